/* Signs that decide, never wrong: a double with an error bound, and exact arithmetic where
   the bound does not settle it (J. R. Shewchuk, Adaptive precision floating-point arithmetic
   and fast robust geometric predicates, 1997). Compile without FMA contraction. */
#ifndef GEOMETRY_PREDICATE_H
#define GEOMETRY_PREDICATE_H

#include <stdbool.h>

#include "geometry/vec.h"

/* Sign (-1, 0, 1) of the triple product [b-a, c-a, d-a]: 1 where d lies on the side of the
   plane a, b, c from which the three appear counter-clockwise. Exact for all finite doubles
   whose products neither overflow nor underflow (coordinates of 0 or 1e-60..1e60). */
int predicate_orient(Vec3 a, Vec3 b, Vec3 c, Vec3 d);

/* Sign of the 2-D cross product (b-a) x (c-a) of (x, y); exact likewise. */
int predicate_orient2(double ax, double ay, double bx, double by, double cx, double cy);

/* Do the closed segment p-q and the closed triangle a, b, c share a point? Exact. The tie
   rule: touching counts, at a corner, a side, an end or in a common plane (then the 2-D
   overlap decides). A zero-length segment is a point, a collapsed triangle the segment or
   point that is left of it. Equations (3) and (4) of the paper, made true for coplanar pairs. */
bool predicate_segment_triangle(Vec3 p, Vec3 q, Vec3 a, Vec3 b, Vec3 c);

/* The paper's equations (2) to (4) to the letter, in doubles, closed signs, no care. */
bool predicate_paper(Vec3 a, Vec3 b, Vec3 v0, Vec3 v1, Vec3 v2);

#endif
