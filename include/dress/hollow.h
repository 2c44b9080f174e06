/* Where limbs touch a garment from outside, in which direction they press, and how deep the hollow is that makes room
   for them. */
#ifndef DRESS_HOLLOW_H
#define DRESS_HOLLOW_H

#include "dress/push.h"

/* What touches the cloth, for each limb. */
typedef struct {
    unsigned parts[LIMBS]; /* its bare parts that press, bits 1 << part; 0 if it touches nothing */
    Vec3 way[LIMBS];       /* the direction in which it presses, unit */
    double missing[LIMBS]; /* the most of its clearance that is missing to cloth, metres */
} Touch;

Touch touch_find(const Push *p);

/* The limb that a part belongs to. */
Limb limb_of(const BodyFrame *body, int part);

/* Is a part bare: is the garment worn over it nowhere? Only such parts press. */
static inline bool limb_is_bare(const Push *p, int part) {
    return !(p->field.lattice->fit->collide & part_bit(p->body, part));
}

/* Private. A vertex of a limb's skin, and how far along the way cloth is that is behind it, metres. */
typedef struct {
    Vec3 at;
    double deep;
} HollowPoint;

/* Private. Points that follow each other: the ball round them, and the deepest. */
enum { HOLLOW_BLOCK = 24 };
typedef struct {
    const HollowPoint *point;
    int n;
    Vec3 middle;
    double radius, deepest;
} HollowBlock;

/* The hollow of a limb. */
typedef struct {
    Vec3 way;
    double share;         /* of its depth: less than 1 where the limb only begins to touch */
    double wide, cap;     /* metres: its radius where it is not deep, and the most that it may be deep */
    HollowPoint *point;
    HollowBlock *block, all;
    int npoints, nblocks;
} Hollow;

MUST_CHECK bool hollow_reserve(Hollow *h, Arena *arena, Error *e);

/* Begins with a limb. */
void hollow_find(Hollow *h, const Push *p, const Touch *t, Limb limb);

/* How deep its hollow is at a vertex, metres: up to the cap. */
double hollow_depth(const Hollow *h, const Push *p, int vertex);

#endif
