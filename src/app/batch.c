/* Many motions on many threads, and nothing that depends on which of them is done first.

   A worker that is free goes on with the motion it is at, else opens the next one, else helps with
   the chunks of a motion that another has opened, else with a garment of a frame (see crew.c), else
   with writing (see press.c); so many short motions and one long one both keep every worker busy. What
   a motion has to say is kept as text until all motions before it have spoken, and the summary is
   written at the end; so a run on sixteen threads reads like a run on one. */
#include "app/batch.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "app/crew.h"
#include "app/folder.h"
#include "app/progress.h"
#include "app/report.h"
#include "app/stop.h"
#include "app/summary.h"
#include "base/clock.h"
#include "base/thread.h"

/* A motion in the batch. */
typedef struct {
    double weight;        /* for the progress: its size */
    int frames, ready;    /* that there will be; that are written */
    bool exists;          /* its folder holds files of an earlier run */
    bool is_done;
    char *said;           /* messages, waiting for their turn; malloc */
} Item;

/* A motion that is being dressed. There is always a free place for one more: every motion under
   way has a worker at it. */
typedef enum { SLOT_FREE, SLOT_BUSY, SLOT_OPEN } SlotState; /* BUSY: being opened or closed by one worker */
typedef struct {
    SlotState state;
    Job *job;
    Arena arena;
    Notes *notes;
    FILE *said;
    size_t size;
    int item;
} Slot;

typedef struct { Lane lane; Slot *slot; } Worker; /* slot: where it was last */

typedef struct {
    const Wardrobe *wardrobe;
    const Input *input;
    Digest options;
    Item *item;
    JobResult *result;    /* of each item */
    int count;
    Worker *worker;
    Slot *slot;           /* as many as workers */
    int nworkers;
    pthread_mutex_t lock; /* guards what follows, the states of slots, and stderr */
    pthread_cond_t change;
    Press press;
    int next;             /* item that nobody has opened yet */
    Progress progress;
    int spoken;           /* items whose messages are out */
} Batch;

typedef struct { Batch *batch; Item *item; } Watcher;

static double weight_under_way(const Batch *b) {
    double sum = 0;
    for (int i = 0; i < b->nworkers; i++) {
        const Item *item = b->slot[i].state != SLOT_FREE ? &b->item[b->slot[i].item] : NULL;
        if (item && item->frames) sum += item->weight * item->ready / item->frames;
    }
    return sum;
}

static void frame_done(void *context) {
    Watcher *w = context;
    pthread_mutex_lock(&w->batch->lock);
    w->item->ready++;
    w->batch->progress.frames++;
    progress_draw(&w->batch->progress, weight_under_way(w->batch));
    pthread_mutex_unlock(&w->batch->lock);
}

/* Prints what may be printed by now: the messages of all items up to the first unfinished one. */
static void speak(Batch *b) {
    for (; b->spoken < b->count && b->item[b->spoken].is_done; b->spoken++) {
        Item *item = &b->item[b->spoken];
        if (item->said && item->said[0]) {
            progress_hide(&b->progress);
            fputs(item->said, stderr);
        }
        free(item->said);
        item->said = NULL;
    }
}

/* Adds the motion's path to an error that does not name it: lower floors do not know it. */
static void name_motion(Error *e, const char *path) {
    char shown[sizeof e->file];
    error_clean(shown, sizeof shown, strcmp(path, "-") == 0 ? "<stdin>" : path);
    if (e->kind && !e->file[0] && !strstr(e->text, shown)) memcpy(e->file, shown, sizeof shown);
}

/* The motion is over, one way or another: its messages, its memory, its place. */
static void finish(Batch *b, Slot *slot) {
    const Settings *s = b->wardrobe->settings;
    Item *item = &b->item[slot->item];
    if (slot->job) job_close(slot->job, s->verbose ? slot->said : NULL);
    Error *error = &b->result[slot->item].error;
    ErrorKind kind = error->kind;
    name_motion(error, b->input[slot->item].path);
    if (slot->said) {
        if (slot->notes && !s->quiet) notes_print(slot->notes, b->input[slot->item].path, slot->said);
        if (kind && kind != ERR_INTERRUPTED) error_print(error, slot->said);
        fclose(slot->said);
    }
    arena_reset(&slot->arena);
    pthread_mutex_lock(&b->lock);
    slot->state = SLOT_FREE;
    item->is_done = true;
    b->progress.done++;
    b->progress.failed += kind > ERR_CHECK;
    b->progress.finished += item->weight;
    speak(b);
    progress_draw(&b->progress, weight_under_way(b));
    pthread_cond_broadcast(&b->change);
    pthread_mutex_unlock(&b->lock);
}

