/* The paper's method to the letter, kept as the baseline that others are measured against. */
#ifndef DRESS_LITERAL_H
#define DRESS_LITERAL_H

#include "dress/frame.h"

/* A leaf of a quadtree, with 16 control points of its own. */
typedef struct {
    Patch patch;      /* where it is now; world, metres */
    LatticeCell cell;
    int level;
    int hits;         /* (body edge, triangle) pairs by equations (2) to (4) */
    Vec3 motion;      /* of the body at these since the frame before; their sum */
    Vec3 moved;       /* of all 16 control points from the global shape */
} LiteralLeaf;

/* The leaves of one frame and their mesh; memory for any frame. */
typedef struct {
    const Lattice *lattice;
    LiteralLeaf *leaf; /* root patch by root patch */
    int nleaves;
    Mesh mesh;         /* a piece for each leaf, nothing shared: cracks between leaves stay visible */
    int *first_of_patch; /* npatches + 1: its triangles of a root patch */
    Triangle *facet;   /* of one leaf */
    Vec3 *point;       /* of one leaf; output units, snapped */
    double *side;      /* per vertex of a part: S_a012 */
    Pose before;       /* of the last frame that was not astray */
    bool has_before;
} Literal;

MUST_CHECK bool literal_reserve(Literal *l, const Lattice *lattice, const Body *body, Arena *arena, Error *e);

/* One frame from the global shape on:
   splits the root patches (all pairs by equations (2) to (4), de Casteljau, the stop rule), then
   moves the leaves that are hit along the motion of what hits them, step by step, until nothing
   does or a cap, and makes the mesh (but for its groups). In a frame that does not go on from another
   nothing has a direction, and all stays where it is. Fills what *stats has about the classification, the
   push and the mesh; hits that are left make it capped. */
void literal_frame(Literal *l, const Patch *root, const BodyFrame *body, Tie tie, SplitRule rule, FrameStats *stats);

#endif
