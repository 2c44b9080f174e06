/* One motion with its garments, from end to end. */
#ifndef APP_JOB_H
#define APP_JOB_H

#include "app/inputs.h"
#include "app/wardrobe.h"
#include "files/obj.h"
#include "files/stats.h"

/* Where the time goes. OTHER is what is left of the whole. */
typedef enum {
    STAGE_OPEN, STAGE_POSE, STAGE_GLOBAL, STAGE_TEST, STAGE_PUSH, STAGE_MESH, STAGE_WRITE, STAGE_OTHER, STAGE_COUNT
} Stage;

typedef struct {
    Error error;             /* kind 0: dressed, every file is written */
    int frames;              /* that were dressed */
    long long bytes;         /* that were written */
    int residual_frames;     /* with anything that still shows through any garment */
    double seconds[STAGE_COUNT];
    SummaryRow *row;         /* ngarments of them, by the caller: sums over the frames so far */
} JobResult;

/* What one thread keeps from job to job. Clear with {0}; job_memory_free gives it back. */
typedef struct { Arena arena; ObjWriter obj; } JobMemory;
void job_memory_free(JobMemory *m);

/* Called after each frame: `done` of `total` frames stand on the disk. */
typedef struct { void (*frame)(void *context, int done, int total); void *context; } JobWatch;

/* Dresses one motion: reads it, finds its figure, fits body and garments, and writes frame by
   frame. Nothing is written unless everything could be read and fitted. The caller resets
   the arena. Looks at stop_requested after each frame (ERR_INTERRUPTED). With --strict ERR_CHECK
   where something shows through. `about`, if not NULL, gets what --verbose prints. `out` must be
   zero but for `row`. */
void job_run(const Wardrobe *wardrobe, const Input *input, const JobWatch *watch, JobMemory *memory, Notes *notes,
             FILE *about, JobResult *out);

#endif
