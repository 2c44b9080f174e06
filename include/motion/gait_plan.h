/* Where and when every foot stands: the plan of a walk over level ground, a slope, stairs or
   along a turn. Centimetres; time in steps: step k meets the ground at time k. */
#ifndef MOTION_GAIT_PLAN_H
#define MOTION_GAIT_PLAN_H

#include "base/arena.h"
#include "motion/gait.h"
#include "motion/gait_foot.h"

/* The ground under the walker; it does not change along x. */
typedef struct {
    double slope;            /* degrees, up along +z is positive */
    double first, rise, run; /* stairs: where the first riser stands; negative rise goes down */
    int count;               /* of risers */
} GaitGround;

/* A step of the walk, as the whole body sees it. */
typedef struct {
    Footfall foot;
    Vec3 centre;     /* on the track, between left and right */
    double heading;  /* degrees about y */
} GaitStep;

typedef struct {
    Gait gait;       /* complete */
    GaitBody body;
    GaitGround ground;
    int nsteps;      /* 0 and 1 are the feet of the standing walker, left and right */
    GaitStep *step;  /* left and right in turn; step i meets the ground at time i - 1 */
    double start, end;
} GaitPlan;

/* g is complete (gait_write sees to that) and within its ranges. ERR_USAGE where the steps do
   not suit the ground. Memory from arena. */
MUST_CHECK bool gait_plan(const Gait *g, Arena *arena, GaitPlan *out, Error *e);

/* The walker's place on the track at time t, and its heading. */
Vec3 gait_plan_centre(const GaitPlan *plan, double t);
double gait_plan_heading(const GaitPlan *plan, double t);

/* The foot of a side at time t; *swing: 0 while it stands, else how far it has swung, 0..1. */
FootPose gait_plan_foot(const GaitPlan *plan, int side, double t, double *swing);

#endif
