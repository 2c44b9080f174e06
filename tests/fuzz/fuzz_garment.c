/* Whatever the bytes: a garment, or one error with a reason. And a garment that was read can be
   written, and what was written is read and written again with the same bytes. */
#include "garment/garment.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static Garment garment; /* large */

static bool parse(const char *bytes, size_t size) {
    Arena arena = {0};
    Error e = {0};
    const char *copy = arena_text(&arena, bytes, size, &e);
    Text text = {"fuzz", copy, size};
    bool good = copy && garment_parse(&text, &garment, &e);
    if (!good && (e.kind != ERR_INPUT || !e.text[0] || e.line < 1)) abort();
    arena_free(&arena);
    return good;
}

static char *write_again(void) {
    char *bytes = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&bytes, &size);
    if (!out || !garment_write(&garment, out)) abort();
    fclose(out);
    return bytes;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (memchr(data, 0, size)) return 0; /* text_read keeps binary files out */
    if (!parse((const char *)data, size)) return 0;
    char *once = write_again();
    if (!parse(once, strlen(once))) abort();
    char *twice = write_again();
    if (strcmp(once, twice) != 0) abort();
    free(once);
    free(twice);
    return 0;
}
