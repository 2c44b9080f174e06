/* Folds. Where a hip, knee or elbow bends far, flesh and cloth of both sides meet at the plane through the joint that
   halves the bend. Flesh is pressed flat along it (dress/yield), cloth stays on its own side of it (dress/crease). */
#ifndef DRESS_FOLD_H
#define DRESS_FOLD_H

#include "figure/body.h"

/* The fold at a joint. What belongs to the trunk's side of the joint is above the fold, the rest below. World frame,
   metres. */
typedef struct {
    Role lower;      /* the bone below the joint: a thigh, shin or forearm */
    double closed;   /* from 0: the joint is open, there is no fold, to 1: it is folded */
    Vec3 joint;
    Vec3 inwards;    /* unit: from the joint into the fold, within the plane */
    Vec3 across;     /* unit normal of the plane, towards what is above */
    double radius;   /* of the limb at the joint */
    double reach;    /* flesh is pressed flat where that of the other side is nearer than this */
} Fold;

/* Those of a body, in no order that matters. */
enum { FOLDS = 6 };
typedef struct { Fold fold[FOLDS]; } Folds;

/* Finds the folds of a pose. One whose joint the body lacks is open. */
Folds folds_find(const Body *body, const Pose *pose);

/* Does a bone hang on another at a joint that folds: a thigh on the pelvis, a shin on its thigh, a forearm on its upper
   arm? */
bool fold_joins(Role bone, Role on);

/* Is a part of that role above the fold, and does it meet what is below in it? That is what the bone below hangs on; of
   a hip also spine and chest. */
bool fold_has_above(const Fold *fold, Role role);

/* The fold in which parts of two roles meet; NULL if there is none, or it is open. */
const Fold *folds_between(const Folds *folds, Role a, Role b);

#endif
