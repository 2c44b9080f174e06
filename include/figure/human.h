/* Finds the human in a tree of joints. */
#ifndef FIGURE_HUMAN_H
#define FIGURE_HUMAN_H

#include "figure/limbs.h"
#include "figure/roles.h"

/* Fills `out` with the joint of each role, -1 where there is none. If the joints form no human, only limbs whose names
   make them certain are filled. told: joints that are known to play their roles, else -1; of several figures the one
   that has them is found. Left and right go by names, else by where feet and knees point; names that feet and
   knees contradict are swapped, with a note. */
void human_find(const Tree *t, const Roles *told, Notes *notes, Roles *out);

#endif
