/* mesh_snap against printf and strtod, the edge list against the definition. */
#include "geometry/mesh.h"

#include <stdlib.h>
#include <string.h>

#include "dice.h"
#include "tap.h"

static bool as_written(double x) {
    char text[64];
    snprintf(text, sizeof text, "%.6f", x);
    double s = mesh_snap(x);
    return s == strtod(text, NULL) && !(s == 0 && signbit(s));
}

static int count_bad(double (*make)(int), int n) {
    int bad = 0;
    for (int i = 0; i < n; i++) {
        double x = make(i);
        bad += !as_written(x) || !as_written(-x) || mesh_snap(mesh_snap(x)) != mesh_snap(x);
    }
    return bad;
}

static double metres(int i) { return (void)i, dice_unit() * 4; }
static double any_size(int i) { return ldexp(dice_unit(), i % 61 - 31); } /* up to 5e8 */
static double tiny(int i) { return ldexp(dice_unit(), -20 - i % 1050); }
static double tie(int i) { return (2 * i + 1) / 128.0; }             /* an exact half of a millionth */
static double near_half(int i) {
    double half = (dice_below(1000000000) + 0.5) / 1e6;
    return i % 3 == 0 ? half : nextafter(half, i % 3 == 1 ? 0 : 1e9);
}
static double large_half(int i) { return 9e8 + dice_below(1000000) + ((double)(i % 1000) + 0.5) / 1e6; }
static double written(int i) { return (double)i / 1e6; }

static void test_snap(void) {
    OK(count_bad(metres, 200000) == 0, "mesh_snap is %%.6f and strtod on metres");
    OK(count_bad(any_size, 200000) == 0, "on any size up to 1e9");
    OK(count_bad(tiny, 5000) == 0, "on the smallest");
    OK(count_bad(tie, 100000) == 0, "on exact halves, which go to the even millionth");
    OK(count_bad(near_half, 200000) == 0, "on halves that doubles just miss");
    OK(count_bad(large_half, 100000) == 0, "and large ones");
    OK(count_bad(written, 200000) == 0, "what was written stays as it is");
    OK(mesh_snap(1 / 128.0) == 0.007812, "0.0078125 is 0.007812");
    OK(mesh_snap(3 / 128.0) == 0.023438, "0.0234375 is 0.023438");
    OK(!signbit(mesh_snap(-0.0000001)) && !signbit(mesh_snap(-0.0)), "never -0");
}

/* Many at a time, in place, with any vectors: each as alone. Every block of some has one that lands on a half. */
static void test_snap_many(void) {
    enum { N = 100 };
    Vec3 from[N], to[N];
    for (Vectors v = VECTORS_BEST; v < VECTORS_COUNT; v++) {
        int wrong = 0;
        for (int round = 0; vectors_usable(v) && round < 100; round++) {
            double scale = round % 4 == 0 ? 1 : 39.37, large = round % 4 == 2 ? 1e9 : 1;
            for (int k = 0; k < N; k++) {
                from[k] = vec(metres(k) - 2, any_size(k), k < round ? metres(k) : tie(k) * large);
                to[k] = from[k];
            }
            mesh_snap_points(v, to, scale, N - round % 17, to);
            for (int k = 0; k < N - round % 17; k++) {
                Vec3 alone = mesh_snap_point(vec_scale(from[k], scale));
                wrong += memcmp(&to[k], &alone, sizeof alone) != 0;
            }
        }
        OK(wrong == 0, "many points are snapped as each alone, vectors %d (%d differ)", v, wrong);
    }
}

static bool same_edges(const Mesh *m, const Edge *wanted, int n) {
    return m->nedges == n && memcmp(m->edge, wanted, (size_t)n * sizeof *wanted) == 0;
}

static void test_edges(void) {
    Arena arena = {0};
    Error e = {0};
    Triangle pair[] = {{{2, 0, 1}}, {{3, 2, 1}}, {{1, 1, 3}}, {{4, 4, 4}}};
    Mesh m = {.nvertices = 5, .ntriangles = 4, .triangle = pair};
    Edge wanted[] = {{{0, 2}}, {{0, 1}}, {{1, 2}}, {{2, 3}}, {{1, 3}}};
    OK(mesh_find_edges(&m, &arena, &e) && same_edges(&m, wanted, 5),
       "each edge once, lower end first, in order of first appearance; collapsed sides are none");

    Mesh empty = {0};
    OK(mesh_find_edges(&empty, &arena, &e) && empty.nedges == 0, "no triangles, no edges");

    enum { N = 40 }; /* a grid that is closed both ways: V - E + F = 0 */
    Triangle *t = ARENA_NEW(&arena, Triangle, 2 * N * N, &e);
    Mesh torus = {.nvertices = N * N, .ntriangles = 2 * N * N, .triangle = t};
    for (int i = 0; i < N * N; i++) {
        int a = i, b = i / N * N + (i + 1) % N, c = (a + N) % (N * N), d = (b + N) % (N * N);
        t[2 * i] = (Triangle){{a, b, d}};
        t[2 * i + 1] = (Triangle){{d, c, a}};
    }
    bool good = mesh_find_edges(&torus, &arena, &e);
    int twice = 0;
    for (int i = 0; good && i < torus.nedges; i++)
        for (int j = 0; j < i; j++) twice += memcmp(&torus.edge[i], &torus.edge[j], sizeof(Edge)) == 0;
    OK(good && torus.nedges == 3 * N * N && twice == 0, "a torus of %d triangles has %d edges", 2 * N * N, 3 * N * N);

    arena.fail_after = 2;
    OK(!mesh_find_edges(&torus, &arena, &e) && e.kind == ERR_INTERNAL, "no memory is an error, not a crash");
    arena_free(&arena);
}

int main(void) {
    test_snap();
    test_snap_many();
    test_edges();
    return tap_done();
}
