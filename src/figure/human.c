/* A human is a pair of legs and a pair of arms with a torso between them that fits them in
   length, legs pointing away from the arms; a head goes on from where the arms leave. The
   best legs and the best arms are not enough: in a T-pose, without names, arms make fine
   legs. So pairs are tried together. */
#include "figure/human.h"

enum { PAIRS = 8 };

/* Proportions of the reference figure: arm (upper + fore) and torso (hip to shoulder line)
   against the leg (thigh + shin). */
static const double ARM_BY_LEG = 0.66, TORSO_BY_LEG = 0.62;
/* Stature against leg and torso together, metres of the reference figure. */
static const double STATURE_BY_LIMBS = 1.70 / 1.305;
static const double ODD_LENGTHS = 4, LEGS_DOWN = 6, NO_HEAD = 3; /* points */
/* Beyond these (arm against leg, torso against leg) it is a bird or a giraffe, whatever the names say. People have
   0.5 to 0.7, figures of fancy up to twice that. */
static const double ARM_LEAST = 0.3, ARM_MOST = 1.6, TORSO_LEAST = 0.2, TORSO_MOST = 1.8;
/* Who has forelegs like hind legs, a long back, and never stretches the legs along it, goes on all fours. */
static const double FORELEG = 0.8, LONG_BACK = 0.8, ACROSS = 0.35;
/* Points below which two pairs are no human: without any name one gets about 35, with names 150. What each pair
   must have by itself, and a pair with a name; below that a pair alone is not worth a word. */
static const double HUMAN = 20, PAIR_LEAST = 5, PAIR_NAMED = 30;

static double square(double x) { return x * x; }

static Vec3 middle(const Tree *t, int frame, int a, int b) {
    return vec_mid(sample_point(t->sample, frame, a), sample_point(t->sample, frame, b));
}

/* From the hips to the shoulders. */
static Vec3 torso(const Tree *t, int frame, const LimbPair *legs, const LimbPair *arms) {
    return vec_sub(middle(t, frame, arms->limb[0].joint[0], arms->limb[1].joint[0]),
                   middle(t, frame, legs->limb[0].joint[0], legs->limb[1].joint[0]));
}

/* Does the hub of the arms lead on to something that is no arm? */
static bool has_head(const Tree *t, const LimbPair *arms) {
    for (int c = t->child[arms->hub]; c >= 0; c = t->sibling[c])
        if (!tree_below(t, arms->limb[0].joint[0], c) && !tree_below(t, arms->limb[1].joint[0], c) &&
            t->bone[c] + t->reach[c] > 0.1 * arms->limb[0].length[0]) return true;
    return false;
}

/* Is one of the pairs part of a limb of the other? */
static bool tangled(const Tree *t, const LimbPair *a, const LimbPair *b) {
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++)
            if (tree_below(t, b->limb[k].joint[0], a->limb[i].joint[0]) ||
                tree_below(t, a->limb[i].joint[0], b->limb[k].joint[0])) return true;
    return false;
}

static int root_of(const Tree *t, int joint) {
    while (t->skeleton->joint[joint].parent >= 0) joint = t->skeleton->joint[joint].parent;
    return joint;
}

typedef struct {
    const LimbPair *legs, *arms;
    double arm, torso; /* lengths against the leg */
    double down;       /* mean cosine between legs and torso: 1 where they always go on from it */
    double score;
} Candidate;

/* Could this be a human? Asked of the best candidate only: who is a dog by names is no human by other limbs. */
static bool possible(const Candidate *c) {
    if (c->arm < ARM_LEAST || c->arm > ARM_MOST || c->torso < TORSO_LEAST || c->torso > TORSO_MOST) return false;
    return c->arm < FORELEG || c->torso < LONG_BACK || c->down > ACROSS;
}

