/* A single line on stderr, redrawn in place at most ten times a second and never wider than the
   terminal is at that moment, so that resizing it leaves no trail. What remains is judged by
   weight (the sizes of the motion files), since their frames are not known before they are read. */
#include "app/progress.h"

#include <stdio.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "base/clock.h"

enum { WIDTH_DEFAULT = 80, WIDTH_MAX = 200 };

void progress_start(Progress *p, const Settings *s, int motions, double weight) {
    *p = (Progress){.mode = (ProgressMode)s->progress, .motions = motions, .weight = weight > 0 ? weight : 1};
    if (p->mode == PROGRESS_AUTO) p->mode = !s->quiet && isatty(STDERR_FILENO) ? PROGRESS_ALWAYS : PROGRESS_NEVER;
    p->started = clock_seconds();
}

static int terminal_width(void) {
    struct winsize size;
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return WIDTH_DEFAULT;
    return size.ws_col < WIDTH_MAX ? size.ws_col : WIDTH_MAX;
}

/* "3:07" or "1:02:03" */
static int put_duration(char *out, size_t n, double seconds) {
    long s = seconds < 1e8 ? (long)(seconds + 0.5) : 100000000;
    if (s < 3600) return snprintf(out, n, "%ld:%02ld", s / 60, s % 60);
    return snprintf(out, n, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
}

static void compose(const Progress *p, double under_way, double elapsed, char *out, size_t n) {
    double part = (p->finished + under_way) / p->weight, rate = elapsed > 0 ? (double)p->frames / elapsed : 0;
    size_t k = (size_t)snprintf(out, n, "%d/%d motions, %.0f frames/s", p->done, p->motions, rate);
    if (p->failed && k < n) k += (size_t)snprintf(out + k, n - k, ", %d failed", p->failed);
    if (elapsed > 1 && part > 0.001 && k + 2 < n) {
        k += (size_t)snprintf(out + k, n - k, ", ");
        k += (size_t)put_duration(out + k, n - k, elapsed * (1 - part) / part);
        if (k < n) snprintf(out + k, n - k, " left");
    }
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
    compose(p, under_way, now - p->started, line, sizeof line);
    int most = terminal_width() - 1, before = p->shown < most ? p->shown : most;
    p->shown = fprintf(stderr, "\r%.*s", most, line) - 1;
    if (before > p->shown) fprintf(stderr, "%*s", before - p->shown, ""); /* what is left of a longer one */
    fflush(stderr);
}

void progress_hide(Progress *p) {
    if (p->mode != PROGRESS_ALWAYS) return;
    int most = terminal_width() - 1, n = p->shown < most ? p->shown : most;
    if (n > 0) fprintf(stderr, "\r%*s\r", n, "");
    p->shown = 0;
    p->drawn = 0;
}

void progress_end(Progress *p) {
    progress_hide(p);
    if (p->mode == PROGRESS_JSON) print_json(p, p->finished / p->weight, clock_seconds() - p->started, true);
}
