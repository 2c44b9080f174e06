/* Frames chosen, frames between frames, and jumps that neither may hide. */
#include "app/take.h"

#include <stdlib.h>
#include <string.h>

#include "folder.h"
#include "tap.h"

enum { FRAMES = 48, CHANNELS_MAX = 128 };

typedef struct {
    Arena arena;
    Motion motion;
    Figure figure;
    Take *take;
    bool good;
} Scene;

/* Changes the values of one row; frame from 1. */
typedef void Change(int frame, double *value, int n);

static void change_row(const char *line, int frame, Change *change, FILE *out) {
    double value[CHANNELS_MAX];
    const char *end = line + strlen(line);
    int n = 0;
    while (n < CHANNELS_MAX && (line = text_number(line, end, &value[n]))) {
        line += *line == ' ';
        n++;
    }
    change(frame, value, n);
    for (int i = 0; i < n; i++) fprintf(out, "%.6f ", value[i]);
    fputc('\n', out);
}

/* Writes the walk of the paper, every row given to `change` if there is one; returns the path. */
static const char *write_walk(const char *name, int steps, Change *change) {
    char line[4096];
    const char *path = in_folder(name);
    FILE *plain = tmpfile(), *out = fopen(path, "w");
    Gait gait;
    Error e = {0};
    gait_defaults(&gait);
    gait.preset = "paper";
    gait.frames_per_step = 24;
    gait.steps = steps;
    if (!plain || !out || !gait_write(&gait, plain, &e)) exit(1);
    rewind(plain);
    for (int frame = 0; fgets(line, sizeof line, plain);) {
        if (frame && change) change_row(line, frame, change, out);
        else fputs(line, out);
        frame += frame || strncmp(line, "Frame Time", 10) == 0;
    }
    fclose(plain);
    fclose(out);
    return path;
}

static Scene open_scene(const char *path, Error *e) {
    Scene s = {0};
    MotionOptions plain = {0};
    FigureOptions found = {0};
    Roles roles;
    s.good = motion_open(path, &plain, &s.arena, NULL, &s.motion, e) &&
             roles_read(&s.motion, NULL, &s.arena, NULL, &roles, e) &&
             figure_build(&s.motion, &roles, &found, &s.arena, NULL, &s.figure, e);
    return s;
}

/* The take keeps pointers into the scene, so it is opened where the scene stays. */
static void open_take(Scene *s, const char *path, FrameSpan span, double rate) {
    Error e = {0};
    *s = open_scene(path, &e);
    s->good = s->good && take_open(&s->motion, &s->figure, &span, rate, &s->arena, &s->take, &e);
    if (!s->good) error_print(&e, stdout);
}

static void close_scene(Scene *s) {
    take_close(s->take);
    motion_close(&s->motion);
    arena_free(&s->arena);
}

/* All frames of a take; the caller frees them. */
static TakeFrame *all_frames(const char *path, FrameSpan span, double rate, int *n) {
    Scene s;
    Error e = {0};
    open_take(&s, path, span, rate);
    int count = s.good ? take_count(s.take) : 0;
    TakeFrame *frames = calloc((size_t)count + 1, sizeof *frames);
    *n = 0;
    while (frames && s.good && *n <= count && take_next(s.take, &frames[*n], &e)) (*n)++;
    OK(*n == count && e.kind == ERR_NONE, "as many frames as were announced: %d", count);
    close_scene(&s);
    return frames;
}

/* The largest distance between places of bones in two poses, metres. */
static double apart(const char *path, const Pose *a, const Pose *b) {
    Error e = {0};
    Scene s = open_scene(path, &e);
    double most = 0;
    for (int r = 0; r < ROLE_COUNT; r++)
        most = max_of(most, vec_dist(rigid_apply(a->bone[r], s.figure.end[r]),
                                     rigid_apply(b->bone[r], s.figure.end[r])));
    close_scene(&s);
    return most;
}

static void test_spans(const char *path) {
    int n;
    TakeFrame *f = all_frames(path, (FrameSpan){3, 20, 4}, 0, &n);
    OK(n == 5 && f[0].number == 3 && f[4].number == 19, "3:20:4 is 3, 7, 11, 15, 19");
    NEAR(f[1].time, 6 * (f[1].dt / 4), 1e-12, "time counts from the motion's first frame");
    OK(f[0].tie == TIE_AFRESH && f[0].dt == 0 && f[1].tie == TIE_GOES_ON, "the first of a take starts afresh");
    free(f);
    f = all_frames(path, (FrameSpan){FRAMES, 0, 0}, 0, &n);
    OK(n == 1 && f[0].number == FRAMES, "the last frame alone");
    free(f);
    f = all_frames(path, (FrameSpan){1, 2000000000, 2000000000}, 0, &n);
    OK(n == 1 && f[0].number == 1, "a huge step does not overflow");
    free(f);
    Error e = {0};
    Scene s = open_scene(path, &e);
    FrameSpan late = {FRAMES + 1, 0, 0};
    bool opened = take_open(&s.motion, &s.figure, &late, 0, &s.arena, &s.take, &e);
    OK(!opened && e.kind == ERR_USAGE, "behind the end is refused");
    close_scene(&s);
}

