/* Where meshes that belong together lie on the disk: the sequence of a body, those of its garments. */
#ifndef APP_REELS_H
#define APP_REELS_H

#include "app/settings.h"
#include "files/sequence.h"

typedef struct {
    const char *motion;  /* its folder, below the one that was named; "" where there is none */
    Sequence body;
    int ngarments;
    Sequence *garment;
    double rate;         /* frames a second as stats.csv tells, where --acceleration needs it; 0: unknown */
    Error error;         /* kind 0: all the above is there */
} Reel;

/* From the folders that `dress` wrote (settings->inputs; each may hold many motions) or from the
   patterns of --garment and --body. Where a motion's meshes are not complete its error says so, and
   the others are there. ERR_USAGE, ERR_INPUT. */
MUST_CHECK bool reels_find(const Settings *s, Arena *arena, Reel **out, int *count, Error *e);

/* The numbers of the frames that any of the reel's sequences has and `span` selects, in order, and
   the usual step from one to the next. Only files without a number: one frame, 1. */
MUST_CHECK bool reel_frames(const Reel *reel, const FrameSpan *span, Arena *arena, int **out, int *count, int *step,
                            Error *e);

#endif
