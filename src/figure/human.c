/* A human is a pair of legs and a pair of arms with a torso between them that fits them in length. The legs go on from
   the torso, away from the arms, and a head goes on from where the arms leave.

   The best legs and the best arms by themselves are not enough: in a T-pose, without names, arms make fine legs. So
   every pair of legs is tried with every pair of arms, and the two together get points. */
#include "figure/human.h"

#include "figure/trunk.h"

enum { PAIRS = 8 }; /* of each kind that are tried */

/* Lengths of the reference figure against its leg (thigh and shin): arm (upper arm and forearm), torso (hip line to
   shoulder line). */
static const double ARM_BY_LEG = 0.66, TORSO_BY_LEG = 0.62;

/* Points, added to those of the pairs (limbs.c): lost for a length that is e times or 1/e of the usual; won by legs
   that always go straight on from the torso; lost where nothing leads on to a head, and where arms and legs leave
   different branches of the tree, as those of two figures do. */
static const double ODD_LENGTHS = 4, LEGS_DOWN = 6, NO_HEAD = 3, OTHER_BRANCH = 3;
static const double HEAD_LEAST = 0.1; /* what leads on to a head is at least as long as that, in upper arms */

/* The least points of a human: skeletons without any name get about 35, with names 150. */
static const double HUMAN = 20;
/* The least points of a pair in it, and of a pair whose names alone make it certain. */
static const double PAIR_LEAST = 5, PAIR_NAMED = 30;

/* Lengths against the leg beyond which it is a bird or a giraffe, whatever the names say. Real people have arms of 0.5
   to 0.7, cartoon figures of up to twice that. */
static const double ARM_LEAST = 0.3, ARM_MOST = 1.6, TORSO_LEAST = 0.2, TORSO_MOST = 1.8;
static const double TORSO_NONE = 0.05; /* shorter, and there is none */
/* A figure with forelegs as long as its hind legs, a long back, and legs that are never stretched along it (mean
   cosine) goes on all fours. */
static const double FORELEG = 0.8, LONG_BACK = 0.8, ACROSS = 0.35;

/* Does the joint where the arms meet lead on to something that is no arm? */
static bool has_head(const Tree *t, const LimbPair *arms) {
    for (int c = t->child[arms->hub]; c >= 0; c = t->sibling[c])
        if (!tree_below(t, arms->limb[0].joint[0], c) && !tree_below(t, arms->limb[1].joint[0], c) &&
            t->bone[c] + t->reach[c] > HEAD_LEAST * arms->limb[0].length[0]) return true;
    return false;
}

/* Does a limb of one pair begin on a limb of the other? */
static bool tangled(const Tree *t, const LimbPair *a, const LimbPair *b) {
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++)
            if (tree_below(t, b->limb[k].joint[0], a->limb[i].joint[0]) ||
                tree_below(t, a->limb[i].joint[0], b->limb[k].joint[0])) return true;
    return false;
}

/* Is one of two joints below the other? */
static bool in_line(const Tree *t, int a, int b) { return tree_below(t, a, b) || tree_below(t, b, a); }

static int root_of(const Tree *t, int joint) {
    while (t->skeleton->joint[joint].parent >= 0) joint = t->skeleton->joint[joint].parent;
    return joint;
}

typedef struct {
    Limbs limbs;
    double arm, torso; /* lengths against the leg */
    double down;       /* mean cosine between legs and the line from shoulders to hips: 1 where they go straight on */
    int against;       /* roles that are told, and that another figure plays */
    double score;
} Candidate;

/* Could this be a human? Asked of the best candidate only, or a dog that names give away would be found to be a human
   by some other of its limbs. */
static bool possible(const Candidate *c) {
    if (c->arm < ARM_LEAST || c->arm > ARM_MOST || c->torso < TORSO_LEAST || c->torso > TORSO_MOST) return false;
    return c->arm < FORELEG || c->torso < LONG_BACK || c->down > ACROSS;
}

/* False for two pairs that cannot belong together. */
static bool human_score(const Tree *t, const LimbPair *legs, const LimbPair *arms, Candidate *out) {
    if (legs->score < PAIR_LEAST || arms->score < PAIR_LEAST || tangled(t, legs, arms)) return false;
    /* A trunk of one joint must be told by names: any star of chains has such limbs. */
    if (legs->hub == arms->hub && (legs->score < PAIR_NAMED || arms->score < PAIR_NAMED)) return false;
    if (root_of(t, legs->hub) != root_of(t, arms->hub)) return false; /* two performers in one file */
    double leg = legs->limb[0].length[0] + legs->limb[0].length[1];
    double arm = arms->limb[0].length[0] + arms->limb[0].length[1];
    double trunk = 0, down = 0;
    Limbs limbs = {legs, arms};
    for (int f = 0; f < t->sample->count; f++) {
        Vec3 up = trunk_line(t, f, &limbs);
        trunk += vec_len(up) / t->sample->count;
        for (int i = 0; i < 2; i++) {
            Vec3 d = vec_sub(sample_point(t->sample, f, legs->limb[i].joint[2]),
                             sample_point(t->sample, f, legs->limb[i].joint[0]));
            double size = vec_len(d) * vec_len(up);
            if (size > 0) down -= vec_dot(d, up) / size / 2 / t->sample->count;
        }
    }
    if (trunk <= TORSO_NONE * leg) return false;
    *out = (Candidate){limbs, arm / leg, trunk / leg, down, 0, legs->score + arms->score + LEGS_DOWN * down};
    out->score -= ODD_LENGTHS * (square(log(out->arm / ARM_BY_LEG)) + square(log(out->torso / TORSO_BY_LEG)));
    if (!has_head(t, arms)) out->score -= NO_HEAD;
    if (!in_line(t, legs->hub, arms->hub)) out->score -= OTHER_BRANCH;
    return true;
}

