/* How far an arm must be turned in a frame, its need, follows from the pose alone (figure/relax). Arms that were turned
   by just that would move in jerks. So for each frame the largest need of all frames within a quarter of a second is
   taken, and of these maxima the weighted mean over another quarter of a second. Each maximum in that mean is at least
   the need of the frame itself, so the mean is as well; and it changes as smoothly as the weights.

   This is done on the frames of the source, and never across a jump, but past frames that are astray (app/take). So a
   frame gets the same turn whichever other frames are dressed, at any rate and in any chunk. */
#include "app/relief.h"

/* Seconds to either side over which the largest is taken, and again over which it is smoothed. */
static const double REACH = 0.25;

/* Frames in that time; ten thousand frames a second are no reason for a large table. */
static const double REACH_MOST = 2048;

/* A source frame, in a ring of them. */
typedef struct {
    ArmTurn need[ARMS], most[ARMS];
    int stretch; /* the same number: no jump in between, but for frames that are astray */
} Moment;

struct Relief {
    const Motion *motion;
    const Figure *figure;
    const Body *body;
    const Padding *padding;
    bool lone_first;
    MotionReader *reader;
    double *row;
    Rigid *world;
    Pose pose;           /* of the last frame that was read */
    int stretches;       /* so far */
    int back, whole;     /* the frame in which the motion is back from those that are astray, and to which stretch */
    double span;         /* REACH in frames */
    int reach, size;     /* in whole frames, rounded up: of the window, of the ring */
    int begin, read, known; /* frames begin .. read - 1 have a need, those before `known` a maximum */
    Moment *ring;
    double *weight;      /* reach + 1 of them, from the middle outwards */
};

bool relief_open(const Motion *m, const Figure *figure, const Body *body, const Padding *padding, bool lone_first,
                 Arena *arena, Relief **out, Error *e) {
    Relief *r = *out = ARENA_NEW(arena, Relief, 1, e);
    if (!r) return false;
    *r = (Relief){.motion = m, .figure = figure, .body = body, .padding = padding, .lone_first = lone_first};
    r->span = fmin(REACH / m->frame_time, REACH_MOST);
    r->reach = (int)ceil(r->span);
    r->size = 4 * r->reach + 2; /* two windows to either side, and one frame that may be asked for again */
    r->row = ARENA_NEW(arena, double, m->skeleton.nchannels, e);
    r->world = ARENA_NEW(arena, Rigid, m->skeleton.njoints, e);
    r->ring = ARENA_NEW(arena, Moment, r->size, e);
    r->weight = ARENA_NEW(arena, double, r->reach + 1, e);
    if (!r->row || !r->world || !r->ring || !r->weight) return false;
    for (int k = 0; k <= r->reach; k++) r->weight[k] = 1 + cos(PI * fmin(k / r->span, 1));
    return motion_reader_open(m, arena, &r->reader, e);
}

void relief_close(Relief *r) {
    if (r && r->reader) motion_reader_close(r->reader);
}

static Moment *moment_of(const Relief *r, int frame) { return &r->ring[frame % r->size]; }

static bool read_pose(void *context, int frame, Pose *out, Error *e) {
    Relief *r = context;
    if (!motion_row(r->reader, frame, r->row, e)) return false;
    skeleton_pose(&r->motion->skeleton, r->row, r->world);
    figure_pose(r->figure, r->world, out);
    return true;
}

/* *stretch: that of the frame that was just read. before: the pose of the one in front of it, in stretch `last`. */
static bool find_stretch(Relief *r, int frame, const Pose *before, int last, int *stretch, Error *e) {
    JumpRule rule = {r->figure, r->motion->frame_time, r->lone_first};
    double width;
    *stretch = frame == r->back ? r->whole : last;
    if (frame == r->back || jumps_judge(&rule, frame, before, &r->pose, &width) != STEP_JUMP) return true;
    *stretch = ++r->stretches;
    if (frame < r->back) return true;
    r->whole = last;
    return jumps_find_return(&rule, frame, r->motion->nframes, width, before, read_pose, r, &r->back, e);
}

static bool read_frame(Relief *r, Error *e) {
    int frame = r->read;
    Pose before = r->pose;
    Moment *now = moment_of(r, frame);
    if (!read_pose(r, frame, &r->pose, e)) return false;
    now->stretch = r->stretches;
    if (frame > r->begin && !find_stretch(r, frame, &before, moment_of(r, frame - 1)->stretch, &now->stretch, e))
        return false;
    relax_find(r->figure, r->body, r->padding, &r->pose, now->need);
    r->read++;
    return true;
}

/* The first and the last frame of the same stretch that have been read within REACH of `frame`. */
static void window_of(const Relief *r, int frame, int *first, int *last) {
    int stretch = moment_of(r, frame)->stretch;
    *first = frame - r->reach > r->begin ? frame - r->reach : r->begin;
    *last = frame + r->reach < r->motion->nframes ? frame + r->reach : r->motion->nframes - 1;
    while (moment_of(r, *first)->stretch != stretch) ++*first;
    while (moment_of(r, *last)->stretch != stretch) --*last;
}

static bool is_with(const Relief *r, int frame, int other) {
    return moment_of(r, frame)->stretch == moment_of(r, other)->stretch;
}

/* The largest need in the window. Where an end of the window lies between two frames, the need there is interpolated,
   so that the maximum does not depend on where the source has its frames. */
static void find_most(Relief *r, int frame) {
    int first, last;
    double part = r->span - (r->reach - 1);
    window_of(r, frame, &first, &last);
    for (int i = 0; i < ARMS * TURNS; i++) {
        int arm = i / TURNS, turn = i % TURNS;
        double most = moment_of(r, frame)->need[arm].angle[turn];
        for (int k = first; k <= last; k++) {
            double need = moment_of(r, k)->need[arm].angle[turn];
            int inner = k == frame - r->reach ? k + 1 : k == frame + r->reach ? k - 1 : k;
            if (!is_with(r, k, frame)) continue;
            if (!is_with(r, inner, frame)) inner = k;
            double within = moment_of(r, inner)->need[arm].angle[turn];
            most = fmax(most, within + part * (need - within));
        }
        moment_of(r, frame)->most[arm].angle[turn] = most;
    }
}

/* Fills the ring as far as a frame needs it. */
static bool fill(Relief *r, int frame, Error *e) {
    int reach = r->reach, end = r->motion->nframes;
    if (r->read == 0 || frame - 2 * reach > r->read) { /* nothing of the ring is wanted */
        r->begin = r->read = frame > 2 * reach ? frame - 2 * reach : 0;
        r->known = r->begin;
    }
    while (r->read < end && r->read <= frame + 2 * reach) {
        if (!read_frame(r, e)) return false;
        if (r->known + reach < r->read) find_most(r, r->known++);
    }
    while (r->known < end && r->known <= frame + reach) find_most(r, r->known++); /* at the end of the motion */
    return true;
}

bool relief_at(Relief *r, int frame, ArmTurn out[ARMS], Error *e) {
    int first, last;
    if (!fill(r, frame, e)) return false;
    window_of(r, frame, &first, &last);
    for (int i = 0; i < ARMS * TURNS; i++) {
        int arm = i / TURNS, turn = i % TURNS;
        double sum = 0, weights = 0;
        for (int k = first; k <= last; k++) {
            double w = r->weight[k < frame ? frame - k : k - frame];
            if (!is_with(r, k, frame)) continue;
            weights += w;
            sum += w * moment_of(r, k)->most[arm].angle[turn];
        }
        out[arm].angle[turn] = sum / weights;
    }
    return true;
}
