/* Workers that take the next item from one atomic counter until none is left. */
#include "base/thread.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

typedef struct {
    atomic_int next;
    int count;
    void (*run)(void *, int, int);
    void *context;
} Shared;

typedef struct {
    Shared *shared;
    int worker;
    pthread_t thread;
} Worker;

int thread_count(void) {
    long n = sysconf(_SC_NPROCESSORS_ONLN);
    return n < 1 ? 1 : n > 1024 ? 1024 : (int)n;
}

static void *work(void *argument) {
    Worker *w = argument;
    for (int i; (i = atomic_fetch_add(&w->shared->next, 1)) < w->shared->count;)
        w->shared->run(w->shared->context, i, w->worker);
    return NULL;
}

bool thread_each(int count, int workers, void (*run)(void *, int, int), void *context, Error *e) {
    Shared shared = {.count = count, .run = run, .context = context};
    atomic_init(&shared.next, 0);
    if (workers > count) workers = count;
    if (workers <= 1) {
        Worker alone = {.shared = &shared};
        work(&alone);
        return true;
    }
    Worker *w = calloc((size_t)workers, sizeof *w);
    if (!w) return error_set(e, ERR_INTERNAL, "out of memory for %d threads", workers);
    int started = 0;
    for (; started < workers; started++) {
        w[started] = (Worker){.shared = &shared, .worker = started};
        if (pthread_create(&w[started].thread, NULL, work, &w[started]) != 0) break;
    }
    if (!started) work(&w[0]); /* no thread to be had: do it here */
    for (int i = 0; i < started; i++) pthread_join(w[i].thread, NULL);
    free(w);
    return true;
}
