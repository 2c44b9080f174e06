/* The last millimetres: single vertices that the sweeps left too near to the body, or whose facets still cut it, are
   moved by offsets of their own. */
#ifndef DRESS_SETTLE_H
#define DRESS_SETTLE_H

#include "dress/dent.h"
#include "dress/residual.h"

enum { MARKED_MOST = 1024 };

/* Mesh vertices that were asked for more clearance than all others, and where they were when they were marked. */
typedef struct {
    int *raised, nraised;
    int nmarked; /* of them; where there are more than MARKED_MOST, nothing is remembered */
    Vec3 was_offset[MARKED_MOST], was_dent[MARKED_MOST], was_point[MARKED_MOST];
    Denter denter;
} Settler;

MUST_CHECK bool settle_reserve(Settler *s, const Lattice *lattice, Arena *arena, Error *e);

/* Begins anew: nothing is raised. */
void settle_start(Settler *s);

/* Moves all vertices of a sheet that are too near to a part, or those of them that were raised. *capped becomes true
   where that takes more than a single vertex may be moved. */
void settle_all(Settler *s, Push *p, bool *capped);
void settle_raised(const Settler *s, Push *p, bool *capped);

/* Asks for `by` more clearance at a vertex, up to `most` more than others have (metres on 1.70 m). Returns false
   where it has as much. */
bool settle_raise(Settler *s, Push *p, int vertex, double by, double most);

/* Chords can cut the body although their ends are outside. Moves the vertices of a hit, if all were raised, by
   the least that takes its point out of the part. */
void settle_hit(Settler *s, Push *p, const TesterHit *hit);

/* Remembers where the raised vertices are, and puts them back there; false where there were too many. */
void settle_mark(Settler *s, const Push *p);
bool settle_restore(const Settler *s, Push *p);

#endif
