/* One way to fail: the first error is kept with its place in the input, and printed by main. */
#include "base/error.h"

#include <stdarg.h>
#include <string.h>

void error_clean(char *out, size_t n, const char *text) {
    size_t i = 0;
    for (; text[i] && i + 1 < n; i++) {
        unsigned char c = (unsigned char)text[i];
        out[i] = c < 32 || c == 127 ? '?' : (char)c;
    }
    out[i] = 0;
}

/* Keeps a window of the line round the column, tabs and control bytes made visible. */
static void keep_source(Error *e, Place place) {
    if (!place.source || place.source_length <= 0) return;
    int length = place.source_length, at = place.column > 0 ? place.column - 1 : 0;
    if (at > length) at = length; /* the line was longer when it was read */
    int room = (int)sizeof e->source - 1, from = 0;
    if (length > room && at > room / 2) from = at - room / 2;
    int n = length - from < room ? length - from : room;
    for (int i = 0; i < n; i++) {
        unsigned char c = (unsigned char)place.source[from + i];
        e->source[i] = (char)(c == '\t' ? ' ' : c < 32 || c == 127 ? '?' : c);
    }
    e->source[n] = 0;
    e->caret = at - from;
    if (e->caret > n) e->caret = n;
}

static void fill(Error *e, ErrorKind kind, Place place, const char *fmt, va_list args) {
    char raw[sizeof e->text];
    memset(e, 0, sizeof *e);
    e->kind = kind;
    vsnprintf(raw, sizeof raw, fmt, args);
    error_clean(e->text, sizeof e->text, raw);
    if (place.file) error_clean(e->file, sizeof e->file, place.file);
    e->line = place.line;
    e->column = place.column;
    keep_source(e, place);
}

bool error_set(Error *e, ErrorKind kind, const char *fmt, ...) {
    if (e->kind != ERR_NONE) return false;
    va_list args;
    va_start(args, fmt);
    fill(e, kind, (Place){0}, fmt, args);
    va_end(args);
    return false;
}

bool error_at(Error *e, ErrorKind kind, Place place, const char *fmt, ...) {
    if (e->kind != ERR_NONE) return false;
    va_list args;
    va_start(args, fmt);
    fill(e, kind, place, fmt, args);
    va_end(args);
    return false;
}

static void print_place(const Error *e, FILE *out) {
    fprintf(out, "%s:", e->file);
    if (e->line > 0) fprintf(out, "%d:", e->line);
    if (e->line > 0 && e->column > 0) fprintf(out, "%d:", e->column);
    fputc(' ', out);
}

static void print_source(const Error *e, FILE *out) {
    if (e->line > 0 && e->source[0]) fprintf(out, "  %s\n  %*s^\n", e->source, e->caret, "");
}

void error_print(const Error *e, FILE *out) {
    if (!e->file[0]) {
        fprintf(out, "kitsuke: %s\n", e->text);
        return;
    }
    print_place(e, out);
    fprintf(out, "error: %s\n", e->text);
    print_source(e, out);
}

void notes_add(Notes *notes, Place place, const char *fmt, ...) {
    if (!notes) return;
    if (notes->count < NOTES_MAX) {
        va_list args;
        va_start(args, fmt);
        fill(&notes->note[notes->count], ERR_NONE, place, fmt, args);
        va_end(args);
    }
    notes->count++;
}

void notes_print(const Notes *notes, const char *name, FILE *out) {
    char shown[sizeof notes->note[0].file];
    error_clean(shown, sizeof shown, name);
    for (int i = 0; i < notes->count && i < NOTES_MAX; i++) {
        const Error *n = &notes->note[i];
        if (n->file[0]) print_place(n, out);
        else fprintf(out, "%s: ", shown);
        fprintf(out, "warning: %s\n", n->text);
        print_source(n, out);
    }
    if (notes->count > NOTES_MAX) fprintf(out, "%s: warning: %d more warnings\n", shown, notes->count - NOTES_MAX);
}
