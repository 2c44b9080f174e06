/* Binding: how the canonical bones sit on the joints' frames.

   Where the zero pose is a human pose (T, A or hanging arms) it answers for the whole torso at
   once: all joint frames are parallel there. Where bones merely lie along an axis, frames of
   the motion answer: in those in which the performer stands straightest, up is up, and the
   hip and shoulder lines give left. Feet are bound where they stand flattest on the floor,
   because rest poses often let them hang. */
#include "figure/bind.h"

enum { CHOSEN_MAX = 16 };

/* ---- means of rotations ---- */

typedef struct { Quat sum; int count; } Mean;

static void mean_add(Mean *m, Mat3 r) {
    Quat q = quat_from_mat(r);
    double dot = q.w * m->sum.w + q.x * m->sum.x + q.y * m->sum.y + q.z * m->sum.z, s = dot < 0 ? -1 : 1;
    m->sum = (Quat){m->sum.w + s * q.w, m->sum.x + s * q.x, m->sum.y + s * q.y, m->sum.z + s * q.z};
    m->count++;
}

static Mat3 mean_of(const Mean *m) {
    Quat q = m->sum;
    double n = sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    if (n < 1e-9) return mat_identity();
    return mat_from_quat((Quat){q.w / n, q.x / n, q.y / n, q.z / n});
}

/* ---- shared ---- */

typedef struct {
    const Skeleton *skeleton;
    const Sample *sample;
    Figure *f;
} Binder;

/* World rotation and place of a joint in a frame of the sample: metres, Y up. */
static Mat3 turn(const Binder *b, int frame, int joint) {
    return mat_mul(b->f->upright, sample_at(b->sample, frame, joint).r);
}
static Vec3 place(const Binder *b, int frame, int joint) {
    return vec_scale(mat_apply(b->f->upright, sample_point(b->sample, frame, joint)), b->f->unit);
}
static Vec3 line(const Binder *b, int frame, Role from, Role to) {
    return vec_sub(place(b, frame, b->f->roles.joint[to]), place(b, frame, b->f->roles.joint[from]));
}

/* Left, up and forward as columns: up made exactly `up`, left as near to `left` as it can be. */
static Mat3 stand(Vec3 left, Vec3 up) {
    Vec3 x = vec_unit_or(vec_mad(left, up, -vec_dot(left, up)), vec(1, 0, 0));
    return mat_columns(x, up, vec_cross(x, up));
}

/* The same with left kept exactly. */
static Mat3 stand_across(Vec3 left, Vec3 up) {
    Vec3 x = vec_unit_or(left, vec(1, 0, 0));
    Vec3 y = vec_unit_or(vec_mad(up, x, -vec_dot(up, x)), vec(0, 1, 0));
    return mat_columns(x, y, vec_cross(x, y));
}

/* ---- the zero pose ---- */

static Vec3 zero_place(const Skeleton *s, int joint) {
    Vec3 p = {0, 0, 0};
    for (int j = joint; j >= 0; j = s->joint[j].parent) p = vec_add(p, s->joint[j].offset);
    return p;
}

static Vec3 zero_line(const Binder *b, int from, int to) {
    return vec_sub(zero_place(b->skeleton, to), zero_place(b->skeleton, from));
}

static Vec3 zero_bone(const Binder *b, Role role) {
    int next = b->f->toward[role];
    if (next < 0) return vec(0, 0, 0);
    return vec_unit_or(zero_line(b, b->f->roles.joint[role], next), vec(0, 0, 0));
}

/* The file axis within `cosine` of a direction, else the direction itself. */
static Vec3 snap(Vec3 v, double cosine) {
    for (int i = 0; i < 6; i++) {
        double sign = i < 3 ? 1 : -1;
        Vec3 axis = vec(i % 3 == 0 ? sign : 0, i % 3 == 1 ? sign : 0, i % 3 == 2 ? sign : 0);
        if (vec_dot(axis, v) > cosine) return axis;
    }
    return v;
}

static bool feet_are_human(const Binder *b) {
    for (int side = 0; side < 2; side++) {
        Role foot = side ? ROLE_RIGHT_FOOT : ROLE_LEFT_FOOT;
        if (b->f->roles.joint[foot] < 0 || b->f->toward[foot] < 0) continue;
        double along = vec_dot(zero_bone(b, foot), zero_bone(b, foot - 1));
        if (along > 0.9 || along < -0.5) return false;
    }
    return true;
}

