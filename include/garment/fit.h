/* A garment on one figure: rings become curves of control points, rows become root patches,
   and every control point that two patches share is one and the same.

   Frame: the canonical stance of the figure (metres). Nothing here depends on a pose. */
#ifndef GARMENT_FIT_H
#define GARMENT_FIT_H

#include "garment/garment.h"

/* A point of a ring (joined stations are one node) with the bones it follows. */
typedef struct {
    Vec3 rest;
    Binding binding;
} FitNode;

/* One cubic arc of a ring. Control points 0 and 1 follow the node at its start, 2 and 3 the node at its end, so that
   arcs that meet at a node keep a common tangent there in every pose. A half arc whose middle station has a binding
   of its own is shaped by that station: each inner point goes as far as it would if it followed `middle`, but in the
   direction that it would have if it followed `turn`, which is the same for all arcs of the ring that meet there. */
typedef struct {
    int node[2];
    Binding middle;    /* of the middle station; n == 0: it has none */
    Binding turn[2];   /* at start and end */
    Vec3 rest[4];      /* control points in the canonical stance */
    int ring;
    double unit[4][2]; /* the same points for a ring that is the unit circle: x to the left, z to the front */
} FitCurve;

typedef struct {
    const char *name;
    int nrows, curve[GARMENT_ROWS_MAX];
    double height[GARMENT_ROWS_MAX]; /* parameter length from this row to the next, metres at rest */
} FitPanel;

/* A root patch: panel and row, or a raw patch. point[4 * i + j] names control point B_ij:
   patches that meet have the same four names along their common edge. */
typedef struct {
    int panel, row;  /* panel -1: raw patch `row` */
    int point[16];
    bool flip;       /* du x dw points into the body */
    unsigned collide;/* roles of the parts that it is worn over, bits 1 << role; all others come to it from outside */
    unsigned pinned; /* sides that may not move, bit 1 << Side */
} FitPatch;

/* What the envelope needs of a ring in the canonical stance: its centre (y, z) and half sizes, metres. */
typedef struct { double y, side, front, back, z; } FitRing;

typedef struct {
    const Garment *garment;
    double scale;      /* girth of the figure against the reference */
    double height;     /* stature, metres */
    int nnodes, ncurves, npanels, npatches, npoints;
    int nopenings;     /* loops of border sides: waist, hem, cuffs */
    FitNode *node;
    FitCurve *curve;
    FitPanel *panel;
    FitPatch *patch;
    FitRing ring[GARMENT_RINGS_MAX];
    Vec3 (*raw)[16];   /* control points of raw patches, sized to the figure */
    unsigned collide;  /* all parts that any patch is worn over */
} Fit;

/* Names of the four control points along a side, in the direction of growing u or w. */
void fit_side(const FitPatch *patch, Side side, int out[4]);

/* What holds the garment in the canonical stance: of panels their rows, of patches 17 by 17 points. */
Box fit_box(const Fit *fit);

/* Sizes `garment` to the figure. The garment must outlive the fit. ERR_INPUT where it names a
   part that this body does not have or where shared edges do not agree. */
MUST_CHECK bool fit_garment(const Garment *garment, const Figure *figure, const Body *body, Arena *arena, Fit *out,
                            Error *e);

#endif
