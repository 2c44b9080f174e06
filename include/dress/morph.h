/* Splitting and merging cells without a jump: the new vertices of a cell that is split move from its facets to the
   surface in a fifth of a second, and back before it is merged (geomorphing, Hoppe 1996). */
#ifndef DRESS_MORPH_H
#define DRESS_MORPH_H

#include "dress/tessellate.h"

typedef struct {
    const Lattice *lattice;
    double *open[LATTICE_LEVELS];  /* [level][cell], for all levels but the deepest: how far the vertices that a cell
                                      gets by splitting have moved from its facets (0) to the surface (1) */
    float *share;                  /* per place: the largest `open` of the cells round it that are split there */
} Morph;

MUST_CHECK bool morph_reserve(Morph *m, const Lattice *lattice, Arena *arena, Error *e);

/* Moves on by dt seconds. leaves: those that this frame wants; cells that it no longer wants split stay split in
   *leaves and *fresh until their vertices are back on the facets. restart: all are on the surface at once. */
void morph_carry(Morph *m, double dt, bool restart, Leaves *leaves, Leaves *fresh);

/* Both of one lattice. */
void morph_copy(const Morph *from, Morph *to);

/* Moves vertices of a sheet, whose points are given on the surface, towards the facets of the coarser grid. */
void morph_points(const Morph *m, const Sheet *sheet, Vec3 *point);

#endif
