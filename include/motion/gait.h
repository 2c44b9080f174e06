/* Walking motions made from normative gait data, written as BVH.

   Body: segment lengths as fractions of stature after Drillis and Contini (1966), as printed
   in Winter, Biomechanics and Motor Control of Human Movement, fig. 4.1. Natural walking
   follows the joint angles of Bovi et al. (2011) within 5 degrees; the table stands in
   src/motion/gait_curves.c. In the file the x rotations are: UpLeg = 9 - hip (the published
   hip is measured from a pelvis that stands 9 degrees forward), Leg = knee, Foot = -ankle. */
#ifndef MOTION_GAIT_H
#define MOTION_GAIT_H

#include <stdio.h>

#include "base/arena.h"

/* gait_defaults fills it; see the options of `kitsuke walk` for units and ranges. */
typedef struct {
    const char *preset;      /* "normal", "paper" (strong knee flexion, level pelvis), "brisk",
                                "squat", "turn" */
    int frames_per_step;     /* 4..1000 */
    int steps;               /* 1..10000; 0 = what suits the preset */
    double step_length;      /* metres, heel to heel; 0 = from height and preset */
    double height;           /* stature, metres */
    double speed;            /* metres per second; 0 = from step length and preset */
    double knee_lift;        /* degrees of extra knee flexion in swing */
    double arm_swing;        /* degrees, half the range of the shoulder; negative = preset's */
    double slope;            /* degrees, up is positive */
    double stair_rise, stair_run; /* metres; 0 = no stairs; negative rise: down */
    int stair_count;
} Gait;

void gait_defaults(Gait *g);

/* Writes the motion as BVH (cm, or mm for who is less than 83 cm tall; Y up, walking along +Z).
   ERR_USAGE for values out of range or impossible together; whether `out` has an error is left to the caller. */
MUST_CHECK bool gait_write(const Gait *g, FILE *out, Error *e);

#endif
