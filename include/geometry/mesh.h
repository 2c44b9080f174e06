/* A triangle mesh as plain arrays. Triangles are counter-clockwise seen from outside. */
#ifndef GEOMETRY_MESH_H
#define GEOMETRY_MESH_H

#include "base/arena.h"
#include "geometry/vec.h"
#include "geometry/vectors.h"

typedef struct { int v[3]; } Triangle;
typedef struct { int v[2]; } Edge; /* v[0] < v[1] */

/* Triangles first..first+count-1 belong to the group. */
typedef struct { const char *name; int first, count; } MeshGroup;

/* A corner (3 * triangle + 0..2) that has another normal than its vertex. */
typedef struct { int corner, normal; } Crease;

/* Arrays belong to the arena they were made in. normal (unit, outward), u and w (patch
   parameters in [0, 1]) may be NULL. edge lists each undirected edge once. Where cloth is folded so
   sharply that no normal serves all facets round a vertex, some of their corners have normals of their
   own: `nextra` of them stand behind those of the vertices, and creases tell whose they are, in order. */
typedef struct {
    int nvertices, ntriangles, nedges, ngroups, nextra, ncreases;
    Vec3 *position, *normal;
    double *u, *w;
    Triangle *triangle;
    Edge *edge;
    MeshGroup *group;
    Crease *crease;
} Mesh;

/* Coordinates of meshes that are read are at most so large: of much larger ones the products in predicates would
   overflow, and what meets could not be told. */
#define MESH_REACH 1e12

/* The double that a reader gets from the text "%.6f" of x: the one nearest to round(x * 1e6) / 1e6 (for |x| < 1e9;
   never -0). */
double mesh_snap(double x);
Vec3 mesh_snap_point(Vec3 p);

/* The same for n points times `unit`. to == from is allowed. */
void mesh_snap_points(Vectors vectors, const Vec3 *from, double unit, int n, Vec3 *to);

/* Fills mesh->edge and nedges from the triangles, each undirected edge once, in order of
   first appearance. */
MUST_CHECK bool mesh_find_edges(Mesh *mesh, Arena *arena, Error *e);

#endif
