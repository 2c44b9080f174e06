/* What hangs together in a mesh: vertices in one place are one, sides that join the same two are one. */
#ifndef GEOMETRY_TOPOLOGY_H
#define GEOMETRY_TOPOLOGY_H

#include "base/arena.h"
#include "geometry/mesh.h"

/* A side of a triangle, from the view of the edge that it lies on. */
typedef struct {
    int low, high;  /* its ends, joined; low < high */
    int triangle;
    int way;        /* 1: the triangle runs from low to high, -1: from high to low */
} Side;

/* Sides of the same edge follow each other. */
typedef struct {
    int *joined; /* per vertex: the first vertex with the same coordinates */
    int nsides;
    Side *side;
} Topology;

/* Of the triangles with wanted[t] (NULL: all). A side without length (both ends in one place) is left out. */
MUST_CHECK bool topology_find(const Mesh *mesh, const bool *wanted, Arena *arena, Topology *out, Error *e);

/* How many sides from side i on lie on the same edge. */
int topology_run(const Topology *t, int i);

#endif
