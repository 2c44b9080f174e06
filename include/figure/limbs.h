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

/* Two limbs of a kind that leave the trunk together. */
typedef struct {
    LimbKind kind;
    int hub;           /* the joint where they meet: their nearest common ancestor */
    Limb limb[2];
    double score;
} LimbPair;

/* Legs and arms that may belong to one human. */
typedef struct { const LimbPair *legs, *arms; } Limbs;

/* A skeleton prepared for searching: lengths are means over the sample, file units. */
typedef struct {
    const Skeleton *skeleton;
    const Sample *sample;
    NameHint *hint;
    int *child, *sibling;  /* first child, next sibling; -1 = none */
    double *bone, *reach;  /* distance to the parent; length of the longest chain below */
} Tree;

MUST_CHECK bool tree_build(const Skeleton *skeleton, const Sample *sample, Arena *arena, Tree *out, Error *e);

/* Is `joint` below `ancestor` or the same? */
bool tree_below(const Tree *t, int joint, int ancestor);

/* Rigs may put a helper node where a bone's parent is and give it the bone's name. Returns the joint below such nodes
   that is the bone itself; `joint` where it is no such node. */
int tree_past_nodes(const Tree *t, int joint, Part part);

/* The best `most` pairs of a kind, best first. Returns their number. */
int limbs_find(const Tree *t, LimbKind kind, int most, LimbPair *out);

#endif
