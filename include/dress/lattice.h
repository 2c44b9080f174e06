/* All points of a garment's surface that can be vertices of a mesh. Every root patch carries a square lattice of
   (side + 1)^2 places, fine enough for the deepest leaf; places that patches share along an edge or at a corner have
   the same number. A mesh of any refinement uses a subset of them.

   The local deformation is a displacement field on the same lattice. On level l a root patch has 2^l x 2^l cells;
   their corners are the level vertices, and each carries one displacement vector. The field over a cell is a bicubic
   patch: of its 4 x 4 control points the 2 x 2 nearest to a corner take that corner's vector. In other words, a
   corner has the weight h(u) h(w) with h(t) = 1 - 3t^2 + 2t^3. The slope of h at both ends is zero, so displaced
   patches still meet, with their tangent planes, at any seam and between any two levels. */
#ifndef DRESS_LATTICE_H
#define DRESS_LATTICE_H

#include "garment/fit.h"

enum { LATTICE_DEPTH_MAX = 3, LATTICE_LEVELS = LATTICE_DEPTH_MAX + 1 };

typedef struct { int patch, a, b; } LatticeCell; /* cell (a, b) of a level: a along u, b along w */
typedef struct { int patch, i, j; } LatticeIndex; /* of a place in a patch: i along u, j along w, 0..side */

/* A lattice coordinate among the cells of a level: in which cell it is, and the weights of the cell's two ends: h
   and its derivative by the patch parameter. */
typedef struct { int cell; double weight[2], slope[2]; } LatticeStep;

typedef struct {
    int count;
    int *vertex;        /* [patch][a * (2^l + 1) + b]: number of the level vertex */
    int *first_cell;    /* count + 1: the cells round vertex v are cell[first_cell[v]] to cell[first_cell[v + 1] - 1] */
    LatticeCell *cell;
    bool *pinned;
    LatticeStep *step;  /* 0..side, along either side of a patch */
} LatticeLevel;

typedef struct {
    const Fit *fit;
    int detail, depth;  /* facets per side of a leaf; levels of splitting */
    int side;           /* detail << depth: facets per side of a root patch at the deepest level */
    int nplaces;
    int *place;         /* [patch][i * (side + 1) + j]: number of the place */
    LatticeIndex *owner; /* per place: the patch on which it is evaluated, and where on it */
    unsigned *collide;  /* per place: parts that it is worn over (bits 1 << role): those that its patches share, and the
                           next bone of each limb; all others come to it from outside */
    bool *pinned;       /* per place */
    LatticeLevel level[LATTICE_LEVELS];
    double (*basis)[4], (*basis_slope)[4]; /* Bernstein values at i / side */
} Lattice;

MUST_CHECK bool lattice_build(const Fit *fit, int detail, int depth, Arena *arena, Lattice *out, Error *e);

/* The number of cells of the deepest level, of all patches. */
static inline int lattice_cells(const Lattice *l) { return l->fit->npatches << (2 * l->depth); }

/* Triangles of a mesh that is split everywhere, and the most edges that any mesh can have: those of cells that share
   none. */
static inline int lattice_triangles(const Lattice *l) { return 2 * l->fit->npatches * l->side * l->side; }
static inline int lattice_edges(const Lattice *l) { return lattice_cells(l) * l->detail * (3 * l->detail + 2); }

/* Number of a place of a patch. */
static inline int lattice_place(const Lattice *l, int patch, int i, int j) {
    int n = l->side + 1;
    return l->place[(patch * n + i) * n + j];
}

/* The point of a place on the root patches. */
Vec3 lattice_point(const Lattice *l, const Patch *root, int place);

/* The outward unit normal of a patch by its derivatives, and that of the root patches at a place. */
Vec3 lattice_outwards(const Lattice *l, int patch, Vec3 du, Vec3 dw);
Vec3 lattice_normal(const Lattice *l, const Patch *root, int place);

/* What moves a place on a level: the four level vertices round it, their weights, and the derivatives of these by the
   patch parameters. */
typedef struct { int vertex[4]; double weight[4], du[4], dw[4]; } LatticeWeights;
LatticeWeights lattice_weights(const Lattice *l, int level, LatticeIndex at);

#endif
