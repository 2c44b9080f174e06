/* The frames of a chunk, each on its way from a row of numbers to files:

       row -> pose -> body mesh -> each garment -> the press (OBJ, Draco), a row of statistics

   While one frame is dressed the body is posed for the next. That, each of the frame's garments and
   its body mesh do not wait for each other: they are the pieces that free threads take (see crew.c).

   Begin with lane_run, at the end. Everything that a frame needs is taken before the first one;
   memory does not grow with the number of frames. A chunk begins with fresh dressers, for then it
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
    return wearer_share(work->wearer, work->unit, &lane->arena, &lane->stance[0].wearer, e) &&
           wearer_share(work->wearer, work->unit, &lane->arena, &lane->stance[1].wearer, e) &&
           wearer_put_on(work->wearer, work->wardrobe, &options, &lane->arena, &lane->dresser, e);
}

static bool relax_arms(Lane *lane, const LaneWork *work, Take *take, Error *e) {
    const Wearer *w = work->wearer;
    const Wardrobe *wardrobe = work->wardrobe;
    lane->padding = (Padding){0};
    for (int g = 0; g < wardrobe->ngarments; g++)
        if (!padding_add(wardrobe->garment[g], &w->figure, &w->body, &lane->arena, &lane->padding, e)) return false;
    return take_relax(take, &w->body, &lane->padding, &lane->arena, e);
}

/* Hands a mesh of the run to the press. What goes wrong the tally keeps, for dress_and_pose to find. */
static void put(Run *r, Pen *pen, PressOrder order, const Mesh *mesh) {
    Error kept_by_tally = {0};
    order.settings = r->settings;
    order.folder = r->work->folder;
    order.metre = r->work->unit;
    order.tally = &r->tally;
    press_put(r->work->press, pen, &order, mesh, &kept_by_tally);
}

/* What is done at the same time. row: one for each garment; NULL: nothing is to be written. next: NULL
   behind the last frame. */
typedef struct { Run *run; const Stance *now; Stance *next; StatsRow *row; } Fitting;

static void pose_body(Stance *s) {
    double since = clock_seconds();
    body_frame_pose(&s->wearer.posed, &s->frame.pose);
    s->seconds += clock_lap(&since);
}

static void dress_garment(const Fitting *f, int g, Pen *pen) {
    Run *r = f->run;
    const TakeFrame *frame = &f->now->frame;
    bool writes = f->row && r->settings->formats != FORMAT_NONE;
    Mesh mesh;
    FrameStats stats;
    double since = clock_seconds();
    dresser_frame(r->lane->dresser[g], &f->now->wearer.posed, frame->dt, frame->tie, writes ? &mesh : NULL, &stats);
    if (!f->row) return;
    f->row[g].stats = stats;
    r->result->seconds[g] += clock_lap(&since);
    if (!writes) return;
    StatsRow *row = &f->row[g];
    put(r, pen, (PressOrder){.name = row->garment, .frame = frame->number, .bytes = &r->result->bytes[g], .row = row,
                             .nrows = 1}, &mesh);
}

/* All garments of a frame share the time for the body. */
static void share_pose(StatsRow *row, int n, double seconds) {
    for (int g = 0; g < n; g++) row[g].pose_s += seconds / n;
}

static void put_body(const Fitting *f, Pen *pen) {
    Run *r = f->run;
    int n = r->work->wardrobe->ngarments;
    if (r->settings->no_body || r->settings->formats == FORMAT_NONE) return;
    double since = clock_seconds();
    Mesh body = wearer_skin(&f->now->wearer);
    share_pose(f->row, n, clock_lap(&since));
    put(r, pen, (PressOrder){.name = "body", .frame = f->now->frame.number, .bytes = &r->result->body_bytes,
                             .row = f->row, .nrows = n}, &body);
}

enum { PIECE_POSE, PIECE_BODY, PIECE_GARMENTS };

