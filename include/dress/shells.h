/* The solids that a triangle mesh bounds: pieces that hang together by their sides, and which
   points are inside of them. Knows nothing of how the mesh was made. */
#ifndef DRESS_SHELLS_H
#define DRESS_SHELLS_H

#include "geometry/boxtree.h"

/* A piece that hangs together by sides. Where it has holes, each is closed by a lid, a fan from
   the middle of its border, for the question of what is inside and for nothing else. */
typedef struct {
    BoxTree surface; /* its triangles, numbered as in the mesh, turned alike */
    BoxTree lids;
    int outward;     /* 1: triangles are counter-clockwise from outside, -1: inside out */
} Shell;

typedef struct {
    int count, open, inverted; /* all; with holes; inside out */
    Shell *shell;
} Shells;

/* Of the triangles with wanted[t] (NULL: all). mesh is borrowed. */
MUST_CHECK bool shells_find(const Mesh *mesh, const bool *wanted, Arena *arena, Shells *out, Error *e);

/* Is p strictly inside: not on the surface, which winds round it at least once? Exact. */
bool shell_holds(const Shell *shell, Vec3 p);

#endif
