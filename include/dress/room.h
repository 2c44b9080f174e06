/* How far a garment stands off the body: the room that arms have to leave for it. */
#ifndef DRESS_ROOM_H
#define DRESS_ROOM_H

#include "figure/relax.h"
#include "garment/garment.h"

/* Adds the garment, as it hangs on the figure in the canonical stance: what of all that is worn stands
   off farthest counts. ERR_INPUT where the garment does not fit the body. Memory from arena. */
MUST_CHECK bool room_add(const Garment *garment, const Figure *figure, const Body *body, Arena *arena, Cloth *cloth,
                         Error *e);

#endif
