/* Which parts are near which vertex of a sheet: found for sixteen at a time, and found again only where
   something has moved. */
#ifndef DRESS_NEAR_H
#define DRESS_NEAR_H

#include "dress/tessellate.h"

/* A vertex and the parts that its place keeps out of, as they are where nothing presses on them: those that
   have given way are no nearer. */
typedef struct {
    Vec3 seen;       /* where the vertex was when it was asked about */
    double distance; /* to the nearest part, or `far` */
    unsigned parts;  /* nearer than `far`: bits 1 << part */
} Near;

/* Fills near[v] for all vertices, the n-th at point[n]. known: those that stand where they were seen stay. */
void near_find(Near *near, const BodyFrame *body, const Sheet *sheet, const Vec3 *point, double far, bool known);

/* Is a vertex that is at p now farther than `clearance` from all its parts for certain? Distances are of first
   order, so that only a share of them is trusted. */
bool near_none(const Near *near, Vec3 p, double clearance);

/* The share. */
#define NEAR_LIPSCHITZ 0.8

#endif
