/* The window over a file: numbers are those of the C library, bit for bit; words, line ends and
   places come out the same wherever the window's edge falls. */
#include "motion/stream.h"

#include <fcntl.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "dice.h"
#include "folder.h"
#include "tap.h"

/* A number as exporters write them, and some as nobody does. */
static int write_number(char *out) {
    static const char *const formats[] = {"%.6f", "%g", "%.15g", "%.17g", "%.3e", "%.0f.", "%.20f", "%+.12f"};
    double x = (2 * dice_unit() - 1) * pow(10, (int)dice_below(24) - 12);
    if (dice_below(50) == 0)
        return sprintf(out, "-.%018" PRIu64 "%018" PRIu64 "E%+d", dice_bits() >> 12, dice_bits() >> 12,
                       (int)dice_below(600) - 595);
    return sprintf(out, formats[dice_below(8)], x);
}

typedef struct {
    Stream stream;
    Arena arena;
    Error e;
    int fd;
} Session;

static bool session_open(Session *s, const char *text, size_t size) {
    memset(s, 0, sizeof *s);
    s->fd = open(in_folder("text"), O_RDWR | O_CREAT | O_TRUNC, 0600);
    return s->fd >= 0 && write(s->fd, text, size) == (ssize_t)size &&
           stream_open(&s->stream, s->fd, "text", &s->arena, &s->e);
}

static void session_close(Session *s) {
    close(s->fd);
    arena_free(&s->arena);
}

static void test_numbers(void) {
    enum { MANY = 100000 };
    static char text[MANY * 48];
    static double wanted[MANY];
    size_t n = 0;
    for (int i = 0; i < MANY; i++) {
        char number[64];
        int length = write_number(number);
        wanted[i] = strtod(number, NULL);
        memcpy(text + n, number, (size_t)length);
        n += (size_t)length;
        text[n++] = i % 7 ? ' ' : '\n';
    }
    Session s;
    bool good = session_open(&s, text, n);
    int same = 0;
    for (int i = 0; i < MANY && good; i++) {
        double x;
        good = stream_number(&s.stream, &x) == NUMBER_OK;
        same += memcmp(&x, &wanted[i], sizeof x) == 0;
    }
    OK(good && same == MANY, "%d of %d numbers are those of strtod, bit for bit", same, MANY);
    double x;
    OK(stream_number(&s.stream, &x) == NUMBER_END, "then the text ends");
    session_close(&s);
}

/* The same few words behind more and more blanks, so that the edge falls on each of their bytes. */
static void test_edges(void) {
    static const char words[] = "Frames 12.5e1\r\nname\rlast";
    static char text[STREAM_SIZE + 64];
    bool good = true;
    for (size_t k = 0; k < 40; k++) {
        size_t before = STREAM_SIZE - 35 + k;
        memset(text, ' ', before);
        text[0] = '\n';
        memcpy(text + before, words, sizeof words - 1);
        Session s;
        double x = 0;
        bool now = session_open(&s, text, before + sizeof words - 1);
        now = now && word_is(stream_word(&s.stream), "frames") && stream_number(&s.stream, &x) <= NUMBER_GLUED &&
            x == 125;
        now = now && s.stream.line == 2 && word_is(stream_word(&s.stream), "name") && s.stream.line == 3;
        Word w = stream_word(&s.stream);
        now = now && word_is(w, "last") && w.first && s.stream.line == 4 && stream_ended(&s.stream);
        stream_error(&s.stream, &s.e, "here");
        now = now && s.e.line == 4 && s.e.column == 5 && strcmp(s.e.source, "last") == 0;
        if (!now) printf("# %zu bytes in front: line %d\n", before, s.stream.line);
        good = good && now;
        session_close(&s);
    }
    OK(good, "words, numbers and line ends at the edge of the window");
}

/* CR and LF are one line end even if the edge parts them. */
static void test_parted(void) {
    static char text[STREAM_SIZE + 8];
    memset(text, ' ', sizeof text);
    memcpy(text + STREAM_SIZE - 1, "\r\nword", 6);
    Session s;
    bool good = session_open(&s, text, sizeof text);
    OK(good && word_is(stream_word(&s.stream), "word") && s.stream.line == 2, "CR and LF on both sides of the edge");
    session_close(&s);
}

static void test_marks(void) {
    static char text[4 * STREAM_SIZE];
    size_t n = 0;
    for (int i = 0; n + 16 < sizeof text; i++) n += (size_t)sprintf(text + n, "%d\n", i);
    Session s;
    Mark mark[100];
    bool good = session_open(&s, text, n);
    double x;
    for (int i = 0; i < 100 && good; i++) {
        mark[i] = stream_mark(&s.stream);
        for (int k = 0; k < 300 && good; k++) good = stream_number(&s.stream, &x) == NUMBER_OK && (int)x == 300 * i + k;
    }
    for (int k = 0; k < 200 && good; k++) {
        int i = (int)dice_below(100);
        stream_seek(&s.stream, mark[i]);
        good = stream_number(&s.stream, &x) == NUMBER_OK && (int)x == 300 * i && s.stream.line == 300 * i + 1;
    }
    OK(good, "back to any mark");
    session_close(&s);
}

/* What stands where a number should, told apart. Only the last word of a file can have been cut. */
static void test_no_numbers(void) {
    static const struct { const char *text; NumberResult result; } some[] = {
        {"", NUMBER_END}, {" ", NUMBER_END}, {"-", NUMBER_CUT}, {"1.5e", NUMBER_CUT}, {"1.5e 2", NUMBER_BAD},
        {"- 1", NUMBER_BAD}, {"1.2.3\n", NUMBER_BAD}, {"1.5x", NUMBER_BAD}, {"name", NUMBER_BAD}, {"1,5", NUMBER_COMMA},
        {"-nan(ind)", NUMBER_INFINITE}, {"1.#QNAN", NUMBER_INFINITE}, {"1e13", NUMBER_RANGE},
        {"0.0-7.5", NUMBER_GLUED}};
    for (size_t i = 0; i < sizeof some / sizeof some[0]; i++) {
        Session s;
        double x = 0;
        bool good = session_open(&s, some[i].text, strlen(some[i].text));
        NumberResult result = stream_number(&s.stream, &x);
        OK(good && result == some[i].result, "'%.6s' is told apart (%d)", some[i].text, (int)result);
        session_close(&s);
    }
}

int main(void) {
    if (!folder_make()) return 1;
    test_numbers();
    test_no_numbers();
    test_edges();
    test_parted();
    test_marks();
    folder_remove();
    return tap_done();
}
