/* Cloth that follows several bones at once. */
#include "dice.h"
#include "dress/blend.h"
#include "tap.h"

static Vec3 moved(const Figure *f, const Pose *pose, const Binding *b, Vec3 rest) {
    Blender blender = blender_of(f, pose);
    return rigid_apply(blend_at(&blender, b, rest), rest);
}

/* Turns all bones of a leg about its hip. */
static void turn_leg(const Figure *f, Pose *pose, Role thigh, Mat3 turn) {
    Vec3 hip = rigid_apply(pose->bone[thigh], f->start[thigh]);
    Rigid about = {turn, vec_sub(hip, mat_apply(turn, hip))};
    for (int r = (int)thigh; r <= (int)thigh + 3; r++) pose->bone[r] = rigid_mul(about, pose->bone[r]);
}

static void bends_about_the_joint(const Figure *f) {
    Binding both = {2, {ROLE_LEFT_THIGH, ROLE_LEFT_SHIN}, {0.5, 0.5}};
    Vec3 knee = f->start[ROLE_LEFT_SHIN], beside = vec_add(knee, vec(0, 0, 0.06));
    double off = 0;
    for (int bend = 0; bend <= 150; bend += 10) {
        Pose pose = figure_rest_pose();
        Mat3 turn = mat_axis_angle(vec(1, 0, 0), bend * PI / 180);
        pose.bone[ROLE_LEFT_SHIN] = (Rigid){turn, vec_sub(knee, mat_apply(turn, knee))};
        off = max_of(off, vec_dist(moved(f, &pose, &both, knee), knee));
        off = max_of(off, fabs(vec_dist(moved(f, &pose, &both, beside), knee) - 0.06));
    }
    OK(off < 1e-12, "half thigh and half shin turn about the knee (%g m off)", off);
}

/* A leg that turns about itself by 60 degrees: cloth half-way down the thigh goes half as far, at the knee as far. */
static void thighs_twist_little_by_little(const Figure *f) {
    Binding thigh = {1, {ROLE_LEFT_THIGH}, {1}};
    Pose pose = figure_rest_pose();
    Vec3 hip = f->start[ROLE_LEFT_THIGH], along = vec_sub(f->end[ROLE_LEFT_THIGH], hip);
    Vec3 axis = vec_unit_or(along, vec(0, -1, 0));
    turn_leg(f, &pose, ROLE_LEFT_THIGH, mat_axis_angle(axis, PI / 3));
    double off = 0;
    for (double down = 0; down <= 1; down += 0.125) {
        Vec3 arm = vec_mad(vec_scale(along, down), vec_unit_or(vec_cross(axis, vec(1, 0, 0)), axis), 0.08);
        Vec3 wanted = vec_add(hip, mat_apply(mat_axis_angle(axis, PI / 3 * down), arm));
        off = max_of(off, vec_dist(moved(f, &pose, &thigh, vec_add(hip, arm)), wanted));
    }
    OK(off < 1e-9, "cloth turns with a thigh the more the farther down it is (%g m off)", off);
}

/* A squat whose thigh goes past straight up beside the trunk, from 20 degrees before it to 10 behind it. Cloth of the
   hip, 12 cm from the joint, goes at most about as far as the thigh at that distance, and back the same way. */
static void thighs_pass_straight_up(const Figure *f) {
    Binding hip = {2, {ROLE_PELVIS, ROLE_LEFT_THIGH}, {0.67, 0.33}};
    Vec3 joint = f->start[ROLE_LEFT_THIGH];
    Pose pose = figure_rest_pose();
    turn_leg(f, &pose, ROLE_LEFT_THIGH, mat_axis_angle(vec(-1, 0, 0), 160 * PI / 180));
    turn_leg(f, &pose, ROLE_LEFT_THIGH, mat_axis_angle(vec(0, 0, 1), -0.2));
    Vec3 before[8], first[8];
    double step = 0;
    for (int k = 0; k <= 60; k++) {
        for (int n = 0; n < 8; n++) {
            Vec3 rest = vec_add(joint, vec(0.12 * cos(n * PI / 4), 0, 0.12 * sin(n * PI / 4)));
            Vec3 at = moved(f, &pose, &hip, rest);
            if (k > 0) step = max_of(step, vec_dist(at, before[n]));
            else first[n] = at;
            before[n] = at;
        }
        turn_leg(f, &pose, ROLE_LEFT_THIGH, mat_axis_angle(vec(-1, 0, 0), 0.5 * PI / 180));
    }
    OK(step < 0.12 * 0.5 * PI / 180 * 1.5, "half a degree of a thigh that passes straight up: cloth moves by %.2f mm",
       1000 * step);
    int inwards = 0;
    for (int n = 0; n < 8; n++) inwards += vec_dist(first[n], before[n]) > 0.12 * 30 * PI / 180;
    OK(inwards == 0, "and all in all by no more than the thigh there");
}

/* Left and right are mirrored, whatever the pose of the leg. */
static void sides_are_mirrored(const Figure *f) {
    Binding left = {2, {ROLE_PELVIS, ROLE_LEFT_THIGH}, {0.6, 0.4}}, right = left;
    right.bone[1] = ROLE_RIGHT_THIGH;
    double off = 0;
    for (int k = 0; k < 500; k++) {
        Pose a = figure_rest_pose(), b = a;
        Vec3 axis = vec_unit_or(vec_add(vec(-2, 0, 0), dice_around()), vec(-1, 0, 0)), rest = vec(0.1, 0.8, 0.05);
        double angle = 2.5 * dice_unit();
        turn_leg(f, &a, ROLE_LEFT_THIGH, mat_axis_angle(axis, angle));
        turn_leg(f, &b, ROLE_RIGHT_THIGH, mat_axis_angle(vec(axis.x, -axis.y, -axis.z), angle));
        Vec3 at = moved(f, &a, &left, rest), other = moved(f, &b, &right, vec(-rest.x, rest.y, rest.z));
        off = max_of(off, vec_dist(at, vec(-other.x, other.y, other.z)));
    }
    OK(off < 1e-9, "left and right move as mirror images (%g m off)", off);
}

int main(void) {
    Figure f = figure_reference();
    bends_about_the_joint(&f);
    thighs_twist_little_by_little(&f);
    thighs_pass_straight_up(&f);
    sides_are_mirrored(&f);
    return tap_done();
}
