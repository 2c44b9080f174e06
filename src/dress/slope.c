/* An edge may grow to STRETCH times what it measures in the bind pose. Where nothing is pressed in, it may already be
   longer than that; then it may not grow further. So along each edge there is a most by which one of its vertices
   may be deeper than the other, and the deepest hollow of which that is true everywhere is found by making vertices
   shallower, one after the other, until nothing changes: it does not depend on their order. */
#include "dress/slope.h"

#include <string.h>

enum { ROUNDS_MAX = 200 };
static const double STRETCH = 2.3; /* 2.5 is asked: the rest is for offsets, and for hollows of two arms in one place */
static const double SHRINKS = 0.8; /* a vertex that moves towards its neighbour comes no nearer than this share of the
                                      way: cloth must not fold over */

bool slopes_reserve(Slopes *s, const Lattice *lattice, Arena *arena, Error *e) {
    int edges = lattice_edges(lattice);
    *s = (Slopes){.slope = ARENA_NEW(arena, Slope, edges, e)};
    s->first_beside = ARENA_NEW(arena, int, lattice->nplaces + 1, e);
    s->beside = ARENA_NEW(arena, int, 2 * edges, e);
    return s->slope && s->first_beside && s->beside;
}

/* Counts the edges of each vertex, then lists their other ends. */
static void list_beside(Slopes *s, const Sheet *sheet) {
    int *first = s->first_beside;
    memset(first, 0, ((size_t)sheet->nvertices + 1) * sizeof *first);
    for (int k = 0; k < 2 * sheet->nedges; k++) first[sheet->edge[k / 2].v[k % 2]]++;
    for (int v = 1; v <= sheet->nvertices; v++) first[v] += first[v - 1];
    for (int k = 0; k < 2 * sheet->nedges; k++)
        s->beside[--first[sheet->edge[k / 2].v[k % 2]]] = sheet->edge[k / 2].v[1 - k % 2];
    s->made = sheet->made;
}

const int *slopes_beside(Slopes *s, const Sheet *sheet, int vertex, int *n) {
    if (s->made != sheet->made) list_beside(s, sheet);
    *n = s->first_beside[vertex + 1] - s->first_beside[vertex];
    return s->beside + s->first_beside[vertex];
}

/* The longest that an edge may be. */
static double longest(const Push *p, int a, int b) {
    int at = p->sheet->place[a], other = p->sheet->place[b];
    Vec3 undented = vec_sub(vec_sub(p->point[b], field_dent(&p->field, other)),
                            vec_sub(p->point[a], field_dent(&p->field, at)));
    return fmax(STRETCH * vec_dist(p->escape.rest[at], p->escape.rest[other]), vec_len(undented));
}

/* The largest t for which |to - t by| <= most; if there is none, that for which it is least. */
static double furthest(Vec3 to, Vec3 by, double most) {
    double towards = vec_dot(to, by), by2 = vec_dot(by, by), to2 = vec_dot(to, to);
    return (towards + sqrt(fmax(0, towards * towards + by2 * (most * most - to2)))) / by2;
}

/* By how much a vertex may be deeper than its neighbour, metres. */
static double step_between(const Push *p, Vec3 way, int deep, int other, double most) {
    Vec3 to = vec_sub(p->point[other], p->point[deep]);
    double step = furthest(to, way, most), towards = vec_dot(way, to), shrinks = SHRINKS * vec_dot(to, to);
    return step * towards > shrinks ? shrinks / towards : step;
}

/* The share that a limb has in what is pressed in at an edge. If each hollow keeps to its share of the steps that one
   alone may make, the sum of all is between edges that are short enough, and so short enough as well. */
static double share_of(double *const wanted[LIMBS], Limb limb, int a, int b) {
    double all = 0;
    for (int k = 0; k < LIMBS; k++) all += fmax(wanted[k][a], wanted[k][b]);
    return fmax(wanted[limb][a], wanted[limb][b]) / all;
}

/* The edges in and round the hollow: depths elsewhere are 0 and stay so. */
static int find_slopes(Slopes *s, const Push *p, Limb limb, double *const wanted[LIMBS]) {
    Vec3 way = p->field.way[limb];
    int n = 0;
    for (int k = 0; k < p->sheet->nedges; k++) {
        int a = p->sheet->edge[k].v[0], b = p->sheet->edge[k].v[1];
        if (wanted[limb][a] <= 0 && wanted[limb][b] <= 0) continue;
        double most = longest(p, a, b), share = share_of(wanted, limb, a, b);
        double a_to_b = share * step_between(p, way, a, b, most), b_to_a = share * step_between(p, way, b, a, most);
        s->slope[n++] = (Slope){{a, b}, {a_to_b, b_to_a}};
    }
    return n;
}

static bool lower(double *depth, double most) {
    if (*depth <= most) return false;
    *depth = most;
    return true;
}

bool slopes_level(Slopes *s, const Push *p, Limb limb, double *const wanted[LIMBS], double *depth) {
    int n = find_slopes(s, p, limb, wanted);
    bool moved = true;
    for (int round = 0; round < ROUNDS_MAX && moved; round++) {
        moved = false;
        for (int k = 0; k < n; k++) {
            const Slope *at = &s->slope[round % 2 ? n - 1 - k : k];
            double *a = &depth[at->v[0]], *b = &depth[at->v[1]];
            moved |= lower(a, *b + at->step[0]) || lower(b, *a + at->step[1]);
        }
    }
    return !moved;
}

double slopes_share(Slopes *s, const Push *p, int vertex, Vec3 by) {
    int n;
    const int *beside = slopes_beside(s, p->sheet, vertex, &n);
    double share = 1;
    for (int k = 0; k < n; k++) {
        Vec3 to = vec_sub(p->point[beside[k]], p->point[vertex]);
        share = fmin(share, furthest(to, by, longest(p, vertex, beside[k])));
    }
    return fmax(share, 0);
}

double slopes_keeps(const Push *p, int vertex, int beside) {
    Vec3 dent = field_dent(&p->field, p->sheet->place[vertex]), to = vec_sub(p->point[beside], p->point[vertex]);
    double most = longest(p, vertex, beside);
    if (field_is_zero(dent) || vec_dot(to, to) <= most * most) return 1;
    return clamp(furthest(vec_add(to, dent), dent, most), 0, 1);
}
