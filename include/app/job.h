/* One motion with its garments, from end to end, on as many threads as there are. */
#ifndef APP_JOB_H
#define APP_JOB_H

#include "app/lane.h"
#include "app/record.h"

/* Where the time goes. OTHER is what is left of the whole, warming up included. */
typedef enum {
    STAGE_OPEN, STAGE_POSE, STAGE_GLOBAL, STAGE_TEST, STAGE_PUSH, STAGE_MESH, STAGE_WRITE, STAGE_OTHER, STAGE_COUNT
} Stage;

typedef struct {
    Error error;             /* kind 0: dressed, every file is written */
    int frames;              /* that were dressed */
    long long bytes;         /* that were written */
    int residual_frames;     /* with anything that still shows through any garment */
    int limb_frames;         /* with a limb from outside in any garment */
    double seconds[STAGE_COUNT];
    SummaryRow *row;         /* ngarments of them, by the caller: sums over the frames so far */
    char *recorded;          /* the rows as text, where an earlier run has finished the motion, else NULL; malloc */
} JobResult;

typedef struct {
    const Wardrobe *wardrobe;
    const Input *input;
    RecordKey key;           /* of what is dressed */
    int workers;             /* how many chunks may be under way at the same time */
    Press *press;            /* that writes the meshes */
} JobOrder;

typedef struct Job Job;

/* Reads the motion, finds its figure, fits body and garments, and only then makes the folder, or
   clears it. Chunk 0 is taken by then: the caller's, to be dressed on this lane, which is ready for
   it. Memory from arena, the job's own. False with out->error; job_close must follow in any case
   but NULL. */
MUST_CHECK bool job_open(const JobOrder *order, Lane *lane, Notes *notes, Arena *arena, JobResult *out, Job **job);

/* The number of a chunk that nobody has taken, or -1: then none is to be had now, because all are
   taken, or something failed, or too many wait for an earlier one. Any thread. */
int job_take(Job *j);

/* Dresses the chunk that was taken, on this thread's lane. What went wrong is in the result. Any
   thread. Looks at stop_requested after each frame (ERR_INTERRUPTED). */
void job_chunk(Job *j, int chunk, Lane *lane, const LaneWatch *watch);

/* Is no chunk left or under way? True once only: whoever gets it closes the job. Any thread. */
bool job_is_over(Job *j);

/* Frames that will be written in all. */
int job_frames(const Job *j);

/* Finishes the statistics, brings everything to the disk and records it. With --strict ERR_CHECK
   where something shows through. `about`, if not NULL, gets what --verbose prints. */
void job_close(Job *j, FILE *about);

#endif
