/* The way out of a part of the body for one point of the cloth: in which direction, and how far. */
#ifndef DRESS_ESCAPE_H
#define DRESS_ESCAPE_H

#include "dress/bodyframe.h"
#include "dress/lattice.h"

/* What tells on which side of the body the places of a garment belong. */
typedef struct {
    const Lattice *lattice;
    Vec3 *rest;            /* per place: in the bind pose; world, metres */
    const Patch *root;     /* of this frame */
} Escape;

/* A point of the cloth that is to keep its distance from the parts. */
typedef struct {
    int place;
    BodyPoint point;       /* where it is now */
    unsigned near;         /* parts (bits 1 << part) that may take room from it */
    double clearance;      /* the distance, metres, */
    double slack;          /* of which this share may be missing */
} EscapePoint;

/* Cloth of a place that is at `at` (world, metres), near to no part so far, with nothing missing that may. */
static inline void escape_at(EscapePoint *p, int place, Vec3 at, double clearance) {
    p->place = place;
    p->near = 0;
    p->clearance = clearance;
    p->slack = 0;
    body_point_move(&p->point, at);
}

MUST_CHECK bool escape_reserve(Escape *s, const Lattice *lattice, Arena *arena, Error *e);

/* Remembers on which side of the body every place is: root patches in the bind pose. */
void escape_bind(Escape *s, const Patch *root);

/* Is cloth of a place worn over a part, or does that come to it from outside? */
static inline bool escape_is_own(const Escape *s, const BodyFrame *body, int place, int part) {
    return s->lattice->collide[place] & part_bit(body, part);
}

/* How far p, `distance` away from a part, must go along *n, the part's outward unit normal there, to be `wanted`
   away from it; metres. Turns *n where it leads to the wrong side. */
double escape_way(const Escape *s, const BodyFrame *body, EscapePoint *p, int part, double wanted,
                  double distance, Vec3 *n);

/* The same for its clearance, or as far as there is room. 0: it may stay. */
double escape_asked(const Escape *s, const BodyFrame *body, EscapePoint *p, int part, double distance, Vec3 *n);

/* How far cloth of a place may go from `at` along n (unit), at most that far, and keep its clearance from what it is
   worn over; metres. */
double escape_free(const Escape *s, const BodyFrame *body, int place, Vec3 at, double clearance, Vec3 n, double most);

#endif
