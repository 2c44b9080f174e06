/* Normals that see the facets which they shade. */
#ifndef GEOMETRY_FACING_H
#define GEOMETRY_FACING_H

#include "geometry/mesh.h"

/* The corners (3 * triangle + 0..2) of the vertices that need another look; private. */
typedef struct {
    int *corner;  /* per vertex: the first one */
    int *next;    /* per corner: the next one of the same vertex */
    int capacity; /* room for creases */
    Crease *crease;
} Facing;

/* Memory for meshes that are no larger. */
MUST_CHECK bool facing_reserve(Facing *f, int vertices, int triangles, Arena *arena, Error *e);

/* Normals of vertices that look away from one of the facets there, or nearly so, become those nearest to all of
   them; where no normal sees them all, corners get creases, which are f's. mesh->normal has room for twice as
   many normals as vertices were reserved. Done twice it changes nothing more. */
void facing_mend(const Facing *f, Mesh *mesh);

#endif
