/* Lines of numbers: printf's, byte for byte, with any vectors; and texts that are found again. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "files/digits.h"
#include "files/memo.h"
#include "dice.h"
#include "tap.h"

enum { NUMBERS = DIGITS_LINES * DIGITS_COLUMNS };

static void print_lines(char *out, const char *tag, const double *x, double unit, int columns) {
    for (int line = 0; line < DIGITS_LINES; line++) {
        out += sprintf(out, "%s", tag);
        for (int c = 0; c < columns; c++) out += sprintf(out, " %.6f", *x++ * unit);
        out += sprintf(out, "\n");
    }
}

/* 1: as printf; 0: not; -1: refused. */
static int compare(const double *x, double unit, int columns, Vectors v) {
    static const char *const tags[] = {"v", "vt", "vn"};
    char ours[DIGITS_LINES * DIGITS_ROOM + 1], theirs[64 * NUMBERS];
    const char *tag = tags[columns % 3];
    char *end = digits_lines(ours, tag, x, unit, columns, v);
    if (!end) return -1;
    *end = 0;
    print_lines(theirs, tag, x, unit, columns);
    return strcmp(ours, theirs) == 0;
}

static void numbers_of_all_sizes(Vectors v) {
    int wrong = 0, refused = 0;
    for (int n = 0; n < 3000; n++) {
        double x[NUMBERS], unit = n % 2 ? 1 : 0.37;
        for (int i = 0; i < NUMBERS; i++)
            x[i] = (dice_unit() - 0.5) * 2 * pow(10, 1 - floor(10 * dice_unit())) * (dice_unit() > 0.01);
        for (int i = 0; i < NUMBERS; i++) x[i] = fabs(x[i]) < 9.9 ? x[i] : 1 / x[i];
        int found = compare(x, unit, 1 + n % 3, v);
        wrong += found == 0;
        refused += found < 0;
    }
    OK(wrong == 0 && refused == 0, "vectors %d: numbers of all sizes are printf's (%d are not, %d are refused)", v,
       wrong, refused);
}

/* As written meshes have them; every last digit, and carries into every place. */
static void whole_millionths(Vectors v) {
    int wrong = 0;
    for (int n = 0; n < 9999900; n += 7 * NUMBERS) {
        double x[NUMBERS];
        for (int i = 0; i < NUMBERS; i++) x[i] = (i % 2 ? -1 : 1) * (n + 7 * i < 9999999 ? n + 7 * i : 0) / 1e6;
        wrong += compare(x, 1, 3, v) != 1;
    }
    OK(wrong == 0, "vectors %d: and so are whole millionths, none is refused (%d are not)", v, wrong);
}

/* Just where the last digit turns it is printf's or refused; elsewhere nothing is. */
static void between_two_digits(Vectors v) {
    int wrong = 0, refused = 0;
    for (int n = 0; n < 2000; n++) {
        double x[NUMBERS], middle = (floor(9999998 * dice_unit()) + 0.5) / 1e6;
        for (int i = 0; i < NUMBERS; i++) x[i] = i == n % NUMBERS ? middle : 0.25;
        for (int k = n % 9; k > 0; k--) x[n % NUMBERS] = nextafter(x[n % NUMBERS], n % 2 ? 0 : 10);
        int found = compare(x, 1, 3, v);
        wrong += found == 0;
        refused += found < 0;
    }
    OK(wrong == 0 && refused > 300, "vectors %d: next to the middle of two digits none is wrong, %d refused", v,
       refused);
}

static void what_is_refused(Vectors v) {
    static const double bad[] = {NAN, INFINITY, -INFINITY, 10, -10, 9.9999995, 1e300, 5e-7, -1.0000005};
    static const double good[] = {0, -0.0, 9.999999, -9.9999989, 5e-324, -1e-7, 0.9999995001};
    int taken = 0, lost = 0;
    double x[NUMBERS];
    for (int place = 0; place < NUMBERS; place++) {
        for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
            for (int i = 0; i < NUMBERS; i++) x[i] = i == place ? bad[k] : 1.5;
            taken += compare(x, 1, 3, v) >= 0;
        }
        for (size_t k = 0; k < sizeof good / sizeof *good; k++) {
            for (int i = 0; i < NUMBERS; i++) x[i] = i == place ? good[k] : 1.5;
            lost += compare(x, 1, 3, v) != 1;
        }
    }
    OK(taken == 0 && lost == 0, "vectors %d: at any place what is beyond is refused (%d are not), the rest is taken "
       "(%d are not)", v, taken, lost);
}

static bool finds(Memo *m, const char *key, const char *wanted) {
    size_t size = 0;
    memo_begin(m);
    memo_add(m, key, strlen(key));
    const char *text = memo_find(m, &size);
    return wanted ? text && size == strlen(wanted) && memcmp(text, wanted, size) == 0 : !text;
}

static void texts_found_again(void) {
    static char large[MEMO_MOST + 1];
    Memo m = {0};
    char key[16];
    OK(finds(&m, "a", NULL), "nothing is found before it is kept");
    memo_keep(&m, "text", 4);
    OK(finds(&m, "a", "text") && finds(&m, "b", NULL) && finds(&m, "aa", NULL), "a text is found under its key alone");
    for (int i = 0; i < 3 * MEMO_ITEMS; i++) {
        snprintf(key, sizeof key, "%d", i);
        if (finds(&m, key, NULL)) memo_keep(&m, key, strlen(key));
        if (!finds(&m, "a", "text")) break;
    }
    OK(finds(&m, "a", "text") && finds(&m, key, key), "what is asked for stays, what is not goes");
    OK(finds(&m, "0", NULL), "the oldest first");
    memo_begin(&m);
    memo_add(&m, large, sizeof large);
    memo_add(&m, "a", 1);
    size_t size;
    bool none = !memo_find(&m, &size);
    memo_keep(&m, "x", 1);
    OK(none && !memo_find(&m, &size), "a key that is too long finds nothing, and nothing is kept under it");
    memo_begin(&m);
    memo_add(&m, "large", 5);
    memo_keep(&m, large, sizeof large);
    OK(!memo_find(&m, &size), "nor is a text that is too long");
    memo_free(&m);
}

int main(void) {
    for (Vectors v = VECTORS_BEST; v < VECTORS_COUNT; v++) {
        if (!vectors_usable(v)) continue;
        numbers_of_all_sizes(v);
        whole_millionths(v);
        between_two_digits(v);
        what_is_refused(v);
    }
    texts_found_again();
    return tap_done();
}
