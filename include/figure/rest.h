/* The rest pose: a pose in which the performer is known to stand upright. For some families of files that is the zero
   pose (all rotations zero, bones as the OFFSETs say). In others the zero pose is a heap of bones along one axis; then
   a T-pose in the first frame serves as well. */
#ifndef FIGURE_REST_H
#define FIGURE_REST_H

#include "figure/figure.h"
#include "figure/sample.h"

typedef struct {
    bool human;        /* is there one? Legs down, arms mirrored */
    bool soles;        /* if human: do the feet stand across the shins, so that the soles are flat in it? */
    const Rigid *pose; /* the transform of each joint in it, file units and axes */
    Mat3 frame;        /* if human: the performer's left, up and forward in it as columns, file axes */
    const char *name;  /* "T-pose offsets", ... */
} Rest;

/* Looks for one. Uses roles and toward of the figure. */
Rest rest_find(const Sample *sample, const Figure *f);

static inline Vec3 rest_place(const Rest *rest, int joint) { return rest->pose[joint].t; }

/* Unit direction of a bone in the rest pose, file axes; zero where it has no end. */
Vec3 rest_bone(const Rest *rest, const Figure *f, Role role);

/* The performer's left, up and forward as columns, in the axes of a joint: the rotation of its bind. */
static inline Mat3 rest_bind(const Rest *rest, int joint) {
    return mat_mul(mat_transpose(rest->pose[joint].r), rest->frame);
}

/* The axis (x, y, z or their negative) whose cosine to the unit vector v is larger than `cosine`, else v itself. */
Vec3 rest_snap(Vec3 v, double cosine);

#endif
