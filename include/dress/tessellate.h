/* Leaves to one watertight mesh. */
#ifndef DRESS_TESSELLATE_H
#define DRESS_TESSELLATE_H

#include "dress/refine.h"

/* The mesh's connectivity for one set of leaves: vertices are lattice places, used once each. */
typedef struct {
    const Lattice *lattice;
    int nvertices, ntriangles, nedges;
    int *place;              /* vertex -> lattice place */
    int *vertex;             /* lattice place -> vertex, -1 where the mesh has none */
    int *lone, nlone;        /* vertices that lie between the places of their owner's leaves */
    Triangle *triangle;      /* counter-clockwise from outside; patch by patch */
    int *first_of_patch;     /* npatches + 1: triangles of a patch */
    Edge *edge;
    int *first_edge, *next_edge; /* private: edges by their smaller vertex */
    unsigned char *laid;     /* the leaves that lie there, as in Leaves.level */
} Sheet;

MUST_CHECK bool sheet_reserve(Sheet *s, const Lattice *lattice, Arena *arena, Error *e);

/* Lays detail x detail facets over every leaf. Where a leaf meets a finer one, its border facets
   take the finer one's vertices in and become fans round their middle: no T-junctions. Leaves that
   are those of the last call cost nothing. */
void tessellate(Sheet *s, const Leaves *leaves);

/* The sheet as a mesh with these positions of its vertices. */
Mesh sheet_mesh(const Sheet *s, Vec3 *position);

/* The edges on borders of leaves, coarser than those tessellated or the same: each once, into room
   for 2 * nedges; returns how many. */
int sheet_borders(const Sheet *s, const Leaves *leaves, Edge *out);

#endif
