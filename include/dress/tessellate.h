/* Leaves to one watertight mesh. */
#ifndef DRESS_TESSELLATE_H
#define DRESS_TESSELLATE_H

#include "dress/refine.h"

/* The mesh's connectivity for one set of leaves: vertices are lattice places, used once each. */
typedef struct {
    const Lattice *lattice;
    int nvertices, ntriangles, nedges;
    int made;                /* how many sheets it has been, so that who remembers one knows another */
    int *place;              /* vertex -> lattice place */
    int *vertex;             /* lattice place -> vertex, -1 where the mesh has none */
    int *lone, nlone;        /* vertices that are on no grid of their owner's leaves: only a finer neighbour has them */
    Triangle *triangle;      /* counter-clockwise from outside; patch by patch */
    int *first_of_patch;     /* npatches + 1: triangles of a patch */
    Edge *edge;
    int *first_edge, *next_edge; /* private: edges by their smaller vertex */
    unsigned char *laid;     /* the leaves that were tessellated, as in Leaves.level */
} Sheet;

MUST_CHECK bool sheet_reserve(Sheet *s, const Lattice *lattice, Arena *arena, Error *e);

/* Covers every leaf with detail x detail facets of two triangles. A facet at the border to a finer leaf takes in
   that leaf's vertices and becomes a fan round its middle, so that there are no T-junctions. A call with the same
   leaves as the last one costs nothing. */
void tessellate(Sheet *s, const Leaves *leaves);

/* The sheet as a mesh with these positions of its vertices. */
Mesh sheet_mesh(const Sheet *s, Vec3 *position);

/* The edges on the borders of leaves, which are those tessellated or coarser ones: each once, into room for 2 * nedges;
   returns how many. */
int sheet_borders(const Sheet *s, const Leaves *leaves, Edge *out);

#endif
