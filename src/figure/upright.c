/* Up is where heads are, most of the time. But people sit, bow, crawl and lie, some for the
   whole take, so three witnesses are heard: the body's axis, the floor (the lowest joint stays
   near zero along the up axis, not along others) and the zero pose, where that is human. A
   still pose may be a handstand as well as a stance, so what a body does in a moment says half
   as much as what it does for seconds. Where the second best is near, a note tells. */
#include "figure/upright.h"

/* Weights of the witnesses against the body's axis, which has up to 1 in a take of LONG seconds. */
static const double FLOOR = 0.8, ZERO_POSE = 0.6, MOMENT = 0.5, LONG = 3;
/* Without a human zero pose y is up in most files, then z; down the same two in some that cameras wrote; x hardly
   ever, so who lies along it lies. */
static const double HABIT_Y = 0.3, HABIT_Z = 0.15, DOWN = 0.6, ALONG_X = 1.3;
/* The lowest joint of one who stands or lies on zero, in parts of hips to shoulders: a toe is over the sole,
   floors are not quite level. Twice as far is no witness. The hips of one who floats about the origin are
   nearer to it than those of one who lies there. */
static const double UNDER_ZERO = 0.15, OVER_ZERO = 0.35, FLAT_HIPS = 0.12;
/* A lead that is told of. */
static const double NARROW = 0.25;

static Vec3 axis_of(char up) {
    double sign = up >= 'x' ? 1 : -1;
    char axis = up >= 'x' ? up : (char)(up - 'X' + 'x');
    return vec(axis == 'x' ? sign : 0, axis == 'y' ? sign : 0, axis == 'z' ? sign : 0);
}

static Vec3 middle(const Sample *s, int frame, int a, int b) {
    return vec_mid(sample_point(s, frame, a), sample_point(s, frame, b));
}

typedef struct {
    Vec3 axis;     /* mean of the body's axis: hips -> shoulders and, less, ankles -> hips */
    double torso;  /* mean length, hips to shoulders */
} Stance;

static Stance find_stance(const Sample *s, const Figure *f) {
    const int *j = f->roles.joint;
    int left = f->toward[ROLE_LEFT_SHIN], right = f->toward[ROLE_RIGHT_SHIN];
    if (left < 0 || right < 0) left = j[ROLE_LEFT_SHIN], right = j[ROLE_RIGHT_SHIN];
    Stance stance = {{0, 0, 0}, 0};
    for (int i = 0; i < s->count; i++) {
        Vec3 hips = middle(s, i, j[ROLE_LEFT_THIGH], j[ROLE_RIGHT_THIGH]);
        Vec3 torso = vec_sub(middle(s, i, j[ROLE_LEFT_UPPER_ARM], j[ROLE_RIGHT_UPPER_ARM]), hips);
        Vec3 legs = vec_sub(hips, middle(s, i, left, right));
        /* Sitters stretch their legs: these count less. */
        Vec3 sum = vec_mad(vec_unit_or(torso, vec(0, 0, 0)), vec_unit_or(legs, vec(0, 0, 0)), 0.7);
        stance.axis = vec_mad(stance.axis, sum, 1 / 1.7 / s->count);
        stance.torso += vec_len(torso) / s->count;
    }
    return stance;
}

/* 1 where the lowest joint of the body stays near zero along the axis, 0 where it does not. */
static double stands_on_zero(const Sample *s, const Figure *f, Vec3 axis, double torso) {
    double off = 0, hips = 0;
    for (int i = 0; i < s->count; i++) {
        double lowest = 1e300;
        for (int r = 0; r < ROLE_COUNT; r++)
            if (f->roles.joint[r] >= 0) lowest = fmin(lowest, vec_dot(axis, sample_point(s, i, f->roles.joint[r])));
        off += (lowest < 0 ? -lowest / UNDER_ZERO : lowest / OVER_ZERO) / s->count;
        hips += vec_dot(axis, sample_point(s, i, f->roles.joint[ROLE_PELVIS])) / s->count;
    }
    if (hips < FLAT_HIPS * torso) return 0;
    return 1 - smoothstep(1, 2, off / (torso + 1e-300));
}

char upright_find(const Sample *s, const Figure *f, const Rest *rest, double seconds, Notes *notes) {
    static const char axes[] = "yzxYZX";
    Stance stance = find_stance(s, f);
    double best = -1e300, next = -1e300, trust = MOMENT + (1 - MOMENT) * smoothstep(0, LONG, seconds);
    char up = 'y';
    for (const char *c = axes; *c; c++) {
        Vec3 axis = axis_of(*c);
        double score = trust * vec_dot(axis, stance.axis) + FLOOR * stands_on_zero(s, f, axis, stance.torso);
        if (*c == 'Y' || *c == 'Z') score -= DOWN;
        if (*c == 'x' || *c == 'X') score -= ALONG_X;
        if (rest->human) score += vec_dot(axis, mat_column(rest->frame, 1)) > 0.9 ? ZERO_POSE : 0;
        else score += *c == 'y' ? HABIT_Y : *c == 'z' ? HABIT_Z : 0;
        if (score > best) next = best, best = score, up = *c;
        else if (score > next) next = score;
    }
    if (best - next < NARROW)
        notes_add(notes, (Place){0}, "up axis is not certain: taken for %s%c; --up tells it", up < 'a' ? "-" : "",
                  up < 'a' ? up - 'A' + 'a' : up);
    return up;
}

Mat3 upright_turn(char up) {
    Vec3 axis = axis_of(up);
    if (up == 'y') return mat_identity();
    if (up == 'Y') return (Mat3){{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
    Vec3 x = axis.x != 0 ? vec(0, -axis.x, 0) : vec(1, 0, 0);
    return (Mat3){{x, axis, vec_cross(x, axis)}};
}
