/* Lists of files are often made by other programs, with names that hold anything: so a line is a
   name, blanks and '#' included, and where there is a NUL in the list, NUL alone separates. */
#include "app/listfile.h"

#include <string.h>

#include "base/text.h"

enum { LIST_MAX = 1 << 30 };

bool listfile_read(const char *path, Arena *arena, TextList *out, Error *e) {
    Text list;
    if (!text_read_raw(path, LIST_MAX, arena, &list, e)) return false;
    char separator = memchr(list.data, 0, list.size) ? 0 : '\n';
    for (size_t at = 0; at < list.size;) {
        const char *name = list.data + at, *end = memchr(name, separator, list.size - at);
        size_t n = end ? (size_t)(end - name) : list.size - at, used = n;
        if (separator && n && name[n - 1] == '\r') used--;
        const char *copy = used ? arena_text(arena, name, used, e) : NULL;
        if (used && (!copy || !settings_append(out, copy, arena, e))) return false;
        at += n + 1;
    }
    return true;
}
