/* Triangles without height, as rounding makes of narrow ones. */
#ifndef GEOMETRY_FLAT_H
#define GEOMETRY_FLAT_H

#include "geometry/mesh.h"

/* Lists the corners of triangles that are less than `least` high, each once, and where they would stand four times
   as high; returns their number, `capacity` at most. A corner that steps aside from one triangle may get in the
   way of another: in every second round they step out of their triangle's plane instead. */
int flat_find(const Vec3 *position, const Triangle *triangle, int ntriangles, double least, int round, int *vertex,
              Vec3 *to, int capacity);

#endif