/* False for two pairs that cannot belong together. */
static bool human_score(const Tree *t, const LimbPair *legs, const LimbPair *arms, Candidate *out) {
    if (legs->score < PAIR_LEAST || arms->score < PAIR_LEAST || tangled(t, legs, arms)) return false;
    /* A trunk of one bone must be told by names: stars have many arms. */
    if (legs->hub == arms->hub && (legs->score < PAIR_NAMED || arms->score < PAIR_NAMED)) return false;
    if (root_of(t, legs->hub) != root_of(t, arms->hub)) return false; /* two performers in one file */
    double leg = legs->limb[0].length[0] + legs->limb[0].length[1];
    double arm = arms->limb[0].length[0] + arms->limb[0].length[1];
    double trunk = 0, down = 0;
    for (int f = 0; f < t->sample->count; f++) {
        Vec3 up = torso(t, f, legs, arms);
        trunk += vec_len(up) / t->sample->count;
        for (int i = 0; i < 2; i++) {
            Vec3 d = vec_sub(sample_point(t->sample, f, legs->limb[i].joint[2]),
                             sample_point(t->sample, f, legs->limb[i].joint[0]));
            double size = vec_len(d) * vec_len(up);
            if (size > 0) down -= vec_dot(d, up) / size / 2 / t->sample->count;
        }
    }
    if (trunk <= 0.05 * leg) return false;
    *out = (Candidate){legs, arms, arm / leg, trunk / leg, down, legs->score + arms->score + LEGS_DOWN * down};
    out->score -= ODD_LENGTHS * (square(log(out->arm / ARM_BY_LEG)) + square(log(out->torso / TORSO_BY_LEG)));
    if (!has_head(t, arms)) out->score -= NO_HEAD;
    return true;
}

/* --- left and right --- */

/* Where feet and knees point, summed over the legs of one frame; *size: how long it would be if all agreed, about
   two feet's lengths. */
static Vec3 forward(const Tree *t, int frame, const LimbPair *legs, const int tip[2], double *size) {
    Vec3 sum = {0, 0, 0};
    *size = 0;
    for (int i = 0; i < 2; i++) {
        const Limb *l = &legs->limb[i];
        Vec3 hip = sample_point(t->sample, frame, l->joint[0]), knee = sample_point(t->sample, frame, l->joint[1]);
        Vec3 ankle = sample_point(t->sample, frame, l->joint[2]);
        Vec3 axis = vec_unit_or(vec_sub(ankle, hip), vec(0, 0, 0)), bend = vec_sub(knee, hip);
        bend = vec_mad(bend, axis, -vec_dot(bend, axis));
        Vec3 foot = tip[i] >= 0 ? vec_sub(sample_point(t->sample, frame, tip[i]), ankle) : vec(0, 0, 0);
        sum = vec_add(sum, vec_add(bend, foot));
        *size += vec_len(bend) + vec_len(foot);
    }
    return sum;
}

/* > 0: limb 0 of the pair is on the left as far as feet and knees tell; about 1 where they tell
   clearly: in one who sits with stretched legs the feet point along the torso and say little. */
static double left_by_shape(const Tree *t, const LimbPair *legs, const LimbPair *arms) {
    int tip[2];
    double votes = 0, size = 0, agreed;
    for (int i = 0; i < 2; i++) {
        int end = legs->limb[i].joint[2];
        tip[i] = t->skeleton->joint[end].is_end ? -1 : sample_tip(t->sample, t->skeleton, end, legs->limb[i].length[1]);
    }
    for (int f = 0; f < t->sample->count; f++) {
        Vec3 up = torso(t, f, legs, arms), left = vec_cross(up, forward(t, f, legs, tip, &agreed));
        Vec3 hips = vec_sub(sample_point(t->sample, f, legs->limb[0].joint[0]),
                            sample_point(t->sample, f, legs->limb[1].joint[0]));
        votes += vec_dot(left, hips);
        size += vec_len(up) * agreed * vec_len(hips);
    }
    return size > 0 ? votes / size : 0;
}

static int named_side(const LimbPair *p) {
    if (p->limb[0].side * p->limb[1].side < 0) return p->limb[0].side;
    return p->limb[0].side == 0 ? -p->limb[1].side : p->limb[1].side == 0 ? p->limb[0].side : 0;
}

