/* One motion from end to end; read job_run from its end upwards. Opening comes first and touches
   no file: the motion, which joint is which bone, the figure, the body and the garments fitted to
   it. Then the frames, each on its way from a row of numbers to files:

       row -> pose -> body mesh -> each garment -> OBJ, Draco, a row of stats.csv

   Everything that a frame needs is taken before the first one; memory does not grow with the
   number of frames. */
#include "app/job.h"

#include <string.h>

#include "app/folder.h"
#include "app/stop.h"
#include "app/take.h"
#include "app/wearer.h"
#include "base/clock.h"

typedef struct {
    const Wardrobe *wardrobe;
    const Settings *settings;
    const Input *input;
    Arena *arena;
    ObjWriter *obj;
    Notes *notes;
    JobResult *result;
    Wearer wearer;
    Dresser **dresser;     /* one for each garment */
    Take *take;
    StatsFile stats;
    bool stats_is_open;
    double unit;           /* output units per metre */
    char folder[OUTPUT_PATH_MAX];
} Job;

void job_memory_free(JobMemory *m) {
    arena_free(&m->arena);
    obj_writer_free(&m->obj);
}

/* Seconds since *since, which moves on to now. */
static double lap(double *since) {
    double now = clock_seconds(), seconds = now - *since;
    *since = now;
    return seconds;
}

static bool open_motion(Job *j, Error *e) {
    const Settings *s = j->settings;
    DressOptions options = {.split = (SplitRule)s->split, .detail = s->detail, .depth = s->depth};
    options.method = (Method)s->method;
    options.fixed_topology = s->fixed != 0;
    if (j->input->is_empty)
        return error_set(e, ERR_INPUT, "no motion (.bvh or .amc) in the folder '%s'", j->input->path);
    return wearer_open(j->wardrobe, j->input->path, j->unit, j->arena, j->notes, &j->wearer, e) &&
           take_open(&j->wearer.motion, &j->wearer.figure, &s->frames, s->rate, j->arena, &j->take, e) &&
           wearer_put_on(&j->wearer, j->wardrobe, &options, j->arena, &j->dresser, e);
}

static bool open_output(Job *j, Error *e) {
    const Settings *s = j->settings;
    char path[OUTPUT_PATH_MAX + 16];
    if (snprintf(j->folder, sizeof j->folder, "%s/%s", s->output, j->input->name) >= (int)sizeof j->folder)
        return error_set(e, ERR_OUTPUT, "the name of the folder for '%s' is too long", j->input->path);
    if (!output_folder(j->folder, e) || (s->force && !folder_clear(j->folder, e))) return false;
    snprintf(path, sizeof path, "%s/stats.csv", j->folder);
    j->stats_is_open = stats_open(&j->stats, path, TABLE_STATS, !s->no_times, e);
    return j->stats_is_open;
}

/* The mesh is in output units already: what was tested is what is written. */
static bool write_mesh(Job *j, const char *name, int frame, const Mesh *mesh, long long *bytes, Error *e) {
    char path[OUTPUT_PATH_MAX + 128];
    const Settings *s = j->settings;
    unsigned formats = s->formats ? s->formats : FORMAT_OBJ;
    long long n = 0;
    if (formats & FORMAT_OBJ) {
        snprintf(path, sizeof path, "%s/%s.%04d.obj", j->folder, name, frame);
        if (!obj_write(j->obj, path, mesh, 1, &n, e)) return false;
        *bytes += n;
    }
    if (formats & FORMAT_DRC) {
        snprintf(path, sizeof path, "%s/%s.%04d.drc", j->folder, name, frame);
        if (!drc_write(path, mesh, 1, &s->drc, &n, e)) return false;
        *bytes += n;
    }
    return true;
}

static bool write_body(Job *j, int frame, Error *e) {
    if (j->settings->no_body) return true;
    Mesh mesh = wearer_skin(&j->wearer);
    return write_mesh(j, "body", frame, &mesh, &j->result->bytes, e);
}

static void count_seconds(JobResult *result, const StatsRow *row) {
    result->seconds[STAGE_POSE] += row->pose_s;
    result->seconds[STAGE_GLOBAL] += row->stats.global_s;
    result->seconds[STAGE_TEST] += row->stats.test_s;
    result->seconds[STAGE_PUSH] += row->stats.push_s;
    result->seconds[STAGE_MESH] += row->stats.mesh_s;
    result->seconds[STAGE_WRITE] += row->write_s;
}

/* pose_s and write_s of the row hold this garment's share of the body. */
static bool dress_garment(Job *j, int g, const TakeFrame *frame, StatsRow *row, Error *e) {
    const char *name = j->wardrobe->garment[g]->name;
    SummaryRow *sum = &j->result->row[g];
    Mesh mesh;
    double start = clock_seconds(), since;
    row->garment = name;
    dresser_frame(j->dresser[g], &j->wearer.posed, frame->dt, frame->restart, &mesh, &row->stats);
    since = clock_seconds();
    if (!write_mesh(j, name, frame->number, &mesh, &sum->bytes, e)) return false;
    row->write_s += lap(&since);
    sum->seconds += since - start;
    summary_add(sum, row);
    count_seconds(j->result, row);
    return stats_add(&j->stats, row, e);
}

