/* How pelvis, chest, head and feet sit on their joints: the second half of figure_build. */
#ifndef FIGURE_BIND_H
#define FIGURE_BIND_H

#include "figure/rest.h"
#include "figure/sample.h"

/* Fills bind and bound of a figure that figure_measure has filled. */
void figure_bind(const Skeleton *skeleton, const Sample *sample, const Rest *rest, Figure *f);

#endif
