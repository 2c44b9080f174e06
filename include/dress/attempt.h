/* One attempt to push the cloth of a frame off the body: it is pushed, tested as it will be written, and wherever the
   test finds something the vertices there are asked to keep more distance. */
#ifndef DRESS_ATTEMPT_H
#define DRESS_ATTEMPT_H

#include "dress/frame.h"
#include "dress/morph.h"
#include "dress/residual.h"
#include "dress/settle.h"

/* The cloth of one frame. Set root and leaves, then tessellate into sheet. */
typedef struct {
    const Fit *fit;
    const Patch *root;       /* of this frame */
    Leaves leaves;
    Sheet sheet;
    Morph morph;             /* of cells that were split or merged lately */
    Push push;
    Settler settler;
    Tester tester;
    Vec3 *position;          /* of the sheet's vertices as they are written: output units, snapped */
    Vec3 *moved;             /* private: where the vertices that have moved since the last test are now */
    bool *flag;              /* private: a mark for each vertex, with a meaning for each use */
} Cloth;

/* How an attempt ended: what is wrong with the mesh as it would be written (the vertices concerned are in tester.bad),
   and what the push took. */
typedef struct {
    Wrong wrong;
    PushResult push;
} Outcome;

/* How much shows of the parts that the garment is worn over. 0 is what attempts are made for. */
static inline int outcome_shows(const Outcome *o) { return residual_total(&o->wrong.own); }

/* Fit and lattice must outlive the cloth. */
MUST_CHECK bool cloth_reserve(Cloth *c, const Fit *fit, const Lattice *lattice, Arena *arena, Error *e);

/* Pushes the cloth, beginning at the global shape displaced by what its field holds, until nothing shows, or nothing
   gets better, or a cap is reached. Seconds and pairs are added to *stats, here and below. */
Outcome attempt_push(Cloth *c, const BodyFrame *body, FrameStats *stats);

/* Pushes nothing: the global shape displaced by what the field holds. */
Outcome attempt_rest(Cloth *c, const BodyFrame *body, FrameStats *stats);

/* Does so much show that there is no room for the garment, however it is pushed? */
bool attempt_is_hopeless(const Cloth *c, const Outcome *o);

/* Tests the cloth where it is now. */
Wrong attempt_test(Cloth *c, const BodyFrame *body, FrameStats *stats);

/* Raises facets that are so flat that the precision of the text would leave nothing of them. The last step of a frame.
   w: what the last test has found. Returns what is wrong now. Marks *stats as capped if some are left. */
Wrong attempt_raise_flat(Cloth *c, const BodyFrame *body, Wrong w, FrameStats *stats);

/* The number of vertices at which the last test found something that shows because there is no room for cloth between
   two parts, or none that it could reach, and of those inside a part that the garment is worn over. */
int attempt_pinched(Cloth *c, const BodyFrame *body);

#endif
