/* Between the limbs. The joint where the legs meet is the pelvis, the joint where the arms meet is the chest, but for
   two habits of one family (Biped), and the joints between them are the spine. What leads on upwards from the
   arms is neck and head: found by name, and without names by height over the shoulders. */
#include "figure/trunk.h"

/* Weight of a name (names.h) that settles what a joint is, and the larger one that it takes to be the pelvis though the
   legs do not meet there. */
static const double NAMED = 0.5, NAMED_PELVIS = 0.7;

typedef struct {
    const Limbs *limbs;
    double stature; /* told from the lengths of leg and torso, file units */
} Human;

static Vec3 middle(const Tree *t, int frame, const LimbPair *p) {
    return sample_middle(t->sample, frame, p->limb[0].joint[0], p->limb[1].joint[0]);
}

Vec3 trunk_line(const Tree *t, int frame, const Limbs *limbs) {
    return vec_sub(middle(t, frame, limbs->arms), middle(t, frame, limbs->legs));
}

/* --- pelvis and spine --- */

/* How steady the hip line is in the frame of `joint`: length of its mean direction, 1 where it does not turn. */
static double hip_line_fixed(const Tree *t, int joint, const LimbPair *legs) {
    Vec3 sum = {0, 0, 0};
    for (int f = 0; f < t->sample->count; f++) {
        Vec3 line = vec_sub(sample_point(t->sample, f, legs->limb[0].joint[0]),
                            sample_point(t->sample, f, legs->limb[1].joint[0]));
        line = vec_unit_or(line, vec(0, 0, 0));
        sum = vec_add(sum, mat_apply(mat_transpose(sample_at(t->sample, f, joint).r), line));
    }
    return vec_len(sum) / t->sample->count;
}

/* The joint that carries the hips: where the legs meet. But 3ds Max Biped hangs the legs on the spine and keeps a
   pelvis above it, which moves the hips just as well. */
static int find_pelvis(const Tree *t, const LimbPair *legs) {
    enum { STEPS = 3 };               /* joints above the hub that are looked at */
    static const double FIXED = 0.99; /* hip_line_fixed */
    int hub = legs->hub;
    if (t->hint[hub].weight[PART_PELVIS] >= NAMED_PELVIS) return hub;
    int above = hub;
    for (int step = 0; step < STEPS; step++) {
        above = t->skeleton->joint[above].parent;
        if (above < 0) break;
        if (t->hint[above].weight[PART_PELVIS] >= NAMED_PELVIS && hip_line_fixed(t, above, legs) > FIXED) return above;
    }
    return hub;
}

/* The first joint above the pelvis on the way to `chest`; -1 where there is none between them. */
static int find_spine(const Tree *t, int pelvis, int chest) {
    int first = -1, j = t->skeleton->joint[chest].parent;
    for (; j >= 0 && !tree_below(t, pelvis, j); j = t->skeleton->joint[j].parent) first = j;
    return first;
}

/* --- neck and head --- */

/* Height of a joint over the shoulder line, along the torso: mean over the frames, file units. */
static double over_shoulders(const Tree *t, const Human *h, int joint) {
    double sum = 0;
    for (int f = 0; f < t->sample->count; f++) {
        Vec3 up = vec_unit_or(trunk_line(t, f, h->limbs), vec(0, 0, 0)), shoulders = middle(t, f, h->limbs->arms);
        sum += vec_dot(up, vec_sub(sample_point(t->sample, f, joint), shoulders)) / t->sample->count;
    }
    return sum;
}

/* The joint at or below `joint` whose name fits the part best, -1 where none does. */
static int named_below(const Tree *t, int joint, Part part) {
    int best = -1;
    double most = NAMED;
    for (int j = joint; j < t->skeleton->njoints; j++)
        if (!t->skeleton->joint[j].is_end && t->hint[j].weight[part] > most && tree_below(t, j, joint))
            most = t->hint[j].weight[part], best = j;
    return best;
}

/* The joint named neck between `first` and the head that is nearest to `first`, else `first`. */
static int named_neck(const Tree *t, int first, int head) {
    int neck = first;
    for (int j = head; j > first; j = t->skeleton->joint[j].parent)
        if (j != head && t->hint[j].weight[PART_NECK] > NAMED) neck = j;
    return t->hint[first].weight[PART_NECK] > NAMED ? first : neck;
}

static bool in_limb(const Tree *t, const LimbPair *p, int joint) {
    return tree_below(t, p->limb[0].joint[0], joint) || tree_below(t, p->limb[1].joint[0], joint);
}

/* The child of `joint` with which neck and head begin, or -1: the one that reaches highest over the shoulders, names
   first. */