/* Legs down, arms mirrored and not up, feet across the shins. *frame: its left, up, forward in
   file axes. */
static bool zero_is_human(const Binder *b, Mat3 *frame) {
    const int *j = b->f->roles.joint;
    Vec3 left_hip = zero_place(b->skeleton, j[ROLE_LEFT_THIGH]), right_hip = zero_place(b->skeleton, j[ROLE_RIGHT_THIGH]);
    Vec3 left_arm = zero_place(b->skeleton, j[ROLE_LEFT_UPPER_ARM]);
    Vec3 right_arm = zero_place(b->skeleton, j[ROLE_RIGHT_UPPER_ARM]);
    Vec3 torso = vec_sub(vec_mid(left_arm, right_arm), vec_mid(left_hip, right_hip));
    Vec3 hips = vec_unit_or(vec_sub(left_hip, right_hip), vec(0, 0, 0));
    Vec3 shoulders = vec_unit_or(vec_sub(left_arm, right_arm), vec(0, 0, 0));
    Vec3 up = snap(vec_unit_or(torso, vec(0, 0, 0)), 0.87);
    /* Hips of no width leave the shoulders to say what is left. */
    if (vec_len(hips) == 0) hips = shoulders;
    if (vec_dot(hips, shoulders) < 0.85 || fabs(vec_dot(hips, up)) > 0.3) return false;
    Mat3 m = stand(snap(vec_unit_or(vec_add(hips, shoulders), hips), 0.96), up);
    static const Role legs[] = {ROLE_LEFT_THIGH, ROLE_RIGHT_THIGH, ROLE_LEFT_SHIN, ROLE_RIGHT_SHIN};
    for (int i = 0; i < 4; i++)
        if (vec_dot(zero_bone(b, legs[i]), up) > -0.8) return false;
    for (Role r = ROLE_LEFT_UPPER_ARM; r <= ROLE_LEFT_FOREARM; r++) {
        Vec3 l = mat_apply(mat_transpose(m), zero_bone(b, r));
        Vec3 other = mat_apply(mat_transpose(m), zero_bone(b, r + ROLE_RIGHT_CLAVICLE - ROLE_LEFT_CLAVICLE));
        if (l.y > 0.5 || vec_dist(l, vec(-other.x, other.y, other.z)) > 0.5 || l.x < -0.3) return false;
    }
    *frame = m;
    return feet_are_human(b);
}

static const char *name_of_rest(const Binder *b, Mat3 frame) {
    double down = -vec_dot(zero_bone(b, ROLE_LEFT_UPPER_ARM), mat_column(frame, 1));
    return down < 0.42 ? "T-pose offsets" : down < 0.87 ? "A-pose offsets" : "offsets with hanging arms";
}

/* ---- upright frames ---- */

/* How straight the performer stands: 1 = torso and legs along the vertical. */
static double straightness(const Binder *b, int frame) {
    const int *j = b->f->roles.joint;
    Vec3 hips = vec_mid(place(b, frame, j[ROLE_LEFT_THIGH]), place(b, frame, j[ROLE_RIGHT_THIGH]));
    Vec3 arms = vec_mid(place(b, frame, j[ROLE_LEFT_UPPER_ARM]), place(b, frame, j[ROLE_RIGHT_UPPER_ARM]));
    double torso = vec_unit_or(vec_sub(arms, hips), vec(0, 0, 0)).y;
    double legs = vec_unit_or(line(b, frame, ROLE_LEFT_SHIN, ROLE_LEFT_THIGH), vec(0, 0, 0)).y +
                  vec_unit_or(line(b, frame, ROLE_RIGHT_SHIN, ROLE_RIGHT_THIGH), vec(0, 0, 0)).y;
    return 0.6 * torso + 0.2 * legs;
}

