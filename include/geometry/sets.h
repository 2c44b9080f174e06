/* Things 0..n-1 in sets that are joined two by two, where each thing may be turned against the
   first of its set: triangles of a surface, vertices of a border. */
#ifndef GEOMETRY_SETS_H
#define GEOMETRY_SETS_H

#include "base/arena.h"

/* Private inside: parent of each thing, and whether it is turned against its parent. */
typedef struct { int *parent; bool *turned; } Sets;

/* n sets of one. */
MUST_CHECK bool sets_make(Sets *sets, int n, Arena *arena, Error *e);

/* The first (smallest) of i's set. *turned, if not NULL: is i turned against it? */
int sets_find(Sets *sets, int i, bool *turned);

/* Makes one set of those of a and b, with a and b turned against each other or not. Where they
   are in one set already nothing happens. */
void sets_join(Sets *sets, int a, int b, bool against);

#endif
