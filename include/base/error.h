/* One way to fail: record the first error, return false. */
#ifndef BASE_ERROR_H
#define BASE_ERROR_H

#include <stdbool.h>
#include <stdio.h>

#if defined(__GNUC__)
#define PRINTF_LIKE(fmt, args) __attribute__((format(printf, fmt, args)))
#define MUST_CHECK __attribute__((warn_unused_result))
#else
#define PRINTF_LIKE(fmt, args)
#define MUST_CHECK
#endif

/* The value of a kind is the program's exit code for it. */
typedef enum {
    ERR_NONE = 0,
    ERR_CHECK = 1,         /* done, but a requested check failed (--strict) */
    ERR_USAGE = 2,         /* the command line or a job file is wrong */
    ERR_INPUT = 3,         /* an input file cannot be read or makes no sense */
    ERR_OUTPUT = 4,        /* an output cannot be written */
    ERR_INTERNAL = 5,      /* out of memory, or a fault of ours */
    ERR_INTERRUPTED = 130, /* SIGINT or SIGTERM */
} ErrorKind;

/* A place in an input text. line and column count from 1, 0 = unknown. */
typedef struct {
    const char *file;   /* name as the user gave it; NULL = no place at all */
    int line, column;
    const char *source; /* start of the offending line, not terminated; may be NULL */
    int source_length;  /* bytes of it, without the line end */
} Place;

/* Plain value; clear it with {0}. Texts are copied in, so it outlives every arena. */
typedef struct {
    ErrorKind kind;
    char text[320];
    char file[320];
    int line, column;
    char source[240]; /* a window of the offending line round the column */
    int caret;        /* where in `source` the caret stands, from 0 */
} Error;

/* Records the first failure and returns false, so callers write
       return error_set(e, ERR_OUTPUT, "cannot write '%s': %s", path, strerror(errno));
   A later call keeps the first. Wording: lower case, problem first, subject in single
   quotes, no final stop. Put a breakpoint here. */
bool error_set(Error *e, ErrorKind kind, const char *fmt, ...) PRINTF_LIKE(3, 4);

/* The same with a place in an input file. */
bool error_at(Error *e, ErrorKind kind, Place place, const char *fmt, ...) PRINTF_LIKE(4, 5);

/* How many bytes of a wrong word of that length a message shows: for "%.*s". */
static inline int error_shown(long length) { return length < 40 ? (int)length : 40; }

/* Prints `file:line:column: error: text`, the line and a caret; without a place
   `kitsuke: text`. Bytes that a terminal could take as a command are shown as '?'. */
void error_print(const Error *e, FILE *out);

/* Things worth telling that do not stop the work, in the order they were found.
   At most NOTES_MAX are kept; `count` goes on counting. Clear with {0}. */
enum { NOTES_MAX = 32 };
typedef struct {
    int count;
    Error note[NOTES_MAX]; /* kind is ERR_NONE; text and place are set */
} Notes;

/* Adds a warning. `notes` may be NULL (then nothing happens). */
void notes_add(Notes *notes, Place place, const char *fmt, ...) PRINTF_LIKE(3, 4);

/* Prints each as `file:line:column: warning: text`; without a place `name: warning: text`. */
void notes_print(const Notes *notes, const char *name, FILE *out);

/* Copies `text` to out (capacity n, always terminated), control bytes replaced by '?'. */
void error_clean(char *out, size_t n, const char *text);

#endif