/* +1: limb 0 of the legs is the left one. */
static int left_leg(const Tree *t, const LimbPair *legs, const LimbPair *arms, Notes *notes) {
    double shape = left_by_shape(t, legs, arms);
    int named = named_side(legs);
    if (named == 0) {
        notes_add(notes, (Place){0}, "joint names do not tell left from right: taken from feet and knees");
        return shape >= 0 ? 1 : -1;
    }
    if (named * shape < -0.5) {
        notes_add(notes, (Place){0}, "feet and knees point backwards: left and right are swapped against the names");
        return -named;
    }
    return named;
}

/* +1: limb 0 of the arms is on the side of limb 0 of the legs. */
static int same_side(const Tree *t, const LimbPair *legs, const LimbPair *arms) {
    int named = named_side(legs) * named_side(arms);
    if (named != 0) return named;
    double votes = 0;
    for (int f = 0; f < t->sample->count; f++)
        votes += vec_dot(vec_sub(sample_point(t->sample, f, legs->limb[0].joint[0]),
                                 sample_point(t->sample, f, legs->limb[1].joint[0])),
                         vec_sub(sample_point(t->sample, f, arms->limb[0].joint[0]),
                                 sample_point(t->sample, f, arms->limb[1].joint[0])));
    return votes >= 0 ? 1 : -1;
}

/* --- limbs to roles --- */

static int real_joint(const Tree *t, int joint) { return joint >= 0 && !t->skeleton->joint[joint].is_end ? joint : -1; }

/* Rigs may put a node in front of a bone, where its parent is, and give it the bone's name: the bone is what it
   carries. */
static int past_nodes(const Tree *t, int joint, Part part) {
    for (int next = joint; next >= 0;) {
        joint = next;
        next = -1;
        if (t->bone[joint] > 0.02 * t->reach[joint]) break;
        for (int c = t->child[joint]; c >= 0; c = t->sibling[c])
            if (t->hint[c].weight[part] > 0 && t->hint[c].weight[part] >= t->hint[joint].weight[part]) next = c;
    }
    return joint;
}

/* The joint below the foot that begins the toes: a named one, else the first on the longest way. */
static int find_toe(const Tree *t, int foot) {
    if (foot < 0) return -1;
    int best = -1, first = -1;
    double most = 0.2, longest = 0;
    for (int j = foot + 1; j < t->skeleton->njoints; j++) {
        if (t->skeleton->joint[j].is_end || !tree_below(t, j, foot)) continue;
        double weight = t->hint[j].weight[PART_TOE] + 0.01 * t->reach[j] / (t->reach[foot] + 1e-300);
        if (weight > most + 1e-6) most = weight, best = j;
        double length = t->bone[j] + t->reach[j];
        if (t->skeleton->joint[j].parent == foot && length > longest) longest = length, first = j;
    }
    return best >= 0 ? past_nodes(t, best, PART_TOE) : first;
}

static void set_leg(const Tree *t, const Limb *l, int right, Roles *out) {
    int shift = right ? ROLE_RIGHT_THIGH - ROLE_LEFT_THIGH : 0;
    out->joint[ROLE_LEFT_THIGH + shift] = l->joint[0];
    out->joint[ROLE_LEFT_SHIN + shift] = l->joint[1];
    out->joint[ROLE_LEFT_FOOT + shift] = real_joint(t, l->joint[2]);
    out->joint[ROLE_LEFT_TOE + shift] = find_toe(t, real_joint(t, l->joint[2]));
}

static void set_arm(const Tree *t, const Limb *l, int right, Roles *out) {
    int shift = right ? ROLE_RIGHT_CLAVICLE - ROLE_LEFT_CLAVICLE : 0;
    out->joint[ROLE_LEFT_CLAVICLE + shift] = l->clavicle;
    out->joint[ROLE_LEFT_UPPER_ARM + shift] = l->joint[0];
    out->joint[ROLE_LEFT_FOREARM + shift] = l->joint[1];
    out->joint[ROLE_LEFT_HAND + shift] = real_joint(t, l->joint[2]);
}

/* --- torso, neck and head --- */

/* How far the hip line turns in the frame of `joint`, as mean cosine: 1 where it is fixed. */
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

/* The joint that carries the hips. It is where the legs meet, except in rigs (3ds Max Biped)
   that hang the legs on the spine and keep a pelvis above it that moves them just as well. */
