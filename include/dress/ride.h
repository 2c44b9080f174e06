/* Cloth that rides up a thigh, as trousers do when their wearer sits down. */
#ifndef DRESS_RIDE_H
#define DRESS_RIDE_H

#include "garment/fit.h"

/* Slides nodes that follow a thigh alone up along it, where the way to them from the row above is much longer than at
   rest. curve: the control points of every curve of the fit in this pose, world, metres. up: room for a number per
   node. */
void ride_up(const Fit *fit, const Figure *figure, const Pose *pose, Vec3 (*curve)[4], double *up);

#endif
