/* crossing_find against the plain loop over all pairs, from which it may differ in speed and
   in nothing else; and on every kind of vectors that this machine has. */
#include "geometry/crossing.h"

#include <stdlib.h>
#include <string.h>

#include "base/thread.h"
#include "geometry/predicate.h"
#include "dice.h"
#include "tap.h"

enum { VERTICES = 6000, ITEMS = 6000, HITS = 100000 };

/* The sets are reserved once and built again for each scene, larger and smaller by turns. */
typedef struct {
    int nedges, ntriangles;
    Vec3 *v, *w; /* vertices of the edges and of the triangles */
    Edge *edge;
    Triangle *triangle;
    CrossingSet edges, triangles;
    Crossing *found, *expected;
    int scenes, hits, wrong_hits, wrong_counts, wrong_order, wrong_capacity, wrong_vectors, wrong_plain;
} Bench;

static bool bench_make(Bench *b, Arena *arena, Error *e) {
    *b = (Bench){.v = ARENA_NEW(arena, Vec3, VERTICES, e), .w = ARENA_NEW(arena, Vec3, VERTICES, e)};
    b->edge = ARENA_NEW(arena, Edge, ITEMS, e);
    b->triangle = ARENA_NEW(arena, Triangle, ITEMS, e);
    b->found = ARENA_NEW(arena, Crossing, 2 * HITS + 1, e);
    b->expected = ARENA_NEW(arena, Crossing, HITS, e);
    return b->v && b->w && b->edge && b->triangle && b->found && b->expected
        && crossing_reserve(&b->edges, ITEMS, arena, e) && crossing_reserve(&b->triangles, ITEMS, arena, e);
}

/* --- the definition --- */

static bool axis_overlaps(double p, double q, double a, double b, double c) {
    double low1 = p < q ? p : q, high1 = p < q ? q : p;
    double low2 = a < b ? a : b, high2 = a < b ? b : a;
    low2 = c < low2 ? c : low2, high2 = c > high2 ? c : high2;
    return (float)low1 <= (float)high2 && (float)low2 <= (float)high1;
}

static int every_pair(Bench *b, CrossingCount *count) {
    int n = 0;
    for (int t = 0; t < b->ntriangles; t++)
        for (int i = 0; i < b->nedges; i++) {
            const int *k = b->edge[i].v, *m = b->triangle[t].v;
            Vec3 p = b->v[k[0]], q = b->v[k[1]], x = b->w[m[0]], y = b->w[m[1]], z = b->w[m[2]];
            count->pairs_all++;
            if (axis_overlaps(p.x, q.x, x.x, y.x, z.x) && axis_overlaps(p.y, q.y, x.y, y.y, z.y)
                && axis_overlaps(p.z, q.z, x.z, y.z, z.z))
                count->pairs_tested++;
            if (!predicate_segment_triangle(p, q, x, y, z)) continue;
            if (n == HITS) abort();
            b->expected[n++] = (Crossing){i, t};
            count->hits++;
        }
    return n;
}

static int by_index(const void *a, const void *b) {
    const Crossing *x = a, *y = b;
    return x->triangle != y->triangle ? (x->triangle > y->triangle) - (x->triangle < y->triangle)
                                      : (x->edge > y->edge) - (x->edge < y->edge);
}

static bool same_count(CrossingCount a, CrossingCount b) {
    return a.pairs_all == b.pairs_all && a.pairs_tested == b.pairs_tested && a.hits == b.hits;
}

/* Is found with these vectors what is in b->found already, in the same order, with the same counts? */
static bool same_with(Bench *b, Vectors vectors, CrossingCount wanted) {
    CrossingCount count = {0};
    b->edges.vectors = b->triangles.vectors = vectors;
    crossing_build_edges(&b->edges, b->v, b->edge, b->nedges);
    crossing_build_triangles(&b->triangles, b->w, b->triangle, b->ntriangles);
    Crossing *found = b->found + wanted.hits;
    int n = crossing_find(&b->edges, &b->triangles, found, HITS, &count);
    b->edges.vectors = b->triangles.vectors = VECTORS_BEST;
    return n == wanted.hits && same_count(count, wanted) && memcmp(found, b->found, (size_t)n * sizeof *found) == 0;
}

