/* Binding: how the canonical bones sit on the joints' frames.

   Where the zero pose is a human pose (T, A or hanging arms), or a T-pose stands in front of the
   take, it answers for the whole torso at once (rest.c). Where bones merely lie along an axis,
   frames of the motion answer: in those in which the performer stands straightest, up is up, and
   the hip and shoulder lines give left; feet are flat where they stand. Who crouches or lies for
   the whole take never stands straight: there the skeleton itself tells what is up. */
#include "figure/bind.h"

#include "figure/measure.h"

/* --- means of rotations --- */

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

/* --- shared --- */

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

/* Where another joint is, seen from the frame of `joint`: metres, mean over the sample. */
static Vec3 seen_from(const Binder *b, int joint, int other) {
    Vec3 sum = {0, 0, 0};
    for (int i = 0; i < b->sample->count; i++) {
        Vec3 d = vec_sub(place(b, i, other), place(b, i, joint));
        sum = vec_add(sum, mat_apply(mat_transpose(turn(b, i, joint)), d));
    }
    return vec_scale(sum, 1.0 / b->sample->count);
}

/* --- upright frames --- */

/* From hips to shoulders, unit. */
static Vec3 back_line(const Binder *b, int frame) {
    const int *j = b->f->roles.joint;
    Vec3 hips = vec_mid(place(b, frame, j[ROLE_LEFT_THIGH]), place(b, frame, j[ROLE_RIGHT_THIGH]));
    Vec3 arms = vec_mid(place(b, frame, j[ROLE_LEFT_UPPER_ARM]), place(b, frame, j[ROLE_RIGHT_UPPER_ARM]));
    return vec_unit_or(vec_sub(arms, hips), vec(0, 1, 0));
}

/* How much the vertical has to say about a bone with that up: all of those who stand. */
static double upright_share(Vec3 up) { return smoothstep(0.3, 0.8, up.y); }

/* How straight the performer stands: 1 = torso and legs along the vertical. */
static double straightness(const Binder *b, int frame) {
    double legs = vec_unit_or(line(b, frame, ROLE_LEFT_SHIN, ROLE_LEFT_THIGH), vec(0, 0, 0)).y +
                  vec_unit_or(line(b, frame, ROLE_RIGHT_SHIN, ROLE_RIGHT_THIGH), vec(0, 0, 0)).y;
    return 0.6 * back_line(b, frame).y + 0.2 * legs;
}

static int choose_upright(const Binder *b, int *out) {
    double score[SAMPLE_FRAMES_MAX];
    for (int i = 0; i < b->sample->count; i++) score[i] = straightness(b, i);
    return sample_best(b->sample, score, out);
}

/* Bone-axis rigs put the joints' own axes along and across the body; an estimate of left
   that comes close to one of them means it. cosine: how close, less than the estimate may be off. */
static Mat3 snap_left(Mat3 bind, double cosine) {
    return stand_across(rest_snap(mat_column(bind, 0), cosine), mat_column(bind, 1));
}

/* bind of a joint from frames in which left is the line between two joints and up is the line
   of the back, with a share of the vertical: a chest leans as the back leans, a pelvis less.
   Of those who lie, the vertical says nothing. */
static Mat3 bind_from_line(const Binder *b, const int *frames, int n, Role role, Role right, Role left,
                           double vertical) {
    int joint = b->f->roles.joint[role];
    Mean mean = {{0, 0, 0, 0}, 0};
    for (int i = 0; i < n; i++) {
        Vec3 back = back_line(b, frames[i]), up = vec_lerp(back, vec(0, 1, 0), vertical * upright_share(back));
        Mat3 body = stand_across(line(b, frames[i], right, left), up);
        mean_add(&mean, mat_mul(mat_transpose(turn(b, frames[i], joint)), body));
    }
    return snap_left(mean_of(&mean), 0.995);
}

/* bind of a joint that on the mean over the frames stands upright (where bone `like` does, about)
   and faces where that bone does. */
static Mat3 bind_like(const Binder *b, const int *frames, int n, int joint, Role like) {
    Mean mean = {{0, 0, 0, 0}, 0};
    for (int i = 0; i < n; i++) {
        Mat3 body = mat_mul(turn(b, frames[i], b->f->roles.joint[like]), b->f->bind[like].r);
        Vec3 up = vec_lerp(mat_column(body, 1), vec(0, 1, 0), upright_share(mat_column(body, 1)));
        body = stand(mat_column(body, 0), vec_unit_or(up, mat_column(body, 1)));
        mean_add(&mean, mat_mul(mat_transpose(turn(b, frames[i], joint)), body));
    }
    return snap_left(mean_of(&mean), 0.97);
}

