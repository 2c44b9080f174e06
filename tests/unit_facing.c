/* Normals where cloth is bent more sharply than its facets are fine: against a search of the whole sphere. */
#include "geometry/facing.h"

#include "geometry/cone.h"
#include "wave.h"
#include "dice.h"
#include "tap.h"

enum { DIRECTIONS = 20000, FAN = 16 };

static Vec3 random_direction(void) {
    for (;;) {
        Vec3 d = dice_around();
        if (vec_dot(d, d) <= 1 && vec_dot(d, d) > 0.01) return vec_unit_or(d, d);
    }
}

/* The cosine of the largest angle. */
static double least(Vec3 axis, const Vec3 *p, int n) {
    double c = 1;
    for (int i = 0; i < n; i++) c = min_of(c, vec_dot(axis, p[i]));
    return c;
}

/* The same for the best of many directions. */
static double best_of_sphere(const Vec3 *p, int n) {
    double best = -1;
    for (int k = 0; k < DIRECTIONS; k++) {
        double turn = 2.399963229728653 * k, y = 1 - (2 * k + 1.0) / DIRECTIONS, r = sqrt(1 - y * y);
        best = max_of(best, least(vec(r * cos(turn), y, r * sin(turn)), p, n));
    }
    return best;
}

static void test_cone(void) {
    int worse = 0, wide = 0, found = 0;
    for (int round = 0; round < 200; round++) {
        Vec3 p[FAN], about = random_direction(), axis;
        int n = 1 + round % FAN;
        double spread = 3 * dice_unit();
        for (int i = 0; i < n; i++) p[i] = vec_unit_or(vec_mad(about, random_direction(), spread), about);
        double best = best_of_sphere(p, n);
        bool has = cone_axis(p, n, &axis) > 0;
        found += has;
        worse += has && (fabs(vec_len(axis) - 1) > 1e-12 || least(axis, p, n) < best - 1e-9);
        wide += !has && best > 0;
    }
    OK(found > 50 && found < 190, "of 200 fans %d lie within a cone", found);
    OK(worse == 0 && wide == 0, "its axis is never worse than %d others, and found where they find one", DIRECTIONS);
}

/* A strip of cloth folded by 160 degrees and a long facet on one side of it: the mean looks away. */
static void test_fold_by_hand(void) {
    double t = 160 * PI / 180;
    Vec3 facet[3] = {vec(0, 1, 0), vec(0, 1, 0), vec(sin(t), cos(t), 0)}, axis = {0, 0, 0};
    Vec3 mean = vec_unit_or(vec_add(vec_add(facet[0], facet[1]), facet[2]), axis);
    OK(least(mean, facet, 3) < 0, "the mean of a fold's facets looks away from one of them");
    NEAR(cone_axis(facet, 3, &axis), cos(t / 2), 1e-12, "but there is a normal that sees them all");
    NEAR(vec_dot(axis, facet[0]), cos(t / 2), 1e-12, "half way between its sides");
    Vec3 back = vec(0, -1, 0), both[2] = {facet[0], back};
    OK(cone_axis(both, 2, &axis) <= 0, "and none where the fold is flat");
}

/* A wavy sheet, every seventh vertex of which is pulled out by hand. */
typedef struct {
    Wave wave;
    Vec3 normal[2 * VERTICES];
    Mesh mesh;
} Bent;

static void bend(Bent *b) {
    make_wave(&b->wave);
    b->mesh = b->wave.mesh;
    b->mesh.normal = b->normal;
    for (int v = 0; v < VERTICES; v++) {
        b->normal[v] = b->wave.normal[v];
        if (v % 7 == 0) b->wave.position[v] = vec_mad(b->wave.position[v], random_direction(), 0.6 * dice_unit());
    }
}

static Vec3 facet_normal(const Mesh *m, int t) {
    const int *v = m->triangle[t].v;
    Vec3 a = m->position[v[0]];
    return vec_unit_or(vec_cross(vec_sub(m->position[v[1]], a), vec_sub(m->position[v[2]], a)), a);
}

static int facets_round(const Mesh *m, int vertex, Vec3 facet[FAN]) {
    int n = 0;
    for (int t = 0; t < m->ntriangles; t++) {
        const int *v = m->triangle[t].v;
        if (v[0] == vertex || v[1] == vertex || v[2] == vertex) facet[n++] = facet_normal(m, t);
    }
    return n;
}

/* Corners whose normal looks away from their facet. */
static int dark_corners(const Mesh *m) {
    const Crease *crease = m->crease, *end = crease + m->ncreases;
    int dark = 0;
    for (int corner = 0; corner < 3 * m->ntriangles; corner++) {
        int own = crease < end && crease->corner == corner ? crease++->normal : m->triangle[corner / 3].v[corner % 3];
        dark += vec_dot(m->normal[own], facet_normal(m, corner / 3)) <= 0;
    }
    return crease == end ? dark : -1;
}

static void test_bent_wave(void) {
    static Bent b;
    Vec3 facet[FAN];
    Arena arena = {0};
    Error e = {0};
    Facing facing;
    int bent = 0, away = 0, blind = 0;
    bend(&b);
    if (!OK(facing_reserve(&facing, VERTICES, TRIANGLES, &arena, &e), "room for a mesh")) return;
    facing_mend(&facing, &b.mesh);
    for (int v = 0; v < VERTICES; v++) {
        int n = facets_round(&b.mesh, v, facet);
        bent += least(b.wave.normal[v], facet, n) < 0;
        if (least(b.normal[v], facet, n) > 0) continue;
        away++;
        blind += best_of_sphere(facet, n) > 0.02;
    }
    OK(bent > 20, "%d vertices are bent away from their surface", bent);
    OK(away > 0 && away < bent && blind == 0, "%d have a normal that looks away from a facet, as all do", away);
    OK(b.mesh.ncreases >= away && dark_corners(&b.mesh) == 0, "but each corner has one that sees its facet");
    int before = b.mesh.ncreases;
    facing_mend(&facing, &b.mesh);
    OK(b.mesh.ncreases == before && dark_corners(&b.mesh) == 0, "and a second time nothing changes");
    arena_free(&arena);
}

int main(void) {
    test_cone();
    test_fold_by_hand();
    test_bent_wave();
    return tap_done();
}
