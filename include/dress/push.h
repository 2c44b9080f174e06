/* Local deformation of the surface as a whole: the body pushes the cloth out of itself. */
#ifndef DRESS_PUSH_H
#define DRESS_PUSH_H

#include "dress/escape.h"
#include "dress/field.h"
#include "dress/near.h"
#include "dress/surface.h"

/* Private. What moves the places of a cell of the deepest level: on each level four unknowns (level vertices, by their
   numbers in Field.displacement). levels: on how many levels there are any that may move. */
typedef struct { int unknown[LATTICE_LEVELS][4], levels; } PushCell;

/* Private. For one coordinate of a place, u or w: the weights of a cell's two ends, on each level. The weight of
   unknown 2 x + y is that of end x along u times that of end y along w. */
typedef struct { double weight[LATTICE_LEVELS][2]; } PushAlong;

/* Private. A mesh vertex near the body. */
typedef struct {
    int vertex, patch;
    const PushCell *cell;             /* what moves it, */
    const PushAlong *u, *w;           /* and with which weights */
    double spent, budget;             /* sum of the lengths of its pushes in this solution, and its limit; metres.
                                         budget < 0: it was not pushed yet */
    Vec3 net;                         /* sum of its pushes */
    Near near;                        /* the parts near it, and where it was when they were last asked */
    unsigned asked;                   /* those of these that give way and were asked (bits 1 << part) */
    double travelled;                 /* value of the bound on its own travel when they were last asked, */
    double patch_travelled;           /* and of Push.patch_travel of its patch */
} PushSample;

/* The displacement and the solver's memory. */
typedef struct {
    const Lattice *lattice;
    const BodyFrame *body;            /* of this frame, */
    const Sheet *sheet;               /* and the cloth's mesh; borrowed, see push_start */
    Escape escape;
    Surface surface;
    Field field;
    Field kept;                       /* push_keep: the field of another attempt, */
    Vec3 *kept_point;                 /* and where it left its vertices */
    int nkept;
    PushCell *cell;                   /* [patch][a][b] of the deepest level */
    PushAlong *along;                 /* per lattice coordinate, 0..side */
    double coarser;                   /* how far a level is moved against the next finer one, in (0, 1]: a coarser level
                                         moves more cloth. Set it before push_start */
    double *mobility;                 /* per level vertex: its share of a move, against that of a free one; 0: fixed */
    double *travel;                   /* per level vertex: metres moved since the samples were found, */
    double *patch_travel;             /* per patch: a bound on what anything on it has moved since then */
    int *first_neighbour, *neighbour; /* of each patch those that share a corner with it, and so its unknowns */
    Vec3 *global, *point;             /* per mesh vertex: global shape, final shape */
    double *clearance;                /* per mesh vertex: the distance that it has to keep, metres */
    double slack;                     /* share of the clearance that may be missing in this sweep */
    double reach;                     /* vertices farther from the body are no samples in this round, metres */
    bool takes_back;                  /* may samples take their pushes back in this sweep? */
    double taken;                     /* the most that one of them has taken back in it, metres */
    Near *near;                       /* per mesh vertex: the parts near it */
    bool near_known;                  /* is `near` filled for this frame and this sheet? */
    PushSample *sample;
    int nsamples;
} Push;

typedef struct {
    int sweeps, active;               /* as in FrameStats */
    double displacement;              /* largest move from the global shape, metres */
    bool capped;
} PushResult;

MUST_CHECK bool push_reserve(Push *p, const Lattice *lattice, Arena *arena, Error *e);

/* Begins a solution: evaluates the global shape from the root patches at the vertices of the sheet. All that follows
   speaks of this body, these root patches and this sheet, which must stay where they are. */
void push_start(Push *p, const BodyFrame *body, const Patch *root, const Leaves *leaves, const Sheet *sheet);

/* Displaces the surface until the vertices keep their clearance, but for the last bit, which is left to
   dress/settle. May be called again, with other clearances. Adds to *result. */
void push_solve(Push *p, PushResult *result);

/* Moves a single vertex by a vector, but no farther from the global shape than the cap. */
void push_vertex(Push *p, int vertex, Vec3 by, bool *capped);

/* Instead of push_solve: puts the vertices where the field has them. */
void push_rest(Push *p);

/* Fills active and displacement of *result. */
void push_measure(const Push *p, PushResult *result);

/* Is a vertex known to be outside of all parts? */
static inline bool push_is_clear(const Push *p, int vertex) {
    return p->near_known && near_clear(&p->near[vertex], p->point[vertex]);
}

/* push_keep stores a solution with its vertices, push_restore returns to it after another attempt. The sheet must then
   be that of the first one again. */
void push_keep(Push *p, int nvertices);
void push_restore(Push *p);

/* The distance that cloth keeps from the body, metres on a figure of 1.70 m. */
#define PUSH_MARGIN 0.003

#endif
