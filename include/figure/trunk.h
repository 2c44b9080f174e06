/* The trunk of a human whose limbs are known: which joints are pelvis, spine, chest, neck and head. */
#ifndef FIGURE_TRUNK_H
#define FIGURE_TRUNK_H

#include "figure/limbs.h"
#include "figure/roles.h"

/* From the middle of the hips to the middle of the shoulders, in a frame of the sample, file units. */
Vec3 trunk_line(const Tree *t, int frame, const Limbs *limbs);

/* Sets the roles of pelvis, spine, chest, neck and head; those that the skeleton lacks stay as they are. */
void trunk_find(const Tree *t, const Limbs *limbs, Roles *out);

#endif
