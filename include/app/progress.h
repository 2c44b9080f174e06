/* One line that tells how far a run is, and messages that do not tear it. */
#ifndef APP_PROGRESS_H
#define APP_PROGRESS_H

#include <stdbool.h>

typedef struct {
    bool visible;
    int motions, done, failed;  /* how many there are, are done, of these failed */
    double weight;              /* of all motions */
    double finished;            /* weight of those that are done */
    double started, drawn;      /* clock_seconds */
    long long frames;           /* that were dressed */
    int shown;                  /* characters that stand in the line now */
} Progress;

/* visible: draw at all. Not thread-safe: the caller has a lock. */
void progress_start(Progress *p, bool visible, int motions, double weight);

/* Draws the line, at most ten times a second. under_way: weight of the parts of unfinished
   motions that are done. */
void progress_draw(Progress *p, double under_way);

/* Takes the line away, so that something else can be printed on stderr. */
void progress_hide(Progress *p);

#endif
