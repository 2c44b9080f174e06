/* Two passes, each linear: a hash table of coordinates joins the vertices, then the sides are
   put into buckets by their lower end and each small bucket is sorted. */
#include "geometry/topology.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static uint64_t bits(double x) {
    uint64_t u;
    x += 0.0; /* -0 and 0 are one place */
    memcpy(&u, &x, sizeof u);
    return u;
}

/* The upper bits of a product depend on all bits of its factors, so they are the ones to take. */
static uint64_t hash(Vec3 p) {
    uint64_t h = bits(p.x) * 0x9E3779B97F4A7C15u;
    h = ((h ^ h >> 32) + bits(p.y)) * 0xBF58476D1CE4E5B9u;
    return ((h ^ h >> 32) + bits(p.z)) * 0x94D049BB133111EBu;
}

static bool same_place(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

static bool join_vertices(const Mesh *mesh, Arena *arena, int *joined, Error *e) {
    size_t size = 16;
    int shift = 60;
    for (; size < 2 * (size_t)mesh->nvertices; size *= 2) shift--;
    int *slot = ARENA_NEW(arena, int, size, e); /* vertex + 1; 0 is free */
    if (!slot) return false;
    for (int v = 0; v < mesh->nvertices; v++) {
        size_t at = (size_t)(hash(mesh->position[v]) >> shift);
        while (slot[at] && !same_place(mesh->position[slot[at] - 1], mesh->position[v])) at = (at + 1) & (size - 1);
        if (!slot[at]) slot[at] = v + 1;
        joined[v] = slot[at] - 1;
    }
    return true;
}

/* Side c of triangle t; false where it has no length. */
static bool side_of(const Mesh *mesh, const int *joined, int t, int c, Side *out) {
    int a = joined[mesh->triangle[t].v[c]], b = joined[mesh->triangle[t].v[(c + 1) % 3]];
    *out = a < b ? (Side){a, b, t, 1} : (Side){b, a, t, -1};
    return a != b;
}

static int by_edge(const void *a, const void *b) {
    const Side *s = a, *t = b;
    if (s->high != t->high) return s->high < t->high ? -1 : 1;
    if (s->triangle != t->triangle) return s->triangle < t->triangle ? -1 : 1;
    return s->way - t->way;
}

/* A bucket mostly holds the few edges that meet in a vertex, nearly in order: insertion. Where thousands do, that would
   take their square. */
static void sort_bucket(Side *side, int n) {
    enum { FEW = 1000 };
    if (n > FEW) {
        qsort(side, (size_t)n, sizeof *side, by_edge);
        return;
    }
    for (int i = 1; i < n; i++) {
        Side s = side[i];
        int k = i;
        for (; k > 0 && side[k - 1].high > s.high; k--) side[k] = side[k - 1];
        side[k] = s;
    }
}

bool topology_find(const Mesh *mesh, const bool *wanted, Arena *arena, Topology *out, Error *e) {
    int n = mesh->nvertices;
    out->joined = ARENA_NEW(arena, int, n, e);
    out->side = ARENA_NEW(arena, Side, 3 * (size_t)mesh->ntriangles, e);
    out->nsides = 0;
    int *end = ARENA_NEW(arena, int, n + 1, e); /* of each bucket, in the end */
    if (!out->joined || !out->side || !end || !join_vertices(mesh, arena, out->joined, e)) return false;
    Side s;
    for (int t = 0; t < mesh->ntriangles; t++)
        for (int c = 0; c < 3 && (!wanted || wanted[t]); c++)
            if (side_of(mesh, out->joined, t, c, &s)) end[s.low + 1]++, out->nsides++;
    for (int v = 0; v < n; v++) end[v + 1] += end[v];
    for (int t = 0; t < mesh->ntriangles; t++)
        for (int c = 0; c < 3 && (!wanted || wanted[t]); c++)
            if (side_of(mesh, out->joined, t, c, &s)) out->side[end[s.low]++] = s;
    for (int v = 0, first = 0; v < n; first = end[v++]) sort_bucket(out->side + first, end[v] - first);
    return true;
}

int topology_run(const Topology *t, int i) {
    int n = 1;
    while (i + n < t->nsides && t->side[i + n].low == t->side[i].low && t->side[i + n].high == t->side[i].high) n++;
    return n;
}
