/* A window that slides over a file. Every reader of motions stands on this: it never holds
   more than 64 kB of the text, yet can say `file:line:column` and show the line, since it
   goes back for the line when something is wrong. */
#include "motion/stream.h"

#include <errno.h>
#include <limits.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "base/text.h"

/* Keeps what is not read yet and fills up the rest of the window. */
static void fill(Stream *s) {
    size_t keep = (size_t)(s->end - s->at);
    s->offset += s->at - s->data;
    memmove(s->data, s->at, keep);
    while (keep < STREAM_SIZE && !s->last) {
        ssize_t n = pread(s->fd, s->data + keep, STREAM_SIZE - keep, (off_t)(s->offset + (long long)keep));
        if (n > 0) keep += (size_t)n;
        else if (n == 0) s->last = true;
        else if (errno != EINTR) s->failure = errno, s->last = true;
    }
    s->at = s->data;
    s->end = s->data + keep;
    s->data[keep] = 0;
}

static void look(Stream *s) {
    if (s->end - s->at < STREAM_LOOK && !s->last) fill(s);
}

Mark stream_mark(const Stream *s) {
    return (Mark){s->offset + (s->at - s->data), s->line_start, s->line};
}

void stream_seek(Stream *s, Mark mark) {
    s->line = mark.line;
    s->line_start = mark.line_start;
    if (mark.offset >= s->offset && mark.offset <= s->offset + (s->end - s->data)) {
        s->at = s->data + (mark.offset - s->offset);
        return;
    }
    s->at = s->end = s->data;
    s->offset = mark.offset;
    s->last = false;
    fill(s);
}

bool stream_open(Stream *s, int fd, const char *name, Arena *arena, Error *e) {
    *s = (Stream){.name = name, .fd = fd, .line = 1};
    s->data = ARENA_NEW(arena, char, STREAM_SIZE + 1, e);
    if (!s->data) return false;
    s->at = s->end = s->data;
    fill(s);
    if (s->end - s->at >= 3 && memcmp(s->at, "\xEF\xBB\xBF", 3) == 0) s->at += 3, s->line_start = 3;
    return stream_sound(s, e);
}

bool stream_sound(const Stream *s, Error *e) {
    if (!s->failure) return true;
    return error_set(e, ERR_INPUT, "cannot read '%s': %s", s->name, strerror(s->failure));
}

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
static bool is_break(char c) { return c == '\n' || c == '\r'; }

/* NUL ends words too: it is the end of the window or a byte that no text has. */
static bool ends_word(char c) { return is_blank(c) || is_break(c) || c == 0; }

static void take_break(Stream *s) {
    look(s); /* so that CR and LF are seen together */
    s->at += s->at[0] == '\r' && s->at[1] == '\n' ? 2 : 1;
    s->line_start = s->offset + (s->at - s->data);
    if (s->line < INT_MAX) s->line++;
}

bool stream_ended(const Stream *s) { return s->last && s->at == s->end; }

bool stream_space(Stream *s) {
    bool broken = false;
    for (;;) {
        if (is_blank(*s->at)) s->at++;
        else if (is_break(*s->at)) take_break(s), broken = true;
        else if (s->at == s->end && !s->last) fill(s);
        else break;
    }
    look(s);
    return broken;
}

bool stream_blanks(Stream *s) {
    for (;;) {
        if (is_blank(*s->at)) s->at++;
        else if (s->at == s->end && !s->last) fill(s);
        else break;
    }
    look(s);
    return !is_break(*s->at) && !stream_ended(s);
}

void stream_skip_line(Stream *s) {
    for (;;) {
        if (is_break(*s->at)) break;
        if (s->at < s->end) s->at++;
        else if (s->last) return;
        else fill(s);
    }
    take_break(s);
}

Word stream_peek(Stream *s) {
    bool start = s->line_start == s->offset + (s->at - s->data);
    bool first = stream_space(s) || start;
    const char *p = s->at;
    while (p < s->end && p - s->at < STREAM_LOOK && !ends_word(*p)) p++;
    if (p == s->at && p < s->end) p++; /* a NUL within the text is a word that fits nothing */
    return (Word){s->at, (int)(p - s->at), first};
}

Word stream_word(Stream *s) {
    Word w = stream_peek(s);
    s->at += w.length;
    return w;
}

bool word_is(Word w, const char *text) {
    return strlen(text) == (size_t)w.length && strncasecmp(w.start, text, (size_t)w.length) == 0;
}

/* Numbers: an integer below 2^53 times or divided by a power of ten up to 10^22 is one
   operation on two exact doubles, hence correctly rounded. The rare rest goes to strtod. */
static const double power_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
enum { POWER_MAX = 22, DIGITS_MAX = 18 };

static inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

/* Appends digits to *mantissa; it wraps beyond 19 of them, which the caller sees by their count. */
static inline const char *take_digits(const char *p, uint64_t *mantissa) {
    uint64_t m = *mantissa;
    while (is_digit(*p)) m = m * 10 + (uint64_t)(*p++ - '0');
    *mantissa = m;
    return p;
}

