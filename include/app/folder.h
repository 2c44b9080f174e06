/* The folder of one motion, below the output folder. */
#ifndef APP_FOLDER_H
#define APP_FOLDER_H

#include "base/error.h"

/* Does the folder hold any file? Folders in it do not count: they are other motions'. True for one that is there and
   cannot be read. */
bool folder_has_files(const char *path);

/* Removes what an earlier run wrote (its record, stats.csv, NAME.0001.obj and .drc, temporaries of
   these) and nothing else. A folder that is not there is fine. ERR_OUTPUT. */
MUST_CHECK bool folder_clear(const char *path, Error *e);

#endif
