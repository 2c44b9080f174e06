/* Arms that hang so close to the trunk that no cloth fits between: how far they have to be turned
   outwards to make room. Changes the motion, so only who asks for it gets it. */
#ifndef FIGURE_RELAX_H
#define FIGURE_RELAX_H

#include "figure/body.h"

/* How far cloth stands off the sides of each part of the body, metres: `off` at places spread evenly
   from the part's low end to its high end. 0: bare there. Clear with {0}. */
enum { CLOTH_PLACES = 12 };
typedef struct { double off[ROLE_COUNT][CLOTH_PLACES]; } Cloth;

/* Degrees by which an arm is turned: the whole arm about the shoulder, then forearm and hand about
   the elbow. */
typedef struct { double shoulder, elbow; } ArmTurn;

/* Index of an arm. */
enum { ARM_LEFT, ARM_RIGHT, ARMS };

/* No turn is larger. */
#define SHOULDER_TURN_MOST 40.0
#define ELBOW_TURN_MOST 30.0

/* The smallest turns that leave between each arm and trunk and thighs as much room as the cloth on
   both needs. 0 where turning outwards does not help: arms that are folded, hands that lie on the
   belly or in the lap. A continuous function of the pose. */
void relax_find(const Figure *figure, const Body *body, const Cloth *cloth, const Pose *pose, ArmTurn out[ARMS]);

/* Turns the arms of a pose. Outwards is the shortest way to where the bone would point straight to
   the side; a bone never goes further than that. */
void relax_apply(const Figure *figure, const ArmTurn turn[ARMS], Pose *pose);

#endif
