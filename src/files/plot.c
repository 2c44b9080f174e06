/* Line plots as a journal prints them: a frame with ticks that point inwards, faint lines across,
   the legend above the frame, where it can hide no curve. Ticks come from plot_axis; everything
   else is placed from the four edges of the frame. */
#include "files/plot.h"

#include <math.h>
#include <stdlib.h>

#include "files/output.h"
#include "files/svg.h"

/* Points: a plot with the margins of its frame, and letters. */
enum { WIDTH = 460, HEIGHT = 310, LEFT = 62, RIGHT = 18, TOP = 52, BOTTOM = 50, LABEL = 12, TITLE = 13 };
enum { X_TICKS = 10, Y_TICKS = 7 };

/* Dark enough for a photocopy; the dash is what tells series apart in print. */
static const char *const colours[PLOT_SERIES_MAX] = {"#000",    "#1c5a96", "#a33a1f", "#3c6e35",
                                                     "#6a4a8c", "#80661a", "#356f73", "#555"};
static const char *const dashes[PLOT_STYLES] = {"", " stroke-dasharray=\"6 3\"", " stroke-dasharray=\"1.5 2.5\"",
                                                " stroke-dasharray=\"8 3 1.5 3\""};

/* The least of 1, 2, 5 times a power of ten that covers `span` in `most` steps. */
static double nice_step(double span, int most) {
    double power = 1;
    while (power * most > span && power > 1e-300) power /= 10;
    while (power * 10 * most < span && power < 1e300) power *= 10;
    for (;; power *= 10)
        for (int k = 0; k < 3; k++) {
            static const double digit[] = {1, 2, 5};
            if (digit[k] * power * most >= span * (1 - 1e-9)) return digit[k] * power;
        }
}

PlotAxis plot_axis(double low, double high, bool whole, int most) {
    if (!(high > low)) high = low + (low != 0 ? fabs(low) : 1);
    int steps = most - 1;
    double step = nice_step(high - low, steps), first, last;
    for (int try = 0; try < 8; try++) { /* widening to whole steps may add one too many */
        if (whole && step < 1) step = 1;
        first = floor(low / step + 1e-9);
        last = ceil(high / step - 1e-9);
        if (last - first <= steps) break;
        step = nice_step(step * steps * 1.01, steps);
    }
    PlotAxis axis = {.low = first * step, .high = last * step, .first = first * step, .step = step};
    axis.ticks = (int)(last - first) + 1;
    double largest = fmax(fabs(axis.low), fabs(axis.high)), unit = 1;
    bool large = largest >= 1e5, small = largest < 0.1;
    for (; large && largest >= 1000 * unit; unit *= 1000) axis.exponent += 3;
    for (; small && largest < unit; unit /= 1000) axis.exponent -= 3;
    for (double s = step / unit; s < 1 - 1e-9 && axis.decimals < 9; s *= 10) axis.decimals++;
    return axis;
}

typedef struct {
    FILE *out;
    const Plot *plot;
    double left, right, top, bottom; /* of the frame, in the picture */
    PlotAxis x, y;
} Drawing;

static double place_x(const Drawing *d, double x) {
    return d->left + (x - d->x.low) / (d->x.high - d->x.low) * (d->right - d->left);
}

static double place_y(const Drawing *d, double y) {
    return d->bottom - (y - d->y.low) / (d->y.high - d->y.low) * (d->bottom - d->top);
}

/* Largest and smallest values; false where there is no point at all. */
static bool find_range(const Plot *plot, double low[2], double high[2], bool *whole) {
    bool any = false;
    *whole = true;
    for (int s = 0; s < plot->nseries; s++)
        for (int k = 0; k < plot->series[s].n; k++) {
            double p[2] = {plot->series[s].x[k], plot->series[s].y[k]};
            if (!isfinite(p[0]) || !isfinite(p[1])) continue;
            *whole = *whole && p[0] == floor(p[0]);
            for (int c = 0; c < 2; c++) {
                low[c] = any ? fmin(low[c], p[c]) : p[c];
                high[c] = any ? fmax(high[c], p[c]) : p[c];
            }
            any = true;
        }
    return any;
}

static void tick_text(const PlotAxis *axis, double value, char *out, size_t n) {
    double scaled = value;
    for (int k = axis->exponent; k > 0; k--) scaled /= 10;
    for (int k = axis->exponent; k < 0; k++) scaled *= 10;
    if (fabs(value) < 1e-6 * axis->step) scaled = 0; /* and not -0 */
    snprintf(out, n, "%.*f", axis->decimals, scaled);
}

/* "time (s)" or, where ticks leave out powers of ten, "time (s) × 10⁻³": multiply what you read. */
static void axis_text(const PlotAxis *axis, const char *label, char *out, size_t n) {
    static const char *const raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    int size = abs(axis->exponent);
    if (size == 0) {
        snprintf(out, n, "%s", label);
        return;
    }
    snprintf(out, n, "%s × 10%s%s%s%s", label, axis->exponent < 0 ? "⁻" : "", size >= 100 ? raised[size / 100] : "",
             size >= 10 ? raised[size / 10 % 10] : "", raised[size % 10]);
}

static double tick(const PlotAxis *axis, int k) { return axis->first + k * axis->step; }

/* The axis ends where the data ends, and has the ticks that lie between. */
static void axis_trim(PlotAxis *axis, double low, double high) {
    if (!(high > low)) return;
    double first = ceil(low / axis->step - 1e-9), last = floor(high / axis->step + 1e-9);
    axis->low = low;
    axis->high = high;
    axis->first = first * axis->step;
    axis->ticks = (int)(last - first) + 1;
}

