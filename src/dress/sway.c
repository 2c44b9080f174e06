/* Cloth that jumps has second differences that the body does not have. If all three frames have the same triangles,
   they are taken vertex by vertex. A mesh that is split differently in each frame has no common vertices: then the
   points of the middle frame are looked for in the other two. The body beside a point, whose vertices are known in
   all frames, tells about where it has gone. */
#include "dress/sway.h"

#include <string.h>

#include "base/sort.h"

static bool build_tree(const Mesh *m, Arena *arena, BoxTree *out, Error *e) {
    return boxtree_build(out, m->position, m->triangle, NULL, m->ntriangles, arena, e);
}

bool sway_frame(const Mesh *garment, const Mesh *body, Arena *arena, SwayFrame *out, Error *e) {
    out->garment = garment;
    out->body = body;
    return build_tree(garment, arena, &out->garment_tree, e) && build_tree(body, arena, &out->body_tree, e);
}

static bool same_triangles(const Mesh *a, const Mesh *b) {
    return a->nvertices == b->nvertices && a->ntriangles == b->ntriangles &&
           memcmp(a->triangle, b->triangle, (size_t)a->ntriangles * sizeof *a->triangle) == 0;
}

static double second_difference(Vec3 a, Vec3 b, Vec3 c) { return vec_len(vec_mad(vec_add(a, c), b, -2)); }

/* The smallest that at least 99 in 100 do not exceed. */
static double percentile(double *x, int n) {
    sort_numbers(x, n);
    return n ? x[(99 * (long)n + 99) / 100 - 1] : 0;
}

static double measure_vertices(const Mesh *a, const Mesh *b, const Mesh *c, double *room) {
    for (int v = 0; v < b->nvertices; v++) room[v] = second_difference(a->position[v], b->position[v], c->position[v]);
    return percentile(room, b->nvertices);
}

/* Where the point p of the garment, which goes along with triangle t of the body, is in another frame. */
static Vec3 follow(const SwayFrame *from, const SwayFrame *to, Vec3 p, int t) {
    const int *v = from->body->triangle[t].v;
    Vec3 moved = {0, 0, 0}, place = p;
    for (int k = 0; k < 3; k++) moved = vec_add(moved, vec_sub(to->body->position[v[k]], from->body->position[v[k]]));
    boxtree_nearest(&to->garment_tree, vec_mad(p, moved, 1.0 / 3), NULL, &place);
    return place;
}

static double measure_followed(const SwayFrame *a, const SwayFrame *b, const SwayFrame *c, double *room) {
    for (int v = 0; v < b->garment->nvertices; v++) {
        Vec3 p = b->garment->position[v];
        int t = 0;
        boxtree_nearest(&b->body_tree, p, &t, NULL);
        room[v] = second_difference(follow(b, a, p, t), p, follow(b, c, p, t));
    }
    return percentile(room, b->garment->nvertices);
}

bool sway_measure(const SwayFrame *const before[2], const SwayFrame *now, Arena *arena, double *garment, double *body,
                  Error *e) {
    const SwayFrame *a = before[0], *b = before[1], *c = now;
    double *room = ARENA_NEW(arena, double, (size_t)b->garment->nvertices + (size_t)b->body->nvertices, e);
    *garment = *body = NAN;
    if (!room) return false;
    if (!same_triangles(a->body, b->body) || !same_triangles(b->body, c->body)) return true;
    *body = measure_vertices(a->body, b->body, c->body, room);
    bool same = same_triangles(a->garment, b->garment) && same_triangles(b->garment, c->garment);
    *garment = same ? measure_vertices(a->garment, b->garment, c->garment, room) : measure_followed(a, b, c, room);
    return true;
}
