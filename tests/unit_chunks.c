/* Chunks of every span hold each of its frames once, and begin where the motion says. */
#include "app/chunks.h"

#include "dice.h"
#include "tap.h"

static int frames_of(const FrameSpan *s) { return (s->last - s->first) / s->step + 1; }

/* Goes through all chunks as a job does; false where a frame is lost, doubled or out of order. */
static bool is_covered(const FrameSpan *span, const Chunks *c) {
    int next = span->first, most = chunks_most(c);
    for (int i = 0; i < c->count; i++) {
        Chunk chunk = chunks_get(c, i);
        if (chunk.count > most) return false;
        if (i == 0 && (chunk.own != span->first || chunk.span.first != span->first)) return false;
        if (chunk.count == 0) continue;
        if (chunk.own != next || (chunk.own - chunk.span.first) % span->step) return false;
        if (i > 0 && (chunk.span.first >= chunk.own || chunk.own - chunk.span.first >= c->warm_up + span->step))
            return false;
        next = chunk.own + chunk.count * span->step;
        if (next <= chunk.span.last || chunk.own + (chunk.count - 1) * span->step > chunk.span.last) return false;
    }
    return next > span->last;
}

static void test_cover(void) {
    static const double rates[] = {0.01, 1, 24, 30, 66, 119.88, 120, 1000, 1e6};
    int bad = 0, n = 0, several = 0;
    for (int i = 0; i < 20000; i++) {
        int total = 1 + (int)dice_below(i % 2 ? 20000 : 2000);
        FrameSpan span = {1 + (int)dice_below((unsigned)total), total, 1 + i % 7 * (i % 5 == 0)};
        span.last -= (int)dice_below((unsigned)(total - span.first + 1));
        Chunks c = chunks_plan(&span, rates[i % 9], total);
        bool good = is_covered(&span, &c) && c.count >= 1;
        several += c.count > 1;
        bad += !good;
        n += frames_of(&span) > 0;
    }
    OK(bad == 0, "%d spans, %d of several chunks: every frame once", n, several);
}

/* Boundaries belong to the motion: a selection of frames falls into the same chunks. */
static void test_fixed(void) {
    int differs = 0;
    FrameSpan all = {1, 10000, 1};
    Chunks whole = chunks_plan(&all, 120, 10000);
    for (int i = 1; i < whole.count; i++) {
        Chunk chunk = chunks_get(&whole, i);
        FrameSpan part = {chunk.own - 5, chunk.own + 5, 1};
        Chunks c = chunks_plan(&part, 120, 10000);
        differs += c.count != 2 || chunks_get(&c, 1).own != chunk.own;
    }
    OK(whole.count == 7 && differs == 0, "%d chunks, which begin at the same frames of any selection", whole.count);
    OK(chunks_get(&whole, 6).count == 10000 - 6 * 1440, "the last one takes what is left");
    FrameSpan longer = {1, 1440 + 719, 1};
    Chunks one = chunks_plan(&longer, 120, 1440 + 719);
    OK(one.count == 1, "less than half a chunk is no chunk of its own");
    longer.last++;
    Chunks two = chunks_plan(&longer, 120, longer.last);
    OK(two.count == 2, "a half is");
}

int main(void) {
    test_cover();
    test_fixed();
    return tap_done();
}
