/* Hollows that limbs from outside press into a garment. A vertex in a hollow has dents: for each limb the vector by
   which it is pressed in (Field.dent). */
#ifndef DRESS_DENT_H
#define DRESS_DENT_H

#include "dress/hollow.h"
#include "dress/slope.h"

typedef struct {
    int nplaces;           /* of the lattice */
    bool is_off;           /* press nothing in, since that did harm in an earlier attempt */
    Hollow hollow;         /* of one limb after the other */
    Slopes slopes;
    double *depth[LIMBS];  /* per vertex: how far dent_all has pressed it in along Field.way, metres */
    double *held[LIMBS];   /* per place: how far it was pressed in in the frame that this one goes on from, faded, */
    Vec3 held_way[LIMBS];  /* and in which direction */
    double turn;           /* by how much that may turn in this frame, radians */
    bool is_held[LIMBS];   /* is there anything of it? */
    double *wanted[LIMBS]; /* depth before it was levelled */
    bool *is_out_of_reach; /* per place: would it have to go farther than the cap, or stretch an edge too far? All if
                              nothing is pressed in */
    bool *kept_out_of_reach; /* dent_keep: the same of another attempt */
    double *spare;         /* per place: extra clearance from own parts (metres), where an edge between the hollow's
                              vertices crossed one */
    bool any_spare;
    bool *is_back;         /* per place: was it taken back in this round? */
    int *back, nback;      /* the places that were */
    int *loose;            /* vertices whose dents were shortened since others round them were, */
    int nloose;
} Denter;

MUST_CHECK bool dent_reserve(Denter *d, const Lattice *lattice, Arena *arena, Error *e);

/* Takes over the dents of a frame that is dt seconds old. goes_on: does the frame of `body` go on from it? */
void dent_carry(Denter *d, const Field *last, const BodyFrame *body, double dt, bool goes_on);

/* Begins an attempt: nothing was taken back yet. */
void dent_start(Denter *d);

/* dent_keep remembers what is out of reach, dent_restore returns to it after another attempt. */
void dent_keep(Denter *d);
void dent_restore(Denter *d);

/* Begins a round of an attempt. A vertex is taken back at most once in each. */
void dent_round(Denter *d);

/* Presses hollows where limbs touch the cloth, as far as the own parts leave room. *capped becomes true if a cap kept a
   vertex from going farther. */
void dent_all(Denter *d, Push *p, bool *capped);

/* Adds a vector to the dent of a single vertex, because of a bare part. It then differs by at most `most` metres
   from what dent_all has set, and stretches no edge too far. */
void dent_add(Denter *d, Push *p, int vertex, int part, Vec3 by, double most, bool *capped);

/* Makes the dent of a vertex shallower, by more each time in an attempt, and keeps it so: an own part shows there.
   Cloth round it follows, as far as its edges would be stretched too far: it and these vertices are then d->loose.
   *capped becomes true if too much would have to follow. */
void dent_back(Denter *d, Push *p, int vertex, bool *capped);

#endif
