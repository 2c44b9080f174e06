/* Hollows that arms press into a garment. A vertex in a hollow has a dent: the vector by which it is pressed in
   (Field.dent). */
#ifndef DRESS_DENT_H
#define DRESS_DENT_H

#include "dress/push.h"

/* A vertex that an arm presses in, and the hollow round it. */
typedef struct {
    Vec3 at;
    double depth, radius; /* of the hollow, metres */
} Presser;

/* Pressers of vertices that follow each other: the box round them, and the largest depth and radius. */
enum { PRESSERS_A_BLOCK = 16 };
typedef struct {
    const Presser *presser;
    int n;
    Box box;
    double deepest, radius;
} PresserBlock;

typedef struct {
    int nplaces;          /* of the lattice */
    bool is_off;          /* press nothing in, since that did harm in an earlier attempt */
    Presser *presser;     /* of all arms */
    int npressers;
    PresserBlock *block;
    int nblocks;
    Vec3 *way;            /* per vertex: the direction in which it is pressed in (unit), */
    double *depth;        /* and how far, metres */
    int *slope;           /* edges of the sheet in and round the hollows */
    Vec3 *hollow;         /* per vertex: its dent as dent_all has set it */
    FieldSpots held;      /* the dents of the frame that this one goes on from, faded */
    double *spare;        /* per place: extra clearance from own parts (metres), where an edge between the hollow's
                             vertices crossed one */
    bool any_spare;
    bool *is_back;        /* per place: was it taken back in this round? */
    int *back, nback;     /* the places that were */
} Denter;

MUST_CHECK bool dent_reserve(Denter *d, const Lattice *lattice, Arena *arena, Error *e);

/* Takes over the dents of a frame that is dt seconds old. goes_on: does the frame of `body` go on from it? */
void dent_carry(Denter *d, const Field *last, const BodyFrame *body, double dt, bool goes_on);

/* Begins an attempt: nothing was taken back yet. */
void dent_start(Denter *d);

/* Begins a round of an attempt. A vertex is taken back at most once in each. */
void dent_round(Denter *d);

/* Presses hollows where arms touch the cloth, as far as the own parts leave room. *capped becomes true if a cap kept a
   vertex from going farther. */
void dent_all(Denter *d, Push *p, bool *capped);

/* Adds a vector to the dent of a single vertex, which then differs by at most `most` metres from what dent_all has
   set. */
void dent_add(const Denter *d, Push *p, int vertex, Vec3 by, double most, bool *capped);

/* Makes the dent of a vertex shallower, by more each time in an attempt, and keeps it so: an own part shows there. */
void dent_back(Denter *d, Push *p, int vertex);

#endif
