/* Many motions on many threads. */
#ifndef APP_BATCH_H
#define APP_BATCH_H

#include "app/job.h"

/* Dresses every input and writes summary.csv. One that fails is an error on stderr and a row
   with the reason; the others go on. Messages and rows come in the order of the inputs, and
   everything that is written is the same however many threads there are. Returns the worst
   exit code; *e is set for what concerns the whole run. total: of the list that these are a shard
   of. */
ErrorKind batch_run(const Wardrobe *wardrobe, const Input *input, int count, int total, Arena *arena, Error *e);

#endif
