/* "%.6f" without printf, which is most of the time that writing an OBJ file takes.

   x * 1e6 is rounded to a whole number k, and k printed. The product carries an error of half
   a unit in its last place, so where it lies that close to the middle between two whole
   numbers the rounding is not certain, and printf decides from the exact value. Below 1e9 the
   product has few enough digits for its fraction to be exact. */
#include "files/decimal.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

static const char PAIRS[] = "0001020304050607080910111213141516171819"
                            "2021222324252627282930313233343536373839"
                            "4041424344454647484950515253545556575859"
                            "6061626364656667686970717273747576777879"
                            "8081828384858687888990919293949596979899";

static char *put_whole(char *out, uint32_t n) {
    char digits[10], *at = digits + sizeof digits;
    while (n >= 100) {
        at -= 2;
        memcpy(at, PAIRS + 2 * (n % 100), 2);
        n /= 100;
    }
    if (n >= 10) memcpy(at -= 2, PAIRS + 2 * n, 2);
    else *--at = (char)('0' + n);
    size_t length = (size_t)(digits + sizeof digits - at);
    memcpy(out, at, length);
    return out + length;
}

char *decimal_put_int(char *out, int n) { return put_whole(out, (uint32_t)n); }

/* What happens rarely stands apart, so that the rest needs no room on the stack. */
__attribute__((noinline)) static char *put_slowly(char *out, double x) {
    return out + snprintf(out, DECIMAL_MAX, "%.6f", x);
}

/* The last six digits of k, a point before them. */
static inline char *put_millionths(char *out, uint32_t k) {
    uint32_t high = k / 10000, middle = k / 100 % 100, low = k % 100;
    *out = '.';
    memcpy(out + 1, PAIRS + 2 * high, 2);
    memcpy(out + 3, PAIRS + 2 * middle, 2);
    memcpy(out + 5, PAIRS + 2 * low, 2);
    return out + 7;
}

char *decimal_put(char *out, double x) {
    double product = fabs(x) * 1e6;
    if (!(product < 1e15)) return put_slowly(out, x);
    int64_t k = (int64_t)product;
    double fraction = product - (double)k;
    if (fabs(fraction - 0.5) <= product * 0x1p-52) return put_slowly(out, x);
    k += fraction > 0.5;
    *out = '-';
    out += signbit(x) != 0;
    if (k < 10000000) {
        uint32_t small = (uint32_t)k, whole = small / 1000000;
        *out = (char)('0' + whole);
        return put_millionths(out + 1, small - 1000000 * whole);
    }
    return put_millionths(put_whole(out, (uint32_t)(k / 1000000)), (uint32_t)(k % 1000000));
}
