/* Ctrl-C and SIGTERM: a request that is looked at between frames. */
#ifndef APP_STOP_H
#define APP_STOP_H

#include <stdbool.h>

/* From now on the first SIGINT or SIGTERM only sets a flag, a second one ends the program at
   once. */
void stop_listen(void);

/* From now on a closed pipe, or a file that grows beyond its limit, is an error of the write and
   no longer kills: for commands that leave files behind, which must be whole. */
void stop_outlive_readers(void);

/* Has somebody asked to stop? */
bool stop_requested(void);

#endif
