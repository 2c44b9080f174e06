/* The analytic gait of the comparison between uniform and adaptive subdivision. */
#ifndef MOTION_GAIT_PAPER_H
#define MOTION_GAIT_PAPER_H

#include "motion/gait.h"
#include "motion/gait_body.h"

/* The pose of a frame of an endless walk; it repeats after 2 * frames_per_step frames but for
   hips.z, which advances by g->step_length in every step. g is complete. */
GaitPose gait_paper_pose(const Gait *g, const GaitBody *body, int frame);

#endif
