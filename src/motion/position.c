/* Do position channels replace the OFFSET or add to it? Both occur, and no file says which. If they replace it, a
   joint's values lie round its OFFSET; if they add, round zero. Each position channel of a joint with an OFFSET is a
   witness, the more trusted the less its values vary: while somebody walks away along x and z, the height of the
   hips still tells. Nearly all files mean to replace, so adding must fit twice as well: the hips of somebody who
   sits are below the OFFSET's height in either case. */
#include <stdlib.h>
#include <string.h>

#include "motion/source.h"

enum { SAMPLES_MAX = 64, WITNESSES_MAX = 256 };

/* One position channel of a joint with an OFFSET that is not zero. */
typedef struct {
    int column;
    double offset, size; /* this coordinate of the OFFSET, and its length */
    double *value;       /* SAMPLES_MAX */
} Witness;

struct Positions {
    Witness *witness;
    int nwitnesses, nsamples, stride;
};

static double coordinate(Vec3 v, ChannelKind kind) { return kind == CHANNEL_TX ? v.x : kind == CHANNEL_TY ? v.y : v.z; }

bool positions_start(const Skeleton *s, Arena *arena, Positions **out, Error *e) {
    Positions *p = *out = ARENA_NEW(arena, Positions, 1, e);
    if (!p || !(p->witness = ARENA_NEW(arena, Witness, WITNESSES_MAX, e))) return false;
    p->stride = 1;
    for (int i = 0; i < s->njoints; i++) {
        const Joint *j = &s->joint[i];
        double size = vec_len(j->offset);
        if (size == 0) continue;
        for (int k = 0; k < j->nchannels && p->nwitnesses < WITNESSES_MAX; k++) {
            if (j->channel[k] > CHANNEL_TZ) continue;
            Witness *w = &p->witness[p->nwitnesses++];
            *w = (Witness){j->first_channel + k, coordinate(j->offset, j->channel[k]), size, NULL};
            if (!(w->value = ARENA_NEW(arena, double, SAMPLES_MAX, e))) return false;
        }
    }
    return true;
}

/* When there is no room for more samples, every second one is dropped, and from then on every second frame is passed
   over: the samples stay spread evenly, whatever the number of frames. */
void positions_add(Positions *p, int frame, const double *row) {
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

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

bool positions_are_deltas(Positions *p) {
    static const double SPREAD_LEAST = 0.05; /* of the OFFSET's length: values that do not vary at all */
    static const double FAR = 10, BETTER = 2; /* most that a witness counts; how much better adding must fit */
    double replace = 0, add = 0; /* sums of the distance from what each of the two expects, in spreads */
    for (int i = 0; i < p->nwitnesses && p->nsamples > 0; i++) {
        Witness *w = &p->witness[i];
        qsort(w->value, (size_t)p->nsamples, sizeof *w->value, ascending);
        double median = w->value[p->nsamples / 2];
        double spread = w->value[p->nsamples * 9 / 10] - w->value[p->nsamples / 10] + SPREAD_LEAST * w->size;
        replace += fmin(fabs(median - w->offset) / spread, FAR);
        add += fmin(fabs(median) / spread, FAR);
    }
    return BETTER * add < replace;
}
