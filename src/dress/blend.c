/* Of the two quaternions of a bone's rotation, a blend needs the one that says which way round the bone has turned, and
   of a thigh also how much of that is a twist about itself, which cloth follows late.

   A thigh's rotation is seen as a swing the shortest way to where it points, and the twist. One that points straight up
   could have swung there from all sides, so that its twist would be any. To make that no place for a thigh to pass, the
   swing begins forwards and outwards of hanging, the more so the more the thigh points up; then the one direction
   without a swing leads into the trunk. */
#include "dress/blend.h"

static const double BEGIN = 30 * PI / 180; /* how far forwards and outwards, where the thigh points up */

static bool is_thigh(Role bone) { return bone == ROLE_LEFT_THIGH || bone == ROLE_RIGHT_THIGH; }

/* The direction of a bone in the canonical stance. */
static Vec3 bone_axis(const Figure *f, Role bone) {
    return vec_unit_or(vec_sub(f->end[bone], f->start[bone]), vec(0, -1, 0));
}

/* Where the swing of a thigh begins. */
static Mat3 swing_begins(const Blender *b, Role thigh) {
    Mat3 pelvis = b->pose->bone[ROLE_PELVIS].r;
    Vec3 hanging = bone_axis(b->figure, thigh);
    Vec3 points = mat_apply(mat_mul(mat_transpose(pelvis), b->pose->bone[thigh].r), hanging);
    double up = fmax(-vec_dot(hanging, points), 0);
    Vec3 about = vec_scale(vec(-1, 0, thigh == ROLE_LEFT_THIGH ? 1 : -1), sqrt(0.5));
    return mat_mul(pelvis, mat_axis_angle(about, BEGIN * up * up));
}

/* The angle by which a bone is twisted about itself, swung from `begin`; radians. */
static double twist_of(const Blender *b, Role bone, Mat3 begin) {
    Quat q = quat_from_mat(mat_mul(mat_transpose(begin), b->pose->bone[bone].r));
    double about = vec_dot(vec(q.x, q.y, q.z), bone_axis(b->figure, bone));
    return 2 * atan2(q.w < 0 ? -about : about, fabs(q.w));
}

/* The rotation of a thigh, counted from that of the pelvis. */
static Quat turn_of_thigh(Blender *b, Role thigh, Quat pelvis) {
    Mat3 begin = swing_begins(b, thigh), r = b->pose->bone[thigh].r;
    double twist = b->twist[thigh == ROLE_RIGHT_THIGH] = twist_of(b, thigh, begin);
    Mat3 swung = mat_mul(r, mat_axis_angle(bone_axis(b->figure, thigh), -twist));
    Quat like = quat_like(quat_from_mat(swung), quat_like(quat_from_mat(begin), pelvis));
    return quat_like(quat_from_mat(r), like);
}

/* A bone has turned the shorter way from the bone that it hangs on. */
Blender blender_of(const Figure *figure, const Pose *pose) {
    Blender b = {.figure = figure, .pose = pose};
    for (int r = 0; r < ROLE_COUNT; r++) {
        Quat like = r > 0 ? b.turn[role_parent((Role)r)] : (Quat){1, 0, 0, 0};
        b.turn[r] = is_thigh((Role)r) ? turn_of_thigh(&b, (Role)r, like)
                                      : quat_like(quat_from_mat(pose->bone[r].r), like);
    }
    return b;
}

/* How a point moves with a bone, and as *turn the rotation of that. */
static Rigid bone_at(const Blender *b, Role bone, Vec3 rest, Quat *turn) {
    *turn = b->turn[bone];
    if (!is_thigh(bone)) return b->pose->bone[bone];
    Vec3 hip = b->figure->start[bone], along = vec_sub(b->figure->end[bone], hip);
    double down = vec_dot(vec_sub(rest, hip), along) / vec_dot(along, along);
    double back = -b->twist[bone == ROLE_RIGHT_THIGH] * (1 - fmin(fmax(down, 0), 1));
    Mat3 about = mat_axis_angle(bone_axis(b->figure, bone), back);
    Rigid g = rigid_mul(b->pose->bone[bone], (Rigid){about, vec_sub(hip, mat_apply(about, hip))});
    *turn = quat_like(quat_from_mat(g.r), *turn);
    return g;
}

Rigid blend_at(const Blender *b, const Binding *binding, Vec3 rest) {
    Quat mean = {0, 0, 0, 0};
    Vec3 dual = {0, 0, 0}; /* vector and scalar part of the sum of t q, that is twice the dual part */
    double dual_w = 0;
    for (int i = 0; i < binding->n; i++) {
        Quat q;
        Rigid g = bone_at(b, binding->bone[i], rest, &q);
        Vec3 v = {q.x, q.y, q.z}, t = g.t;
        double s = binding->weight[i];
        mean = (Quat){mean.w + s * q.w, mean.x + s * q.x, mean.y + s * q.y, mean.z + s * q.z};
        dual = vec_mad(dual, vec_add(vec_scale(t, q.w), vec_cross(t, v)), s);
        dual_w -= s * vec_dot(t, v);
    }
    double n = sqrt(mean.w * mean.w + mean.x * mean.x + mean.y * mean.y + mean.z * mean.z);
    if (n < 1e-6) return b->pose->bone[binding->bone[0]]; /* bones turned against each other: no mean */
    Vec3 v = {mean.x, mean.y, mean.z};
    Vec3 t = vec_add(vec_mad(vec_scale(dual, mean.w), v, -dual_w), vec_cross(v, dual));
    return (Rigid){mat_from_quat((Quat){mean.w / n, v.x / n, v.y / n, v.z / n}), vec_scale(t, 1 / (n * n))};
}
