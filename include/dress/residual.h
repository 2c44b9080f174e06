/* What still intersects on exactly the mesh that is written. */
#ifndef DRESS_RESIDUAL_H
#define DRESS_RESIDUAL_H

#include "dress/bodyframe.h"

/* Edges and triangles of a garment, boxed. */
typedef struct {
    const Edge *edge;
    const Triangle *triangle;
    int nedges, ntriangles;
    CrossingSet edges, triangles;
} TesterCloth;

/* An edge (n = 2) or triangle (3) of the garment that crosses a part of the body, and where: the weights of
   its vertices. */
typedef struct {
    int part, n, v[3];
    double weight[3];
} TesterHit;

/* The vertex of a hit that is nearest to where it is. */
static inline int tester_hit_vertex(const TesterHit *hit) {
    int nearest = 0;
    for (int c = 1; c < hit->n; c++)
        if (hit->weight[c] > hit->weight[nearest]) nearest = c;
    return hit->v[nearest];
}

/* A garment mesh in output units, boxed for tests against the body, and room for what is found. */
typedef struct {
    unsigned own;         /* parts (bits 1 << role) that the garment is worn over */
    int *bad, nbad;       /* vertices that must not be where they are, in the order found */
    TesterHit *hit;       /* the crossings, likewise; of very many the first */
    int nhits;
    TesterCloth all;      /* private, as is what follows */
    bool is_stale;        /* its boxes are those of an earlier shape */
    Vec3 *position;
    TesterCloth some;     /* those with a vertex that moves */
    int some_edges_most, some_triangles_most;
    Edge *some_edge;
    Triangle *some_triangle;
    bool *moves;          /* per vertex */
    Crossing *found;
    Box *block;           /* boxes round the vertices */
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
void tester_build(Tester *t, Vec3 *position, const Edge *edge, int nedges, const Triangle *triangle, int ntriangles,
                  unsigned own);

/* Counts the crossings with the parts in `parts` (bits 1 << role): *own those with parts that the
   garment is worn over, *other the rest. Appends their garment vertices to t->bad, and themselves
   to t->hit. */
void tester_cross(Tester *t, const BodyFrame *body, unsigned parts, Residual *own, Residual *other,
                  CrossingCount *count);

/* Moves n vertices of the mesh: vertex[k] to to[k]. In *own, *other and *count stands what tester_cross, called
   once since the mesh was built, has counted with the same parts; what changes is counted anew, so that they,
   t->bad and t->hit are as if the mesh were built and tested again. */
void tester_move(Tester *t, const BodyFrame *body, unsigned parts, const int *vertex, const Vec3 *to, int n,
                 Residual *own, Residual *other, CrossingCount *count);

/* Counts the vertices inside any part, and appends them to t->bad. clear, if not NULL: per vertex whether it is
   known to be outside of all. */
void tester_inside(Tester *t, const BodyFrame *body, const Vec3 *position, int nvertices, const bool *clear,
                   Residual *own, Residual *other);

#endif
