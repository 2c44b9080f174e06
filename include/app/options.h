/* The command line: GNU manners over the table of settings. */
#ifndef APP_OPTIONS_H
#define APP_OPTIONS_H

#include "app/settings.h"

/* A word after `kitsuke`. */
typedef struct {
    const char *name;
    CommandBit bit;
    const char *summary;  /* one line, lower case */
    const char *operands; /* behind the name in the usage line */
    const char *example;  /* lines that can be typed as they stand */
    /* Does the work and returns the exit code. What it leaves in *e is printed by main. */
    ErrorKind (*run)(const Settings *settings, Error *e);
} Command;

/* Reads the words behind the command, and before them the job file that they name; they win.
   Stops where --help or --version is asked for: then out->help or out->version is set and
   nothing else matters. Texts point into argv. ERR_USAGE. */
MUST_CHECK bool options_parse(const Command *command, int argc, char **argv, Arena *arena, Settings *out, Error *e);

/* The option of that name; *no: it was called no-NAME, a switch that is taken back. As settings_find. */
const Option *options_find(const char *name, unsigned commands, bool *no);

#endif
