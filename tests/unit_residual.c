/* The tests of a mesh that is written: when some of its vertices move, what is counted is what a mesh that is
   built and tested anew gives. */
#include "dress/residual.h"

#include <string.h>

#include "dice.h"
#include "geometry/boxtree.h"
#include "scene.h"

/* A cloth that lies in the body: the skin of hips and trunk, each vertex a little inwards or outwards. */
typedef struct {
    Scene scene;
    Mesh mesh;
    Vec3 *other;
    Tester moved, anew;
} Sunk;

static Vec3 somewhere_near(const Sunk *c, int v) {
    const BodyFrame *f = &c->scene.posed;
    return mesh_snap_point(vec_mad(f->position[v], f->normal[v], 0.01 * (dice_unit() - 0.3)));
}

static void open_cloth(Sunk *c) {
    Scene *s = &c->scene;
    Pose rest = figure_rest_pose();
    scene_open(s, "tshirt");
    body_frame_pose(&s->posed, &rest);
    body_frame_normals(&s->posed);
    const BodyPart *first = &s->body.part[s->body.of_role[ROLE_PELVIS]];
    const BodyPart *last = &s->body.part[s->body.of_role[ROLE_CHEST]];
    c->mesh = s->body.skin;
    c->mesh.edge += first->first_edge;
    c->mesh.nedges = last->first_edge + last->nedges - first->first_edge;
    c->mesh.triangle += first->first_triangle;
    c->mesh.ntriangles = last->first_triangle + last->ntriangles - first->first_triangle;
    c->mesh.position = ARENA_NEW(&s->arena, Vec3, c->mesh.nvertices, &s->error);
    c->other = ARENA_NEW(&s->arena, Vec3, c->mesh.nvertices, &s->error);
    need(s, c->mesh.position && c->other);
    unsigned own = 1u << ROLE_CHEST;
    int room = s->body.skin.nedges;
    need(s, tester_reserve(&c->moved, room, room, room, own, &s->arena, &s->error));
    need(s, tester_reserve(&c->anew, room, room, room, own, &s->arena, &s->error));
    for (int v = 0; v < c->mesh.nvertices; v++) c->mesh.position[v] = somewhere_near(c, v);
}

static int by_value(const void *a, const void *b) { return *(const int *)a - *(const int *)b; }

/* The same vertices as often; sorts both. */
static bool same_bad(Tester *a, Tester *b) {
    qsort(a->bad, (size_t)a->nbad, sizeof(int), by_value);
    qsort(b->bad, (size_t)b->nbad, sizeof(int), by_value);
    return a->nbad == b->nbad && memcmp(a->bad, b->bad, (size_t)a->nbad * sizeof(int)) == 0;
}

static bool same_residual(const Residual *a, const Residual *b) {
    return a->edges == b->edges && a->cloth == b->cloth && a->inside == b->inside && a->deepest == b->deepest;
}

static bool same_wrong(const Wrong *a, const Wrong *b) {
    return same_residual(&a->own, &b->own) && same_residual(&a->other, &b->other) && a->count.hits == b->count.hits &&
           a->count.pairs_all == b->count.pairs_all && a->count.pairs_tested == b->count.pairs_tested;
}

/* Moves `most` vertices, some of them to where they are, again and again. */
static void move_some(Sunk *c, int most) {
    enum { TIMES = 6, MOST = 2000 };
    static int vertex[MOST];
    static Vec3 to[MOST];
    int wrong = 0, n = c->mesh.nvertices;
    const BodyFrame *body = &c->scene.posed;
    Wrong w = tester_test(&c->moved, body, &c->mesh, NULL);
    for (int k = 0; k < TIMES; k++) {
        int step = n / most, first = (int)(dice_unit() * step);
        for (int i = 0; i < most; i++) {
            vertex[i] = first + i * step;
            to[i] = i % 5 ? somewhere_near(c, vertex[i]) : c->mesh.position[vertex[i]];
        }
        w = tester_again(&c->moved, body, vertex, to, most, NULL, w);
        Mesh copy = c->mesh;
        copy.position = memcpy(c->other, c->mesh.position, (size_t)n * sizeof *c->other);
        Wrong anew = tester_test(&c->anew, body, &copy, NULL);
        wrong += !same_wrong(&w, &anew) || !same_bad(&c->moved, &c->anew);
    }
    OK(wrong == 0 && w.own.edges > 100 && w.own.inside > 100 && w.other.cloth > 100,
       "%d of %d vertices move, %d times: found as if tested anew (at last %d hits, %d inside)", most, n, TIMES,
       w.count.hits, w.own.inside + w.other.inside);
}

/* How far x is from the skin of a part, by all of its triangles. */
static double from_skin(const BodyFrame *body, int part, Vec3 x) {
    const BodyPart *p = &body->body->part[part];
    double least = INFINITY;
    for (int t = p->first_triangle; t < p->first_triangle + p->ntriangles; t++) {
        const int *v = body->body->skin.triangle[t].v;
        Vec3 near = boxtree_triangle_point(x, body->position[v[0]], body->position[v[1]], body->position[v[2]]);
        least = min_of(least, vec_dist(x, near));
    }
    return least;
}

/* A hit is told by the weights of its vertices: a point of the cloth that lies on the part. */
static void know_where(Sunk *c) {
    const BodyFrame *body = &c->scene.posed;
    int wrong = 0;
    double farthest = 0;
    Wrong w = tester_test(&c->anew, body, &c->mesh, NULL);
    for (int k = 0; k < c->anew.nhits; k++) {
        const TesterHit *hit = &c->anew.hit[k];
        Vec3 x = {0, 0, 0};
        double sum = 0, least = 1;
        for (int i = 0; i < hit->n; i++) {
            x = vec_mad(x, c->mesh.position[hit->v[i]], hit->weight[i]);
            sum += hit->weight[i];
            least = min_of(least, hit->weight[i]);
        }
        wrong += least < 0 || fabs(sum - 1) > 1e-12;
        farthest = max_of(farthest, from_skin(body, hit->part, x));
    }
    OK(c->anew.nhits == w.count.hits && wrong == 0, "%d hits, whose weights are 0 or more and add up to 1",
       c->anew.nhits);
    OK(farthest < 1e-12, "each is on the skin of its part (%.2g m off)", farthest);
}

/* What is known to be outside is not asked again; all the rest is. */
static void leave_out_clear(Sunk *c) {
    static bool clear[1 << 15];
    Wrong w = tester_test(&c->anew, &c->scene.posed, &c->mesh, NULL);
    for (int v = 0; v < c->mesh.nvertices; v++) clear[v] = true;
    for (int k = 0; k < c->anew.nbad; k++) clear[c->anew.bad[k]] = false;
    Wrong less = tester_test(&c->moved, &c->scene.posed, &c->mesh, clear);
    for (int v = 0; v < c->mesh.nvertices; v++) clear[v] = true;
    Wrong none = tester_test(&c->moved, &c->scene.posed, &c->mesh, clear);
    OK(same_wrong(&w, &less) && none.own.inside == 0 && none.own.edges == w.own.edges,
       "vertices that are known to be outside are not asked");
}

int main(void) {
    Sunk c = {.other = NULL};
    open_cloth(&c);
    move_some(&c, 1);
    move_some(&c, 20);
    move_some(&c, 700);
    leave_out_clear(&c);
    know_where(&c);
    arena_free(&c.scene.arena);
    return tap_done();
}
