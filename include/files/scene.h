/* Shaded pictures of meshes as vector graphics: what is hidden is left out, and not painted over. */
#ifndef FILES_SCENE_H
#define FILES_SCENE_H

#include "files/outline.h"
#include "files/raster.h"

enum { SCENE_SURFACES_MAX = 33 }; /* a body and 32 garments */

/* colour: 0 is skin, 1, 2, ... are cloth. Lines are edges of the mesh; dots need not lie on it. */
typedef struct {
    Mesh mesh;           /* with normals */
    int colour;
    bool is_closed;      /* it has no back sides to be seen */
    int nlines;
    const Edge *line;
    int ndots;
    const Vec3 *dot;
} SceneSurface;

typedef struct { int count; SceneSurface surface[SCENE_SURFACES_MAX]; } Scene;

/* The memory that pictures of one size are drawn with, one after the other. */
typedef struct {
    Raster raster;
    Outline outline;
    double fine, unit;   /* pixels per point; tenths of a point per pixel */
    double extent;       /* of the scene, the longest; metres */
    /* Private: */
    unsigned char *spread;
    int *queue;
    int (*dot)[2], ndots, capacity;
    int nclips;          /* so far, for their names */
} Canvas;

/* Size in points. ndots: of a scene, at most. */
MUST_CHECK bool canvas_reserve(Canvas *c, double width, double height, int ndots, Arena *arena, Error *e);

/* The view from a place `azimuth` degrees round the figure, to the left of where it heads (a
   direction in the world, Y up), and `elevation` degrees above. */
Mat3 scene_view(Vec3 heading, double azimuth, double elevation);

/* Adds what the vertices of surfaces `first` and on reach in view coordinates. */
void scene_reach(const Scene *scene, Mat3 turn, int first, Box *box);

/* Draws a scene into an SVG picture, its upper left corner at (left, top). camera.scale: points per
   metre. What lies outside the canvas is cut off. */
void scene_draw(Canvas *c, const Scene *scene, const Camera *camera, double left, double top, FILE *out);

#endif
