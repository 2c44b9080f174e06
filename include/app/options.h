/* The command line: GNU manners over the table of settings. */
#ifndef APP_OPTIONS_H
#define APP_OPTIONS_H

#include "app/commands.h"

/* Reads the words behind the command, and before them the job file that they name; they win.
   Stops where --help or --version is asked for: then out->help or out->version is set and
   nothing else matters. Texts point into argv. ERR_USAGE. */
MUST_CHECK bool options_parse(const Command *command, int argc, char **argv, Arena *arena, Settings *out, Error *e);

#endif
