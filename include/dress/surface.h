/* The surface at all vertices of a sheet, evaluated leaf by leaf on the grids of geometry/grid. */
#ifndef DRESS_SURFACE_H
#define DRESS_SURFACE_H

#include "dress/field.h"
#include "geometry/grid.h"

/* Private. */
typedef struct {
    const Lattice *lattice;
    GridRows rows[LATTICE_LEVELS]; /* of a patch with detail << k facets along a side */
    Vec3 *grid, *part, *normal;    /* of one leaf */
} Surface;

MUST_CHECK bool surface_reserve(Surface *s, const Lattice *lattice, Arena *arena, Error *e);

/* out[v] becomes lattice_point of the place of vertex v. */
void surface_points(const Surface *s, const Sheet *sheet, const Patch *root, Vec3 *out);

/* The same for field_at of all levels, but for rounding. */
void surface_field(const Surface *s, const Sheet *sheet, const Field *f, Vec3 *out);

/* The same for field_normal of all levels, but for rounding, and with a direction at poles. */
void surface_normals(const Surface *s, const Sheet *sheet, const Field *f, const Patch *root, Vec3 *out);

#endif
