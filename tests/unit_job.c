/* One motion from end to end where every allocation fails once: a clean error, nothing written. And
   threads that help each other out. */
#include "app/job.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "folder.h"
#include "motion/gait.h"
#include "tap.h"

static Wardrobe wardrobe;
static Settings settings;
static Press press; /* without places: everybody writes his own */
static Input input = {.path = "motions/paper-walk.bvh", .name = "walk"};

static void ignore(void *context) { (void)context; }

/* Dresses two frames; of the job's allocations, or of the lane's, the fail-th one fails (0: none). */
static Error run(long fail, bool in_lane, int *frames) {
    Arena arena = {.fail_after = in_lane ? 0 : fail};
    Lane lane = {.arena = {.fail_after = in_lane ? fail : 0}};
    LaneWatch watch = {ignore, NULL};
    SummaryRow rows[2] = {{0}};
    JobResult result = {.row = rows};
    JobOrder order = {.wardrobe = &wardrobe, .input = &input, .key = {1, 2}, .workers = 1, .press = &press};
    Notes notes = {0};
    Job *job = NULL;
    if (job_open(&order, &lane, &notes, &arena, &result, &job))
        for (int chunk = 0; chunk >= 0; chunk = job_take(job)) job_chunk(job, chunk, &lane, &watch);
    if (job) job_close(job, NULL);
    lane_free(&lane);
    arena_free(&arena);
    *frames = result.frames;
    return result.error;
}

static bool read_wardrobe(void) {
    static const char *const paths[] = {"garments/skirt.garment", "garments/trousers.garment"};
    static Garment *garment[2];
    Arena scratch = {0};
    Error e = {0};
    bool good = true;
    for (int g = 0; g < 2; g++) {
        garment[g] = calloc(1, sizeof *garment[g]);
        good = good && garment[g] && garment_read(paths[g], &scratch, garment[g], &e);
    }
    if (!good) error_print(&e, stdout);
    arena_free(&scratch);
    settings = (Settings){.output = folder, .formats = FORMAT_NONE, .frames = {1, 2, 1}, .detail = 2, .body_detail = 8};
    wardrobe = (Wardrobe){.settings = &settings, .body = *body_default(), .ngarments = 2, .garment = garment};
    return good;
}

static bool is_there(const char *name) {
    struct stat info;
    return stat(in_folder(name), &info) == 0;
}

static void test_every_allocation(bool in_lane) {
    enum { MOST = 5000 };
    int frames = 0, unclean = 0, written = 0, told = 0;
    long n = 1;
    for (; n < MOST; n++) {
        Error e = run(n, in_lane, &frames);
        if (e.kind == ERR_NONE) break;
        unclean += e.kind != ERR_INTERNAL;
        told += strstr(e.text, "memory") != NULL;
        written += is_there("walk/stats.csv") || is_there("walk/stats.csv.tmp");
        if (is_there("walk/stats.csv")) remove(in_folder("walk/stats.csv"));
        written += is_there("walk/.done");
    }
    OK(n > 15 && n < MOST, "%ld allocations of %s, each failed once", n - 1, in_lane ? "the lane" : "the job");
    OK(unclean == 0, "each ends the job as an internal error");
    OK(told == n - 1, "which says that it is memory");
    OK(written <= !in_lane, "and leaves no record, nor statistics but where only the record is missing");
    OK(frames == 2 && is_there("walk/stats.csv") && is_there("walk/.done"), "with all of them it is dressed");
    remove(in_folder("walk/stats.csv"));
    remove(in_folder("walk/.done"));
}

typedef struct { JobOrder order; Lane lane; Arena arena; Notes notes; JobResult result; Job *job; } Opened;

static bool open_one(Opened *o, const Input *of, SummaryRow *rows) {
    *o = (Opened){.order = {.wardrobe = &wardrobe, .input = of, .key = {1, 2}, .workers = 2, .press = &press},
                  .result = {.row = rows}};
    return job_open(&o->order, &o->lane, &o->notes, &o->arena, &o->result, &o->job);
}

static void close_one(Opened *o) {
    if (o->job) job_close(o->job, NULL);
    lane_free(&o->lane);
    arena_free(&o->arena);
}

/* Makes a motion of 480 frames, which is two chunks. */
static bool make_long(const char *path) {
    Gait gait;
    Error e = {0};
    Output out;
    gait_defaults(&gait);
    gait.preset = "paper";
    gait.frames_per_step = 8;
    gait.steps = 60;
    return output_open(&out, path, &e) && gait_write(&gait, out.file, &e) && output_close(&out, &e);
}

/* A thread has read a motion and got ready for it, but nothing came of it (here its folder cannot be
   made); then it helps with a chunk of another motion. */
static void test_help(void) {
    char path[256];
    Input lost = {.path = input.path, .name = "long.bvh/none"}, long_one = {.path = path, .name = "long"};
    Opened a, b;
    SummaryRow rows[2][2] = {{{0}}};
    LaneWatch watch = {ignore, NULL};
    snprintf(path, sizeof path, "%s", in_folder("long.bvh"));
    settings.frames = (FrameSpan){.step = 8};
    bool good = make_long(path) && !open_one(&a, &lost, rows[0]) && a.result.error.kind == ERR_OUTPUT &&
                open_one(&b, &long_one, rows[1]);
    OK(good, "a motion whose folder cannot be made, and a long one that is open");
    if (good) {
        int second = job_take(b.job);
        job_chunk(b.job, second, &a.lane, &watch);
        job_chunk(b.job, 0, &b.lane, &watch);
        OK(second == 1 && job_is_over(b.job), "it has two chunks, and each thread dresses one");
    }
    close_one(&a);
    close_one(&b);
    OK(b.result.error.kind == ERR_NONE && b.result.frames == 60, "whole: %d frames %s", b.result.frames,
       b.result.error.text);
}

static void test_repeated(void) {
    int frames;
    settings.frames = (FrameSpan){1, 2, 1};
    Error e = run(0, false, &frames);
    OK(e.kind == ERR_NONE && frames == 2, "a second run replaces the first");
    for (int i = 0; i < wardrobe.ngarments; i++) free(wardrobe.garment[i]);
}

int main(void) {
    if (!folder_make()) return 1;
    if (read_wardrobe()) {
        test_every_allocation(false);
        test_every_allocation(true);
    }
    test_help();
    test_repeated();
    folder_remove();
    return tap_done();
}
