/* Many motions at once, and nothing that depends on which of them is done first.

   Workers take motions from one counter. What a motion has to say is kept as text until all
   motions before it have spoken, and the summary's rows are written at the end from an array in
   the order of the inputs; so a run on sixteen threads reads like a run on one. */
#include "app/batch.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "app/folder.h"
#include "app/progress.h"
#include "app/stop.h"
#include "base/clock.h"
#include "base/thread.h"

/* A motion in the batch. */
typedef struct {
    JobResult result;
    double weight;     /* for the progress: its size */
    bool exists;       /* its folder holds files of an earlier run */
    bool done;
    char *said;        /* messages, waiting for their turn; malloc */
} Item;

typedef struct { JobMemory memory; Item *item; double part; } Worker; /* part: of the item that is done */

typedef struct {
    const Wardrobe *wardrobe;
    const Input *input;
    Item *item;
    int count;
    Worker *worker;
    int nworkers;
    pthread_mutex_t lock;  /* guards what follows, and stderr */
    Progress progress;
    int spoken;            /* items whose messages are out */
} Batch;

typedef struct { Batch *batch; Worker *worker; } Watcher;

static double under_way(const Batch *b) {
    double sum = 0;
    for (int i = 0; i < b->nworkers; i++)
        if (b->worker[i].item) sum += b->worker[i].part * b->worker[i].item->weight;
    return sum;
}

static void frame_done(void *context, int done, int total) {
    Watcher *w = context;
    pthread_mutex_lock(&w->batch->lock);
    w->worker->part = (double)done / total;
    w->batch->progress.frames++;
    progress_draw(&w->batch->progress, under_way(w->batch));
    pthread_mutex_unlock(&w->batch->lock);
}

/* Prints what may be printed by now: the messages of all items up to the first unfinished one. */
static void speak(Batch *b) {
    for (; b->spoken < b->count && b->item[b->spoken].done; b->spoken++) {
        Item *item = &b->item[b->spoken];
        if (item->said && item->said[0]) {
            progress_hide(&b->progress);
            fputs(item->said, stderr);
        }
        free(item->said);
        item->said = NULL;
    }
}

static void finish(Batch *b, Worker *w, Item *item) {
    pthread_mutex_lock(&b->lock);
    w->item = NULL;
    item->done = true;
    b->progress.done++;
    b->progress.failed += item->result.error.kind > ERR_CHECK;
    b->progress.finished += item->weight;
    speak(b);
    progress_draw(&b->progress, under_way(b));
    pthread_mutex_unlock(&b->lock);
}

/* Dresses an item; what there is to say about it goes to `said`. */
static void dress(Batch *b, Worker *w, int i, FILE *said) {
    const Settings *s = b->wardrobe->settings;
    Watcher watcher = {b, w};
    JobWatch watch = {frame_done, &watcher};
    Notes *notes = ARENA_NEW(&w->memory.arena, Notes, 1, &b->item[i].result.error);
    if (!notes) return;
    job_run(b->wardrobe, &b->input[i], &watch, &w->memory, notes, s->verbose ? said : NULL, &b->item[i].result);
    if (said && !s->quiet) notes_print(notes, b->input[i].path, said);
}

static void run_item(void *context, int i, int worker) {
    Batch *b = context;
    Worker *w = &b->worker[worker];
    Item *item = &b->item[i];
    size_t size;
    FILE *said = open_memstream(&item->said, &size);
    pthread_mutex_lock(&b->lock);
    w->item = item;
    w->part = 0;
    pthread_mutex_unlock(&b->lock);
    if (stop_requested()) error_set(&item->result.error, ERR_INTERRUPTED, "interrupted");
    else if (item->exists)
        error_set(&item->result.error, ERR_OUTPUT, "'%s/%s' holds files of an earlier run; --force replaces them",
                  b->wardrobe->settings->output, b->input[i].name);
    else dress(b, w, i, said);
    if (said) {
        ErrorKind kind = item->result.error.kind;
        if (kind && kind != ERR_INTERRUPTED) error_print(&item->result.error, said);
        fclose(said);
    }
    arena_reset(&w->memory.arena);
    finish(b, w, item);
}

/* Looks, before anything is written, at what each motion would replace. Returns the weight of all. */
static double look_at_folders(Batch *b) {
    char path[OUTPUT_PATH_MAX];
    const Settings *s = b->wardrobe->settings;
    double weight = 0;
    for (int i = 0; i < b->count; i++) {
        struct stat info;
        b->item[i].weight = stat(b->input[i].path, &info) == 0 && S_ISREG(info.st_mode) ? (double)info.st_size : 1;
        weight += b->item[i].weight;
        int n = snprintf(path, sizeof path, "%s/%s", s->output, b->input[i].name);
        b->item[i].exists = !s->force && n < (int)sizeof path && folder_has_files(path);
    }
    return weight;
}

/* Why a motion was not dressed, with its place; empty where it was. */
static void give_reason(const Error *why, char *reason, size_t n) {
    reason[0] = 0;
    if (why->kind <= ERR_CHECK) return;
    if (why->line) snprintf(reason, n, "%s:%d:%d: %s", why->file, why->line, why->column, why->text);
    else snprintf(reason, n, "%s", why->text);
}

static const char *status_of(ErrorKind kind) {
    if (kind <= ERR_CHECK) return "ok";
    return kind == ERR_INPUT || kind == ERR_USAGE ? "refused" : "failed";
}

