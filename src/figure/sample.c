/* Evenly spread frames, kept as world transforms. */
#include "figure/sample.h"

enum { LONG_MOTION = 8 };                  /* frames: from here on the first one is left out */
static const long TRANSFORMS_MAX = 200000; /* of the sample, about 20 MB: many joints leave few frames */

MUST_CHECK static bool read_rows(const Motion *m, MotionReader *reader, int count, const int *frame, double *row,
                                 Rigid *world, Error *e) {
    for (int i = 0; i < count; i++) {
        if (!motion_row(reader, frame[i], row, e)) return false;
        skeleton_pose(&m->skeleton, row, world + (long)i * m->skeleton.njoints);
    }
    return true;
}

/* Sums from the joint up to the root: another order would round differently. */
static void zero_pose(const Skeleton *s, Rigid *world) {
    for (int j = 0; j < s->njoints; j++) {
        Vec3 place = {0, 0, 0};
        for (int k = j; k >= 0; k = s->joint[k].parent) place = vec_add(place, s->joint[k].offset);
        world[j] = (Rigid){mat_identity(), place};
    }
}

bool sample_read(const Motion *m, int wanted, Arena *arena, Sample *out, Error *e) {
    int first = m->nframes >= LONG_MOTION ? 1 : 0, n = m->nframes - first;
    int count = wanted < n ? wanted : n;
    if (count > SAMPLE_FRAMES_MAX) count = SAMPLE_FRAMES_MAX;
    long most = TRANSFORMS_MAX / (m->skeleton.njoints + 1) + 1;
    if (count > most) count = (int)most;

    int njoints = m->skeleton.njoints;
    int *frame = ARENA_NEW(arena, int, count + 1, e); /* the motion's first, and then those of the sample */
    double *row = frame ? ARENA_NEW(arena, double, m->skeleton.nchannels, e) : NULL;
    Rigid *world = row ? ARENA_NEW(arena, Rigid, (size_t)(count + 2) * (size_t)njoints, e) : NULL;
    if (!world) return false;
    for (int i = 0; i < count; i++)
        frame[i + 1] = first + (count > 1 ? (int)((long long)i * (n - 1) / (count - 1)) : n / 2);

    MotionReader *reader;
    if (!motion_reader_open(m, arena, &reader, e)) return false;
    Rigid *zero = world, *taken = zero + njoints;
    bool good = read_rows(m, reader, count + 1, frame, row, taken, e);
    motion_reader_close(reader);
    zero_pose(&m->skeleton, zero);
    *out = (Sample){count, njoints, frame + 1, taken + njoints, taken, zero};
    return good;
}

double sample_distance(const Sample *s, int a, int b) {
    double sum = 0;
    for (int i = 0; i < s->count; i++) sum += vec_dist(sample_point(s, i, a), sample_point(s, i, b));
    return s->count ? sum / s->count : 0;
}

int sample_best(const Sample *s, const double *score, int out[SAMPLE_BEST_MAX]) {
    int count = 0, few = s->count < 3 ? s->count : 3, most = s->count / 4 > few ? s->count / 4 : few;
    for (int i = 0; i < s->count; i++) {
        int k = count;
        if (k < most) count++;
        else if (score[i] > score[out[most - 1]]) k = most - 1;
        else continue;
        for (; k > 0 && score[out[k - 1]] < score[i]; k--) out[k] = out[k - 1];
        out[k] = i;
    }
    return count;
}

int sample_standing(const Sample *s, Mat3 upright, int ankle, int tip, double rise, int out[SAMPLE_BEST_MAX]) {
    static const double SLACK = 0.5, STEEP = 4; /* rises that differ by so many rises are alike; weight of the rest */
    double score[SAMPLE_FRAMES_MAX];
    for (int i = 0; i < s->count; i++) {
        double low = mat_apply(upright, sample_point(s, i, tip)).y;
        double high = mat_apply(upright, sample_point(s, i, ankle)).y;
        score[i] = -low - high - STEEP * fmax(0, fabs(high - low - rise) - SLACK * rise);
    }
    return sample_best(s, score, out);
}

int sample_tip(const Sample *s, const Skeleton *skeleton, int joint, double limit) {
    int tip = -1;
    double farthest = 0;
    for (int j = joint + 1; s->count > 0 && j < skeleton->njoints; j++) {
        if (!skeleton_below(skeleton, j, joint)) continue;
        double d = vec_dist(sample_point(s, 0, joint), sample_point(s, 0, j));
        if (d > farthest * (1 + 1e-9) && d <= limit) farthest = d, tip = j;
    }
    return tip;
}