/* Frame, ticks and the faint lines from side to side. */
static void draw_frame(const Drawing *d) {
    fputs("<path stroke=\"#ddd\" stroke-width=\".6\" d=\"", d->out);
    for (int k = 1; k < d->y.ticks - 1; k++) {
        fputc('M', d->out);
        svg_point(d->out, d->left, place_y(d, tick(&d->y, k)));
        fprintf(d->out, "H%.0f", d->right);
    }
    fputs("\"/>\n<path stroke=\"#000\" stroke-width=\".8\" d=\"", d->out);
    fprintf(d->out, "M%.0f %.0fH%.0fV%.0fH%.0fz", d->left, d->top, d->right, d->bottom, d->left);
    for (int k = 0; k < d->x.ticks; k++) {
        fputc('M', d->out);
        svg_point(d->out, place_x(d, tick(&d->x, k)), d->bottom);
        fputs("v-4", d->out);
    }
    for (int k = 0; k < d->y.ticks; k++) {
        fputc('M', d->out);
        svg_point(d->out, d->left, place_y(d, tick(&d->y, k)));
        fputs("h4", d->out);
    }
    fputs("\"/>\n", d->out);
}

static void draw_labels(const Drawing *d) {
    char text[256];
    for (int k = 0; k < d->x.ticks; k++) {
        tick_text(&d->x, tick(&d->x, k), text, sizeof text);
        svg_text(d->out, place_x(d, tick(&d->x, k)), d->bottom + 15, LABEL, SVG_MIDDLE, text);
    }
    for (int k = 0; k < d->y.ticks; k++) {
        tick_text(&d->y, tick(&d->y, k), text, sizeof text);
        svg_text(d->out, d->left - 5, place_y(d, tick(&d->y, k)) + 4, LABEL, SVG_END, text);
    }
    axis_text(&d->x, d->plot->x_label, text, sizeof text);
    svg_text(d->out, (d->left + d->right) / 2, d->bottom + 36, LABEL, SVG_MIDDLE, text);
    axis_text(&d->y, d->plot->y_label, text, sizeof text);
    svg_text_turned(d->out, d->left - 44, (d->top + d->bottom) / 2, LABEL, text);
}

static void begin_line(const Drawing *d, int number) {
    const PlotSeries *s = &d->plot->series[number];
    fprintf(d->out, "<path stroke=\"%s\" stroke-width=\"1.4\"%s d=\"", colours[number], dashes[s->style]);
}

/* A run of points on one column of tenths of a point shows no more than where it comes in, its
   range and where it leaves: a take of a hundred thousand frames stays a small picture. */
static void draw_series(const Drawing *d, int number) {
    const PlotSeries *s = &d->plot->series[number];
    bool pen_down = false;
    begin_line(d, number);
    for (int k = 0, next; k < s->n; k = next) {
        next = k + 1;
        if (!isfinite(s->x[k]) || !isfinite(s->y[k])) {
            pen_down = false;
            continue;
        }
        double x = place_x(d, s->x[k]), low = s->y[k], high = s->y[k], last = s->y[k];
        while (next < s->n && place_x(d, s->x[next]) < x + 0.1 && isfinite(s->y[next])) {
            last = s->y[next++];
            low = fmin(low, last);
            high = fmax(high, last);
        }
        fputc(pen_down ? 'L' : 'M', d->out);
        svg_point(d->out, x, place_y(d, s->y[k]));
        double other[3] = {low, high, last};
        for (int c = 0; next > k + 1 && c < 3; c++) {
            fputc('L', d->out);
            svg_point(d->out, x, place_y(d, other[c]));
        }
        pen_down = true;
    }
    fputs("\"/>\n", d->out);
}

static void draw_legend(const Drawing *d) {
    double at = d->right;
    for (int s = d->plot->nseries - 1; s >= 0; s--) {
        const char *name = d->plot->series[s].name;
        at -= svg_text_width(name, LABEL);
        svg_text(d->out, at, d->top - 9, LABEL, SVG_START, name);
        begin_line(d, s);
        fputc('M', d->out);
        svg_point(d->out, at - 32, d->top - 13);
        fputs("h27\"/>\n", d->out);
        at -= 44;
    }
}

static bool draw_plot(FILE *out, const Plot *plot, double left, Error *e) {
    double low[2] = {0}, high[2] = {0};
    bool whole;
    if (!find_range(plot, low, high, &whole))
        return error_set(e, ERR_INPUT, "nothing to plot: no value of '%s'", plot->title ? plot->title : plot->y_label);
    Drawing d = {.out = out, .plot = plot, .left = left + LEFT, .right = left + WIDTH - RIGHT};
    d.top = TOP;
    d.bottom = HEIGHT - BOTTOM;
    d.x = plot_axis(low[0], high[0], whole, X_TICKS);
    d.y = plot_axis(fmin(low[1], 0), high[1], false, Y_TICKS);
    axis_trim(&d.x, low[0], high[0]);
    draw_frame(&d);
    draw_labels(&d);
    for (int s = 0; s < plot->nseries; s++) draw_series(&d, s);
    draw_legend(&d);
    if (plot->title) svg_text(out, d.left, d.top - 32, TITLE, SVG_START, plot->title);
    return true;
}

bool plot_lines(const char *path, const Plot *plot, int count, Error *e) {
    Output output;
    bool good = true;
    if (!output_open(&output, path, e)) return false;
    svg_open(output.file, (double)count * WIDTH, HEIGHT, count && plot[0].title ? plot[0].title : "kitsuke");
    for (int k = 0; k < count && good; k++) good = draw_plot(output.file, &plot[k], (double)k * WIDTH, e);
    svg_close(output.file);
    if (good) return output_close(&output, e);
    output_abandon(&output);
    return false;
}
