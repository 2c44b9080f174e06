/* Global deformation: the garment's control points follow the body. */
#ifndef DRESS_FOLLOW_H
#define DRESS_FOLLOW_H

#include "garment/fit.h"

/* What global deformation needs from frame to frame; private inside. */
typedef struct {
    const Fit *fit;
    const Figure *figure;
    const Body *body;
    Vec3 (*curve)[4];                    /* control points of every curve in this pose */
    Vec3 (*slope)[GARMENT_ROWS_MAX][4];  /* per panel and row: derivative across the rows */
    Vec3 *node_slope;                    /* per node: sum of the slopes of its panels, */
    double *node_length;                 /* of their lengths, */
    int *node_uses;                      /* and their number */
} Follower;

/* Takes the memory for a fit. Figure and body must outlive it. */
MUST_CHECK bool follow_reserve(Follower *f, const Fit *fit, const Figure *figure, const Body *body,
                               Arena *arena, Error *e);

/* The root patches (fit->npatches) of the garment in a pose: world frame, metres. Patches that
   share control points get exactly equal ones. Tangent planes are continuous inside a panel
   and, for garments that follow bones, across seams where arcs of one ring meet. */
void follow_pose(Follower *f, const Pose *pose, Patch *out);

#endif
