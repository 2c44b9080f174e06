/* A motion file that is open: its skeleton, and its frames one by one. Rows are read when
   they are asked for, so memory does not grow with the number of frames. */
#ifndef MOTION_MOTION_H
#define MOTION_MOTION_H

#include "base/arena.h"
#include "motion/skeleton.h"

typedef enum { POSITION_GUESS, POSITION_REPLACE, POSITION_ADD } PositionRule;

/* Zero is the default everywhere. */
typedef struct {
    const char *asf;        /* skeleton of an AMC file; NULL: look beside it */
    double fps;             /* > 0: frames per second instead of what the file says */
    PositionRule position;  /* what position channels do to the OFFSET */
    int max_joints;         /* 0: 10000 */
    int max_frames;         /* 0: 100 million */
} MotionOptions;

typedef struct MotionSource MotionSource; /* the open file and an index of its frames */

typedef struct {
    const char *path, *format;  /* path as given, not copied; "BVH" or "ASF/AMC" */
    Skeleton skeleton;
    int nframes;                /* complete frames, at least 1 */
    double frame_time;          /* seconds, > 0 */
    int max_frames;             /* that the options allow, at any rate */
    bool has_frame_time;        /* false: the file (an AMC, mostly) says nothing, 1/120 s is assumed */
    double file_unit;           /* metres per file unit if the file says so (ASF), else 0 */
    MotionSource *source;
} Motion;

/* Opens a BVH file, or an AMC file with its ASF skeleton; by content, not by name. "-" is
   standard input (spooled). Reads the whole file once, so that everything that is wrong
   with it is known: ERR_INPUT with the place. Tolerated oddities go to notes (may be NULL).
   Needs motion_close even if it fails. Memory from arena. */
MUST_CHECK bool motion_open(const char *path, const MotionOptions *options, Arena *arena, Notes *notes,
                            Motion *out, Error *e);
void motion_close(Motion *m);

/* A reader of rows; each thread needs its own. Sequential reading is fastest. */
typedef struct MotionReader MotionReader;
MUST_CHECK bool motion_reader_open(const Motion *m, Arena *arena, MotionReader **out, Error *e);
void motion_reader_close(MotionReader *r);

/* The channel values of a frame (0-based) into row (skeleton.nchannels values). ERR_INPUT
   where the file has changed or vanished since it was opened. */
MUST_CHECK bool motion_row(MotionReader *r, int frame, double *row, Error *e);

#endif
