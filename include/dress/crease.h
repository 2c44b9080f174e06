/* What folds do to the global shape (dress/follow). */
#ifndef DRESS_CREASE_H
#define DRESS_CREASE_H

#include "dress/fold.h"
#include "garment/fit.h"

/* A point that hangs half on the one bone of a joint and half on the other goes out to where the flesh of both sides
   meets. Returns where. binding: of the point; at: where a blend of its bones has left it; world, metres. */
Vec3 crease_mitre(const Figure *figure, const Pose *pose, const Binding *binding, Vec3 at);

/* Where a point of the cloth belongs. */
typedef enum {
    CREASE_APART,    /* it has nothing to do with this fold */
    CREASE_BETWEEN,  /* it follows both sides */
    CREASE_ABOVE,
    CREASE_BELOW
} CreaseSide;

/* By the bones that a point follows. */
CreaseSide crease_side(const Fold *fold, const Binding *binding);

/* Of what lies between two points: the side of both, or of the one if the other is between. */
CreaseSide crease_side_of_both(CreaseSide a, CreaseSide b);

/* Moves the four control points of a curve of the cloth so that both its ends (start, end: their sides), and its middle
   if they are on one side, do not lie beyond the fold's plane where the flesh of the other side is. World, metres. */
void crease_keep(const Body *body, const Pose *pose, const Fold *fold, CreaseSide start, CreaseSide end, Vec3 curve[4]);

/* The same for a curve that goes round half of the trunk, past both hips, and is on one side of the fold: at a third
   and at two thirds of it, where the thighs are. Its ends stay where they are. */
void crease_keep_between(const Body *body, const Pose *pose, const Fold *fold, CreaseSide side, Vec3 curve[4]);

#endif
