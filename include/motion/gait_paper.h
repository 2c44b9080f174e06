/* The analytic gait of the comparison between uniform and adaptive subdivision. */
#ifndef MOTION_GAIT_PAPER_H
#define MOTION_GAIT_PAPER_H

#include "motion/gait.h"
#include "motion/gait_body.h"

/* The height at which the pelvis glides, centimetres: no heel or ball goes below the ground. g is complete. */
double gait_paper_height(const Gait *g, const GaitBody *body);

/* The pose of a frame of an endless walk at that height; it repeats after 2 * frames_per_step frames but for
   hips.z, which advances by g->step_length in every step. */
GaitPose gait_paper_pose(const Gait *g, double height, int frame);

#endif