/* The frames with the largest scores, best first; at least one, at most a quarter of all. */
static int choose(const double *score, int n, int *out) {
    int count = 0, most = n / 4 < 1 ? 1 : n / 4 > CHOSEN_MAX ? CHOSEN_MAX : n / 4;
    for (int i = 0; i < n; i++) {
        int k = count < most ? count++ : most;
        if (k == most) {
            if (score[i] <= score[out[most - 1]]) continue;
            k--;
        }
        while (k > 0 && score[out[k - 1]] < score[i]) { out[k] = out[k - 1]; k--; }
        out[k] = i;
    }
    return count;
}

enum { FRAMES_MAX = 256 };

static int choose_upright(const Binder *b, int *out) {
    double score[FRAMES_MAX];
    int n = b->sample->count < FRAMES_MAX ? b->sample->count : FRAMES_MAX;
    for (int i = 0; i < n; i++) score[i] = straightness(b, i);
    return choose(score, n, out);
}

/* Bone-axis rigs put the joints' own axes along and across the body; an estimate of left
   that comes close to one of them means it. */
static Mat3 snap_left(Mat3 bind) {
    Vec3 left = snap(mat_column(bind, 0), 0.95), up = mat_column(bind, 1);
    return stand_across(left, up);
}

/* bind of a joint from frames in which up is up and left is the line between two joints. */
static Mat3 bind_from_line(const Binder *b, const int *frames, int n, int joint, Role right, Role left) {
    Mean mean = {{0, 0, 0, 0}, 0};
    for (int i = 0; i < n; i++) {
        Mat3 body = stand_across(line(b, frames[i], right, left), vec(0, 1, 0));
        mean_add(&mean, mat_mul(mat_transpose(turn(b, frames[i], joint)), body));
    }
    return snap_left(mean_of(&mean));
}

/* bind of a joint that on the mean over the frames is turned like bone `like`. */
static Mat3 bind_like(const Binder *b, const int *frames, int n, int joint, Role like) {
    Mean mean = {{0, 0, 0, 0}, 0};
    for (int i = 0; i < n; i++) {
        Mat3 body = mat_mul(turn(b, frames[i], b->f->roles.joint[like]), b->f->bind[like].r);
        body = stand(mat_column(body, 0), vec(0, 1, 0));
        mean_add(&mean, mat_mul(mat_transpose(turn(b, frames[i], joint)), body));
    }
    return snap_left(mean_of(&mean));
}

/* ---- feet ---- */

/* Frames in which ankle and toes are lowest: the foot stands flat. */
static int choose_flat(const Binder *b, int ankle, int tip, int *out) {
    double score[FRAMES_MAX];
    int n = b->sample->count < FRAMES_MAX ? b->sample->count : FRAMES_MAX;
    for (int i = 0; i < n; i++) score[i] = -place(b, i, ankle).y - place(b, i, tip).y;
    return choose(score, n, out);
}

/* False where the frames do not tell (no tip, foot upright, or frames that disagree). */
static bool foot_from_frames(const Binder *b, Role foot, Mat3 *bind) {
    int joint = b->f->roles.joint[foot], tip = b->f->toward[foot], frames[CHOSEN_MAX];
    if (tip < 0) return false;
    int n = choose_flat(b, joint, tip, frames);
    Mean mean = {{0, 0, 0, 0}, 0};
    Vec3 ups = {0, 0, 0};
    for (int i = 0; i < n; i++) {
        Vec3 along = vec_sub(place(b, frames[i], tip), place(b, frames[i], joint));
        Vec3 flat = vec(along.x, 0, along.z);
        if (vec_len(flat) < 0.5 * vec_len(along)) return false;
        Mat3 body = stand(vec_cross(vec(0, 1, 0), flat), vec(0, 1, 0));
        Mat3 inverse = mat_transpose(turn(b, frames[i], joint));
        mean_add(&mean, mat_mul(inverse, body));
        ups = vec_add(ups, mat_column(inverse, 1));
    }
    *bind = mean_of(&mean);
    return n >= 3 && vec_len(ups) / n > 0.97;
}

/* From the zero pose: flat, turned to where the toes point. */
static Mat3 foot_from_rest(const Binder *b, Role foot, Mat3 rest) {
    Vec3 up = mat_column(rest, 1), along = zero_bone(b, foot);
    along = vec_mad(along, up, -vec_dot(along, up));
    if (vec_len(along) < 0.5 || vec_dot(along, mat_column(rest, 2)) < 0) return rest;
    return stand(vec_cross(up, along), up);
}

