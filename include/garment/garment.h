/* A garment as its text file gives it: rings round the body, panels lofted through rings, raw
   patches, seams, pins and colliders. Lengths in metres on the reference figure (1.70 m) in
   the canonical stance. The format is documented in garments/README.md. */
#ifndef GARMENT_GARMENT_H
#define GARMENT_GARMENT_H

#include "base/text.h"
#include "figure/body.h"

enum {
    GARMENT_NAME_MAX = 48, GARMENT_RINGS_MAX = 64, GARMENT_PANELS_MAX = 32, GARMENT_ROWS_MAX = 16,
    GARMENT_PATCHES_MAX = 64, GARMENT_SEAMS_MAX = 128, GARMENT_JOINS_MAX = 32, GARMENT_COLLIDES_MAX = 32,
    GARMENT_PINS_MAX = 16, GARMENT_DETAIL_MAX = 64, BINDING_MAX = 4
};

typedef enum { FOLLOW_BONES, FOLLOW_ENVELOPE } Follow; /* the global deformation */

/* The four named points of a ring. left is the one with the larger canonical x, front faces +z. */
typedef enum { STATION_LEFT, STATION_FRONT, STATION_RIGHT, STATION_BACK, STATION_COUNT, STATION_NONE = -1 } Station;

/* Weights of the bones that a point follows; positive, sum 1. n == 0: not given. */
typedef struct { int n; Role bone[BINDING_MAX]; double weight[BINDING_MAX]; } Binding;

/* A ring: two half-ellipses round a body part, `ease` metres off its section, or of an own
   size. Centre: the section's centre plus `shift` (canonical axes). Plane: across the part's
   axis, then turned by `tilt` degrees about canonical z (positive raises the left side); the
   stations keep the names they had before the turn. In a garment that follows the envelope a
   ring on a thigh or shin goes round both legs: its centre lies half-way between the two. */
typedef struct {
    char name[GARMENT_NAME_MAX];
    Role part;
    double at;                    /* place along the part, in bone lengths */
    double ease;                  /* metres added to side, front and back */
    bool has_size;
    double side, front, back;     /* half sizes if has_size, ease is added */
    Vec3 shift;
    double tilt;
    Vec3 move[STATION_COUNT];     /* moves one station, canonical axes */
    Binding binding[STATION_COUNT];
} Ring;

/* One curve of a panel: an arc of a ring, a quarter (via = STATION_NONE) or half. */
typedef struct { int ring; Station from, via, to; } Row;

/* A column of nrows - 1 patches. u runs along the rows, w from the first row to the last. */
typedef struct { char name[GARMENT_NAME_MAX]; int nrows; Row row[GARMENT_ROWS_MAX]; } Panel;

/* A raw patch: 16 control points in four columns, from start to end, each from top to bottom:
   point[4 * i + j] is B_ij. */
typedef struct { char name[GARMENT_NAME_MAX]; Vec3 point[16]; Binding binding[16]; } RawPatch;

/* start / end: first / last point of every row (u = 0 / 1); top / bottom: first / last row (w = 0 / 1). */
typedef enum { SIDE_START, SIDE_END, SIDE_TOP, SIDE_BOTTOM } Side;

/* Index of control point k = 0..3 along a side, in the direction of growing u or w. */
static inline int side_point(Side side, int k) {
    return side == SIDE_START ? k : side == SIDE_END ? 12 + k : side == SIDE_TOP ? 4 * k : 4 * k + 3;
}

/* piece: panels first (0..npanels-1), then raw patches (npanels + k). */
typedef struct { int piece_a; Side side_a; int piece_b; Side side_b; bool crease; } Seam;

/* Two stations that are one point: the mean of both. */
typedef struct { int ring_a; Station station_a; int ring_b; Station station_b; } Join;

/* Which body parts patches collide with: those between two rings, or (rings -1) a whole piece.
   parts: bits 1 << role. */
typedef struct { int from_ring, to_ring; int piece; unsigned parts; } Collide;

/* Control points that the local deformation may not move. */
typedef struct { int ring; int piece; Side side; } Pin; /* ring -1: a side of a piece */

typedef struct {
    char name[GARMENT_NAME_MAX];
    Follow follow;
    bool loose;
    int detail;                   /* facets per side of a root patch; 0 = not given */
    int nrings, npanels, npatches, nseams, njoins, ncollides, npins;
    Ring ring[GARMENT_RINGS_MAX];
    Panel panel[GARMENT_PANELS_MAX];
    RawPatch patch[GARMENT_PATCHES_MAX];
    Seam seam[GARMENT_SEAMS_MAX];
    Join join[GARMENT_JOINS_MAX];
    Collide collide[GARMENT_COLLIDES_MAX];
    Pin pin[GARMENT_PINS_MAX];
} Garment;

/* "left", "front", "right", "back"; "start", "end", "top", "bottom". */
const char *station_name(Station s);
const char *side_name(Side s);

/* The ring, or the piece (panel or raw patch, numbered as in Seam), of that name; -1: none. */
int garment_find_ring(const Garment *g, const char *name);
int garment_find_piece(const Garment *g, const char *name);
const char *garment_piece_name(const Garment *g, int piece);

/* Reads and checks a garment: names known and unique, rings used in order, sides of seams of
   equal control points and equal bindings, patches not degenerate, a name that can be a file
   name and is not `body`. ERR_INPUT with file:line:column. `out` is large: keep it in an arena. */
MUST_CHECK bool garment_read(const char *path, Arena *scratch, Garment *out, Error *e);
MUST_CHECK bool garment_parse(const Text *text, Garment *out, Error *e);

/* Writes the same garment back (mirrors expanded). Reading, writing and reading again gives
   an equal Garment and equal bytes. False where `out` has an error. */
bool garment_write(const Garment *g, FILE *out);

#endif
