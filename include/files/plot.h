/* Line plots for print: black on white, told apart by dashes first and by colour second. */
#ifndef FILES_PLOT_H
#define FILES_PLOT_H

#include "base/error.h"

typedef enum { PLOT_SOLID, PLOT_DASHED, PLOT_DOTTED, PLOT_DASH_DOT, PLOT_STYLES } PlotStyle;

/* x grows from point to point. A value that is not finite leaves a gap in the line. */
typedef struct {
    const char *name;       /* for the legend */
    PlotStyle style;
    int n;
    const double *x, *y;
} PlotSeries;

/* Labels say what and in which unit: "time in tests (ms)". Powers of ten are added where they
   keep the numbers short. The y axis begins at zero unless values are negative. */
typedef struct {
    const char *title;      /* above the plot; may be NULL */
    const char *x_label, *y_label;
    int nseries;
    const PlotSeries *series;
} Plot;

enum { PLOT_SERIES_MAX = 8 }; /* of a plot: each has a colour of its own */

/* Writes `count` plots side by side as one SVG file, the same bytes for the same numbers. A plot
   without a single point is an error, never an empty picture: ERR_INPUT; ERR_OUTPUT. */
MUST_CHECK bool plot_lines(const char *path, const Plot *plot, int count, Error *e);

/* An axis over [low, high], widened to whole steps of 1, 2 or 5 times a power of ten. */
typedef struct {
    double low, high;   /* its ends */
    double first, step; /* ticks are first, first + step, ... */
    int ticks;
    int exponent;       /* labels are in units of 10^exponent, a multiple of 3 */
    int decimals;       /* digits behind the point that labels need */
} PlotAxis;

/* whole: only whole numbers make sense, as for frames. most: ticks wanted at most, at least 3. */
PlotAxis plot_axis(double low, double high, bool whole, int most);

#endif
