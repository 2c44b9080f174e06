/* How steep the sides of hollows may be: cloth stretches only so far. */
#ifndef DRESS_SLOPE_H
#define DRESS_SLOPE_H

#include "dress/push.h"

/* Private. An edge of the sheet in a hollow: how much deeper each of its vertices may be than the other, metres. */
typedef struct { int v[2]; double step[2]; } Slope;

typedef struct {
    Slope *slope;
    int *first_beside, *beside; /* the neighbours of each vertex */
    int made;                   /* Sheet.made of the sheet whose neighbours these are */
} Slopes;

MUST_CHECK bool slopes_reserve(Slopes *s, const Lattice *lattice, Arena *arena, Error *e);

/* The neighbours of a vertex: n of them. */
const int *slopes_beside(Slopes *s, const Sheet *sheet, int vertex, int *n);

/* Makes vertices shallower, which are to be moved along `way` by depth[v] metres, until no edge is stretched too far,
   so that cloth beside a vertex that has no room stays behind too. The result is the deepest hollow of that kind.
   Returns false if it was not reached within a cap. */
MUST_CHECK bool slopes_level(Slopes *s, const Push *p, Limb limb, double *const wanted[LIMBS], double *depth);

/* The share of `by`, 0 to 1, by which a vertex may move without stretching an edge too far. */
double slopes_share(Slopes *s, const Push *p, int vertex, Vec3 by);

/* The share of its dent that a vertex may keep so that the edge to its neighbour is not stretched too far. */
double slopes_keeps(const Push *p, int vertex, int beside);

#endif
