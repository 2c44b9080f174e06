/* Whatever the bytes: a motion that is dressed from end to end, its numbers finite and its files
   whole, or one error with a reason and no record. The parts are garment, body, roles and motion;
   those that are empty or missing are the adult, no roles, and the smallest human. */
#include "app/job.h"

#include <math.h>

#include "human.h"
#include "parts.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static char folder[] = "/dev/shm/kitsuke-fuzz-XXXXXX"; /* a disk would be waited for in every run */

static void remove_folder(void) {
    char command[64];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    if (system(command) != 0) abort();
}

static void ignore(void *context) { (void)context; }

static const char *written(const char *name) {
    static char path[64];
    snprintf(path, sizeof path, "%s/motion/%s", folder, name);
    return path;
}

static bool is_written(const char *name) { return access(written(name), F_OK) == 0; }

static void check(const JobResult *r) {
    const SummaryRow *sum = r->row;
    if (r->error.kind) {
        bool is_ours = r->error.kind == ERR_OUTPUT || r->error.kind == ERR_INTERNAL;
        if (is_ours || !r->error.text[0] || is_written(RECORD_NAME)) abort();
        return;
    }
    if (!is_written(RECORD_NAME) || !is_written("stats.csv") || r->frames < 1) abort();
    if (!isfinite(sum->deepest) || !isfinite(sum->max_displacement)) abort();
}

static void dress(const Wardrobe *w, const char *motion, Arena *arena) {
    static Notes notes;
    Lane lane = {.arena = {0}};
    SummaryRow row = {0};
    JobResult result = {.row = &row};
    Input input = {.path = motion, .name = "motion"};
    Press press = {0};
    JobOrder order = {.wardrobe = w, .input = &input, .key = {1, 2}, .workers = 1, .press = &press};
    Job *job = NULL;
    notes.count = 0;
    remove(written(RECORD_NAME));
    if (job_open(&order, &lane, &notes, arena, &result, &job))
        for (int chunk = 0; chunk >= 0; chunk = job_take(job)) job_chunk(job, chunk, &lane, &(LaneWatch){ignore, NULL});
    if (job) job_close(job, NULL);
    check(&result);
    lane_free(&lane);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static Sheet garment, body, roles, motion;
    const char *garments[] = {garment.path};
    Arena arena = {0};
    Error e = {0};
    Wardrobe w;
    TextList one = {.count = 1, .item = garments};
    Settings s = {.garments = one, .output = folder, .frames = {1, 2, 1}, .detail = 2, .body_detail = 8};
    if (!garment.path[0]) {
        if (!mkdtemp(folder)) abort();
        atexit(remove_folder);
    }
    s.force = s.no_times = true;
    s.max_frames = 1000;
    s.max_joints = 200;
    s.formats = size % 8 ? FORMAT_NONE : FORMAT_OBJ;
    part_take(&data, &size, &garment);
    if (part_take(&data, &size, &body)) s.body = body.path;
    if (part_take(&data, &size, &roles)) s.roles = roles.path;
    if (!part_take(&data, &size, &motion)) sheet_write(&motion, human_bvh, sizeof human_bvh - 1);
    if (wardrobe_read(&s, &arena, &w, &e)) dress(&w, motion.path, &arena);
    else if (e.kind != ERR_INPUT || !e.text[0]) abort();
    arena_free(&arena);
    return 0;
}
