/* From pixels to curves: the cracks between pixels are joined to long lines, and these are
   smoothed and thinned until few points tell the same. */
#ifndef FILES_OUTLINE_H
#define FILES_OUTLINE_H

#include "base/arena.h"

/* Pixels; (0, 0) is the upper left corner of the first one. */
typedef struct { float x, y; } OutlinePoint;

typedef struct {
    int width;             /* pixels */
    int left, top, right, bottom; /* the part of the picture that is looked at; right, bottom: behind it */
    unsigned char *crack;  /* [y * (width + 1) + x]: bits of the corner (x, y): see outline.c */
    OutlinePoint *point;   /* of the line that outline_next has found */
    int count, capacity;
    bool is_closed;        /* then the last point is not the first again */
    int at, pass;          /* private: where the search goes on */
    unsigned char *kept;   /* private */
    int (*range)[2];       /* private: work list of thinning */
} Outline;

MUST_CHECK bool outline_reserve(Outline *o, int width, int height, Arena *arena, Error *e);

/* Starts afresh, without a crack, in the pixels from (left, top) up to before (right, bottom). */
void outline_clear(Outline *o, int left, int top, int right, int bottom);

/* Adds the side above the pixel (x, y), or the one left of it. x = right and y = bottom are the sides
   of the part. */
void outline_above(Outline *o, int x, int y);
void outline_left(Outline *o, int x, int y);

/* The next line, thinned: each crack belongs to one. Where every corner has an even number of
   cracks, as round a region, all lines are closed. False: there are no more. */
bool outline_next(Outline *o);

/* Area inside a closed line, pixels; length of any. */
double outline_area(const Outline *o);
double outline_length(const Outline *o);

/* Writes the line as words of an SVG path, coordinates times `scale` rounded to whole numbers.
   Gentle bends become curves, sharp ones stay corners. */
void outline_write(const Outline *o, double scale, FILE *out);

#endif
