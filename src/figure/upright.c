/* Up is where the head is, most of the time. But people sit, bow, crawl and lie, some for the whole take. So each of
   the six axes gets points from three sources: the body's axis, the floor (along the up axis, and only along it, the
   lowest joint stays near zero) and the rest pose, where that is human.

   A single pose may as well be a handstand, so the body's axis counts less in a take of a moment than in one of several
   seconds. If two axes have nearly the same points, a note tells. */
#include "figure/upright.h"

/* Points. The body's axis has at most MOMENT in a single pose and 1 in a take of LONG seconds. */
static const double FLOOR = 0.8, REST_POSE = 0.6, MOMENT = 0.5, LONG = 3;
/* Won and lost by habit: without a human rest pose y is up in most files, z in some; in files that camera systems wrote
   y or z may point down; x is up hardly ever: a body along x lies. DOWN_Y in files where no axis has a floor: so write
   cameras, which hold the root at the origin, and there a body along -y stands rather than lies. */
static const double HABIT_Y = 0.3, HABIT_Z = 0.15, DOWN = 0.6, DOWN_Y = 0.25, ALONG_X = 1.3;
/* How far below and above zero the lowest joint may be, in parts of the length from hips to shoulders: a toe joint is
   above the sole, and floors are not quite level. Twice as far tells nothing. Hips less than FLAT_HIPS above zero are
   those of a figure that is held at the origin and stands on no floor. */
static const double UNDER_ZERO = 0.15, OVER_ZERO = 0.35, FLAT_HIPS = 0.12;
/* A lead over the second axis below which a note tells. */
static const double NARROW = 0.4;

static Vec3 axis_of(char up) {
    double sign = up >= 'x' ? 1 : -1;
    char axis = up >= 'x' ? up : (char)(up - 'X' + 'x');
    return vec(axis == 'x' ? sign : 0, axis == 'y' ? sign : 0, axis == 'z' ? sign : 0);
}

typedef struct {
    Vec3 axis;     /* mean of the body's axis, length up to 1: hips -> shoulders and, less, ankles -> hips */
    double torso;  /* mean length, hips to shoulders */
} Stance;

static Stance find_stance(const Sample *s, const Figure *f) {
    static const double LEGS = 0.7; /* weight against the torso */
    const int *j = f->roles.joint;
    int left = f->toward[ROLE_LEFT_SHIN], right = f->toward[ROLE_RIGHT_SHIN];
    if (left < 0 || right < 0) left = j[ROLE_LEFT_SHIN], right = j[ROLE_RIGHT_SHIN];
    Stance stance = {{0, 0, 0}, 0};
    for (int i = 0; i < s->count; i++) {
        Vec3 hips = sample_middle(s, i, j[ROLE_LEFT_THIGH], j[ROLE_RIGHT_THIGH]);
        Vec3 torso = vec_sub(sample_middle(s, i, j[ROLE_LEFT_UPPER_ARM], j[ROLE_RIGHT_UPPER_ARM]), hips);
        Vec3 legs = vec_sub(hips, sample_middle(s, i, left, right));
        /* Legs count less: people who sit stretch them forwards. */
        Vec3 sum = vec_mad(vec_unit_or(torso, vec(0, 0, 0)), vec_unit_or(legs, vec(0, 0, 0)), LEGS);
        stance.axis = vec_mad(stance.axis, sum, 1 / (1 + LEGS) / s->count);
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
    double floor[6], clearest = 0;
    char up = 'y';
    for (int i = 0; i < 6; i++) {
        floor[i] = stands_on_zero(s, f, axis_of(axes[i]), stance.torso);
        clearest = fmax(clearest, floor[i]);
    }
    bool camera = clearest == 0 && !rest->human;
    for (int i = 0; i < 6; i++) {
        char c = axes[i];
        Vec3 axis = axis_of(c);
        double score = trust * vec_dot(axis, stance.axis) + FLOOR * floor[i];
        if (c == 'Y' || c == 'Z') score -= c == 'Y' && camera ? DOWN_Y : DOWN;
        if (c == 'x' || c == 'X') score -= ALONG_X;
        if (rest->human) score += vec_dot(axis, mat_column(rest->frame, 1)) > 0.9 ? REST_POSE : 0;
        else score += c == 'y' ? HABIT_Y : c == 'z' ? HABIT_Z : 0;
        if (score > best) next = best, best = score, up = c;
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
