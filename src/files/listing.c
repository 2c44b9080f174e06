/* Names are sorted, since file systems list them in any order. */
#include "files/listing.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

static int by_bytes(const void *a, const void *b) { return strcmp(*(const char *const *)a, *(const char *const *)b); }

static bool add_name(Listing *list, int *capacity, const char *name, Arena *arena, Error *e) {
    const char **more = ARENA_GROW(arena, const char *, list->name, list->count, capacity, e);
    if (!more) return false;
    list->name = more;
    list->name[list->count] = arena_text(arena, name, strlen(name), e);
    return list->name[list->count++] != NULL;
}

bool listing_read(const char *folder, Arena *arena, Listing *out, Error *e) {
    *out = (Listing){0};
    DIR *open = opendir(folder[0] ? folder : ".");
    if (!open) return error_set(e, ERR_INPUT, "cannot open the folder '%s': %s", folder, strerror(errno));
    bool good = true;
    int capacity = 0;
    for (struct dirent *entry; good && (errno = 0, entry = readdir(open));)
        if (entry->d_name[0] != '.') good = add_name(out, &capacity, entry->d_name, arena, e);
    if (good && errno) good = error_set(e, ERR_INPUT, "cannot list the folder '%s': %s", folder, strerror(errno));
    closedir(open);
    if (good && out->count) qsort(out->name, (size_t)out->count, sizeof *out->name, by_bytes);
    return good;
}

char *listing_path(const char *folder, const char *name, Arena *arena, Error *e) {
    size_t n = strlen(folder), size = n + strlen(name) + 2;
    char *path = ARENA_NEW(arena, char, size, e);
    if (path) snprintf(path, size, "%s%s%s", folder, n && folder[n - 1] != '/' ? "/" : "", name);
    return path;
}
