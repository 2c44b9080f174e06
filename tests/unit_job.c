/* One motion from end to end where every allocation fails once: a clean error, nothing written. */
#include "app/job.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "folder.h"
#include "tap.h"

static Wardrobe wardrobe;
static Settings settings;
static Input input = {.path = "motions/paper-walk.bvh", .name = "walk"};

static void ignore(void *context) { (void)context; }

/* Dresses two frames; of the job's allocations, or of the lane's, the fail-th one fails (0: none). */
static Error run(long fail, bool in_lane, int *frames) {
    Arena arena = {.fail_after = in_lane ? 0 : fail};
    Lane lane = {.arena = {.fail_after = in_lane ? fail : 0}};
    LaneWatch watch = {ignore, NULL};
    SummaryRow rows[2] = {{0}};
    JobResult result = {.row = rows};
    JobOrder order = {.wardrobe = &wardrobe, .input = &input, .key = {1, 2}, .workers = 1};
    Notes notes = {0};
    Job *job = NULL;
    if (job_open(&order, &lane, &notes, &arena, &result, &job))
        for (int chunk; (chunk = job_take(job)) >= 0;) job_chunk(job, chunk, &lane, &watch);
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

static void test_repeated(void) {
    int frames;
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
    test_repeated();
    folder_remove();
    return tap_done();
}
