/* The Bernstein form, de Casteljau's split and the blossom describe one surface. */
#include "geometry/grid.h"

#include <string.h>

#include "dice.h"
#include "tap.h"

static Patch random_patch(void) {
    Patch p;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) p.p[i][j] = dice_point();
    return p;
}

static void split_keeps_the_surface(void) {
    double worst = 0, part_worst = 0;
    for (int n = 0; n < 200; n++) {
        Patch patch = random_patch(), child[4];
        bezier_split(&patch, child);
        for (int k = 0; k < 4; k++) {
            double u = dice_unit(), w = dice_unit(), u0 = 0.5 * (k / 2), w0 = 0.5 * (k % 2);
            Vec3 whole = bezier_point(&patch, u0 + 0.5 * u, w0 + 0.5 * w, NULL, NULL);
            Patch part = bezier_part(&patch, u0, u0 + 0.5, w0, w0 + 0.5);
            worst = max_of(worst, vec_dist(whole, bezier_point(&child[k], u, w, NULL, NULL)));
            for (int c = 0; c < 16; c++)
                part_worst = max_of(part_worst, vec_dist(part.p[c / 4][c % 4], child[k].p[c / 4][c % 4]));
        }
    }
    NEAR(worst, 0, 1e-14, "the four children lie on the patch");
    NEAR(part_worst, 0, 1e-14, "the blossom gives the same control points as de Casteljau");
}

static void children_share_their_borders(void) {
    Patch patch = random_patch(), child[4];
    bezier_split(&patch, child);
    bool same = true;
    for (int k = 0; k < 4; k++) {
        same = same && vec_dist(child[0].p[3][k], child[2].p[0][k]) == 0 &&
               vec_dist(child[1].p[3][k], child[3].p[0][k]) == 0;
        same = same && vec_dist(child[0].p[k][3], child[1].p[k][0]) == 0 &&
               vec_dist(child[2].p[k][3], child[3].p[k][0]) == 0;
    }
    OK(same, "neighbouring children have literally the same control points: 49, not 64");
}

static void derivatives_are_limits(void) {
    double worst = 0, h = 1e-6;
    for (int n = 0; n < 100; n++) {
        Patch patch = random_patch();
        double u = 0.1 + 0.8 * dice_unit(), w = 0.1 + 0.8 * dice_unit();
        Vec3 du, dw;
        bezier_point(&patch, u, w, &du, &dw);
        Vec3 nu = vec_scale(
            vec_sub(bezier_point(&patch, u + h, w, NULL, NULL), bezier_point(&patch, u - h, w, NULL, NULL)), 0.5 / h);
        Vec3 nw = vec_scale(
            vec_sub(bezier_point(&patch, u, w + h, NULL, NULL), bezier_point(&patch, u, w - h, NULL, NULL)), 0.5 / h);
        worst = max_of(worst, max_of(vec_dist(du, nu), vec_dist(dw, nw)));
    }
    NEAR(worst, 0, 1e-8, "du and dw are the central differences' limits");
}

static void basis_is_a_partition(void) {
    double worst = 0;
    for (int n = 0; n <= 100; n++) {
        double b[4], d[4];
        bezier_basis(n / 100.0, b, d);
        worst = max_of(worst, fabs(b[0] + b[1] + b[2] + b[3] - 1) + fabs(d[0] + d[1] + d[2] + d[3]));
    }
    NEAR(worst, 0, 1e-14, "the basis sums to one and its slopes to zero");
}

static void normals(void) {
    Patch flat;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) flat.p[i][j] = vec(i, j, 0);
    NEAR(bezier_normal(&flat, 0.3, 0.7).z, 1, 1e-15, "a flat patch points along du x dw");
    for (int j = 0; j < 4; j++) flat.p[0][j] = vec(0, 1.5, 0);
    NEAR(bezier_normal(&flat, 0, 0.5).z, 1, 1e-12, "at a pole the normal is taken from beside it");
}

static void hermite(void) {
    Vec3 out[4], a = {0, 1, 2}, b = {3, 1, 4}, da = {1, 0, 0}, db = {0, 0, 2};
    bezier_from_hermite(a, da, b, db, 0.5, out);
    NEAR(vec_dist(vec_scale(vec_sub(out[1], out[0]), 3 / 0.5), da), 0, 1e-14,
         "a Hermite segment leaves with its slope");
    NEAR(vec_dist(vec_scale(vec_sub(out[3], out[2]), 3 / 0.5), db), 0, 1e-14, "and arrives with its slope");
}

/* How many points and normals of the grid are not those of bezier_point and bezier_normal, or lie behind
   its end. */
static int differing(const Patch *patch, const GridRows *u, const GridRows *w) {
    enum { BEHIND = 16, ROOM = 40 * 40 };
    static Vec3 point[ROOM], normal[ROOM], alone[ROOM];
    int wrong = 0, n = u->n * w->n;
    const Vec3 untouched = {1, 2, 3};
    for (int k = 0; k < n + BEHIND; k++) point[k] = normal[k] = alone[k] = untouched;
    grid_points(patch, u, w, point, normal);
    grid_points(patch, u, w, alone, NULL);
    for (int k = 0; k < n + BEHIND; k++) {
        double s = u->t[k < n ? k / w->n : 0], t = w->t[k < n ? k % w->n : 0];
        Vec3 p = k < n ? bezier_point(patch, s, t, NULL, NULL) : untouched;
        Vec3 q = k < n ? bezier_normal(patch, s, t) : untouched;
        wrong += memcmp(&p, &point[k], sizeof p) != 0 || memcmp(&p, &alone[k], sizeof p) != 0 ||
                 memcmp(&q, &normal[k], sizeof q) != 0;
    }
    return wrong;
}

/* With any vectors, round a pole as well; as a whole and in parts of any size. */
static void grids(void) {
    enum { FACETS = 32, ALL = FACETS + 1 };
    Arena arena = {0};
    Error e = {0};
    GridRows rows;
    if (!OK(grid_rows(FACETS, &arena, &rows, &e), "basis rows are made")) return;
    for (Vectors v = VECTORS_PLAIN; v < VECTORS_COUNT; v++) {
        if (!vectors_usable(v)) continue;
        int wrong = 0;
        rows.vectors = v;
        for (int n = 1; n <= ALL; n++) {
            GridRows part = grid_part(&rows, n % 3 ? 0 : ALL - n, n), other = grid_part(&rows, 0, 1 + n * 7 % ALL);
            Patch patch = random_patch();
            for (int j = 0; j < 4 && n % 5 == 0; j++) patch.p[3][j] = patch.p[3][0]; /* u = 1 is a pole */
            for (int i = 0; i < 4 && n % 7 == 0; i++) patch.p[i][0] = patch.p[0][0]; /* w = 0 is one */
            wrong += differing(&patch, &rows, &part) + differing(&patch, &part, &rows) +
                     differing(&patch, &part, &other);
        }
        OK(wrong == 0, "a grid is the same point by point, vectors %d (%d differ)", v, wrong);
    }
    arena_free(&arena);
}

int main(void) {
    grids();
    split_keeps_the_surface();
    children_share_their_borders();
    derivatives_are_limits();
    basis_is_a_partition();
    normals();
    hermite();
    return tap_done();
}
