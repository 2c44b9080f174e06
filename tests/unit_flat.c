/* Triangles without height get one, whatever their neighbours are. */
#include "geometry/flat.h"

#include "tap.h"

enum { VERTICES = 8, ROUNDS = 4 };
static const double LEAST = 5e-6;

static double height(const Vec3 *p, Triangle t) {
    double longest = 0;
    for (int k = 0; k < 3; k++) longest = max_of(longest, vec_dist(p[t.v[k]], p[t.v[(k + 1) % 3]]));
    Vec3 n = vec_cross(vec_sub(p[t.v[1]], p[t.v[0]]), vec_sub(p[t.v[2]], p[t.v[0]]));
    return longest > 0 ? vec_len(n) / longest : 0;
}

/* Moves what is found until nothing is; returns the rounds that took, or ROUNDS + 1. */
static int mend(Vec3 *p, const Triangle *t, int n) {
    int vertex[VERTICES];
    Vec3 to[VERTICES];
    for (int round = 0; round <= ROUNDS; round++) {
        int count = flat_find(p, t, n, LEAST, round, vertex, to, VERTICES);
        if (count == 0) return round;
        for (int k = 0; k < count; k++) p[vertex[k]] = mesh_snap_point(to[k]);
    }
    return ROUNDS + 1;
}

int main(void) {
    Triangle t = {{0, 1, 2}};
    Vec3 good[3] = {{0, 0, 0}, {0.01, 0, 0}, {0.004, LEAST * 1.01, 0}};
    OK(mend(good, &t, 1) == 0, "a triangle that is high enough stays");

    Vec3 low[3] = {{0, 0, 0}, {0.01, 0, 0}, {0.004, -0.000001, 0}};
    OK(mend(low, &t, 1) == 1 && low[2].x == 0.004 && low[2].z == 0, "a lower one is raised");
    NEAR(low[2].y, -4 * LEAST, 2e-6, "to its own side");

    Vec3 line[3] = {{0, 0, 0}, {0.003, 0.006, 0.009}, {0.001, 0.002, 0.003}};
    OK(mend(line, &t, 1) == 1 && height(line, t) > 3 * LEAST, "so is one without a side, a line");
    Vec3 twice[3] = {{0, 0, 0}, {0.01, 0, 0}, {0.01, 0, 0}};
    OK(mend(twice, &t, 1) == 1 && height(twice, t) > 3 * LEAST, "one with two corners in one place");
    Vec3 point[3] = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
    OK(mend(point, &t, 1) <= ROUNDS && height(point, t) > LEAST, "and one that is a point");

    Vec3 between[5] = {{0, 0, 0}, {0.01, 0, 0}, {0.005, 0.000001, 0}, {0, 0.00001, 0}, {0.01, 0.00001, 0}};
    Triangle pair[2] = {{{0, 1, 2}}, {{4, 3, 2}}};
    OK(mend(between, pair, 2) <= ROUNDS && height(between, pair[0]) >= LEAST && height(between, pair[1]) >= LEAST,
       "a corner between two sides that are near each other leaves their plane");
    return tap_done();
}
