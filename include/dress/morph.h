/* Splitting and merging without a jump: what is split opens from the facets that were there to the surface, and
   closes to them again before it is merged (geomorphing, Hoppe 1996). */
#ifndef DRESS_MORPH_H
#define DRESS_MORPH_H

#include "dress/tessellate.h"

typedef struct {
    const Lattice *lattice;
    double *open[LATTICE_LEVELS];  /* [level][cell], of all cells but the deepest: how far what it is split into has
                                      come from its facets (0) to the surface (1) */
    float *share;                  /* per place: that of the cells round it, the most open one's */
} Morph;

MUST_CHECK bool morph_reserve(Morph *m, const Lattice *lattice, Arena *arena, Error *e);

/* What dt seconds make of it. *leaves: those that are wanted now; those that are no longer wanted stay split in
   *leaves and *fresh until they have closed. restart: all that is split is open at once. */
void morph_carry(Morph *m, double dt, bool restart, Leaves *leaves, Leaves *fresh);

/* Moves the vertices of a sheet, given on the surface, towards the facets of the coarser one. */
void morph_points(const Morph *m, const Sheet *sheet, Vec3 *point);

#endif
