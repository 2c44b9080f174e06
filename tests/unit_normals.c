/* Normals where cloth is bent more sharply than its facets are fine: against a search of the whole sphere. */
#include "dress/normals.h"

#include "dress/follow.h"
#include "geometry/cone.h"
#include "scene.h"

enum { DETAIL = 4, DEPTH = 1, DIRECTIONS = 20000, FAN = 16 };

static unsigned state = 4711;

static double random_unit(void) {
    state = state * 1664525u + 1013904223u;
    return (state >> 8) / 16777216.0;
}

static Vec3 random_direction(void) {
    for (;;) {
        Vec3 d = vec(2 * random_unit() - 1, 2 * random_unit() - 1, 2 * random_unit() - 1);
        if (vec_dot(d, d) <= 1 && vec_dot(d, d) > 0.01) return vec_unit_or(d, d);
    }
}

/* The cosine of the largest angle. */
static double least(Vec3 axis, const Vec3 *p, int n) {
    double c = 1;
    for (int i = 0; i < n; i++) c = fmin(c, vec_dot(axis, p[i]));
    return c;
}

/* The same for the best of many directions. */
static double best_of_sphere(const Vec3 *p, int n) {
    double best = -1;
    for (int k = 0; k < DIRECTIONS; k++) {
        double turn = 2.399963229728653 * k, y = 1 - (2 * k + 1.0) / DIRECTIONS, r = sqrt(1 - y * y);
        best = fmax(best, least(vec(r * cos(turn), y, r * sin(turn)), p, n));
    }
    return best;
}

static void test_cone(void) {
    int worse = 0, wide = 0, found = 0;
    for (int round = 0; round < 200; round++) {
        Vec3 p[FAN], about = random_direction(), axis;
        int n = 1 + round % FAN;
        double spread = 3 * random_unit();
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

/* Trousers at rest, single vertices of which are pulled out by hand. */
typedef struct {
    Scene scene;
    Fit fit;
    Lattice lattice;
    Leaves leaves;
    Sheet sheet;
    Follower follower;
    Field field;
    Normals normals;
    Patch *root;
    Vec3 *position, *normal;
} Cloth;

static void open_cloth(Cloth *c) {
    Scene *s = &c->scene;
    Arena *a = &s->arena;
    Error *e = &s->error;
    scene_open(s, "trousers");
    need(s, fit_garment(s->garment, &s->figure, &s->body, a, &c->fit, e));
    need(s, lattice_build(&c->fit, DETAIL, DEPTH, a, &c->lattice, e));
    need(s, leaves_reserve(&c->leaves, &c->lattice, a, e) && sheet_reserve(&c->sheet, &c->lattice, a, e));
    need(s, follow_reserve(&c->follower, &c->fit, &s->figure, &s->body, a, e));
    need(s, field_reserve(&c->field, &c->lattice, a, e) && normals_reserve(&c->normals, &c->lattice, a, e));
    c->root = ARENA_NEW(a, Patch, c->fit.npatches, e);
    c->position = ARENA_NEW(a, Vec3, c->lattice.nplaces, e);
    c->normal = ARENA_NEW(a, Vec3, 2 * c->lattice.nplaces, e);
    need(s, c->root && c->position && c->normal);
}

static void bend_cloth(Cloth *c) {
    Pose rest = figure_rest_pose();
    follow_pose(&c->follower, &rest, c->root);
    leaves_fill(&c->leaves, DEPTH);
    tessellate(&c->sheet, &c->leaves);
    for (int v = 0; v < c->sheet.nvertices; v++) {
        c->position[v] = lattice_point(&c->lattice, c->root, c->sheet.place[v]);
        if (v % 7 == 0) c->position[v] = vec_mad(c->position[v], random_direction(), 0.05 * random_unit());
    }
}

/* The unit normals of the facets round a vertex. */
static int facets_round(const Cloth *c, int vertex, Vec3 facet[FAN]) {
    int n = 0;
    for (int t = 0; t < c->sheet.ntriangles; t++) {
        const int *v = c->sheet.triangle[t].v;
        if ((v[0] != vertex && v[1] != vertex && v[2] != vertex) || n == FAN) continue;
        Vec3 a = c->position[v[0]], f = vec_cross(vec_sub(c->position[v[1]], a), vec_sub(c->position[v[2]], a));
        facet[n++] = vec_unit_or(f, f);
    }
    return n;
}

/* Corners whose normal looks away from their facet. */
static int dark_corners(const Cloth *c) {
    const Crease *crease = c->normals.crease, *end = crease + c->normals.ncreases;
    int dark = 0;
    for (int corner = 0; corner < 3 * c->sheet.ntriangles; corner++) {
        const int *v = c->sheet.triangle[corner / 3].v;
        int own = crease < end && crease->corner == corner ? crease++->normal : v[corner % 3];
        Vec3 a = c->position[v[0]], f = vec_cross(vec_sub(c->position[v[1]], a), vec_sub(c->position[v[2]], a));
        dark += vec_dot(c->normal[own], f) <= 0;
    }
    return crease == end ? dark : -1;
}

static void test_bent_sheet(void) {
    static Cloth c;
    Vec3 facet[FAN];
    int bent = 0, away = 0, blind = 0;
    open_cloth(&c);
    bend_cloth(&c);
    normals_find(&c.normals, &c.field, c.root, &c.sheet, c.position, c.normal);
    for (int v = 0; v < c.sheet.nvertices; v++) {
        int n = facets_round(&c, v, facet);
        bent += least(field_normal(&c.field, c.root, 0, c.sheet.place[v]), facet, n) < 0;
        if (least(c.normal[v], facet, n) > 0) continue;
        away++;
        blind += best_of_sphere(facet, n) > 0.02;
    }
    OK(bent > 20, "%d vertices are bent away from their patches", bent);
    OK(away < bent / 2 && blind == 0, "%d of these have a normal that looks away from a facet: all do there", away);
    OK(c.normals.ncreases >= away && dark_corners(&c) == 0, "but each corner has one that sees its facet");
    arena_free(&c.scene.arena);
}

int main(void) {
    test_cone();
    test_fold_by_hand();
    test_bent_sheet();
    return tap_done();
}