/* Heads that lean back in every upright frame are bound wrongly: people look ahead, or down.
   More than this (radians) is taken off. */
static const double HEAD_BACK = 0.17;

static Mat3 head_from_rest(const Binder *b, const int *frames, int n, Mat3 rest) {
    Mat3 level = bind_like(b, frames, n, b->f->roles.joint[ROLE_HEAD], ROLE_CHEST);
    Mat3 d = mat_mul(mat_transpose(rest), level);
    double back = atan2(d.r[2].y, d.r[1].y);
    if (back <= HEAD_BACK) return rest;
    return mat_mul(rest, mat_axis_angle(vec(1, 0, 0), back - HEAD_BACK));
}

/* --- what the skeleton tells --- */

/* The bind, turned about left so that `line`, which is upright in those who stand, leans by no more than `most`
   (radians) against its up. line: in the joint's frame. */
static Mat3 lean_within(Mat3 bind, Vec3 line, double most) {
    Vec3 v = mat_apply(mat_transpose(bind), line);
    double lean = atan2(v.z, v.y);
    return mat_mul(bind, mat_axis_angle(vec(1, 0, 0), lean - clamp(lean, -most, most)));
}

/* The spine over the pelvis and the line from the chest to the neck are upright in those who stand, whatever the rig;
   bones shorter than this (in statures) say nothing. */
static const double SAYS = 0.03;

/* How much the frames know of a pelvis: all where somebody stands straight in them, else nothing. */
static double known_pelvis(const Binder *b, const int *upright, int n) {
    double straight = 0;
    for (int i = 0; i < n; i++) straight += straightness(b, upright[i]) / n;
    return smoothstep(0.85, 0.97, straight);
}

/* A pelvis that leans by more than this (radians) in all upright frames was not level in the zero pose. */
static const double PELVIS_LEAN = 0.17;

static Mat3 pelvis_from_rest(Mat3 rest, Mat3 level, double known) {
    return lean_within(rest, mat_column(level, 1), PELVIS_LEAN + (1 - known) * PI);
}

/* The line to the first joint of the spine that is FAR from the pelvis (statures), or to the chest: nearer ones lie at
   the sacrum, up to 30 degrees behind, farther ones move when the back bends. */
static Mat3 pelvis_from_bones(const Binder *b, Mat3 level, double known) {
    static const double FAR = 0.09;
    static const double STANDS = 0.44, NEVER_STANDS = 0.09; /* how far the frames may differ from the bones */
    const Figure *f = b->f;
    int pelvis = f->roles.joint[ROLE_PELVIS], chest = f->roles.joint[ROLE_CHEST];
    Vec3 spine = {0, 0, 0};
    for (int j = chest; j > pelvis; j = b->skeleton->joint[j].parent) {
        Vec3 line = seen_from(b, pelvis, j);
        if (vec_len(line) > (j == chest ? SAYS : FAR) * f->height) spine = line;
    }
    return vec_len(spine) > 0 ? lean_within(level, spine, NEVER_STANDS + known * (STANDS - NEVER_STANDS)) : level;
}

static Mat3 chest_from_bones(const Binder *b, Mat3 bind) {
    const int *j = b->f->roles.joint;
    if (j[ROLE_NECK] < 0 || j[ROLE_NECK] == j[ROLE_CHEST]) return bind;
    Vec3 neck = seen_from(b, j[ROLE_CHEST], j[ROLE_NECK]);
    return vec_len(neck) > SAYS * b->f->height ? lean_within(bind, neck, 0) : bind;
}

/* Do neck and head continue each other in the zero pose, as where bones lie along an axis? */
static bool neck_is_stretched(const Binder *b) {
    const int *j = b->f->roles.joint;
    int base = j[ROLE_NECK] >= 0 ? j[ROLE_NECK] : j[ROLE_CHEST], below = b->skeleton->joint[base].parent;
    if (below < 0) return false;
    const Rigid *zero = b->sample->zero;
    Vec3 up = vec_unit_or(vec_sub(zero[base].t, zero[below].t), vec(0, 0, 0));
    return vec_dot(up, vec_unit_or(vec_sub(zero[j[ROLE_HEAD]].t, zero[base].t), up)) > 0.9;
}

/* On the mean over all frames people look ahead and their heads are level; but some look down or aside for a whole
   take. Where the zero pose stretches the trunk, the frames of head and chest are parallel. So of what the frames
   say of a head that is near to that only the nod counts, and not too much of it. */
