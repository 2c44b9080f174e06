/* What still intersects on exactly the mesh that is written. */
#ifndef DRESS_RESIDUAL_H
#define DRESS_RESIDUAL_H

#include "dress/bodyframe.h"

/* A garment mesh in output units, boxed for tests against the body, and room for what is found. */
typedef struct {
    CrossingSet edges, triangles;
    const Edge *edge;
    const Triangle *triangle;
    unsigned own;         /* parts (bits 1 << role) that the garment is worn over */
    Crossing *found;
    int capacity;
    Box *block;           /* private: boxes round the vertices */
    int *bad, nbad;       /* vertices that must not be where they are, in the order found */
} Tester;

typedef struct {
    int edges;       /* (body edge, garment triangle) pairs that share a point */
    int cloth;       /* (garment edge, body triangle) pairs */
    int inside;      /* garment vertices inside a part (analytic), once for each part */
    double deepest;  /* metres */
} Residual;

/* Room for meshes of up to this many edges and triangles. */
MUST_CHECK bool tester_reserve(Tester *t, int edges, int triangles, Arena *arena, Error *e);

/* Boxes the mesh; all arrays must stay until the last test. own: see Tester. */
void tester_build(Tester *t, const Vec3 *position, const Edge *edge, int nedges, const Triangle *triangle,
                  int ntriangles, unsigned own);

/* Counts the crossings with the parts in `parts` (bits 1 << role): *own those with parts that the
   garment is worn over, *other the rest. Appends their garment vertices to t->bad. */
void tester_cross(Tester *t, const BodyFrame *body, unsigned parts, Residual *own, Residual *other,
                  CrossingCount *count);

/* Counts the vertices inside any part, and appends them to t->bad. clear, if not NULL: per vertex the parts (bits
   1 << role) that it is known to be outside of. */
void tester_inside(Tester *t, const BodyFrame *body, const Vec3 *position, int nvertices, const unsigned *clear,
                   Residual *own, Residual *other);

#endif
