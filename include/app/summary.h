/* summary.csv: a row for each motion and garment of a run. */
#ifndef APP_SUMMARY_H
#define APP_SUMMARY_H

#include "app/job.h"
#include "files/lock.h"

/* The last line of a shard's: which part of how many motions this is. */
#define SUMMARY_SHARD "# shard %d of %d of %d motions\n"

/* The file of this run: OUT/summary.csv, or OUT/summary.K-of-N.csv of a shard. ERR_OUTPUT. */
MUST_CHECK bool summary_path(const Settings *s, char path[OUTPUT_PATH_MAX], Error *e);

/* Makes the output folder, and locks the summary: one run at a time may write it. The lock lasts as long as the
   run. ERR_OUTPUT. */
MUST_CHECK bool summary_lock(const Settings *s, Lock *lock, Error *e);

/* Writes the file: the rows of each motion in the order of the inputs. total: motions of the list that these are a
   shard of. ERR_OUTPUT. */
MUST_CHECK bool summary_write(const Wardrobe *w, const Input *input, const JobResult *result, int count, int total,
                              Error *e);

/* Joins the summaries in the folders s->inputs: shards take turns, as their motions did, others follow
   one another. Writes s->output/summary.csv, or that of the only folder. ERR_INPUT where a shard is
   missing or they do not belong together. */
MUST_CHECK bool summary_merge(const Settings *s, Arena *arena, Error *e);

#endif
