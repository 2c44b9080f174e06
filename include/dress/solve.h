/* The local deformation of a frame: patches are split, pushed and tested, anew where something is left. */
#ifndef DRESS_SOLVE_H
#define DRESS_SOLVE_H

#include "dress/frame.h"
#include "dress/residual.h"
#include "dress/settle.h"

/* What is wrong with the mesh as it would be written, and what finding that has cost; vertices that must not
   be where they are stand in the tester's list of bad ones. */
typedef struct {
    Residual own, other;   /* parts that the garment is worn over, and all others that it keeps out of */
    CrossingCount count;
} Wrong;

typedef struct {
    const Fit *fit;
    const Patch *root;       /* of this frame */
    bool may_split;          /* patches, farther than the classification has; */
    bool fixed_topology;     /* but one and the same grid is laid over them */
    Leaves leaves;           /* of this frame: set them before solver_frame, which splits them farther */
    Leaves fresh, kept;      /* before anything is carried along; of the best attempt so far */
    Leaves grid;             /* what is tessellated under a fixed topology */
    Sheet sheet;
    Push push;
    Field before;            /* frames that are astray, */
    bool is_astray;          /* as the last one was */
    Settler settler;
    Tester tester;
    Vec3 *position;          /* of the sheet's vertices as they are written: output units, snapped */
    Vec3 *moved;             /* positions of the vertices that have moved since a test */
    bool *clear;             /* per vertex: it is known to be outside of all parts */
} Solver;

/* Fit and lattice must outlive the solver. */
MUST_CHECK bool solver_reserve(Solver *s, const Fit *fit, const Lattice *lattice, const DressOptions *options,
                               Arena *arena, Error *e);

/* Takes along what the frame that this one goes on from displaced, `dt` seconds ago; pushes the cloth off the body,
   unless `is_global`; leaves the mesh in sheet and position. Fills the solver's columns of *stats and adds to
   *count. */
Wrong solver_frame(Solver *s, const BodyFrame *body, const Patch *root, double dt, Tie tie, bool is_global,
                   FrameStats *stats, CrossingCount *count);

/* The same last test for a mesh that another method has made. */
Wrong solver_test(Solver *s, const BodyFrame *body, const Mesh *mesh, CrossingCount *count);

#endif
