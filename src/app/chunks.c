/* Where chunks begin. What a frame's cloth takes over from the frame before sinks by a centimetre in a
   tenth of a second, then fades by a fifth every thirtieth (dress/field.c); WARM_UP seconds are enough
   for the most that cloth is ever displaced, a seventh of the height. So a chunk that warms up so long
   begins as if it had been there all the time, to within the digits that are written. Every machine and
   every number of threads cuts alike, and so all write the same bytes. */
#include "app/chunks.h"

/* Seconds, and the bounds in frames that keep odd rates from making chunks of nothing, or chunks
   whose rows of statistics do not fit in memory. */
static const double LENGTH = 12, WARM_UP = 2.5;
enum { LENGTH_LEAST = 240, LENGTH_MOST = 4096, WARM_UP_LEAST = 8, WARM_UP_MOST = 512 };

static int bounded(double x, int least, int most) { return x < least ? least : x > most ? most : (int)x; }

/* The chunk of a frame. What is left behind the last boundary joins the chunk before if it is less
   than half of one. */
static int chunk_of(const Chunks *c, int number) {
    int k = (number - 1) / c->length;
    return k < c->last_of_motion ? k : c->last_of_motion;
}

Chunks chunks_plan(const FrameSpan *span, double rate, int total) {
    Chunks c = {.span = *span};
    c.length = bounded(LENGTH * rate + 0.5, LENGTH_LEAST, LENGTH_MOST);
    c.warm_up = bounded(WARM_UP * rate + 0.999, WARM_UP_LEAST, WARM_UP_MOST);
    c.last_of_motion = total / c.length - (total % c.length * 2 < c.length);
    if (c.last_of_motion < 0) c.last_of_motion = 0;
    c.first = chunk_of(&c, span->first);
    c.count = chunk_of(&c, span->last) - c.first + 1;
    return c;
}

/* The first frame of the span at or behind `number`. */
static int align(const FrameSpan *span, long long number) {
    if (number <= span->first) return span->first;
    long long steps = (number - span->first + span->step - 1) / span->step;
    long long n = span->first + steps * span->step;
    return n > span->last ? span->last + 1 : (int)n;
}

Chunk chunks_get(const Chunks *c, int i) {
    int k = c->first + i;
    long long begin = (long long)k * c->length + 1, end = begin + c->length - 1;
    if (k == c->last_of_motion || end > c->span.last) end = c->span.last;
    Chunk chunk = {.span = c->span, .own = align(&c->span, begin)};
    chunk.span.last = (int)end;
    chunk.span.first = i == 0 ? c->span.first : align(&c->span, begin - c->warm_up);
    chunk.count = chunk.own > end ? 0 : (int)(end - chunk.own) / c->span.step + 1;
    return chunk;
}

int chunks_most(const Chunks *c) {
    int whole = (c->span.last - c->span.first) / c->span.step + 1;
    int most = (c->length + c->length / 2) / c->span.step + 1;
    return c->count > 1 && most < whole ? most : whole;
}
