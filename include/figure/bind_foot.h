/* How feet and toes sit on their joints: the part of figure_bind that knows the ground. */
#ifndef FIGURE_BIND_FOOT_H
#define FIGURE_BIND_FOOT_H

#include "figure/binder.h"
#include "figure/rest.h"

/* The rotation of a foot's bind: the sole's left, up and forward as columns, in the frame of the ankle. Uses the bind
   of the pelvis. False where nothing tells where the foot points: no toe joint and no end site, or only one below the
   ankle. */
bool bind_foot(const Binder *b, Role foot, const Rest *rest, Mat3 *out);

/* Binds the toes of a foot that is bound, if the skeleton has a joint for them. */
void bind_toe(const Binder *b, Role foot, const Rest *rest);

#endif
