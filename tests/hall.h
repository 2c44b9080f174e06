/* A press and threads that help at it, for the unit programs of press and crew. */
#ifndef TESTS_HALL_H
#define TESTS_HALL_H

#include <stdatomic.h>

#include "app/crew.h"

enum { HELPERS = 3 };

typedef struct {
    pthread_mutex_t lock;
    pthread_cond_t change;
    Press press;
    pthread_t helper[HELPERS];
    bool is_over;
    atomic_int by_helpers; /* pieces of a crew's rounds */
} Hall;

static inline void hall_open(Hall *hall) {
    *hall = (Hall){.is_over = false};
    pthread_mutex_init(&hall->lock, NULL);
    pthread_cond_init(&hall->change, NULL);
}

/* A thread without a motion, as in app/batch.c. */
static inline void *hall_help(void *context) {
    Hall *hall = context;
    Pen pen = {0};
    pthread_mutex_lock(&hall->lock);
    hall->press.helpers++;
    while (!hall->is_over) {
        if (crew_help(&hall->press, &pen)) hall->by_helpers++;
        else if (!press_help(&hall->press, &pen)) pthread_cond_wait(&hall->change, &hall->lock);
    }
    hall->press.helpers--;
    pthread_mutex_unlock(&hall->lock);
    pen_free(&pen);
    return NULL;
}

static inline void hall_fill(Hall *hall) {
    for (int i = 0; i < HELPERS; i++) pthread_create(&hall->helper[i], NULL, hall_help, hall);
}

static inline void hall_empty(Hall *hall) {
    pthread_mutex_lock(&hall->lock);
    hall->is_over = true;
    pthread_cond_broadcast(&hall->change);
    pthread_mutex_unlock(&hall->lock);
    for (int i = 0; i < HELPERS; i++) pthread_join(hall->helper[i], NULL);
}

#endif
