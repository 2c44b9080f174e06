/* The last word on a frame: body edges through the cloth, cloth edges through the body, and cloth
   vertices inside it, part by part, so that what is found can be named. */
#include "dress/residual.h"

bool tester_reserve(Tester *t, int edges, int triangles, Arena *arena, Error *e) {
    t->capacity = 8192;
    t->found = ARENA_NEW(arena, Crossing, t->capacity, e);
    return t->found && crossing_reserve(&t->edges, edges, arena, e) && crossing_reserve(&t->triangles, triangles, arena, e);
}

void tester_build(Tester *t, const Vec3 *position, const Edge *edge, int nedges, const Triangle *triangle, int ntriangles) {
    crossing_build_edges(&t->edges, position, edge, nedges);
    crossing_build_triangles(&t->triangles, position, triangle, ntriangles);
}

void tester_count(Tester *t, const BodyFrame *body, unsigned parts, const Vec3 *position, int nvertices, Residual *out,
                  CrossingCount *count) {
    double to_metres = 1 / body->unit;
    for (int p = 0; p < body->body->nparts; p++) {
        if (!(parts & part_bit(body, p))) continue;
        int before = count->hits;
        crossing_find(&body->edges[p], &t->triangles, t->found, t->capacity, count);
        out->edges += count->hits - before;
        before = count->hits;
        crossing_find(&t->edges, &body->triangles[p], t->found, t->capacity, count);
        out->cloth += count->hits - before;
        for (int v = 0; v < nvertices; v++) {
            double d = body_frame_distance(body, p, vec_scale(position[v], to_metres), 0, NULL);
            if (d >= 0) continue;
            out->inside++;
            if (-d > out->deepest) out->deepest = -d;
        }
    }
}
