/* Accelerations of meshes that move in known ways. */
#include "dress/sway.h"

#include "tap.h"

enum { RINGS = 24 };

static Arena arena;

/* A closed-off tube round the z axis of `around` facets, moved by d. */
static Mesh tube(double radius, int around, Vec3 d) {
    Error e = {0};
    Mesh m = {.nvertices = around * RINGS, .ntriangles = 2 * around * (RINGS - 1)};
    m.position = ARENA_NEW(&arena, Vec3, m.nvertices, &e);
    m.triangle = ARENA_NEW(&arena, Triangle, m.ntriangles, &e);
    for (int r = 0, t = 0; r < RINGS; r++)
        for (int k = 0; k < around; k++) {
            double angle = 2 * PI * k / around;
            int i = r * around + k, next = r * around + (k + 1) % around;
            m.position[i] = vec_add(d, vec(radius * cos(angle), radius * sin(angle), 0.05 * r));
            if (r + 1 == RINGS) continue;
            m.triangle[t++] = (Triangle){{i, next, next + around}};
            m.triangle[t++] = (Triangle){{i, next + around, i + around}};
        }
    return m;
}

/* Garments of the given numbers of facets, and the body, at x = path[0..2]. */
static void measure(const int around[3], const double cloth[3], const double path[3], double *garment, double *body) {
    Error e = {0};
    SwayFrame frame[3];
    Mesh mesh[3][2];
    bool good = true;
    for (int f = 0; f < 3; f++) {
        mesh[f][0] = tube(0.2, around[f], vec(path[f] + cloth[f], 0, 0));
        mesh[f][1] = tube(0.15, 16, vec(path[f], 0, 0));
        good = good && sway_frame(&mesh[f][0], &mesh[f][1], &arena, &frame[f], &e);
    }
    const SwayFrame *before[2] = {&frame[0], &frame[1]};
    OK(good && sway_measure(before, &frame[2], &arena, garment, body, &e), "three frames");
}

int main(void) {
    double garment, body;
    const double still[3] = {0, 0, 0}, even[3] = {0, 0.25, 0.5}, fast[3] = {0, 0.25, 1}, pop[3] = {0, 0.0625, 0};
    measure((int[]){64, 64, 64}, still, even, &garment, &body);
    NEAR(garment, 0, 1e-15, "the same triangles in even motion: none");
    NEAR(body, 0, 1e-15, "nor the body");
    measure((int[]){64, 64, 64}, still, fast, &garment, &body);
    NEAR(garment, 0.5, 1e-15, "that of a path that bends");
    NEAR(body, 0.5, 1e-15, "and the body's");
    measure((int[]){64, 64, 64}, pop, even, &garment, &body);
    NEAR(garment, 0.125, 1e-15, "there and back again in a frame: twice the way");
    NEAR(body, 0, 1e-15, "though the body does not");
    measure((int[]){64, 256, 128}, still, even, &garment, &body);
    NEAR(garment, 0, 0.002, "other triangles in every frame, even motion: less than their chords cut off");
    measure((int[]){64, 256, 128}, still, fast, &garment, &body);
    NEAR(garment, 0.5, 0.002, "other triangles, a path that bends");
    measure((int[]){64, 256, 128}, pop, even, &garment, &body);
    NEAR(garment, 0.125, 0.005, "other triangles, there and back again");

    Error e = {0};
    SwayFrame a, b;
    Mesh cloth = tube(0.2, 64, vec(0, 0, 0)), thin = tube(0.1, 8, vec(0, 0, 0)), thick = tube(0.1, 16, vec(0, 0, 0));
    bool good = sway_frame(&cloth, &thin, &arena, &a, &e) && sway_frame(&cloth, &thick, &arena, &b, &e) &&
                sway_measure((const SwayFrame *[]){&a, &a}, &b, &arena, &garment, &body, &e);
    OK(good && isnan(garment) && isnan(body), "a body that changes its triangles tells nothing");
    arena_free(&arena);
    return tap_done();
}