static void test_rates(const char *path) {
    int n, twice;
    TakeFrame *f = all_frames(path, (FrameSpan){0}, 0, &n);
    double rate = 1 / f[1].time;
    TakeFrame *same = all_frames(path, (FrameSpan){0}, rate, &twice);
    OK(twice == n, "its own rate: as many frames");
    double most = 0;
    for (int i = 0; i < n; i++) most = max_of(most, apart(path, &f[i].pose, &same[i].pose));
    NEAR(most, 0, 0, "which are the same");
    free(same);
    TakeFrame *g = all_frames(path, (FrameSpan){0}, 2 * rate, &twice);
    OK(twice == 2 * n - 1, "twice the rate: twice as many less one");
    double between = 0, step = 0;
    most = 0;
    for (int i = 0; i < n; i++) most = max_of(most, apart(path, &f[i].pose, &g[2 * i].pose));
    for (int i = 0; i + 1 < n; i++) {
        step = apart(path, &f[i].pose, &f[i + 1].pose);
        double a = apart(path, &f[i].pose, &g[2 * i + 1].pose), b = apart(path, &g[2 * i + 1].pose, &f[i + 1].pose);
        between = max_of(between, max_of(a, b) / step);
    }
    NEAR(most, 0, 0, "every other one is the source's own");
    OK(between < 0.6, "those between lie half-way (%.3f of the step at most)", between);
    free(f);
    free(g);
}

static void wrap(int frame, double *value, int n) {
    for (int i = 3; frame % 2 && i < n; i++) value[i] += i % 3 ? 360 : -720;
}

static void test_wrapped_angles(const char *path) {
    int n, m;
    double rate = 0, most = 0;
    TakeFrame *f = all_frames(path, (FrameSpan){0}, 0, &n);
    rate = 3 / f[1].time;
    free(f);
    f = all_frames(path, (FrameSpan){0}, rate, &n);
    TakeFrame *g = all_frames(write_walk("wrapped.bvh", 2, wrap), (FrameSpan){0}, rate, &m);
    for (int i = 0; i < n && i < m; i++) most = max_of(most, apart(path, &f[i].pose, &g[i].pose));
    NEAR(most, 0, 1e-9, "angles that jump by 360 degrees are the same angles");
    free(f);
    free(g);
}

/* A rest pose in front, and from frame 21 on everything 3 m aside. */
static void spoil(int frame, double *value, int n) {
    if (frame == 1)
        for (int i = 3; i < n; i++) value[i] = 0;
    if (frame > 20) value[0] += 300;
}

static void test_jumps(void) {
    const char *path = write_walk("jumps.bvh", 2, spoil);
    int n, wrong = 0;
    TakeFrame *f = all_frames(path, (FrameSpan){0}, 0, &n);
    for (int i = 0; i < n; i++) wrong += (f[i].tie == TIE_AFRESH) != (i <= 1 || i == 20);
    OK(wrong == 0, "a rest pose in front and a teleport make frames 2 and 21 start afresh, and no other");
    double rate = 4 / f[1].time;
    free(f);
    f = all_frames(path, (FrameSpan){1, 0, 7}, 0, &n);
    OK(f[1].tie && !f[2].tie && f[3].tie && !f[4].tie, "also where the frames themselves are left out");
    free(f);
    f = all_frames(path, (FrameSpan){0}, rate, &n);
    NEAR(apart(path, &f[76].pose, &f[79].pose), 0, 1e-9, "nothing is interpolated across a teleport");
    OK(apart(path, &f[79].pose, &f[80].pose) > 2.9, "which happens at its frame");
    for (int i = wrong = 0; i < n; i++) wrong += (f[i].tie == TIE_AFRESH) != (i == 0 || i == 4 || i == 80);
    OK(wrong == 0, "resampled frames start afresh behind it");
    free(f);
    Notes notes = {0};
    Scene s;
    Error e = {0};
    TakeFrame frame;
    open_take(&s, path, (FrameSpan){0}, 0);
    while (take_next(s.take, &frame, &e)) continue;
    take_notes(s.take, &notes);
    OK(notes.count == 2 && strstr(notes.note[0].text, "frame 1 stands apart"), "the rest pose is told");
    OK(notes.count == 2 && strstr(notes.note[1].text, "at frame 21"), "the teleport is told");
    close_scene(&s);
}

