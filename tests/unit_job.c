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

static void ignore(void *context, int done, int total) {
    (void)context;
    (void)done;
    (void)total;
}

/* Dresses two frames with the fail-th allocation failing (0: none). */
static Error run(long fail, int *frames) {
    JobMemory memory = {.arena = {.fail_after = fail}};
    JobWatch watch = {ignore, NULL};
    SummaryRow rows[2] = {{0}};
    JobResult result = {.row = rows};
    Notes notes = {0};
    job_run(&wardrobe, &input, &watch, &memory, &notes, NULL, &result);
    job_memory_free(&memory);
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

static void test_every_allocation(void) {
    enum { MOST = 5000 };
    struct stat info;
    int frames = 0, unclean = 0, written = 0, told = 0;
    long n = 1;
    for (; n < MOST; n++) {
        Error e = run(n, &frames);
        if (e.kind == ERR_NONE) break;
        unclean += e.kind != ERR_INTERNAL || frames > 0;
        told += strstr(e.text, "memory") != NULL;
        written += stat(in_folder("walk/stats.csv"), &info) == 0 || stat(in_folder("walk/stats.csv.tmp"), &info) == 0;
    }
    OK(n > 20 && n < MOST, "%ld allocations, each failed once", n - 1);
    OK(unclean == 0, "each ends the job as an internal error before the first frame");
    OK(told == n - 1, "which says that it is memory");
    OK(written == 0, "and leaves no statistics");
    OK(frames == 2 && stat(in_folder("walk/stats.csv"), &info) == 0, "with all of them it is dressed");
}

static void test_repeated(void) {
    int frames;
    Error e = run(0, &frames);
    OK(e.kind == ERR_NONE && frames == 2, "a second run replaces the first");
    for (int i = 0; i < wardrobe.ngarments; i++) free(wardrobe.garment[i]);
}

int main(void) {
    if (!folder_make()) return 1;
    if (read_wardrobe()) test_every_allocation();
    test_repeated();
    folder_remove();
    return tap_done();
}
