/* A job file: a command line that can be kept, read and repeated.

       # the skirt of the second figure
       motion   ../motions/paper-walk.bvh
       garment  ../garments/skirt.garment
       frames   1:60:5
       no-body

   A line is the long name of an option and its value, which is the rest of the line. '#' at the
   start of a word begins a comment. In "..." a value may hold anything: \" \\ \n \r \t. Relative
   paths are seen from the file's folder. */
#ifndef APP_JOBFILE_H
#define APP_JOBFILE_H

#include "app/commands.h"
#include "base/text.h"

/* Puts what the file says into `out`, which holds the defaults. ERR_USAGE with file, line and
   column. Texts and paths live in arena. */
MUST_CHECK bool jobfile_read(const char *path, const Command *command, Arena *arena, Settings *out, Error *e);

MUST_CHECK bool jobfile_parse(const Text *text, const Command *command, Arena *arena, Settings *out, Error *e);

/* The job that the settings amount to, without what is the default anyway. ERR_INTERNAL. */
MUST_CHECK bool jobfile_print(const Command *command, const Settings *s, FILE *out, Error *e);

#endif
