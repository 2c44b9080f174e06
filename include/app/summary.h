/* summary.csv: a row for each motion and garment of a run. */
#ifndef APP_SUMMARY_H
#define APP_SUMMARY_H

#include "app/job.h"

/* The file of this run: OUT/summary.csv, or OUT/summary.K-of-N.csv of a shard. ERR_OUTPUT. */
MUST_CHECK bool summary_path(const Settings *s, char path[OUTPUT_PATH_MAX], Error *e);

/* The rows of a motion; `rows`, if not NULL, as they were recorded before. */
MUST_CHECK bool summary_add_motion(StatsFile *f, const Wardrobe *w, const Input *input, const JobResult *result,
                                   const char *rows, Error *e);

#endif
