/* A figure in motion. Pelvis, chest, head and feet are rigid with their joints (bind.c finds how they sit on them), so
   they lean and turn as the performer did. Limb bones are not: the rotation of a limb's joint about its bone means
   something else in every rig. So a limb bone takes only its direction and its start from the joints, and turns by the
   smallest rotation from its parent. A thigh also turns about its own axis, with the hips and with the plane in which
   its knee bends: joint positions tell these in every rig. */
#include "figure/figure.h"

#include "figure/bind.h"
#include "figure/measure.h"

/* A bone may start this far (in statures) from its parent's end, so that joints whose distance varies do not tear the
   body apart. */
static const double GAP = 0.05;
/* A way to the next joint that is shorter than this (in bone lengths) tells no direction. */
static const double SHORT = 0.15;

bool figure_build(const Motion *m, const Roles *roles, const FigureOptions *options, Arena *scratch, Notes *notes,
                  Figure *out, Error *e) {
    Sample sample;
    Rest rest;
    Figure f = {.roles = *roles};
    if (!sample_read(m, SAMPLE_FRAMES_MAX, scratch, &sample, e)) return false;
    if (!figure_measure(m, options, &sample, &rest, notes, &f, e)) return false;
    figure_bind(&m->skeleton, &sample, &rest, &f);
    *out = f;
    return true;
}

/* --- pose --- */

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

/* `to`, or the point on the way there that is GAP from `from`. */
static Vec3 not_far(const Poser *p, Vec3 from, Vec3 to) {
    double size = vec_dist(from, to), most = GAP * p->f->height;
    return vec_lerp(from, to, size > most ? most / size : 1);
}

/* From a limb's joint to where its bone begins: sideways, in the axes of the trunk (see arms_out in figure.h). */
static Vec3 aside(const Poser *p, Role role) {
    bool leg = role >= ROLE_LEFT_THIGH, right = leg ? role >= ROLE_RIGHT_THIGH : role >= ROLE_RIGHT_CLAVICLE;
    double out = leg ? p->f->legs_out : p->f->arms_out;
    return vec_scale(mat_column(p->pose->bone[leg ? ROLE_PELVIS : ROLE_CHEST].r, 0), right ? -out : out);
}

/* Where a limb bone begins: at its joint, but within GAP of where its parent bone ends. */
static Vec3 start_of(const Poser *p, Role role, Role parent) {
    Vec3 expected = rigid_apply(p->pose->bone[parent], p->f->start[role]);
    int joint = p->f->roles.joint[role];
    return joint < 0 ? expected : not_far(p, expected, vec_add(point(p, joint), aside(p, role)));
}

/* The rotation `r` of a bone, followed by the smallest rotation that points the bone along `now`. */
static Mat3 point_along(const Figure *f, Role role, Mat3 r, Vec3 now) {
    Vec3 bone = vec_sub(f->end[role], f->start[role]);
    double length = vec_len(bone);
    if (vec_len(now) <= SHORT * length || length == 0) return r;
    Vec3 rest = mat_apply(r, vec_scale(bone, 1 / length));
    return mat_mul(mat_between(rest, vec_unit_or(now, rest)), r);
}

/* A limb bone that begins where bone `begin` ends and turns from the rotation of `parent` towards the next joint. */
static void pose_limb_bone(const Poser *p, Role role, Role begin, Role parent) {
    const Figure *f = p->f;
    Vec3 start = start_of(p, role, begin);
    Mat3 r = p->pose->bone[parent].r;
    if (f->roles.joint[role] >= 0 && f->toward[role] >= 0)
        r = point_along(f, role, r, vec_sub(point(p, f->toward[role]), point(p, f->roles.joint[role])));
    p->pose->bone[role] = placed(r, f->start[role], start);
}

/* The rotation of a bone that is rigid with its joint. */
static Mat3 bound_turn(const Poser *p, Role role) {
    return mat_mul(joint_in_world(p, p->f->roles.joint[role]).r, p->f->bind[role].r);
}

