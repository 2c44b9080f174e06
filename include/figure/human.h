/* Finds the human in a tree of joints. */
#ifndef FIGURE_HUMAN_H
#define FIGURE_HUMAN_H

#include "figure/limbs.h"
#include "figure/roles.h"

/* Fills `out` with what is there, -1 elsewhere. Where the joints form no human, only the
   limbs that were recognised are filled. Left and right go by names, else by the way the
   feet and knees point; names that feet and knees contradict are swapped, with a note. */
void human_find(const Tree *t, Notes *notes, Roles *out);

#endif
