/* Which way is up in a motion file. */
#ifndef FIGURE_UPRIGHT_H
#define FIGURE_UPRIGHT_H

#include "figure/rest.h"
#include "figure/sample.h"

/* The up axis: 'x', 'y' or 'z', upper case where the negative axis is up. Uses roles and toward of the figure.
   seconds: length of the take. */
char upright_find(const Sample *s, const Figure *f, const Rest *rest, double seconds, Notes *notes);

/* The rotation by one or two right angles that takes that axis to +y. */
Mat3 upright_turn(char up);

#endif
