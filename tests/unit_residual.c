/* The tests of a mesh that is written: when some of its vertices move, what is counted is what a mesh that is
   built and tested anew gives. */
#include "dress/residual.h"

#include <string.h>

#include "dice.h"
#include "scene.h"

/* A cloth that lies in the body: its own skin, each vertex a little inwards or outwards. */
typedef struct {
    Scene scene;
    const Mesh *skin;
    Vec3 *position, *other;
    Tester moved, anew;
    unsigned parts;
} Cloth;

static Vec3 somewhere_near(const Cloth *c, int v) {
    const BodyFrame *f = &c->scene.posed;
    return mesh_snap_point(vec_mad(f->position[v], f->normal[v], 0.01 * (dice_unit() - 0.3)));
}

static void open_cloth(Cloth *c) {
    Scene *s = &c->scene;
    Pose rest = figure_rest_pose();
    scene_open(s, "tshirt");
    body_frame_pose(&s->posed, &rest);
    body_frame_normals(&s->posed);
    c->skin = &s->body.skin;
    c->parts = (1u << ROLE_CHEST | 1u << ROLE_LEFT_UPPER_ARM | 1u << ROLE_PELVIS);
    c->position = ARENA_NEW(&s->arena, Vec3, c->skin->nvertices, &s->error);
    c->other = ARENA_NEW(&s->arena, Vec3, c->skin->nvertices, &s->error);
    need(s, c->position && c->other);
    need(s, tester_reserve(&c->moved, c->skin->nedges, c->skin->ntriangles, &s->arena, &s->error));
    need(s, tester_reserve(&c->anew, c->skin->nedges, c->skin->ntriangles, &s->arena, &s->error));
    for (int v = 0; v < c->skin->nvertices; v++) c->position[v] = somewhere_near(c, v);
}

typedef struct { Residual own, other; CrossingCount count; } Found;

static Found find(Cloth *c, Tester *t, Vec3 *position) {
    const Mesh *m = c->skin;
    Found f = {.own = {0}};
    tester_build(t, position, m->edge, m->nedges, m->triangle, m->ntriangles, 1u << ROLE_CHEST);
    tester_cross(t, &c->scene.posed, c->parts, &f.own, &f.other, &f.count);
    return f;
}

static int by_value(const void *a, const void *b) { return *(const int *)a - *(const int *)b; }

/* The same vertices as often; sorts both. */
static bool same_bad(Tester *a, Tester *b) {
    qsort(a->bad, (size_t)a->nbad, sizeof(int), by_value);
    qsort(b->bad, (size_t)b->nbad, sizeof(int), by_value);
    return a->nbad == b->nbad && memcmp(a->bad, b->bad, (size_t)a->nbad * sizeof(int)) == 0;
}

static bool same_found(const Found *a, const Found *b) {
    return a->own.edges == b->own.edges && a->own.cloth == b->own.cloth && a->other.edges == b->other.edges &&
           a->other.cloth == b->other.cloth && a->count.hits == b->count.hits &&
           a->count.pairs_all == b->count.pairs_all && a->count.pairs_tested == b->count.pairs_tested;
}

/* Moves `most` vertices, some of them to where they are, again and again. */
static void move_some(Cloth *c, int most) {
    enum { TIMES = 6, MOST = 2000 };
    static int vertex[MOST];
    static Vec3 to[MOST];
    int wrong = 0, hits = 0, n = c->skin->nvertices;
    Found f = find(c, &c->moved, c->position);
    for (int k = 0; k < TIMES; k++) {
        int step = n / most, first = (int)(dice_unit() * step);
        for (int i = 0; i < most; i++) {
            vertex[i] = first + i * step;
            to[i] = i % 5 ? somewhere_near(c, vertex[i]) : c->position[vertex[i]];
        }
        tester_move(&c->moved, &c->scene.posed, c->parts, vertex, to, most, &f.own, &f.other, &f.count);
        memcpy(c->other, c->position, (size_t)n * sizeof *c->other);
        Found g = find(c, &c->anew, c->other);
        wrong += !same_found(&f, &g) || !same_bad(&c->moved, &c->anew);
        hits += g.count.hits;
    }
    OK(wrong == 0 && hits > 1000, "%d of %d vertices move, %d times: found as if built anew (%d hits in all)", most, n,
       TIMES, hits);

    /* Parts that have not been asked about are tested against the mesh as it is now. */
    Found a = {.own = {0}}, b = a;
    tester_cross(&c->moved, &c->scene.posed, ~c->parts, &a.own, &a.other, &a.count);
    tester_cross(&c->anew, &c->scene.posed, ~c->parts, &b.own, &b.other, &b.count);
    OK(same_found(&a, &b) && same_bad(&c->moved, &c->anew), "and other parts afterwards");
}

int main(void) {
    Cloth c = {.parts = 0};
    open_cloth(&c);
    move_some(&c, 1);
    move_some(&c, 20);
    move_some(&c, 700);
    arena_free(&c.scene.arena);
    return tap_done();
}
