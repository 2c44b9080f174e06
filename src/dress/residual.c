/* The last word on a frame: body edges through the cloth, cloth edges through the body, and cloth
   vertices inside it, part by part, so that what is found can be named. */
#include "dress/residual.h"

#include "geometry/boxtree.h"

enum { FOUND_MAX = 1 << 14, BLOCK = 16 /* vertices that share a box */ };

bool tester_reserve(Tester *t, int edges, int triangles, Arena *arena, Error *e) {
    t->capacity = FOUND_MAX;
    t->found = ARENA_NEW(arena, Crossing, t->capacity, e);
    t->bad = ARENA_NEW(arena, int, 3 * t->capacity, e);
    t->block = ARENA_NEW(arena, Box, edges / BLOCK + 1, e); /* a mesh has more edges than vertices */
    return t->found && t->bad && t->block && crossing_reserve(&t->edges, edges, arena, e) &&
           crossing_reserve(&t->triangles, triangles, arena, e);
}

void tester_build(Tester *t, const Vec3 *position, const Edge *edge, int nedges, const Triangle *triangle,
                  int ntriangles, unsigned own) {
    t->edge = edge;
    t->triangle = triangle;
    t->own = own;
    t->nbad = 0;
    crossing_build_edges(&t->edges, position, edge, nedges);
    crossing_build_triangles(&t->triangles, position, triangle, ntriangles);
}

/* Appends the garment's corners of the listed pairs to the vertices that must not be where they are. */
static void add_bad(Tester *t, bool is_triangle, int listed) {
    for (int k = 0; k < listed; k++) {
        const int *v = is_triangle ? t->triangle[t->found[k].triangle].v : t->edge[t->found[k].edge].v;
        for (int c = 0; c < (is_triangle ? 3 : 2) && t->nbad < 3 * t->capacity; c++) t->bad[t->nbad++] = v[c];
    }
}

void tester_cross(Tester *t, const BodyFrame *body, unsigned parts, Residual *own, Residual *other,
                  CrossingCount *count) {
    for (int p = 0; p < body->body->nparts; p++) {
        unsigned bit = part_bit(body, p);
        if (!(parts & bit)) continue;
        Residual *r = t->own & bit ? own : other;
        int before = count->hits;
        add_bad(t, true, crossing_find(&body->edges[p], &t->triangles, t->found, t->capacity, count));
        r->edges += count->hits - before;
        before = count->hits;
        add_bad(t, false, crossing_find(&t->edges, &body->triangles[p], t->found, t->capacity, count));
        r->cloth += count->hits - before;
    }
}

/* Boxes in metres round vertices that follow each other, and so lie near each other. */
static void box_vertices(Tester *t, const Vec3 *position, int n, double to_metres) {
    for (int v = 0; v < n; v++) {
        Box *box = &t->block[v / BLOCK];
        if (v % BLOCK == 0) *box = box_empty();
        box_add(box, vec_scale(position[v], to_metres));
    }
}

void tester_inside(Tester *t, const BodyFrame *body, const Vec3 *position, int nvertices, const unsigned *clear,
                   Residual *own, Residual *other) {
    double to_metres = 1 / body->unit;
    box_vertices(t, position, nvertices, to_metres);
    for (int p = 0; p < body->body->nparts; p++)
        for (int v = 0; v < nvertices; v++) {
            if (v % BLOCK == 0 && !box_touches(t->block[v / BLOCK], body->box[p])) {
                v += BLOCK - 1;
                continue;
            }
            if (clear && clear[v] & part_bit(body, p)) continue;
            double d = body_frame_distance(body, p, vec_scale(position[v], to_metres), 0, NULL);
            if (d >= 0) continue;
            Residual *r = t->own & part_bit(body, p) ? own : other;
            r->inside++;
            r->deepest = fmax(r->deepest, -d);
            if (t->nbad < 3 * t->capacity) t->bad[t->nbad++] = v;
        }
}
