/* How far poses are turned against each other, in degrees. */
#ifndef TESTS_TURNS_H
#define TESTS_TURNS_H

#include "rig.h"
#include "tap.h"

static const double DEGREE = PI / 180;

static inline double angle(Vec3 a, Vec3 b) {
    double c = vec_dot(vec_unit_or(a, vec(0, 0, 0)), vec_unit_or(b, vec(0, 0, 0)));
    return acos(clamp(c, -1, 1)) / DEGREE;
}

static inline bool is_rotation(Mat3 m) {
    Mat3 i = mat_mul(m, mat_transpose(m));
    for (int k = 0; k < 3; k++) {
        Vec3 row = mat_column(i, k), unit = mat_column(mat_identity(), k);
        if (vec_dist(row, unit) > 1e-9) return false;
    }
    return vec_dot(vec_cross(m.r[0], m.r[1]), m.r[2]) > 0;
}

/* Angle of the rotation that takes one frame to the other, degrees. */
static inline double turned(Mat3 a, Mat3 b) {
    Mat3 d = mat_mul(mat_transpose(a), b);
    return acos(clamp((d.r[0].x + d.r[1].y + d.r[2].z - 1) / 2, -1, 1)) / DEGREE;
}

static inline double foot_difference(Rig *a, Rig *b) {
    double most = 0;
    for (int frame = 0; frame < a->motion.nframes; frame++)
        for (int foot = ROLE_LEFT_FOOT; foot <= ROLE_RIGHT_FOOT; foot += ROLE_RIGHT_FOOT - ROLE_LEFT_FOOT) {
            const Figure *f = &a->figure, *g = &b->figure;
            Vec3 u = mat_apply(rig_pose(a, frame).bone[foot].r, vec_sub(f->end[foot], f->start[foot]));
            Vec3 v = mat_apply(rig_pose(b, frame).bone[foot].r, vec_sub(g->end[foot], g->start[foot]));
            most = max_of(most, angle(u, v));
        }
    return most;
}

static inline double turn_difference(Rig *a, Rig *b, Role role) {
    double most = 0;
    for (int frame = 0; frame < a->motion.nframes; frame++) {
        Pose p = rig_pose(a, frame), q = rig_pose(b, frame);
        most = max_of(most, turned(p.bone[role].r, q.bone[role].r));
    }
    return most;
}

#endif
