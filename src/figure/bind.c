/* Binding: how pelvis, chest and head sit on the frames of their joints (feet: bind_foot.c).

   A bind is the rigid transform from the canonical stance to the frame of a joint. The columns of its rotation are the
   bone's left, up and forward in the joint's own axes. Every rig chooses these axes in its own way, so they must be
   found.

   If the zero pose is a human pose (T, A or hanging arms), or if the take begins with a T-pose, it tells the whole
   torso at once (rest.c). If the zero pose only lays the bones along an axis, frames of the motion tell: in those in
   which the performer stands straightest, up is the vertical, and the lines through hips and shoulders give left. A
   performer who crouches or lies for the whole take never stands straight; then the bones of the trunk themselves tell
   what is up. */
#include "figure/bind.h"

#include "figure/bind_foot.h"
#include "figure/binder.h"

/* --- axes of a body --- */

/* Left, up and forward as columns. One function keeps up exactly and makes left perpendicular to it, the other keeps
   left. */
static Mat3 axes_keeping_up(Vec3 left, Vec3 up) {
    Vec3 x = vec_unit_or(vec_mad(left, up, -vec_dot(left, up)), vec(1, 0, 0));
    return mat_columns(x, up, vec_cross(x, up));
}

static Mat3 axes_keeping_left(Vec3 left, Vec3 up) {
    Vec3 x = vec_unit_or(left, vec(1, 0, 0));
    Vec3 y = vec_unit_or(vec_mad(up, x, -vec_dot(up, x)), vec(0, 1, 0));
    return mat_columns(x, y, vec_cross(x, y));
}

/* Rigs often lay a joint's own axes along and across the body. An estimate of left whose cosine to one of them is
   above `cosine` is taken to mean that axis. */
static Mat3 snap_left(Mat3 bind, double cosine) {
    return axes_keeping_left(rest_snap(mat_column(bind, 0), cosine), mat_column(bind, 1));
}

/* The bind, turned about its left so that `line` leans forwards or backwards from its up by `most` radians at most.
   line: a direction in the joint's frame that is upright in a human who stands. */
static Mat3 lean_within(Mat3 bind, Vec3 line, double most) {
    Vec3 v = mat_apply(mat_transpose(bind), line);
    double lean = atan2(v.z, v.y);
    return mat_mul(bind, mat_axis_angle(vec(1, 0, 0), lean - clamp(lean, -most, most)));
}

/* --- upright frames --- */

/* From the joint of one role to that of another. */
static Vec3 line(const Binder *b, int frame, Role from, Role to) {
    const int *j = b->f->roles.joint;
    return vec_sub(binder_position(b, frame, j[to]), binder_position(b, frame, j[from]));
}

/* Unit vector from the middle of the hips to the middle of the shoulders. */
static Vec3 back_line(const Binder *b, int frame) {
    const int *j = b->f->roles.joint;
    Vec3 hips = vec_mid(binder_position(b, frame, j[ROLE_LEFT_THIGH]), binder_position(b, frame, j[ROLE_RIGHT_THIGH]));
    Vec3 arms = vec_mid(binder_position(b, frame, j[ROLE_LEFT_UPPER_ARM]),
                        binder_position(b, frame, j[ROLE_RIGHT_UPPER_ARM]));
    return vec_unit_or(vec_sub(arms, hips), vec(0, 1, 0));
}

/* How much the vertical tells of a bone whose estimated up is `up`: 1 of somebody who stands, 0 of somebody who lies.
   Cosines to the vertical. */
static double upright_share(Vec3 up) {
    static const double LIES = 0.3, STANDS = 0.8;
    return smoothstep(LIES, STANDS, up.y);
}

/* How straight the performer stands: 1 = torso and thighs along the vertical. */
static double straightness(const Binder *b, int frame) {
    static const double TORSO = 0.6, THIGH = 0.2; /* weights; there are two thighs */
    double thighs = vec_unit_or(line(b, frame, ROLE_LEFT_SHIN, ROLE_LEFT_THIGH), vec(0, 0, 0)).y +
                    vec_unit_or(line(b, frame, ROLE_RIGHT_SHIN, ROLE_RIGHT_THIGH), vec(0, 0, 0)).y;
    return TORSO * back_line(b, frame).y + THIGH * thighs;
}

/* Some frames of the sample. */
typedef struct { int n, frame[SAMPLE_FRAMES_MAX]; } Frames;

