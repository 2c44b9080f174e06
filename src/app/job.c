/* One motion from end to end: opened by one thread, dressed by as many as come, closed by the last.

   Opening comes first: the motion, which joint is which bone, the figure, the body and the garments
   fitted to it; only when all of that is good is the output touched. Then the frames, in chunks (see
   lane.c). Chunks may finish in any order; their rows wait until all before them are written, so that
   stats.csv reads as if one thread had done it all. No more chunks are given out than there are places
   to wait, which bounds the memory. At last, when everything is on the disk, comes the record that says
   so. */
#include "app/job.h"

#include <pthread.h>

#include "app/folder.h"
#include "base/clock.h"
#include "files/lock.h"

typedef struct { ChunkResult result; bool is_done; } Berth; /* where the rows of chunk i wait: i % nberths */

struct Job {
    JobOrder order;
    const Settings *settings;
    Arena *arena;
    Notes *notes;
    Wearer wearer;
    LaneWork work;
    Chunks chunks;
    int frames;
    Lock lock;
    StatsFile stats;
    bool stats_is_open;
    char folder[OUTPUT_PATH_MAX];
    pthread_mutex_t guard; /* guards what follows */
    JobResult *result;
    Jumps jumps;
    double whole;          /* seconds of all threads */
    int nberths;
    Berth *berth;
    int taken, finished, written; /* chunks; written: also those that an error before them has made void */
    bool has_failed, is_over;
};

static bool plan(Job *j, Error *e) {
    const Settings *s = j->settings;
    const Motion *m = &j->wearer.motion;
    FrameSpan span;
    if (!take_span(m, &s->frames, s->rate, &span, e)) return false;
    j->chunks = chunks_plan(&span, s->rate > 0 ? s->rate : 1 / m->frame_time, take_length(m, s->rate));
    j->frames = (span.last - span.first) / span.step + 1;
    return true;
}

/* Places for the rows of chunks that wait for an earlier one. */
static bool make_berths(Job *j, Error *e) {
    int n = j->order.wardrobe->ngarments, most = chunks_most(&j->chunks);
    j->nberths = j->order.workers > 1 ? j->order.workers + 1 : 1;
    if (j->nberths > j->chunks.count) j->nberths = j->chunks.count;
    j->berth = ARENA_NEW(j->arena, Berth, j->nberths, e);
    for (int i = 0; j->berth && i < j->nberths; i++) {
        ChunkResult *r = &j->berth[i].result;
        r->row = ARENA_NEW(j->arena, StatsRow, (size_t)most * (size_t)n, e);
        r->bytes = ARENA_NEW(j->arena, long long, n, e);
        r->seconds = ARENA_NEW(j->arena, double, n, e);
        if (!r->row || !r->bytes || !r->seconds) return false;
    }
    return j->berth != NULL;
}

static bool open_motion(Job *j, Lane *lane, Error *e) {
    const Input *input = j->order.input;
    if (input->is_empty) return error_set(e, ERR_INPUT, "no motion (.bvh or .amc) in the folder '%s'", input->path);
    return wearer_open(j->order.wardrobe, input->path, j->work.unit, j->arena, j->notes, &j->wearer, e) &&
           plan(j, e) && make_berths(j, e) && lane_open(lane, &j->work, e);
}

static bool open_output(Job *j, Error *e) {
    const Settings *s = j->settings;
    char path[OUTPUT_PATH_MAX + 16];
    if (snprintf(j->folder, sizeof j->folder, "%s/%s", s->output, j->order.input->name) >= (int)sizeof j->folder)
        return error_set(e, ERR_OUTPUT, "the name of the folder for '%s' is too long", j->order.input->path);
    if (!output_folder(j->folder, e) || !lock_folder(&j->lock, j->folder, e)) return false;
    if ((s->force || s->resume) && !folder_clear(j->folder, e)) return false;
    snprintf(path, sizeof path, "%s/stats.csv", j->folder);
    j->stats_is_open = stats_open(&j->stats, path, TABLE_STATS, !s->no_times, e);
    return j->stats_is_open;
}

