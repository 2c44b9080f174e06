/* The last millimetres: vertices that the sweeps left too near to the body, or whose edges and triangles still cross
   it, are moved one by one. */
#ifndef DRESS_SETTLE_H
#define DRESS_SETTLE_H

#include "dress/dent.h"
#include "dress/residual.h"

enum { MARKED_MOST = 1024 };

typedef struct {
    int *raised, nraised; /* mesh vertices that have to keep more clearance than all others, or follow one of them */
    bool *is_listed;      /* per vertex: is it one of these? */
    int nmarked;          /* how many of these settle_mark found; of more than MARKED_MOST nothing is remembered */
    Vec3 was_offset[MARKED_MOST], was_point[MARKED_MOST];
    Dents were_dents[MARKED_MOST];
    Denter denter;
} Settler;

MUST_CHECK bool settle_reserve(Settler *s, const Lattice *lattice, Arena *arena, Error *e);

/* Begins anew: nothing is raised. */
void settle_start(Settler *s);

/* Moves all vertices that are too near to a part, or those of them that were raised. *capped becomes true if that takes
   more than a single vertex may be moved, or more steps. */
void settle_all(Settler *s, Push *p, bool *capped);
void settle_raised(Settler *s, Push *p, bool *capped);

/* Raises a vertex: adds `by` to its clearance, up to `most` more than others have (metres on 1.70 m). Returns false
   if it has as much already. */
bool settle_raise(Settler *s, Push *p, int vertex, double by, double most);

/* An edge or triangle can cross the body although its vertices are outside. Moves the vertices of such a hit by the
   least that takes the point where it crosses out of the part. Does so only if all of them were raised before.
   *capped: as above. */
void settle_hit(Settler *s, Push *p, const TesterHit *hit, bool *capped);

/* Remembers where the raised vertices are, and puts them back there. False if there were too many. */
void settle_mark(Settler *s, const Push *p);
bool settle_restore(const Settler *s, Push *p);

#endif
