/* The canonical human. Skeletons of every family are translated into it once, at load; whatever comes after knows only
   this figure.

   Canonical frame: metres, Y up, facing +Z, +X is the figure's LEFT, the floor under it is
   y = 0, the hip joints stand at x = +-hip, z = 0. Canonical stance: legs straight down,
   arms straight, 45 degrees out and down (A-pose) in the plane of the shoulders, feet
   pointing along +Z. Body and garments are written for this figure and know nothing of files. */
#ifndef FIGURE_FIGURE_H
#define FIGURE_FIGURE_H

#include "figure/roles.h"

/* A figure has all ROLE_COUNT bones. Those that the skeleton lacks move with a neighbour. */
typedef struct {
    double height;             /* stature, metres */
    double unit;               /* metres per file unit */
    const char *unit_name;     /* "cm", "inch", ... or "unknown" */
    bool unit_is_guess;        /* found from the size: neither the options nor the file say it */
    char up;                   /* up axis of the motion: 'x', 'y', 'z'; upper case = negative */
    Mat3 upright;              /* file axes -> Y up */
    Vec3 start[ROLE_COUNT];    /* where each bone begins in the canonical stance */
    Vec3 end[ROLE_COUNT];      /* where it ends (the next joint, or the tip) */
    Roles roles;
    const char *rest;          /* how the bind was found, for `inspect`: "T-pose offsets", ... */
    /* Private, for the rooms of src/figure: */
    Rigid bind[ROLE_COUNT];    /* canonical stance -> frame of the joint (metres), for bones that are rigid with one */
    bool bound[ROLE_COUNT];    /* which bones these are */
    int toward[ROLE_COUNT];    /* joint or end site that the bone points to; -1 = none, it moves with its parent */
    double arms_out, legs_out; /* metres that limbs stand farther out than their joints, which are too narrow or wide */
} Figure;

/* Rigid transforms canonical stance -> world (metres, Y up), one for each bone. */
typedef struct { Rigid bone[ROLE_COUNT]; } Pose;

/* Zero is the default. */
typedef struct {
    double unit;   /* > 0: metres per file unit */
    double scale;  /* > 0: multiplies the result's size */
    char up;       /* 'x', 'y', 'z', upper case for negative; 0: found from the motion */
} FigureOptions;

/* The reference adult that body and garment files are written for; its stature, metres. */
#define FIGURE_STATURE 1.70
Figure figure_reference(void);

/* The factor for lengths that are given for the reference adult, for somebody of that stature (metres). */
static inline double figure_scale(double height) { return height / FIGURE_STATURE; }

/* Builds the figure of a motion: unit, up axis, bone lengths and bind, from a sample of its
   frames. Oddities go to notes. */
MUST_CHECK bool figure_build(const Motion *m, const Roles *roles, const FigureOptions *options, Arena *scratch,
                             Notes *notes, Figure *out, Error *e);

/* The pose for the joints' world transforms (file units) of one frame. Pelvis, chest, head and feet are rigid with
   their joints. The spine is half-way between pelvis and chest. A limb bone turns from its parent by the smallest
   rotation that points it to the next joint; a thigh also turns about its own axis, so that its left is the pelvis's
   left and a bent knee bends backwards. A foot without a joint is level, as far as ankles turn easily. */
void figure_pose(const Figure *f, const Rigid *world, Pose *out);

/* The pose in which every bone is where it stands in the canonical stance. */
Pose figure_rest_pose(void);

/* The pose that is that share (0..1) of the way from the canonical stance, with the pelvis where it is, to a pose. */
Pose figure_pose_towards(const Figure *f, const Pose *pose, double share);

/* How far two poses are apart: the largest distance between the two places of a bone's end, in statures. Finds T-pose
   first frames and teleports. */
double figure_step(const Figure *f, const Pose *a, const Pose *b);

#endif
