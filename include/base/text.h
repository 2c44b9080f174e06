/* Reading text: a whole small file with a cursor that knows line and column.
   For job, garment, body and roles files and for the heads of motion files. */
#ifndef BASE_TEXT_H
#define BASE_TEXT_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/error.h"

/* A text in memory. data ends in NUL, which does not count in size. A byte-order mark is
   skipped. Inside, NUL bytes are an error (a binary file). */
typedef struct {
    const char *name; /* for messages */
    const char *data;
    size_t size;
} Text;

/* Reads a file of at most `limit` bytes; "-" is standard input. ERR_INPUT for a missing,
   unreadable, binary or too large file and for a directory. */
MUST_CHECK bool text_read(const char *path, size_t limit, Arena *arena, Text *out, Error *e);

/* The same where NUL bytes may stand inside. */
MUST_CHECK bool text_read_raw(const char *path, size_t limit, Arena *arena, Text *out, Error *e);

/* The first word of a file that is no comment, cut to fit: "garment", "HIERARCHY". Empty for what is no regular file:
   what is read from a pipe is gone for who reads it next. ERR_INPUT if it cannot be opened. */
enum { TEXT_FIRST = 16 };
MUST_CHECK bool text_first_word(const char *path, char word[TEXT_FIRST], Error *e);

/* Can the file be read again, as a pipe cannot? Yes for one that is not there: whoever reads it says so. */
bool text_is_kept(const char *path);

/* A place in a Text. Copy it to go back. */
typedef struct {
    const Text *text;
    const char *at; /* next byte */
    const char *line_start;
    int line; /* from 1 */
} Cursor;

Cursor text_start(const Text *text);

/* The place of `at`, a pointer into the cursor's current line, for error_at. */
Place text_place(const Cursor *c, const char *at);

/* Does the line end here? A Text's last byte is followed by NUL. */
static inline bool text_is_end(char c) { return c == '\n' || c == '\r' || c == 0; }

/* Line-oriented reading (garment, body, job, roles). A line is words separated by blanks,
   a '#' at the start of a word begins a comment; CR, LF and CRLF end a line. */
enum { TEXT_WORDS_MAX = 64 };
typedef struct {
    Cursor at;                          /* start of the line */
    int count;                          /* words in it */
    const char *word[TEXT_WORDS_MAX];   /* not terminated */
    int length[TEXT_WORDS_MAX];
} Line;

/* Fetches the next line that holds a word. False at the end of the text (no error) or with
   an error for a line of more than TEXT_WORDS_MAX words; check e->kind. */
bool text_line(Cursor *c, Line *line, Error *e);

/* Is word i of the line equal to `word`? False for i out of range. */
bool text_is(const Line *line, int i, const char *word);

/* Word i as a number (C notation, no locale, finite, |x| <= 1e12). Error with its place. */
MUST_CHECK bool text_real(const Line *line, int i, double *out, Error *e);
MUST_CHECK bool text_int(const Line *line, int i, int low, int high, int *out, Error *e);

/* Copies word i into out (capacity n); error where it is missing or too long. */
MUST_CHECK bool text_word(const Line *line, int i, char *out, size_t n, Error *e);

/* error_at for word i of the line (i == count: just behind the last word). Returns false. */
bool text_error(const Line *line, int i, Error *e, const char *fmt, ...) PRINTF_LIKE(4, 5);

/* Parses a number that starts at `s` and ends before `end`: sign, digits, '.', exponent.
   Returns the first byte behind it, or NULL if there is none. Independent of the locale,
   correctly rounded; overflow gives infinity, underflow 0. */
const char *text_number(const char *s, const char *end, double *out);

/* x in the fewest digits that read back as x; returns `out`. Round numbers stay plain: 20, not 2e+01. */
enum { TEXT_SHORTEST = 32 };
const char *text_shortest(double x, char out[TEXT_SHORTEST]);

/* Does a file's name end in `ending`, such as ".bvh" or ".BVH", with something in front of it? */
bool text_ends_in(const char *name, const char *ending);

/* The candidate that a wrong word was probably meant to be: begin with {.word = ...}, try them all. */
typedef struct {
    const char *word, *best; /* best: NULL while nothing is near enough */
    int distance;
} Nearest;
void nearest_try(Nearest *n, const char *candidate);

/* Records "unknown WHAT 'WORD'; did you mean 'BEST'?" and returns false. */
bool nearest_error(const Nearest *n, const char *what, Place place, Error *e);

#endif
