/* Flesh gives way. Where parts of a posed body press on each other, or leave less room than cloth needs, both are
   flattened, so that cloth can lie between them. */
#ifndef DRESS_YIELD_H
#define DRESS_YIELD_H

#include "figure/body.h"

/* The fold inside a bent knee or elbow, where the flesh of both bones is pressed flat along the plane that halves the
   bend. World frame, metres. */
typedef struct {
    Vec3 centre;     /* of the joint */
    Vec3 inwards;    /* unit: from the joint into the fold, within the plane */
    Vec3 across;     /* unit normal of the plane, towards the part that gives way */
    Vec3 floor;      /* unit normal of the wall that closes the fold towards the joint */
    double bottom;   /* how far from the joint along `inwards` the fold begins; 0: there is no fold */
} Fold;

/* How a part gives way to another that presses on it. */
typedef struct {
    int other;       /* the other part */
    double share;    /* share of the missing room that this part makes */
    double most;     /* it gives way no farther, metres */
    bool folds;      /* do they meet at a joint? Then it gives way only where their surfaces face each other */
    Fold fold;       /* of the two bones of a limb */
} Contact;

/* A part gives way to so many others at the most, the first that are found. */
enum { CONTACTS_MAX = 12 };
typedef struct { int n; Contact contact[CONTACTS_MAX]; } Contacts;

/* May the two roles press on each other at all? Parts of the trunk may not, nor neighbours in a limb, except at
   elbow and knee; a head may be bowed to the chest. */
bool yield_concerns(Role a, Role b);

/* The two sides of a contact of roles a and b on a body of `scale` x 1.70 m. */
void yield_contact(Role a, Role b, double scale, Contact *of_a, Contact *of_b);

/* Are they the two bones, upper and lower, that meet at a knee or elbow? */
bool yield_hinges(Role upper, Role lower);

/* The fold of such a contact: joint at `centre`, unit directions from there up one bone and down the other,
   and the radius of the limb at the joint, metres. */
void yield_fold(Vec3 centre, Vec3 up, Vec3 down, double radius, Contact *upper, Contact *lower);

/* May a part give way at all where its normal is about `normal` and the other's is `away`? A cheap test before
   yield_by. */
bool yield_may(const Contact *c, Vec3 normal, Vec3 away);

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
