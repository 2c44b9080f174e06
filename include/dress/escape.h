/* The way out of a part of the body for a point of the cloth: in which direction, and how far. */
#ifndef DRESS_ESCAPE_H
#define DRESS_ESCAPE_H

#include "dress/bodyframe.h"
#include "dress/lattice.h"

/* What tells on which side of the body the places of a garment belong. */
typedef struct {
    const Lattice *lattice;
    Vec3 *rest;            /* per place: its point in the bind pose; world, metres */
    const Patch *root;     /* root patches of the global shape of this frame */
} Escape;

/* A point of the cloth that has to keep its clearance from the body. */
typedef struct {
    int place;
    BodyPoint point;       /* where it is now */
    unsigned near;         /* parts near it (bits 1 << part), between which it may be squeezed */
    double clearance;      /* metres */
    double slack;          /* share of the clearance that may be missing */
} EscapePoint;

/* Cloth of a place that is at `at` (world, metres); no part is near it, nothing may be missing. */
static inline void escape_at(EscapePoint *p, int place, Vec3 at, double clearance) {
    p->place = place;
    p->near = 0;
    p->clearance = clearance;
    p->slack = 0;
    body_point_move(&p->point, at);
}

MUST_CHECK bool escape_reserve(Escape *s, const Lattice *lattice, Arena *arena, Error *e);

/* Remembers where every place is in the bind pose. root: the root patches in that pose. */
void escape_bind(Escape *s, const Patch *root);

/* Is cloth of a place worn over a part? Else the part comes to it from outside. */
static inline bool escape_is_own(const Escape *s, const BodyFrame *body, int place, int part) {
    return s->lattice->collide[place] & part_bit(body, part);
}

/* How far p must go along *n to be `wanted` metres away from a part; metres. distance: what it is now, *n: the part's
   outward unit normal at p, which is turned if it leads to the wrong side. */
double escape_way(const Escape *s, const BodyFrame *body, EscapePoint *p, int part, double wanted,
                  double distance, Vec3 *n);

/* The same for its clearance, or, between two parts, for half the room between them. 0: it may stay. */
double escape_asked(const Escape *s, const BodyFrame *body, EscapePoint *p, int part, double distance, Vec3 *n);

/* How far cloth of a place may go from `at` along n (unit), up to `most`, and keep its clearance from the parts that it
   is worn over; metres. */
double escape_free(const Escape *s, const BodyFrame *body, int place, Vec3 at, double clearance, Vec3 n, double most);

#endif
