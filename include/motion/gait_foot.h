/* One foot: how it rolls over the ground while it stands, and how it swings from one place to
   the next. Time is counted in steps, so a stride lasts 2. Centimetres and degrees. */
#ifndef MOTION_GAIT_FOOT_H
#define MOTION_GAIT_FOOT_H

#include "motion/gait_body.h"

/* Parts of a stride: a foot stands for the first, then swings. */
#define GAIT_STANCE 0.60
#define GAIT_SWING_TIME (2 * (1 - GAIT_STANCE)) /* in steps */

/* Length of the step that belongs to the published angles, in statures: what the hip travels
   over a foot that rolls as they say. */
#define GAIT_STEP 0.394

/* Pitch of the foot, toes up positive, when it meets and leaves the ground in natural walking. */
double gait_foot_strike(void);
double gait_foot_lift(void);

/* A place where a foot stands, and when. */
typedef struct {
    int side;
    double contact, release; /* time in steps; far away for the feet of a standing walker */
    Rigid ground;            /* origin under the ankle of a flat foot, y = up from the ground, z = to the toes */
    double strike, lift;     /* pitch at contact and at release against the ground */
    double climb;            /* height gained on stairs since the same foot's last place */
    double clearance;        /* extra height in the swing that ends here, */
    Vec3 detour;             /* and how far its middle lies beside the straight line: round a bend that would lead
                                through the other leg */
} Footfall;

/* A foot's frame (origin at the ankle) and the bend of its toes. */
typedef struct {
    Rigid frame;
    double toe;
} FootPose;

/* Points of the sole in the world: heel, ankle, ball, tip of the toes. */
enum { GAIT_SOLE = 4 };
void gait_foot_sole(const GaitBody *body, const FootPose *foot, Vec3 *sole);

/* The foot at rest on `f`, rolling over heel and toes as t nears contact and release: the heel
   stays where it is until the foot lies flat, the toes stay from then on. */
FootPose gait_foot_stand(const GaitBody *body, const Footfall *f, double t);

/* The part of `clearance` that counts at x = 0..1 of the swing; at most 1. */
double gait_foot_clearance(const Footfall *to, double x);

/* Between from->release and to->contact. */
FootPose gait_foot_swing(const GaitBody *body, const Footfall *from, const Footfall *to, double t);

#endif
