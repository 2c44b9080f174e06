/* Which triangles of a mesh share an edge, if vertices with the same coordinates count as one. */
#ifndef GEOMETRY_TOPOLOGY_H
#define GEOMETRY_TOPOLOGY_H

#include "base/arena.h"
#include "geometry/mesh.h"

/* A side of a triangle, as one of those that lie on an edge. */
typedef struct {
    int low, high;  /* its ends, as Topology.joined has them; low < high */
    int triangle;
    int way;        /* 1: the triangle runs from low to high, -1: from high to low */
} Side;

/* Sides of the same edge follow each other. */
typedef struct {
    int *joined; /* per vertex: the first vertex with the same coordinates */
    int nsides;
    Side *side;
} Topology;

/* wanted[t]: does triangle t count? NULL: all do. Sides without length are left out. */
MUST_CHECK bool topology_find(const Mesh *mesh, const bool *wanted, Arena *arena, Topology *out, Error *e);

/* How many sides from side i on lie on the same edge. */
int topology_run(const Topology *t, int i);

#endif
