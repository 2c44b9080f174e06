/* The one mutable global of the program: a signal handler has no other place to write to. It is
   a lock-free atomic, which C11 allows in a handler and between threads. */
#include "app/stop.h"

#include <signal.h>
#include <stdatomic.h>
#include <stddef.h>

static atomic_int requested;

static void request(int signal_number) {
    (void)signal_number;
    atomic_store(&requested, 1);
}

void stop_listen(void) {
    struct sigaction action = {.sa_handler = request, .sa_flags = (int)(SA_RESTART | SA_RESETHAND)};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

void stop_outlive_readers(void) {
    struct sigaction ignore = {.sa_handler = SIG_IGN};
    sigemptyset(&ignore.sa_mask);
    sigaction(SIGPIPE, &ignore, NULL);
    sigaction(SIGXFSZ, &ignore, NULL);
}

bool stop_requested(void) { return atomic_load(&requested) != 0; }
