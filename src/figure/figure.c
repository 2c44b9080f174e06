/* A figure in motion. Pelvis, chest, head and feet are rigid with their joints (bind.c finds
   how they sit on them), so they lean and turn as the performer did. Limbs do not: the twist
   of a joint means something else in every rig, so a limb bone takes the smallest turn from
   its parent that points it the right way, and starts where its joint is. */
#include "figure/figure.h"

#include "figure/bind.h"
#include "figure/measure.h"

enum { SAMPLE_FRAMES = 64 };

/* A bone may start this far (in heights) from its parent's end: joints whose distance varies
   do not tear the body apart. */
static const double GAP = 0.05;
/* A direction shorter than this (in bone lengths) says nothing. */
static const double POINTS = 0.15;

bool figure_build(const Motion *m, const Roles *roles, const FigureOptions *options, Arena *scratch, Notes *notes,
                  Figure *out, Error *e) {
    Sample sample;
    Figure f = {.roles = *roles};
    if (!sample_read(m, SAMPLE_FRAMES, scratch, &sample, e)) return false;
    if (!figure_measure(m, options, &sample, notes, &f, e)) return false;
    figure_bind(&m->skeleton, &sample, &f);
    *out = f;
    return true;
}

/* ---- pose ---- */

typedef struct {
    const Figure *f;
    const Rigid *world;
    Pose *pose;
} Poser;

static Rigid joint_in_world(const Poser *p, int joint) {
    Rigid g = p->world[joint];
    return (Rigid){mat_mul(p->f->upright, g.r), vec_scale(mat_apply(p->f->upright, g.t), p->f->unit)};
}

static Vec3 point(const Poser *p, int joint) { return joint_in_world(p, joint).t; }

/* The rigid motion with that rotation that takes the canonical point `from` to `to`. */
static Rigid placed(Mat3 r, Vec3 from, Vec3 to) { return (Rigid){r, vec_sub(to, mat_apply(r, from))}; }

static void follow(const Poser *p, Role role, Role parent) { p->pose->bone[role] = p->pose->bone[parent]; }

/* Turns with its joint, starts where `parent` says, within GAP of where the joint is. */
static Vec3 start_of(const Poser *p, Role role, Role parent) {
    Vec3 expected = rigid_apply(p->pose->bone[parent], p->f->start[role]);
    int joint = p->f->roles.joint[role];
    if (joint < 0) return expected;
    Vec3 gap = vec_sub(point(p, joint), expected);
    double size = vec_len(gap), most = GAP * p->f->height;
    return vec_mad(expected, gap, size > most ? most / size : 1);
}

/* Points from `start` to where the next joint is, by the smallest turn from `parent`. */
static void point_bone(const Poser *p, Role role, Role parent, Vec3 start, int from) {
    const Figure *f = p->f;
    Vec3 along = vec_sub(f->end[role], f->start[role]);
    Mat3 r = p->pose->bone[parent].r;
    if (from >= 0 && f->toward[role] >= 0) {
        Vec3 now = vec_sub(point(p, f->toward[role]), point(p, from));
        if (vec_len(now) > POINTS * vec_len(along)) {
            Vec3 rest = mat_apply(r, vec_unit_or(along, vec(0, 1, 0)));
            r = mat_mul(mat_between(rest, vec_unit_or(now, rest)), r);
        }
    }
    p->pose->bone[role] = placed(r, f->start[role], start);
}

static void pose_limb_bone(const Poser *p, Role role, Role parent) {
    point_bone(p, role, parent, start_of(p, role, parent), p->f->roles.joint[role]);
}

static void pose_bound(const Poser *p, Role role, Role parent) {
    if (!p->f->bound[role]) { follow(p, role, parent); return; }
    Mat3 r = mat_mul(joint_in_world(p, p->f->roles.joint[role]).r, p->f->bind[role].r);
    p->pose->bone[role] = placed(r, p->f->start[role], start_of(p, role, parent));
}

/* Half-way between pelvis and chest in turn and place. */
static void pose_spine(const Poser *p) {
    const Figure *f = p->f;
    Rigid pelvis = p->pose->bone[ROLE_PELVIS], chest = p->pose->bone[ROLE_CHEST];
    Mat3 r = mat_from_quat(quat_nlerp(quat_from_mat(pelvis.r), quat_from_mat(chest.r), 0.5));
    Vec3 middle = vec_mid(f->start[ROLE_SPINE], f->end[ROLE_SPINE]);
    Vec3 place = vec_mid(rigid_apply(pelvis, f->start[ROLE_SPINE]), rigid_apply(chest, f->end[ROLE_SPINE]));
    p->pose->bone[ROLE_SPINE] = placed(r, middle, place);
}