static Mat3 head_from_chest(const Binder *b) {
    static const double NEAR = 0.5, NODS = 0.3; /* cosine; radians */
    int all[SAMPLE_FRAMES_MAX];
    for (int i = 0; i < b->sample->count; i++) all[i] = i;
    Mat3 level = bind_like(b, all, b->sample->count, b->f->roles.joint[ROLE_HEAD], ROLE_CHEST);
    Mat3 chest = b->f->bind[ROLE_CHEST].r;
    if (!neck_is_stretched(b) || vec_dot(mat_column(chest, 0), mat_column(level, 0)) < NEAR) return level;
    return lean_within(lean_within(chest, mat_column(level, 1), 0), mat_column(chest, 1), NODS);
}

/* The head's only child, or the highest of several that is no eye and no hair, is about over it. */
static Mat3 head_from_bones(const Binder *b, Mat3 bind) {
    static const double LEAN = 0.2;
    const Joint *joint = b->skeleton->joint;
    int head = b->f->roles.joint[ROLE_HEAD], children = 0;
    double highest = 0.6;
    Vec3 top = {0, 0, 0};
    for (int j = head + 1; j < b->skeleton->njoints; j++) children += joint[j].parent == head;
    for (int j = head + 1; j < b->skeleton->njoints; j++) {
        if (joint[j].parent != head) continue;
        Vec3 at = seen_from(b, head, j);
        double size = vec_len(at);
        if (size < SAYS * b->f->height || size > 0.2 * b->f->height) continue;
        double up = vec_dot(at, mat_column(bind, 1)) / size, aside = vec_dot(at, mat_column(bind, 0)) / size;
        if (up > highest && (children == 1 || fabs(aside) < 0.2)) highest = up, top = at;
    }
    return vec_len(top) > 0 ? lean_within(bind, top, LEAN) : bind;
}

/* --- feet --- */

/* Flat, pointing where `along` does, which falls by `slope` radians; the sole's up as near to `up` as can be. */
static Mat3 sole(Vec3 along, Vec3 up, double slope) {
    Vec3 left = vec_unit_or(vec_cross(up, along), vec(1, 0, 0));
    Vec3 ahead = mat_apply(mat_axis_angle(left, -slope), along);
    return mat_columns(left, vec_cross(ahead, left), ahead);
}

/* Along the shin upwards, on the mean: ankles bend forwards and back, but to the side only little. A foot that lies
   along the shin, as of one who kneels, says next to nothing of its sides. along: where the foot points. */
static Vec3 up_the_shin(const Binder *b, Role foot, Vec3 along) {
    int ankle = b->f->roles.joint[foot], knee = b->f->roles.joint[foot - 1];
    Vec3 sum = {0, 0, 0};
    for (int i = 0; i < b->sample->count; i++) {
        Vec3 shin = vec_sub(place(b, i, knee), place(b, i, ankle));
        shin = vec_unit_or(mat_apply(mat_transpose(turn(b, i, ankle)), shin), vec(0, 1, 0));
        Vec3 aside = vec_cross(shin, along);
        sum = vec_mad(sum, shin, vec_dot(aside, aside));
    }
    return vec_unit_or(sum, vec(0, 1, 0));
}

/* What lies ahead of the ankle and does not move against it: the toe joint, or the tip of a foot without one. -1: there
   is nothing. */
static int ball(const Binder *b, Role foot) {
    int ankle = b->f->roles.joint[foot], toe = b->f->roles.joint[foot + 1];
    bool ahead = toe >= 0 && vec_len(seen_from(b, ankle, toe)) > SAYS * b->f->height;
    return ahead ? toe : b->f->toward[foot];
}

static int standing(const Binder *b, Role foot, int out[SAMPLE_BEST_MAX]) {
    double rise = FIGURE_FOOT_RISE * b->f->height / b->f->unit;
    return sample_standing(b->sample, b->f->upright, b->f->roles.joint[foot], ball(b, foot), rise, out);
}

/* What is up for the sole, in the foot's frame: the vertical where the foot stands, if these frames agree with each
   other and, about, with the shin; else along the shin. along falls by about `slope` where the foot is flat. */
