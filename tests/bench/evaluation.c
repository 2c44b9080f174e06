/* Points and normals of a patch on a grid, against the Bernstein form point by point. */
#include "bench.h"
#include "geometry/grid.h"

enum { FACETS = 32, POINTS = (FACETS + 1) * (FACETS + 1) };

typedef struct { Patch patch; GridRows rows; Vec3 *point, *normal; } Cloth;

static void on_the_grid(void *context) {
    Cloth *c = context;
    grid_points(&c->patch, &c->rows, &c->rows, c->point, c->normal);
}

static void point_by_point(void *context) {
    Cloth *c = context;
    for (int j = 0, k = 0; j <= FACETS; j++)
        for (int i = 0; i <= FACETS; i++, k++) {
            double u = (double)i / FACETS, w = (double)j / FACETS;
            c->point[k] = bezier_point(&c->patch, u, w, NULL, NULL);
            c->normal[k] = bezier_normal(&c->patch, u, w);
        }
}

void bench_evaluation(Bench *b) {
    Arena arena = {0};
    Error e = {0};
    Cloth c = {.point = ARENA_NEW(&arena, Vec3, POINTS, &e), .normal = ARENA_NEW(&arena, Vec3, POINTS, &e)};
    bench_need(c.point && c.normal && grid_rows(FACETS, &arena, &c.rows, &e), &e);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) c.patch.p[i][j] = vec(0.3 * i, 0.3 * j, 0.1 * ((i * j) % 3));
    Timing base = bench_time(point_by_point, &c), time = bench_time(on_the_grid, &c);
    bench_enter(b, (BenchRow){"paper", "evaluation with normals", POINTS, "points", time, "the Bernstein form", base,
                              15});
    arena_free(&arena);
}
