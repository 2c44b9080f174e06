/* Candidates for legs and arms in any skeleton, by names and by shape. */
#ifndef FIGURE_LIMBS_H
#define FIGURE_LIMBS_H

#include "figure/names.h"
#include "figure/sample.h"

typedef enum { LIMB_LEG, LIMB_ARM } LimbKind;

/* A leg (thigh, shin, foot) or an arm (upper arm, forearm, hand). The last one may be an end
   site, which only marks where the shin or forearm ends. */
typedef struct {
    int joint[3];
    int clavicle;      /* arms only; -1 = none */
    double length[2];  /* file units */
    double score;      /* how much it looks like a limb of that kind */
    int side;          /* as the names say: +1 left, -1 right, 0 nothing */
    bool found;
} Limb;

/* Two limbs that leave the same joint. */
typedef struct {
    LimbKind kind;
    int hub;           /* their nearest common ancestor */
    Limb limb[2];
    double score;
} LimbPair;

/* A skeleton prepared for searching. */
typedef struct {
    const Skeleton *skeleton;
    const Sample *sample;
    NameHint *hint;
    int *child, *sibling;  /* first child, next sibling; -1 = none */
    double *bone, *reach;  /* distance to the parent; longest way down from here */
} Tree;

MUST_CHECK bool tree_build(const Skeleton *skeleton, const Sample *sample, Arena *arena, Tree *out, Error *e);

/* Is `joint` below `ancestor` or the same? */
bool tree_below(const Tree *t, int joint, int ancestor);

/* The best `most` pairs of a kind, best first. Returns their number. */
int limbs_find(const Tree *t, LimbKind kind, int most, LimbPair *out);

#endif
