/* The ground floor: numbers that are read as the C library reads them and written in the fewest digits, lines of
   words that know their place, what was probably meant, the first word of a file, memory that is given back and
   limited, and how many processors there are. */
#define _GNU_SOURCE /* sched_setaffinity */
#include "base/text.h"

#include <inttypes.h>
#include <limits.h>
#include <sched.h>
#include <stdlib.h>
#include <string.h>

#include "base/digest.h"
#include "base/thread.h"
#include "dice.h"
#include "folder.h"
#include "tap.h"

/* Any finite double there is. */
static double any_double(void) {
    for (;;) {
        uint64_t bits = dice_bits();
        double x;
        memcpy(&x, &bits, sizeof x);
        if (isfinite(x)) return x;
    }
}

static bool is_read(const char *text, double wanted) {
    double x = 0;
    const char *end = text + strlen(text);
    return text_number(text, end, &x) == end && x == wanted;
}

static void numbers_are_read(void) {
    int wrong = 0;
    for (int k = 0; k < 100000; k++) {
        char text[64];
        double x = any_double();
        snprintf(text, sizeof text, "%.*g", k % 18, x);
        wrong += !is_read(text, strtod(text, NULL));
    }
    OK(wrong == 0, "any number in any number of digits is what strtod reads");
    OK(is_read("+.5", 0.5) && is_read("5.", 5) && is_read("-0e9", 0) && is_read("1E+3", 1000), "signs, points, powers");
    OK(is_read("1e999", INFINITY) && is_read("1e-999", 0), "too large is infinite, too small nothing");
    static const char *const none[] = {"", "-", ".", "e5", "nan", "inf", "0x10", " 1", "1,5"};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        OK(!is_read(none[i], strtod(none[i], NULL)), "'%s' is no number", none[i]);
    double x = 0;
    const char word[] = "1e", digits[] = "1234";
    OK(text_number(word, word + 2, &x) == word + 1 && x == 1, "a power without digits does not belong to it");
    OK(text_number(digits, digits + 2, &x) == digits + 2 && x == 12, "nor does what stands behind the end");
}

/* In front of the exponent. */
static int digits_of(const char *text) {
    int n = 0;
    for (; *text && *text != 'e'; text++) n += *text >= '0' && *text <= '9';
    return n;
}

static void numbers_are_written(void) {
    char text[TEXT_SHORTEST], shorter[400];
    int wrong = 0, wasted = 0;
    for (int k = 0; k < 100000; k++) {
        double x = k % 2 ? any_double() : (double)(dice_bits() % 1000000) / 1000;
        wrong += strtod(text_shortest(x, text), NULL) != x;
        int n = digits_of(text);
        if (n < 2) continue;
        snprintf(shorter, sizeof shorter, "%.*g", n - 1, x);
        bool is_rounder = strchr(shorter, 'e') && !strchr(text, 'e'); /* 2e+02 for 200 */
        wasted += digits_of(shorter) < n && strtod(shorter, NULL) == x && !is_rounder;
    }
    OK(wrong == 0, "what is written is read back to the last bit");
    OK(wasted == 0, "in no more digits than it takes");
    OK(strcmp(text_shortest(0.052, text), "0.052") == 0, "0.052 is 0.052");
    OK(strcmp(text_shortest(20, text), "20") == 0, "and 20 is no 2e+01");
}

static Text text_of(const char *data) { return (Text){"file", data, strlen(data)}; }

static void lines_know_their_words(void) {
    Text text = text_of("# first\n\n  ring\thip 1.5 # tail\r\nnext#no comment\rlast");
    Cursor c = text_start(&text);
    Line line;
    Error e = {0};
    double x = 0;
    bool good = text_line(&c, &line, &e) && line.count == 3 && line.at.line == 3;
    OK(good && text_is(&line, 1, "hip") && !text_is(&line, 1, "hi") && !text_is(&line, 3, "hip"),
       "words between blanks, without comments and empty lines");
    OK(good && text_real(&line, 2, &x, &e) && x == 1.5, "one of them is a number");
    good = !text_real(&line, 1, &x, &e) && strcmp(e.text, "expected a number, found 'hip'") == 0;
    OK(good && e.line == 3 && e.column == 8, "and of one that is none the place is told (%d:%d: %s)", e.line, e.column,
       e.text);
    OK(strcmp(e.source, "  ring hip 1.5 # tail") == 0 && e.caret == 7, "with its line, and a caret below it");
    e = (Error){0};
    OK(!text_real(&line, 3, &x, &e) && e.column == 15, "a word that is missing is missed behind the last one");
    e = (Error){0};
    OK(text_line(&c, &line, &e) && line.count == 2 && line.at.line == 4 && text_is(&line, 0, "next#no"),
       "'#' within a word begins no comment; CRLF is one end of a line");
    OK(text_line(&c, &line, &e) && line.at.line == 5 && text_is(&line, 0, "last"), "CR alone is one too");
    OK(!text_line(&c, &line, &e) && !e.kind, "the last line needs none");
}

static void meant(const char *word, const char *wanted) {
    static const char *const all[] = {"left_thigh", "right_thigh", "pelvis", "pin", "draco-position-bits"};
    Nearest n = {.word = word};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) nearest_try(&n, all[i]);
    const char *best = n.best ? n.best : "nothing";
    OK(strcmp(best, wanted) == 0, "'%s' meant %s (%s)", word, wanted, best);
}

