/* Body edges against garment triangles: a leg through a skirt, finer and finer. Everything is built
   anew each time, as each frame does. */
#include "geometry/crossing.h"

#include <math.h>

#include "bench.h"

enum { FOUND_MAX = 1 << 16 };

typedef struct {
    Mesh body, cloth;
    CrossingSet edges, triangles;
    Crossing *found;
    CrossingCount count;
    int hits; /* by the paper's test */
} Legs;

/* A tube about a line parallel to y, narrower at one end. */
static Mesh tube(Arena *arena, Error *e, int columns, int rows, Vec3 foot, double low, double high, double length) {
    Mesh m = {.nvertices = columns * (rows + 1), .ntriangles = 2 * columns * rows};
    m.position = ARENA_NEW(arena, Vec3, m.nvertices, e);
    m.triangle = ARENA_NEW(arena, Triangle, m.ntriangles, e);
    bench_need(m.position && m.triangle, e);
    for (int r = 0, n = 0; r <= rows; r++)
        for (int c = 0; c < columns; c++) {
            double angle = 2 * PI * c / columns, t = (double)r / rows, radius = low + (high - low) * t;
            m.position[r * columns + c] = vec_add(foot, vec(radius * cos(angle), length * t, radius * sin(angle)));
            if (r == rows) continue;
            int a = r * columns + c, d = r * columns + (c + 1) % columns;
            m.triangle[n++] = (Triangle){{a, d, d + columns}};
            m.triangle[n++] = (Triangle){{a, d + columns, a + columns}};
        }
    bench_need(mesh_find_edges(&m, arena, e), e);
    return m;
}

/* About so many edges and triangles; facets are as wide as high. */
static Legs make_legs(Arena *arena, int edges, int triangles) {
    Legs l = {0};
    Error e = {0};
    int round = (int)sqrt(edges / 3.0 / 2), columns = (int)sqrt(triangles / 2.0 * 1.3);
    l.body = tube(arena, &e, round, edges / 3 / round, vec(0, 0, 0), 0.06, 0.10, 0.9);
    l.cloth = tube(arena, &e, columns, triangles / 2 / columns, vec(0.02, 0.2, 0.03), 0.25, 0.10, 0.8);
    l.found = ARENA_NEW(arena, Crossing, FOUND_MAX, &e);
    bench_need(l.found && crossing_reserve(&l.edges, l.body.nedges, arena, &e) &&
               crossing_reserve(&l.triangles, l.cloth.ntriangles, arena, &e), &e);
    return l;
}

static void build_and_find(void *context) {
    Legs *l = context;
    l->count = (CrossingCount){0};
    crossing_build_edges(&l->edges, l->body.position, l->body.edge, l->body.nedges);
    crossing_build_triangles(&l->triangles, l->cloth.position, l->cloth.triangle, l->cloth.ntriangles);
    crossing_find(&l->edges, &l->triangles, l->found, FOUND_MAX, &l->count);
}

/* [a, b, c, d] of the paper's equation (2): the second index is the base point. */
static inline double product(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    return vec_dot(vec_sub(a, b), vec_cross(vec_sub(c, b), vec_sub(d, b)));
}

/* The paper's test, equations (2) to (4), over all pairs. All in one place, so that the compiler
   takes what depends on the triangle alone out of the inner loop. */
static void all_pairs(void *context) {
    Legs *l = context;
    l->hits = 0;
    for (int t = 0; t < l->cloth.ntriangles; t++) {
        const int *k = l->cloth.triangle[t].v;
        Vec3 v0 = l->cloth.position[k[0]], v1 = l->cloth.position[k[1]], v2 = l->cloth.position[k[2]];
        for (int i = 0; i < l->body.nedges; i++) {
            Vec3 a = l->body.position[l->body.edge[i].v[0]], b = l->body.position[l->body.edge[i].v[1]];
            double sa = product(a, v0, v1, v2), sb = product(b, v0, v1, v2);
            if (sa * sb > 0) continue;
            double s01 = product(a, b, v0, v1), s12 = product(a, b, v1, v2), s20 = product(a, b, v2, v0);
            l->hits += (sa >= 0 && sb <= 0 && s01 >= 0 && s12 >= 0 && s20 >= 0) ||
                       (sa <= 0 && sb >= 0 && s01 <= 0 && s12 <= 0 && s20 <= 0);
        }
    }
}

static Timing time_with(Legs *l, Vectors vectors) {
    l->edges.vectors = l->triangles.vectors = vectors;
    return bench_time(build_and_find, l);
}

static void compare(Bench *b, const char *scene, int edges, int triangles, double asked) {
    static const char *const names[] = {"crossing", "crossing; plain C", "crossing; AVX2", "crossing; AVX-512"};
    Arena arena = {0};
    Legs l = make_legs(&arena, edges, triangles);
    Timing base = bench_time(all_pairs, &l);
    for (Vectors vectors = VECTORS_BEST; vectors < VECTORS_COUNT; vectors++) {
        if (!vectors_usable(vectors)) continue;
        Timing time = time_with(&l, vectors);
        bench_need(l.hits == l.count.hits, &(Error){.text = "the paper's test finds other pairs"});
        bench_enter(b, (BenchRow){scene, names[vectors], l.count.pairs_all, "pairs", time, "the paper's all pairs",
                                  base, vectors == VECTORS_BEST ? asked : 0});
    }
    arena_free(&arena);
}

/* Time against the number of edges, of triangles, and of both; the share of them that meet stays the same. */
static void growth(Bench *b) {
    enum { LEAST = 2000, MOST = 64000, FIXED = 8000 };
    static const char *const what[] = {"crossing; edges", "crossing; triangles", "crossing; both"};
    for (int kind = 0; kind < 3; kind++) {
        BenchSeries s = {.what = what[kind], .unit = kind == 0 ? "edges" : kind == 1 ? "triangles" : "both",
                         .most = kind == 2 ? 1.1 : 0};
        for (int size = LEAST; size <= MOST; size *= 2) {
            Arena arena = {0};
            Legs l = make_legs(&arena, kind == 1 ? FIXED : size, kind == 0 ? FIXED : size);
            int items = (kind != 1 ? l.body.nedges : 0) + (kind != 0 ? l.cloth.ntriangles : 0);
            bench_add(&s, items, time_with(&l, VECTORS_BEST).least);
            arena_free(&arena);
        }
        bench_series(b, &s);
    }
}

void bench_crossing(Bench *b) {
    compare(b, "paper", 4000, 4096, 0);
    compare(b, "middle", 10000, 2000, 900);
    compare(b, "production", 20000, 20000, 4000);
    growth(b);
}
