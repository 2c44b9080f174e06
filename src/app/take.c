/* From the rows of a motion file to the poses that are dressed.

   A window of two neighbouring source frames moves forward only. A resampled frame lies between the two: each joint's
   transform relative to its parent is interpolated (rotations as quaternions; the file's angles would wrap around and
   lock), so that bones keep their length. Every source frame passes through the window, also those that are skipped, so
   no jump is missed.

   A jump is a step that no body makes: a T-pose in front of the take, or a root that teleports. Both sides are dressed
   as they stand, but nothing is carried across, and nothing is interpolated between. If the motion is back at once, as
   if it had not jumped, the frames between are astray: they are dressed, and then forgotten. */
#include "app/take.h"

#include <math.h>

#include "app/relief.h"

/* The first frame stands alone if the step to the second is so many times wider than any of the
   next steps, and wider than this part of the height. */
static const double LONE_FACTOR = 4, LONE_STEP = 0.05;

/* Frame times are rounded in files ("0.0083333"): what lies nearer than this to a frame of the
   source, as a part of its time, is that frame and no mixture. */
static const double ROUNDING = 1e-5;

enum { LONE_LOOK = 8 };

/* A source frame: the joints in the file's units and axes, and the figure's pose. */
typedef struct { int frame; Rigid *world; Pose pose; bool is_astray; } SourceFrame;

struct Take {
    const Motion *motion;
    const Figure *figure;
    MotionReader *reader;
    double *row;
    double rate;               /* 0: the source's */
    int number, last, step;    /* of the next frame, from 1 */
    bool begun;
    SourceFrame behind, ahead; /* the window: ahead.frame == behind.frame + 1, from 0 */
    SourceFrame probe;         /* a frame farther ahead */
    bool within;               /* a jump between `behind` and `ahead`, */
    bool cut;                  /* and nothing is carried across; */
    bool passed;               /* the same between the frame that was last given out and `behind` */
    int astray_until;          /* frames in front of that one are astray, if their steps are jumps */
    Rigid *between;            /* joints of a resampled frame */
    bool lone_first;
    double last_time;
    Relief *relief;            /* NULL: arms stay as they are */
    Jumps jumps;
};

static bool load(Take *t, SourceFrame *s, int frame, Error *e) {
    s->frame = frame;
    if (!motion_row(t->reader, frame, t->row, e)) return false;
    skeleton_pose(&t->motion->skeleton, t->row, s->world);
    figure_pose(t->figure, s->world, &s->pose);
    return true;
}

/* Moves the window one frame on. */
static bool shift(Take *t, Error *e) {
    SourceFrame swap = t->behind;
    t->behind = t->ahead;
    t->ahead = swap;
    return load(t, &t->ahead, t->behind.frame + 1, e);
}

/* Does the first frame not belong to the rest? */
static bool look_at_first(Take *t, Error *e) {
    int look = t->motion->nframes - 1 < LONE_LOOK ? t->motion->nframes - 1 : LONE_LOOK;
    if (look < 3) return true; /* nothing to compare with */
    double first = 0, widest = 0;
    if (!load(t, &t->ahead, 0, e)) return false;
    for (int i = 1; i <= look; i++) {
        if (!shift(t, e)) return false;
        double width = figure_step(t->figure, &t->behind.pose, &t->ahead.pose);
        if (i == 1) first = width;
        else if (width > widest) widest = width;
    }
    t->lone_first = first > LONE_STEP && first > LONE_FACTOR * widest;
    return true;
}

static bool read_probe(void *context, int frame, Pose *out, Error *e) {
    Take *t = context;
    if (!load(t, &t->probe, frame, e)) return false;
    *out = t->probe.pose;
    return true;
}

