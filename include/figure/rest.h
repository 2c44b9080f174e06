/* A pose in which the performer is known to stand: the zero pose, all rotations zero, bones as the OFFSETs say. For
   some families it is a human who stands, for others a heap of bones along one axis; then a T-pose in front of the take
   will do as well. */
#ifndef FIGURE_REST_H
#define FIGURE_REST_H

#include "figure/figure.h"
#include "figure/sample.h"

typedef struct {
    bool human;        /* legs down, arms mirrored, feet across the shins */
    const Rigid *pose; /* of each joint in it, file units and axes */
    Mat3 frame;        /* if human: its left, up and forward as columns, file axes */
    const char *name;  /* "T-pose offsets", ... */
} Rest;

/* Uses roles and toward of the figure. */
Rest rest_find(const Sample *sample, const Figure *f);

static inline Vec3 rest_place(const Rest *rest, int joint) { return rest->pose[joint].t; }

/* Unit direction of a bone; zero where it has no end. */
Vec3 rest_bone(const Rest *rest, const Figure *f, Role role);

/* The frame of one who stands, seen from that of a joint. */
static inline Mat3 rest_bind(const Rest *rest, int joint) {
    return mat_mul(mat_transpose(rest->pose[joint].r), rest->frame);
}

/* The axis (x, y, z or their negative) within `cosine` of a unit vector, else the vector. */
Vec3 rest_snap(Vec3 v, double cosine);

#endif
