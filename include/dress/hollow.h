/* Where limbs touch a garment from outside, in which direction they press, and how deep the hollow is that makes room
   for them. */
#ifndef DRESS_HOLLOW_H
#define DRESS_HOLLOW_H

#include "dress/push.h"

/* What touches the cloth, for each limb. */
typedef struct {
    unsigned parts[LIMBS]; /* its bare parts, bits 1 << part; 0 if it touches nothing */
    Vec3 way[LIMBS];       /* the direction in which it presses, unit */
    Box before[LIMBS];     /* holds all cloth that it may press in */
} Touch;

Touch touch_find(const Push *p);

/* The limb that a part belongs to. */
Limb limb_of(const BodyFrame *body, int part);

/* Is a part bare: is the garment worn over it nowhere? Only such parts press. */
static inline bool limb_is_bare(const Push *p, int part) {
    return !(p->field.lattice->fit->collide & part_bit(p->body, part));
}

/* A vertex that a limb presses in, and the hollow round it. */
typedef struct {
    Vec3 at;
    double depth, radius; /* of the hollow, metres */
} Presser;

/* Pressers of vertices that follow each other: the box round them, and the largest depth and radius. */
enum { PRESSERS_A_BLOCK = 16 };
typedef struct {
    const Presser *presser;
    int n;
    Box box;
    double deepest, radius;
} PresserBlock;

/* The hollow of a limb: the deepest of its pressers' hollows everywhere. */
typedef struct {
    Vec3 way;
    Presser *presser;
    int npressers;
    PresserBlock *block;
    int nblocks;
    Box reach;
} Hollow;

MUST_CHECK bool hollow_reserve(Hollow *h, const Lattice *lattice, Arena *arena, Error *e);

/* Finds what a limb that touches presses in, as far as the own parts leave room. out_of_reach[v] becomes true where the
   cap keeps vertex v from going behind the limb. */
void hollow_find(Hollow *h, const Push *p, const Touch *t, Limb limb, bool *out_of_reach);

/* How deep the hollow is at a vertex, metres. */
double hollow_depth(const Hollow *h, const Push *p, int vertex);

#endif