/* Returns the first byte behind the number, or NULL if there is none. */
static inline const char *parse(const char *s, const char *end, double *out) {
    const char *p = s + (*s == '-' || *s == '+'), *whole = p;
    uint64_t mantissa = 0;
    p = take_digits(p, &mantissa);
    long digits = p - whole, fraction = 0;
    if (*p == '.') {
        const char *point = p++;
        p = take_digits(p, &mantissa);
        fraction = p - point - 1;
        digits += fraction;
    }
    if (digits == 0) return NULL;
    long exponent = -fraction;
    if (*p == 'e' || *p == 'E') {
        const char *q = p + 1 + (p[1] == '-' || p[1] == '+');
        if (is_digit(*q)) {
            long n = 0;
            for (; is_digit(*q); q++) n = n < 100000 ? n * 10 + (*q - '0') : n;
            exponent += p[1] == '-' ? -n : n;
            p = q;
        }
    }
    if (digits > DIGITS_MAX || mantissa >> 53 || exponent < -POWER_MAX || exponent > POWER_MAX)
        return text_number(s, end, out);
    double v = (double)mantissa;
    v = exponent < 0 ? v / power_of_ten[-exponent] : v * power_of_ten[exponent];
    *out = *s == '-' ? -v : v;
    return p;
}

/* Is the word a number's beginning that the end of the file has cut? */
static bool is_cut(const Stream *s, Word w) {
    if (!s->last || w.start + w.length != s->end) return false;
    for (int i = 0; i < w.length; i++)
        if (!w.start[i] || !strchr("0123456789+-.eE", w.start[i])) return false;
    return true;
}

/* A word that is no plain number: what is it? */
static NumberResult diagnose(Stream *s) {
    Word w = stream_peek(s);
    if (is_cut(s, w)) return NUMBER_CUT;
    const char *p = w.start + (*w.start == '-' || *w.start == '+');
    if (strncasecmp(p, "nan", 3) == 0 || strncasecmp(p, "inf", 3) == 0) return NUMBER_INFINITE;
    while (is_digit(*p)) p++;
    if (strncmp(p, ".#", 2) == 0) return NUMBER_INFINITE; /* 1.#QNAN, as an old C library prints */
    while (is_digit(*p) || *p == '.') p++;
    return *p == ',' && p > w.start && is_digit(p[-1]) ? NUMBER_COMMA : NUMBER_BAD;
}

NumberResult stream_number(Stream *s, double *out) {
    if (*s->at == ' ') s->at++;
    if ((unsigned char)*s->at <= ' ' || s->end - s->at < STREAM_LOOK) stream_space(s);
    if (stream_ended(s)) return NUMBER_END;
    const char *p = parse(s->at, s->end, out);
    if (!p || p - s->at >= STREAM_LOOK) return diagnose(s);
    bool glued = *p == '-' || *p == '+';
    if (!glued && !ends_word(*p) && *p != '{' && *p != '}') return diagnose(s);
    if (!(*out >= -1e12 && *out <= 1e12)) return NUMBER_RANGE;
    s->at = p;
    return glued ? NUMBER_GLUED : NUMBER_OK;
}

bool stream_refuse(Stream *s, NumberResult r, const char *what, Error *e) {
    Word w = stream_peek(s);
    int n = error_shown(w.length);
    if (!stream_sound(s, e)) return false;
    switch (r) {
    case NUMBER_END: return stream_error(s, e, "the file ends before %s", what);
    case NUMBER_COMMA:
        return stream_error(s, e, "%s: comma in '%.*s': decimals have a point, and blanks between them", what, n,
                            w.start);
    case NUMBER_INFINITE: return stream_error(s, e, "%s is '%.*s', not a finite number", what, n, w.start);
    case NUMBER_RANGE: return stream_error(s, e, "%s is '%.*s', out of range", what, n, w.start);
    default: return stream_error(s, e, "%s: expected a number, found '%.*s'", what, n, w.start);
    }
}

/* The place of `at`. The window goes back to the start of the line, so that it can be shown;
   a line too long for the window stays unshown. */
static Place place(Stream *s) {
    Mark here = stream_mark(s);
    long long column = here.offset - here.line_start;
    Place where = {s->name, here.line, column < INT_MAX ? (int)column + 1 : 0, NULL, 0};
    if (column > STREAM_SIZE - STREAM_LOOK) return where;
    stream_seek(s, (Mark){here.line_start, here.line_start, here.line});
    look(s);
    const char *end = s->at;
    while (end < s->end && !is_break(*end)) end++;
    where.source = s->at;
    where.source_length = (int)(end - s->at);
    s->at += column <= s->end - s->at ? column : 0;
    return where;
}

bool stream_error(Stream *s, Error *e, const char *fmt, ...) {
    char text[sizeof e->text];
    va_list args;
    va_start(args, fmt);
    vsnprintf(text, sizeof text, fmt, args);
    va_end(args);
    return error_at(e, ERR_INPUT, place(s), "%s", text);
}

void stream_note(Stream *s, Notes *notes, const char *fmt, ...) {
    char text[sizeof notes->note[0].text];
    va_list args;
    va_start(args, fmt);
    vsnprintf(text, sizeof text, fmt, args);
    va_end(args);
    notes_add(notes, place(s), "%s", text);
}
