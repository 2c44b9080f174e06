/* Vertex normals that point to the same side as the facets that they shade. */
#ifndef GEOMETRY_FACING_H
#define GEOMETRY_FACING_H

#include "geometry/mesh.h"

/* Private. A corner is 3 * triangle + 0..2. */
typedef struct {
    int *corner;  /* per vertex that needs another normal: its first corner */
    int *next;    /* per corner: the next one of the same vertex */
    int capacity; /* room for creases */
    Crease *crease;
} Facing;

/* Takes memory for meshes of up to that size. */
MUST_CHECK bool facing_reserve(Facing *f, int vertices, int triangles, Arena *arena, Error *e);

/* Replaces the normal of a vertex that points away from one of its facets, or nearly, by the one that is nearest to
   all of them. If no normal points to the same side as all of them, some of their corners get normals of their own
   (creases, which belong to f: at most as many as vertices were reserved; other corners keep the mean). mesh->normal
   must have room for twice as many normals as vertices were reserved. A second call changes nothing. */
void facing_mend(const Facing *f, Mesh *mesh);

#endif
