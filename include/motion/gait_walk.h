/* The walker's whole body along a plan. */
#ifndef MOTION_GAIT_WALK_H
#define MOTION_GAIT_WALK_H

#include "motion/gait_plan.h"

typedef struct {
    const GaitPlan *plan;
    int frames;
    double *drop; /* for each frame: how far the hips are lowered so that both feet are in reach */
} GaitWalk;

/* Prepares the poses of all frames. ERR_USAGE where a foot cannot be reached. */
MUST_CHECK bool gait_walk(const GaitPlan *plan, Arena *arena, GaitWalk *out, Error *e);
GaitPose gait_walk_pose(const GaitWalk *walk, int frame);

#endif