static bool dress_frame(Job *j, const TakeFrame *frame, double since, Error *e) {
    int n = j->wardrobe->ngarments;
    bool residual = false;
    body_frame_pose(&j->wearer.posed, &frame->pose);
    double pose_s = lap(&since) / n;
    if (!write_body(j, frame->number, e)) return false;
    double body_s = lap(&since) / n;
    for (int g = 0; g < n; g++) {
        StatsRow row = {.frame = frame->number, .time = frame->time, .pose_s = pose_s, .write_s = body_s};
        row.split = (SplitRule)j->settings->split;
        row.method = (Method)j->settings->method;
        if (!dress_garment(j, g, frame, &row, e)) return false;
        residual = residual || stats_has_residual(&row.stats);
    }
    j->result->frames++;
    j->result->residual_frames += residual;
    return true;
}

static bool dress_frames(Job *j, const JobWatch *watch, Error *e) {
    TakeFrame frame;
    int total = take_count(j->take);
    for (double since = clock_seconds(); take_next(j->take, &frame, e); since = clock_seconds()) {
        if (!dress_frame(j, &frame, since, e)) return false;
        watch->frame(watch->context, j->result->frames, total);
        if (stop_requested() && j->result->frames < total) return error_set(e, ERR_INTERRUPTED, "interrupted");
    }
    return e->kind == ERR_NONE;
}

/* Fails where --strict finds something that shows through. */
static bool check(const Job *j, Error *e) {
    for (int g = 0; j->settings->strict && g < j->wardrobe->ngarments; g++) {
        const SummaryRow *sum = &j->result->row[g];
        if (sum->residual_frames > 0)
            return error_at(e, ERR_CHECK, (Place){.file = j->input->path},
                            "the body shows through '%s' in %d of %d frames", j->wardrobe->garment[g]->name,
                            sum->residual_frames, sum->frames);
    }
    return true;
}

static bool run(Job *j, const JobWatch *watch, Error *e) {
    double since = clock_seconds();
    if (!open_motion(j, e) || !open_output(j, e)) return false;
    j->result->seconds[STAGE_OPEN] = lap(&since);
    if (!dress_frames(j, watch, e)) return false;
    j->stats_is_open = false;
    return stats_close(&j->stats, e) && check(j, e);
}

static void tell(const Job *j, FILE *about) {
    const Motion *m = &j->wearer.motion;
    const Figure *f = &j->wearer.figure;
    fprintf(about, "%s: %s, %d frame%s at %.5g a second, figure %.2f m, unit %s, %s\n", j->input->name, m->format,
            m->nframes, m->nframes == 1 ? "" : "s", 1 / m->frame_time, f->height, f->unit_name, f->rest);
    for (int g = 0; g < j->wardrobe->ngarments; g++) {
        const SummaryRow *sum = &j->result->row[g];
        fprintf(about, "%s/%s: %d frames, %d with residuals, moved by %.1f cm at most\n", j->input->name,
                j->wardrobe->garment[g]->name, sum->frames, sum->residual_frames, 100 * sum->max_displacement);
    }
}

/* What is left of the whole when the known stages are taken off. */
static double other_seconds(const double *seconds, double whole) {
    for (int stage = 0; stage < STAGE_OTHER; stage++) whole -= seconds[stage];
    return whole > 0 ? whole : 0;
}

void job_run(const Wardrobe *wardrobe, const Input *input, const JobWatch *watch, JobMemory *memory, Notes *notes,
             FILE *about, JobResult *out) {
    double since = clock_seconds();
    Job *j = ARENA_NEW(&memory->arena, Job, 1, &out->error);
    if (!j) return;
    *j = (Job){.wardrobe = wardrobe, .settings = wardrobe->settings, .input = input, .notes = notes, .result = out};
    j->arena = &memory->arena;
    j->obj = &memory->obj;
    j->unit = j->settings->output_unit > 0 ? 1 / j->settings->output_unit : 1;
    j->obj->metre = j->unit;
    bool good = run(j, watch, &out->error);
    if (j->take) take_notes(j->take, notes);
    if (about && (good || out->error.kind == ERR_CHECK)) tell(j, about);
    if (j->stats_is_open) stats_abandon(&j->stats);
    take_close(j->take);
    wearer_close(&j->wearer);
    for (int g = 0; g < wardrobe->ngarments; g++) out->bytes += out->row[g].bytes;
    out->seconds[STAGE_OTHER] = other_seconds(out->seconds, lap(&since));
}
