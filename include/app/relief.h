/* The turns of the arms over time: enough in every frame, smooth from frame to frame. */
#ifndef APP_RELIEF_H
#define APP_RELIEF_H

#include "app/jumps.h"
#include "figure/relax.h"

typedef struct Relief Relief;

/* lone_first: the first frame does not belong to the others. Motion, figure, body and padding must
   outlive it. Memory from arena, as much for a long motion as for a short one. */
MUST_CHECK bool relief_open(const Motion *m, const Figure *figure, const Body *body, const Padding *padding,
                            bool lone_first, Arena *arena, Relief **out, Error *e);
void relief_close(Relief *r);

/* The turns at a source frame, from 0. Frames may be left out but never come again. They depend on
   the source alone: on the frames within half a second, not on which of them are asked for. */
MUST_CHECK bool relief_at(Relief *r, int frame, ArmTurn out[ARMS], Error *e);

#endif
