/* Rooms of garment/fit that are too large to share a file with it; used by it alone. */
#ifndef GARMENT_FIT_PARTS_H
#define GARMENT_FIT_PARTS_H

#include "garment/fit.h"

/* Numbers the control points' names 0..npoints-1 in order of first use, and counts the openings. */
MUST_CHECK bool fit_number_points(Fit *f, Arena *arena, Error *e);

/* Appends the raw patches, sized to the figure, and sews them. private_names: the last name that
   was given to a point that nobody shares. */
MUST_CHECK bool fit_raw_patches(Fit *f, const Figure *figure, const Body *body, int *private_names, Arena *arena,
                                Error *e);

/* How far du x dw of the quad (u0 w0, u0 w1, u1 w0, u1 w1) points away from `centre`: positive is
   outwards; grows with the area. */
double fit_outwardness(const Vec3 q[4], Vec3 centre);

#endif
