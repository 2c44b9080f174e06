/* Whether a garment covers what it should: how far it goes round certain places of the body. */
#ifndef DRESS_COVER_H
#define DRESS_COVER_H

#include "geometry/boxtree.h"

typedef enum { COVER_HIPS, COVER_THIGHS, COVER_KNEES, COVER_TORSO, COVER_COUNT } CoverPlace;

/* "hips", "thighs", ... */
extern const char *const cover_names[COVER_COUNT];

/* From each place (a pair, such as the knees, has two: the smaller counts) rays go out all round,
   square to the trunk, at the legs also square to the thigh. share[place]: how many of them, from
   0 to 1, meet the garment; NAN where the body has no groups named by the roles that are needed.
   Places are found in the shape of the groups: the hips between the upper ends of the thighs, the
   middle of a thigh, the knee at its lower end, the middles of spine and chest for the torso. */
MUST_CHECK bool cover_measure(const Mesh *body, const Mesh *garment, Arena *arena, double share[COVER_COUNT],
                              Error *e);

#endif
