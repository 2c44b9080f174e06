/* The zero pose: all rotations zero, bones as the OFFSETs say. For some families it is a human
   who stands, for others a heap of bones along one axis. */
#ifndef FIGURE_REST_H
#define FIGURE_REST_H

#include "figure/figure.h"

typedef struct {
    bool human;        /* legs down, arms mirrored, feet across the shins */
    Mat3 frame;        /* if human: its left, up and forward as columns, file axes */
    const char *name;  /* "T-pose offsets", ... */
} Rest;

/* Uses roles and toward of the figure. */
Rest rest_find(const Skeleton *skeleton, const Figure *f);

/* Where a joint lies in the zero pose, file units. */
Vec3 rest_place(const Skeleton *skeleton, int joint);

/* Unit direction of a bone in the zero pose; zero where it has no end. */
Vec3 rest_bone(const Skeleton *skeleton, const Figure *f, Role role);

/* The axis (x, y, z or their negative) within `cosine` of a unit vector, else the vector. */
Vec3 rest_snap(Vec3 v, double cosine);

#endif
