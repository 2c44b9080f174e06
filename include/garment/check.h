/* What a garment must be beyond its grammar. Each check writes what is wrong into `why`, in the
   words of an error message; the parser knows the place. */
#ifndef GARMENT_CHECK_H
#define GARMENT_CHECK_H

#include "garment/garment.h"

typedef struct { char text[240]; } Why;

/* Writes what is wrong, and returns false. */
bool refuse(Why *why, const char *fmt, ...) PRINTF_LIKE(2, 3);

/* Can the name be (the beginning of) a file name on any system, a cell of a table, and no
   statement of the format? */
MUST_CHECK bool check_name(const char *name, Why *why);

/* Is the row an arc between neighbouring stations, of a ring that the panel does not have yet? */
MUST_CHECK bool check_row(const Garment *g, const Panel *panel, const Row *row, Why *why);

/* Has the raw patch an area? */
MUST_CHECK bool check_area(const RawPatch *patch, Why *why);

/* Are the two sides of a seam the same curve, point by point, in the same or in the opposite
   order, and neither sewn to another yet? `seam` is not among those of g. */
MUST_CHECK bool check_seam(const Garment *g, const Seam *seam, Why *why);

/* Two stations of different rings, neither joined to another yet? */
MUST_CHECK bool check_join(const Garment *g, const Join *join, Why *why);

/* Is there a patch that the statement speaks of? */
MUST_CHECK bool check_collide(const Garment *g, const Collide *collide, Why *why);
MUST_CHECK bool check_pin(const Garment *g, const Pin *pin, Why *why);

/* Can a garment that follows the envelope have this panel: all of its rings, in the order of the
   file, on torso and legs, each below the one before? *ring: the one that is wrong; -1: the panel is. */
MUST_CHECK bool check_envelope(const Garment *g, const Panel *panel, int *ring, Why *why);

#endif
