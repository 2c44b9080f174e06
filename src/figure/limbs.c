/* Legs and arms are what makes a skeleton human: two chains of two long bones that leave one joint and mirror each
   other in length. Every choice of three joints along a chain that could be a limb gets points: for names that say so,
   for two bones of like length, for covering most of the chain. Names weigh most, so they settle what they know; shape
   decides the rest, so a skeleton with meaningless names is found by the same search. */
#include "figure/limbs.h"

enum {
    DEPTH_MAX = 12,    /* joints of a chain that are looked at: arms of split bones reach the wrist at the eighth */
    START_MAX = 5,     /* a limb begins at most so many joints below the hub */
    CHILDREN_MAX = 12, /* limbs of a hub that are kept, the best one of each child */
};

/* Points. A fully named pair gets about 50, a well shaped one about 10 more. Won by names, times their weights: */
static const double LONG_BONE_NAMED = 10, END_NAMED = 6, CLAVICLE_NAMED = 4, SIDES_NAMED = 5;
static const double NO_LIMB_NAMED = 20; /* lost by a name of another part of the body, or of no body at all */
static const double SAME_SIDE = 20;     /* lost by two limbs of the same side */
/* By shape: won by a limb that covers the whole chain; lost, for bones of uneven lengths, for each joint that is jumped
   over, for each of them where the chain forks, for one that bends, for a limb that starts far from the hub, for an end
   that is an end site, for an end that coincides with the joint before it, for two limbs of unlike lengths. */
static const double COVERAGE = 8;
static const double UNEVEN = 4, SKIPPED = 0.4, FORKED = 2, BENT = 20, FAR_START = 4, NO_END_JOINT = 1;
static const double COINCIDES = 0.5, MIRROR = 8;
static const double STILL = 2; /* lost by a limb that never moves against its hub */

/* For legs and arms. The usual ln(upper bone / lower bone): 0.415 m / 0.39 m, 0.28 / 0.25 in the reference figure. */
static const double EVEN[2] = {0.06, 0.11};
/* The share of the two long bones in the whole chain that counts as covering it. */
static const double SHARE[2] = {0.75, 0.58};
/* Shares of the chain, or of the other bone, that a limb has at least. */
static const double BOTH_LEAST = 0.1, SHORTER_LEAST = 0.2;
/* A joint this near to the one before it (against chain or limb) coincides with it. */
static const double NO_WAY = 0.02;

/* A chain of joints from a child of the hub downwards. */
typedef struct {
    int count, joint[DEPTH_MAX];
    double along[DEPTH_MAX]; /* distance from the hub along the chain */
    const Limb *like;        /* the limb of the other side, if that is known */
} Way;

/* How surely the name says that this is no limb: a bone of the trunk, neck or head, or of no body at all. */
static double of_no_limb(const Tree *t, int joint) {
    static const double STRANGER = 0.4;
    double most = t->hint[joint].stranger ? STRANGER : 0;
    for (int part = PART_PELVIS; part <= PART_HEAD; part++) most = fmax(most, t->hint[joint].weight[part]);
    return most;
}

static double name_points(const Tree *t, LimbKind kind, const int joint[3]) {
    static const Part part[2][3] = {{PART_THIGH, PART_SHIN, PART_FOOT}, {PART_UPPER_ARM, PART_FOREARM, PART_HAND}};
    return LONG_BONE_NAMED * (t->hint[joint[0]].weight[part[kind][0]] + t->hint[joint[1]].weight[part[kind][1]]) +
           END_NAMED * t->hint[joint[2]].weight[part[kind][2]] -
           NO_LIMB_NAMED * (of_no_limb(t, joint[0]) + of_no_limb(t, joint[1]));
}

/* The joint before the upper arm that looks most like a clavicle: by name, and without names the first from which it is
   still some way to the shoulder. *points: won by its name. */
static int find_clavicle(const Tree *t, const Way *w, int start, double *points) {
    static const double SOME_WAY = 0.3, BONE = 0.1; /* of the way from the hub; weight against that of a name */
    int best = -1;
    double most = -1;
    for (int i = 0; i < start; i++) {
        bool bone = w->along[start] - w->along[i] > SOME_WAY * w->along[start];
        double weight = t->hint[w->joint[i]].weight[PART_CLAVICLE] + (bone ? BONE : 0);
        if (weight > most + 1e-9) most = weight, best = i;
    }
    *points = best >= 0 ? CLAVICLE_NAMED * t->hint[w->joint[best]].weight[PART_CLAVICLE] : 0;
    return best >= 0 ? w->joint[best] : -1;
}

/* Do chains leave this joint in different directions? Children in the same place count as one: if their chains part,
   they part there. */
