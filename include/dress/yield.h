/* Flesh gives way. Parts of a posed body that press on each other, or leave less room than
   cloth needs, are both flattened there, so that cloth can lie between them. */
#ifndef DRESS_YIELD_H
#define DRESS_YIELD_H

#include "figure/body.h"

/* The inside of a bent knee or elbow, where the flesh of both bones is pressed flat along the plane that halves
   the bend. World frame, metres. */
typedef struct {
    Vec3 centre;     /* of the joint */
    Vec3 inwards;    /* unit: from the joint into the fold */
    Vec3 across;     /* unit: normal of the plane, towards the part that gives way, */
    Vec3 floor;      /* and of the wall from its bottom towards the joint */
    double bottom;   /* how far from the joint along `inwards` the fold begins; 0: there is none */
} Fold;

/* One part that presses on another. */
typedef struct {
    int other;       /* part that it gives way to */
    double share;    /* of the room that is missing, which this part makes */
    double most;     /* it gives way no farther, metres */
    bool folds;      /* they meet at a joint: it gives way only where their surfaces face each other */
    Fold fold;       /* of the two bones of a limb */
} Contact;

/* Parts that are pressed by more others give way to the first of them. */
enum { CONTACTS_MAX = 12 };
typedef struct { int n; Contact contact[CONTACTS_MAX]; } Contacts;

/* May the two roles press on each other at all? Neighbours in a limb and the trunk are one body,
   but for the bends of elbow and knee, and a head that is bowed to the chest. */
bool yield_concerns(Role a, Role b);

/* The two sides of a contact of roles a and b on a body of `scale` x 1.70 m. */
void yield_contact(Role a, Role b, double scale, Contact *of_a, Contact *of_b);

/* Are they the two bones of a limb, the upper first, that fold at knee or elbow? */
bool yield_hinges(Role upper, Role lower);

/* The fold of such a contact: joint at `centre`, unit directions from there up one bone and down the other,
   and the radius of the limb at the joint, metres. */
void yield_fold(Vec3 centre, Vec3 up, Vec3 down, double radius, Contact *upper, Contact *lower);

/* May a part give way at all where its normal is about this one and the other's is `away`? A cheap question. */
bool yield_may(const Contact *c, Vec3 normal, Vec3 away);

/* A point (world, metres) where a part and one that presses on it stand so far away, each as if alone, with these unit
   normals. */
typedef struct {
    Vec3 at;
    double distance, other;
    Vec3 normal, away;
} Meeting;

/* How far the part gives way there, where `room` is to be left between the two: metres, >= 0 and no more than
   c->most, to be added to the distance. Where it does, the normal of what that leaves. */
double yield_by(const Contact *c, double room, const Meeting *m);
Vec3 yield_normal(const Contact *c, double room, const Meeting *m);

/* The room that parts leave between them, metres on 1.70 m: two layers of cloth, a sleeve and the side
   of a shirt or two legs of trousers, that keep their margin, with what facets need for being flat. */
#define YIELD_ROOM 0.012

#endif
