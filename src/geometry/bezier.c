/* Bicubic Bezier patches. A patch is evaluated by its Bernstein form (1) and split by de
   Casteljau's scheme (5, 6); both describe the same surface, and the tests say so. */
#include "geometry/bezier.h"

void bezier_basis(double t, double b[4], double d[4]) {
    double s = 1 - t;
    b[0] = s * s * s;
    b[1] = 3 * s * s * t;
    b[2] = 3 * s * t * t;
    b[3] = t * t * t;
    if (!d) return;
    d[0] = -3 * s * s;
    d[1] = 3 * s * s - 6 * s * t;
    d[2] = 6 * s * t - 3 * t * t;
    d[3] = 3 * t * t;
}

Vec3 bezier_point(const Patch *patch, double u, double w, Vec3 *du, Vec3 *dw) {
    double bu[4], bw[4], cu[4], cw[4];
    bezier_basis(u, bu, cu);
    bezier_basis(w, bw, cw);
    Vec3 row[4], slope[4];
    for (int i = 0; i < 4; i++) {
        row[i] = bezier_cubic(patch->p[i], bw);
        slope[i] = bezier_cubic(patch->p[i], cw);
    }
    if (du) *du = bezier_cubic(row, cu);
    if (dw) *dw = bezier_cubic(slope, bu);
    return bezier_cubic(row, bu);
}

Vec3 bezier_normal(const Patch *patch, double u, double w) {
    for (int try = 0; try < 3; try++) {
        Vec3 du, dw;
        bezier_point(patch, u, w, &du, &dw);
        Vec3 n = vec_cross(du, dw);
        double size = vec_len(n);
        if (size > 1e-9 * (vec_dot(du, du) + vec_dot(dw, dw)) && size > 0) return vec_scale(n, 1 / size);
        u += (0.5 - u) * 0.01; /* a pole: the derivative vanishes here, not beside */
        w += (0.5 - w) * 0.01;
    }
    return vec(0, 1, 0);
}

/* Equation (5) at t = 1/2: four points become the seven of both halves. */
static void halve(const Vec3 p[4], Vec3 out[7]) {
    Vec3 a = vec_mid(p[0], p[1]), b = vec_mid(p[1], p[2]), c = vec_mid(p[2], p[3]);
    Vec3 ab = vec_mid(a, b), bc = vec_mid(b, c);
    Vec3 all[7] = {p[0], a, ab, vec_mid(ab, bc), bc, c, p[3]};
    for (int i = 0; i < 7; i++) out[i] = all[i];
}

void bezier_split(const Patch *patch, Patch child[4]) {
    Vec3 row[4][7], net[7][7]; /* 28 points, then 49 */
    for (int i = 0; i < 4; i++) halve(patch->p[i], row[i]);
    for (int j = 0; j < 7; j++) {
        Vec3 down[4] = {row[0][j], row[1][j], row[2][j], row[3][j]}, seven[7];
        halve(down, seven);
        for (int i = 0; i < 7; i++) net[i][j] = seven[i];
    }
    for (int a = 0; a < 2; a++)
        for (int b = 0; b < 2; b++)
            for (int i = 0; i < 4; i++)
                for (int j = 0; j < 4; j++) child[2 * a + b].p[i][j] = net[3 * a + i][3 * b + j];
}

/* The blossom of a cubic at (a, b, c): the polar form that is linear in each argument. */
static Vec3 blossom(const Vec3 p[4], double a, double b, double c) {
    Vec3 q0 = vec_lerp(p[0], p[1], a), q1 = vec_lerp(p[1], p[2], a), q2 = vec_lerp(p[2], p[3], a);
    return vec_lerp(vec_lerp(q0, q1, b), vec_lerp(q1, q2, b), c);
}

static void part_of_curve(const Vec3 p[4], double t0, double t1, Vec3 out[4]) {
    Vec3 all[4] = {blossom(p, t0, t0, t0), blossom(p, t0, t0, t1), blossom(p, t0, t1, t1), blossom(p, t1, t1, t1)};
    for (int i = 0; i < 4; i++) out[i] = all[i];
}

Patch bezier_part(const Patch *patch, double u0, double u1, double w0, double w1) {
    Patch out;
    for (int i = 0; i < 4; i++) part_of_curve(patch->p[i], w0, w1, out.p[i]);
    for (int j = 0; j < 4; j++) {
        Vec3 down[4] = {out.p[0][j], out.p[1][j], out.p[2][j], out.p[3][j]}, cut[4];
        part_of_curve(down, u0, u1, cut);
        for (int i = 0; i < 4; i++) out.p[i][j] = cut[i];
    }
    return out;
}

void bezier_from_hermite(Vec3 a, Vec3 da, Vec3 b, Vec3 db, double h, Vec3 out[4]) {
    out[0] = a;
    out[1] = vec_mad(a, da, h / 3);
    out[2] = vec_mad(b, db, -h / 3);
    out[3] = b;
}
