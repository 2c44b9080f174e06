/* Many points and normals of one patch at a time, on a grid of parameters: the same bits as bezier_point and
   bezier_normal give. */
#ifndef GEOMETRY_GRID_H
#define GEOMETRY_GRID_H

#include "base/arena.h"
#include "geometry/bezier.h"
#include "geometry/vectors.h"

/* Bernstein values and their derivatives at n parameters: made once, used for every patch and frame. For a part of a
   patch, grid_part gives a part of them. */
typedef struct {
    Vectors vectors;             /* instruction set to use; grid_points takes that of u */
    int n;
    double *t;                   /* the parameters */
    double *value[4], *slope[4];
} GridRows;

/* At i / facets, i = 0..facets; facets >= 1. */
MUST_CHECK bool grid_rows(int facets, Arena *arena, GridRows *out, Error *e);

/* The rows first..first+n-1. */
GridRows grid_part(const GridRows *rows, int first, int n);

/* point[i * w->n + j] at (u->t[i], w->t[j]). normal, if not NULL, gets the unit normals. Nothing is written
   behind the last of them. */
void grid_points(const Patch *patch, const GridRows *u, const GridRows *w, Vec3 *point, Vec3 *normal);

#endif
