/* Lists of files are often made by other programs, with names that hold anything: so a line is a
   name, blanks and '#' included, and where there is a NUL in the list, NUL alone separates. */
#include "app/listfile.h"

#include <errno.h>
#include <string.h>

enum { LIST_START = 1 << 16, LIST_MAX = 1 << 30 };

/* The whole file; *size bytes of it. */
static char *read_all(FILE *f, size_t *size, Arena *arena, Error *e) {
    size_t capacity = LIST_START, n = 0;
    char *data = ARENA_NEW(arena, char, capacity, e);
    while (data && !feof(f) && !ferror(f)) {
        if (n == capacity) {
            if (capacity >= LIST_MAX) return error_set(e, ERR_INPUT, "the list of files is larger than 1 GB"), NULL;
            char *more = ARENA_NEW(arena, char, 2 * capacity, e);
            if (!more) return NULL;
            memcpy(more, data, n);
            data = more;
            capacity *= 2;
        }
        n += fread(data + n, 1, capacity - n, f);
    }
    *size = n;
    return data;
}

static bool split(char *data, size_t size, Arena *arena, TextList *out, Error *e) {
    char separator = memchr(data, 0, size) ? 0 : '\n';
    for (size_t at = 0; at < size;) {
        char *end = memchr(data + at, separator, size - at);
        size_t n = end ? (size_t)(end - data) - at : size - at, used = n;
        if (separator && n && data[at + n - 1] == '\r') used--;
        const char *path = used ? arena_text(arena, data + at, used, e) : NULL;
        if (used && (!path || !settings_append(out, path, arena, e))) return false;
        at += n + 1;
    }
    return true;
}

bool listfile_read(const char *path, Arena *arena, TextList *out, Error *e) {
    bool is_stdin = strcmp(path, "-") == 0;
    size_t size = 0;
    FILE *f = is_stdin ? stdin : fopen(path, "rb");
    if (!f) return error_set(e, ERR_INPUT, "cannot open '%s': %s", path, strerror(errno));
    errno = 0;
    char *data = read_all(f, &size, arena, e);
    int code = ferror(f) ? (errno ? errno : EIO) : 0;
    if (!is_stdin) fclose(f);
    if (data && code) return error_set(e, ERR_INPUT, "cannot read '%s': %s", path, strerror(code));
    return data && split(data, size, arena, out, e);
}
