/* Which of many segments intersect which of many triangles: culled by boxes, decided exactly, counted. The only
   place where edge-triangle pairs are enumerated. */
#ifndef GEOMETRY_CROSSING_H
#define GEOMETRY_CROSSING_H

#include <stdatomic.h>

#include "base/arena.h"
#include "geometry/mesh.h"
#include "geometry/tile.h"

typedef struct { int edge, triangle; } Crossing;

typedef struct {
    long long pairs_all;    /* segments x triangles: what a test of all pairs costs */
    long long pairs_tested; /* pairs whose boxes overlap, before any numeric filter; the same
                               on every machine */
    int hits;               /* pairs that intersect (predicate_segment_triangle) */
} CrossingCount;

/* Boxes over one set of segments or triangles, made for repeated queries, by several threads at a time. Memory is taken
   at crossing_reserve and kept; building allocates nothing. Private inside but for `vectors`. */
enum { CROSSING_LEVELS = 3 };
typedef struct {
    Vectors vectors;        /* instruction set to use; a search takes that of the edges */
    int count;              /* of items */
    const TileItems *items; /* segments or triangles */
    const Vec3 *position;   /* borrowed, as is the next: both must stay as they are until the next build */
    const int *index;       /* per item 2 (segments) or 3 (triangles) vertices */
    float reach;            /* largest magnitude of a coordinate */
    Tile *level[CROSSING_LEVELS]; /* boxes of items, of tiles of items, of tiles of those */
    TileShapes *shapes;     /* of the tiles of items, made when a search first asks for them, */
    atomic_uchar *state;    /* and how far each of these is */
} CrossingSet;

MUST_CHECK bool crossing_reserve(CrossingSet *set, int capacity, Arena *arena, Error *e);

/* Boxes over the segments edge[0..n-1] (or triangles) whose vertices are in position. Items
   that follow each other in the array should lie near each other: 16 share a box.
   n <= capacity. Coordinates are finite, with magnitudes below 1e37. */
void crossing_build_edges(CrossingSet *set, const Vec3 *position, const Edge *edge, int n);
void crossing_build_triangles(CrossingSet *set, const Vec3 *position, const Triangle *triangle, int n);

/* The box round everything, to the precision of floats; box_empty() without items. */
Box crossing_box(const CrossingSet *set);

/* Finds every pair that intersects, in a fixed order. Writes the first `capacity` to out,
   counts all; adds to *count. Returns how many were written. */
int crossing_find(const CrossingSet *edges, const CrossingSet *triangles, Crossing *out, int capacity,
                  CrossingCount *count);

/* The same pairs in another order, found without culling: the cost for a program without boxes, with which the paper's
   experiment is repeated. Counts every pair as tested. */
int crossing_find_plainly(const CrossingSet *edges, const CrossingSet *triangles, Crossing *out, int capacity,
                          CrossingCount *count);

#endif
