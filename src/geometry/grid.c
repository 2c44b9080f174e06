/* A patch at fixed w is a cubic curve along u, and all of a grid's points on it are one small matrix
   product: basis rows, which never change, times four points. Basis values stand side by side, so
   that the compiler turns each loop along u into vectors, as wide as the processor has them;
   every sum is taken in the order of bezier_point, so wider vectors change no bit. */
#include "geometry/grid.h"

bool grid_rows(int facets, Arena *arena, GridRows *out, Error *e) {
    int n = facets + 1;
    double *all = ARENA_NEW(arena, double, 9 * n, e);
    *out = (GridRows){.n = n, .t = all};
    if (!all) return false;
    for (int k = 0; k < 4; k++) {
        out->value[k] = all + (1 + k) * n;
        out->slope[k] = all + (5 + k) * n;
    }
    for (int i = 0; i < n; i++) {
        double b[4], d[4];
        out->t[i] = (double)i / facets;
        bezier_basis(out->t[i], b, d);
        for (int k = 0; k < 4; k++) out->value[k][i] = b[k], out->slope[k][i] = d[k];
    }
    return true;
}

GridRows grid_part(const GridRows *rows, int first, int n) {
    GridRows part = {.vectors = rows->vectors, .n = n, .t = rows->t + first};
    for (int k = 0; k < 4; k++) part.value[k] = rows->value[k] + first, part.slope[k] = rows->slope[k] + first;
    return part;
}

#define ALWAYS static inline __attribute__((always_inline))

/* Four basis values at the i-th parameter. */
typedef struct { double b[4]; } Basis;
ALWAYS Basis basis_at(double *const rows[4], int i) {
    return (Basis){{rows[0][i], rows[1][i], rows[2][i], rows[3][i]}};
}

ALWAYS void points_of(const Vec3 row[4], const GridRows *u, Vec3 *restrict out) {
    for (int i = 0; i < u->n; i++) {
        Basis b = basis_at(u->value, i);
        out[i] = bezier_cubic(row, b.b);
    }
}

/* Unit normals. False where bezier_normal would see a pole. */
ALWAYS bool normals_of(const Vec3 row[4], const Vec3 slope[4], const GridRows *u, Vec3 *restrict out) {
    int good = 0;
    for (int i = 0; i < u->n; i++) {
        Basis value = basis_at(u->value, i), steep = basis_at(u->slope, i);
        Vec3 du = bezier_cubic(row, steep.b), dw = bezier_cubic(slope, value.b), c = vec_cross(du, dw);
        double size = vec_len(c);
        good += (size > 1e-9 * (vec_dot(du, du) + vec_dot(dw, dw))) & (size > 0);
        out[i] = vec_scale(c, 1 / size);
    }
    return good == u->n;
}

/* The curve at w->t[j]: its control points, and how they change along w. */
ALWAYS void curve_at(const Patch *patch, const GridRows *w, int j, Vec3 row[4], Vec3 slope[4]) {
    Basis value = basis_at(w->value, j), steep = basis_at(w->slope, j);
    for (int k = 0; k < 4; k++) {
        row[k] = bezier_cubic(patch->p[k], value.b);
        slope[k] = bezier_cubic(patch->p[k], steep.b);
    }
}

ALWAYS void whole_grid(const Patch *patch, const GridRows *u, const GridRows *w, Vec3 *point, Vec3 *normal) {
    Vec3 row[4], slope[4];
    for (int j = 0; j < w->n; j++, point += u->n) {
        curve_at(patch, w, j, row, slope);
        points_of(row, u, point);
        if (!normal) continue;
        bool good = normals_of(row, slope, u, normal);
        for (int i = 0; i < u->n && !good; i++) normal[i] = bezier_normal(patch, u->t[i], w->t[j]);
        normal += u->n;
    }
}

#ifdef VECTORS_ARE_X86
FOR_AVX2 static void avx2_grid(const Patch *patch, const GridRows *u, const GridRows *w, Vec3 *point, Vec3 *normal) {
    whole_grid(patch, u, w, point, normal);
}

FOR_AVX512 static void avx512_grid(const Patch *patch, const GridRows *u, const GridRows *w, Vec3 *point,
                                   Vec3 *normal) {
    whole_grid(patch, u, w, point, normal);
}
#endif

void grid_points(const Patch *patch, const GridRows *u, const GridRows *w, Vec3 *point, Vec3 *normal) {
#ifdef VECTORS_ARE_X86
    Vectors vectors = vectors_pick(u->vectors);
    if (vectors == VECTORS_AVX512) avx512_grid(patch, u, w, point, normal);
    else if (vectors == VECTORS_AVX2) avx2_grid(patch, u, w, point, normal);
    else
#endif
        whole_grid(patch, u, w, point, normal);
}
