/* Feet. The line from the ankle to the toes gives forward. What is missing is how far that line falls when the sole is
   flat on the ground, and how the sole is rolled about it.

   A human zero pose shows flat soles. Without one, the frames in which the foot most likely stands on the ground tell
   both. Where no frame does (somebody who kneels, crawls or lies), the shin tells the roll: ankles bend forwards and
   backwards, but hardly to the side.

   In some rigs the line from the ankle does not end at the toes but at the ground below, and tells nothing. */
#include "figure/bind_foot.h"

#include "figure/measure.h"

/* The sole's axes: it points along `along`, which falls by `slope` radians; up is as near to `up` as possible. */
static Mat3 sole(Vec3 along, Vec3 up, double slope) {
    Vec3 left = vec_unit_or(vec_cross(up, along), vec(1, 0, 0));
    Vec3 ahead = mat_apply(mat_axis_angle(left, -slope), along);
    return mat_columns(left, vec_cross(ahead, left), ahead);
}

/* Mean direction from ankle to knee, in the ankle's frame. along: where the foot points. A frame in which the foot lies
   along the shin, as of somebody who kneels, tells little of the foot's roll and has little weight. */
static Vec3 up_the_shin(const Binder *b, Role foot, Vec3 along) {
    int ankle = b->f->roles.joint[foot], knee = b->f->roles.joint[foot - 1];
    Vec3 sum = {0, 0, 0};
    for (int i = 0; i < b->sample->count; i++) {
        Vec3 shin = vec_sub(binder_position(b, i, knee), binder_position(b, i, ankle));
        shin = vec_unit_or(mat_apply(mat_transpose(binder_rotation(b, i, ankle)), shin), vec(0, 1, 0));
        Vec3 aside = vec_cross(shin, along);
        sum = vec_mad(sum, shin, vec_dot(aside, aside));
    }
    return vec_unit_or(sum, vec(0, 1, 0));
}

/* The joint that a foot points to: it lies ahead of the ankle and does not move against it. The toe joint, or the tip
   of a foot that has none; -1 where there is neither. */
static int ball(const Binder *b, Role foot) {
    int ankle = b->f->roles.joint[foot], toe = b->f->roles.joint[foot + 1];
    bool ahead = toe >= 0 && vec_len(binder_offset(b, ankle, toe)) > BINDER_SHORT * b->f->height;
    return ahead ? toe : b->f->toward[foot];
}

static int standing(const Binder *b, Role foot, int out[SAMPLE_BEST_MAX]) {
    double rise = FIGURE_FOOT_RISE * b->f->height / b->f->unit;
    return sample_standing(b->sample, b->f->upright, b->f->roles.joint[foot], ball(b, foot), rise, out);
}

/* The sole's up, in the ankle's frame: the vertical of the frames in which the foot stands, if these frames agree with
   each other and roughly with the shin; else the direction up the shin. slope: about how far `along` falls, in radians,
   when the foot is flat. */
static Vec3 up_of_sole(const Binder *b, Role foot, Vec3 along, double slope) {
    static const double AGREE = 0.99;     /* length of the mean of the verticals */
    static const double SLOPE_OFF = 0.35; /* radians: that the fall of the foot may differ from slope */
    static const double LIKE_SHIN = 0.85; /* cosine between left by the vertical and left by the shin */
    int frames[SAMPLE_BEST_MAX], n = standing(b, foot, frames);
    Vec3 shin = up_the_shin(b, foot, along), up = {0, 0, 0};
    for (int i = 0; i < n; i++)
        up = vec_add(up, mat_column(mat_transpose(binder_rotation(b, frames[i], b->f->roles.joint[foot])), 1));
    if (n < 3 || vec_len(up) < AGREE * n || fabs(asin(-vec_dot(along, up) / n) - slope) > SLOPE_OFF) return shin;
    Vec3 left = vec_unit_or(vec_cross(up, along), vec(0, 0, 0));
    return vec_dot(left, vec_unit_or(vec_cross(shin, along), left)) > LIKE_SHIN ? up : shin;
}

/* From a human zero pose, where soles lie flat. Two exceptions: legs that stand astride tilt the soles sideways, and
   some solvers turn feet upside down, which the shin shows. Then only the slope is taken from the zero pose. */
