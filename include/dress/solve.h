/* The local deformation of a frame: attempts to push the cloth off the body, until one leaves nothing that shows. */
#ifndef DRESS_SOLVE_H
#define DRESS_SOLVE_H

#include "dress/attempt.h"

typedef struct {
    bool may_split;          /* patches, farther than the classification has; */
    bool fixed_topology;     /* but one and the same grid is laid over them */
    Cloth cloth;             /* set cloth.leaves before solver_frame, which splits them farther */
    Leaves fresh, kept;      /* before anything is carried along; of the best attempt so far */
    Leaves grid;             /* what is tessellated under a fixed topology */
    Field before;            /* what this frame goes on from (if tight); before frames that are astray, */
    bool is_astray;          /* as the last one was, that of the last that was not */
    bool is_thrown;          /* a frame has left something and thrown cloth far, where it has stayed since */
} Solver;

/* Fit and lattice must outlive the solver. */
MUST_CHECK bool solver_reserve(Solver *s, const Fit *fit, const Lattice *lattice, const DressOptions *options,
                               Arena *arena, Error *e);

/* Takes along what the frame that this one goes on from displaced, `dt` seconds ago; pushes the cloth off the body,
   unless `is_global`; leaves the mesh in cloth.sheet and cloth.position. Fills the solver's columns of *stats; adds
   to its pairs. */
Wrong solver_frame(Solver *s, const BodyFrame *body, const Patch *root, double dt, Tie tie, bool is_global,
                   FrameStats *stats);

#endif
