/* Flesh gives way. Parts of a posed body that press on each other, or leave less room than
   cloth needs, are both flattened there, so that cloth can lie between them. */
#ifndef DRESS_YIELD_H
#define DRESS_YIELD_H

#include "figure/body.h"

/* One part that presses on another. */
typedef struct {
    int other;       /* part that it gives way to */
    double share;    /* of the room that is missing, which this part makes */
    double most;     /* it gives way no farther, metres */
    bool folds;      /* they meet at a joint: it gives way only where their surfaces face each other */
} Contact;

/* Parts that are pressed by more others give way to the first of them. */
enum { CONTACTS_MAX = 12 };
typedef struct { int n; Contact contact[CONTACTS_MAX]; } Contacts;

/* May the two roles press on each other at all? Neighbours in a limb and the trunk are one body,
   but for the bends of elbow and knee. */
bool yield_concerns(Role a, Role b);

/* The two sides of a contact of roles a and b on a body of `scale` x 1.70 m. */
void yield_contact(Role a, Role b, double scale, Contact *of_a, Contact *of_b);

/* How far a part that is `distance` from a point, with unit normal *normal there, gives way to one
   that is `other` away with unit normal `away`: metres, >= 0, to be added to the distance. *normal
   becomes that of the sum. `scale` as above. */
double yield_by(const Contact *c, double scale, double distance, double other, Vec3 away, Vec3 *normal);

/* The room that parts leave between them, metres on 1.70 m: two layers of cloth, a sleeve and the side
   of a shirt or two legs of trousers, that keep their margin, with what facets need for being flat. */
#define YIELD_ROOM 0.012

#endif
