/* A list of paths in a file. */
#ifndef APP_LISTFILE_H
#define APP_LISTFILE_H

#include "app/settings.h"

/* Appends the paths of the file (or "-", standard input), one in a line as it stands, or separated
   by NUL as `find -print0` writes them; empty ones are left out. ERR_INPUT. Memory from arena. */
MUST_CHECK bool listfile_read(const char *path, Arena *arena, TextList *out, Error *e);

#endif
