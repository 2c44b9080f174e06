/* A take: the frames of a motion as poses of its figure, one after the other, selected,
   resampled in time where that is asked for, and with jumps marked. */
#ifndef APP_TAKE_H
#define APP_TAKE_H

#include "app/jumps.h"
#include "app/settings.h"
#include "dress/frame.h"
#include "figure/relax.h"

typedef struct {
    int number;   /* from 1, of the source or, resampled, of the resampled frames */
    double time;  /* seconds since the first frame of the motion */
    double dt;    /* seconds since the last frame of the take that is not astray; 0 for its first */
    Tie tie;      /* to the frame before; those that a jump leads to and another back from at once are astray */
    Pose pose;
    double arm_turn; /* degrees: the most by which a joint of an arm was turned outwards; see take_relax */
} TakeFrame;

typedef struct Take Take;

/* How many frames the whole motion has at that rate; 0: its own. */
int take_length(const Motion *m, double rate);

/* The span with its gaps filled, 1 <= first, last <= length, 1 <= step. ERR_USAGE where it begins
   behind the motion's end, ERR_INPUT where a rate makes more frames of the motion than its options allow. */
MUST_CHECK bool take_span(const Motion *m, const FrameSpan *span, double rate, FrameSpan *out, Error *e);

/* rate 0: the motion's own. ERR_USAGE for a span that holds no frame. Memory from arena, as
   much for a long motion as for a short one. */
MUST_CHECK bool take_open(const Motion *m, const Figure *figure, const FrameSpan *span, double rate, Arena *arena,
                          Take **out, Error *e);
void take_close(Take *t);

/* From now on arms are turned outwards where they leave no room for the cloth. `body` must be that of
   the figure. Before the first frame. */
MUST_CHECK bool take_relax(Take *t, const Body *body, const Padding *padding, Arena *arena, Error *e);

/* How many frames there will be. */
int take_count(const Take *t);

/* Leaves out all frames before that one, which was not given out yet. */
void take_leap(Take *t, int number);

/* The next frame. False at the end (no error) or with an error; check e->kind. */
bool take_next(Take *t, TakeFrame *out, Error *e);

/* The jumps that were passed so far, or since they were forgotten. */
Jumps take_jumps(const Take *t);
void take_forget_jumps(Take *t);

/* The same as warnings. */
void take_notes(const Take *t, Notes *notes);

#endif
