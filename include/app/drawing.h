/* What a sheet of pictures is to show, read from the options of `draw`. */
#ifndef APP_DRAWING_H
#define APP_DRAWING_H

#include "app/settings.h"

enum { DRAWING_SPANS_MAX = 32, DRAWING_CELLS_MAX = 8, DRAWING_PICTURES_MAX = 64 };

/* One picture of each frame: how it is dressed and what is drawn besides the surfaces. */
typedef struct {
    Method method;
    SplitRule split;
    unsigned show;            /* SHOW_ bits */
    char title[80];           /* below the picture; empty: none */
} DrawingCell;

typedef struct {
    double azimuth, elevation; /* degrees, as in scene_view */
    int ncells;
    DrawingCell cell[DRAWING_CELLS_MAX];
    int nspans;               /* 0: what drawing_spread makes */
    FrameSpan span[DRAWING_SPANS_MAX];
} Drawing;

/* ERR_USAGE that names the option. */
MUST_CHECK bool drawing_read(const Settings *settings, Arena *arena, Drawing *out, Error *e);

/* Which of `total` frames are drawn: their numbers, ascending, each once, into *frame and how many
   into *count. ERR_USAGE where a span begins behind the end or too many are wanted. */
MUST_CHECK bool drawing_frames(const Drawing *d, const char *motion, int total, Arena *arena, int **frame, int *count,
                               Error *e);

#endif
