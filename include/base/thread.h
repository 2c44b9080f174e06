/* Pieces of work at the same time. */
#ifndef BASE_THREAD_H
#define BASE_THREAD_H

#include "base/error.h"

/* Processors that this process may use, at least 1. */
int thread_count(void);

/* Calls run(context, item) once for every item in 0..count-1, each on a thread of its own where so many can be had (a
   single one on the calling thread), and waits for all. */
MUST_CHECK bool thread_each(int count, void (*run)(void *context, int item), void *context, Error *e);

#endif
