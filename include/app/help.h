/* Help pages, made from the tables of commands and options. */
#ifndef APP_HELP_H
#define APP_HELP_H

#include "app/commands.h"

/* The page of one command: usage, example, options by group with range and default. */
void help_command(const Command *command, FILE *out);

/* The page of the program. commands ends with a NULL name; the first is the main one. */
void help_program(const Command *commands, FILE *out);

/* Purpose, one example and where to read on: the answer to a call without arguments. */
void help_hint(const Command *commands, FILE *out);

#endif