static int find_pelvis(const Tree *t, const LimbPair *legs) {
    int hub = legs->hub;
    if (t->hint[hub].weight[PART_PELVIS] >= 0.7) return hub;
    int above = hub;
    for (int steps = 0; steps < 3; steps++) {
        above = t->skeleton->joint[above].parent;
        if (above < 0) break;
        if (t->hint[above].weight[PART_PELVIS] >= 0.7 && hip_line_fixed(t, above, legs) > 0.99) return above;
    }
    return hub;
}

/* The joint on the way from the pelvis to `chest` that comes first above the pelvis; -1 = none. */
static int find_spine(const Tree *t, int pelvis, int chest) {
    int first = -1, j = t->skeleton->joint[chest].parent;
    for (; j >= 0 && !tree_below(t, pelvis, j); j = t->skeleton->joint[j].parent) first = j;
    return first;
}

typedef struct {
    const LimbPair *legs, *arms;
    double stature; /* by the length of limbs and torso, file units */
} Human;

/* Height of a joint over the shoulder line along the torso, mean over the frames. */
static double over_shoulders(const Tree *t, const Human *h, int joint) {
    double sum = 0;
    for (int f = 0; f < t->sample->count; f++) {
        Vec3 up = vec_unit_or(torso(t, f, h->legs, h->arms), vec(0, 0, 0));
        Vec3 shoulders = middle(t, f, h->arms->limb[0].joint[0], h->arms->limb[1].joint[0]);
        sum += vec_dot(up, vec_sub(sample_point(t->sample, f, joint), shoulders)) / t->sample->count;
    }
    return sum;
}

/* The named head at or below `joint` that lies nearest to it, or -1. */
static int named_below(const Tree *t, int joint, Part part) {
    int best = -1;
    double most = 0.5;
    for (int j = joint; j < t->skeleton->njoints; j++)
        if (!t->skeleton->joint[j].is_end && t->hint[j].weight[part] > most && tree_below(t, j, joint))
            most = t->hint[j].weight[part], best = j;
    return best;
}

/* The named neck between `first` and the head, else `first`. */
static int named_neck(const Tree *t, int first, int head) {
    int neck = first;
    for (int j = head; j > first; j = t->skeleton->joint[j].parent)
        if (j != head && t->hint[j].weight[PART_NECK] > 0.5) neck = j;
    return t->hint[first].weight[PART_NECK] > 0.5 ? first : neck;
}

static bool in_limb(const Tree *t, const LimbPair *p, int joint) {
    return tree_below(t, p->limb[0].joint[0], joint) || tree_below(t, p->limb[1].joint[0], joint);
}

/* The child of `joint` with which neck and head begin, or -1. */
static int head_branch(const Tree *t, const Human *h, int joint) {
    int best = -1;
    double most = 0.02;
    for (int c = t->child[joint]; c >= 0; c = t->sibling[c]) {
        if (t->skeleton->joint[c].is_end || in_limb(t, h->arms, c) || in_limb(t, h->legs, c)) continue;
        double points = 0, high = -1e300;
        for (int j = c; j < t->skeleton->njoints; j++)
            if (tree_below(t, j, c)) high = fmax(high, over_shoulders(t, h, j));
        if (high > 0) points = fmin(1, high / (0.2 * h->stature));
        if (named_below(t, c, PART_HEAD) >= 0) points += 2;
        if (named_below(t, c, PART_NECK) >= 0) points += 1;
        if (points > most) most = points, best = c;
    }
    return best;
}

/* The child that a chain goes on with, or -1 where it ends or parts: eyes, jaw and hair grow from a head, and none is
   much longer than the others. */
static int goes_on(const Tree *t, int joint) {
    int next = -1;
    double longest = 0, second = 0;
    for (int c = t->child[joint]; c >= 0; c = t->sibling[c]) {
        double length = t->bone[c] + t->reach[c];
        if (length > longest) second = longest, longest = length, next = c;
        else second = fmax(second, length);
    }
    if (next < 0 || t->skeleton->joint[next].is_end || t->hint[next].stranger) return -1;
    return second < 0.5 * longest ? next : -1;
}

