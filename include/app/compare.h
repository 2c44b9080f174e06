/* The experiment: one motion and one garment, dressed by several methods over the same frames. */
#ifndef APP_COMPARE_H
#define APP_COMPARE_H

#include "app/inputs.h"
#include "app/wardrobe.h"
#include "files/obj.h"

enum { COMPARE_RUNS_MAX = 16 };

/* Seconds of each run: over all frames, and over those with contact. */
typedef struct { double all[COMPARE_RUNS_MAX], contact[COMPARE_RUNS_MAX]; } CompareSeconds;

/* One method over the frames of one motion, or of several. */
typedef struct {
    int frames, contact_frames;   /* contact: the adaptive classification splits a patch */
    int residual_frames, nodes_max, leaves_max;
    long long nodes, leaves;
    long long tests, tests_max, tests_contact; /* as the paper counts: no culling */
    long long tests_culled;
    long long points, bytes;      /* control points of the final leaves; of the frame as OBJ */
    double displacement;          /* metres */
    CompareSeconds plain, culled, solve; /* in tests without and with culling, in the local deformation */
} CompareSum;

typedef struct {
    const char *motion, *garment;
    Error error;                       /* kind 0: compared */
    CompareSum sum[COMPARE_METHODS];   /* of the methods that were asked for */
} ComparePair;

/* The methods that are run: those asked for, and always uniform and adaptive. */
unsigned compare_methods(const Settings *settings);

/* How often each is timed. */
int compare_runs(const Settings *settings);

/* "uniform", "adaptive", "global", "paper" */
const char *compare_name(CompareMethod method);

/* Dresses the motion in garment number g of the wardrobe and writes compare.csv, tests.svg and
   times.svg to `folder` (no pictures where there is no contact, no times with --no-times). Notes
   and memory as in job_open; the caller resets the arena. Fills all of *out but the names. */
void compare_run(const Wardrobe *wardrobe, int g, const Input *input, const char *folder, Arena *arena, ObjWriter *obj,
                 Notes *notes, ComparePair *out);

/* Adds what another motion gave. */
void compare_add(CompareSum *sum, const CompareSum *other);

/* What was found as Markdown tables, with total rows where there are several pairs. */
void compare_print(const ComparePair *pair, int count, const Settings *settings, FILE *out);

#endif