static void bind_foot(const Binder *b, Role foot, const Mat3 *rest, const int *upright, int n) {
    Figure *f = b->f;
    int joint = f->roles.joint[foot];
    if (joint < 0) return;
    Mat3 from_frames, *bind = &f->bind[foot].r;
    bool told = foot_from_frames(b, foot, &from_frames);
    if (rest) {
        *bind = foot_from_rest(b, foot, *rest);
        if (told && vec_dot(mat_column(*bind, 1), mat_column(from_frames, 1)) > 0.85) *bind = from_frames;
    } else if (told) {
        *bind = from_frames;
    } else {
        *bind = bind_like(b, upright, n, joint, ROLE_PELVIS);
    }
    f->bound[foot] = true;

    int toe = f->roles.joint[foot + 1], flat[CHOSEN_MAX];
    if (toe < 0 || f->toward[foot] < 0) return;
    Mean mean = {{0, 0, 0, 0}, 0};
    int nflat = choose_flat(b, joint, f->toward[foot], flat);
    for (int i = 0; i < nflat; i++)
        mean_add(&mean, mat_mul(mat_transpose(turn(b, flat[i], toe)), mat_mul(turn(b, flat[i], joint), *bind)));
    f->bind[foot + 1].r = mean_of(&mean);
    f->bound[foot + 1] = true;
}

/* ---- */

/* Puts the canonical point half-way between the starts of two bones where the two joints are
   on the mean, in the joint's frame. */
static void anchor(const Binder *b, Role role, Role left, Role right) {
    Figure *f = b->f;
    int joint = f->roles.joint[role];
    Vec3 sum = {0, 0, 0};
    for (int i = 0; i < b->sample->count; i++) {
        Vec3 p = vec_mid(place(b, i, f->roles.joint[left]), place(b, i, f->roles.joint[right]));
        Vec3 d = vec_sub(p, place(b, i, joint));
        sum = vec_add(sum, mat_apply(mat_transpose(turn(b, i, joint)), d));
    }
    Vec3 canonical = vec_mid(f->start[left], f->start[right]);
    f->bind[role].t = vec_sub(vec_scale(sum, 1.0 / b->sample->count), mat_apply(f->bind[role].r, canonical));
    f->bound[role] = true;
}

void figure_bind(const Skeleton *skeleton, const Sample *sample, Figure *f) {
    Binder b = {skeleton, sample, f};
    const int *j = f->roles.joint;
    Mat3 zero;
    bool human = zero_is_human(&b, &zero);
    int upright[CHOSEN_MAX], n = choose_upright(&b, upright);
    for (int r = 0; r < ROLE_COUNT; r++) f->bind[r] = rigid_identity(), f->bound[r] = false;
    if (human) {
        f->bind[ROLE_PELVIS].r = f->bind[ROLE_CHEST].r = f->bind[ROLE_HEAD].r = zero;
        f->rest = name_of_rest(&b, zero);
    } else {
        f->bind[ROLE_PELVIS].r = bind_from_line(&b, upright, n, j[ROLE_PELVIS], ROLE_RIGHT_THIGH, ROLE_LEFT_THIGH);
        f->bind[ROLE_CHEST].r = bind_from_line(&b, upright, n, j[ROLE_CHEST], ROLE_RIGHT_UPPER_ARM, ROLE_LEFT_UPPER_ARM);
        if (j[ROLE_HEAD] >= 0) f->bind[ROLE_HEAD].r = bind_like(&b, upright, n, j[ROLE_HEAD], ROLE_CHEST);
        f->rest = "upright frames";
    }
    anchor(&b, ROLE_PELVIS, ROLE_LEFT_THIGH, ROLE_RIGHT_THIGH);
    anchor(&b, ROLE_CHEST, ROLE_LEFT_UPPER_ARM, ROLE_RIGHT_UPPER_ARM);
    f->bound[ROLE_HEAD] = j[ROLE_HEAD] >= 0;
    bind_foot(&b, ROLE_LEFT_FOOT, human ? &zero : NULL, upright, n);
    bind_foot(&b, ROLE_RIGHT_FOOT, human ? &zero : NULL, upright, n);
}
