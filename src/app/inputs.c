/* Which motions there are, and where each one's files go.

   A motion's folder is named by its path below the folder that was named on the command line,
   without its ending. Where two would share a name, both become longer: first by the ending
   (run.bvh, run.amc), then by the whole path as it was given, at last by a number. Every part of
   a name is cleaned, so that no file leads out of the output folder, whatever it is called. */
#include "app/inputs.h"

#include <glob.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "app/record.h"
#include "files/listing.h"

enum { DEPTH_MAX = 64, INPUTS_MAX = 10000000, PART_MAX = 120, PART_KEPT = 100 };

/* How much of its path a motion's name has to show. */
typedef enum { SHORT, WITH_ENDING, WHOLE, WHOLE_WITH_ENDING, NUMBERED } Length;

typedef struct { Input input; const char *below; Length length; } Found; /* below: its path below the named folder */

typedef struct {
    Found *found;
    int count, capacity;
    Arena *arena;
    Error *e;
} Search;

static bool add(Search *s, const char *path, const char *below, bool is_empty) {
    if (s->count == INPUTS_MAX) return error_set(s->e, ERR_USAGE, "more than %d motions", INPUTS_MAX);
    Found *found = ARENA_GROW(s->arena, Found, s->found, s->count, &s->capacity, s->e);
    if (!found) return false;
    s->found = found;
    s->found[s->count++] = (Found){{path, NULL, is_empty}, below, SHORT};
    return true;
}

static bool is_motion_name(const char *name) { return text_ends_in(name, ".bvh") || text_ends_in(name, ".amc"); }

/* Links to files are followed, links to folders are not: they could lead round in a circle. A folder that cannot be
   read stays in the list. */
static bool search_folder(Search *s, const char *path, size_t root, int depth) {
    Listing names;
    Error why = {0};
    if (depth > DEPTH_MAX) return add(s, path, path + root, false);
    if (!listing_read(path, s->arena, &names, &why)) {
        if (why.kind == ERR_INPUT) return add(s, path, path + root, false);
        *s->e = why;
        return false;
    }
    for (int i = 0; i < names.count; i++) {
        struct stat info;
        const char *inside = listing_path(path, names.name[i], s->arena, s->e);
        if (!inside) return false;
        bool good = true, is_folder = lstat(inside, &info) == 0 && S_ISDIR(info.st_mode);
        if (is_folder) good = search_folder(s, inside, root, depth + 1);
        else if (is_motion_name(names.name[i])) good = add(s, inside, inside + root, false);
        if (!good) return false;
    }
    return true;
}

/* The path without "//" and "/./", so that one file has one name. No name stays none: what "$unset" gives a shell is
   not the folder it stands in. */
static char *tidy(const char *path, Arena *arena, Error *e) {
    char *out = arena_text(arena, path, strlen(path), e), *to = out;
    for (const char *at = out; out && *at;) {
        if (at[0] == '.' && at[1] == '/' && (at == out || at[-1] == '/')) at += 2;
        else if (at[0] == '/' && at > out && at[-1] == '/') at++;
        else *to++ = *at++;
    }
    if (out) *to = 0;
    return out && !*out && *path ? arena_text(arena, ".", 1, e) : out;
}

static bool add_file(Search *s, const char *path) {
    const char *slash = strrchr(path, '/');
    return add(s, path, slash ? slash + 1 : path, false);
}

static bool has_pattern(const char *path) { return strpbrk(path, "*?[") != NULL; }

static bool add_operand(Search *s, const char *operand);

/* A pattern that no shell has replaced, because it was quoted or stands in a job file. What it
   matches exists, so this goes no deeper. */
static bool add_matches(Search *s, const char *pattern) {
    glob_t found;
    bool good = true;
    int code = glob(pattern, 0, NULL, &found);
    if (code == GLOB_NOMATCH) return add_file(s, pattern);
    if (code != 0) return error_set(s->e, ERR_INTERNAL, "out of memory for the files '%s'", pattern);
    for (size_t i = 0; good && i < found.gl_pathc; i++) {
        const char *path = arena_text(s->arena, found.gl_pathv[i], strlen(found.gl_pathv[i]), s->e);
        struct stat info;
        if (path && stat(path, &info) != 0) good = add_file(s, path); /* it has just gone */
        else good = path && add_operand(s, path);
    }
    globfree(&found);
    return good;
}

static bool add_operand(Search *s, const char *operand) {
    struct stat info;
    if (strcmp(operand, "-") == 0) return add(s, operand, "stdin", false);
    char *path = tidy(operand, s->arena, s->e);
    if (!path) return false;
    bool is_there = stat(path, &info) == 0;
    if (!is_there && has_pattern(path)) return add_matches(s, path);
    if (!is_there || !S_ISDIR(info.st_mode)) return add_file(s, path);
    int before = s->count;
    size_t n = strlen(path);
    if (!search_folder(s, path, path[n - 1] == '/' ? n : n + 1, 0)) return false;
    return s->count > before || add(s, path, path, true);
}

static uint32_t hash(const char *s, size_t n) { /* FNV-1a */
    uint32_t h = 2166136261u;
    for (size_t i = 0; i < n; i++) h = (h ^ (unsigned char)s[i]) * 16777619u;
    return h;
}

/* One part of a path, made harmless as the name of a file: no separators, control bytes or
   characters that some file system forbids, at most 120 bytes, none of our own endings. */
