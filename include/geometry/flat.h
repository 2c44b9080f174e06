/* Triangles of nearly no height, which rounding makes of narrow ones. */
#ifndef GEOMETRY_FLAT_H
#define GEOMETRY_FLAT_H

#include "geometry/mesh.h"

/* Finds the triangles that are less than `least` high. For each, vertex[k] becomes the corner opposite its longest
   side (every vertex once), and to[k] a point at which the triangle would be four times `least` high. Returns their
   number, at most `capacity`. Moving a corner may flatten another triangle; so in every second round corners move
   out of their triangle's plane. */
int flat_find(const Vec3 *position, const Triangle *triangle, int ntriangles, double least, int round, int *vertex,
              Vec3 *to, int capacity);

#endif
