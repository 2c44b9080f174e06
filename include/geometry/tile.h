/* Sixteen segments or triangles with their bounding boxes in structures of arrays, made and compared by SIMD
   instructions. */
#ifndef GEOMETRY_TILE_H
#define GEOMETRY_TILE_H

#include "geometry/vec.h"
#include "geometry/vectors.h"

enum { TILE_LANES = 16 };

/* Box k is low[x][k] .. high[x][k] for the axes x = 0, 1, 2. A lane without a box is empty: low
   is larger than high, and it overlaps nothing. */
typedef struct { _Alignas(64) float low[3][TILE_LANES], high[3][TILE_LANES]; } Tile;

/* A set of lanes: bits 1 << lane. */
typedef unsigned short TileLanes;

/* Both ends of sixteen segments. */
typedef struct { _Alignas(64) float p[3][TILE_LANES], q[3][TILE_LANES]; } TileEnds;

/* The planes of sixteen triangles: n x = w, so long that |nx| + |ny| + |nz| <= 1; n is zero where a triangle has none.
   The error of n is a few roundings however thin the triangle is. */
typedef struct { _Alignas(64) float n[3][TILE_LANES], w[TILE_LANES]; } TilePlanes;

typedef union { TileEnds ends; TilePlanes planes; } TileShapes;

/* What is made of n <= 16 items whose corners are position[index[0]], position[index[1]], ... */
typedef struct {
    int corners; /* of an item: 2, a segment, or 3, a triangle */
    /* Their boxes, the lanes beyond empty. The box round all of them becomes box `lane` of `above`. */
    void (*boxes)(Tile *out, const Vec3 *position, const int *index, int n, Tile *above, int lane);
    /* The ends of segments, the planes of triangles. */
    void (*shapes)(TileShapes *out, const Vec3 *position, const int *index, int n);
} TileItems;

typedef struct {
    TileItems segments, triangles;
    /* For each k in `lanes` row[k] becomes the lanes of tile a that overlap box k of tile b; touching is enough.
       Returns the lanes of b that overlap any. */
    TileLanes (*meet)(const Tile *a, const Tile *b, TileLanes lanes, TileLanes row[TILE_LANES]);
    /* For each triangle k in `lanes` row[k] keeps, of the segments in it, those that may reach the triangle: they do
       not have both ends on one side of its plane, farther from it than `slack`. Returns the triangles that any may
       reach; adds how many segments there were to *pairs. */
    TileLanes (*reach)(const TileEnds *ends, const TilePlanes *planes, TileLanes lanes, float slack,
                       TileLanes row[TILE_LANES], long long *pairs);
} TileMachine;

/* The functions for an instruction set. All give the same bits. */
const TileMachine *tile_machine(Vectors vectors);

/* The lanes of tile a that overlap box k of tile b. */
TileLanes tile_overlap(const Tile *a, const Tile *b, int k);

/* The segments that may reach plane k: not both ends on one side, farther from it than slack. */
TileLanes tile_reaching(const TileEnds *ends, const TilePlanes *planes, int k, float slack);

/* The box round all boxes of `below` becomes box `lane` of `above`. */
void tile_sum(const Tile *below, Tile *above, int lane);

/* Empties the lanes from `first` on. */
void tile_empty(Tile *t, int first);

#endif
