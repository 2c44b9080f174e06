/* Which parts of the body are near each vertex of a sheet, and how near. As distances change no faster than a vertex
   moves, what was found stays of use for some way. */
#ifndef DRESS_NEAR_H
#define DRESS_NEAR_H

#include "dress/tessellate.h"

/* A point and the parts near it. Distances are at most the true ones: those of parts that give way are measured as if
   nothing pressed on them. */
typedef struct {
    Vec3 seen;                      /* the point that all this holds for */
    unsigned parts;                 /* the parts near it: bits 1 << part */
    float least;                    /* the least of their distances; the limit of the search if there are none */
    float distance[BODY_PARTS_MAX]; /* of those in `parts` */
} Near;

/* The first part of a set that is not empty. To go through one:
       for (unsigned left = parts; left; left &= left - 1) ... near_first(left) ... */
static inline int near_first(unsigned parts) { return __builtin_ctz(parts); }

/* Fills near[v] for every vertex v, at point[v], with the parts that are nearer than `far`. known: what is known of
   vertices that have not moved since is kept. */
void near_find(Near *near, const BodyFrame *body, const Sheet *sheet, const Vec3 *point, double far, bool known);

/* Those of near->parts that have one of the roles (bits 1 << role). */
unsigned near_parts(const Near *near, const BodyFrame *body, unsigned roles);

/* Is p outside of all parts for certain? Measured distances are at most one and a half times the true
   ones (tests/unit_body.c), so half of them is trusted. */
bool near_clear(const Near *near, Vec3 p);

/* How far a point may go before a part at `distance` can be nearer than `clearance`. True distances change no faster
   than the point moves; measured ones are of first order, so only this share of the difference is trusted. */
#define NEAR_LIPSCHITZ 0.8
static inline double near_slack(double distance, double clearance) { return NEAR_LIPSCHITZ * (distance - clearance); }

/* The point is at p now: makes all distances smaller by as much as it has gone. */
void near_move(Near *near, Vec3 p);

/* Sets `least` from the distances; `far` if there are none. */
void near_sum(Near *near, double far);

#endif