static bool add_rows(const Batch *b, StatsFile *f, int i, Error *e) {
    const JobResult *result = &b->item[i].result;
    char reason[720];
    give_reason(&result->error, reason, sizeof reason);
    for (int g = 0; g < b->wardrobe->ngarments; g++) {
        SummaryRow row = result->row[g];
        row.motion = b->input[i].name;
        row.garment = b->wardrobe->garment[g]->name;
        row.status = status_of(result->error.kind);
        row.reason = reason[0] ? reason : NULL;
        if (!stats_add_summary(f, &row, e)) return false;
    }
    return true;
}

static bool write_summary(const Batch *b, Error *e) {
    char path[OUTPUT_PATH_MAX];
    const Settings *s = b->wardrobe->settings;
    StatsFile f;
    if (snprintf(path, sizeof path, "%s/summary.csv", s->output) >= (int)sizeof path)
        return error_set(e, ERR_OUTPUT, "the name of the output folder is too long");
    if (!output_folder(s->output, e) || !stats_open(&f, path, TABLE_SUMMARY, !s->no_times, e)) return false;
    for (int i = 0; i < b->count; i++) {
        if (add_rows(b, &f, i, e)) continue;
        stats_abandon(&f);
        return false;
    }
    return stats_close(&f, e);
}

static void print_stages(const Batch *b, double elapsed) {
    static const char *const names[STAGE_COUNT] = {"open and fit", "pose", "global shape", "test",
                                                   "push",         "mesh", "write",        "other"};
    double sum[STAGE_COUNT] = {0}, whole = 0;
    for (int i = 0; i < b->count; i++)
        for (int k = 0; k < STAGE_COUNT; k++) sum[k] += b->item[i].result.seconds[k];
    for (int k = 0; k < STAGE_COUNT; k++) whole += sum[k];
    for (int k = 0; k < STAGE_COUNT; k++)
        fprintf(stderr, "  %-14s %9.3f s  %5.1f %%\n", names[k], sum[k], whole > 0 ? 100 * sum[k] / whole : 0);
    fprintf(stderr, "  %-14s %9.3f s  on %d thread%s in %.3f s\n", "together", whole, b->nworkers,
            b->nworkers == 1 ? "" : "s", elapsed);
}

static void print_bytes(double bytes) {
    if (bytes >= 1e9) fprintf(stderr, "%.2f GB", bytes / 1e9);
    else if (bytes >= 1e6) fprintf(stderr, "%.1f MB", bytes / 1e6);
    else fprintf(stderr, "%.1f kB", bytes / 1e3);
}

static void print_end(const Batch *b) {
    long long frames = 0, residual = 0, bytes = 0;
    int done = 0;
    double elapsed = clock_seconds() - b->progress.started;
    for (int i = 0; i < b->count; i++) {
        const JobResult *r = &b->item[i].result;
        done += r->error.kind <= ERR_CHECK;
        frames += r->frames;
        residual += r->residual_frames;
        bytes += r->bytes;
    }
    if (b->wardrobe->settings->verbose) print_stages(b, elapsed);
    fprintf(stderr, "%d of %d motion%s dressed, %lld frame%s, %lld with residuals, ", done, b->count,
            b->count == 1 ? "" : "s", frames, frames == 1 ? "" : "s", residual);
    print_bytes((double)bytes);
    fprintf(stderr, " in %.1f s (%.0f frames/s)\n", elapsed, elapsed > 0 ? (double)frames / elapsed : 0);
}

static bool prepare(Batch *b, Arena *arena, Error *e) {
    const Settings *s = b->wardrobe->settings;
    int wanted = s->jobs ? s->jobs : thread_count();
    b->nworkers = wanted < b->count ? wanted : b->count;
    b->item = ARENA_NEW(arena, Item, b->count, e);
    b->worker = ARENA_NEW(arena, Worker, b->nworkers, e);
    SummaryRow *rows = ARENA_NEW(arena, SummaryRow, (size_t)b->count * (size_t)b->wardrobe->ngarments, e);
    if (!b->item || !b->worker || !rows) return false;
    for (int i = 0; i < b->count; i++) b->item[i].result.row = rows + (size_t)i * (size_t)b->wardrobe->ngarments;
    bool visible = s->progress == PROGRESS_ALWAYS;
    if (s->progress == PROGRESS_AUTO) visible = !s->quiet && isatty(STDERR_FILENO);
    progress_start(&b->progress, visible, b->count, look_at_folders(b));
    return true;
}

ErrorKind batch_run(const Wardrobe *wardrobe, const Input *input, int count, Arena *arena, Error *e) {
    Batch b = {.wardrobe = wardrobe, .input = input, .count = count, .lock = PTHREAD_MUTEX_INITIALIZER};
    ErrorKind worst = ERR_NONE;
    if (!prepare(&b, arena, e)) return e->kind;
    bool good = thread_each(count, b.nworkers, run_item, &b, e);
    progress_hide(&b.progress);
    for (int i = 0; i < b.nworkers; i++) job_memory_free(&b.worker[i].memory);
    if (!good || !write_summary(&b, e)) worst = e->kind;
    if (!wardrobe->settings->quiet) print_end(&b);
    for (int i = 0; i < count; i++)
        if (b.item[i].result.error.kind > worst) worst = b.item[i].result.error.kind;
    if (stop_requested()) error_set(e, worst = ERR_INTERRUPTED, "interrupted; what is written is whole");
    return worst;
}
