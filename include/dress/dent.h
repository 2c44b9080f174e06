/* Hollows that arms press into a garment. */
#ifndef DRESS_DENT_H
#define DRESS_DENT_H

#include "dress/push.h"

/* A vertex that an arm has to get past. */
typedef struct {
    Vec3 at;
    double depth, radius; /* how far it is pressed in, and how far about its hollow goes; metres */
} Presser;

/* Some that follow each other: where they stand, and the most that any of them is deep and wide. */
enum { PRESSERS_A_BLOCK = 16 };
typedef struct {
    const Presser *presser;
    int n;
    Box box;
    double deepest, radius;
} PresserBlock;

typedef struct {
    int nplaces;          /* of the lattice */
    bool is_off;          /* nothing is pressed in: it did harm in an attempt before */
    Presser *presser;
    int npressers;
    PresserBlock *block;
    int nblocks;
    Vec3 *way;            /* per vertex: in which direction it is pressed in, */
    double *depth;        /* and how far; */
    int *slope;           /* the edges of the sheet where it is */
    Vec3 *hollow;         /* per vertex: how far it was pressed in, not counting single vertices */
    FieldSpots held;      /* what is left of the hollows of the frame that this one goes on from */
    double *spare;        /* per place: metres more that the hollow keeps from what it is worn over, for between its
                             vertices it would go through that */
    bool any_spare;
    bool *is_back;        /* per place: taken back in this round; */
    int *back, nback;     /* the places that are */
} Denter;

MUST_CHECK bool dent_reserve(Denter *d, const Lattice *lattice, Arena *arena, Error *e);

/* Takes the hollows of a frame along that is dt seconds old. goes_on: whether the frame of `body` goes on from it. */
void dent_carry(Denter *d, const Field *last, const BodyFrame *body, double dt, bool goes_on);

/* Begins anew: hollows may be as deep as there is room. */
void dent_start(Denter *d);

/* Begins a round, in which a vertex is taken back once at most. */
void dent_round(Denter *d);

/* Presses the cloth in that arms which touch it have to get past, with what is round it; only as far as there is room
   in front of what it is worn over. *capped becomes true where a cap kept it from going farther. */
void dent_all(Denter *d, Push *p, bool *capped);

/* Moves a single vertex by so much more, at most that far from where its hollow is. */
void dent_add(const Denter *d, Push *p, int vertex, Vec3 by, double most, bool *capped);

/* Takes a vertex back out of its hollow, the farther the more often it is asked, and keeps it from there. */
void dent_back(Denter *d, Push *p, int vertex);

#endif