static void do_piece(void *context, int piece, Pen *pen) {
    const Fitting *f = context;
    if (piece >= PIECE_GARMENTS) dress_garment(f, piece - PIECE_GARMENTS, pen);
    else if (piece == PIECE_POSE && f->next) pose_body(f->next);
    else if (piece == PIECE_BODY && f->row) put_body(f, pen);
}

static bool dress_and_pose(Run *r, const Stance *now, Stance *next, StatsRow *row, Error *e) {
    Fitting f = {r, now, next, row};
    crew_do(r->work->press, &r->lane->pen, &r->tally, do_piece, &f, PIECE_GARMENTS + r->work->wardrobe->ngarments);
    return press_good(r->work->press, &r->tally, e);
}

static bool dress_frame(Run *r, const Stance *now, Stance *next, Error *e) {
    int n = r->work->wardrobe->ngarments;
    bool residual = false, limb = false;
    StatsRow *row = &r->result->row[r->result->nrows];
    for (int g = 0; g < n; g++)
        row[g] = (StatsRow){.frame = now->frame.number, .time = now->frame.time, .arm_turn = now->frame.arm_turn,
                            .split = (SplitRule)r->settings->split, .method = (Method)r->settings->method,
                            .garment = r->work->wardrobe->garment[g]->name};
    share_pose(row, n, now->seconds);
    if (!dress_and_pose(r, now, next, row, e)) return false;
    for (int g = 0; g < n; g++) {
        residual = residual || stats_has_residual(&row[g].stats);
        limb = limb || stats_has_limb(&row[g].stats);
    }
    r->result->nrows += n;
    r->result->frames++;
    r->result->residual_frames += residual;
    r->result->limb_frames += limb;
    return true;
}

/* False where there is no other frame, or with an error. */
static bool read_frame(const Run *r, Take *take, Stance *s, Error *e) {
    double since = clock_seconds();
    if (!take_next(take, &s->frame, e)) return false;
    if (s->frame.number < r->chunk->own) take_forget_jumps(take); /* they are the chunk's before */
    s->seconds = clock_lap(&since);
    return true;
}

static bool dress_frames(Run *r, Take *take, const LaneWatch *watch, Error *e) {
    Stance *now = &r->lane->stance[0], *next = &r->lane->stance[1];
    Error ahead = {0}; /* of the next frame: this one is dressed all the same */
    bool more = read_frame(r, take, now, &ahead);
    if (more) pose_body(now);
    while (more) {
        more = read_frame(r, take, next, &ahead);
        Stance *coming = more ? next : NULL;
        if (now->frame.number < r->chunk->own) { /* only what the cloth carries on from it is wanted */
            if (!dress_and_pose(r, now, coming, NULL, e)) return false;
        } else {
            if (!dress_frame(r, now, coming, e)) return false;
            watch->frame(watch->context);
        }
        if (stop_requested() && more) return error_set(e, ERR_INTERRUPTED, "interrupted");
        Stance *done = now;
        now = next;
        next = done;
    }
    *e = ahead;
    return e->kind == ERR_NONE;
}

/* What the press has spent is known only now. */
static void count_writing(Run *r) {
    int n = r->work->wardrobe->ngarments;
    for (int i = 0; i < r->result->nrows; i++) r->result->seconds[i % n] += r->result->row[i].write_s;
    r->result->helped = r->tally.helped;
}

void lane_run(Lane *lane, const LaneWork *work, const Chunk *chunk, const LaneWatch *watch, ChunkResult *out) {
    const Wearer *w = work->wearer;
    const Settings *s = work->wardrobe->settings;
    Run r = {.lane = lane, .work = work, .settings = s, .chunk = chunk, .result = out};
    Error *e = &out->error;
    Take *take = NULL;
    if (take_open(&w->motion, &w->figure, &chunk->span, s->rate, &lane->arena, &take, e) &&
        (!s->relax_arms || relax_arms(lane, work, take, e))) {
        dress_frames(&r, take, watch, e);
        press_finish(work->press, &lane->pen, &r.tally, e);
        count_writing(&r);
        out->jumps = take_jumps(take);
    }
    take_close(take);
}
