/* Meshes on their way to the disk. Whoever has nothing else to do writes them, so that the frames of
   one motion keep every thread busy although each has to wait for the one before. */
#ifndef APP_PRESS_H
#define APP_PRESS_H

#include <pthread.h>

#include "app/settings.h"
#include "files/obj.h"
#include "files/stats.h"

/* What one thread writes with. Clear with {0}, pen_free at the end. */
typedef struct { ObjWriter obj; DrcWriter drc; } Pen;
void pen_free(Pen *pen);

/* What became of the meshes of one chunk. Clear with {0}; the press's until press_finish. */
typedef struct {
    int waiting;         /* not yet on the disk */
    double helped;       /* seconds that other threads spent for it, less those that it has waited for them */
    Error error;
} PressTally;

/* One mesh. Pointers are kept until the tally is finished. */
typedef struct {
    const Settings *settings;
    const char *folder, *name; /* folder/name.0001.obj */
    int frame;
    double metre;              /* output units in one */
    long long *bytes;          /* grows by what was written */
    StatsRow *row;             /* nrows of them share the seconds */
    int nrows;
    PressTally *tally;
} PressOrder;

/* Clear with {0} for a press that takes no meshes over: then each thread writes its own. */
typedef struct PressSheet PressSheet;
typedef struct CrewRound CrewRound;
typedef struct {
    pthread_mutex_t *lock; /* of the batch, as is the next: guards what follows */
    pthread_cond_t *change;
    PressSheet *sheet;     /* places for meshes that wait */
    int nsheets, first, count; /* a ring */
    int helpers;           /* threads that have nothing else to do */
    CrewRound *rounds;     /* other work for them, see crew.h */
} Press;

MUST_CHECK bool press_open(Press *p, int threads, pthread_mutex_t *lock, pthread_cond_t *change, Arena *arena,
                           Error *e);
void press_close(Press *p);

/* Writes a mesh, or copies it for somebody who is free to. Errors of earlier meshes of the tally
   come up here too. Who does not look may ask press_good later: the tally keeps the first error. */
bool press_put(Press *p, Pen *pen, const PressOrder *order, const Mesh *mesh, Error *e);

/* False, and *e tells, if a mesh of the tally has failed by now. */
MUST_CHECK bool press_good(Press *p, const PressTally *tally, Error *e);

/* Returns when all meshes of the tally are on the disk or one has failed, which *e then tells; writes
   what others have not begun. */
void press_finish(Press *p, Pen *pen, PressTally *tally, Error *e);

/* For a thread that is free and holds the lock, which it lends meanwhile: writes one mesh. False if
   none waits. */
bool press_help(Press *p, Pen *pen);

/* For the tally's own thread, with the lock held: writes one of its meshes, if any waits; waits for
   others to change something. */
bool press_write_own(Press *p, Pen *pen, const PressTally *tally);
void press_wait(Press *p, PressTally *tally);

#endif
