/* Sixteen bounding boxes in one structure of arrays, made and compared by SIMD instructions. */
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

/* Makes the boxes of n <= 16 items whose corners are position[index[0]], position[index[1]], ... Lanes beyond are
   empty. The box round all of them becomes box `lane` of `above`. */
typedef void TileBoxes(Tile *out, const Vec3 *position, const int *index, int n, Tile *above, int lane);

typedef struct {
    TileBoxes *segments, *triangles; /* items of two and of three corners */
    /* The lanes of tile a that overlap box k of tile b; touching is enough. */
    TileLanes (*overlap)(const Tile *a, const Tile *b, int k);
    /* The same for each k in `lanes`, into row[k]. Returns the lanes of b that overlap any. */
    TileLanes (*meet)(const Tile *a, const Tile *b, TileLanes lanes, TileLanes row[TILE_LANES]);
} TileMachine;

/* The functions for an instruction set. All give the same bits. */
const TileMachine *tile_machine(Vectors vectors);

/* The box round all boxes of `below` becomes box `lane` of `above`. */
void tile_sum(const Tile *below, Tile *above, int lane);

/* Empties the lanes from `first` on. */
void tile_empty(Tile *t, int first);

#endif