static bool same_plainly(Bench *b, CrossingCount wanted) {
    CrossingCount count = {0};
    Crossing *found = b->found + wanted.hits;
    int n = crossing_find_plainly(&b->edges, &b->triangles, found, HITS, &count);
    qsort(found, (size_t)n, sizeof *found, by_index);
    return n == wanted.hits && count.pairs_tested == wanted.pairs_all
        && memcmp(found, b->expected, (size_t)n * sizeof *found) == 0;
}

static void check(Bench *b) {
    CrossingCount wanted = {0}, count = {0}, again = {0};
    int n = every_pair(b, &wanted);
    crossing_build_edges(&b->edges, b->v, b->edge, b->nedges);
    crossing_build_triangles(&b->triangles, b->w, b->triangle, b->ntriangles);
    int found = crossing_find(&b->edges, &b->triangles, b->found, HITS, &count);
    b->scenes++;
    b->hits += n;
    b->wrong_counts += !same_count(count, wanted);

    int room = (int)dice_below((unsigned)n + 1);
    static const Crossing mark = {-1, -1};
    Crossing *part = b->found + n;
    part[room] = mark;
    int written = crossing_find(&b->edges, &b->triangles, part, room, &again);
    b->wrong_capacity += written != room || !same_count(again, wanted) || part[room].edge != -1;
    b->wrong_order += memcmp(part, b->found, (size_t)room * sizeof *part) != 0;

    for (Vectors v = VECTORS_PLAIN; v < VECTORS_COUNT; v++)
        if (vectors_usable(v)) b->wrong_vectors += !same_with(b, v, wanted);
    b->wrong_plain += !same_plainly(b, wanted);

    qsort(b->found, (size_t)found, sizeof *b->found, by_index);
    b->wrong_hits += found != n || memcmp(b->found, b->expected, (size_t)n * sizeof *b->found) != 0;
}

static void report(Bench *b, const char *what) {
    OK(b->wrong_hits == 0, "%s: the hits of all pairs (%d scenes, %d hits)", what, b->scenes, b->hits);
    OK(b->wrong_counts == 0, "%s: pairs tested are those whose boxes overlap", what);
    OK(b->wrong_order == 0, "%s: the same order every time", what);
    OK(b->wrong_capacity == 0, "%s: no more is written than there is room for, all is counted", what);
    OK(b->wrong_vectors == 0, "%s: the same on every kind of vectors", what);
    OK(b->wrong_plain == 0, "%s: the same without culling", what);
    b->wrong_vectors = b->wrong_plain = 0;
    b->scenes = b->hits = b->wrong_hits = b->wrong_counts = b->wrong_order = b->wrong_capacity = 0;
}

/* --- scenes --- */

/* n items of nearby random vertices, two neighbours sharing some. */
static void soup(Bench *b, int nedges, int ntriangles, double size, Vec3 origin) {
    b->nedges = nedges;
    b->ntriangles = ntriangles;
    for (int i = 0; i < VERTICES; i++) {
        Vec3 p = vec_add(origin, dice_point()), q = vec_add(origin, dice_point());
        b->v[i] = i % 3 ? vec_mad(b->v[i - 1], vec_sub(p, origin), size) : p;
        b->w[i] = i % 3 ? vec_mad(b->w[i - 1], vec_sub(q, origin), size) : q;
    }
    for (int i = 0; i < nedges; i++) b->edge[i] = (Edge){{i % (VERTICES - 1), i % (VERTICES - 1) + 1}};
    for (int i = 0; i < ntriangles; i++) {
        int k = i % (VERTICES - 2);
        b->triangle[i] = (Triangle){{k, k + 2, k + 1}};
    }
}

