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

/* Where a hit is, while the cloth's vertices are there. */
static inline Vec3 tester_hit_point(const TesterHit *hit, const Vec3 *position) {
    Vec3 x = {0, 0, 0};
    for (int c = 0; c < hit->n; c++) x = vec_mad(x, position[hit->v[c]], hit->weight[c]);
    return x;
}

/* What crosses or lies inside some parts of the body. */
typedef struct {
    int edges;       /* (body edge, garment triangle) pairs that share a point */
    int cloth;       /* (garment edge, body triangle) pairs */
    int inside;      /* garment vertices inside a part (analytic), once for each part */
    double deepest;  /* metres */
} Residual;

static inline int residual_total(const Residual *r) { return r->edges + r->cloth + r->inside; }

/* What is wrong with a mesh, and what finding that has cost. */
typedef struct {
    Residual own, other;   /* of parts that the garment is worn over; of all others, which come from outside */
    CrossingCount count;
} Wrong;

/* Private. The parts that a vertex is inside of (bits 1 << part), and how deep it is in those that the garment is worn
   over and in others, metres. */
typedef struct { unsigned parts; double own, other; } TesterSunk;

/* The last test's mesh, boxed, and where it found what. */
typedef struct {
    unsigned own;         /* parts (bits 1 << role) that the garment is worn over */
    int *bad, nbad;       /* vertices inside a part, or of an edge or triangle that crosses one, in the order found */
    TesterHit *hit;       /* the crossings, in the order found; of very many the first */
    int nhits;
    Vec3 *position;       /* private, as is what follows */
    int nvertices;
    TesterCloth all;
    TesterCloth some;     /* its edges and triangles with a vertex that moves */
    int some_edges_most, some_triangles_most;
    Edge *some_edge;
    Triangle *some_triangle;
    bool *moves;          /* per vertex */
    Crossing *found;
    Box *block;           /* boxes round the vertices */
    TesterSunk *sunk;     /* per vertex */
    int *inside;          /* the vertices inside parts */
} Tester;

/* Room for meshes of up to this many vertices, edges and triangles. own: see Tester. */
MUST_CHECK bool tester_reserve(Tester *t, int vertices, int edges, int triangles, unsigned own, Arena *arena, Error *e);

/* Tests a mesh in output units against all parts; its arrays must stay until the last test. clear, if not NULL: per
   vertex whether it is known to be outside of all parts, so that it need not be asked. */
Wrong tester_test(Tester *t, const BodyFrame *body, const Mesh *mesh, const bool *clear);

/* Moves n vertices of that mesh, vertex[k] to to[k], and tests it again. clear: of these alone. w: the last test's
   result. The new result, t->bad and t->hit are those of a test of the whole mesh, but for the order of the lists. */
Wrong tester_again(Tester *t, const BodyFrame *body, const int *vertex, const Vec3 *to, int n, const bool *clear,
                   Wrong w);

#endif
