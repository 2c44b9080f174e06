/* How pelvis, chest, head and feet sit on their joints: the second half of figure_build. */
#ifndef FIGURE_BIND_H
#define FIGURE_BIND_H

#include "figure/figure.h"
#include "figure/sample.h"

/* Fills bind, bound and rest of a measured figure. */
void figure_bind(const Skeleton *skeleton, const Sample *sample, Figure *f);

#endif