static Vec3 up_of_sole(const Binder *b, Role foot, Vec3 along, double slope) {
    static const double ALIKE = 0.99, NEAR = 0.85, FLAT = 0.35; /* cosines, means of them; radians */
    int frames[SAMPLE_BEST_MAX], n = standing(b, foot, frames);
    Vec3 shin = up_the_shin(b, foot, along), up = {0, 0, 0};
    for (int i = 0; i < n; i++)
        up = vec_add(up, mat_column(mat_transpose(turn(b, frames[i], b->f->roles.joint[foot])), 1));
    if (n < 3 || vec_len(up) < ALIKE * n || fabs(asin(-vec_dot(along, up) / n) - slope) > FLAT) return shin;
    Vec3 left = vec_unit_or(vec_cross(up, along), vec(0, 0, 0));
    return vec_dot(left, vec_unit_or(vec_cross(shin, along), left)) > NEAR ? up : shin;
}

/* From the zero pose, where soles lie flat. Where the legs stand astride, flat only fore and aft; and some solvers turn
   feet upside down, which the shin knows. */
static Mat3 foot_from_rest(const Binder *b, Role foot, const Rest *rest) {
    static const double ASTRIDE = 0.12; /* sine */
    int joint = b->f->roles.joint[foot];
    Mat3 flat = rest_bind(rest, joint);
    Vec3 along = mat_apply(mat_transpose(rest->pose[joint].r), rest_bone(rest, b->f, foot)), up = mat_column(flat, 1);
    double fall = -vec_dot(along, up);
    if (fabs(fall) > 0.87 || vec_dot(along, mat_column(flat, 2)) <= 0) return flat;
    bool astride = fabs(vec_dot(rest_bone(rest, b->f, foot - 1), mat_column(rest->frame, 0))) > ASTRIDE;
    bool flipped = vec_dot(vec_cross(up, along), vec_cross(up_the_shin(b, foot, along), along)) < 0;
    return sole(along, astride || flipped ? up_of_sole(b, foot, along, asin(fall)) : up, asin(fall));
}

/* Of feet that lie along the shins throughout, as of those who crawl: they have their left where the hips have it. */
static Vec3 up_by_hips(const Binder *b, Role foot, Vec3 along) {
    const int *j = b->f->roles.joint;
    Vec3 left = {0, 0, 0}, hips = mat_column(b->f->bind[ROLE_PELVIS].r, 0);
    for (int i = 0; i < b->sample->count; i++) {
        Vec3 aside = mat_apply(turn(b, i, j[ROLE_PELVIS]), hips);
        left = vec_add(left, mat_apply(mat_transpose(turn(b, i, j[foot])), aside));
    }
    return vec_unit_or(vec_cross(along, left), vec(0, 1, 0));
}

/* From frames in which the foot stands: how far its line falls there, within what is usual. False where the foot has no
   end. */
static bool foot_from_frames(const Binder *b, Role foot, Mat3 *bind) {
    static const double UNUSUAL = 0.2;
    int joint = b->f->roles.joint[foot], tip = ball(b, foot), frames[SAMPLE_BEST_MAX];
    if (tip < 0) return false;
    Vec3 along = seen_from(b, joint, tip);
    double size = vec_len(along), slope = 0, usual = asin(clamp(FIGURE_FOOT_RISE * b->f->height / size, 0, 0.7));
    along = vec_scale(along, 1 / size);
    if (!(size > 0)) return false;
    if (vec_len(vec_cross(up_the_shin(b, foot, along), along)) < 0.3) {
        *bind = sole(along, up_by_hips(b, foot, along), usual);
        return true;
    }
    int n = standing(b, foot, frames);
    for (int i = 0; i < n; i++) slope += asin(clamp(-mat_apply(turn(b, frames[i], joint), along).y, -1, 1)) / n;
    *bind = sole(along, up_of_sole(b, foot, along, usual), clamp(slope, usual - UNUSUAL, usual + UNUSUAL));
    return true;
}

/* Toes lie as the foot does when it is flat. */
static void bind_toe(const Binder *b, Role foot, const Rest *rest) {
    Figure *f = b->f;
    Role toe = foot + 1;
    int joint = f->roles.joint[toe], frames[SAMPLE_BEST_MAX];
    if (joint < 0 || f->toward[foot] < 0) return;
    f->bound[toe] = true;
    if (rest->human) {
        Mat3 flat = mat_mul(rest->pose[f->roles.joint[foot]].r, f->bind[foot].r);
        f->bind[toe].r = mat_mul(mat_transpose(rest->pose[joint].r), flat);
        return;
    }
    Mean mean = {{0, 0, 0, 0}, 0};
    int n = standing(b, foot, frames);
    for (int i = 0; i < n; i++) {
        Mat3 flat = mat_mul(turn(b, frames[i], f->roles.joint[foot]), f->bind[foot].r);
        mean_add(&mean, mat_mul(mat_transpose(turn(b, frames[i], joint)), flat));
    }
    f->bind[toe].r = mean_of(&mean);
}