/* Without names: the last joint on the way up that is not yet the top of the head. */
static int head_by_shape(const Tree *t, const Human *h, int first) {
    int head = first;
    for (int j = first; j >= 0; j = goes_on(t, j)) {
        double height = over_shoulders(t, h, j);
        if (j != first && (height > 0.14 * h->stature || height < over_shoulders(t, h, head))) break;
        head = j;
    }
    return head;
}

static void set_torso(const Tree *t, const Human *h, Roles *out) {
    int chest = h->arms->hub, pelvis = find_pelvis(t, h->legs);
    int neck = -1, first = -1;
    /* Biped hangs the arms on the neck. */
    int below = t->skeleton->joint[chest].parent;
    if (t->hint[chest].weight[PART_NECK] > 0.5 && below >= 0 && !tree_below(t, pelvis, below)) {
        neck = chest;
        chest = below;
    }
    for (int j = h->arms->hub; j >= 0 && first < 0; j = t->skeleton->joint[j].parent) {
        first = head_branch(t, h, j);
        if (tree_below(t, pelvis, j)) break;
    }
    out->joint[ROLE_PELVIS] = pelvis;
    out->joint[ROLE_CHEST] = chest;
    out->joint[ROLE_SPINE] = find_spine(t, pelvis, chest);
    if (first >= 0) {
        int named = named_below(t, first, PART_HEAD);
        int head = named >= 0 ? past_nodes(t, named, PART_HEAD) : head_by_shape(t, h, first);
        bool only_neck = head == first && named < 0 && t->hint[first].weight[PART_NECK] > 0.5;
        if (only_neck) head = -1;
        if (neck < 0 && first != head) neck = named_neck(t, first, head);
        out->joint[ROLE_HEAD] = head;
    }
    out->joint[ROLE_NECK] = neck;
}

/* --- the human --- */

static void set_limbs(const Tree *t, const LimbPair *legs, const LimbPair *arms, int left, int same, Roles *out) {
    for (int i = 0; i < 2; i++) {
        if (legs) set_leg(t, &legs->limb[i], (i == 0) != (left > 0), out);
        if (arms) set_arm(t, &arms->limb[i], (i == 0) != (left * same > 0), out);
    }
}

void human_find(const Tree *t, Notes *notes, Roles *out) {
    LimbPair legs[PAIRS], arms[PAIRS];
    int nlegs = limbs_find(t, LIMB_LEG, PAIRS, legs), narms = limbs_find(t, LIMB_ARM, PAIRS, arms);
    Candidate best = {.score = HUMAN}, c;
    for (int r = 0; r < ROLE_COUNT; r++) out->joint[r] = -1;
    for (int l = 0; l < nlegs; l++)
        for (int a = 0; a < narms; a++)
            if (human_score(t, &legs[l], &arms[a], &c) && c.score > best.score) best = c;
    if (best.legs && possible(&best)) {
        Human h = {best.legs, best.arms, best.legs->limb[0].length[0] + best.legs->limb[0].length[1]};
        for (int f = 0; f < t->sample->count; f++)
            h.stature += vec_len(torso(t, f, best.legs, best.arms)) / t->sample->count;
        h.stature *= STATURE_BY_LIMBS;
        set_limbs(t, best.legs, best.arms, left_leg(t, best.legs, best.arms, notes),
                  same_side(t, best.legs, best.arms), out);
        set_torso(t, &h, out);
        return;
    }
    /* No human: name the limbs that names make certain, so that the message is of use. Arms that do not go with
       the legs are missing. */
    if (nlegs > 0 && legs[0].score > PAIR_NAMED) {
        int left = named_side(&legs[0]) < 0 ? -1 : 1;
        set_limbs(t, &legs[0], NULL, left, 1, out);
        out->joint[ROLE_PELVIS] = legs[0].hub;
    } else if (narms > 0 && arms[0].score > PAIR_NAMED) {
        int left = named_side(&arms[0]) < 0 ? -1 : 1;
        set_limbs(t, NULL, &arms[0], left, 1, out);
        out->joint[ROLE_CHEST] = arms[0].hub;
    }
}
