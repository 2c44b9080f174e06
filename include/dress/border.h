/* The border of a mesh: how many pieces it has, and where it nearly meets itself, as it does at a
   crack or at a vertex that stands on the side of a triangle. */
#ifndef DRESS_BORDER_H
#define DRESS_BORDER_H

#include "geometry/mesh.h"

/* A border vertex with a border edge near in space that is not near along the border, is no other hem of the same
   cloth, and has its cloth on another side. */
typedef struct { int vertex; double distance; } Crack;

/* Edges of one triangle make the border; vertices with the same coordinates are one. */
typedef struct {
    int pieces;   /* of the border, each hanging together: a whole skirt has two */
    int ncracks;
    Crack *crack;
} Border;

/* reach: edges nearer than that may be cracks, in units of the mesh. */
MUST_CHECK bool border_find(const Mesh *mesh, double reach, Arena *arena, Border *out, Error *e);

#endif