static void bind_foot(const Binder *b, Role foot, const Rest *rest, const int *upright, int n) {
    Figure *f = b->f;
    int joint = f->roles.joint[foot];
    if (joint < 0) return;
    Mat3 *bind = &f->bind[foot].r;
    if (rest->human) *bind = foot_from_rest(b, foot, rest);
    else if (!foot_from_frames(b, foot, bind)) *bind = bind_like(b, upright, n, joint, ROLE_PELVIS);
    f->bound[foot] = true;
    bind_toe(b, foot, rest);
}

/* --- all of it --- */

/* Puts the canonical point half-way between the starts of two bones where the two joints are
   on the mean, in the joint's frame. */
static void anchor_torso(const Binder *b, Role role, Role left, Role right) {
    Figure *f = b->f;
    int joint = f->roles.joint[role];
    Vec3 middle = vec_mid(seen_from(b, joint, f->roles.joint[left]), seen_from(b, joint, f->roles.joint[right]));
    Vec3 canonical = vec_mid(f->start[left], f->start[right]);
    f->bind[role].t = vec_sub(middle, mat_apply(f->bind[role].r, canonical));
    f->bound[role] = true;
}

/* The head joint of one rig is the skull's base, of another the middle of the neck. So the
   joint's place counts as the base as far as it moves: on the mean over the upright frames the
   canonical base is where the chest carries it. */
static void anchor_head(const Binder *b, const int *frames, int n) {
    Figure *f = b->f;
    int head = f->roles.joint[ROLE_HEAD], chest = f->roles.joint[ROLE_CHEST];
    Vec3 sum = {0, 0, 0}, base = f->start[ROLE_HEAD];
    if (head < 0) return;
    for (int i = 0; i < n; i++) {
        Rigid carried = rigid_mul((Rigid){turn(b, frames[i], chest), place(b, frames[i], chest)}, f->bind[ROLE_CHEST]);
        Rigid joint = {turn(b, frames[i], head), place(b, frames[i], head)};
        sum = vec_add(sum, rigid_unapply(joint, rigid_apply(carried, base)));
    }
    f->bind[ROLE_HEAD].t = vec_sub(vec_scale(sum, 1.0 / n), mat_apply(f->bind[ROLE_HEAD].r, base));
    f->bound[ROLE_HEAD] = true;
}

void figure_bind(const Skeleton *skeleton, const Sample *sample, const Rest *rest, Figure *f) {
    Binder b = {skeleton, sample, f};
    const int *j = f->roles.joint;
    int upright[SAMPLE_BEST_MAX], n = choose_upright(&b, upright);
    for (int r = 0; r < ROLE_COUNT; r++) f->bind[r] = rigid_identity(), f->bound[r] = false;
    Mat3 level = bind_from_line(&b, upright, n, ROLE_PELVIS, ROLE_RIGHT_THIGH, ROLE_LEFT_THIGH, 0.5);
    double known = known_pelvis(&b, upright, n);
    if (rest->human) {
        f->bind[ROLE_PELVIS].r = pelvis_from_rest(rest_bind(rest, j[ROLE_PELVIS]), level, known);
        f->bind[ROLE_CHEST].r = rest_bind(rest, j[ROLE_CHEST]);
        if (j[ROLE_HEAD] >= 0)
            f->bind[ROLE_HEAD].r = head_from_rest(&b, upright, n, rest_bind(rest, j[ROLE_HEAD]));
    } else {
        Mat3 chest = bind_from_line(&b, upright, n, ROLE_CHEST, ROLE_RIGHT_UPPER_ARM, ROLE_LEFT_UPPER_ARM, 0);
        f->bind[ROLE_PELVIS].r = pelvis_from_bones(&b, level, known);
        f->bind[ROLE_CHEST].r = chest_from_bones(&b, chest);
        if (j[ROLE_HEAD] >= 0) f->bind[ROLE_HEAD].r = head_from_bones(&b, head_from_chest(&b));
    }
    anchor_torso(&b, ROLE_PELVIS, ROLE_LEFT_THIGH, ROLE_RIGHT_THIGH);
    anchor_torso(&b, ROLE_CHEST, ROLE_LEFT_UPPER_ARM, ROLE_RIGHT_UPPER_ARM);
    anchor_head(&b, upright, n);
    bind_foot(&b, ROLE_LEFT_FOOT, rest, upright, n);
    bind_foot(&b, ROLE_RIGHT_FOOT, rest, upright, n);
}