/* From where the chest carries its base to where the head is. */
static void pose_neck_and_head(const Poser *p) {
    const Figure *f = p->f;
    Rigid chest = p->pose->bone[ROLE_CHEST], *neck = &p->pose->bone[ROLE_NECK], *head = &p->pose->bone[ROLE_HEAD];
    Mat3 turned = chest.r;
    if (f->bound[ROLE_HEAD]) turned = mat_mul(joint_in_world(p, f->roles.joint[ROLE_HEAD]).r, f->bind[ROLE_HEAD].r);
    Quat between = quat_nlerp(quat_from_mat(chest.r), quat_from_mat(turned), 0.5);
    *neck = placed(mat_from_quat(between), f->start[ROLE_NECK], rigid_apply(chest, f->start[ROLE_NECK]));
    *head = placed(turned, f->start[ROLE_HEAD], rigid_apply(*neck, f->end[ROLE_NECK]));
}

static void pose_arm(const Poser *p, Role clavicle) {
    Vec3 start = rigid_apply(p->pose->bone[ROLE_CHEST], p->f->start[clavicle]);
    const Figure *f = p->f;
    Vec3 shoulder = point(p, f->roles.joint[clavicle + 1]);
    Mat3 r = p->pose->bone[ROLE_CHEST].r;
    Vec3 rest = mat_apply(r, vec_sub(f->end[clavicle], f->start[clavicle])), now = vec_sub(shoulder, start);
    if (vec_len(now) > POINTS * vec_len(rest)) {
        rest = vec_unit_or(rest, vec(0, 1, 0));
        r = mat_mul(mat_between(rest, vec_unit_or(now, rest)), r);
    }
    p->pose->bone[clavicle] = placed(r, f->start[clavicle], start);
    for (Role role = clavicle + 1; role <= clavicle + 3; role++) {
        /* The upper arm's turn is counted from the chest: the clavicle's is small and noisy. */
        Vec3 at = start_of(p, role, role - 1);
        point_bone(p, role, role == clavicle + 1 ? ROLE_CHEST : role - 1, at, f->roles.joint[role]);
    }
}

static void pose_leg(const Poser *p, Role thigh) {
    pose_limb_bone(p, thigh, ROLE_PELVIS);
    pose_limb_bone(p, thigh + 1, thigh);
    pose_bound(p, thigh + 2, thigh + 1);
    if (p->f->bound[thigh + 3]) {
        Mat3 r = mat_mul(joint_in_world(p, p->f->roles.joint[thigh + 3]).r, p->f->bind[thigh + 3].r);
        Vec3 start = rigid_apply(p->pose->bone[thigh + 2], p->f->start[thigh + 3]);
        p->pose->bone[thigh + 3] = placed(r, p->f->start[thigh + 3], start);
    } else {
        follow(p, thigh + 3, thigh + 2);
    }
}

void figure_pose(const Figure *f, const Rigid *world, Pose *out) {
    Poser p = {f, world, out};
    out->bone[ROLE_PELVIS] = rigid_mul(joint_in_world(&p, f->roles.joint[ROLE_PELVIS]), f->bind[ROLE_PELVIS]);
    out->bone[ROLE_CHEST] = rigid_mul(joint_in_world(&p, f->roles.joint[ROLE_CHEST]), f->bind[ROLE_CHEST]);
    pose_spine(&p);
    pose_neck_and_head(&p);
    pose_arm(&p, ROLE_LEFT_CLAVICLE);
    pose_arm(&p, ROLE_RIGHT_CLAVICLE);
    pose_leg(&p, ROLE_LEFT_THIGH);
    pose_leg(&p, ROLE_RIGHT_THIGH);
}

Pose figure_rest_pose(void) {
    Pose pose;
    for (int r = 0; r < ROLE_COUNT; r++) pose.bone[r] = rigid_identity();
    return pose;
}

double figure_speed(const Figure *f, const Pose *a, const Pose *b, double dt) {
    double most = 0;
    for (int r = 0; r < ROLE_COUNT; r++) {
        double d = vec_dist(rigid_apply(a->bone[r], f->end[r]), rigid_apply(b->bone[r], f->end[r]));
        if (d > most) most = d;
    }
    return most / f->height / (dt > 1e-9 ? dt : 1e-9);
}
