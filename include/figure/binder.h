/* What the binding of every bone is made from: where the joints are in the sampled frames.
   World frame: metres, Y up. */
#ifndef FIGURE_BINDER_H
#define FIGURE_BINDER_H

#include "figure/figure.h"
#include "figure/sample.h"

typedef struct {
    const Skeleton *skeleton;
    const Sample *sample;
    Figure *f; /* measured: all but bind and bound are set */
} Binder;

/* A direction between joints that are nearer to each other than this (statures) is noise. */
#define BINDER_SHORT 0.03

/* Rotation and position of a joint in a frame of the sample, world frame. */
Mat3 binder_rotation(const Binder *b, int frame, int joint);
Vec3 binder_position(const Binder *b, int frame, int joint);

/* Mean position of another joint over the sample, in the frame of `joint`, metres. */
Vec3 binder_offset(const Binder *b, int joint, int other);

/* The mean of rotations is the direction of a sum of their quaternions. Begin with {0, 0, 0, 0}. */
void binder_mean_add(Quat *sum, Mat3 r);
Mat3 binder_mean(Quat sum);

#endif
