/* Flesh gives way. Where parts of a posed body press on each other, or leave less room than cloth needs, both are
   flattened, so that cloth can lie between them. */
#ifndef DRESS_YIELD_H
#define DRESS_YIELD_H

#include "dress/fold.h"

/* How a part gives way to another that presses on it. */
typedef struct {
    int other;       /* the other part */
    double share;    /* share of the missing room that this part makes */
    double soft;     /* it gives way no farther than this, metres, */
    double most;     /* in a fold than this */
    double reach;    /* and only where the other part is nearer than this, metres */
    bool joined;     /* do they meet at a joint? Then it gives way only where their surfaces face each other */
    const Fold *fold;/* in which they meet; NULL: in none, or it is open */
    Vec3 across;     /* unit normal of its plane, towards the part that gives way */
    Vec3 floor;      /* unit normal of the wall that closes it towards the joint */
    double bottom;   /* how far from the joint along fold->inwards it begins, metres */
} Contact;

/* All others that a part gives way to. */
typedef struct { int n; Contact contact[BODY_PARTS_MAX - 1]; } Contacts;

/* May the two roles press on each other at all? Parts of the trunk may not, nor neighbours in a limb, except at
   elbow and knee; a head may be bowed to the chest. */
bool yield_concerns(Role a, Role b);

/* Do two parts meet at a joint of the body? On its outside they are one surface, and press only where they fold against
   each other. */
bool yield_share_joint(Role a, Role b);

/* The two sides of a contact of roles a and b on a body of `scale` x 1.70 m. */
void yield_contact(Role a, Role b, double scale, Contact *of_a, Contact *of_b);

/* The same for a contact in a fold that is not open. The fold must outlive it. */
void yield_fold(const Fold *fold, Contact *above, Contact *below);

/* May a part give way at all where its normal is about `normal` and the other's is `away`? A cheap test before
   yield_by. */
bool yield_may(const Contact *c, Vec3 normal, Vec3 away);

/* Where the other part is farther than this from a point, a part does not give way to it; metres. distance: of the
   point from the part itself. */
double yield_within(const Contact *c, double room, Vec3 at, double distance);

/* A point, and its distances from a part and from another that presses on it, each as if nothing pressed. */
typedef struct {
    Vec3 at;                /* world, metres */
    double distance, other; /* from the part, from the other; metres */
    Vec3 normal, away;      /* outward unit normals of the part and of the other */
} Meeting;

/* How far the part gives way there, if `room` metres are to be left between the two: from 0 to c->most metres, to be
   added to its distance; and the part's normal where it has given way. */
double yield_by(const Contact *c, double room, const Meeting *m);
Vec3 yield_normal(const Contact *c, double room, const Meeting *m);

/* The room that parts leave between them, metres on 1.70 m: for two layers of cloth (a sleeve and the side of a shirt,
   or two legs of trousers) with their margins, and for facets, which are flat. */
#define YIELD_ROOM 0.012

#endif
