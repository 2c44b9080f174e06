/* Some frames of a motion, spread evenly over it. How a skeleton is built shows in its movement: its rest pose may
   mean nothing. */
#ifndef FIGURE_SAMPLE_H
#define FIGURE_SAMPLE_H

#include "motion/motion.h"

enum { SAMPLE_FRAMES_MAX = 64, SAMPLE_BEST_MAX = 16 };

typedef struct {
    int count, njoints;
    const int *frame;   /* which frame of the motion each one is */
    const Rigid *world; /* transforms of all joints, count x njoints, file units and axes */
    const Rigid *first; /* the same in the motion's first frame */
    const Rigid *zero;  /* and in the zero pose: all rotations zero, bones as the OFFSETs say */
} Sample;

/* At most `wanted` frames, wanted <= SAMPLE_FRAMES_MAX. The first frame of a long motion, often a T-pose that is no
   part of the take, is not among them. */
MUST_CHECK bool sample_read(const Motion *m, int wanted, Arena *arena, Sample *out, Error *e);

static inline Rigid sample_at(const Sample *s, int i, int joint) { return s->world[(long)i * s->njoints + joint]; }
static inline Vec3 sample_point(const Sample *s, int i, int joint) { return s->world[(long)i * s->njoints + joint].t; }

/* The place half-way between two joints. */
static inline Vec3 sample_middle(const Sample *s, int i, int a, int b) {
    return vec_mid(sample_point(s, i, a), sample_point(s, i, b));
}

/* Mean distance between two joints, file units. */
double sample_distance(const Sample *s, int a, int b);

/* The frames with the largest scores, best first: a quarter of the sample, at least three where there are three.
   score: one for each frame. Returns their number. */
int sample_best(const Sample *s, const double *score, int out[SAMPLE_BEST_MAX]);

/* The frames in which a foot most likely stands flat, best first: ankle and tip are low, and the ankle is about `rise`
   (file units) over the tip. upright: file axes -> Y up. Returns their number. */
int sample_standing(const Sample *s, Mat3 upright, int ankle, int tip, double rise, int out[SAMPLE_BEST_MAX]);

/* The joint or end site below `joint` in the tree that lies farthest from it in the first frame of the sample, of those
   within `limit` (file units): what is farther is a thing that a hand or foot holds. -1 where there is none. */
int sample_tip(const Sample *s, const Skeleton *skeleton, int joint, double limit);

#endif
