/* A single line on stderr, redrawn in place at most ten times a second and never wider than the
   terminal is at that moment. The cursor waits at the line's beginning: where a terminal that gets
   narrower breaks the line, the next drawing erases all of it. What remains is judged by weight
   (the sizes of the motion files), since their frames are not known before they are read. */
#include "app/progress.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "base/clock.h"

enum { WIDTH_DEFAULT = 80, WIDTH_MAX = 200 };

#define ERASE "\033[J" /* from the cursor on */

static bool is_terminal(void) {
    const char *kind = getenv("TERM");
    return isatty(STDERR_FILENO) && !(kind && strcmp(kind, "dumb") == 0);
}

void progress_start(Progress *p, const Settings *s, int motions, double weight) {
    *p = (Progress){.mode = (ProgressMode)s->progress, .motions = motions, .weight = weight > 0 ? weight : 1};
    if (p->mode == PROGRESS_AUTO) p->mode = !s->quiet && is_terminal() ? PROGRESS_ALWAYS : PROGRESS_NEVER;
    p->started = clock_seconds();
}

static int terminal_width(void) {
    struct winsize size;
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return WIDTH_DEFAULT;
    return size.ws_col < WIDTH_MAX ? size.ws_col : WIDTH_MAX;
}

/* "3:07" or "1:02:03" */
static void put_duration(char *out, size_t n, double seconds) {
    long s = seconds < 1e8 ? (long)(seconds + 0.5) : 100000000;
    if (s < 3600) snprintf(out, n, "%ld:%02ld", s / 60, s % 60);
    else snprintf(out, n, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
}

static void put(char *line, int most, const char *fmt, ...) PRINTF_LIKE(3, 4);

/* Adds a part to the line where there is room for all of it. */
static void put(char *line, int most, const char *fmt, ...) {
    char part[80];
    int used = (int)strlen(line), size = most + 1 - used;
    va_list args;
    va_start(args, fmt);
    int n = vsnprintf(part, sizeof part, fmt, args) + (used ? 2 : 0);
    va_end(args);
    if (n < size) snprintf(line + used, (size_t)size, "%s%s", used ? ", " : "", part);
}

/* What matters most comes first, since a narrow terminal shows no more. */
static void compose(const Progress *p, double under_way, double elapsed, int most, char line[WIDTH_MAX + 1]) {
    double part = (p->finished + under_way) / p->weight;
    char left[40];
    line[0] = 0;
    put(line, most, "%d/%d motions", p->done, p->motions);
    if (p->failed) put(line, most, "%d failed", p->failed);
    if (elapsed > 1 && part > 0.001) {
        put_duration(left, sizeof left, elapsed * (1 - part) / part);
        put(line, most, "%s left", left);
    }
    put(line, most, "%.0f frames/s", elapsed > 0 ? (double)p->frames / elapsed : 0);
}

/* For programs: what the line says, as numbers. */
static void print_json(const Progress *p, double part, double elapsed, bool is_last) {
    fprintf(stderr, "{\"motions\":%d,\"done\":%d,\"failed\":%d,\"frames\":%lld,\"seconds\":%.1f,", p->motions, p->done,
            p->failed, p->frames, elapsed);
    fprintf(stderr, "\"frames_per_second\":%.1f,\"part\":%.4f,\"finished\":%s}\n",
            elapsed > 0 ? (double)p->frames / elapsed : 0, part < 1 ? part : 1, is_last ? "true" : "false");
}

void progress_draw(Progress *p, double under_way) {
    char line[WIDTH_MAX + 1];
    double now = clock_seconds();
    if (p->mode == PROGRESS_NEVER || now - p->drawn < (p->mode == PROGRESS_JSON ? 1 : 0.1)) return;
    p->drawn = now;
    if (p->mode == PROGRESS_JSON) {
        print_json(p, (p->finished + under_way) / p->weight, now - p->started, false);
        return;
    }
    compose(p, under_way, now - p->started, terminal_width() - 1, line);
    fprintf(stderr, "\r" ERASE "%s\r", line);
    p->is_shown = true;
}

void progress_hide(Progress *p) {
    if (p->is_shown) fputs("\r" ERASE, stderr);
    p->is_shown = false;
    p->drawn = 0;
}

void progress_end(Progress *p) {
    progress_hide(p);
    if (p->mode == PROGRESS_JSON) print_json(p, p->finished / p->weight, clock_seconds() - p->started, true);
}