static void errors_come_first(void) {
    Error e = {0};
    char shown[8];
    OK(!error_set(&e, ERR_INPUT, "first\033[2J") && !error_set(&e, ERR_OUTPUT, "second") && e.kind == ERR_INPUT,
       "the first error stays");
    OK(strcmp(e.text, "first?[2J") == 0, "and no byte of it is a command to a terminal");
    error_clean(shown, sizeof shown, "0123456789");
    OK(strcmp(shown, "0123456") == 0, "texts end where their room does");
    char line[300];
    Error cut = {0};
    memset(line, 'x', sizeof line);
    error_at(&cut, ERR_INPUT, (Place){"f", 1, 1000, line, sizeof line}, "behind the end");
    OK(cut.caret >= 0 && cut.caret <= (int)strlen(cut.source) && strlen(cut.source) < sizeof cut.source,
       "a place behind the end of its line is the end (%d of %zu)", cut.caret, strlen(cut.source));
    OK(error_shown(3) == 3 && error_shown(LONG_MAX) == 40, "of long words the beginning is shown");
}

static void memory_is_bounded(void) {
    Arena arena = {.limit = 1 << 20};
    Error e = {0};
    char *a = ARENA_NEW(&arena, char, 1000, &e);
    bool aligned = a && (uintptr_t)a % 64 == 0, zero = a != NULL;
    if (a) memset(a, 1, 1000);
    arena_reset(&arena);
    char *b = ARENA_NEW(&arena, char, 1000, &e);
    for (int i = 0; b && i < 1000; i++) zero = zero && b[i] == 0;
    OK(aligned && a == b && zero, "what was forgotten is handed out again, full of zeros");
    OK(ARENA_NEW(&arena, char, 0, &e) != NULL, "nothing has a place too");
    OK(!ARENA_NEW(&arena, char, 1 << 20, &e) && e.kind == ERR_INPUT && arena.held <= arena.limit, "a limit is kept");
    e = (Error){0};
    OK(!arena_array(&arena, SIZE_MAX / 2, 3, &e) && e.kind == ERR_INTERNAL, "no product of sizes overflows");
    arena_free(&arena);
    OK(arena.held == 0, "all is given back");

    arena = (Arena){0};
    e = (Error){0};
    int *grown = NULL, capacity = 0, kept = 0, room = 0;
    for (int i = 0; i < 1000; i++) {
        grown = ARENA_GROW(&arena, int, grown, i, &capacity, &e);
        if (!grown) break;
        grown[i] = i;
        room += capacity > i;
    }
    for (int i = 0; grown && i < 1000; i++) kept += grown[i] == i;
    OK(room == 1000 && kept == 1000, "an array grows and keeps what it holds (%d, %d)", room, kept);
    arena.limit = arena.held;
    while (capacity < 1 << 20 && (grown = ARENA_GROW(&arena, int, grown, capacity, &capacity, &e))) continue;
    OK(!grown && e.kind == ERR_INPUT, "but not beyond the limit (%d)", capacity);
    arena_free(&arena);

    arena = (Arena){0};
    bool good = true;
    for (int k = 0; k < 2000; k++) good = ARENA_NEW(&arena, char, k % 20 == 0 ? 700000 : 20000, &e) && good;
    OK(good && (double)arena.held < 1.1 * (double)arena.used, "little is left over of blocks: %zu of %zu KB",
       (arena.held - arena.used) >> 10, arena.held >> 10);
    arena_free(&arena);
}

static void digests_differ(void) {
    Digest one = digest_start(), other = digest_start(), again = digest_start();
    digest_text(&one, "ab"), digest_text(&one, "c");
    digest_text(&other, "a"), digest_text(&other, "bc");
    digest_text(&again, "ab"), digest_text(&again, "c");
    OK(one == again && one != other, "texts are told apart by their ends (%016" PRIx64 ")", one);
}

static void begins_with(const char *text, const char *wanted, const char *what) {
    char word[TEXT_FIRST];
    Error e = {0};
    OK(text_first_word(folder_put_text("first", text), word, &e) && strcmp(word, wanted) == 0, "%s: '%s'", what, word);
}

static void first_words_are_found(void) {
    char many[8000] = "";
    for (size_t n = 0; n + 16 < sizeof many; n += 4) memcpy(many + n, "# x\n", 5);
    strcat(many, "garment x\n");
    begins_with("\xEF\xBB\xBF# a remark\ngarment x\n", "garment", "behind a mark and a comment");
    begins_with("#\r\n#\r\ngarment x\r\n", "garment", "lines that end in CR LF");
    begins_with("# a remark\rgarment x\r", "garment", "lines that end in CR");
    begins_with(many, "garment", "behind many comments");
    begins_with("# nothing else", "", "nothing but a comment");
}

/* As in a batch job that has got one processor of many. */
static void processors_are_ours(void) {
#ifdef __linux__
    cpu_set_t all, one;
    size_t first = 0;
    CPU_ZERO(&one);
    if (sched_getaffinity(0, sizeof all, &all) != 0) {
        SKIP("processors", "there is no telling which are ours");
        return;
    }
    OK(thread_count() == CPU_COUNT(&all), "all processors that are ours count: %d", thread_count());
    while (!CPU_ISSET(first, &all)) first++;
    CPU_SET(first, &one);
    if (sched_setaffinity(0, sizeof one, &one) == 0) OK(thread_count() == 1, "others do not: %d", thread_count());
    sched_setaffinity(0, sizeof all, &all);
#endif
}

int main(void) {
    if (!folder_make()) return 1;
    numbers_are_read();
    numbers_are_written();
    lines_know_their_words();
    meant("left_tigh", "left_thigh");
    meant("pelivs", "pelvis");
    meant("pni", "nothing");
    meant("draco", "draco-position-bits");
    meant("elbow", "nothing");
    errors_come_first();
    memory_is_bounded();
    digests_differ();
    first_words_are_found();
    processors_are_ours();
    folder_remove();
    return tap_done();
}