/* Those in which the performer stands straightest. */
static Frames find_upright(const Binder *b) {
    double score[SAMPLE_FRAMES_MAX];
    Frames upright;
    for (int i = 0; i < b->sample->count; i++) score[i] = straightness(b, i);
    upright.n = sample_best(b->sample, score, upright.frame);
    return upright;
}

/* From 0 to 1: how far these frames can be trusted to tell what is up for the pelvis. Nothing where nobody stands
   straight in them. */
static double trust_in_upright(const Binder *b, const Frames *upright) {
    static const double BENT = 0.85, STRAIGHT = 0.97; /* mean straightness */
    double straight = 0;
    for (int i = 0; i < upright->n; i++) straight += straightness(b, upright->frame[i]) / upright->n;
    return smoothstep(BENT, STRAIGHT, straight);
}

/* The bind of a role's joint by frames: left is the line from joint `right` to joint `left`, up is the line of the
   back. `vertical` is the share of the vertical in up where the performer stands: a chest leans as the back leans, a
   pelvis less. */
static Mat3 bind_from_lines(const Binder *b, const Frames *upright, Role role, Role right, Role left,
                            double vertical) {
    static const double NEAR_AXIS = 0.995;
    int joint = b->f->roles.joint[role];
    Quat sum = {0, 0, 0, 0};
    for (int i = 0; i < upright->n; i++) {
        int frame = upright->frame[i];
        Vec3 back = back_line(b, frame), up = vec_lerp(back, vec(0, 1, 0), vertical * upright_share(back));
        Mat3 body = axes_keeping_left(line(b, frame, right, left), up);
        binder_mean_add(&sum, mat_mul(mat_transpose(binder_rotation(b, frame, joint)), body));
    }
    return snap_left(binder_mean(sum), NEAR_AXIS);
}

/* The bind of a joint that on the mean over some frames faces where the bone of role `like` does and stands as
   upright. */
static Mat3 bind_like(const Binder *b, const Frames *frames, int joint, Role like) {
    static const double NEAR_AXIS = 0.97;
    Quat sum = {0, 0, 0, 0};
    for (int i = 0; i < frames->n; i++) {
        Mat3 body = mat_mul(binder_rotation(b, frames->frame[i], b->f->roles.joint[like]), b->f->bind[like].r);
        Vec3 up = vec_lerp(mat_column(body, 1), vec(0, 1, 0), upright_share(mat_column(body, 1)));
        body = axes_keeping_up(mat_column(body, 0), vec_unit_or(up, mat_column(body, 1)));
        binder_mean_add(&sum, mat_mul(mat_transpose(binder_rotation(b, frames->frame[i], joint)), body));
    }
    return snap_left(binder_mean(sum), NEAR_AXIS);
}

/* --- pelvis and chest --- */

/* From a human zero pose. A pelvis that leans by more than PELVIS_LEAN (radians) in all upright frames was not level
   in the zero pose. level: the bind by these frames, trust: how far they can be trusted. */
static Mat3 pelvis_from_rest(Mat3 rest, Mat3 level, double trust) {
    static const double PELVIS_LEAN = 0.17;
    return lean_within(rest, mat_column(level, 1), PELVIS_LEAN + (1 - trust) * PI);
}

/* From the frames, corrected by the line to the first joint of the spine that is FAR from the pelvis (statures), or to
   the chest: in a human who stands it is upright, whatever the rig. Nearer joints lie at the sacrum, up to 30 degrees
   behind; farther ones move when the back bends. The less the frames can be trusted, the less may the bind lean from
   that line. */
static Mat3 pelvis_from_bones(const Binder *b, Mat3 level, double trust) {
    static const double FAR = 0.09;
    static const double LEAN_TRUSTED = 0.44, LEAN_UNTRUSTED = 0.09; /* radians */
    const Figure *f = b->f;
    int pelvis = f->roles.joint[ROLE_PELVIS], chest = f->roles.joint[ROLE_CHEST];
    Vec3 spine = {0, 0, 0};
    for (int j = chest; j > pelvis; j = b->skeleton->joint[j].parent) {
        Vec3 to_joint = binder_offset(b, pelvis, j);
        if (vec_len(to_joint) > (j == chest ? BINDER_SHORT : FAR) * f->height) spine = to_joint;
    }
    double most = LEAN_UNTRUSTED + trust * (LEAN_TRUSTED - LEAN_UNTRUSTED);
    return vec_len(spine) > 0 ? lean_within(level, spine, most) : level;
}