/* Has an earlier run finished the motion, from the same inputs with the same options? */
static bool is_finished(Batch *b, Slot *slot, const RecordKey *key) {
    const Settings *s = b->wardrobe->settings;
    JobResult *result = &b->result[slot->item];
    char folder[OUTPUT_PATH_MAX];
    Record record;
    int n = snprintf(folder, sizeof folder, "%s/%s", s->output, b->input[slot->item].name);
    if (!s->resume || n >= (int)sizeof folder || !record_read(folder, key, &slot->arena, &record, &result->error))
        return false;
    result->recorded = strdup(record.rows);
    if (!result->recorded) return !error_set(&result->error, ERR_INTERNAL, "out of memory for the summary");
    if (s->strict && record.residual_frames > 0)
        error_at(&result->error, ERR_CHECK, (Place){.file = b->input[slot->item].path},
                 "the body shows through in %d of %d frames", record.residual_frames, record.frames);
    return true;
}

/* Opens the slot's motion. False: there is nothing to dress. */
static bool open_job(Batch *b, Worker *w, Slot *slot) {
    const Settings *s = b->wardrobe->settings;
    const Input *input = &b->input[slot->item];
    Item *item = &b->item[slot->item];
    JobResult *result = &b->result[slot->item];
    JobOrder order = {.wardrobe = b->wardrobe, .input = input, .key = {.options = b->options}, .workers = b->nworkers,
                      .press = &b->press};
    slot->job = NULL;
    slot->said = open_memstream(&item->said, &slot->size);
    slot->notes = ARENA_NEW(&slot->arena, Notes, 1, &result->error);
    if (!slot->notes) return false;
    if (stop_requested()) return error_set(&result->error, ERR_INTERRUPTED, "interrupted");
    if (item->exists && !s->resume)
        return error_set(&result->error, ERR_OUTPUT,
                         "'%s/%s' holds files of an earlier run; --force replaces them, --resume goes on with them",
                         s->output, input->name);
    if (!input->is_empty && !record_motion(input, s, &order.key.motion, &result->error)) return false;
    if (is_finished(b, slot, &order.key) || result->error.kind) return false;
    return job_open(&order, &w->lane, slot->notes, &slot->arena, result, &slot->job);
}

/* A free slot for the next item. */
static Slot *start_item(Batch *b) {
    for (int i = 0; b->next < b->count && i < b->nworkers; i++) {
        if (b->slot[i].state != SLOT_FREE) continue;
        b->slot[i].state = SLOT_BUSY;
        b->slot[i].item = b->next++;
        return &b->slot[i];
    }
    return NULL;
}

/* Finds something for the worker: *chunk of slot->job, or -1 where the slot is to be opened.
   NULL when all is done. */
static Slot *next_task(Batch *b, Worker *w, int *chunk) {
    Slot *found = NULL;
    pthread_mutex_lock(&b->lock);
    for (;;) {
        bool any = false;
        *chunk = -1;
        if (w->slot && w->slot->state == SLOT_OPEN && (*chunk = job_take(w->slot->job)) >= 0) found = w->slot;
        if (!found) found = start_item(b);
        for (int i = 0; !found && i < b->nworkers; i++) {
            any = any || b->slot[i].state != SLOT_FREE;
            if (b->slot[i].state == SLOT_OPEN && (*chunk = job_take(b->slot[i].job)) >= 0) found = &b->slot[i];
        }
        if (found || !any) break;
        b->press.helpers++;
        Pen *pen = &w->lane.pen;
        if (!crew_help(&b->press, pen) && !press_help(&b->press, pen)) pthread_cond_wait(&b->change, &b->lock);
        b->press.helpers--;
    }
    pthread_mutex_unlock(&b->lock);
    return w->slot = found;
}

/* From now on others may help. */
static void offer(Batch *b, Slot *slot) {
    pthread_mutex_lock(&b->lock);
    slot->state = SLOT_OPEN;
    b->item[slot->item].frames = job_frames(slot->job);
    pthread_cond_broadcast(&b->change);
    pthread_mutex_unlock(&b->lock);
}

