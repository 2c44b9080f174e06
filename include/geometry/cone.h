/* The narrowest cone that holds a handful of directions. */
#ifndef GEOMETRY_CONE_H
#define GEOMETRY_CONE_H

#include "geometry/vec.h"

/* *axis: the unit vector whose largest angle to n > 0 unit vectors is smallest. Returns the cosine of that angle. If
   every direction is 90 degrees or more from one of them, returns 0 or less, and *axis is arbitrary. */
double cone_axis(const Vec3 *direction, int n, Vec3 *axis);

#endif
