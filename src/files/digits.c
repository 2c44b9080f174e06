/* What decimal.c does with one number, done with 48 side by side.

   A number below 10 has seven digits, so with its point it is eight bytes, always: "d.dddddd". They are
   put together by arithmetic without branches or tables, which the compiler turns into vectors as wide as
   the processor has them. Only then come the lines, where each number begins where the one before has
   ended: a blank, perhaps a minus, eight bytes.

   A block in which one number is too large, or so near the middle between two last digits that only its
   exact value tells, is left to decimal.c. Coordinates in metres are seldom either. */
#include "files/digits.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

enum { NUMBERS = DIGITS_LINES * DIGITS_COLUMNS };
static const double LIMIT = 9999999.5;            /* millionths: what is less rounds to seven digits */
static const uint64_t ZEROS = 0x3030303030302E30; /* "0.000000" */
static const bool LOWEST_FIRST = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__; /* does this machine store words so? */

/* text: eight bytes, of which the first is the lowest. */
typedef struct { uint32_t minus[NUMBERS]; uint64_t text[NUMBERS]; } Digits;

/* 1 where the sign bit stands, for -0 as well. */
ALWAYS void find_minus(const double *x, uint32_t *minus) {
    uint64_t bits[NUMBERS];
    memcpy(bits, x, sizeof bits);
    for (int i = 0; i < NUMBERS; i++) minus[i] = (uint32_t)(bits[i] >> 63);
}

/* |x unit| in millionths, not rounded; LIMIT where it is that or more, or a NAN. */
ALWAYS void scale_all(const double *x, double unit, double *millionths) {
    for (int i = 0; i < NUMBERS; i++) {
        double product = fabs(x[i] * unit) * 1e6;
        millionths[i] = product < LIMIT ? product : LIMIT;
    }
}

/* Rounded as decimal_put does. False if any number of the block is beyond us: then the product errs by half
   a unit in its last place, and the middle between two whole numbers is nearer than twice that. */
ALWAYS bool round_all(double *millionths) {
    int beyond = 0;
    for (int i = 0; i < NUMBERS; i++) {
        double k = millionths[i], whole = (double)(int32_t)(k + 0.5);
        beyond += (k >= LIMIT) | (fabs(k - whole) >= 0.5 - k * 0x1p-51);
        millionths[i] = whole;
    }
    return beyond == 0;
}

/* Whole numbers below 1e7 as d.dd, which are the first four bytes, and four digits more. Half a unit keeps
   the quotient of exact multiples on its side; 5243 >> 19 is a hundredth, 103 >> 10 a tenth. Two numbers
   below 100 stand in one word, in 16 bits each, and become their tens and ones: t | (n - 10 t) << 8. */
ALWAYS void spell_all(const double *millionths, uint64_t *text) {
    for (int i = 0; i < NUMBERS; i++) {
        uint32_t high = (uint32_t)(int32_t)((millionths[i] + 0.5) * 1e-4);
        uint32_t low = (uint32_t)(int32_t)millionths[i] - 10000 * high;
        uint32_t first = high * 5243 >> 19, second = high - 100 * first, middle = low * 5243 >> 19;
        uint32_t rest = middle | (low - 100 * middle) << 16;
        uint32_t head = (second << 8) - (second * 103 >> 10) * (2560 - 1);
        uint32_t tail = (rest << 8) - (rest * 103 >> 10 & 0x000F000F) * (2560 - 1);
        text[i] = ZEROS + (first | head << 16) + ((uint64_t)tail << 32);
    }
}

ALWAYS bool find_digits(const double *x, double unit, Digits *d) {
    double millionths[NUMBERS];
    find_minus(x, d->minus);
    scale_all(x, unit, millionths);
    bool good = round_all(millionths);
    spell_all(millionths, d->text);
    return good;
}

static char *put_lines(char *out, const char *tag, int columns, const Digits *d) {
    for (int line = 0, i = 0; line < DIGITS_LINES; line++) {
        *out++ = tag[0];
        *out = tag[1];
        out += tag[1] != 0;
        for (int c = 0; c < columns; c++, i++) {
            out[0] = ' ';
            out[1] = '-';
            out += 1 + d->minus[i];
            memcpy(out, &d->text[i], 8);
            out += 8;
        }
        *out++ = '\n';
    }
    return out;
}

typedef bool FindDigits(const double *x, double unit, Digits *d);

static bool plain_digits(const double *x, double unit, Digits *d) { return find_digits(x, unit, d); }

#ifdef VECTORS_ARE_X86
FOR_AVX2 static bool avx2_digits(const double *x, double unit, Digits *d) { return find_digits(x, unit, d); }
FOR_AVX512 static bool avx512_digits(const double *x, double unit, Digits *d) { return find_digits(x, unit, d); }
#endif

char *digits_lines(char *out, const char *tag, const double *x, double unit, int columns, Vectors vectors) {
    Digits d;
    FindDigits *find = plain_digits;
    vectors = vectors_pick(vectors);
#ifdef VECTORS_ARE_X86
    if (vectors != VECTORS_PLAIN) find = vectors == VECTORS_AVX512 ? avx512_digits : avx2_digits;
#endif
    return LOWEST_FIRST && find(x, unit, &d) ? put_lines(out, tag, columns, &d) : NULL;
}