static Mat3 foot_from_rest(const Binder *b, Role foot, const Rest *rest) {
    static const double UPRIGHT = 0.87; /* sine of the fall: a line that points down or up and tells no sole */
    static const double ASTRIDE = 0.12; /* sine of the thigh's lean to the side */
    int joint = b->f->roles.joint[foot];
    Mat3 flat = rest_bind(rest, joint);
    Vec3 along = mat_apply(mat_transpose(rest->pose[joint].r), rest_bone(rest, b->f, foot)), up = mat_column(flat, 1);
    double fall = -vec_dot(along, up);
    if (fabs(fall) > UPRIGHT || vec_dot(along, mat_column(flat, 2)) <= 0) return flat;
    bool astride = fabs(vec_dot(rest_bone(rest, b->f, foot - 1), mat_column(rest->frame, 0))) > ASTRIDE;
    bool flipped = vec_dot(vec_cross(up, along), vec_cross(up_the_shin(b, foot, along), along)) < 0;
    return sole(along, astride || flipped ? up_of_sole(b, foot, along, asin(fall)) : up, asin(fall));
}

/* For feet that lie along the shins throughout, as of somebody who crawls: the sole's left is where the pelvis has
   its left, on the mean. */
static Vec3 up_by_hips(const Binder *b, Role foot, Vec3 along) {
    const int *j = b->f->roles.joint;
    Vec3 left = {0, 0, 0}, hips = mat_column(b->f->bind[ROLE_PELVIS].r, 0);
    for (int i = 0; i < b->sample->count; i++) {
        Vec3 aside = mat_apply(binder_rotation(b, i, j[ROLE_PELVIS]), hips);
        left = vec_add(left, mat_apply(mat_transpose(binder_rotation(b, i, j[foot])), aside));
    }
    return vec_unit_or(vec_cross(along, left), vec(0, 1, 0));
}

/* Is the foot's line shorter than any foot? Then, if it goes on along the shin, it ends at the ground below the
   ankle. */
static bool is_short(const Binder *b, Role foot) {
    static const double SHORT = 0.06; /* statures */
    int tip = ball(b, foot);
    return tip >= 0 && vec_len(binder_offset(b, b->f->roles.joint[foot], tip)) < SHORT * b->f->height;
}

/* By how much the foot's line falls in the frames in which the foot stands, on the mean, radians. */
static double fall_in_stance(const Binder *b, Role foot) {
    int joint = b->f->roles.joint[foot], frames[SAMPLE_BEST_MAX], n = standing(b, foot, frames);
    Vec3 along = vec_unit_or(binder_offset(b, joint, ball(b, foot)), vec(0, 0, 0));
    double fall = 0;
    for (int i = 0; i < n; i++)
        fall += asin(clamp(-mat_apply(binder_rotation(b, frames[i], joint), along).y, -1, 1)) / n;
    return fall;
}

/* No foot that stands falls by more than this, radians. */
static const double STEEP = 1;

/* From the frames in which the foot stands: the slope is the mean fall of its line there, within UNUSUAL radians of the
   usual one. False where the foot has no end, or one below the ankle. */
static bool foot_from_frames(const Binder *b, Role foot, Mat3 *bind) {
    static const double SINE_MOST = 0.7, UNUSUAL = 0.2;
    static const double ALONG_SHIN = 0.3; /* sine between foot and shin, below which the shin tells no roll */
    int joint = b->f->roles.joint[foot], tip = ball(b, foot);
    if (tip < 0) return false;
    Vec3 along = binder_offset(b, joint, tip);
    double size = vec_len(along), slope = fall_in_stance(b, foot), rise = FIGURE_FOOT_RISE * b->f->height;
    double usual = asin(clamp(rise / size, 0, SINE_MOST));
    along = vec_scale(along, 1 / size);
    if (!(size > 0)) return false;
    bool along_shin = vec_len(vec_cross(up_the_shin(b, foot, along), along)) < ALONG_SHIN;
    if (is_short(b, foot) && (along_shin || slope > STEEP)) return false;
    if (along_shin) {
        *bind = sole(along, up_by_hips(b, foot, along), usual);
        return true;
    }
    *bind = sole(along, up_of_sole(b, foot, along, usual), clamp(slope, usual - UNUSUAL, usual + UNUSUAL));
    return true;
}

bool bind_foot(const Binder *b, Role foot, const Rest *rest, Mat3 *out) {
    bool ends_below = ball(b, foot) >= 0 && (is_short(b, foot) || fall_in_stance(b, foot) > STEEP);
    bool told = rest->human && (rest->soles || ends_below);
    if (!told) return foot_from_frames(b, foot, out);
    *out = foot_from_rest(b, foot, rest);
    return true;
}

/* Toes are parallel to the foot when it is flat: in the zero pose, else in the frames in which it stands. */
void bind_toe(const Binder *b, Role foot, const Rest *rest) {
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
    Quat sum = {0, 0, 0, 0};
    int n = standing(b, foot, frames);
    for (int i = 0; i < n; i++) {
        Mat3 flat = mat_mul(binder_rotation(b, frames[i], f->roles.joint[foot]), f->bind[foot].r);
        binder_mean_add(&sum, mat_mul(mat_transpose(binder_rotation(b, frames[i], joint)), flat));
    }
    f->bind[toe].r = binder_mean(sum);
}
