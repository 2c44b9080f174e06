/* A text file of any size read through a window of fixed size. Knows the line and column of
   every byte, and reads words and numbers. The window moves; memory does not grow. */
#ifndef MOTION_STREAM_H
#define MOTION_STREAM_H

#include "base/arena.h"

/* At least STREAM_LOOK bytes from `at` on are in the window, or all that the file has left, so that no word up to that
   length is cut by the window's end. */
enum { STREAM_SIZE = 1 << 16, STREAM_LOOK = 1 << 12 };

typedef struct {
    const char *name;     /* for messages */
    int fd;               /* belongs to the caller; read by position, so threads may share it */
    char *data;           /* the window; a NUL stands behind its last byte */
    const char *at, *end; /* next byte, end of the window */
    long long offset;     /* of data[0] in the file */
    bool last;            /* nothing follows `end` */
    int failure;          /* errno of a read that failed; the text then seems to end there */
    int line;             /* from 1 */
    long long line_start; /* file offset of the first byte of this line */
} Stream;

/* A run of bytes without white space. Valid until the next call on the stream. */
typedef struct {
    const char *start;
    int length;
    bool first; /* first word of its line */
} Word;

/* A place to come back to. */
typedef struct {
    long long offset, line_start;
    int line;
} Mark;

/* Starts at the beginning of the file, behind a byte-order mark. */
MUST_CHECK bool stream_open(Stream *s, int fd, const char *name, Arena *arena, Error *e);
Mark stream_mark(const Stream *s);
void stream_seek(Stream *s, Mark mark);

/* False with ERR_INPUT where reading has failed (a disk error, not the end of the text). */
MUST_CHECK bool stream_sound(const Stream *s, Error *e);

/* Skips white space with line ends (LF, CRLF, CR). True if a line end was among it. */
bool stream_space(Stream *s);
/* Skips white space up to the end of the line. False where nothing else is in the line. */
bool stream_blanks(Stream *s);
/* Skips the rest of the line with its end. */
void stream_skip_line(Stream *s);
/* Is this the end of the text? Call it behind stream_space. */
bool stream_ended(const Stream *s);

/* The word at `at` without taking it, and the next word (length 0 at the end of the text). */
Word stream_peek(Stream *s);
Word stream_word(Stream *s);
bool word_is(Word w, const char *text); /* letters in any case */

typedef enum {
    NUMBER_OK,
    NUMBER_GLUED,    /* read, but the next number follows without a blank: 0.0-7.5 */
    NUMBER_END,      /* the text ends here */
    NUMBER_CUT,      /* the text ends within a number: `-` or `1.5e` */
    NUMBER_BAD,      /* something else stands here */
    NUMBER_COMMA,    /* 1,5 */
    NUMBER_INFINITE, /* nan, inf, -nan(ind), 1.#QNAN */
    NUMBER_RANGE,    /* beyond 1e12: no length or angle of a body */
} NumberResult;

/* Skips white space and reads a number: C notation, correctly rounded, underflow is 0.
   From NUMBER_END on `at` stays at its first byte. */
NumberResult stream_number(Stream *s, double *out);

/* Says what is wrong with the number at `at`; `what` names it: "frame 3, joint 'Hips',
   Xposition". Returns false. */
bool stream_refuse(Stream *s, NumberResult r, const char *what, Error *e);

/* error_at and notes_add for the next byte. Words taken before are no longer valid. */
bool stream_error(Stream *s, Error *e, const char *fmt, ...) PRINTF_LIKE(3, 4);
void stream_note(Stream *s, Notes *notes, const char *fmt, ...) PRINTF_LIKE(3, 4);

#endif