/* Half-way between pelvis and chest in turn and place. */
static void pose_spine(const Poser *p) {
    const Figure *f = p->f;
    Rigid pelvis = p->pose->bone[ROLE_PELVIS], chest = p->pose->bone[ROLE_CHEST];
    Mat3 r = mat_nlerp(pelvis.r, chest.r, 0.5);
    Vec3 middle = vec_mid(f->start[ROLE_SPINE], f->end[ROLE_SPINE]);
    Vec3 place = vec_mid(rigid_apply(pelvis, f->start[ROLE_SPINE]), rigid_apply(chest, f->end[ROLE_SPINE]));
    p->pose->bone[ROLE_SPINE] = placed(r, middle, place);
}

/* The neck points from its base, which the chest carries, to the base of the skull. */
static void pose_neck_and_head(const Poser *p) {
    const Figure *f = p->f;
    Rigid chest = p->pose->bone[ROLE_CHEST];
    Vec3 base = rigid_apply(chest, f->start[ROLE_NECK]);
    if (!f->bound[ROLE_HEAD]) {
        follow(p, ROLE_NECK, ROLE_CHEST);
        follow(p, ROLE_HEAD, ROLE_CHEST);
        return;
    }
    Rigid head = rigid_mul(joint_in_world(p, f->roles.joint[ROLE_HEAD]), f->bind[ROLE_HEAD]);
    Vec3 skull = rigid_apply(head, f->start[ROLE_HEAD]);
    Mat3 half = mat_nlerp(chest.r, head.r, 0.5);
    Rigid neck = placed(point_along(f, ROLE_NECK, half, vec_sub(skull, base)), f->start[ROLE_NECK], base);
    p->pose->bone[ROLE_NECK] = neck;
    Vec3 start = not_far(p, rigid_apply(neck, f->end[ROLE_NECK]), skull);
    p->pose->bone[ROLE_HEAD] = placed(head.r, f->start[ROLE_HEAD], start);
}

static void pose_arm(const Poser *p, Role clavicle) {
    const Figure *f = p->f;
    Role upper = clavicle + 1, forearm = clavicle + 2, hand = clavicle + 3;
    Vec3 start = rigid_apply(p->pose->bone[ROLE_CHEST], f->start[clavicle]);
    Vec3 along = vec_sub(vec_add(point(p, f->roles.joint[upper]), aside(p, upper)), start);
    Mat3 r = point_along(f, clavicle, p->pose->bone[ROLE_CHEST].r, along);
    p->pose->bone[clavicle] = placed(r, f->start[clavicle], start);
    /* The upper arm's turn is counted from the chest: the clavicle's is small and noisy. */
    pose_limb_bone(p, upper, clavicle, ROLE_CHEST);
    pose_limb_bone(p, forearm, upper, upper);
    pose_limb_bone(p, hand, forearm, forearm);
}

/* Turns a bone about its axis by `share` of the angle from `from` to `to`, both perpendicular to the axis. */
static void twist(const Figure *f, Role role, Vec3 axis, Vec3 from, Vec3 to, double share, Rigid *bone) {
    double turn = atan2(vec_dot(vec_cross(from, to), axis), vec_dot(from, to));
    Mat3 r = mat_mul(mat_axis_angle(axis, share * turn), bone->r);
    *bone = placed(r, f->start[role], rigid_apply(*bone, f->start[role]));
}

/* The part of v that is perpendicular to a unit axis. */
static Vec3 across(Vec3 v, Vec3 axis) { return vec_mad(v, axis, -vec_dot(v, axis)); }

/* The smallest rotation from the pelvis twists a thigh that is lifted to the chest. So the thigh is turned about its
   axis: first until its left is the pelvis's left, unless it points sideways itself; then until its back is where the
   shin goes, the more so the more the knee is bent. A knee that is bent little would turn the thigh to and fro in a
   stride. */