/* The line from the chest to the neck is upright in a human who stands. */
static Mat3 chest_from_bones(const Binder *b, Mat3 bind) {
    const int *j = b->f->roles.joint;
    if (j[ROLE_NECK] < 0 || j[ROLE_NECK] == j[ROLE_CHEST]) return bind;
    Vec3 neck = binder_offset(b, j[ROLE_CHEST], j[ROLE_NECK]);
    return vec_len(neck) > BINDER_SHORT * b->f->height ? lean_within(bind, neck, 0) : bind;
}

/* --- head --- */

/* From a human zero pose. People look ahead or down, so a head that leans back by more than HEAD_BACK (radians) in
   the upright frames is bound wrongly: what is beyond is taken off. */
static Mat3 head_from_rest(const Binder *b, const Frames *upright, Mat3 rest) {
    static const double HEAD_BACK = 0.17;
    Mat3 level = bind_like(b, upright, b->f->roles.joint[ROLE_HEAD], ROLE_CHEST);
    Mat3 d = mat_mul(mat_transpose(rest), level);
    double back = atan2(d.r[2].y, d.r[1].y);
    if (back <= HEAD_BACK) return rest;
    return mat_mul(rest, mat_axis_angle(vec(1, 0, 0), back - HEAD_BACK));
}

/* Do neck and head lie on one line in the zero pose, as where it lays bones along an axis? */
static bool neck_is_stretched(const Binder *b) {
    static const double ONE_LINE = 0.9; /* cosine */
    const int *j = b->f->roles.joint;
    int base = j[ROLE_NECK] >= 0 ? j[ROLE_NECK] : j[ROLE_CHEST], below = b->skeleton->joint[base].parent;
    if (below < 0) return false;
    const Rigid *zero = b->sample->zero;
    Vec3 up = vec_unit_or(vec_sub(zero[base].t, zero[below].t), vec(0, 0, 0));
    return vec_dot(up, vec_unit_or(vec_sub(zero[j[ROLE_HEAD]].t, zero[base].t), up)) > ONE_LINE;
}

/* On the mean over all frames people look ahead with a level head. But some look down or aside for a whole take. If the
   zero pose stretches the neck, the axes of head and chest are parallel in it, which is better evidence: then of the
   mean over the frames only the nod is used, up to NOD radians, unless the two differ widely. */
static Mat3 head_from_chest(const Binder *b) {
    static const double WIDELY = 0.5, NOD = 0.3; /* cosine between left or up by one and by the other; radians */
    Frames all = {.n = b->sample->count};
    for (int i = 0; i < all.n; i++) all.frame[i] = i;
    Mat3 level = bind_like(b, &all, b->f->roles.joint[ROLE_HEAD], ROLE_CHEST), chest = b->f->bind[ROLE_CHEST].r;
    if (!neck_is_stretched(b)) return level;
    for (int axis = 0; axis < 2; axis++)
        if (vec_dot(mat_column(chest, axis), mat_column(level, axis)) < WIDELY) return level;
    return lean_within(lean_within(chest, mat_column(level, 1), 0), mat_column(chest, 1), NOD);
}

/* The top of a head lies about above its joint: its only child, or the highest of several. A child aside of the head's
   middle is an eye or hair; one that is farther than LONG statures is a thing that the head carries. */
static Mat3 head_from_bones(const Binder *b, Mat3 bind) {
    static const double LONG = 0.2, UP = 0.6, ASIDE = 0.2; /* statures; cosines to the head's up and left */
    static const double LEAN = 0.2;                        /* radians */
    const Joint *joint = b->skeleton->joint;
    int head = b->f->roles.joint[ROLE_HEAD], children = 0;
    double highest = UP;
    Vec3 top = {0, 0, 0};
    for (int j = head + 1; j < b->skeleton->njoints; j++) children += joint[j].parent == head;
    for (int j = head + 1; j < b->skeleton->njoints; j++) {
        if (joint[j].parent != head) continue;
        Vec3 at = binder_offset(b, head, j);
        double size = vec_len(at);
        if (size < BINDER_SHORT * b->f->height || size > LONG * b->f->height) continue;
        double up = vec_dot(at, mat_column(bind, 1)) / size, aside = vec_dot(at, mat_column(bind, 0)) / size;
        if (up > highest && (children == 1 || fabs(aside) < ASIDE)) highest = up, top = at;
    }
    return vec_len(top) > 0 ? lean_within(bind, top, LEAN) : bind;
}

/* --- positions --- */

/* Sets where the bone is, after how it is turned: the point half-way between the starts of two bones in the canonical
   stance goes to the mean middle of their joints. */
