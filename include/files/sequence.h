/* Numbered files, a frame each: skirt.0001.obj, skirt.0002.obj, ... */
#ifndef FILES_SEQUENCE_H
#define FILES_SEQUENCE_H

#include "base/arena.h"

typedef struct { int number; const char *path; } SequenceFile;

typedef struct {
    const char *pattern; /* for messages */
    const char *name;    /* what stands before the number, without separators: "skirt" */
    bool still;          /* one file without a number, which holds in every frame */
    int count;
    SequenceFile *file;  /* by number, each once */
} Sequence;

/* The files of a pattern: the number stands at `*`, `####` or `%04d` in the name of the file, as
   any number of digits, up to 999,999,999. Without such a mark it is one file. ERR_INPUT if there is none. */
MUST_CHECK bool sequence_find(const char *pattern, Arena *arena, Sequence *out, Error *e);

/* All sequences NAME.0001.ending in a folder (at least four digits), by name. None is no error. */
MUST_CHECK bool sequence_scan(const char *folder, const char *ending, Arena *arena, Sequence **out, int *count,
                              Error *e);

/* The file of that number; NULL if there is none. */
const char *sequence_path(const Sequence *s, int number);

#endif
