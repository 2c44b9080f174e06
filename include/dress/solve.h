/* The local deformation of a frame: attempts to push the cloth off the body, until after one nothing shows. */
#ifndef DRESS_SOLVE_H
#define DRESS_SOLVE_H

#include "dress/attempt.h"

typedef struct {
    bool may_split;          /* may patches be split farther than the classification has? */
    bool fixed_topology;     /* is one and the same grid tessellated in every frame? */
    Cloth cloth;             /* set cloth.leaves before solver_frame, which splits them farther */
    Leaves fresh;            /* leaves without those that the displacement of the frame before needs */
    Leaves kept;             /* of the best attempt so far */
    Leaves grid;             /* what is tessellated under a fixed topology */
    Field before;            /* the displacement that this frame began with (tight garments); during frames that are
                                astray, that of the last one that was not */
    Morph morph_before;      /* likewise, in such frames */
    bool is_astray;          /* was the last frame? */
    bool is_thrown;          /* was cloth displaced far in a frame after which something showed, and is it still? */
} Solver;

/* Fit and lattice must outlive the solver. */
MUST_CHECK bool solver_reserve(Solver *s, const Fit *fit, const Lattice *lattice, const DressOptions *options,
                               Arena *arena, Error *e);

/* Dresses a frame: takes over the displacement of the frame that it goes on from, `dt` seconds ago, and pushes the
   cloth off the body (is_global: leaves the global shape). The mesh is then in cloth.sheet and cloth.position. Fills
   the solver's columns of *stats, and adds to its pairs. Returns what is wrong with the mesh. */
Wrong solver_frame(Solver *s, const BodyFrame *body, const Patch *root, double dt, Tie tie, bool is_global,
                   FrameStats *stats);

#endif
