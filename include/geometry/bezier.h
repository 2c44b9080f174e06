/* Bicubic Bezier patches: the paper's equations (1), (5) and (6). */
#ifndef GEOMETRY_BEZIER_H
#define GEOMETRY_BEZIER_H

#include "geometry/vec.h"

/* p[i][j] is the paper's B_ij: i runs along u, j along w. */
typedef struct { Vec3 p[4][4]; } Patch;

/* Equation (1): the point at (u, w), both in [0, 1]. du and dw, if not NULL, get the first
   partial derivatives. */
Vec3 bezier_point(const Patch *patch, double u, double w, Vec3 *du, Vec3 *dw);

/* Unit normal du x dw. Where a derivative vanishes (a pole) it is taken a little inside; +y where the
   patch has no area there either. */
Vec3 bezier_normal(const Patch *patch, double u, double w);

/* Equations (5) and (6) at t = 1/2 in both directions: four patches of the same surface.
   child[2 * a + b] covers u half a, w half b. */
void bezier_split(const Patch *patch, Patch child[4]);

/* The part of the patch over [u0, u1] x [w0, w1] as a patch of its own (blossom). */
Patch bezier_part(const Patch *patch, double u0, double u1, double w0, double w1);

/* Sum of p[k] b[k]: a cubic for the weights of bezier_basis. */
static inline Vec3 bezier_cubic(const Vec3 p[4], const double b[4]) {
    return vec_mad(vec_mad(vec_mad(vec_scale(p[0], b[0]), p[1], b[1]), p[2], b[2]), p[3], b[3]);
}

/* Equation (1) for weights that are at hand: those of u and of w, or of their derivatives. */
static inline Vec3 bezier_weighted(const Patch *patch, const double bu[4], const double bw[4]) {
    Vec3 row[4];
    for (int i = 0; i < 4; i++) row[i] = bezier_cubic(patch->p[i], bw);
    return bezier_cubic(row, bu);
}

/* Values b[k] = C(3,k) t^k (1-t)^(3-k) and, if d is not NULL, their derivatives. */
void bezier_basis(double t, double b[4], double d[4]);

/* The Bezier form of the cubic Hermite segment from a to b with end derivatives da, db over
   a parameter length h: out = a, a + h da / 3, b - h db / 3, b. */
void bezier_from_hermite(Vec3 a, Vec3 da, Vec3 b, Vec3 db, double h, Vec3 out[4]);

#endif
