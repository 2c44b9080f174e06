/* Line plots: ticks that a reader can count by, and files that a browser can read. */
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "files/plot.h"
#include "folder.h"
#include "tap.h"

/* Is x 1, 2 or 5 times a power of ten? */
static bool is_round(double x) {
    while (x >= 9.5) x /= 10;
    while (x < 0.95) x *= 10;
    return fabs(x - 1) < 1e-6 || fabs(x - 2) < 1e-6 || fabs(x - 5) < 1e-6;
}

static void test_axis(double low, double high, bool whole) {
    PlotAxis a = plot_axis(low, high, whole, 7);
    double span = a.high - a.low, slack = 1e-6 * span;
    OK(a.low <= low + slack && a.high >= high - slack, "axis over %g..%g covers it (%g..%g)", low, high, a.low, a.high);
    OK(is_round(a.step) && (!whole || a.step >= 1), "its step %g is round", a.step);
    OK(fabs(span / a.step - (a.ticks - 1)) < 1e-6 && a.ticks >= 2 && a.ticks <= 7, "it has %d ticks", a.ticks);
    OK(low == high || (a.low > low - a.step && a.high < high + a.step), "it is no wider than it must be");
    double unit = pow(10, a.exponent), shown = a.step / unit * pow(10, a.decimals);
    OK(a.exponent % 3 == 0 && fabs(shown - floor(shown + 0.5)) < 1e-6, "%d decimals show every tick", a.decimals);
}

static char *read_all(const char *path, Arena *arena) {
    Text text;
    Error e = {0};
    return text_read(path, 1 << 24, arena, &text, &e) ? (char *)text.data : NULL;
}

static int count(const char *text, const char *what) {
    int n = 0;
    for (const char *at = text; (at = strstr(at, what)); at += strlen(what)) n++;
    return n;
}

static void test_file(void) {
    enum { N = 40 };
    double x[N], many[N], few[N];
    for (int k = 0; k < N; k++) {
        x[k] = k + 1;
        many[k] = 2.7e6 + 1e5 * sin(k * 0.3);
        few[k] = 6e5 + 3e5 * sin(k * 0.2);
    }
    few[20] = NAN;
    PlotSeries series[] = {{"uniform", PLOT_SOLID, N, x, many}, {"adaptive <&>", PLOT_DASHED, N, x, few}};
    Plot plot[] = {{"(a) Intersection tests", "frame", "tests", 2, series},
                   {"(b) Time", "frame", "seconds", 1, series}};
    const char *path = in_folder("a.svg"), *again = in_folder("b.svg");
    Error e = {0};
    Arena arena = {0};
    OK(plot_lines(path, plot, 2, &e) && plot_lines(again, plot, 2, &e), "two plots in one file: %s", e.text);
    char *text = read_all(path, &arena), *second = read_all(again, &arena);
    OK(text && second && strcmp(text, second) == 0, "the same numbers give the same bytes");
    OK(strstr(text, "adaptive &lt;&amp;>"), "a name cannot break the file");
    OK(count(text, "stroke-dasharray=\"6 3\"") == 2, "dashed: the line and its sample in the legend");
    OK(strstr(text, "tests × 10⁶"), "powers of ten stand at the axis");
    const char *line = strstr(strstr(text, "adaptive"), "<path"), *curve = NULL;
    for (const char *at = text; (at = strstr(at, "stroke-dasharray")) && !curve; at++) curve = at;
    OK(line && curve && count(text, "nan") == 0 && count(text, "inf") == 0, "a gap leaves no number");
    int moves = 0;
    for (const char *at = strstr(curve, "d=\""); *at != '>'; at++) moves += *at == 'M';
    OK(moves == 2, "but a second stroke");
    plot[0].title = "caf\xe9 caf\xc3\xa9 \xe2\x82 \xed\xa0\x80 \xf0\x9f\x99\x82\xc3";
    OK(plot_lines(again, plot, 1, &e) && strstr(read_all(again, &arena), ">caf? caf\xc3\xa9 ?? ??? \xf0\x9f\x99\x82?<"),
       "bytes that are no characters become '?'");
    plot[1].nseries = 0;
    OK(!plot_lines(again, plot, 2, &e) && e.kind == ERR_INPUT, "no values are no plot: %s", e.text);
    OK(read_all(again, &arena), "and what was there stays");
    arena_free(&arena);
}

static void test_size(void) {
    enum { N = 200000 };
    double *x = malloc(N * sizeof *x), *y = malloc(N * sizeof *y);
    for (int k = 0; k < N; k++) x[k] = k, y[k] = k % 7 == 0 ? 5 : 0;
    PlotSeries series = {"spikes", PLOT_SOLID, N, x, y};
    Plot plot = {NULL, "frame", "value", 1, &series};
    const char *path = in_folder("long.svg");
    Error e = {0};
    Arena arena = {0};
    OK(plot_lines(path, &plot, 1, &e), "a plot of %d points", N);
    char *text = read_all(path, &arena);
    OK(text && strlen(text) < 300000, "is no large file: %zu bytes", text ? strlen(text) : 0);
    arena_free(&arena);
    free(x);
    free(y);
}

int main(void) {
    test_axis(0, 36, true);
    test_axis(1, 2, true);
    test_axis(0, 2.7e6, false);
    test_axis(-3.2, 17, false);
    test_axis(0, 0.00031, false);
    test_axis(99.9, 100.1, false);
    test_axis(5, 5, false);
    test_axis(0, 0, true);
    test_axis(0, 1e-200, false);
    test_axis(0, 9.99e99, false);
    if (!folder_make()) return 1;
    test_file();
    test_size();
    folder_remove();
    return tap_done();
}
