/* One attempt to push the cloth of a frame off the body: it is pushed, tested as it will be written, and asked for
   more distance round what is found. */
#ifndef DRESS_ATTEMPT_H
#define DRESS_ATTEMPT_H

#include "dress/frame.h"
#include "dress/morph.h"
#include "dress/residual.h"
#include "dress/settle.h"

/* The cloth of one frame. Set root and leaves, then lay its sheet. */
typedef struct {
    const Fit *fit;
    const Patch *root;       /* of this frame */
    Leaves leaves;
    Sheet sheet;
    Morph morph;             /* of what is split anew, or no longer */
    Push push;
    Settler settler;
    Tester tester;
    Vec3 *position;          /* of the sheet's vertices as they are written: output units, snapped */
    Vec3 *moved;             /* private: where vertices that have moved since a test are now; */
    bool *flag;              /* a mark for every vertex, anew for each question */
} Cloth;

/* What is wrong with the mesh as it would be written, and what it took. Vertices that must not be where they are
   stand in the tester's list of bad ones. */
typedef struct {
    Wrong wrong;
    PushResult push;
} Outcome;

/* Fit and lattice must outlive the cloth. */
MUST_CHECK bool cloth_reserve(Cloth *c, const Fit *fit, const Lattice *lattice, Arena *arena, Error *e);

/* Pushes the cloth from the global shape, with what its field holds, until nothing shows, or nothing gets better, or a
   cap. Seconds and pairs are added to *stats, here and below. */
Outcome attempt_push(Cloth *c, const BodyFrame *body, FrameStats *stats);

/* Leaves the cloth where its field has it. */
Outcome attempt_rest(Cloth *c, const BodyFrame *body, FrameStats *stats);

/* Is so much left of the parts that the garment is worn over that there is no room for it, however it is pushed? */
bool attempt_is_hopeless(const Cloth *c, const Outcome *o);

/* Tests the cloth where it is now. */
Wrong attempt_test(Cloth *c, const BodyFrame *body, FrameStats *stats);

/* The last word: no facet folds over so far that the text of a file leaves nothing of it. w: what the last test has
   found; returns what is wrong now. */
Wrong attempt_raise_flat(Cloth *c, const BodyFrame *body, Wrong w, FrameStats *stats);

/* How many vertices a part from outside is left at because there is no room for its clearance on either side. */
int attempt_pinched(Cloth *c, const BodyFrame *body);

static inline int residual_total(const Residual *r) { return r->edges + r->cloth + r->inside; }

#endif
