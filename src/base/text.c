/* Text files read whole, cut into lines of words; every word knows its place. */
#include "base/text.h"

#include <errno.h>
#include <limits.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#define BYTE_ORDER_MARK "\xEF\xBB\xBF"

/* Reads all of f, growing by doubling since pipes have no size. */
static char *read_all(FILE *f, const char *path, size_t limit, size_t *size, Error *e) {
    size_t capacity = 1 << 14, n = 0;
    char *data = malloc(capacity);
    while (data) {
        n += fread(data + n, 1, capacity - 1 - n, f);
        if (ferror(f)) {
            error_set(e, ERR_INPUT, "cannot read '%s': %s", path, strerror(errno));
            break;
        }
        if (n > limit) {
            error_set(e, ERR_INPUT, "'%s' is larger than %zu bytes", path, limit);
            break;
        }
        if (n < capacity - 1) {
            data[n] = 0;
            *size = n;
            return data;
        }
        char *more = realloc(data, capacity *= 2);
        if (!more) break;
        data = more;
    }
    free(data);
    error_set(e, ERR_INTERNAL, "out of memory while reading '%s'", path);
    return NULL;
}

bool text_read_raw(const char *path, size_t limit, Arena *arena, Text *out, Error *e) {
    bool standard = strcmp(path, "-") == 0;
    FILE *f = standard ? stdin : fopen(path, "rb");
    if (!f) return error_set(e, ERR_INPUT, "cannot open '%s': %s", path, strerror(errno));
    struct stat info;
    if (!standard && fstat(fileno(f), &info) == 0 && S_ISDIR(info.st_mode)) {
        fclose(f);
        return error_set(e, ERR_INPUT, "cannot read '%s': it is a directory", path);
    }
    size_t size = 0;
    char *data = read_all(f, path, limit, &size, e);
    if (!standard) fclose(f);
    if (!data) return false;
    *out = (Text){standard ? "<stdin>" : path, arena_text(arena, data, size, e), size};
    free(data);
    if (out->data && strncmp(out->data, BYTE_ORDER_MARK, sizeof BYTE_ORDER_MARK - 1) == 0) {
        out->data += sizeof BYTE_ORDER_MARK - 1;
        out->size -= sizeof BYTE_ORDER_MARK - 1;
    }
    return out->data != NULL;
}

bool text_read(const char *path, size_t limit, Arena *arena, Text *out, Error *e) {
    if (!text_read_raw(path, limit, arena, out, e)) return false;
    return !memchr(out->data, 0, out->size) ||
           error_set(e, ERR_INPUT, "'%s' is a binary file or UTF-16, not plain text", path);
}

bool text_is_kept(const char *path) {
    struct stat info;
    return strcmp(path, "-") != 0 && (stat(path, &info) != 0 || S_ISREG(info.st_mode) || S_ISDIR(info.st_mode));
}

bool text_first_word(const char *path, char word[TEXT_FIRST], Error *e) {
    char mark[sizeof BYTE_ORDER_MARK] = "";
    word[0] = 0;
    if (!text_is_kept(path)) return true;
    FILE *f = fopen(path, "r");
    if (!f) return error_set(e, ERR_INPUT, "cannot open '%s': %s", path, strerror(errno));
    if (!fgets(mark, sizeof mark, f) || strcmp(mark, BYTE_ORDER_MARK) != 0) rewind(f);
    while (fscanf(f, "%15s", word) == 1 && word[0] == '#') {
        word[0] = 0;
        for (int c; (c = fgetc(f)) != EOF && !text_is_end((char)c);) continue;
    }
    fclose(f);
    return true;
}

Cursor text_start(const Text *text) { return (Cursor){text, text->data, text->data, 1}; }

Place text_place(const Cursor *c, const char *at) {
    const char *end = c->line_start;
    while (!text_is_end(*end)) end++;
    long column = at - c->line_start + 1;
    return (Place){c->text->name, c->line, (int)(column < INT_MAX ? column : INT_MAX), c->line_start,
                   (int)(end - c->line_start < INT_MAX ? end - c->line_start : INT_MAX)};
}

static void next_line(Cursor *c) {
    while (!text_is_end(*c->at)) c->at++;
    if (*c->at == '\r' && c->at[1] == '\n') c->at++;
    if (*c->at) c->at++;
    c->line_start = c->at;
    c->line++;
}

bool text_line(Cursor *c, Line *line, Error *e) {
    while (*c->at) {
        line->at = *c;
        line->count = 0;
        while (!text_is_end(*c->at)) {
            if (*c->at == ' ' || *c->at == '\t') {
                c->at++;
                continue;
            }
            if (*c->at == '#') break;
            if (line->count == TEXT_WORDS_MAX)
                return error_at(e, ERR_INPUT, text_place(c, c->at), "more than %d words in a line", TEXT_WORDS_MAX);
            const char *start = c->at;
            while (!text_is_end(*c->at) && *c->at != ' ' && *c->at != '\t') c->at++;
            line->word[line->count] = start;
            line->length[line->count++] = (int)(c->at - start);
        }
        next_line(c);
        if (line->count) return true;
    }
    return false;
}

