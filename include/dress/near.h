/* Which parts are near which vertex of a sheet, and how near: found for sixteen vertices at a time, and good for
   some way that they move. */
#ifndef DRESS_NEAR_H
#define DRESS_NEAR_H

#include "dress/tessellate.h"

/* A point and the parts near it. Distances are those where nothing presses on the parts, or less: what has given
   way is no nearer. */
typedef struct {
    Vec3 seen;                      /* the point that all this holds for */
    unsigned parts;                 /* near: bits 1 << part */
    float least;                    /* their least distance; what it was asked for where there is none */
    float distance[BODY_PARTS_MAX]; /* of those in `parts` */
} Near;

/* The first part of a set that is not empty. To go through one:
       for (unsigned left = parts; left; left &= left - 1) ... near_first(left) ... */
static inline int near_first(unsigned parts) { return __builtin_ctz(parts); }

/* Fills near[v] for all vertices, the n-th at point[n], with the parts that are nearer than `far`. known: those
   that stand where they were seen stay. */
void near_find(Near *near, const BodyFrame *body, const Sheet *sheet, const Vec3 *point, double far, bool known);

/* Those of near->parts that have one of the roles (bits 1 << role). */
unsigned near_parts(const Near *near, const BodyFrame *body, unsigned roles);

/* Does no part hold p for certain? A guess would not do: distances are never more than half too long
   (tests/unit_body.c), and only a half of them is trusted. */
bool near_clear(const Near *near, Vec3 p);

/* How far the point may go before a part at `distance` can be nearer than `clearance`. */
#define NEAR_LIPSCHITZ 0.8 /* distances change no faster than the point moves; they are of first order, so no more
                              than this share of a slack is trusted */
static inline double near_slack(double distance, double clearance) { return NEAR_LIPSCHITZ * (distance - clearance); }

/* The point is at p now. Parts may have come nearer by as much as it has gone. */
void near_move(Near *near, Vec3 p);

/* Finds the least distance anew. */
void near_sum(Near *near, double far);

#endif
