/* From what stands on the command line to the list of motions, each with a folder of its own. */
#ifndef APP_INPUTS_H
#define APP_INPUTS_H

#include "app/settings.h"

typedef struct {
    const char *path;  /* to open; "-" is standard input */
    const char *name;  /* folder below the output folder: relative, never leading out of it, its own */
    bool is_empty;     /* path is a folder that holds no motion */
} Input;

/* Files in the order they were named; folders are searched recursively for .bvh and .amc, in
   the order of the names' bytes. A file that was reached twice is taken once. What cannot be
   read stays in the list: it is that motion's failure, not the batch's. Memory from arena. */
MUST_CHECK bool inputs_collect(const TextList *operands, Arena *arena, Input **out, int *count, Error *e);

#endif
