/* The commands. Each does its work and returns the exit code; an error that is left in *e is
   printed by main, others were printed where they happened. */
#ifndef APP_COMMANDS_H
#define APP_COMMANDS_H

#include "app/settings.h"

/* A word after `kitsuke`. */
typedef struct {
    const char *name;
    CommandBit bit;
    const char *summary;  /* one line, lower case */
    const char *operands; /* behind the name in the usage line */
    const char *example;  /* lines that can be typed as they stand */
    ErrorKind (*run)(const Settings *settings, Error *e);
} Command;

ErrorKind cmd_dress(const Settings *settings, Error *e);
ErrorKind cmd_compare(const Settings *settings, Error *e);
ErrorKind cmd_inspect(const Settings *settings, Error *e);
ErrorKind cmd_walk(const Settings *settings, Error *e);
ErrorKind cmd_verify(const Settings *settings, Error *e);
ErrorKind cmd_draw(const Settings *settings, Error *e);

#endif