static bool forks(const Tree *t, int joint) {
    static const double SAME_PLACE = 0.1; /* of the bone to the child */
    int first = -1;
    for (int c = t->child[joint]; c >= 0; c = t->sibling[c]) {
        if (t->skeleton->joint[c].is_end || !(t->reach[c] > 0)) continue;
        if (first >= 0 && sample_distance(t->sample, first, c) > SAME_PLACE * t->bone[c]) return true;
        first = c;
    }
    return false;
}

/* Points of a bone that jumps over joints between places `from` and `to` of the chain. Rigs split bones (upper_arm,
   upper_arm.001); such a bone is always straight and nothing branches off. chord: mean distance of the two places. */
static double skip_points(const Tree *t, const Way *w, int from, int to, double chord) {
    double path = w->along[to] - w->along[from], points = 0;
    for (int i = from + 1; i < to; i++) {
        if (w->along[i + 1] - w->along[i] > NO_WAY * w->along[w->count - 1]) points -= SKIPPED;
        if (forks(t, w->joint[i])) points -= FORKED;
    }
    return path > 0 ? points - BENT * (1 - chord / path) : points;
}

/* Does a limb that leaves `hub` keep still against it in all frames? Beside the bones that move the body, rigs carry
   chains of the same names for their animators, which may be at rest. */
static bool keeps_still(const Tree *t, int hub, const Limb *limb) {
    static const double NO_MOVE = 1e-3; /* of the limb */
    if (t->sample->count < 2) return false; /* a single pose does not tell */
    for (int i = 1; i < 3; i++) {
        Vec3 first = {0, 0, 0};
        for (int f = 0; f < t->sample->count; f++) {
            Rigid g = sample_at(t->sample, f, hub);
            Vec3 at = mat_apply(mat_transpose(g.r), vec_sub(sample_point(t->sample, f, limb->joint[i]), g.t));
            if (f == 0) first = at;
            if (vec_dist(at, first) > NO_MOVE * (limb->length[0] + limb->length[1])) return false;
        }
    }
    return true;
}

/* Points lost by two limbs for bones of unlike lengths. */
static double unlikeness(const Limb *a, const Limb *b) {
    return MIRROR * (square(log(a->length[0] / b->length[0])) + square(log(a->length[1] / b->length[1])));
}

/* How many upper bones beyond the first one a limb starts from the hub. An elbow too low makes that bone longer: it
   counts no more than the usual share of the limb, or the shoulder would seem nearer. */
static double far_start(LimbKind kind, const Limb *limb, double along) {
    double ratio = exp(EVEN[kind]), usual = ratio / (1 + ratio) * (limb->length[0] + limb->length[1]);
    return fmax(0, along / fmin(limb->length[0], usual) - 1);
}

/* Scores the limb of the chain's joints a, b and its last one, and keeps it in *best if it is better. */
static void try_limb(const Tree *t, LimbKind kind, const Way *w, int a, int b, Limb *best) {
    int c = w->count - 1, end = w->joint[c];
    Limb limb = {.first = w->joint[0], .joint = {w->joint[a], w->joint[b], end}, .clavicle = -1, .found = true};
    limb.length[0] = sample_distance(t->sample, limb.joint[0], limb.joint[1]);
    limb.length[1] = sample_distance(t->sample, limb.joint[1], limb.joint[2]);
    double total = w->along[c] - w->along[0] + t->reach[end], both = limb.length[0] + limb.length[1];
    double shorter = fmin(limb.length[0], limb.length[1]), longer = fmax(limb.length[0], limb.length[1]);
    if (!(both > 0) || both < BOTH_LEAST * total || shorter < SHORTER_LEAST * longer) return;

    double uneven = log(limb.length[0] / limb.length[1]) - EVEN[kind];
    limb.score = name_points(t, kind, limb.joint) - UNEVEN * uneven * uneven;
    limb.score += COVERAGE * fmin(1, both / total / SHARE[kind]);
    limb.score += skip_points(t, w, a, b, limb.length[0]) + skip_points(t, w, b, c, limb.length[1]);
    limb.score -= FAR_START * far_start(kind, &limb, w->along[a]);
    if (t->skeleton->joint[end].is_end) limb.score -= NO_END_JOINT;
    if (t->bone[end] < NO_WAY * both) limb.score -= COINCIDES;
    if (kind == LIMB_ARM) {
        double points;
        limb.clavicle = find_clavicle(t, w, a, &points);
        limb.score += points;
    }
    if (w->like) limb.score -= unlikeness(&limb, w->like);
    if (best->found && limb.score <= best->score + 1e-9) return;
    if (keeps_still(t, t->skeleton->joint[w->joint[0]].parent, &limb)) limb.score -= STILL;
    if (best->found && limb.score <= best->score + 1e-9) return;
    int votes = 0;
    for (int i = 0; i < w->count; i++) votes += t->hint[w->joint[i]].side;
    limb.side = (votes > 0) - (votes < 0);
    *best = limb;
}

