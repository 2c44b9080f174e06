/* What a run says of itself when it is over. */
#ifndef APP_REPORT_H
#define APP_REPORT_H

#include "app/job.h"

/* How many of `count` motions were dressed and what that gave; with --verbose also where the time went, with --quiet
   nothing. seconds: how long the run took on that many workers. */
void report_print(const Settings *s, const JobResult *result, int count, int workers, double seconds, FILE *out);

#endif
