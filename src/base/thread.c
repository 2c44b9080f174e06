/* Threads that take the next item from one atomic counter until none is left, so that all items are done also where
   there are fewer threads. */
#define _GNU_SOURCE /* sched_getaffinity */
#include "base/thread.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

typedef struct {
    atomic_int next;
    int count;
    void (*run)(void *, int);
    void *context;
} Shared;

/* Batch systems and taskset give a job some of the machine's processors. */
int thread_count(void) {
#ifdef __linux__
    cpu_set_t ours;
    if (sched_getaffinity(0, sizeof ours, &ours) == 0) return CPU_COUNT(&ours);
#endif
    long n = sysconf(_SC_NPROCESSORS_ONLN);
    return n < 1 ? 1 : n > 1024 ? 1024 : (int)n;
}

static void *work(void *argument) {
    Shared *s = argument;
    for (int i; (i = atomic_fetch_add(&s->next, 1)) < s->count;) s->run(s->context, i);
    return NULL;
}

bool thread_each(int count, void (*run)(void *, int), void *context, Error *e) {
    Shared shared = {.count = count, .run = run, .context = context};
    int started = 0;
    atomic_init(&shared.next, 0);
    pthread_t *thread = count > 1 ? calloc((size_t)count, sizeof *thread) : NULL;
    if (count > 1 && !thread) return error_set(e, ERR_INTERNAL, "out of memory for %d threads", count);
    while (thread && started < count && pthread_create(&thread[started], NULL, work, &shared) == 0) started++;
    if (!started) work(&shared); /* no thread is needed, or none to be had */
    for (int i = 0; i < started; i++) pthread_join(thread[i], NULL);
    free(thread);
    return true;
}
