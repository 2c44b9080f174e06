/* A fixed number of workers that take numbered items from one counter. */
#ifndef BASE_THREAD_H
#define BASE_THREAD_H

#include "base/error.h"

/* Processors that this process may use, at least 1. */
int thread_count(void);

/* Calls run(context, item, worker) once for every item in 0..count-1 on up to `workers`
   threads (worker in 0..workers-1; 1 = on the calling thread) and waits for all. Which
   worker gets which item is not defined; each item is done exactly once. */
MUST_CHECK bool thread_each(int count, int workers, void (*run)(void *context, int item, int worker),
                            void *context, Error *e);

#endif
