/* Squatting on the spot, for garments over strongly bent knees and hips. */
#ifndef MOTION_GAIT_SQUAT_H
#define MOTION_GAIT_SQUAT_H

#include "motion/gait_body.h"

/* depth: 0 stands upright, 1 has the thighs nearly level. Feet stay flat on the ground. */
GaitPose gait_squat_pose(const GaitBody *body, double depth);

#endif