bool job_open(const JobOrder *order, Lane *lane, Notes *notes, Arena *arena, JobResult *out, Job **job) {
    double since = clock_seconds();
    Job *j = *job = ARENA_NEW(arena, Job, 1, &out->error);
    if (!j) return false;
    *j = (Job){.order = *order, .settings = order->wardrobe->settings, .arena = arena, .notes = notes, .result = out};
    j->work = (LaneWork){.wardrobe = order->wardrobe, .wearer = &j->wearer, .folder = j->folder};
    j->work.press = order->press;
    j->work.unit = j->settings->output_unit > 0 ? 1 / j->settings->output_unit : 1;
    pthread_mutex_init(&j->guard, NULL);
    j->has_failed = !open_motion(j, lane, &out->error) || !open_output(j, &out->error);
    j->taken = !j->has_failed;
    j->whole = out->seconds[STAGE_OPEN] = clock_lap(&since);
    return !j->has_failed;
}

int job_frames(const Job *j) { return j->frames; }

int job_take(Job *j) {
    int chunk = -1;
    pthread_mutex_lock(&j->guard);
    if (!j->has_failed && j->taken < j->chunks.count && j->taken < j->written + j->nberths) chunk = j->taken++;
    pthread_mutex_unlock(&j->guard);
    return chunk;
}

static void count_seconds(JobResult *result, const StatsRow *row) {
    result->seconds[STAGE_POSE] += row->pose_s;
    result->seconds[STAGE_GLOBAL] += row->stats.global_s;
    result->seconds[STAGE_TEST] += row->stats.test_s;
    result->seconds[STAGE_PUSH] += row->stats.push_s;
    result->seconds[STAGE_MESH] += row->stats.mesh_s;
    result->seconds[STAGE_WRITE] += row->write_s;
}

/* Adds a chunk to the statistics of the motion. */
static bool write_chunk(Job *j, const ChunkResult *r, Error *e) {
    int n = j->order.wardrobe->ngarments;
    for (int i = 0; i < r->nrows; i++) {
        summary_add(&j->result->row[i % n], &r->row[i]);
        count_seconds(j->result, &r->row[i]);
        if (!stats_add(&j->stats, &r->row[i], e)) return false;
    }
    for (int g = 0; g < n; g++) {
        j->result->row[g].bytes += r->bytes[g];
        j->result->row[g].seconds += r->seconds[g];
    }
    j->result->bytes += r->body_bytes;
    j->result->frames += r->frames;
    j->result->residual_frames += r->residual_frames;
    j->result->limb_frames += r->limb_frames;
    jumps_append(&j->jumps, &r->jumps);
    return true;
}

/* Writes what is next and whatever has waited for it. Behind an error nothing is written. */
static void deliver(Job *j) {
    Error *e = &j->result->error;
    for (Berth *b; j->written < j->taken && (b = &j->berth[j->written % j->nberths])->is_done; j->written++) {
        if (e->kind == ERR_NONE && write_chunk(j, &b->result, e)) *e = b->result.error;
        b->is_done = false;
    }
    j->has_failed = j->has_failed || e->kind != ERR_NONE;
}

static void clear(ChunkResult *r, int ngarments) {
    r->nrows = r->frames = r->residual_frames = r->limb_frames = 0;
    r->body_bytes = 0;
    r->helped = 0;
    r->jumps = (Jumps){0};
    r->error = (Error){0};
    for (int g = 0; g < ngarments; g++) {
        r->bytes[g] = 0;
        r->seconds[g] = 0;
    }
}

/* For chunk 0 the lane is open: whether garments fit is known before a folder is made. */
static void dress(Job *j, int chunk, Lane *lane, const LaneWatch *watch, ChunkResult *out) {
    Chunk c = chunks_get(&j->chunks, chunk);
    clear(out, j->order.wardrobe->ngarments);
    if (c.count == 0 || (chunk > 0 && !lane_open(lane, &j->work, &out->error))) return;
    lane_run(lane, &j->work, &c, watch, out);
    if (out->error.kind == ERR_NONE && out->frames != c.count)
        error_set(&out->error, ERR_INTERNAL, "%d frames of chunk %d were dressed, not %d", out->frames, chunk, c.count);
}

