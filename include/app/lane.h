/* What one thread needs to dress the frames of a chunk: poses of its own, dressers, memory. */
#ifndef APP_LANE_H
#define APP_LANE_H

#include "app/chunks.h"
#include "app/press.h"
#include "app/wearer.h"
#include "dress/padding.h"

/* A frame, and the body posed for it. Motion, figure and body are the job's. */
typedef struct {
    Wearer wearer;
    TakeFrame frame;
    double seconds;      /* that posing it took */
} Stance;

/* Clear with {0} once, lane_free at the end; in between it serves any motion. */
typedef struct {
    Arena arena;
    Pen pen;
    Stance stance[2];    /* of the frame that is dressed, and of the next */
    Dresser **dresser;   /* one for each garment */
    Padding padding;     /* how far these stand off */
} Lane;

/* What a chunk gives, in the order of its frames. Arrays by the job. */
typedef struct {
    StatsRow *row;         /* nrows of them */
    int nrows, frames, residual_frames, limb_frames;
    long long body_bytes, *bytes; /* written for the body, for each garment */
    double *seconds;       /* for each garment */
    double helped;         /* seconds that other threads spent on writing its files */
    Jumps jumps;
    Error error;
} ChunkResult;

/* What the chunks of a motion share; const while they run. */
typedef struct {
    const Wardrobe *wardrobe;
    const Wearer *wearer;
    const char *folder;    /* where the meshes go */
    double unit;           /* output units per metre */
    Press *press;          /* that writes them */
} LaneWork;

/* Called after each frame that was written. */
typedef struct { void (*frame)(void *context); void *context; } LaneWatch;

void lane_free(Lane *lane);

/* Makes the lane ready for one chunk of a motion. What was in it is forgotten. */
MUST_CHECK bool lane_open(Lane *lane, const LaneWork *work, Error *e);

/* Dresses a chunk on a lane that was opened for it, so from a state that is the same whatever was
   dressed before. */
void lane_run(Lane *lane, const LaneWork *work, const Chunk *chunk, const LaneWatch *watch, ChunkResult *out);

#endif
