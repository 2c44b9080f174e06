/* A skeleton prepared for searching: what its names say, and how long its chains are. */
#ifndef FIGURE_TREE_H
#define FIGURE_TREE_H

#include "figure/names.h"
#include "figure/sample.h"

/* Lengths are means over the sample, file units. */
typedef struct {
    const Skeleton *skeleton;
    const Sample *sample;
    NameHint *hint;
    int *child, *sibling; /* first child, next sibling; -1 = none */
    double *bone, *reach; /* distance to the parent; length of the longest chain below */
} Tree;

MUST_CHECK bool tree_build(const Skeleton *skeleton, const Sample *sample, Arena *arena, Tree *out, Error *e);

/* Is `joint` below `ancestor` or the same? */
bool tree_below(const Tree *t, int joint, int ancestor);

/* Rigs may put a helper node where a bone's parent is and give it the bone's name. Returns the joint below such nodes
   that is the bone itself; `joint` where it is no such node. */
int tree_past_nodes(const Tree *t, int joint, Part part);

#endif