static char *clean(const char *part, size_t length, Arena *arena, Error *e) {
    static const char *const ours[] = {".obj", ".drc", ".csv", ".tmp", ".lock", RECORD_NAME};
    char *out = ARENA_NEW(arena, char, length + 16, e);
    if (!out) return NULL;
    size_t n = length;
    for (size_t i = 0; i < n; i++) {
        unsigned char c = (unsigned char)part[i];
        out[i] = c < 32 || c == 127 || strchr("/\\:*?\"<>|", c) ? '_' : (char)c;
    }
    if (n > PART_MAX) {
        n = PART_KEPT;
        while (n > 0 && ((unsigned char)out[n] & 0xC0) == 0x80) n--; /* not through a character of UTF-8 */
        n += (size_t)snprintf(out + n, 12, "~%08x", (unsigned)hash(part, length));
    }
    out[n] = 0;
    for (size_t i = 0, k; i < sizeof ours / sizeof ours[0]; i++) {
        k = strlen(ours[i]);
        if (n < k || strcasecmp(out + n - k, ours[i]) != 0) continue;
        memcpy(out + n, "_", 2); /* no folder may stand where a file of ours would */
        break;
    }
    return out;
}

/* The cleaned path: parts that are empty, "." or ".." fall out. */
static const char *clean_path(const char *path, size_t length, int number, Arena *arena, Error *e) {
    char *out = ARENA_NEW(arena, char, 2 * length + 32, e);
    size_t n = 0, k;
    for (size_t at = 0; out && at < length; at += k + 1) {
        const char *slash = memchr(path + at, '/', length - at);
        k = slash ? (size_t)(slash - path) - at : length - at;
        if (k == 0 || (k <= 2 && memcmp(path + at, "..", k) == 0)) continue;
        char *part = clean(path + at, k, arena, e);
        if (!part) return NULL;
        n += (size_t)snprintf(out + n, 2 * length + 32 - n, "%s%s", n ? "/" : "", part);
    }
    if (out && n == 0) n = (size_t)snprintf(out, 32, "motion");
    if (out && number) snprintf(out + n, 2 * length + 32 - n, "~%d", number);
    return out;
}

static bool give_name(Found *f, int number, Arena *arena, Error *e) {
    const char *path = f->length >= WHOLE ? f->input.path : f->below;
    size_t n = strlen(path);
    const char *slash = strrchr(path, '/'), *dot = strrchr(path, '.');
    bool keeps_ending = f->length == WITH_ENDING || f->length >= WHOLE_WITH_ENDING;
    if (!keeps_ending && dot && dot > (slash ? slash + 1 : path)) n = (size_t)(dot - path);
    f->input.name = clean_path(path, n, f->length == NUMBERED ? number : 0, arena, e);
    return f->input.name != NULL;
}

static int by_name(const void *a, const void *b) {
    return strcasecmp((*(Found *const *)a)->input.name, (*(Found *const *)b)->input.name);
}

/* Lengthens every name that is not the only one of its kind, also on a disk that does not tell Walk
   from walk; *changed tells whether there were any. */
static bool lengthen(Found **sorted, Found *found, int n, bool *changed, Arena *arena, Error *e) {
    *changed = false;
    qsort(sorted, (size_t)n, sizeof *sorted, by_name);
    for (int i = 0, j; i < n; i = j) {
        const char *name = sorted[i]->input.name;
        for (j = i + 1; j < n && strcasecmp(sorted[j]->input.name, name) == 0;) j++;
        for (int k = i; j - i > 1 && k < j; k++) {
            *changed = true;
            if (sorted[k]->length < NUMBERED) sorted[k]->length++;
            if (!give_name(sorted[k], (int)(sorted[k] - found) + 1, arena, e)) return false;
        }
    }
    return true;
}

static bool give_names(Search *s) {
    bool changed = true;
    Found **sorted = ARENA_NEW(s->arena, Found *, s->count, s->e);
    if (!sorted) return false;
    for (int i = 0; i < s->count; i++) {
        sorted[i] = &s->found[i];
        if (!give_name(&s->found[i], i + 1, s->arena, s->e)) return false;
    }
    for (int pass = 0; changed && pass <= 2 * NUMBERED; pass++)
        if (!lengthen(sorted, s->found, s->count, &changed, s->arena, s->e)) return false;
    return !changed || error_set(s->e, ERR_USAGE, "no two motions may have the folder '%s'", sorted[0]->input.name);
}

static int by_path(const void *a, const void *b) {
    const Found *x = *(Found *const *)a, *y = *(Found *const *)b;
    int order = strcmp(x->input.path, y->input.path);
    return order ? order : (x > y) - (x < y);
}

/* Keeps the first of equal paths. */
static bool drop_repeated(Search *s) {
    Found **sorted = ARENA_NEW(s->arena, Found *, s->count, s->e);
    bool *drop = ARENA_NEW(s->arena, bool, s->count, s->e);
    if (!sorted || !drop) return false;
    for (int i = 0; i < s->count; i++) sorted[i] = &s->found[i];
    if (s->count) qsort(sorted, (size_t)s->count, sizeof *sorted, by_path);
    for (int i = 1; i < s->count; i++)
        drop[sorted[i] - s->found] = strcmp(sorted[i]->input.path, sorted[i - 1]->input.path) == 0;
    int kept = 0;
    for (int i = 0; i < s->count; i++)
        if (!drop[i]) s->found[kept++] = s->found[i];
    s->count = kept;
    return true;
}

bool inputs_collect(const TextList *operands, Arena *arena, Input **out, int *count, Error *e) {
    Search s = {.arena = arena, .e = e};
    for (int i = 0; i < operands->count; i++)
        if (!add_operand(&s, operands->item[i])) return false;
    if (!drop_repeated(&s) || !give_names(&s)) return false;
    *out = ARENA_NEW(arena, Input, s.count, e);
    *count = s.count;
    for (int i = 0; *out && i < s.count; i++) (*out)[i] = s.found[i].input;
    return *out != NULL;
}
