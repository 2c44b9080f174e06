/* What still intersects on exactly the mesh that is written. */
#ifndef DRESS_RESIDUAL_H
#define DRESS_RESIDUAL_H

#include "dress/bodyframe.h"

/* A mesh in output units, boxed for tests against the body, and room for what is found. */
typedef struct {
    CrossingSet edges, triangles;
    Crossing *found;
    int capacity;
} Tester;

typedef struct {
    int edges;       /* (body edge, garment triangle) pairs that share a point */
    int cloth;       /* (garment edge, body triangle) pairs */
    int inside;      /* garment vertices inside a part (analytic) */
    double deepest;  /* metres */
} Residual;

/* Room for meshes of up to this many edges and triangles. */
MUST_CHECK bool tester_reserve(Tester *t, int edges, int triangles, Arena *arena, Error *e);

/* Boxes the mesh; position must stay until the last test. */
void tester_build(Tester *t, const Vec3 *position, const Edge *edge, int nedges, const Triangle *triangle, int ntriangles);

/* Counts against the parts in `parts` (bits 1 << role), adding up in *out. */
void tester_count(Tester *t, const BodyFrame *body, unsigned parts, const Vec3 *position, int nvertices, Residual *out,
                  CrossingCount *count);

#endif
