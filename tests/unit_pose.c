/* A pose puts every limb where the file's joints are: on motions of many families, those that are shipped too. */
#include "rig.h"
#include "tap.h"
#include "turns.h"

/* Bones that point to a joint; the others have turns of their own. */
static const Role POINTING[] = {
    ROLE_LEFT_UPPER_ARM, ROLE_LEFT_FOREARM, ROLE_LEFT_HAND, ROLE_RIGHT_UPPER_ARM, ROLE_RIGHT_FOREARM, ROLE_RIGHT_HAND,
    ROLE_LEFT_THIGH, ROLE_LEFT_SHIN, ROLE_RIGHT_THIGH, ROLE_RIGHT_SHIN};

typedef struct {
    double off, astray; /* metres from its joint, degrees from its direction: the worst */
    int asked, crooked; /* bones, and those whose turn is no rotation */
    double slack;       /* degrees by which pelvis and chest turn in their joints */
    Mat3 first[2];      /* how they sat there in the first frame */
} Poses;

static void look_at_trunk(const Rig *r, const Pose *pose, int frame, Poses *p) {
    for (int k = 0; k < 2; k++) {
        Role role = k ? ROLE_CHEST : ROLE_PELVIS;
        Mat3 joint = mat_mul(r->figure.upright, r->world[r->figure.roles.joint[role]].r);
        Mat3 seat = mat_mul(mat_transpose(joint), pose->bone[role].r);
        if (frame == 0) p->first[k] = seat;
        p->slack = max_of(p->slack, turned(p->first[k], seat));
    }
}

static void look_at(const Rig *r, const Pose *pose, Poses *p) {
    const Figure *f = &r->figure;
    for (int k = 0; k < ROLE_COUNT; k++) p->crooked += !is_rotation(pose->bone[k].r);
    for (size_t i = 0; i < sizeof POINTING / sizeof POINTING[0]; i++) {
        Role role = POINTING[i];
        int joint = f->roles.joint[role], toward = f->toward[role];
        if (joint < 0 || toward < 0) continue;
        Vec3 bone = mat_apply(pose->bone[role].r, vec_sub(f->end[role], f->start[role]));
        Vec3 seen = mat_apply(f->upright, vec_sub(r->world[toward].t, r->world[joint].t));
        p->asked++;
        p->off = max_of(p->off, vec_dist(rigid_apply(pose->bone[role], f->start[role]), rig_place(r, role)));
        p->astray = max_of(p->astray, angle(bone, seen));
    }
}

/* In a squat shins lean by more than the sole of an unknown foot does. */
static void test_unknown_feet(void) {
    Rig r;
    double shins = 0, soles = 0, aside = 0;
    if (!OK(rig_open(&r, "motions/squat.bvh", NULL), "the squat opens")) return;
    for (int k = ROLE_LEFT_FOOT; k <= ROLE_RIGHT_TOE; k++) r.figure.bound[k] = false;
    for (int frame = 0; frame < r.motion.nframes; frame++) {
        Mat3 shin = rig_pose(&r, frame).bone[ROLE_LEFT_SHIN].r, foot = rig_pose(&r, frame).bone[ROLE_LEFT_FOOT].r;
        shins = max_of(shins, fabs(asin(mat_column(shin, 2).y)) / DEGREE);
        soles = max_of(soles, fabs(asin(mat_column(foot, 2).y)) / DEGREE);
        aside = max_of(aside, angle(mat_column(shin, 0), mat_column(foot, 0)));
    }
    OK(shins > 25 && fabs(shins - soles - 20) < 0.01, "unknown feet are level, but for what an ankle does not give: "
       "%.1f of %.1f degrees", soles, shins);
    OK(aside < 1e-4, "and not turned to the side");
    rig_close(&r);
}

/* From the canonical stance to a pose: all of it at the end, only the pelvis at the beginning. */
static void way_to_a_pose(void) {
    Rig r;
    if (!OK(rig_open(&r, "motions/squat.bvh", NULL), "squat opens")) return;
    Pose pose = rig_pose(&r, r.motion.nframes / 2);
    Pose none = figure_pose_towards(&r.figure, &pose, 0), half = figure_pose_towards(&r.figure, &pose, 0.5);
    Pose whole = figure_pose_towards(&r.figure, &pose, 1);
    double off = 0, begun = 0, unequal = 0, deepest = 0, torn = 0;
    for (int k = 0; k < ROLE_COUNT; k++) {
        int up = (int)role_parent((Role)k);
        Vec3 start = r.figure.start[k];
        double bend = turned(pose.bone[up].r, pose.bone[k].r), bend_half = turned(half.bone[up].r, half.bone[k].r);
        off = max_of(off, turned(whole.bone[k].r, pose.bone[k].r));
        off = max_of(off, vec_dist(rigid_apply(whole.bone[k], start), rigid_apply(pose.bone[k], start)));
        begun = max_of(begun, turned(none.bone[k].r, pose.bone[ROLE_PELVIS].r));
        torn = max_of(torn, vec_dist(rigid_apply(none.bone[k], start), rigid_apply(none.bone[up], start)));
        unequal = max_of(unequal, fabs(bend_half - bend / 2));
        deepest = max_of(deepest, bend);
    }
    OK(off < 1e-5, "all the way is the pose (%.2g off)", off);
    OK(begun < 1e-5 && torn < 1e-12, "none of it the canonical stance at the pelvis (%.2g, %.2g)", begun, torn);
    OK(unequal < 1e-4 && deepest > 30, "half of it bends joints half as far (%.2g of up to %.0f degrees)", unequal,
       deepest);
    rig_close(&r);
}

int main(void) {
    static const char *const files[] = {
        "motions/paper-walk.bvh", "motions/squat.bvh", "motions/turn.bvh", "tests/data/figure/lafan1.bvh",
        "tests/data/figure/mixamo.bvh", "tests/data/figure/nameless_axis.bvh", "tests/data/figure/rigify.bvh",
        "tests/data/figure/smpl.bvh", "tests/data/figure/kinect.bvh", "tests/data/figure/xsens.bvh"};
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        Rig r;
        Poses p = {0};
        if (!OK(rig_open(&r, files[i], NULL), "%s opens", files[i])) continue;
        for (int frame = 0; frame < r.motion.nframes; frame++) {
            Pose pose = rig_pose(&r, frame);
            look_at(&r, &pose, &p);
            look_at_trunk(&r, &pose, frame, &p);
        }
        OK(p.crooked == 0, "every bone moves rigidly");
        OK(p.slack < 1e-4, "pelvis and chest turn with their joints (%.2g degrees off)", p.slack);
        OK(p.asked == 10 * r.motion.nframes && p.off < 0.001, "all %d limb bones begin at their joints (%.2g m off)",
           p.asked / r.motion.nframes, p.off);
        OK(p.astray < 1e-4, "and point where these do (%.2g degrees off)", p.astray);
        rig_close(&r);
    }
    way_to_a_pose();
    test_unknown_feet();
    return tap_done();
}