static void test_soups(Bench *b) {
    static const int size[] = {0, 1, 2, 15, 16, 17, 31, 255, 256, 257, 700};
    enum { SIZES = sizeof size / sizeof size[0] };
    for (int i = 0; i < SIZES; i++)
        for (int j = 0; j < SIZES; j++) soup(b, size[i], size[j], 0.3, vec(-0.5, -0.5, -0.5)), check(b);
    soup(b, 4097, 40, 0.1, vec(0, 0, 0)), check(b);
    soup(b, 40, 4097, 0.1, vec(0, 0, 0)), check(b);
    soup(b, 3, 3, 0.1, vec(0, 0, 0)), check(b);
    soup(b, 6000, 300, 0.02, vec(0, 0, 0)), check(b);
    report(b, "random soups");
}

/* Far from the origin a float sees little: the count grows, no hit may be lost. */
static void test_far(Bench *b) {
    for (int i = 0; i < 8; i++) soup(b, 500, 300, 0.2, vec(ldexp(1, 4 * i), -ldexp(1, 3 * i), 10)), check(b);
    report(b, "far from the origin");
    static const double scale[] = {1e-30, 1e-12, 1e-3, 1e3, 1e12, 1e30};
    for (int k = 0; k < 6; k++) {
        soup(b, 300, 300, 0.3, vec(-0.5, -0.5, -0.5));
        for (int i = 0; i < VERTICES; i++) {
            b->v[i] = vec_scale(b->v[i], scale[k]);
            b->w[i] = vec_scale(b->w[i], scale[k]);
        }
        check(b);
    }
    report(b, "any scale");
}

static Vec3 on_grid(unsigned side) { return vec(dice_below(side), dice_below(side), dice_below(side)); }

/* Whole-number vertices used by many items: nearly every pair that meets only touches. */
static void test_grid(Bench *b) {
    for (int n = 0; n < 40; n++) {
        unsigned side = 2 + dice_below(6);
        b->nedges = 200, b->ntriangles = 200;
        for (int i = 0; i < 300; i++) {
            b->v[i] = vec_scale(on_grid(side), n % 2 ? 1 : 0.1);
            b->w[i] = dice_below(2) ? b->v[i] : vec_scale(on_grid(side), n % 2 ? 1 : 0.1);
        }
        for (int i = 0; i < 200; i++) {
            b->edge[i] = (Edge){{(int)dice_below(300), (int)dice_below(300)}};
            b->triangle[i] = (Triangle){{(int)dice_below(300), (int)dice_below(300), (int)dice_below(300)}};
        }
        check(b);
    }
    report(b, "touching, coplanar and collapsed items");
}

/* Thin triangles, and edges that end as near to their planes as doubles come: what the float
   sieve must let through. */
static void test_near_planes(Bench *b) {
    for (int n = 0; n < 20; n++) {
        Vec3 far = vec(n % 4 * 10, 0, n % 5);
        soup(b, 600, 300, 0.3, far);
        for (int t = 0; t < 300; t++) {
            int *k = b->triangle[t].v;
            k[0] = 3 * t, k[1] = 3 * t + 1, k[2] = 3 * t + 2;
            Vec3 *w = b->w + 3 * t;
            Vec3 aside = vec_scale(dice_point(), ldexp(1, -2 * (t % 20)));
            if (t % 2) w[2] = vec_add(vec_lerp(w[0], w[1], dice_unit()), aside);
            for (int i = 0; i < 2; i++) {
                int end = 4 * t + 2 * i;
                b->v[end] = vec_lerp(vec_lerp(w[0], w[1], dice_unit()), w[2], dice_unit());
                b->v[end + 1] = vec_add(far, dice_point());
                b->edge[2 * t + i] = (Edge){{end, end + 1}};
            }
        }
        check(b);
    }
    report(b, "edges that end in the plane of a thin triangle");
}