/* Frames 21 and 22 stand 3 m aside; behind them all is as it was. */
static void lead_astray(int frame, double *value, int n) {
    if (n > 0 && (frame == 21 || frame == 22)) value[0] += 300;
}

static void test_astray(void) {
    const char *path = write_walk("astray.bvh", 2, lead_astray);
    int n, wrong = 0;
    TakeFrame *f = all_frames(path, (FrameSpan){0}, 0, &n);
    double frame_time = f[1].time;
    for (int i = 1; i < n; i++) wrong += f[i].tie != (i == 20 || i == 21 ? TIE_ASTRAY : TIE_GOES_ON);
    OK(wrong == 0, "frames that the motion leaves at once are astray, and no other starts afresh");
    NEAR(f[22].dt, 3 * frame_time, 1e-12, "time behind them counts from the frame in front");
    free(f);
    f = all_frames(path, (FrameSpan){1, 0, 7}, 0, &n);
    OK(f[3].tie == TIE_ASTRAY && f[4].tie == TIE_GOES_ON, "also where frames are left out");
    free(f);
    f = all_frames(path, (FrameSpan){2, 0, 7}, 0, &n);
    for (int i = wrong = 1; i < n; i++) wrong += f[i].tie != TIE_GOES_ON;
    OK(wrong == 1, "left out themselves they leave no trace");
    free(f);
}

/* The same, and from frame 16 on everything another 3 m aside. */
static void lead_astray_behind_a_jump(int frame, double *value, int n) {
    lead_astray(frame, value, n);
    if (frame > 15) value[0] += 300;
}

static void test_astray_behind_a_jump(void) {
    const char *path = write_walk("both.bvh", 2, lead_astray_behind_a_jump);
    const int chosen[] = {1, 15, 22, 29, 30};
    int n;
    TakeFrame *f = all_frames(path, (FrameSpan){1, 0, 7}, 0, &n), frame;
    OK(f[3].tie == TIE_ASTRAY && f[4].tie == TIE_AFRESH, "what is astray does not forget the jump in front of it");
    free(f);
    f = all_frames(path, (FrameSpan){0}, 0, &n);
    Scene s;
    Error e = {0};
    bool good = true;
    open_take(&s, path, (FrameSpan){1, 30, 1}, 0);
    for (int i = 0; i < 5; i++) {
        const TakeFrame *same = &f[chosen[i] - 1];
        Tie tie = i == 0 || i == 3 ? TIE_AFRESH : i == 2 ? TIE_ASTRAY : TIE_GOES_ON;
        int before = i == 3 ? 1 : i - 1; /* what is astray does not count */
        take_leap(s.take, chosen[i]);
        good = good && take_next(s.take, &frame, &e) && frame.number == same->number && frame.time == same->time &&
               frame.tie == tie && memcmp(&frame.pose, &same->pose, sizeof frame.pose) == 0 &&
               fabs(frame.dt - (i ? (chosen[i] - chosen[before]) * f[1].time : 0)) < 1e-12;
    }
    OK(good && !take_next(s.take, &frame, &e), "nor is it where frames are leapt over one by one");
    free(f);
    close_scene(&s);
}

static size_t memory_of(const char *path) {
    Scene s;
    Error e = {0};
    TakeFrame frame;
    open_take(&s, path, (FrameSpan){0}, 0);
    size_t before = s.arena.used;
    while (take_next(s.take, &frame, &e)) continue;
    OK(s.arena.used == before, "frames take no memory");
    size_t used = s.arena.held;
    close_scene(&s);
    return used;
}

static void test_memory(void) {
    size_t small = memory_of(write_walk("short.bvh", 20, NULL)), large = memory_of(write_walk("long.bvh", 400, NULL));
    OK(large == small, "20 times as many frames take %zu kB, as few do", large >> 10);
}

int main(void) {
    if (!folder_make()) return 1;
    static char path[256];
    snprintf(path, sizeof path, "%s", write_walk("walk.bvh", 2, NULL));
    test_spans(path);
    test_rates(path);
    test_wrapped_angles(path);
    test_jumps();
    test_astray();
    test_astray_behind_a_jump();
    test_memory();
    folder_remove();
    return tap_done();
}
