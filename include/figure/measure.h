/* Size, unit and up axis of a skeleton: the first half of figure_build. */
#ifndef FIGURE_MEASURE_H
#define FIGURE_MEASURE_H

#include "figure/rest.h"
#include "figure/sample.h"

/* Fills everything of the figure but bind and bound. *rest: the rest pose, if there is one. */
MUST_CHECK bool figure_measure(const Motion *m, const FigureOptions *options, const Sample *sample, Rest *rest,
                               Notes *notes, Figure *f, Error *e);

/* How far an ankle usually is over the ball of a flat foot, in statures. */
#define FIGURE_FOOT_RISE (0.06 / FIGURE_STATURE)

#endif
