/* A tree of bounding boxes over triangles of a mesh: finds those that touch a box, and the one nearest to a point.
   Exact: boxes are doubles, and touching counts. */
#ifndef GEOMETRY_BOXTREE_H
#define GEOMETRY_BOXTREE_H

#include "base/arena.h"
#include "geometry/mesh.h"

/* Private inside: a node's triangles are item[first..first+count-1]; without any it has two
   children, node[first] and node[first + 1]. */
typedef struct { Box box; int first, count; } BoxNode;
typedef struct {
    const Vec3 *position;
    const Triangle *triangle;
    int count, *item; /* the triangles, in the order of the leaves */
    BoxNode *node;
} BoxTree;

/* Over the triangles item[0..n-1] (NULL: 0..n-1). position and triangle are borrowed. n may be 0. */
MUST_CHECK bool boxtree_build(BoxTree *tree, const Vec3 *position, const Triangle *triangle, const int *item, int n,
                              Arena *arena, Error *e);

/* The box of everything; box_empty() without triangles. */
Box boxtree_box(const BoxTree *tree);

/* A walk over the triangles whose boxes touch a box (closed; its sides may be infinite):
       BoxWalk walk = boxtree_walk(&tree, box);
       for (int t; (t = boxtree_next(&walk)) >= 0;) ... */
enum { BOXTREE_DEPTH = 62 };
typedef struct {
    const BoxTree *tree;
    Box box;
    int at, end, depth, stack[BOXTREE_DEPTH + 2];
} BoxWalk;
BoxWalk boxtree_walk(const BoxTree *tree, Box box);
int boxtree_next(BoxWalk *walk);

/* Distance from p to the nearest triangle. *triangle and *point (either may be NULL): that triangle, and its point
   nearest to p. A tree without triangles returns INFINITY and sets neither. */
double boxtree_nearest(const BoxTree *tree, Vec3 p, int *triangle, Vec3 *point);

/* The point of a triangle, which may have collapsed, that is nearest to p. */
Vec3 boxtree_triangle_point(Vec3 p, Vec3 a, Vec3 b, Vec3 c);

static inline bool box_touches(Box a, Box b) {
    return a.low.x <= b.high.x && a.high.x >= b.low.x && a.low.y <= b.high.y && a.high.y >= b.low.y &&
           a.low.z <= b.high.z && a.high.z >= b.low.z;
}

static inline Box box_of_triangle(const Vec3 *position, Triangle t) {
    Box b = {position[t.v[0]], position[t.v[0]]};
    box_add(&b, position[t.v[1]]);
    box_add(&b, position[t.v[2]]);
    return b;
}

#endif
