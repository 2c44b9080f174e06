/* The normals of the written mesh. */
#ifndef DRESS_NORMALS_H
#define DRESS_NORMALS_H

#include "dress/surface.h"

/* The corners (3 * triangle + 0..2) of the vertices that need another look; private. */
typedef struct {
    int *corner; /* per mesh vertex: the first one */
    int *next;   /* per corner: the next one of the same vertex */
    int capacity, nextra, ncreases; /* room for either of the two, which are as in Mesh */
    Crease *crease;
    Surface surface;
} Normals;

MUST_CHECK bool normals_reserve(Normals *n, const Lattice *lattice, Arena *arena, Error *e);

/* Unit outward normals at the sheet's vertices: those of the displaced patches (analytic). Where single
   vertices leave the patches, or the facets are too coarse for them, the one nearest to all facets round
   the vertex; and where no normal sees all of these, creases with further ones. `normal` has room for two
   a lattice place. */
void normals_find(Normals *n, const Field *f, const Patch *root, const Sheet *sheet, const Vec3 *position,
                  Vec3 *normal);

#endif
