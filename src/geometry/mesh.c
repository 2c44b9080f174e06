/* Two small things that every mesh needs: coordinates that survive being written as text, and
   the list of its edges. */
#include "geometry/mesh.h"

enum { BLOCK = 48 };                            /* numbers of sixteen points */
static const double LARGE = 1e9;
static const double WHOLE = 6755399441055744.0; /* 1.5 x 2^52: a sum with it has no fraction bits, nor is it ever -0 */

/* Round x to a whole number of millionths, then divide: both operands are whole numbers below
   2^53, so the quotient is the double nearest to the decimal, which is what strtod returns.
   printf rounds the exact value of x and ties to even. The product p is rounded itself, which
   matters only where it lands on a half: then what the product lost decides. */
double mesh_snap(double x) {
    if (!(fabs(x) < LARGE)) return x;
    double p = x * 1e6, n = (p + WHOLE) - WHOLE, rest = p - n;
    if (rest == 0.5 || rest == -0.5) {
        double high = (double)(float)x, low = x - high; /* 24 and 29 bits: times 1e6 (14 bits) both are exact */
        double lost = (high * 1e6 - p) + low * 1e6;
        if (lost * rest > 0) n += 2 * rest;
    }
    return n / 1e6;
}

Vec3 mesh_snap_point(Vec3 p) {
    return vec(mesh_snap(p.x), mesh_snap(p.y), mesh_snap(p.z));
}

/* mesh_snap without a branch, for a block of numbers times `unit`. False if any of them lands on a half or is too
   large, and so is not what it should be. */
ALWAYS bool snap_block(const double *from, double unit, double *to) {
    int special = 0;
    for (int k = 0; k < BLOCK; k++) {
        double x = from[k] * unit, p = x * 1e6, n = (p + WHOLE) - WHOLE;
        special |= (fabs(p - n) == 0.5) | !(fabs(x) < LARGE);
        to[k] = n / 1e6;
    }
    return !special;
}

ALWAYS void snap_all(const double *from, double unit, int n, double *to) {
    for (int first = 0; first < n; first += BLOCK) {
        double block[BLOCK];
        int count = n - first < BLOCK ? n - first : BLOCK;
        bool whole = count == BLOCK && snap_block(from + first, unit, block);
        for (int k = 0; k < count; k++) to[first + k] = whole ? block[k] : mesh_snap(from[first + k] * unit);
    }
}

#ifdef VECTORS_ARE_X86
FOR_AVX2 static void snap_avx2(const double *from, double unit, int n, double *to) { snap_all(from, unit, n, to); }
FOR_AVX512 static void snap_avx512(const double *from, double unit, int n, double *to) { snap_all(from, unit, n, to); }
#endif

void mesh_snap_points(Vectors vectors, const Vec3 *from, double unit, int n, Vec3 *to) {
    const double *in = &from->x;
    double *out = &to->x;
    vectors = vectors_pick(vectors);
#ifdef VECTORS_ARE_X86
    if (vectors == VECTORS_AVX512) snap_avx512(in, unit, 3 * n, out);
    else if (vectors == VECTORS_AVX2) snap_avx2(in, unit, 3 * n, out);
    else
#endif
        snap_all(in, unit, 3 * n, out);
}

/* The edges at a vertex that have it as their lower end form a list; few enough to search. */
bool mesh_find_edges(Mesh *mesh, Arena *arena, Error *e) {
    size_t sides = 3 * (size_t)mesh->ntriangles;
    Edge *edge = ARENA_NEW(arena, Edge, sides, e);
    int *first = ARENA_NEW(arena, int, mesh->nvertices, e); /* per vertex: edge + 1, 0 = none */
    int *next = ARENA_NEW(arena, int, sides, e);            /* per edge likewise */
    if (!edge || !first || !next) return false;
    int n = 0;
    for (int t = 0; t < mesh->ntriangles; t++) {
        const int *v = mesh->triangle[t].v;
        for (int k = 0; k < 3; k++) {
            int a = v[k], b = v[(k + 1) % 3], low = a < b ? a : b, high = a < b ? b : a, i = first[low];
            if (low == high) continue; /* a side of a collapsed triangle is no edge */
            while (i && edge[i - 1].v[1] != high) i = next[i - 1];
            if (i) continue;
            edge[n] = (Edge){{low, high}};
            next[n] = first[low];
            first[low] = ++n;
        }
    }
    mesh->edge = edge;
    mesh->nedges = n;
    return true;
}
