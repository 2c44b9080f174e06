/* Pieces of work that do not wait for each other, such as the garments of one frame: whoever has nothing
   else to do takes some. */
#ifndef APP_CREW_H
#define APP_CREW_H

#include "app/press.h"

/* Does piece 0..count-1, with the pen of the thread that it is done on. */
typedef void CrewPiece(void *context, int piece, Pen *pen);

/* Does all pieces, each once, and returns when all are done; in the meantime this thread writes meshes of
   the tally, if others still have pieces of it in hand. */
void crew_do(Press *press, Pen *pen, PressTally *tally, CrewPiece *run, void *context, int count);

/* For a thread that is free and holds the press's lock, which it lends meanwhile: does one piece. False if
   there is none. */
bool crew_help(Press *press, Pen *pen);

#endif
