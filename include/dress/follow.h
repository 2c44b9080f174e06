/* Global deformation: the garment's control points follow the body. */
#ifndef DRESS_FOLLOW_H
#define DRESS_FOLLOW_H

#include "dress/fold.h"
#include "garment/fit.h"

/* What global deformation needs from frame to frame; private inside. */
typedef struct {
    const Fit *fit;
    const Figure *figure;
    const Body *body;
    Folds folds;                         /* of this pose */
    Vec3 (*curve)[4];                    /* control points of every curve in this pose */
    double *up;                          /* per node: how far it rides up a thigh, metres */
    Vec3 (*slope)[GARMENT_ROWS_MAX][2][4]; /* per panel and row: derivatives across the rows at the curve's control
                                              points, for the patch above the row and for the one below */
    int (*column)[GARMENT_ROWS_MAX][2];    /* per panel and row, at start and end: number of the column from there to
                                              the next row */
    Vec3 (*column_slope)[2];               /* per column, at its upper and lower node: sum of its panels' slopes, */
    double (*column_length)[2];            /* sum of their lengths, */
    int *column_uses, ncolumns;            /* and how many panels have it */
} Follower;

/* Takes the memory for a fit. Figure and body must outlive it. */
MUST_CHECK bool follow_reserve(Follower *f, const Fit *fit, const Figure *figure, const Body *body,
                               Arena *arena, Error *e);

/* The root patches (fit->npatches) of the garment in a pose: world frame, metres. Patches that
   share control points get exactly equal ones. Tangent planes are continuous inside a panel, but for
   single points where seams part, and, for garments that follow bones, across seams where arcs of
   one ring meet. */
void follow_pose(Follower *f, const Pose *pose, Patch *out);

#endif
