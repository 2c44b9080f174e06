/* Which patches are split: a quadtree over every root patch, and the paper's rule. */
#ifndef DRESS_REFINE_H
#define DRESS_REFINE_H

#include "dress/bodyframe.h"
#include "dress/lattice.h"
#include "geometry/grid.h"

typedef enum { SPLIT_ADAPTIVE, SPLIT_UNIFORM, SPLIT_NONE } SplitRule;

/* The leaves of the quadtrees: the level of the leaf over every deepest cell. */
typedef struct {
    const Lattice *lattice;
    unsigned char *level; /* [patch][x * cells + y], cells = 1 << depth */
} Leaves;

MUST_CHECK bool leaves_reserve(Leaves *leaves, const Lattice *lattice, Arena *arena, Error *e);

/* All leaves at one level. */
void leaves_fill(Leaves *leaves, int level);

/* Leaves of one lattice. */
void leaves_copy(const Leaves *from, Leaves *to);

/* Splits until the leaves over cell (a, b) of `level` are at that level or deeper. */
void leaves_split(Leaves *leaves, int patch, int level, int a, int b);

/* Splits until all cells round a level vertex are at its level or deeper, so that it may move. */
void leaves_open(Leaves *leaves, int level, int vertex);

int leaves_count(const Leaves *leaves);

/* The leaf whose first deepest cell is (x, y), if one starts there: returns its level or -1. */
static inline int leaf_at(const Leaves *leaves, int patch, int x, int y) {
    int depth = leaves->lattice->depth, cells = 1 << depth;
    int level = leaves->level[(patch * cells + x) * cells + y], size = 1 << (depth - level);
    return x % size == 0 && y % size == 0 ? level : -1;
}

typedef struct {
    int nodes, leaves, depth; /* patches ever made, leaves, deepest level */
    int hits;                 /* (body edge, triangle) pairs on the root patches, or on all leaves
                                 where these are split from the start */
    CrossingCount count;
    bool capped;              /* more hits than the list holds: some patches may be left unsplit */
} Classification;

/* Memory of the classification; private inside. */
typedef struct {
    const Lattice *lattice;
    GridRows rows[LATTICE_LEVELS]; /* at the corners of each level's facets */
    Vec3 *position, *written; /* corners of facets: in metres; in output units */
    Triangle *triangle;
    LatticeCell *cell, *next;
    bool *hit;
    Crossing *found;
    int found_capacity;
    CrossingSet set;
    bool plain;               /* test without culling, to measure against */
} Classifier;

MUST_CHECK bool classifier_reserve(Classifier *c, const Lattice *lattice, Arena *arena, Error *e);

/* The 2 n^2 facets of a cell whose (n + 1)^2 corners are vertices first, first + 1, ... along w. */
void facets_of_cell(int n, int first, Triangle *out);

/* Do two of four children (2 * a + b) that share a side both intersect? The paper's stop rule. */
static inline bool neighbours_hit(const bool hit[4]) {
    return (hit[0] && hit[1]) || (hit[0] && hit[2]) || (hit[1] && hit[3]) || (hit[2] && hit[3]);
}

/* The paper's rule on the global shape. A patch is hit if an edge of one of its colliders
   crosses its triangles (detail x detail x 2) or a corner of them lies inside. A patch that is
   hit is split in four, and all four are tested; where two that share a side are hit, splitting
   ends there; else those that are hit are split again, down to the lattice's depth. *by_rule and
   the numbers in *out are those of the rule alone; in *leaves the corners of the leaves that are
   hit are opened besides (see leaves_open), and root patches that a limb reaches into from outside
   are split once. count.pairs_all is what the paper counts: nodes
   x 2 detail^2 x edges of the garment's colliders. */
void classify(Classifier *c, const Patch *root, const BodyFrame *body, SplitRule rule, Leaves *by_rule, Leaves *leaves,
              Classification *out);

#endif
