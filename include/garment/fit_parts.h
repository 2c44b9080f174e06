/* What the rooms of garment/fit share; used by them alone. */
#ifndef GARMENT_FIT_PARTS_H
#define GARMENT_FIT_PARTS_H

#include "garment/fit.h"

/* A ring in space: its centre and its half axes, front and back apart. Canonical stance, metres. */
typedef struct {
    Vec3 centre, side, front, back;
} RingFrame;

/* A fit in the making. */
typedef struct {
    const Garment *g;
    const Body *body;
    Fit *fit;
    Arena *arena;
    int node_of[GARMENT_RINGS_MAX][STATION_COUNT];
    RingFrame ring[GARMENT_RINGS_MAX];
    Vec3 measure[GARMENT_RINGS_MAX]; /* factors for the file's lengths at a ring, along the canonical axes */
    int private_names;               /* the last name of a point that nobody shares: -1, -2, ... */
} Tailor;

/* fit_rings.c: sizes all rings to the body, makes their nodes, and joins those that the garment joins. */
MUST_CHECK bool fit_rings(Tailor *t, Error *e);

/* The number of the curve of a row, which is made when it is first used; rows through the same stations share it. */
int fit_curve(Tailor *t, const Row *row);

/* Sets `turn` of all curves, once they are made. */
void fit_turns(Fit *f);

/* Numbers the control points' names 0..npoints-1 in order of first use, and counts the openings. */
MUST_CHECK bool fit_number_points(Fit *f, Arena *arena, Error *e);

/* Appends the raw patches, sized to the figure, and sews them. private_names: the last name that
   was given to a point that nobody shares. */
MUST_CHECK bool fit_raw_patches(Fit *f, const Figure *figure, int *private_names, Arena *arena, Error *e);

/* How far du x dw of the quad (u0 w0, u0 w1, u1 w0, u1 w1) points away from `centre`: positive is
   outwards; grows with the area. */
double fit_outwardness(const Vec3 q[4], Vec3 centre);

#endif
