/* Size, unit and up axis of a skeleton: the first half of figure_build. */
#ifndef FIGURE_MEASURE_H
#define FIGURE_MEASURE_H

#include "figure/figure.h"
#include "figure/sample.h"

/* Fills everything of the figure but bind, bound and rest. */
MUST_CHECK bool figure_measure(const Motion *m, const FigureOptions *options, const Sample *sample, Notes *notes,
                               Figure *f, Error *e);

/* Sets the canonical stance: the reference adult, made k times as large, with the given
   lengths in metres. */
typedef struct { double hips, thigh, shin, torso, shoulders, upper_arm, forearm, hand; } Lengths;
void figure_shape(double k, const Lengths *lengths, Figure *f);

#endif
