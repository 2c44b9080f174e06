/* Candidates for legs and arms in any skeleton, by names and by shape. */
#ifndef FIGURE_LIMBS_H
#define FIGURE_LIMBS_H

#include "figure/tree.h"

typedef enum { LIMB_LEG, LIMB_ARM } LimbKind;

/* A leg (thigh, shin, foot) or an arm (upper arm, forearm, hand). The last one may be an end
   site, which only marks where the shin or forearm ends. */
typedef struct {
    int first;         /* the child of the hub with which its chain begins */
    int joint[3];
    int clavicle;      /* arms only; -1 = none */
    double length[2];  /* file units */
    double score;      /* how much it looks like a limb of that kind */
    int side;          /* as the names say: +1 left, -1 right, 0 nothing */
    bool found;
} Limb;

/* Two limbs of a kind that leave the trunk together. */
typedef struct {
    int hub;           /* the joint where they meet: their nearest common ancestor */
    Limb limb[2];
    double score;
} LimbPair;

/* Legs and arms that may belong to one human. */
typedef struct { const LimbPair *legs, *arms; } Limbs;

/* The best `most` pairs of a kind, best first. Returns their number. */
int limbs_find(const Tree *t, LimbKind kind, int most, LimbPair *out);

#endif
