/* One line that tells how far a run is, and messages that do not tear it. */
#ifndef APP_PROGRESS_H
#define APP_PROGRESS_H

#include "app/settings.h"

typedef struct {
    ProgressMode mode;          /* ALWAYS, NEVER or JSON */
    int motions, done, failed;  /* how many there are, are done, of these failed */
    double weight;              /* of all motions */
    double finished;            /* weight of those that are done */
    double started, drawn;      /* clock_seconds */
    long long frames;           /* that were dressed */
    bool is_shown;              /* does the line stand there now? */
} Progress;

/* Draws what the settings ask for. Not thread-safe: the caller has a lock. */
void progress_start(Progress *p, const Settings *settings, int motions, double weight);

/* Draws the line, at most ten times a second (JSON: once). under_way: weight of the parts of unfinished
   motions that are done. */
void progress_draw(Progress *p, double under_way);

/* Takes the line away, so that something else can be printed on stderr. */
void progress_hide(Progress *p);

/* All is over: no line is left, or the last one of JSON. */
void progress_end(Progress *p);

#endif