/* --- several figures --- */

/* Can this joint play that role in a figure with these limbs? Left and right are not asked: they may change places. */
static bool belongs_to(const Tree *t, const Limbs *limbs, Role role, int joint) {
    int limb = role_limb(role);
    const LimbPair *p = limb > 2 || role == ROLE_PELVIS || role == ROLE_SPINE ? limbs->legs : limbs->arms;
    if (limb == 0) return in_line(t, joint, p->hub);
    return in_line(t, joint, p->limb[0].joint[1]) || in_line(t, joint, p->limb[1].joint[1]);
}

static int count_against(const Tree *t, const Limbs *limbs, const Roles *told) {
    int n = 0;
    for (Role r = 0; r < ROLE_COUNT; r++) n += told->joint[r] >= 0 && !belongs_to(t, limbs, r, told->joint[r]);
    return n;
}

/* --- left and right --- */

/* Where feet and knees point in a frame: the sum over both legs of the way from ankle to tip and of the knee's way off
   the line from hip to ankle. *size: how long the sum would be if all four pointed one way. */
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

/* Which leg is the left one, by where feet and knees point, on the mean over the frames: from 1 (certainly limb 0) to
   -1. About 0 where they do not tell: if somebody sits with stretched legs the feet point along the torso. */
static double left_by_shape(const Tree *t, const Limbs *limbs) {
    const LimbPair *legs = limbs->legs;
    int tip[2];
    double votes = 0, size = 0, agreed;
    for (int i = 0; i < 2; i++) {
        int end = legs->limb[i].joint[2];
        tip[i] = t->skeleton->joint[end].is_end ? -1 : sample_tip(t->sample, t->skeleton, end, legs->limb[i].length[1]);
    }
    for (int f = 0; f < t->sample->count; f++) {
        Vec3 up = trunk_line(t, f, limbs), left = vec_cross(up, forward(t, f, legs, tip, &agreed));
        Vec3 hips = vec_sub(sample_point(t->sample, f, legs->limb[0].joint[0]),
                            sample_point(t->sample, f, legs->limb[1].joint[0]));
        votes += vec_dot(left, hips);
        size += vec_len(up) * agreed * vec_len(hips);
    }
    return size > 0 ? votes / size : 0;
}

/* The side of limb 0 by names: +1 left, -1 right, 0 where they do not tell. */
static int named_side(const LimbPair *p) {
    if (p->limb[0].side * p->limb[1].side < 0) return p->limb[0].side;
    return p->limb[0].side == 0 ? -p->limb[1].side : p->limb[1].side == 0 ? p->limb[0].side : 0;
}

/* +1: limb 0 of the legs is the left one. */
static int left_leg(const Tree *t, const Limbs *limbs, Notes *notes) {
    static const double CONTRADICTS = 0.5;
    double shape = left_by_shape(t, limbs);
    int named = named_side(limbs->legs);
    if (named == 0) {
        notes_add(notes, (Place){0}, "joint names do not tell left from right: taken from feet and knees");
        return shape >= 0 ? 1 : -1;
    }
    if (named * shape < -CONTRADICTS) {
        notes_add(notes, (Place){0}, "feet and knees point backwards: left and right are swapped against the names");
        return -named;
    }
    return named;
}