static void twist_thigh(const Poser *p, Role thigh) {
    static const double ASTRIDE = 0.5, SPLIT = 0.95; /* cosine between thigh and hip line */
    static const double STRAIGHT = 40 * PI / 180, BENT = 90 * PI / 180;
    const Figure *f = p->f;
    Role shin = thigh + 1;
    Rigid *bone = &p->pose->bone[thigh];
    Vec3 axis = vec_unit_or(mat_apply(bone->r, vec_sub(f->end[thigh], f->start[thigh])), vec(0, -1, 0));
    Vec3 hips = mat_column(p->pose->bone[ROLE_PELVIS].r, 0);
    double share = 1 - smoothstep(ASTRIDE, SPLIT, fabs(vec_dot(hips, axis)));
    twist(f, thigh, axis, mat_column(bone->r, 0), across(hips, axis), share, bone);
    if (f->roles.joint[shin] < 0 || f->toward[shin] < 0) return;
    Vec3 shank = vec_sub(point(p, f->toward[shin]), point(p, f->roles.joint[shin])), aside = across(shank, axis);
    double bend = atan2(vec_len(aside), vec_dot(shank, axis));
    twist(f, thigh, axis, vec_scale(mat_column(bone->r, 2), -1), aside, smoothstep(STRAIGHT, BENT, bend), bone);
}

/* A foot of which the file tells nothing: at a right angle to the shin, but turned towards the level as far as an ankle
   is turned without a thought. */
static Mat3 level_foot(Mat3 shin) {
    static const double EASY = 20 * PI / 180;
    double rise = asin(clamp(mat_column(shin, 2).y, -1, 1));
    return mat_mul(mat_axis_angle(mat_column(shin, 0), clamp(rise, -EASY, EASY)), shin);
}

static void pose_leg(const Poser *p, Role thigh) {
    const Figure *f = p->f;
    Role shin = thigh + 1, foot = thigh + 2, toe = thigh + 3;
    pose_limb_bone(p, thigh, ROLE_PELVIS, ROLE_PELVIS);
    twist_thigh(p, thigh);
    pose_limb_bone(p, shin, thigh, thigh);
    Mat3 r = f->bound[foot] ? bound_turn(p, foot) : level_foot(p->pose->bone[shin].r);
    p->pose->bone[foot] = placed(r, f->start[foot], start_of(p, foot, shin));
    if (f->bound[toe]) r = bound_turn(p, toe);
    p->pose->bone[toe] = placed(r, f->start[toe], rigid_apply(p->pose->bone[foot], f->end[foot]));
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

/* Each bone's turn and shift against its parent is that share of what it is in the pose. */
Pose figure_pose_towards(const Figure *f, const Pose *pose, double share) {
    Pose out;
    out.bone[ROLE_PELVIS] = pose->bone[ROLE_PELVIS];
    for (int r = ROLE_PELVIS + 1; r < ROLE_COUNT; r++) {
        Role p = role_parent((Role)r);
        Rigid by = rigid_mul(rigid_inverse(pose->bone[p]), pose->bone[r]);
        Vec3 joint = f->start[r], shift = vec_sub(rigid_apply(by, joint), joint);
        Mat3 turn = mat_nlerp(mat_identity(), by.r, share);
        Vec3 at = vec_mad(joint, shift, share);
        out.bone[r] = rigid_mul(out.bone[p], (Rigid){turn, vec_sub(at, mat_apply(turn, joint))});
    }
    return out;
}

double figure_step(const Figure *f, const Pose *a, const Pose *b) {
    double most = 0;
    for (int r = 0; r < ROLE_COUNT; r++) {
        double d = vec_dist(rigid_apply(a->bone[r], f->end[r]), rigid_apply(b->bone[r], f->end[r]));
        if (d > most) most = d;
    }
    return most / f->height;
}
