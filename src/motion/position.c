/* What position channels mean.

   Do they replace the OFFSET or add to it? Both occur, and no file says which. If they replace it, a joint's values lie
   round its OFFSET; if they add, round zero. Each position channel of a joint with an OFFSET is a witness, the more
   trusted the less its values vary: while somebody walks away along x and z, the height of the hips still tells. Joints
   below a root tell more than roots, since bones keep their length: where they tell anything, roots are not asked.
   Nearly all files mean to replace, so adding must fit twice as well: the hips of somebody who sits are below the
   OFFSET's height in either case.

   Do they tell the pose alone? In files of bare points, as pose estimators write them, no joint but a root turns in any
   frame. Where such files leave OFFSETs zero, the first frame has to stand for them. */
#include <string.h>

#include "base/sort.h"
#include "motion/source.h"

enum { SAMPLES_MAX = 64, WITNESSES_MAX = 256 };

/* One position channel of a joint with an OFFSET that is not zero. */
typedef struct {
    int column;
    bool root;
    double offset, size; /* this coordinate of the OFFSET, and its length */
    double *value;       /* SAMPLES_MAX */
} Witness;

struct Positions {
    const Skeleton *skeleton;
    Witness *witness;
    int nwitnesses, nsamples, stride;
    double *first; /* the first row */
    bool turns;    /* seen: a joint that is no root and turns */
};

static double coordinate(Vec3 v, ChannelKind kind) { return kind == CHANNEL_TX ? v.x : kind == CHANNEL_TY ? v.y : v.z; }

bool positions_start(const Skeleton *s, Arena *arena, Positions **out, Error *e) {
    Positions *p = *out = ARENA_NEW(arena, Positions, 1, e);
    if (!p || !(p->witness = ARENA_NEW(arena, Witness, WITNESSES_MAX, e))) return false;
    if (!(p->first = ARENA_NEW(arena, double, s->nchannels, e))) return false;
    p->skeleton = s;
    p->stride = 1;
    for (int i = 0; i < s->njoints; i++) {
        const Joint *j = &s->joint[i];
        double size = vec_len(j->offset);
        if (size == 0) continue;
        for (int k = 0; k < j->nchannels && p->nwitnesses < WITNESSES_MAX; k++) {
            if (j->channel[k] > CHANNEL_TZ) continue;
            Witness *w = &p->witness[p->nwitnesses++];
            *w = (Witness){j->first_channel + k, j->parent < 0, coordinate(j->offset, j->channel[k]), size, NULL};
            if (!(w->value = ARENA_NEW(arena, double, SAMPLES_MAX, e))) return false;
        }
    }
    return true;
}

static bool turns(const Skeleton *s, const double *row) {
    for (int i = 0; i < s->njoints; i++) {
        const Joint *j = &s->joint[i];
        for (int k = 0; k < j->nchannels; k++)
            if (j->parent >= 0 && j->channel[k] >= CHANNEL_RX && j->channel[k] <= CHANNEL_RZ &&
                row[j->first_channel + k] != 0)
                return true;
    }
    return false;
}

/* When there is no room for more samples, every second one is dropped, and from then on every second frame is passed
   over: the samples stay spread evenly, whatever the number of frames. */
void positions_add(Positions *p, int frame, const double *row) {
    if (frame == 0) memcpy(p->first, row, (size_t)p->skeleton->nchannels * sizeof *row);
    p->turns = p->turns || turns(p->skeleton, row);
    if (frame % p->stride != 0) return;
    if (p->nsamples == SAMPLES_MAX) {
        for (int i = 0; i < p->nwitnesses; i++)
            for (int k = 0; k < SAMPLES_MAX / 2; k++) p->witness[i].value[k] = p->witness[i].value[2 * k];
        p->nsamples /= 2;
        p->stride *= 2;
        if (frame % p->stride != 0) return;
    }
    for (int i = 0; i < p->nwitnesses; i++) p->witness[i].value[p->nsamples] = row[p->witness[i].column];
    p->nsamples++;
}

bool positions_are_deltas(Positions *p) {
    static const double SPREAD_LEAST = 0.05; /* of the OFFSET's length: values that do not vary at all */
    static const double FAR = 10, BETTER = 2; /* most that a witness counts; how much better adding must fit */
    /* Of roots [1] and of other joints [0]: sums of the distance from what each of the two expects, in spreads. */
    double replace[2] = {0, 0}, add[2] = {0, 0};
    for (int i = 0; i < p->nwitnesses && p->nsamples > 0; i++) {
        Witness *w = &p->witness[i];
        sort_numbers(w->value, p->nsamples);
        double median = w->value[p->nsamples / 2];
        double spread = w->value[p->nsamples * 9 / 10] - w->value[p->nsamples / 10] + SPREAD_LEAST * w->size;
        replace[w->root] += fmin(fabs(median - w->offset) / spread, FAR);
        add[w->root] += fmin(fabs(median) / spread, FAR);
    }
    int asked = add[0] == replace[0];
    return BETTER * add[asked] < replace[asked];
}

static int positions_of(const Joint *j) {
    int n = 0;
    for (int k = 0; k < j->nchannels; k++) n += j->channel[k] <= CHANNEL_TZ;
    return n;
}

bool positions_are_all(const Positions *p) {
    const Skeleton *s = p->skeleton;
    int moved = 0, others = 0;
    for (int i = 0; i < s->njoints; i++) {
        if (s->joint[i].parent < 0 || s->joint[i].is_end) continue;
        if (positions_of(&s->joint[i]) == 3) moved++;
        else others++;
    }
    return !p->turns && moved > others;
}

void positions_fill_offsets(const Positions *p, Skeleton *s) {
    for (int i = 0; i < s->njoints; i++) {
        Joint *j = &s->joint[i];
        double v[3] = {0, 0, 0};
        if (j->parent < 0 || vec_len(j->offset) > 0) continue;
        for (int k = 0; k < j->nchannels; k++)
            if (j->channel[k] <= CHANNEL_TZ) v[j->channel[k]] = p->first[j->first_channel + k];
        j->offset = vec(v[0], v[1], v[2]);
    }
}
