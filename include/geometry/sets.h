/* Union-find with parity: things 0..n-1 in sets that are joined two by two. Two things of a set are turned alike or
   against each other, as triangles of a surface that run the same way round or not. */
#ifndef GEOMETRY_SETS_H
#define GEOMETRY_SETS_H

#include "base/arena.h"

/* Private inside: parent of each thing, and whether it is turned against its parent. */
typedef struct { int *parent; bool *turned; } Sets;

/* Makes n sets of one thing each. */
MUST_CHECK bool sets_make(Sets *sets, int n, Arena *arena, Error *e);

/* The smallest number in i's set. *turned, if not NULL: is i turned against it? */
int sets_find(Sets *sets, int i, bool *turned);

/* Joins the sets of a and b. against: a and b are turned against each other. Nothing happens if they are in one set
   already. */
void sets_join(Sets *sets, int a, int b, bool against);

#endif
