/* A pattern is what stands before the number and what stands behind it; a file belongs to it if
   only digits are between. */
#include "files/sequence.h"

#include <stdlib.h>
#include <string.h>

#include "files/listing.h"

enum { NUMBER_MOST = 999999999, PLAIN_DIGITS = 4 };

typedef struct {
    const char *text;                       /* as a whole */
    const char *folder;                     /* may be empty */
    const char *before, *behind;            /* the number, in the file's name */
    size_t before_length, behind_length;
} Pattern;

/* The length of a mark at s: `*`, `#...` or `%d`, `%4d`, `%04d`; 0 where there is none. */
static size_t mark_length(const char *s) {
    if (*s == '*') return 1;
    if (*s == '#') return strspn(s, "#");
    size_t n = *s == '%' ? 1 + strspn(s + 1, "0123456789") : 0;
    return n && s[n] == 'd' ? n + 1 : 0;
}

/* False where the name has no mark. */
static bool part_pattern(const char *file, Pattern *p) {
    for (const char *s = file; *s; s++) {
        size_t n = mark_length(s);
        if (!n) continue;
        p->before = file;
        p->before_length = (size_t)(s - file);
        p->behind = s + n;
        p->behind_length = strlen(p->behind);
        return true;
    }
    return false;
}

/* The number in a name that fits; -1 where it does not. */
static int number_in(const char *name, const Pattern *p) {
    size_t n = strlen(name);
    if (n <= p->before_length + p->behind_length || memcmp(name, p->before, p->before_length) != 0) return -1;
    size_t digits = n - p->before_length - p->behind_length;
    const char *s = name + p->before_length;
    if (memcmp(s + digits, p->behind, p->behind_length) != 0) return -1;
    int number = 0;
    for (size_t i = 0; i < digits; i++) {
        if (s[i] < '0' || s[i] > '9' || number > NUMBER_MOST / 10) return -1;
        number = 10 * number + (s[i] - '0');
    }
    return number;
}

static int by_number(const void *a, const void *b) {
    const SequenceFile *f = a, *g = b;
    return f->number != g->number ? (f->number < g->number ? -1 : 1) : strcmp(f->path, g->path);
}

static bool collect(const Pattern *p, const Listing *names, Arena *arena, Sequence *out, Error *e) {
    size_t length = p->before_length;
    while (length > 0 && strchr("._- ", p->before[length - 1])) length--;
    *out = (Sequence){.pattern = p->text, .name = arena_text(arena, p->before, length, e)};
    for (int i = 0; i < names->count; i++) out->count += number_in(names->name[i], p) >= 0;
    out->file = ARENA_NEW(arena, SequenceFile, out->count, e);
    if (!out->name || !out->file) return false;
    for (int i = 0, n = 0; i < names->count; i++) {
        int number = number_in(names->name[i], p);
        if (number < 0) continue;
        out->file[n++] = (SequenceFile){number, listing_path(p->folder, names->name[i], arena, e)};
        if (!out->file[n - 1].path) return false;
    }
    if (out->count) qsort(out->file, (size_t)out->count, sizeof *out->file, by_number);
    for (int i = 1; i < out->count; i++)
        if (out->file[i].number == out->file[i - 1].number)
            return error_set(e, ERR_INPUT, "'%s' and '%s' have the same number", out->file[i - 1].path,
                             out->file[i].path);
    return true;
}

bool sequence_find(const char *pattern, Arena *arena, Sequence *out, Error *e) {
    const char *slash = strrchr(pattern, '/'), *file = slash ? slash + 1 : pattern;
    Pattern p = {.text = pattern, .folder = arena_text(arena, pattern, (size_t)(file - pattern), e)};
    Listing names;
    if (!p.folder) return false;
    if (!part_pattern(file, &p)) {
        const char *dot = strchr(file, '.');
        size_t length = dot && dot > file ? (size_t)(dot - file) : strlen(file);
        *out = (Sequence){pattern, arena_text(arena, file, length, e), true, 1, ARENA_NEW(arena, SequenceFile, 1, e)};
        if (!out->name || !out->file) return false;
        out->file[0] = (SequenceFile){0, pattern};
        return true;
    }
    if (!listing_read(p.folder, arena, &names, e) || !collect(&p, &names, arena, out, e)) return false;
    return out->count > 0 || error_set(e, ERR_INPUT, "no file is called like '%s'", pattern);
}

/* The length of NAME in NAME.DIGITS.ending; 0 where the name is another. */
static size_t plain_name(const char *name, const char *ending) {
    size_t n = strlen(name), m = strlen(ending), digits = 0;
    if (n < m + 1 || strcmp(name + n - m, ending) != 0 || name[n - m - 1] != '.') return 0;
    for (n -= m + 1; n > 0 && name[n - 1] >= '0' && name[n - 1] <= '9'; n--) digits++;
    return digits >= PLAIN_DIGITS && n > 1 && name[n - 1] == '.' ? n - 1 : 0;
}

/* The pattern of all files NAME.DIGITS.ending beside NAME.0001.ending, n the length of NAME. */
static bool plain_pattern(const char *folder, const char *file, size_t n, Arena *arena, Pattern *out, Error *e) {
    size_t room = strlen(file) + 2;
    char *name = ARENA_NEW(arena, char, room, e);
    if (!name) return false;
    snprintf(name, room, "%.*s.*.%s", (int)n, file, strrchr(file, '.') + 1);
    *out = (Pattern){.folder = folder, .before = name, .before_length = n + 1, .behind = name + n + 2};
    out->behind_length = strlen(out->behind);
    out->text = listing_path(folder, name, arena, e);
    return out->text != NULL;
}

bool sequence_scan(const char *folder, const char *ending, Arena *arena, Sequence **out, int *count, Error *e) {
    Listing names;
    *count = 0;
    if (!listing_read(folder, arena, &names, e)) return false;
    *out = ARENA_NEW(arena, Sequence, names.count, e);
    if (!*out) return false;
    for (int i = 0; i < names.count; i++) {
        size_t n = plain_name(names.name[i], ending);
        bool known = n == 0; /* files of one sequence need not follow each other */
        for (int k = 0; k < *count && !known; k++)
            known = strlen((*out)[k].name) == n && memcmp((*out)[k].name, names.name[i], n) == 0;
        Pattern p;
        if (known) continue;
        if (!plain_pattern(folder, names.name[i], n, arena, &p, e) || !collect(&p, &names, arena, &(*out)[*count], e))
            return false;
        ++*count;
    }
    return true;
}

const char *sequence_path(const Sequence *s, int number) {
    if (s->still) return s->file[0].path;
    for (int low = 0, high = s->count; low < high;) {
        int middle = low + (high - low) / 2;
        if (s->file[middle].number == number) return s->file[middle].path;
        if (s->file[middle].number < number) low = middle + 1;
        else high = middle;
    }
    return NULL;
}
