/* At a fixed w a patch is a cubic along u, whose four control points are cubics along w. These are computed for
   eight w at a time (a block of columns of the grid), and then, for each u, eight points. The compiler makes SIMD
   code of these loops; every sum is taken in the order of bezier_point, so the width of the vectors changes no bit.

   The last block of columns may reach beyond the end of a row. What it writes there belongs to the next row, which
   is written later: rows are done from the first to the last, and blocks from the last to the first. Only after the
   very last row nothing may be written. */
#include "geometry/grid.h"

#include <string.h>

enum { LANES = 8 };

bool grid_rows(int facets, Arena *arena, GridRows *out, Error *e) {
    int n = facets + 1, padded = n + LANES; /* the last parameter again, for lanes beyond it */
    double *all = ARENA_NEW(arena, double, 9 * padded, e);
    *out = (GridRows){.n = n, .t = all};
    if (!all) return false;
    for (int k = 0; k < 4; k++) {
        out->value[k] = all + (1 + k) * padded;
        out->slope[k] = all + (5 + k) * padded;
    }
    for (int i = 0; i < padded; i++) {
        double b[4], d[4];
        out->t[i] = i < n ? (double)i / facets : 1;
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

/* Eight vectors side by side; of these `lanes` are in use, a constant wherever it is inlined. */
typedef struct { double x[LANES], y[LANES], z[LANES]; } Lanes;

ALWAYS Vec3 lane(const Lanes *v, int l) { return vec(v->x[l], v->y[l], v->z[l]); }

/* The cubics of four points at the parameters from j on. */
ALWAYS void cubics(const Vec3 p[4], double *const basis[4], int j, int lanes, Lanes *out) {
    for (int l = 0; l < lanes; l++) {
        Vec3 q = bezier_cubic(p, (double[4]){basis[0][j + l], basis[1][j + l], basis[2][j + l], basis[3][j + l]});
        out->x[l] = q.x, out->y[l] = q.y, out->z[l] = q.z;
    }
}

/* The control points of curves along u, and how they change along w. */
typedef struct { Lanes row[4], slope[4]; } Curves;

/* Basis values at one parameter, and their derivatives. */
typedef struct { double value[4], slope[4]; } Basis;

ALWAYS Basis basis_at(const GridRows *r, int i) {
    return (Basis){{r->value[0][i], r->value[1][i], r->value[2][i], r->value[3][i]},
                   {r->slope[0][i], r->slope[1][i], r->slope[2][i], r->slope[3][i]}};
}

ALWAYS Vec3 at_lane(const Lanes v[4], const double b[4], int l) {
    return bezier_cubic((Vec3[4]){lane(&v[0], l), lane(&v[1], l), lane(&v[2], l), lane(&v[3], l)}, b);
}

ALWAYS void points_at(const Curves *c, const Basis *u, int lanes, Vec3 *restrict out) {
    for (int l = 0; l < lanes; l++) out[l] = at_lane(c->row, u->value, l);
}

/* Unit normals. sure[l] becomes 0 where du x dw is no longer than `least`. */
ALWAYS void normals_at(const Curves *c, const Basis *u, double least, int lanes, Vec3 *restrict out, double *sure) {
    for (int l = 0; l < lanes; l++) {
        Vec3 n = vec_cross(at_lane(c->row, u->slope, l), at_lane(c->slope, u->value, l));
        double size = vec_len(n);
        sure[l] = size > least ? sure[l] : 0;
        out[l] = vec_scale(n, 1 / size);
    }
}

/* Where du x dw is longer than this bezier_normal sees no pole: derivatives are no longer than three times the
   longest step between control points. */
static double longest_at_poles(const Patch *patch) {
    double u = 0, w = 0;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 3; j++) {
            Vec3 down = vec_sub(patch->p[j + 1][i], patch->p[j][i]);
            Vec3 right = vec_sub(patch->p[i][j + 1], patch->p[i][j]);
            u = fmax(u, vec_dot(down, down));
            w = fmax(w, vec_dot(right, right));
        }
    return 1.001 * 1e-9 * 9 * (u + w);
}

/* What is asked for. normal may be NULL. */
typedef struct { const Patch *patch; const GridRows *u, *w; Vec3 *point, *normal; double least; } Grid;

/* The columns from j on. */
ALWAYS void fill_columns(const Grid *g, int j, int lanes) {
    int n = g->w->n, nrows = g->u->n;
    Curves c;
    Vec3 end[LANES];
    double sure[LANES] = {1, 1, 1, 1, 1, 1, 1, 1}, all = 0;
    for (int k = 0; k < 4; k++) {
        cubics(g->patch->p[k], g->w->value, j, lanes, &c.row[k]);
        if (g->normal) cubics(g->patch->p[k], g->w->slope, j, lanes, &c.slope[k]);
    }
    for (int i = 0; i < nrows; i++) {
        int at = i * n + j, left = nrows * n - at;
        Basis u = basis_at(g->u, i);
        points_at(&c, &u, lanes, left < lanes ? end : g->point + at);
        if (left < lanes) memcpy(g->point + at, end, (size_t)left * sizeof *end);
        if (!g->normal) continue;
        normals_at(&c, &u, g->least, lanes, left < lanes ? end : g->normal + at, sure);
        if (left < lanes) memcpy(g->normal + at, end, (size_t)left * sizeof *end);
    }
    for (int l = 0; l < lanes; l++) all += sure[l];
    for (int l = 0; l < lanes && j + l < n && all < lanes; l++)
        for (int i = 0; i < nrows; i++) g->normal[i * n + j + l] = bezier_normal(g->patch, g->u->t[i], g->w->t[j + l]);
}

ALWAYS void fill(const Grid *asked) {
    const Grid here = *asked, *g = &here; /* a copy: the compiler knows that no write to the points changes it */
    int j = g->w->n / LANES * LANES, left = g->w->n - j;
    if (left > LANES / 2) fill_columns(g, j, LANES);
    else if (left > 0) fill_columns(g, j, LANES / 2);
    while ((j -= LANES) >= 0) fill_columns(g, j, LANES);
}

static void plain_fill(const Grid *g) { fill(g); }

#ifdef VECTORS_ARE_X86
FOR_AVX2 static void avx2_fill(const Grid *g) { fill(g); }
FOR_AVX512 static void avx512_fill(const Grid *g) { fill(g); }
#endif

void grid_points(const Patch *patch, const GridRows *u, const GridRows *w, Vec3 *point, Vec3 *normal) {
    Grid g = {patch, u, w, point, normal, normal ? longest_at_poles(patch) : 0};
    void (*run)(const Grid *g) = plain_fill;
#ifdef VECTORS_ARE_X86
    Vectors vectors = vectors_pick(u->vectors);
    if (vectors != VECTORS_PLAIN) run = vectors == VECTORS_AVX512 ? avx512_fill : avx2_fill;
#endif
    run(&g);
}
