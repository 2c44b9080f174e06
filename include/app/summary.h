/* summary.csv: a row for each motion and garment of a run. */
#ifndef APP_SUMMARY_H
#define APP_SUMMARY_H

#include "app/job.h"

#define SHARD_LINE "# shard %d of %d of %d motions\n"

/* The file of this run: OUT/summary.csv, or OUT/summary.K-of-N.csv of a shard. ERR_OUTPUT. */
MUST_CHECK bool summary_path(const Settings *s, char path[OUTPUT_PATH_MAX], Error *e);

/* The rows of a motion; `rows`, if not NULL, as they were recorded before. */
MUST_CHECK bool summary_add_motion(StatsFile *f, const Wardrobe *w, const Input *input, const JobResult *result,
                                   const char *rows, Error *e);

/* The last line, of a shard: which part of how many motions this is. */
MUST_CHECK bool summary_end(StatsFile *f, const Settings *s, int total, Error *e);

/* Joins the summaries in the folders s->inputs: shards take turns, as their motions did, others follow
   one another. Writes s->output/summary.csv, or that of the only folder. ERR_INPUT where a shard is
   missing or they do not belong together. */
MUST_CHECK bool summary_merge(const Settings *s, Arena *arena, Error *e);

#endif