/* A chunk is done. True: this worker has to close the slot's motion; by now that may be another
   one, which is over as well. */
static bool must_close(Batch *b, Slot *slot) {
    pthread_mutex_lock(&b->lock);
    bool is_over = slot->state == SLOT_OPEN && job_is_over(slot->job);
    if (is_over) slot->state = SLOT_BUSY;
    pthread_cond_broadcast(&b->change);
    pthread_mutex_unlock(&b->lock);
    return is_over;
}

static void work(void *context, int index) {
    Batch *b = context;
    Worker *w = &b->worker[index];
    int chunk;
    for (Slot *slot; (slot = next_task(b, w, &chunk));) {
        if (chunk < 0 && !open_job(b, w, slot)) {
            finish(b, slot);
            continue;
        }
        if (chunk < 0) {
            offer(b, slot);
            chunk = 0;
        }
        Watcher watcher = {b, &b->item[slot->item]};
        job_chunk(slot->job, chunk, &w->lane, &(LaneWatch){frame_done, &watcher});
        if (must_close(b, slot)) finish(b, slot);
    }
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

/* A run that found its folders there already and dressed nothing has no summary to write: the one that
   is there is theirs. */
static bool is_refused(const Batch *b) {
    bool refused = false, dressed = false;
    for (int i = 0; i < b->count; i++) {
        refused = refused || (b->item[i].exists && !b->wardrobe->settings->resume);
        dressed = dressed || b->result[i].error.kind <= ERR_CHECK;
    }
    return refused && !dressed;
}

static bool prepare(Batch *b, Arena *arena, Error *e) {
    const Settings *s = b->wardrobe->settings;
    b->nworkers = s->jobs ? s->jobs : thread_count();
    b->item = ARENA_NEW(arena, Item, b->count, e);
    b->result = ARENA_NEW(arena, JobResult, b->count, e);
    b->worker = ARENA_NEW(arena, Worker, b->nworkers, e);
    b->slot = ARENA_NEW(arena, Slot, b->nworkers, e);
    SummaryRow *rows = ARENA_NEW(arena, SummaryRow, (size_t)b->count * (size_t)b->wardrobe->ngarments, e);
    if (!b->item || !b->result || !b->worker || !b->slot || !rows || !record_options(s, &b->options, e) ||
        !press_open(&b->press, b->nworkers, &b->lock, &b->change, arena, e))
        return false;
    for (int i = 0; i < b->count; i++) b->result[i].row = rows + (size_t)i * (size_t)b->wardrobe->ngarments;
    for (int i = 0; i < b->nworkers; i++)
        b->worker[i].lane.arena.limit = b->slot[i].arena.limit = (size_t)s->max_memory << 20;
    progress_start(&b->progress, s, b->count, look_at_folders(b));
    return true;
}

static void clean_up(Batch *b) {
    for (int i = 0; i < b->nworkers && b->worker && b->slot; i++) {
        lane_free(&b->worker[i].lane);
        arena_free(&b->slot[i].arena);
    }
    press_close(&b->press);
    for (int i = 0; i < b->count && b->result; i++) free(b->result[i].recorded);
    pthread_cond_destroy(&b->change);
    pthread_mutex_destroy(&b->lock);
}

ErrorKind batch_run(const Wardrobe *wardrobe, const Input *input, int count, int total, Arena *arena, Error *e) {
    Batch b = {.wardrobe = wardrobe, .input = input, .count = count};
    Lock lock = {0};
    ErrorKind worst = ERR_NONE;
    pthread_mutex_init(&b.lock, NULL);
    pthread_cond_init(&b.change, NULL);
    bool good = summary_lock(wardrobe->settings, &lock, e) && prepare(&b, arena, e) &&
                thread_each(b.nworkers, work, &b, e);
    progress_end(&b.progress);
    if (!good || !(is_refused(&b) || summary_write(wardrobe, input, b.result, count, total, e))) worst = e->kind;
    double seconds = clock_seconds() - b.progress.started;
    if (good) report_print(wardrobe->settings, b.result, count, b.nworkers, seconds, stderr);
    for (int i = 0; good && i < count; i++)
        if (b.result[i].error.kind > worst) worst = b.result[i].error.kind;
    if (stop_requested()) {
        worst = ERR_INTERRUPTED;
        error_set(e, worst, "interrupted; what is written is whole, and the same command with --resume goes on");
    }
    clean_up(&b);
    lock_release(&lock);
    return worst;
}
