/* Local deformation: the body pushes the cloth out. */
#ifndef DRESS_PUSH_H
#define DRESS_PUSH_H

#include "dress/field.h"
#include "dress/near.h"
#include "dress/residual.h"
#include "dress/surface.h"

/* A mesh vertex near the body, with the level vertices that move it. Private. */
typedef struct {
    int vertex, n;                    /* n: level vertices; -1 until somebody asks */
    int id[4 * LATTICE_LEVELS];       /* into Field.displacement */
    double weight[4 * LATTICE_LEVELS], norm2;
    double spent, budget;             /* push issued in this frame, and its limit; metres */
    Vec3 net;                         /* their sum */
    Near near;                        /* parts worth asking, and where it was when they were last asked, */
    unsigned asked;                   /* as those of these were where they give way; */
    double travelled;                 /* what it had gone at most by then (Push.travel) */
} PushSample;

enum { MARKS_MAX = 1024 };

/* The displacement and the solver's memory. */
typedef struct {
    const Lattice *lattice;
    Surface surface;
    Field field;
    Field kept;                       /* of another attempt, */
    Vec3 *kept_point;                 /* and where it left the vertices */
    int nkept;
    bool *active;                     /* per level vertex: all cells round it are split to its level */
    double *mobility;                 /* per level vertex: how willingly it moves */
    double *travel;                   /* per level vertex: metres moved since the samples were found, */
    bool any_travel;                  /* if anything was */
    const Patch *root;                /* of this frame */
    Vec3 *rest;                       /* per lattice place: in the bind pose */
    Vec3 *global, *point;             /* per mesh vertex: global shape, final shape */
    double *clearance;                /* per mesh vertex: distance asked for, */
    double slack;                     /* of which this share may be missing */
    Near *near;                       /* per mesh vertex */
    bool near_known;                  /* since the frame or the sheet changed */
    PushSample *sample;
    int nsamples;
    int *raised, nraised;             /* mesh vertices that were asked for more */
    Vec3 was_offset[MARKS_MAX], was_point[MARKS_MAX]; /* per raised vertex: when push_mark was called, */
    int nmarked;                      /* when there were so many */
} Push;

typedef struct {
    int sweeps, active, pinched;
    double displacement;              /* largest move from the global shape */
    bool capped;
} PushResult;

MUST_CHECK bool push_reserve(Push *p, const Lattice *lattice, Arena *arena, Error *e);

/* Sets how far a level is moved against the next finer one, which moves less cloth: in (0, 1]. */
void push_weigh(Push *p, double coarser);

/* Remembers on which side of the body every place is: root patches in the bind pose. */
void push_bind(Push *p, const Patch *root);

/* Evaluates the global shape from the root patches at the vertices of the sheet. */
void push_start(Push *p, const Patch *root, const Leaves *leaves, const Sheet *sheet);

/* Displaces the vertices of the sheet until they keep their clearance: projection onto half
   spaces, in sweeps. May be called again after push_raise; adds to *result. */
void push_solve(Push *p, const BodyFrame *body, const Sheet *sheet, PushResult *result);

/* Instead of solving: leaves the sheet on the global shape. */
void push_rest(Push *p, const Sheet *sheet);

/* Asks for more clearance at a vertex, up to `most` more than others have (metres on 1.70 m). Returns false
   where it has as much. Vertices that were raised push_settle moves alone. */
bool push_raise(Push *p, int vertex, double by, double most);

/* Chords can cut the body although their ends are outside. Moves the vertices of a hit, if they were raised, by
   the least that takes its point out of the part. */
void push_off(Push *p, const BodyFrame *body, const Sheet *sheet, const TesterHit *hit);
void push_settle(Push *p, const BodyFrame *body, const Sheet *sheet, PushResult *result);

/* Remembers where the raised vertices are, and puts them back there; false where there were too many. */
void push_mark(Push *p, const Sheet *sheet);
bool push_unsettle(Push *p, const Sheet *sheet);

/* Fills what the solution amounts to: active, pinched, displacement. */
void push_measure(const Push *p, const BodyFrame *body, const Sheet *sheet, PushResult *result);

/* Per mesh vertex the parts (bits 1 << role) that it is known to be outside of. */
void push_clear(const Push *p, const Sheet *sheet, unsigned *clear);

/* Keeps a solution of that many vertices, to take it back, with the sheet that it was made for, after
   another attempt. */
void push_keep(Push *p, int nvertices);
void push_back(Push *p);

/* The distance that cloth keeps from the body, metres on a figure of 1.70 m. */
#define PUSH_MARGIN 0.003

#endif
