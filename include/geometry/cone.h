/* The narrowest cone that holds a handful of directions. */
#ifndef GEOMETRY_CONE_H
#define GEOMETRY_CONE_H

#include "geometry/vec.h"

/* The unit direction whose largest angle to n > 0 unit vectors is smallest; returns the cosine of that angle.
   Where every direction is 90 degrees or more from one of them, 0 or less is returned, and any of them. */
double cone_axis(const Vec3 *direction, int n, Vec3 *axis);

#endif
