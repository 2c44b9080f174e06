/* A walk by formula: the pelvis is level and glides at one height, the thighs swing 24 degrees
   either way about 8, and the knees bend strongly in swing, so that a skirt is met by the knee
   of one leg at a time. Feet are not planted: what counts here is that the motion is simple
   enough to be stated in a paper. */
#include "motion/gait_paper.h"

#include "motion/gait_curves.h"

/* Where the knee is bent most, radians before the thigh's foremost place; and the same moment
   in the published curves, as a part of the stride. */
#define KNEE_PEAK (-1.35)
#define KNEE_PEAK_CYCLE 0.72
#define KNEE_WIDTH 0.62

static void pose_leg(const Gait *g, double phase, GaitPose *pose, int side) {
    double d = remainder(phase - KNEE_PEAK, 2 * PI);
    double hip = 8 + 24 * cos(phase);
    double knee = 6 + (54 + g->knee_lift) * exp(-d * d / (2 * KNEE_WIDTH * KNEE_WIDTH));
    double ankle = gait_curve(GAIT_CURVE_ANKLE, d / (2 * PI) + KNEE_PEAK_CYCLE);
    gait_pose_leg(pose, side, hip, 0, knee, ankle);
    /* Behind the body the toes stay level while the heel rises. */
    gait_pose_toe(pose, side, fmax(0, knee - hip - ankle) * smoothstep(-0.2, -0.6, cos(phase)));
}

static GaitPose pose_at(const Gait *g, int frame) {
    GaitPose pose = {0};
    int stride = 2 * g->frames_per_step;
    double swing = g->arm_swing;
    for (int side = 0; side < GAIT_SIDES; side++) {
        int own = (frame + side * g->frames_per_step) % stride;
        double phase = 2 * PI * own / stride;
        pose_leg(g, phase, &pose, side);
        /* Arms swing against their legs, turned outwards so that hands clear a wide skirt. */
        gait_pose_arm(&pose, side, 2 - swing * cos(phase), 17, 18 - 0.4 * swing * cos(phase));
    }
    return pose;
}

/* How far the lowest point of both soles lies under the hips. */
static double reach_down(const GaitBody *body, const GaitPose *pose) {
    double deepest = 0;
    for (int side = 0; side < GAIT_SIDES; side++) {
        Rigid foot = gait_pose_foot(body, pose, side);
        double heel = -rigid_apply(foot, vec(0, -body->ankle, -body->heel)).y;
        double toe = -rigid_apply(foot, vec(0, -body->ankle, body->ball)).y;
        deepest = fmax(deepest, fmax(heel, toe));
    }
    return deepest;
}

double gait_paper_height(const Gait *g, const GaitBody *body) {
    double height = 0;
    for (int i = 0; i < g->frames_per_step; i++) { /* the second step is the first one's mirror image */
        GaitPose pose = pose_at(g, i);
        height = fmax(height, reach_down(body, &pose));
    }
    return height;
}

GaitPose gait_paper_pose(const Gait *g, double height, int frame) {
    GaitPose pose = pose_at(g, frame);
    pose.hips = vec(0, height, 100 * g->step_length * frame / g->frames_per_step);
    return pose;
}
