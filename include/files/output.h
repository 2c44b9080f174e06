/* The one way to write a file. What is not finished is not there: bytes go to PATH.tmp in the
   same folder, every result is checked, and only a whole file is renamed to PATH. A failure
   removes the temporary and leaves an older PATH as it was. */
#ifndef FILES_OUTPUT_H
#define FILES_OUTPUT_H

#include <stddef.h>

#include "base/error.h"

enum { OUTPUT_PATH_MAX = 4096 };

/* A file that is being written bit by bit. "-" is standard output; a device or a pipe
   (/dev/null, /dev/stdout) is written in place, for a rename would replace the device. */
typedef struct {
    FILE *file;                          /* write here; NULL: nothing is open */
    char path[OUTPUT_PATH_MAX];          /* private */
    char temporary[OUTPUT_PATH_MAX + 8]; /* private; empty: written in place */
} Output;

/* Exactly one output_close or output_abandon must follow a success. ERR_OUTPUT. */
MUST_CHECK bool output_open(Output *o, const char *path, Error *e);

/* Have all bytes so far been taken? Cheap; lets a long job stop at once when the disk is full. */
MUST_CHECK bool output_good(const Output *o, Error *e);

/* Flushes, closes and renames. Whatever the result, the Output is closed afterwards. */
MUST_CHECK bool output_close(Output *o, Error *e);

/* Gives up: nothing is left. Harmless where nothing is open. */
void output_abandon(Output *o);

/* A whole file at once; allocates nothing. */
MUST_CHECK bool output_file(const char *path, const void *data, size_t size, Error *e);

/* Makes a folder and those above it; one that is there already is fine. */
MUST_CHECK bool output_folder(const char *path, Error *e);

#endif
