/* The last word on a frame: body edges through the cloth, cloth edges through the body, and cloth
   vertices inside it, part by part, so that what is found can be named. */
#include "dress/residual.h"

enum { FOUND_MAX = 1 << 14 };

bool tester_reserve(Tester *t, int edges, int triangles, Arena *arena, Error *e) {
    t->capacity = FOUND_MAX;
    t->found = ARENA_NEW(arena, Crossing, t->capacity, e);
    return t->found && crossing_reserve(&t->edges, edges, arena, e) && crossing_reserve(&t->triangles, triangles, arena, e);
}

void tester_build(Tester *t, const Vec3 *position, const Edge *edge, int nedges, const Triangle *triangle,
                  int ntriangles, const unsigned *own) {
    t->edge = edge;
    t->triangle = triangle;
    t->own = own;
    crossing_build_edges(&t->edges, position, edge, nedges);
    crossing_build_triangles(&t->triangles, position, triangle, ntriangles);
}

bool tester_owns_triangle(const Tester *t, int triangle, unsigned part) {
    const int *v = t->triangle[triangle].v;
    return t->own[v[0]] & t->own[v[1]] & t->own[v[2]] & part;
}

bool tester_owns_edge(const Tester *t, int edge, unsigned part) {
    const int *v = t->edge[edge].v;
    return t->own[v[0]] & t->own[v[1]] & part;
}

void tester_count(Tester *t, const BodyFrame *body, const Vec3 *position, int nvertices, Residual *own, Residual *other,
                  CrossingCount *count) {
    double to_metres = 1 / body->unit;
    for (int p = 0; p < body->body->nparts; p++) {
        unsigned bit = part_bit(body, p);
        int before = count->hits, listed = crossing_find(&body->edges[p], &t->triangles, t->found, t->capacity, count), mine = 0;
        for (int k = 0; k < listed; k++) mine += tester_owns_triangle(t, t->found[k].triangle, bit);
        own->edges += mine + (count->hits - before - listed); /* what the list could not hold counts as bad */
        other->edges += listed - mine;
        before = count->hits;
        listed = crossing_find(&t->edges, &body->triangles[p], t->found, t->capacity, count);
        mine = 0;
        for (int k = 0; k < listed; k++) mine += tester_owns_edge(t, t->found[k].edge, bit);
        own->cloth += mine + (count->hits - before - listed);
        other->cloth += listed - mine;
        for (int v = 0; v < nvertices; v++) {
            double d = body_frame_distance(body, p, vec_scale(position[v], to_metres), 0, NULL);
            if (d >= 0) continue;
            Residual *r = t->own[v] & bit ? own : other;
            r->inside++;
            if (-d > r->deepest) r->deepest = -d;
        }
    }
}
