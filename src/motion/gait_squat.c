/* Going down, the hips move back and the trunk leans forward, so that the body stays over the
   feet; the arms come up in front. Legs follow by inverse kinematics. */
#include "motion/gait_squat.h"

/* Parts of the stature: place of the hips over the ankles, standing and down. */
#define HIGH 0.528
#define LOW 0.300
#define AHEAD 0.0155
#define BACK (-0.125)
#define HALF_WIDTH 0.070

#define TOE_OUT 12.0 /* degrees */
#define PELVIS_LEAN 22.0
#define TRUNK_LEAN 20.0

GaitPose gait_squat_pose(const GaitBody *body, double depth) {
    GaitPose pose = {0};
    double h = body->height;
    pose.hips = vec(0, h * (HIGH + (LOW - HIGH) * depth), h * (AHEAD + (BACK - AHEAD) * depth));
    pose.turn[GAIT_HIPS].x = PELVIS_LEAN * depth;
    pose.turn[GAIT_SPINE].x = TRUNK_LEAN / 2 * depth;
    pose.turn[GAIT_CHEST].x = TRUNK_LEAN / 2 * depth;
    pose.turn[GAIT_NECK].x = -TRUNK_LEAN / 2 * depth;
    pose.turn[GAIT_HEAD].x = -TRUNK_LEAN / 2 * depth;
    for (int side = 0; side < GAIT_SIDES; side++) {
        double left = side == GAIT_LEFT ? 1 : -1, out = left * TOE_OUT * PI / 180;
        Rigid foot = {mat_axis_angle(vec(0, 1, 0), out), vec(left * HALF_WIDTH * h, body->ankle, 0)};
        gait_pose_reach(body, &pose, side, foot, vec(sin(out), 0, cos(out)));
        gait_pose_arm(&pose, side, (75 + PELVIS_LEAN + TRUNK_LEAN) * depth, 11 - 6 * depth, 12 - 4 * depth);
    }
    return pose;
}