static void anchor_torso(const Binder *b, Role role, Role left, Role right) {
    Figure *f = b->f;
    int joint = f->roles.joint[role];
    Vec3 to_left = binder_offset(b, joint, f->roles.joint[left]);
    Vec3 middle = vec_mid(to_left, binder_offset(b, joint, f->roles.joint[right]));
    Vec3 canonical = vec_mid(f->start[left], f->start[right]);
    f->bind[role].t = vec_sub(middle, mat_apply(f->bind[role].r, canonical));
    f->bound[role] = true;
}

/* The head joint of one rig is the base of the skull, of another the middle of the neck. So only its movement counts:
   on the mean over the upright frames the canonical base of the skull is where the chest carries it. */
static void anchor_head(const Binder *b, const Frames *upright) {
    Figure *f = b->f;
    int head = f->roles.joint[ROLE_HEAD], chest = f->roles.joint[ROLE_CHEST];
    Vec3 sum = {0, 0, 0}, base = f->start[ROLE_HEAD];
    if (head < 0) return;
    for (int i = 0; i < upright->n; i++) {
        int frame = upright->frame[i];
        Rigid carrier = {binder_rotation(b, frame, chest), binder_position(b, frame, chest)};
        Rigid carried = rigid_mul(carrier, f->bind[ROLE_CHEST]);
        Rigid joint = {binder_rotation(b, frame, head), binder_position(b, frame, head)};
        sum = vec_add(sum, rigid_unapply(joint, rigid_apply(carried, base)));
    }
    f->bind[ROLE_HEAD].t = vec_sub(vec_scale(sum, 1.0 / upright->n), mat_apply(f->bind[ROLE_HEAD].r, base));
    f->bound[ROLE_HEAD] = true;
}

/* --- all of it --- */

static void turn_torso(const Binder *b, const Rest *rest, const Frames *upright) {
    static const double PELVIS_VERTICAL = 0.5, CHEST_VERTICAL = 0;
    const int *j = b->f->roles.joint;
    Rigid *bind = b->f->bind;
    Mat3 level = bind_from_lines(b, upright, ROLE_PELVIS, ROLE_RIGHT_THIGH, ROLE_LEFT_THIGH, PELVIS_VERTICAL);
    double trust = trust_in_upright(b, upright);
    if (rest->human) {
        bind[ROLE_PELVIS].r = pelvis_from_rest(rest_bind(rest, j[ROLE_PELVIS]), level, trust);
        bind[ROLE_CHEST].r = rest_bind(rest, j[ROLE_CHEST]);
        if (j[ROLE_HEAD] >= 0) bind[ROLE_HEAD].r = head_from_rest(b, upright, rest_bind(rest, j[ROLE_HEAD]));
        return;
    }
    Mat3 chest = bind_from_lines(b, upright, ROLE_CHEST, ROLE_RIGHT_UPPER_ARM, ROLE_LEFT_UPPER_ARM, CHEST_VERTICAL);
    bind[ROLE_PELVIS].r = pelvis_from_bones(b, level, trust);
    bind[ROLE_CHEST].r = chest_from_bones(b, chest);
    if (j[ROLE_HEAD] >= 0) bind[ROLE_HEAD].r = head_from_bones(b, head_from_chest(b));
}

/* A foot without an end stands as upright as the pelvis. */
static void bind_foot_and_toe(const Binder *b, const Rest *rest, const Frames *upright, Role foot) {
    int joint = b->f->roles.joint[foot];
    Mat3 *bind = &b->f->bind[foot].r;
    if (joint < 0) return;
    if (!bind_foot(b, foot, rest, bind)) *bind = bind_like(b, upright, joint, ROLE_PELVIS);
    b->f->bound[foot] = true;
    bind_toe(b, foot, rest);
}

void figure_bind(const Skeleton *skeleton, const Sample *sample, const Rest *rest, Figure *f) {
    Binder b = {skeleton, sample, f};
    Frames upright = find_upright(&b);
    for (int r = 0; r < ROLE_COUNT; r++) f->bind[r] = rigid_identity(), f->bound[r] = false;
    turn_torso(&b, rest, &upright);
    anchor_torso(&b, ROLE_PELVIS, ROLE_LEFT_THIGH, ROLE_RIGHT_THIGH);
    anchor_torso(&b, ROLE_CHEST, ROLE_LEFT_UPPER_ARM, ROLE_RIGHT_UPPER_ARM);
    anchor_head(&b, &upright);
    bind_foot_and_toe(&b, rest, &upright, ROLE_LEFT_FOOT);
    bind_foot_and_toe(&b, rest, &upright, ROLE_RIGHT_FOOT);
}
