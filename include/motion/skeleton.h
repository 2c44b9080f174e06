/* Joints, channels and forward kinematics, the same for every motion format. Everything is
   in the file's own units and axes; angles are degrees in files and rows, as written there. */
#ifndef MOTION_SKELETON_H
#define MOTION_SKELETON_H

#include <stdbool.h>

#include "geometry/vec.h"

/* Scales are read, but nothing is scaled by them: bones are rigid. */
typedef enum {
    CHANNEL_TX, CHANNEL_TY, CHANNEL_TZ, CHANNEL_RX, CHANNEL_RY, CHANNEL_RZ, CHANNEL_SX, CHANNEL_SY, CHANNEL_SZ,
    CHANNEL_KINDS
} ChannelKind;

typedef struct {
    const char *name;         /* as in the file, trimmed; an end site is "PARENT_End" */
    int parent;               /* index of the parent, always smaller; -1 for a root */
    Vec3 offset;              /* from the parent's origin, in the parent's frame */
    Mat3 axis;                /* ASF `axis`: the rotation is axis * R * axis^T; identity for BVH */
    bool has_axis, is_end;    /* is_end: an end site, without channels */
    int nchannels;            /* 0..CHANNEL_KINDS */
    ChannelKind channel[CHANNEL_KINDS]; /* in the order of the file; R = product in that order */
    int first_channel;        /* column of the first one in a row */
} Joint;

typedef struct {
    int njoints, nchannels;
    Joint *joint;             /* what is below a joint stands right behind it */
    bool position_adds;       /* position channels add to the OFFSET; else they replace it */
    bool points;              /* none but roots turn by channels: all turn as the places of their children say */
} Skeleton;

/* World transform of every joint (file units and axes) for one row of channel values.
   row: nchannels values. world: njoints. */
void skeleton_pose(const Skeleton *s, const double *row, Rigid *world);

/* Is `joint` below `ancestor` or the same? */
bool skeleton_below(const Skeleton *s, int joint, int ancestor);

/* Index of the joint of that name (exact), or -1. */
int skeleton_find(const Skeleton *s, const char *name);

#endif
