/* What is seen of meshes from one side, pixel by pixel: which surface, how far, how bright. */
#ifndef FILES_RASTER_H
#define FILES_RASTER_H

#include "geometry/mesh.h"

enum { RASTER_TONES = 32, RASTER_PAPER = 0 };

/* Parallel projection. turn: world to view (x right, y up, z towards the viewer); centre: the world
   point in the middle of the picture; scale: pixels per metre. */
typedef struct { Mat3 turn; Vec3 centre; double scale; } Camera;

/* Rows from top to bottom. Where nothing is, label is RASTER_PAPER and depth -INFINITY. */
typedef struct {
    int width, height;
    Camera camera;
    float *depth;         /* view z in metres: more is nearer */
    unsigned char *label; /* as given to raster_mesh */
    unsigned char *tone;  /* 0 dark .. RASTER_TONES - 1 bright */
} Raster;

MUST_CHECK bool raster_reserve(Raster *r, int width, int height, Arena *arena, Error *e);
void raster_clear(Raster *r, const Camera *camera);

/* Draws a mesh with normals. What shows its back side gets `back`; RASTER_PAPER: the mesh is closed,
   and its back sides are never seen. The nearest surface stays. */
void raster_mesh(Raster *r, const Mesh *mesh, int front, int back);

/* A world point in the picture: x and y in pixels from the upper left corner, z the depth. */
Vec3 raster_place(const Raster *r, Vec3 world);

/* Is nothing more than `slack` metres before this place, in its pixel or one of the eight round it? So the edge of a
   surface counts as visible although it crosses pixels. False outside the picture. */
bool raster_visible(const Raster *r, Vec3 place, double slack);

#endif
