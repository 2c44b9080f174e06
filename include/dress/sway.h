/* How violently a mesh moves: the acceleration of its points over three frames. */
#ifndef DRESS_SWAY_H
#define DRESS_SWAY_H

#include "geometry/boxtree.h"

/* A garment and its body in one frame. */
typedef struct {
    const Mesh *garment, *body;
    BoxTree garment_tree, body_tree;
} SwayFrame;
MUST_CHECK bool sway_frame(const Mesh *garment, const Mesh *body, Arena *arena, SwayFrame *out, Error *e);

/* Second differences of the vertices' positions over three frames in a row, before[0], before[1]
   and now: the length that 99 in 100 do not exceed, in units of the meshes per frame^2. Where the
   body's triangles are not the same in all three, both are NAN. Where the garment's are not, its
   points are followed: each goes along with the nearest part of the body and from there to the
   nearest point of the garment, which tells moves across the cloth and not those within it. */
MUST_CHECK bool sway_measure(const SwayFrame *const before[2], const SwayFrame *now, Arena *arena, double *garment,
                             double *body, Error *e);

#endif
