/* A short name for a long content: 64 bits by which files and settings are told apart from their
   older selves. Not meant against somebody who forges one. */
#ifndef BASE_DIGEST_H
#define BASE_DIGEST_H

#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

typedef uint64_t Digest;

Digest digest_start(void);
void digest_add(Digest *d, const void *data, size_t size);
/* A text with its end, so that "ab", "c" differs from "a", "bc". */
void digest_text(Digest *d, const char *text);
/* All bytes of a file, and how many. ERR_INPUT. */
MUST_CHECK bool digest_file(Digest *d, const char *path, Error *e);

#endif
