/* Arms that hang so close to the trunk that no cloth fits between: by how much they must be turned outwards to make
   room. That changes the motion, so it is done only on request. */
#ifndef FIGURE_RELAX_H
#define FIGURE_RELAX_H

#include "figure/body.h"

/* How far garments stand off each part of the body, in metres, at places spread evenly from the part's low end to its
   high end: at the side, where arm and trunk would touch, and in front. 0: bare there. Clear with {0}. */
enum { PADDING_PLACES = 12 };
typedef struct {
    double side[ROLE_COUNT][PADDING_PLACES], front[ROLE_COUNT][PADDING_PLACES];
    bool is_tube; /* some cloth goes round both legs at once, as a skirt's */
} Padding;

/* Degrees by which an arm is turned: the whole arm about the shoulder, out to the side and forwards,
   and forearm and hand about the elbow, out to the side. */
typedef enum { TURN_OUT, TURN_FORWARD, TURN_ELBOW, TURNS } Turn;
typedef struct { double angle[TURNS]; } ArmTurn;

/* No turn is larger. */
extern const double relax_most[TURNS];

/* Index of an arm. */
enum { ARM_LEFT, ARM_RIGHT, ARMS };

/* The smallest turns that leave between each arm and trunk and thighs as much room as the cloth on
   both needs. 0 where they would not help: arms behind the back, hands between the legs. A continuous
   function of the pose. */
void relax_find(const Figure *figure, const Body *body, const Padding *padding, const Pose *pose, ArmTurn out[ARMS]);

/* Turns the arms of a pose. Out is the shortest way to where the bone would point straight to the
   side, and never further; forwards is about the line through both shoulders. */
void relax_apply(const Figure *figure, const ArmTurn turn[ARMS], Pose *pose);

#endif