/* A tube of rows x columns quads about the y axis, its radius wavy. */
static int tube(Vec3 *v, Triangle *t, int columns, int rows, double radius, double wave) {
    int n = 0;
    for (int r = 0; r <= rows; r++)
        for (int c = 0; c < columns; c++) {
            double angle = 2 * PI * c / columns, here = radius + wave * sin(5 * angle) * r / rows;
            v[r * columns + c] = vec(here * cos(angle), (double)r / rows, here * sin(angle));
        }
    for (int r = 0; r < rows; r++)
        for (int c = 0; c < columns; c++) {
            int a = r * columns + c, d = r * columns + (c + 1) % columns;
            t[n++] = (Triangle){{a, d, d + columns}};
            t[n++] = (Triangle){{a, d + columns, a + columns}};
        }
    return n;
}

static void test_meshes(Bench *b, Arena *arena, Error *e) {
    Mesh body = {.nvertices = 24 * 31, .position = b->v, .triangle = b->triangle};
    for (int n = 0; n < 4; n++) {
        body.ntriangles = tube(b->v, b->triangle, 24, 30, 0.15, 0);
        if (!mesh_find_edges(&body, arena, e)) abort();
        b->nedges = body.nedges;
        memcpy(b->edge, body.edge, (size_t)body.nedges * sizeof(Edge));
        b->ntriangles = tube(b->w, b->triangle, n == 3 ? 24 : 20, n == 3 ? 30 : 12, n == 3 ? 0.15 : 0.152, 0.004 * n);
        check(b);
    }
    report(b, "a wavy tube round a tube, and a tube in its own place");
}

/* --- threads --- */

enum { SEARCHES = 4, TIMES = 200 };

typedef struct { Bench *b; int hits, wrong[SEARCHES]; } Crowd;

static void search_among(void *context, int item) {
    Crowd *c = context;
    CrossingCount count = {0};
    Crossing *found = c->b->found + item * c->hits;
    int n = crossing_find(&c->b->edges, &c->b->triangles, found, c->hits, &count);
    c->wrong[item] += n != c->hits || memcmp(found, c->b->expected, (size_t)n * sizeof *found) != 0;
}

/* The first `skipped` items are left out, so that sixteen others share a tile. */
static void build_without(Bench *b, int skipped) {
    crossing_build_edges(&b->edges, b->v, b->edge + skipped, b->nedges - skipped);
    crossing_build_triangles(&b->triangles, b->w, b->triangle + skipped, b->ntriangles - skipped);
}

/* The sets of the last scene, built anew and searched by several at once, again and again. */
static void test_threads(Bench *b, Error *e) {
    CrossingCount count = {0};
    Crowd crowd = {.b = b, .hits = crossing_find(&b->edges, &b->triangles, b->expected, HITS / SEARCHES, &count)};
    int wrong = 0;
    for (int k = 0; k < TIMES; k++) {
        build_without(b, 1);
        crossing_find(&b->edges, &b->triangles, b->found, HITS, &count);
        build_without(b, 0);
        if (!thread_each(SEARCHES, search_among, &crowd, e)) abort();
    }
    for (int i = 0; i < SEARCHES; i++) wrong += crowd.wrong[i];
    OK(wrong == 0 && crowd.hits > 100, "%d threads that search at once find the same (%d hits)", SEARCHES, crowd.hits);
}

int main(void) {
    Arena arena = {0};
    Error e = {0};
    Bench b;
    if (!OK(bench_make(&b, &arena, &e), "memory is reserved")) return tap_done();
    printf("# AVX2: %s, AVX-512: %s\n", vectors_usable(VECTORS_AVX2) ? "yes" : "not on this machine",
           vectors_usable(VECTORS_AVX512) ? "yes" : "not on this machine");
    test_soups(&b);
    test_far(&b);
    test_grid(&b);
    test_near_planes(&b);
    test_meshes(&b, &arena, &e);
    test_threads(&b, &e);
    CrossingSet set;
    arena.fail_after = 3;
    OK(!crossing_reserve(&set, 100, &arena, &e) && e.kind == ERR_INTERNAL, "no memory is an error, not a crash");
    arena_free(&arena);
    return tap_done();
}