/* Tries every limb of every chain that goes on from w with `joint`. */
static void walk_limbs(const Tree *t, LimbKind kind, Way *w, int joint, Limb *best) {
    if (w->count >= DEPTH_MAX) return;
    double before = w->count > 0 ? w->along[w->count - 1] : 0;
    w->along[w->count] = before + t->bone[joint];
    w->joint[w->count++] = joint;
    for (int b = 1; b < w->count - 1; b++)
        for (int a = 0; a < b && a < START_MAX; a++) try_limb(t, kind, w, a, b, best);
    for (int c = t->child[joint]; c >= 0; c = t->sibling[c]) walk_limbs(t, kind, w, c, best);
    w->count--;
}

/* The best limb that begins at or below `first`, a child of the hub: by itself, or beside the limb `like` of the other
   side. */
static Limb best_limb(const Tree *t, LimbKind kind, int first, const Limb *like) {
    Way way = {.like = like};
    Limb best = {0};
    walk_limbs(t, kind, &way, first, &best);
    if (like && best.found) best.score += unlikeness(&best, like); /* the pair loses it, and not the limb */
    return best;
}

static LimbPair make_pair(const Tree *t, int hub, const Limb *a, const Limb *b) {
    LimbPair pair = {hub, {*a, *b}, a->score + b->score - unlikeness(a, b)};
    double da = sample_distance(t->sample, hub, a->joint[0]), db = sample_distance(t->sample, hub, b->joint[0]);
    double size = a->length[0] + a->length[1];
    pair.score -= MIRROR * square((da - db) / size);
    if (a->side * b->side < 0) pair.score += SIDES_NAMED;
    if (a->side * b->side > 0) pair.score -= SAME_SIDE;
    return pair;
}

/* Two limbs of a hub. What a hand holds may look more like a limb than the arm itself does. So where two are unlike,
   each is also paired with what is best beside it on the other side. */
static LimbPair best_pair(const Tree *t, LimbKind kind, int hub, const Limb *a, const Limb *b) {
    static const double UNLIKE = 2; /* points */
    LimbPair best = make_pair(t, hub, a, b);
    for (int way = 0; way < 2 && unlikeness(a, b) > UNLIKE; way++) {
        const Limb *kept = way ? b : a;
        Limb other = best_limb(t, kind, way ? a->first : b->first, kept);
        LimbPair pair = make_pair(t, hub, kept, &other);
        if (pair.score > best.score) best = pair;
    }
    return best;
}

/* Keeps the `most` best pairs, best first. */
static void keep_pair(LimbPair pair, int most, LimbPair *out, int *count) {
    int i = *count < most ? (*count)++ : most;
    if (i == most && pair.score <= out[most - 1].score) return;
    if (i == most) i--;
    while (i > 0 && out[i - 1].score < pair.score) { out[i] = out[i - 1]; i--; }
    out[i] = pair;
}

/* The best limbs that leave a hub, one for each child, best first. Returns their number; 0 where fewer than two joints
   leave it. */
static int limbs_of_hub(const Tree *t, LimbKind kind, int hub, Limb limb[CHILDREN_MAX]) {
    int n = 0, children = 0;
    for (int c = t->child[hub]; c >= 0; c = t->sibling[c]) children += !t->skeleton->joint[c].is_end;
    for (int c = t->child[hub]; c >= 0 && children >= 2; c = t->sibling[c]) {
        if (t->skeleton->joint[c].is_end) continue;
        Limb l = best_limb(t, kind, c, NULL);
        if (!l.found || (n == CHILDREN_MAX && limb[n - 1].score >= l.score)) continue;
        int i = n < CHILDREN_MAX ? n++ : n - 1;
        while (i > 0 && limb[i - 1].score < l.score) { limb[i] = limb[i - 1]; i--; }
        limb[i] = l;
    }
    return n;
}

int limbs_find(const Tree *t, LimbKind kind, int most, LimbPair *out) {
    int count = 0;
    for (int hub = 0; hub < t->skeleton->njoints; hub++) {
        Limb limb[CHILDREN_MAX];
        int n = limbs_of_hub(t, kind, hub, limb);
        for (int a = 0; a < n; a++)
            for (int b = a + 1; b < n; b++) keep_pair(best_pair(t, kind, hub, &limb[a], &limb[b]), most, out, &count);
    }
    return count;
}
