/* Test Anything Protocol for the unit programs: OK(condition, "what is %s", "true"). */
#ifndef TESTS_TAP_H
#define TESTS_TAP_H

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>

static int tap_count, tap_failures;

static inline bool tap_ok(bool good, const char *file, int line, const char *fmt, ...) {
    va_list args;
    tap_count++;
    if (!good) tap_failures++;
    printf("%s %d - ", good ? "ok" : "not ok", tap_count);
    va_start(args, fmt);
    vprintf(fmt, args);
    va_end(args);
    printf("\n");
    if (!good) printf("# failed at %s:%d\n", file, line);
    return good;
}

#define OK(good, ...) tap_ok((good), __FILE__, __LINE__, __VA_ARGS__)
/* |value - wanted| <= tolerance, and the numbers where it is not so. */
#define NEAR(value, wanted, tolerance, what) \
    tap_ok(fabs((value) - (wanted)) <= (tolerance), __FILE__, __LINE__, "%s (%.12g, wanted %.12g)", what, \
           (double)(value), (double)(wanted))
/* The larger, or smaller, of what was found before and x. Unlike fmax and fmin they keep a number that is none, so that
   no bound on what was found holds. */
static inline double max_of(double before, double x) { return isnan(before) || x <= before ? before : x; }
static inline double min_of(double before, double x) { return isnan(before) || x >= before ? before : x; }

#define SKIP(what, why) printf("ok %d - %s # SKIP %s\n", ++tap_count, what, why)

/* Prints the plan; return it from main. */
static inline int tap_done(void) {
    printf("1..%d\n", tap_count);
    return tap_failures ? 1 : 0;
}

#endif
