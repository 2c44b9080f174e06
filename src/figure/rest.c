/* Is the zero pose a human who stands? If so, the whole binding follows from it; if not, nothing in it may be believed.
   So the tests are strict where a heap of bones could pass (legs or both arms to one side, feet that point up) and
   lenient where rigs differ (legs astride, arms anywhere from level to hanging). Feet that go on along the shins are
   left out of it: in some rigs the line from the ankle only ends at the ground.

   Takes of rigs whose zero pose is a heap often begin with a T-pose, which tells as much. But the first frame may also
   belong to the motion itself, with a body that is turned and bent: so there arms and legs must be straight. */
#include "figure/rest.h"

/* Cosines. */
static const double UPRIGHT = 0.87, SIDEWAYS = 0.96; /* trunk and left line that near to an axis of the file mean it */
static const double TOGETHER = 0.85;   /* least, between hip line and shoulder line */
static const double LEANING = 0.3;     /* most, between hip line and trunk */
static const double LEGS_DOWN = 0.8;   /* least, between legs and down: they may stand astride as far as that */
static const double ALONG_SHIN = 0.97, UP_SHIN = -0.5; /* between foot and shin: most and least */
static const double RAISED = 0.5;      /* most, between arms and up */
static const double INWARDS = -0.3;    /* least, between an arm and its own side */
static const double TEE = 0.42, HANGING = 0.87; /* between arms and down: less is a T-pose, more hangs */
/* Lengths of the difference between a unit bone and the mirror image of the other. */
static const double LEGS_LOPSIDED = 0.25, ARMS_LOPSIDED = 0.5;

Vec3 rest_bone(const Rest *rest, const Figure *f, Role role) {
    if (f->toward[role] < 0) return vec(0, 0, 0);
    Vec3 from = rest_place(rest, f->roles.joint[role]), to = rest_place(rest, f->toward[role]);
    return vec_unit_or(vec_sub(to, from), vec(0, 0, 0));
}

Vec3 rest_snap(Vec3 v, double cosine) {
    for (int i = 0; i < 6; i++) {
        double sign = i < 3 ? 1 : -1;
        Vec3 axis = vec(i % 3 == 0 ? sign : 0, i % 3 == 1 ? sign : 0, i % 3 == 2 ? sign : 0);
        if (vec_dot(axis, v) > cosine) return axis;
    }
    return v;
}

/* Sets rest->frame to left, up and forward of the body that hips and shoulders span. */
static bool torso_is_human(const Figure *f, Rest *rest) {
    const int *j = f->roles.joint;
    Vec3 left_hip = rest_place(rest, j[ROLE_LEFT_THIGH]), right_hip = rest_place(rest, j[ROLE_RIGHT_THIGH]);
    Vec3 left_arm = rest_place(rest, j[ROLE_LEFT_UPPER_ARM]), right_arm = rest_place(rest, j[ROLE_RIGHT_UPPER_ARM]);
    Vec3 torso = vec_sub(vec_mid(left_arm, right_arm), vec_mid(left_hip, right_hip));
    Vec3 shoulders = vec_unit_or(vec_sub(left_arm, right_arm), vec(0, 0, 0));
    Vec3 hips = vec_unit_or(vec_sub(left_hip, right_hip), shoulders); /* hips may have no width */
    Vec3 up = rest_snap(vec_unit_or(torso, vec(0, 0, 0)), UPRIGHT);
    if (vec_dot(hips, shoulders) < TOGETHER || fabs(vec_dot(hips, up)) > LEANING) return false;
    Vec3 left = vec_add(hips, shoulders);
    left = rest_snap(vec_unit_or(vec_mad(left, up, -vec_dot(left, up)), hips), SIDEWAYS);
    rest->frame = mat_columns(left, up, vec_cross(left, up));
    return true;
}

/* *bone: unit direction of a bone in the axes of the body. Returns the length of its difference from the mirror image
   of the bone on the other side. */
static double lopsided(const Figure *f, const Rest *rest, Role role, Vec3 *bone) {
    Mat3 to_body = mat_transpose(rest->frame);
    Vec3 other = mat_apply(to_body, rest_bone(rest, f, role_mirror(role)));
    *bone = mat_apply(to_body, rest_bone(rest, f, role));
    return vec_dist(*bone, vec(-other.x, other.y, other.z));
}

/* Some exporters take a frame of the motion for the zero pose. Then the legs stride, and are not each other's mirror
   image. */
static bool legs_are_human(const Figure *f, Rest *rest) {
    static const Role bones[] = {ROLE_LEFT_THIGH, ROLE_RIGHT_THIGH, ROLE_LEFT_SHIN, ROLE_RIGHT_SHIN};
    Vec3 bone;
    for (int i = 0; i < 4; i++)
        if (lopsided(f, rest, bones[i], &bone) > LEGS_LOPSIDED || bone.y > -LEGS_DOWN) return false;
    rest->soles = true;
    for (int side = 0; side < 2; side++) {
        Role foot = side ? ROLE_RIGHT_FOOT : ROLE_LEFT_FOOT;
        if (f->toward[foot] < 0) continue;
        double along = vec_dot(rest_bone(rest, f, foot), rest_bone(rest, f, foot - 1));
        if (along > ALONG_SHIN) rest->soles = false;
        if (along < UP_SHIN) return false;
    }
    return true;
}

static bool arms_are_human(const Figure *f, const Rest *rest) {
    Vec3 left;
    for (int r = ROLE_LEFT_UPPER_ARM; r <= ROLE_LEFT_FOREARM; r++)
        if (lopsided(f, rest, (Role)r, &left) > ARMS_LOPSIDED || left.y > RAISED || left.x < INWARDS) return false;
    return true;
}

static bool is_human(const Figure *f, Rest *rest) {
    return torso_is_human(f, rest) && legs_are_human(f, rest) && arms_are_human(f, rest);
}

/* Do legs go straight down, and straight arms to the side rather than down? */
static bool is_straight(const Figure *f, const Rest *rest) {
    static const double STRAIGHT = 0.97, DOWN = 0.97, OFF_DOWN = 0.8;
    Vec3 up = mat_column(rest->frame, 1);
    for (int side = 0; side < 2; side++) {
        Role leg = side ? ROLE_RIGHT_THIGH : ROLE_LEFT_THIGH, arm = side ? ROLE_RIGHT_UPPER_ARM : ROLE_LEFT_UPPER_ARM;
        Vec3 thigh = rest_bone(rest, f, leg), upper = rest_bone(rest, f, arm);
        if (-vec_dot(thigh, up) < DOWN || vec_dot(thigh, rest_bone(rest, f, leg + 1)) < STRAIGHT) return false;
        if (-vec_dot(upper, up) > OFF_DOWN || vec_dot(upper, rest_bone(rest, f, arm + 1)) < STRAIGHT) return false;
    }
    return true;
}

Rest rest_find(const Sample *sample, const Figure *f) {
    Rest zero = {.pose = sample->zero}, first = {.pose = sample->first};
    if (is_human(f, &zero)) {
        double down = -vec_dot(rest_bone(&zero, f, ROLE_LEFT_UPPER_ARM), mat_column(zero.frame, 1));
        zero.human = true;
        zero.name = down < TEE ? "T-pose offsets" : down < HANGING ? "A-pose offsets" : "offsets with hanging arms";
        return zero;
    }
    first.human = is_human(f, &first) && is_straight(f, &first);
    first.name = first.human ? "T-pose in frame 1" : "upright frames";
    return first;
}
