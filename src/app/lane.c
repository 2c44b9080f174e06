/* The frames of a chunk, each on its way from a row of numbers to files:

       row -> pose -> body mesh -> each garment -> the press (OBJ, Draco), a row of statistics

   A frame's garments are dressed side by side where threads are free (see crew.c).

   Read lane_run from its end upwards. Everything that a frame needs is taken before the first
   one; memory does not grow with the number of frames. A chunk begins with fresh dressers, for then it
   cannot know what its thread has dressed before. */
#include "app/lane.h"

#include "app/crew.h"
#include "app/stop.h"
#include "base/clock.h"

typedef struct {
    Lane *lane;
    const LaneWork *work;
    const Settings *settings;
    const Chunk *chunk;
    ChunkResult *result;
    PressTally tally;
} Run;

void lane_free(Lane *lane) {
    arena_free(&lane->arena);
    pen_free(&lane->pen);
}

bool lane_open(Lane *lane, const LaneWork *work, Error *e) {
    const Settings *s = work->wardrobe->settings;
    DressOptions options = {.split = (SplitRule)s->split, .detail = s->detail, .depth = s->depth};
    options.method = (Method)s->method;
    options.fixed_topology = s->fixed != 0;
    arena_reset(&lane->arena);
    return wearer_share(work->wearer, work->unit, &lane->arena, &lane->wearer, e) &&
           wearer_put_on(&lane->wearer, work->wardrobe, &options, &lane->arena, &lane->dresser, e);
}

static bool relax_arms(Lane *lane, const Wardrobe *wardrobe, Take *take, Error *e) {
    const Wearer *w = &lane->wearer;
    lane->cloth = (Cloth){0};
    for (int g = 0; g < wardrobe->ngarments; g++)
        if (!room_add(wardrobe->garment[g], &w->figure, &w->body, &lane->arena, &lane->cloth, e)) return false;
    return take_relax(take, &w->body, &lane->cloth, &lane->arena, e);
}

/* Hands a mesh to the press; rows share the time of writing it. */
static bool put(Run *r, Pen *pen, const char *name, int frame, const Mesh *mesh, long long *bytes, StatsRow *row,
                int nrows, Error *e) {
    PressOrder order = {r->settings, r->work->folder, name, frame, r->work->unit, bytes, row, nrows, &r->tally};
    return r->settings->formats == FORMAT_NONE || press_put(r->work->press, pen, &order, mesh, e);
}

/* The garments of a frame are dressed by whoever is free. row: of each; NULL: nothing is to be written. */
typedef struct { Run *run; const TakeFrame *frame; StatsRow *row; } Fitting;

static void dress_garment(void *context, int g, Pen *pen) {
    Fitting *f = context;
    Run *r = f->run;
    Mesh mesh;
    FrameStats stats;
    Error e = {0};
    double since = clock_seconds();
    dresser_frame(r->lane->dresser[g], &r->lane->wearer.posed, f->frame->dt, f->frame->restart, &mesh, &stats);
    if (!f->row) return;
    StatsRow *row = &f->row[g];
    row->stats = stats;
    r->result->seconds[g] += clock_lap(&since);
    if (!put(r, pen, row->garment, f->frame->number, &mesh, &r->result->bytes[g], row, 1, &e))
        return; /* the tally tells */
}

static bool dress_garments(Run *r, const TakeFrame *frame, StatsRow *row, Error *e) {
    Fitting f = {r, frame, row};
    crew_do(r->work->press, &r->lane->pen, &r->tally, dress_garment, &f, r->work->wardrobe->ngarments);
    return press_good(r->work->press, &r->tally, e);
}

/* The rows share the time for the body. */
static bool dress_frame(Run *r, const TakeFrame *frame, double since, Error *e) {
    int n = r->work->wardrobe->ngarments;
    bool residual = false;
    StatsRow *row = &r->result->row[r->result->nrows];
    body_frame_pose(&r->lane->wearer.posed, &frame->pose);
    double pose_s = clock_lap(&since) / n;
    for (int g = 0; g < n; g++)
        row[g] = (StatsRow){.frame = frame->number, .time = frame->time, .split = (SplitRule)r->settings->split,
                            .method = (Method)r->settings->method, .garment = r->work->wardrobe->garment[g]->name,
                            .pose_s = pose_s, .arm_turn = frame->arm_turn};
    Mesh body = wearer_skin(&r->lane->wearer);
    if (!r->settings->no_body &&
        !put(r, &r->lane->pen, "body", frame->number, &body, &r->result->body_bytes, row, n, e))
        return false;
    if (!dress_garments(r, frame, row, e)) return false;
    for (int g = 0; g < n; g++) residual = residual || stats_has_residual(&row[g].stats);
    r->result->nrows += n;
    r->result->frames++;
    r->result->residual_frames += residual;
    return true;
}

/* A frame in front of the chunk: only what the cloth carries on from it is wanted. */
static bool warm_up(Run *r, const TakeFrame *frame, Error *e) {
    body_frame_pose(&r->lane->wearer.posed, &frame->pose);
    return dress_garments(r, frame, NULL, e);
}

static bool dress_frames(Run *r, Take *take, const LaneWatch *watch, Error *e) {
    TakeFrame frame;
    int left = take_count(take);
    for (double since = clock_seconds(); take_next(take, &frame, e); since = clock_seconds()) {
        left--;
        if (frame.number < r->chunk->own) {
            if (!warm_up(r, &frame, e)) return false;
            take_forget_jumps(take); /* they are the chunk's before */
        } else {
            if (!dress_frame(r, &frame, since, e)) return false;
            watch->frame(watch->context);
        }
        if (stop_requested() && left > 0) return error_set(e, ERR_INTERRUPTED, "interrupted");
    }
    return e->kind == ERR_NONE;
}

/* What the press has spent is known only now. */
static void count_writing(Run *r) {
    int n = r->work->wardrobe->ngarments;
    for (int i = 0; i < r->result->nrows; i++) r->result->seconds[i % n] += r->result->row[i].write_s;
    r->result->helped = r->tally.helped;
}

void lane_run(Lane *lane, const LaneWork *work, const Chunk *chunk, const LaneWatch *watch, ChunkResult *out) {
    const Wearer *w = &lane->wearer;
    const Settings *s = work->wardrobe->settings;
    Run r = {.lane = lane, .work = work, .settings = s, .chunk = chunk, .result = out};
    Error *e = &out->error;
    Take *take = NULL;
    if (take_open(&w->motion, &w->figure, &chunk->span, s->rate, &lane->arena, &take, e) &&
        (!s->relax_arms || relax_arms(lane, work->wardrobe, take, e))) {
        dress_frames(&r, take, watch, e);
        press_finish(work->press, &lane->pen, &r.tally, e);
        count_writing(&r);
        out->jumps = take_jumps(take);
    }
    take_close(take);
}
