/* The two tables of a run as CSV: stats.csv has a row for each frame and garment, summary.csv
   one for each motion and garment. Which columns there are, their units and what they mean
   stands in one table in stats.c; lines that begin with '#' tell the units. */
#ifndef FILES_STATS_H
#define FILES_STATS_H

#include "dress/frame.h"
#include "files/output.h"

/* A row of stats.csv. Texts need to live only until the row is written. */
typedef struct {
    int frame;           /* as in the source, from 1 */
    double time;         /* seconds since the first frame of the motion */
    const char *garment;
    SplitRule split;
    Method method;
    FrameStats stats;
    double pose_s, write_s;
    double arm_turn;     /* degrees; see TakeFrame */
} StatsRow;

/* A row of summary.csv; clear with {0}, name it, and summary_add each frame. */
typedef struct {
    const char *motion, *garment;
    const char *status;  /* "ok", "failed" or "refused" */
    int frames, residual_frames, limb_frames, pinched_frames, capped_frames;
    long long residual_edges, residual_cloth, inside;
    double deepest, max_displacement, mean_nodes;
    int max_nodes;
    long long nodes;     /* of all frames, for the mean */
    long long pairs_all, pairs_tested;
    long long bytes;     /* written for this garment */
    double seconds;
    const char *reason;  /* why not ok; NULL = nothing to say */
    double arm_turn;     /* the largest of all frames */
} SummaryRow;

/* Does anything of the garment still go through what it is worn over? */
bool stats_has_residual(const FrameStats *s);

/* Through any other part, such as a hand that comes from outside? */
bool stats_has_limb(const FrameStats *s);

void summary_add(SummaryRow *sum, const StatsRow *row);

typedef enum { TABLE_STATS, TABLE_SUMMARY } StatsTable;

/* A table that is being written; nothing of it is seen before stats_close. */
typedef struct { Output out; StatsTable table; bool times; } StatsFile;

/* Writes the head. times: with the columns of measured seconds, which no two runs share.
   One stats_close or stats_abandon must follow a success. ERR_OUTPUT. */
MUST_CHECK bool stats_open(StatsFile *f, const char *path, StatsTable table, bool times, Error *e);
MUST_CHECK bool stats_add(StatsFile *f, const StatsRow *row, Error *e);
MUST_CHECK bool stats_add_summary(StatsFile *f, const SummaryRow *row, Error *e);
/* Lines that were written before, or a comment, as they stand. */
MUST_CHECK bool stats_add_text(StatsFile *f, const char *lines, Error *e);
MUST_CHECK bool stats_close(StatsFile *f, Error *e);
void stats_abandon(StatsFile *f);

/* The columns as a Markdown table, as the README shows them. */
void stats_describe(StatsTable table, FILE *out);

#endif
