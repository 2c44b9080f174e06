/* A long motion is cut into chunks, so that every core can have one. */
#ifndef APP_CHUNKS_H
#define APP_CHUNKS_H

#include "app/take.h"

/* Frames of the take. Those in front of `own` only warm up: the cloth that they leave behind is
   what the chunk begins with, and nothing of them is written. */
typedef struct {
    FrameSpan span; /* with the warm-up */
    int own;        /* number of the first frame that is written */
    int count;      /* of these */
} Chunk;

/* How a span (gaps filled) of a motion is cut. Depends on the motion, the rate and the span only,
   never on the number of threads; and where a chunk begins not even on the span. */
typedef struct {
    FrameSpan span;
    int length, warm_up; /* in frames of the take */
    int first, count;    /* the chunks that the span reaches, counted from 0 */
    int last_of_motion;  /* the motion's last chunk, which may be longer */
} Chunks;

/* rate: frames of the take a second; total: of the whole motion. */
Chunks chunks_plan(const FrameSpan *span, double rate, int total);

/* Chunk i of 0..count - 1; its count may be 0 where the step leaps over it. */
Chunk chunks_get(const Chunks *c, int i);

/* The most frames that a chunk writes. */
int chunks_most(const Chunks *c);

#endif