/* +1: limb 0 of the arms is on the side of limb 0 of the legs. */
static int same_side(const Tree *t, const Limbs *limbs) {
    const LimbPair *legs = limbs->legs, *arms = limbs->arms;
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

/* Is joint the first below the foot that is no stranger, as a heel is? */
static bool is_first(const Tree *t, int joint, int foot) {
    if (t->hint[joint].stranger) return false;
    do joint = t->skeleton->joint[joint].parent;
    while (joint != foot && t->hint[joint].stranger);
    return joint == foot;
}

/* The joint below the foot with which the toes begin: the one that is named best, the nearest to the foot of several
   named alike; without names of those that are first below the foot the one with the longest chain. */
static int find_toe(const Tree *t, int foot) {
    static const double NAMED = 0.2, NEARER = 0.01; /* least weight of a name; what being nearer may add to it */
    if (foot < 0) return -1;
    int best = -1, first = -1;
    double most = NAMED, longest = 0;
    for (int j = foot + 1; j < t->skeleton->njoints; j++) {
        if (t->skeleton->joint[j].is_end || !tree_below(t, j, foot)) continue;
        double weight = t->hint[j].weight[PART_TOE] + NEARER * t->reach[j] / (t->reach[foot] + 1e-300);
        if (weight > most + 1e-6) most = weight, best = j;
        double length = t->bone[j] + t->reach[j];
        if (length > longest && is_first(t, j, foot)) longest = length, first = j;
    }
    return best >= 0 ? tree_past_nodes(t, best, PART_TOE) : first;
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

/* --- the human --- */

/* left: +1 if limb 0 of the legs is the left one, else -1; same: likewise, if limb 0 of the arms is on its side. Either
   pair may be NULL. */
static void set_limbs(const Tree *t, const Limbs *limbs, int left, int same, Roles *out) {
    for (int i = 0; i < 2; i++) {
        if (limbs->legs) set_leg(t, &limbs->legs->limb[i], (i == 0) != (left > 0), out);
        if (limbs->arms) set_arm(t, &limbs->arms->limb[i], (i == 0) != (left * same > 0), out);
    }
}

/* No human: sets the limbs that names make certain, so that the message can tell what is missing. Arms that do not go
   with the legs are missing. */
static void set_certain(const Tree *t, const LimbPair *legs, const LimbPair *arms, Roles *out) {
    if (legs && legs->score > PAIR_NAMED) {
        set_limbs(t, &(Limbs){legs, NULL}, named_side(legs) < 0 ? -1 : 1, 1, out);
        out->joint[ROLE_PELVIS] = legs->hub;
    } else if (arms && arms->score > PAIR_NAMED) {
        set_limbs(t, &(Limbs){NULL, arms}, named_side(arms) < 0 ? -1 : 1, 1, out);
        out->joint[ROLE_CHEST] = arms->hub;
    }
}

/* Do all joints hang on a root? Then the tree tells nothing. */
static bool is_flat(const Tree *t) {
    for (int j = 0; j < t->skeleton->njoints; j++) {
        int parent = t->skeleton->joint[j].parent;
        if (!t->skeleton->joint[j].is_end && parent >= 0 && t->skeleton->joint[parent].parent >= 0) return false;
    }
    return true;
}

static bool plays_any(const Roles *roles, int joint) {
    for (int r = 0; r < ROLE_COUNT; r++)
        if (roles->joint[r] == joint) return true;
    return false;
}

static Part part_of(Role role) {
    if (role < ROLE_LEFT_CLAVICLE) return (Part)(PART_PELVIS + (int)role);
    if (role < ROLE_LEFT_THIGH) return PART_CLAVICLE + (role - ROLE_LEFT_CLAVICLE) % (PART_THIGH - PART_CLAVICLE);
    return PART_THIGH + (role - ROLE_LEFT_THIGH) % (PART_COUNT - PART_THIGH);
}

/* For each role the joint whose name fits best. From the last to the first: a shoulder is an upper arm before it is a
   clavicle. Without a chest the last joint of the spine is it. */
static void set_by_names(const Tree *t, Roles *out) {
    static const double NAMED = 0.5;
    int last_spine = -1;
    for (int j = 0; j < t->skeleton->njoints; j++)
        if (t->hint[j].weight[PART_SPINE] > NAMED) last_spine = j;
    for (int r = ROLE_COUNT - 1; r >= 0; r--) {
        int limb = role_limb((Role)r), side = limb == 0 ? 0 : limb % 2 ? 1 : -1;
        double most = NAMED;
        for (int j = 0; j < t->skeleton->njoints; j++) {
            double weight = t->hint[j].weight[part_of((Role)r)];
            if (t->hint[j].side != side || weight <= most || plays_any(out, j)) continue;
            most = weight;
            out->joint[r] = j;
        }
        if (r == ROLE_CHEST && out->joint[r] < 0) out->joint[r] = last_spine;
    }
}

void human_find(const Tree *t, const Roles *told, Notes *notes, Roles *out) {
    LimbPair legs[PAIRS], arms[PAIRS];
    int nlegs = limbs_find(t, LIMB_LEG, PAIRS, legs), narms = limbs_find(t, LIMB_ARM, PAIRS, arms);
    Candidate best = {.score = HUMAN, .against = ROLE_COUNT}, c;
    for (int r = 0; r < ROLE_COUNT; r++) out->joint[r] = -1;
    for (int l = 0; l < nlegs; l++)
        for (int a = 0; a < narms; a++) {
            if (!human_score(t, &legs[l], &arms[a], &c) || c.score <= HUMAN) continue;
            c.against = count_against(t, &c.limbs, told);
            if (c.against < best.against || (c.against == best.against && c.score > best.score)) best = c;
        }
    if (best.limbs.legs && possible(&best)) {
        set_limbs(t, &best.limbs, left_leg(t, &best.limbs, notes), same_side(t, &best.limbs), out);
        trunk_find(t, &best.limbs, out);
    } else if (is_flat(t)) {
        set_by_names(t, out);
    } else {
        set_certain(t, nlegs > 0 ? &legs[0] : NULL, narms > 0 ? &arms[0] : NULL, out);
    }
}
