/* One frame from end to end: a garment on a moving body. Read dresser_frame in frame.c and you know the method.

   Words of this floor:
     worn over     A garment is worn over some parts of the body (`collide` in its file): its own parts. All other
                   parts, such as arms for a skirt, come to it from outside: it gives way to them, but not so far that
                   an own part shows.
     global shape  The surface as it follows the pose, before the body pushes it.
     place         A point of the garment's surface that any mesh may use as a vertex (dress/lattice).
     level vertex  A corner of the quadtree's cells of a level. It carries one vector of the displacement field.
     clearance     The distance that a vertex has to keep from the body: PUSH_MARGIN, and more where it was raised,
                   because an edge or triangle beside it still crossed the body.
     sweep         One pass of the solver over the samples, the vertices near the body.
     limb          What presses on a garment from outside: an arm, or all other such parts together.
     offset, dent  What a single vertex is moved beside the field: out of its own parts, or into the garment where a
                   limb presses a hollow.
     pinched       Between parts that overlap, where no cloth fits; or in a limb that presses so deep that cloth would
                   have to go beyond its cap, or be stretched too far. */
#ifndef DRESS_FRAME_H
#define DRESS_FRAME_H

#include "dress/bodyframe.h"
#include "dress/refine.h"

/* How the local deformation is done: pushing shared vertices out of the body, the paper's way to
   the letter (dress/literal), or not at all. */
typedef enum { METHOD_PUSH, METHOD_PAPER, METHOD_GLOBAL } Method;

/* Zero is the default. */
typedef struct {
    Method method;
    SplitRule split;
    int detail;           /* facets per side of a root patch; 0 = the garment's, else 8 */
    int depth;            /* levels of splitting, 1..3; 0 = 2 */
    bool fixed_topology;  /* one grid over every root patch in every frame; not for METHOD_PAPER */
    bool plain_tests;     /* also classify without culling, to fill plain_s */
} DressOptions;

/* What happened in one frame, a row of stats.csv. Lengths in metres. */
typedef struct {
    int nodes, leaves, depth;         /* of the classification by the paper's rule */
    long long tests, tests_culled;    /* its edge-triangle pairs: all, as the paper counts, and what culling leaves */
    int cells;                        /* leaves after the solver refined further */
    int vertices, triangles;          /* of the written mesh */
    long long pairs_all, pairs_tested;/* edge-triangle pairs of all tests of the frame */
    int hits_before;                  /* body edges through the global shape */
    int sweeps, active;               /* solver sweeps, displaced level vertices */
    double displacement;              /* largest move from the global to the final shape */
    int residual_edges, residual_cloth, inside; /* against parts that the garment is worn over */
    double deepest;                   /* of the inside vertices */
    int limb_edges, limb_cloth, limb_inside;    /* against all others */
    int pinched;                      /* vertices for which there is no room, or none that cloth could reach */
    bool capped;                      /* a cap (sweeps, rounds, displacement) was reached */
    bool restarted;                   /* carried state dropped: jump in the motion */
    double global_s, test_s, push_s, mesh_s; /* seconds */
    double classify_s, plain_s;       /* of the classification, a part of test_s; of it without culling */
} FrameStats;

/* What a frame has to do with the one before it. */
typedef enum {
    TIE_GOES_ON, /* it takes over the displacement */
    TIE_AFRESH,  /* nothing: it is the first, or the figure has jumped */
    TIE_ASTRAY   /* nothing: a frame or few that do not belong to the motion; the next one that goes on takes over from
                    the last frame before them */
} Tie;

/* A garment on a figure with the state that is carried from frame to frame. */
typedef struct Dresser Dresser;

/* Fits the garment to the figure and its body and takes all the memory that frames need. All
   three must outlive the dresser. */
MUST_CHECK bool dresser_open(const Garment *garment, const Figure *figure, const Body *body,
                             const DressOptions *options, Arena *arena, Dresser **out, Error *e);

/* Dresses one frame. dt: seconds since the one that it goes on from. *mesh is filled with arrays of the
   dresser, valid until the next call: in output units (body->unit), snapped, with normals, u, w and a group for
   each panel; NULL: the statistics are enough. Allocates nothing. */
void dresser_frame(Dresser *d, const BodyFrame *body, double dt, Tie tie, Mesh *mesh, FrameStats *stats);

/* Leaves as the paper's rule splits (FrameStats.leaves), or as the solver refined them further
   (FrameStats.cells). METHOD_PAPER knows only the former. */
typedef enum { LEAVES_BY_RULE, LEAVES_CELLS } LeafKind;

/* The control points of the last frame's leaves, at most `capacity` of them: world, metres; returns how many leaves
   there are. The mesh lies on the cells but for the last millimetres, by which single vertices may have been moved;
   leaves by the rule are displaced as far as their own level and coarser ones go. */
int dresser_leaves(const Dresser *d, LeafKind kind, Patch *out, int capacity);

/* The edges of the last mesh that lie on borders of leaves, each once, into room for twice the
   edges of that mesh; returns how many. */
int dresser_borders(const Dresser *d, LeafKind kind, Edge *out);

/* Facts for `inspect`. own_parts: bits 1 << role that the garment collides with. size: at rest, metres. */
typedef struct { int patches, openings; unsigned own_parts; Vec3 size; } DresserInfo;
DresserInfo dresser_info(const Dresser *d);

#endif