static int head_branch(const Tree *t, const Human *h, int joint) {
    static const double HEAD_NAMED = 2, NECK_NAMED = 1, LEAST = 0.02; /* points */
    static const double HIGH = 0.2;                                   /* statures: worth one point */
    int best = -1;
    double most = LEAST;
    for (int c = t->child[joint]; c >= 0; c = t->sibling[c]) {
        if (t->skeleton->joint[c].is_end || in_limb(t, h->limbs->arms, c) || in_limb(t, h->limbs->legs, c)) continue;
        double points = 0, high = -1e300;
        for (int j = c; j < t->skeleton->njoints; j++)
            if (tree_below(t, j, c)) high = fmax(high, over_shoulders(t, h, j));
        if (high > 0) points = fmin(1, high / (HIGH * h->stature));
        if (named_below(t, c, PART_HEAD) >= 0) points += HEAD_NAMED;
        if (named_below(t, c, PART_NECK) >= 0) points += NECK_NAMED;
        if (points > most) most = points, best = c;
    }
    return best;
}

/* The child with which a chain goes on. -1 where it ends or branches: eyes, jaw and hair leave a head together, and
   none of them is much longer than the others. */
static int goes_on(const Tree *t, int joint) {
    static const double MUCH_SHORTER = 0.5;
    int next = -1;
    double longest = 0, second = 0;
    for (int c = t->child[joint]; c >= 0; c = t->sibling[c]) {
        double length = t->bone[c] + t->reach[c];
        if (length > longest) second = longest, longest = length, next = c;
        else second = fmax(second, length);
    }
    if (next < 0 || t->skeleton->joint[next].is_end || t->hint[next].stranger) return -1;
    return second < MUCH_SHORTER * longest ? next : -1;
}

/* Without names: the last joint on the way up that is not yet the top of the head. */
static int head_by_shape(const Tree *t, const Human *h, int first) {
    static const double CROWN = 0.14; /* statures over the shoulders */
    int head = first;
    for (int j = first; j >= 0; j = goes_on(t, j)) {
        double height = over_shoulders(t, h, j);
        if (j != first && (height > CROWN * h->stature || height < over_shoulders(t, h, head))) break;
        head = j;
    }
    return head;
}

/* Where neck and head begin: at the hub of the arms, or below it down to the pelvis. -1: nowhere. */
static int find_head_branch(const Tree *t, const Human *h, int pelvis) {
    int first = -1;
    for (int j = h->limbs->arms->hub; j >= 0 && first < 0; j = t->skeleton->joint[j].parent) {
        first = head_branch(t, h, j);
        if (tree_below(t, pelvis, j)) break;
    }
    return first;
}

/* A tree may hang from the head, as where a headset is tracked. -1: this one does not. */
static int head_above(const Tree *t, int chest) {
    int j = chest;
    while (j >= 0 && t->hint[j].weight[PART_HEAD] <= NAMED) j = t->skeleton->joint[j].parent;
    return j;
}

/* --- all of it --- */

static double find_stature(const Tree *t, const Limbs *limbs) {
    static const double STATURE_BY_LIMBS = 1.70 / 1.305; /* stature against leg and torso, of the reference figure */
    const Limb *leg = &limbs->legs->limb[0];
    double sum = leg->length[0] + leg->length[1];
    for (int f = 0; f < t->sample->count; f++) sum += vec_len(trunk_line(t, f, limbs)) / t->sample->count;
    return sum * STATURE_BY_LIMBS;
}

void trunk_find(const Tree *t, const Limbs *limbs, Roles *out) {
    Human h = {limbs, find_stature(t, limbs)};
    int chest = limbs->arms->hub, pelvis = find_pelvis(t, limbs->legs), neck = -1;
    /* Biped hangs the arms on the neck. */
    int below = t->skeleton->joint[chest].parent;
    if (t->hint[chest].weight[PART_NECK] > NAMED && below >= 0 && !tree_below(t, pelvis, below)) {
        neck = chest;
        chest = below;
    }
    out->joint[ROLE_PELVIS] = pelvis;
    out->joint[ROLE_CHEST] = chest;
    out->joint[ROLE_SPINE] = find_spine(t, pelvis, chest);
    int first = find_head_branch(t, &h, pelvis);
    if (first >= 0) {
        int named = named_below(t, first, PART_HEAD);
        int head = named >= 0 ? tree_past_nodes(t, named, PART_HEAD) : head_by_shape(t, &h, first);
        if (neck < 0 && first != head) neck = named_neck(t, first, head);
        out->joint[ROLE_HEAD] = head;
    } else {
        out->joint[ROLE_HEAD] = head_above(t, chest);
    }
    out->joint[ROLE_NECK] = neck;
}