bool text_error(const Line *line, int i, Error *e, const char *fmt, ...) {
    const char *at = i < line->count ? line->word[i]
                     : line->count   ? line->word[line->count - 1] + line->length[line->count - 1]
                                     : line->at.at;
    char text[320];
    va_list args;
    va_start(args, fmt);
    vsnprintf(text, sizeof text, fmt, args);
    va_end(args);
    return error_at(e, ERR_INPUT, text_place(&line->at, at), "%s", text);
}

bool text_is(const Line *line, int i, const char *word) {
    return i >= 0 && i < line->count && (size_t)line->length[i] == strlen(word) &&
           memcmp(line->word[i], word, strlen(word)) == 0;
}

/* strtod reads in the C locale as long as nobody calls setlocale, and nobody does. What it
   takes beyond plain decimals (hex, nan, inf) is kept out by checking the bytes first. */
const char *text_number(const char *s, const char *end, double *out) {
    const char *p = s;
    int digits = 0;
    if (p < end && (*p == '+' || *p == '-')) p++;
    while (p < end && *p >= '0' && *p <= '9') p++, digits++;
    if (p < end && *p == '.') {
        p++;
        while (p < end && *p >= '0' && *p <= '9') p++, digits++;
    }
    if (!digits) return NULL;
    if (p < end && (*p == 'e' || *p == 'E')) {
        const char *q = p + 1;
        if (q < end && (*q == '+' || *q == '-')) q++;
        if (q < end && *q >= '0' && *q <= '9') {
            while (q < end && *q >= '0' && *q <= '9') q++;
            p = q;
        }
    }
    char small[64];
    size_t n = (size_t)(p - s);
    if (n < sizeof small) { /* a copy stops strtod at our end, not its own */
        memcpy(small, s, n);
        small[n] = 0;
        *out = strtod(small, NULL);
    } else {
        *out = strtod(s, NULL);
    }
    return p;
}

bool text_real(const Line *line, int i, double *out, Error *e) {
    if (i >= line->count) return text_error(line, i, e, "expected a number, found the end of the line");
    const char *s = line->word[i], *end = s + line->length[i];
    const char *stop = text_number(s, end, out);
    if (stop != end)
        return text_error(line, i, e, "expected a number, found '%.*s'", error_shown(line->length[i]), s);
    *out += 0.0; /* -0 is 0 */
    return (*out >= -1e12 && *out <= 1e12) || text_error(line, i, e, "number out of range");
}

bool text_int(const Line *line, int i, int low, int high, int *out, Error *e) {
    double x = 0;
    if (!text_real(line, i, &x, e)) return false;
    if (x < low || x > high || x != (double)(int)x)
        return text_error(line, i, e, "expected a whole number from %d to %d", low, high);
    *out = (int)x;
    return true;
}

bool text_word(const Line *line, int i, char *out, size_t n, Error *e) {
    if (i >= line->count) return text_error(line, i, e, "expected a name, found the end of the line");
    if ((size_t)line->length[i] >= n) return text_error(line, i, e, "name longer than %zu bytes", n - 1);
    memcpy(out, line->word[i], (size_t)line->length[i]);
    out[line->length[i]] = 0;
    return true;
}

const char *text_shortest(double x, char out[TEXT_SHORTEST]) {
    for (int digits = 6; digits <= 17; digits++) {
        snprintf(out, TEXT_SHORTEST, "%.*g", digits, x);
        if (strtod(out, NULL) == x) break;
    }
    return out;
}

bool text_ends_in(const char *name, const char *ending) {
    size_t n = strlen(name), k = strlen(ending);
    return n > k && strcasecmp(name + n - k, ending) == 0;
}

/* Edit distance, capped at 9. */
static int distance(const char *a, const char *b) {
    enum { MOST = 40 };
    int row[MOST + 1], la = (int)strlen(a), lb = (int)strlen(b);
    if (la > MOST || lb > MOST) return 9;
    for (int j = 0; j <= lb; j++) row[j] = j;
    for (int i = 1; i <= la; i++) {
        int corner = row[0];
        row[0] = i;
        for (int j = 1; j <= lb; j++) {
            int change = corner + (a[i - 1] != b[j - 1]);
            corner = row[j];
            int best = row[j] < row[j - 1] ? row[j] + 1 : row[j - 1] + 1;
            row[j] = change < best ? change : best;
        }
    }
    return row[lb] < 9 ? row[lb] : 9;
}

/* One letter in four may be wrong, and one more: else any short word would do. A beginning of a
   name counts as near, however much is missing. */
void nearest_try(Nearest *n, const char *candidate) {
    int length = (int)strlen(n->word), most = length / 4 + 1;
    bool beginning = length >= 3 && strncmp(candidate, n->word, (size_t)length) == 0;
    int d = beginning ? 1 : distance(n->word, candidate);
    if (d > most || (n->best && d >= n->distance)) return;
    n->best = candidate;
    n->distance = d;
}

bool nearest_error(const Nearest *n, const char *what, Place place, Error *e) {
    if (!n->best) return error_at(e, ERR_INPUT, place, "unknown %s '%s'", what, n->word);
    return error_at(e, ERR_INPUT, place, "unknown %s '%s'; did you mean '%s'?", what, n->word, n->best);
}
