/* Is the zero pose human? If so, all joint frames are parallel to one standing body and the
   whole binding follows from it; if not, nothing may be believed of it. So the tests are
   strict where heaps could pass (feet along the shins, arms both to one side) and lenient
   where rigs differ (legs astride, arms anywhere from level to hanging). */
#include "figure/rest.h"

Vec3 rest_place(const Skeleton *s, int joint) {
    Vec3 p = {0, 0, 0};
    for (int j = joint; j >= 0; j = s->joint[j].parent) p = vec_add(p, s->joint[j].offset);
    return p;
}

Vec3 rest_bone(const Skeleton *s, const Figure *f, Role role) {
    if (f->toward[role] < 0) return vec(0, 0, 0);
    return vec_unit_or(vec_sub(rest_place(s, f->toward[role]), rest_place(s, f->roles.joint[role])), vec(0, 0, 0));
}

Vec3 rest_snap(Vec3 v, double cosine) {
    for (int i = 0; i < 6; i++) {
        double sign = i < 3 ? 1 : -1;
        Vec3 axis = vec(i % 3 == 0 ? sign : 0, i % 3 == 1 ? sign : 0, i % 3 == 2 ? sign : 0);
        if (vec_dot(axis, v) > cosine) return axis;
    }
    return v;
}

/* Left, up and forward of the body that hips and shoulders span. */
static bool torso_is_human(const Skeleton *s, const Figure *f, Mat3 *frame) {
    const int *j = f->roles.joint;
    Vec3 left_hip = rest_place(s, j[ROLE_LEFT_THIGH]), right_hip = rest_place(s, j[ROLE_RIGHT_THIGH]);
    Vec3 left_arm = rest_place(s, j[ROLE_LEFT_UPPER_ARM]), right_arm = rest_place(s, j[ROLE_RIGHT_UPPER_ARM]);
    Vec3 torso = vec_sub(vec_mid(left_arm, right_arm), vec_mid(left_hip, right_hip));
    Vec3 shoulders = vec_unit_or(vec_sub(left_arm, right_arm), vec(0, 0, 0));
    Vec3 hips = vec_unit_or(vec_sub(left_hip, right_hip), shoulders); /* hips may have no width */
    Vec3 up = rest_snap(vec_unit_or(torso, vec(0, 0, 0)), 0.87);
    if (vec_dot(hips, shoulders) < 0.85 || fabs(vec_dot(hips, up)) > 0.3) return false;
    Vec3 left = vec_add(hips, shoulders);
    left = rest_snap(vec_unit_or(vec_mad(left, up, -vec_dot(left, up)), hips), 0.96);
    *frame = mat_columns(left, up, vec_cross(left, up));
    return true;
}

static bool legs_are_human(const Skeleton *s, const Figure *f, Vec3 up) {
    static const Role bones[] = {ROLE_LEFT_THIGH, ROLE_RIGHT_THIGH, ROLE_LEFT_SHIN, ROLE_RIGHT_SHIN};
    for (int i = 0; i < 4; i++)
        if (vec_dot(rest_bone(s, f, bones[i]), up) > -0.8) return false;
    for (int side = 0; side < 2; side++) {
        Role foot = side ? ROLE_RIGHT_FOOT : ROLE_LEFT_FOOT;
        if (f->toward[foot] < 0) continue;
        double along = vec_dot(rest_bone(s, f, foot), rest_bone(s, f, foot - 1));
        if (along > 0.97 || along < -0.5) return false;
    }
    return true;
}

static bool arms_are_human(const Skeleton *s, const Figure *f, Mat3 frame) {
    Mat3 to_body = mat_transpose(frame);
    for (int r = ROLE_LEFT_UPPER_ARM; r <= ROLE_LEFT_FOREARM; r++) {
        Vec3 left = mat_apply(to_body, rest_bone(s, f, (Role)r));
        Vec3 right = mat_apply(to_body, rest_bone(s, f, role_mirror((Role)r)));
        if (left.y > 0.5 || left.x < -0.3 || vec_dist(left, vec(-right.x, right.y, right.z)) > 0.5) return false;
    }
    return true;
}

Rest rest_find(const Skeleton *s, const Figure *f) {
    Rest rest = {.frame = mat_identity(), .name = "upright frames"};
    if (!torso_is_human(s, f, &rest.frame)) return rest;
    if (!legs_are_human(s, f, mat_column(rest.frame, 1)) || !arms_are_human(s, f, rest.frame)) return rest;
    rest.human = true;
    double down = -vec_dot(rest_bone(s, f, ROLE_LEFT_UPPER_ARM), mat_column(rest.frame, 1));
    rest.name = down < 0.42 ? "T-pose offsets" : down < 0.87 ? "A-pose offsets" : "offsets with hanging arms";
    return rest;
}