/* Moves on and looks at the step inside the window. */
static bool advance(Take *t, Error *e) {
    if (!shift(t, e)) return false;
    double width;
    JumpRule rule = {t->figure, t->motion->frame_time, t->lone_first};
    Step kind = jumps_judge(&rule, t->ahead.frame, &t->behind.pose, &t->ahead.pose, &width);
    if (kind != STEP_PLAIN) jumps_add(&t->jumps, t->ahead.frame + 1, width, kind);
    t->passed = t->passed || t->cut;
    t->within = kind == STEP_JUMP;
    if (t->within && !t->behind.is_astray &&
        !jumps_find_return(&rule, t->ahead.frame, t->motion->nframes, width, &t->behind.pose, read_probe, t,
                           &t->astray_until, e))
        return false;
    t->ahead.is_astray = t->ahead.frame < t->astray_until;
    t->cut = t->within && !t->behind.is_astray && !t->ahead.is_astray;
    return true;
}

/* Because of the rounding a hundredth of the last frame may be missing. */
int take_length(const Motion *m, double rate) {
    if (rate <= 0) return m->nframes;
    double n = floor((m->nframes - 1) * m->frame_time * rate + 0.01) + 1;
    return n < 2e9 ? (int)n : 2000000000;
}

bool take_span(const Motion *m, const FrameSpan *span, double rate, FrameSpan *out, Error *e) {
    int total = take_length(m, rate);
    if (rate > 0 && m->max_frames > 0 && total > m->max_frames) /* the file's own number was looked at by its reader */
        return error_set(e, ERR_INPUT, "'%s' has %d frames at %g a second, more than the limit of %d", m->path, total,
                         rate, m->max_frames);
    out->first = span->first ? span->first : 1;
    out->last = span->last && span->last < total ? span->last : total;
    out->step = span->step ? span->step : 1;
    if (out->first <= total) return true;
    return error_set(e, ERR_USAGE, "'--frames' begins at %d, but '%s' has %d frame%s", out->first, m->path, total,
                     total == 1 ? "" : "s");
}

bool take_open(const Motion *m, const Figure *figure, const FrameSpan *span, double rate, Arena *arena, Take **out,
               Error *e) {
    const Skeleton *s = &m->skeleton;
    FrameSpan all;
    Take *t = ARENA_NEW(arena, Take, 1, e);
    *out = t;
    if (!t || !take_span(m, span, rate, &all, e)) return false;
    *t = (Take){.motion = m, .figure = figure, .rate = rate, .number = all.first, .last = all.last, .step = all.step};
    t->row = ARENA_NEW(arena, double, s->nchannels, e);
    t->behind.world = ARENA_NEW(arena, Rigid, s->njoints, e);
    t->ahead.world = ARENA_NEW(arena, Rigid, s->njoints, e);
    t->probe.world = ARENA_NEW(arena, Rigid, s->njoints, e);
    t->between = ARENA_NEW(arena, Rigid, s->njoints, e);
    if (!t->row || !t->behind.world || !t->ahead.world || !t->probe.world || !t->between) return false;
    return motion_reader_open(m, arena, &t->reader, e) && look_at_first(t, e);
}

void take_close(Take *t) {
    if (t && t->reader) motion_reader_close(t->reader);
    if (t) relief_close(t->relief);
}

bool take_relax(Take *t, const Body *body, const Padding *padding, Arena *arena, Error *e) {
    return relief_open(t->motion, t->figure, body, padding, t->lone_first, arena, &t->relief, e);
}

int take_count(const Take *t) { return t->number > t->last ? 0 : (t->last - t->number) / t->step + 1; }

void take_leap(Take *t, int number) { t->number = number; }

/* Moves the window until `frame` is the one ahead; it may already be further. */
static bool reach(Take *t, int frame, int begin, Error *e) {
    if (!t->begun) {
        if (!load(t, &t->ahead, begin, e)) return false;
        t->behind.frame = begin - 1;
        t->begun = true;
    }
    while (t->ahead.frame < frame)
        if (!advance(t, e)) return false;
    return true;
}

