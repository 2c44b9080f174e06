/* Some frames of a motion, spread evenly over it: what a skeleton is can only be seen where
   it moves, because rest poses lie. */
#ifndef FIGURE_SAMPLE_H
#define FIGURE_SAMPLE_H

#include "motion/motion.h"

enum { SAMPLE_FRAMES_MAX = 64, SAMPLE_BEST_MAX = 16 };

typedef struct {
    int count, njoints;
    const int *frame;   /* which frame of the motion each one is */
    const Rigid *world; /* count x njoints, file units and axes */
    const Rigid *first; /* the motion's first frame */
    const Rigid *zero;  /* and the zero pose: no turns, bones as the OFFSETs say */
} Sample;

/* At most `wanted` frames, wanted <= SAMPLE_FRAMES_MAX. Long motions give their first frame, often a T-pose that is no
   part of the take, no vote. */
MUST_CHECK bool sample_read(const Motion *m, int wanted, Arena *arena, Sample *out, Error *e);

static inline Rigid sample_at(const Sample *s, int i, int joint) { return s->world[(long)i * s->njoints + joint]; }
static inline Vec3 sample_point(const Sample *s, int i, int joint) { return s->world[(long)i * s->njoints + joint].t; }

/* Mean distance between two joints, file units. */
double sample_distance(const Sample *s, int a, int b);

/* The frames with the largest scores (one for each frame), best first: a quarter of all, at
   least three where there are three. Returns their number. */
int sample_best(const Sample *s, const double *score, int out[SAMPLE_BEST_MAX]);

/* The same for the frames in which a foot most likely stands flat: ankle and tip are low, and the ankle is about
   `rise` (file units) over the tip. upright: file axes -> Y up. */
int sample_standing(const Sample *s, Mat3 upright, int ankle, int tip, double rise, int out[SAMPLE_BEST_MAX]);

/* The joint below `joint` (end sites too) that lies farthest from it in the first frame of
   the sample, but not beyond `limit`: what a foot stands on may hang below it. -1 where nothing
   below it has any distance. */
int sample_tip(const Sample *s, const Skeleton *skeleton, int joint, double limit);

#endif
