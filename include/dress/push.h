/* Local deformation: the body pushes the cloth out, the surface as a whole. */
#ifndef DRESS_PUSH_H
#define DRESS_PUSH_H

#include "dress/escape.h"
#include "dress/field.h"
#include "dress/near.h"
#include "dress/surface.h"

/* The unknowns that move the places of a cell of the deepest level: four level vertices of each level, by their
   numbers in Field.displacement, and how many levels have any that may move; and for one coordinate of a place how
   those at its two ends weigh. The weight of vertex 2 x + y is that of x along u times that of y along w. Private, as
   are samples. */
typedef struct { int unknown[LATTICE_LEVELS][4], levels; } PushCell;
typedef struct { double weight[LATTICE_LEVELS][2]; } PushAlong;

/* A mesh vertex near the body. */
typedef struct {
    int vertex, patch;
    const PushCell *cell;             /* what moves it, */
    const PushAlong *u, *w;           /* and by how much */
    double spent, budget;             /* push issued in this frame, and its limit; metres */
    Vec3 net;                         /* their sum */
    Near near;                        /* parts worth asking, and where it was when they were last asked, */
    unsigned asked;                   /* as those of these were where they give way; */
    double travelled;                 /* what it had gone at most by then (Push.travel), */
    double patch_travelled;           /* and its patch */
} PushSample;

/* The displacement and the solver's memory. */
typedef struct {
    const Lattice *lattice;
    const BodyFrame *body;            /* of this frame, */
    const Sheet *sheet;               /* and the cloth's mesh; borrowed, see push_start */
    Escape escape;
    Surface surface;
    Field field;
    Field kept;                       /* of another attempt, */
    Vec3 *kept_point;                 /* and where it left the vertices */
    int nkept;
    PushCell *cell;                   /* [patch][a][b] of the deepest level */
    PushAlong *along;                 /* per lattice coordinate, 0..side */
    double coarser;                   /* how far a level is moved against the next finer one, which moves less
                                         cloth: in (0, 1]. Set it before push_start */
    double *mobility;                 /* per level vertex: how willingly it moves in this frame */
    double *travel;                   /* per level vertex: metres moved since the samples were found, */
    double *patch_travel;             /* and per patch the most that anything on it can have; */
    int *first_neighbour, *neighbour; /* for what moves a patch moves those that share a corner with it */
    Vec3 *global, *point;             /* per mesh vertex: global shape, final shape */
    double *clearance;                /* per mesh vertex: distance asked for, */
    double slack;                     /* of which this share may be missing in this sweep */
    bool takes_back;                  /* do samples take pushes back in this sweep? */
    double taken;                     /* the most that one of them has taken back in it, metres */
    Near *near;                       /* per mesh vertex */
    bool near_known;                  /* since the frame or the sheet changed */
    PushSample *sample;
    int nsamples;
} Push;

typedef struct {
    int sweeps, active, pinched;
    double displacement;              /* largest move from the global shape */
    bool capped;
} PushResult;

MUST_CHECK bool push_reserve(Push *p, const Lattice *lattice, Arena *arena, Error *e);

/* Begins a solution: evaluates the global shape from the root patches at the vertices of the sheet. All that follows
   speaks of this body, these root patches and this sheet, which must stay where they are. */
void push_start(Push *p, const BodyFrame *body, const Patch *root, const Leaves *leaves, const Sheet *sheet);

/* Displaces the vertices of the sheet until they keep their clearance, but for what is left to dress/settle:
   projection onto half spaces, in sweeps. May be called again, with other clearances; adds to *result. */
void push_solve(Push *p, PushResult *result);

/* Moves a single vertex by so much more; no farther from the global shape than the cap. */
void push_vertex(Push *p, int vertex, Vec3 by, bool *capped);

/* Instead of solving: leaves the sheet where the field has it. */
void push_rest(Push *p);

/* Fills what the solution amounts to: active, pinched, displacement. */
void push_measure(const Push *p, PushResult *result);

/* Per mesh vertex whether it is known to be outside of all parts. */
void push_clear(const Push *p, bool *clear);

/* Keeps a solution of that many vertices, to take it back, with the sheet that it was made for, after
   another attempt. */
void push_keep(Push *p, int nvertices);
void push_restore(Push *p);

/* The distance that cloth keeps from the body, metres on a figure of 1.70 m. */
#define PUSH_MARGIN 0.003

#endif