/* The pose at `part` of the way from the frame behind to the frame ahead. */
static void interpolate(Take *t, double part, Pose *out) {
    const Skeleton *s = &t->motion->skeleton;
    for (int j = 0; j < s->njoints; j++) {
        int up = s->joint[j].parent;
        Rigid a = t->behind.world[j], b = t->ahead.world[j];
        if (up >= 0) {
            a = rigid_mul(rigid_inverse(t->behind.world[up]), a);
            b = rigid_mul(rigid_inverse(t->ahead.world[up]), b);
        }
        Rigid local = {mat_nlerp(a.r, b.r, part), vec_lerp(a.t, b.t, part)};
        t->between[j] = up >= 0 ? rigid_mul(t->between[up], local) : local;
    }
    figure_pose(t->figure, t->between, out);
}

/* Turns the arms as between two source frames, neighbours or the same. */
static bool relax(Take *t, int frame, int next, double part, TakeFrame *out, Error *e) {
    ArmTurn here[ARMS], there[ARMS];
    out->arm_turn = 0;
    if (!t->relief) return true;
    if (!relief_at(t->relief, frame, here, e) || !relief_at(t->relief, next, there, e)) return false;
    for (int i = 0; i < ARMS * TURNS; i++) {
        double *angle = &here[i / TURNS].angle[i % TURNS];
        *angle += part * (there[i / TURNS].angle[i % TURNS] - *angle);
        out->arm_turn = fmax(out->arm_turn, *angle);
    }
    relax_apply(t->figure, here, &out->pose);
    return true;
}

static void tie_to_last(Take *t, bool is_astray, TakeFrame *out) {
    out->tie = is_astray ? TIE_ASTRAY : t->passed ? TIE_AFRESH : TIE_GOES_ON;
    if (!is_astray) t->passed = false;
}

/* A frame of the source as it stands. */
static bool give_source(Take *t, int frame, TakeFrame *out, Error *e) {
    if (!reach(t, frame, frame, e)) return false;
    bool is_ahead = t->ahead.frame == frame;
    const SourceFrame *s = is_ahead ? &t->ahead : &t->behind;
    out->pose = s->pose;
    if (is_ahead) {
        t->passed = t->passed || t->cut;
        t->cut = false;
    }
    tie_to_last(t, s->is_astray, out);
    return relax(t, frame, frame, 0, out, e);
}

/* A frame between two of the source; at a jump there is nothing between, and the earlier stays. */
static bool give_between(Take *t, int frame, double part, TakeFrame *out, Error *e) {
    if (!reach(t, frame + 1, frame, e)) return false;
    if (t->within) out->pose = t->behind.pose;
    else interpolate(t, part, &out->pose);
    tie_to_last(t, t->behind.is_astray, out);
    return relax(t, frame, t->within ? frame : frame + 1, part, out, e);
}

bool take_next(Take *t, TakeFrame *out, Error *e) {
    if (t->number > t->last) return false;
    bool is_first = !t->begun, good;
    double frame_time = t->motion->frame_time;
    out->number = t->number;
    if (t->rate > 0) {
        out->time = (t->number - 1) / t->rate;
        double place = fmin(out->time / frame_time, t->motion->nframes - 1), nearest = floor(place + 0.5);
        if (fabs(place - nearest) < ROUNDING * (place + 1)) good = give_source(t, (int)nearest, out, e);
        else good = give_between(t, (int)place, place - floor(place), out, e);
    } else {
        out->time = (t->number - 1) * frame_time;
        good = give_source(t, t->number - 1, out, e);
    }
    if (is_first) out->tie = TIE_AFRESH;
    out->dt = is_first ? 0 : out->time - t->last_time;
    if (out->tie != TIE_ASTRAY) t->last_time = out->time;
    t->number = t->step > t->last - t->number ? t->last + 1 : t->number + t->step;
    return good;
}

Jumps take_jumps(const Take *t) { return t->jumps; }

void take_forget_jumps(Take *t) { t->jumps = (Jumps){0}; }

void take_notes(const Take *t, Notes *notes) { jumps_notes(&t->jumps, t->motion->path, notes); }