void job_chunk(Job *j, int chunk, Lane *lane, const LaneWatch *watch) {
    double since = clock_seconds();
    Berth *b = &j->berth[chunk % j->nberths];
    dress(j, chunk, lane, watch, &b->result);
    pthread_mutex_lock(&j->guard);
    j->whole += clock_lap(&since) + b->result.helped;
    j->finished++;
    j->has_failed = j->has_failed || b->result.error.kind != ERR_NONE;
    b->is_done = true;
    deliver(j);
    pthread_mutex_unlock(&j->guard);
}

bool job_is_over(Job *j) {
    pthread_mutex_lock(&j->guard);
    bool now = !j->is_over && j->finished == j->taken && (j->has_failed || j->taken == j->chunks.count);
    j->is_over = j->is_over || now;
    pthread_mutex_unlock(&j->guard);
    return now;
}

static bool record(Job *j, Error *e) {
    const JobResult *r = j->result;
    Record done = {.frames = r->frames, .residual_frames = r->residual_frames, .bytes = r->bytes};
    SummaryRow *row = ARENA_NEW(j->arena, SummaryRow, j->order.wardrobe->ngarments, e);
    for (int g = 0; row && g < j->order.wardrobe->ngarments; g++) {
        row[g] = r->row[g];
        row[g].motion = j->order.input->name;
        row[g].garment = j->order.wardrobe->garment[g]->name;
        row[g].status = "ok";
    }
    return row && sync_folder(j->folder, e) &&
           record_write(j->folder, &j->order.key, &done, row, j->order.wardrobe->ngarments, !j->settings->no_times, e);
}

/* Fails where --strict finds something that shows through. */
static bool check(const Job *j, Error *e) {
    for (int g = 0; j->settings->strict && g < j->order.wardrobe->ngarments; g++) {
        const SummaryRow *sum = &j->result->row[g];
        if (sum->residual_frames > 0)
            return error_at(e, ERR_CHECK, (Place){.file = j->order.input->path},
                            "the body shows through '%s' in %d of %d frames", j->order.wardrobe->garment[g]->name,
                            sum->residual_frames, sum->frames);
    }
    return true;
}

static void tell(const Job *j, FILE *about) {
    const Motion *m = &j->wearer.motion;
    const Figure *f = &j->wearer.figure;
    const char *name = j->order.input->name;
    fprintf(about, "%s: %s, %d frame%s at %.5g a second, figure %.2f m, unit %s, %s\n", name, m->format, m->nframes,
            m->nframes == 1 ? "" : "s", 1 / m->frame_time, f->height, f->unit_name, f->rest);
    for (int g = 0; g < j->order.wardrobe->ngarments; g++) {
        const SummaryRow *sum = &j->result->row[g];
        fprintf(about, "%s/%s: %d frame%s, %d with residuals, moved by %.1f cm at most\n", name,
                j->order.wardrobe->garment[g]->name, sum->frames, sum->frames == 1 ? "" : "s", sum->residual_frames,
                100 * sum->max_displacement);
    }
}

/* What is left of the whole when the known stages are taken off. */
static double other_seconds(const double *seconds, double whole) {
    for (int stage = 0; stage < STAGE_OTHER; stage++) whole -= seconds[stage];
    return whole > 0 ? whole : 0;
}

void job_close(Job *j, FILE *about) {
    double since = clock_seconds();
    Error *e = &j->result->error;
    for (int g = 0; g < j->order.wardrobe->ngarments; g++) j->result->bytes += j->result->row[g].bytes;
    if (e->kind) {
        if (j->stats_is_open) stats_abandon(&j->stats);
    } else if (stats_close(&j->stats, e) && record(j, e)) {
        check(j, e);
    }
    jumps_notes(&j->jumps, j->order.input->path, j->notes);
    if (about && e->kind <= ERR_CHECK) tell(j, about);
    wearer_close(&j->wearer);
    lock_release(&j->lock);
    pthread_mutex_destroy(&j->guard);
    j->result->seconds[STAGE_OTHER] = other_seconds(j->result->seconds, j->whole + clock_lap(&since));
}
