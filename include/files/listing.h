/* What is in a folder. */
#ifndef FILES_LISTING_H
#define FILES_LISTING_H

#include "base/arena.h"

typedef struct {
    int count;
    const char **name; /* in the order of their bytes, hidden ones left out */
} Listing;

/* "" is the current folder. ERR_INPUT. */
MUST_CHECK bool listing_read(const char *folder, Arena *arena, Listing *out, Error *e);

/* folder/name, without a second slash; only the name where the folder is "". */
char *listing_path(const char *folder, const char *name, Arena *arena, Error *e);

#endif
