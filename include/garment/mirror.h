/* How a garment grows while it is read: by a piece, or by the mirror image of what it has. */
#ifndef GARMENT_MIRROR_H
#define GARMENT_MIRROR_H

#include "garment/check.h"

/* Adds a panel or a raw patch and returns it, NULL where there are too many. Pieces count panels
   first, so a new panel moves the numbers of the patches in every seam, pin and collide. */
Panel *garment_add_panel(Garment *g, const char *name);
RawPatch *garment_add_patch(Garment *g, const char *name);

/* Adds the mirror image of everything whose name begins with `from`, named with `to` instead. */
MUST_CHECK bool garment_mirror(Garment *g, const char *from, const char *to, Why *why);

#endif
