/* How far a garment stands off the body: the room that arms have to leave for it. */
#ifndef DRESS_PADDING_H
#define DRESS_PADDING_H

#include "figure/relax.h"
#include "garment/garment.h"

/* Adds the garment, as it hangs on the figure in the canonical stance: what of all that is worn stands
   off farthest counts. ERR_INPUT where the garment does not fit the body. Memory from arena. */
MUST_CHECK bool padding_add(const Garment *garment, const Figure *figure, const Body *body, Arena *arena, Padding *sum,
                            Error *e);

#endif
