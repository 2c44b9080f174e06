/* Sizes come from where the joints are while they move, not from OFFSETs: these may be zero,
   and End Sites often are. Legs, torso and arms are measured; what cannot be measured well
   (neck, head, feet) is the reference adult's, scaled. */
#include "figure/measure.h"

#include <string.h>

#include "base/sort.h"
#include "figure/upright.h"

/* Metres. hips and shoulders: distance between the joints; torso: from hip line to shoulder line; ankle: its height
   over the sole. */
typedef struct { double hips, thigh, shin, ankle, torso, shoulders, upper_arm, forearm, hand; } Lengths;

/* The reference adult, metres. */
static const double ABOVE_SHOULDERS = 0.315;
static const double HIP_HEIGHT = 0.885, SHOULDER_HEIGHT = 1.385;
static const double SOLE = 0.016; /* below toe joint or tip */
static const Lengths adult = {0.176, 0.415, 0.39, 0.08, 0.50, 0.34, 0.28, 0.25, 0.18};

/* --- canonical stance --- */

static void set_pair(Figure *f, Role left, Role right, Vec3 start, Vec3 end) {
    f->start[left] = start;
    f->end[left] = end;
    f->start[right] = vec(-start.x, start.y, start.z);
    f->end[right] = vec(-end.x, end.y, end.z);
}

/* Sets the canonical stance: the reference adult made k times as large, but with the given lengths. */
static void set_stance(double k, const Lengths *l, Figure *f) {
    double hip_y = l->ankle + l->shin + l->thigh, shoulder_y = hip_y + l->torso;
    double t = l->torso / (SHOULDER_HEIGHT - HIP_HEIGHT); /* stretches the spine */
    Vec3 at[6] = {{0, hip_y, 0}, {0, hip_y + 0.115 * t, -0.01 * k}, {0, hip_y + 0.285 * t, -0.01 * k},
                  {0, shoulder_y + 0.045 * k, -0.01 * k}, {0, shoulder_y + 0.135 * k, 0.01 * k},
                  {0, shoulder_y + ABOVE_SHOULDERS * k, 0.01 * k}};
    for (int r = ROLE_PELVIS; r <= ROLE_HEAD; r++) f->start[r] = at[r], f->end[r] = at[r + 1];

    Vec3 hip = vec(l->hips / 2, hip_y, 0), knee = vec(hip.x, l->ankle + l->shin, 0), ankle = vec(hip.x, l->ankle, 0);
    Vec3 ball = vec(hip.x, 0.02 * k, 0.13 * k), tip = vec(hip.x, 0.02 * k, 0.20 * k);
    set_pair(f, ROLE_LEFT_THIGH, ROLE_RIGHT_THIGH, hip, knee);
    set_pair(f, ROLE_LEFT_SHIN, ROLE_RIGHT_SHIN, knee, ankle);
    set_pair(f, ROLE_LEFT_FOOT, ROLE_RIGHT_FOOT, ankle, ball);
    set_pair(f, ROLE_LEFT_TOE, ROLE_RIGHT_TOE, ball, tip);

    Vec3 down = vec_scale(vec(1, -1, 0), sqrt(0.5)); /* along the left arm */
    Vec3 shoulder = vec(l->shoulders / 2, shoulder_y, -0.01 * k), elbow = vec_mad(shoulder, down, l->upper_arm);
    Vec3 wrist = vec_mad(elbow, down, l->forearm), finger = vec_mad(wrist, down, l->hand);
    set_pair(f, ROLE_LEFT_CLAVICLE, ROLE_RIGHT_CLAVICLE, vec(0.02 * k, shoulder_y + 0.015 * k, 0), shoulder);
    set_pair(f, ROLE_LEFT_UPPER_ARM, ROLE_RIGHT_UPPER_ARM, shoulder, elbow);
    set_pair(f, ROLE_LEFT_FOREARM, ROLE_RIGHT_FOREARM, elbow, wrist);
    set_pair(f, ROLE_LEFT_HAND, ROLE_RIGHT_HAND, wrist, finger);
    f->height = shoulder_y + ABOVE_SHOULDERS * k;
}

Figure figure_reference(void) {
    Figure f = {.unit = 1, .unit_name = "m", .up = 'y', .upright = mat_identity(), .rest = "reference"};
    set_stance(1, &adult, &f);
    for (int r = 0; r < ROLE_COUNT; r++) {
        f.roles.joint[r] = f.toward[r] = -1;
        f.bind[r] = rigid_identity();
    }
    return f;
}

/* --- lengths --- */

/* Distance between two joints in most frames; 0 where one is missing. */
static double median_distance(const Sample *s, int a, int b) {
    double d[SAMPLE_FRAMES_MAX];
    int n = s->count;
    if (a < 0 || b < 0) return 0;
    for (int f = 0; f < n; f++) d[f] = vec_dist(sample_point(s, f, a), sample_point(s, f, b));
    sort_numbers(d, n);
    return d[(n - 1) / 2];
}

/* Mean length of the left and the right bone. */
static double bone_length(const Sample *s, const Figure *f, Role left, Role right) {
    return 0.5 * (median_distance(s, f->roles.joint[left], f->toward[left]) +
                  median_distance(s, f->roles.joint[right], f->toward[right]));
}

/* The measured length where it is between low and high times the usual, else the usual. */
static double sane(double measured, double usual, double low, double high) {
    return measured >= low * usual && measured <= high * usual ? measured : usual;
}

/* Hips to shoulders with a straight back: in a human zero pose, unless the frames say quite
   another length; else in the straighter frames. */
static double torso_length(const Sample *s, const Rest *rest, const Roles *r) {
    const int *j = r->joint;
    double d[SAMPLE_FRAMES_MAX];
    for (int f = 0; f < s->count; f++)
        d[f] = vec_dist(sample_middle(s, f, j[ROLE_LEFT_THIGH], j[ROLE_RIGHT_THIGH]),
                        sample_middle(s, f, j[ROLE_LEFT_UPPER_ARM], j[ROLE_RIGHT_UPPER_ARM]));
    sort_numbers(d, s->count);
    double moving = d[(int)(0.75 * (s->count - 1))];
    if (!rest->human) return moving;
    Vec3 hips = vec_mid(rest_place(rest, j[ROLE_LEFT_THIGH]), rest_place(rest, j[ROLE_RIGHT_THIGH]));
    Vec3 arms = vec_mid(rest_place(rest, j[ROLE_LEFT_UPPER_ARM]), rest_place(rest, j[ROLE_RIGHT_UPPER_ARM]));
    return sane(vec_dist(hips, arms), moving, 0.85, 1.15);
}

/* Height of the ankle over the lowest point of the foot where the foot is flat: in a human
   zero pose, else in the frames in which it stands. Negative where the foot has no end. */
static double ankle_height(const Sample *s, const Rest *rest, const Figure *f, Role foot) {
    int ankle = f->roles.joint[foot], tip = f->toward[foot], toe = f->roles.joint[foot + 1], frames[SAMPLE_BEST_MAX];
    if (ankle < 0 || tip < 0) return -1;
    if (toe < 0) toe = tip;
    if (rest->human && rest->soles) {
        Vec3 up = mat_column(rest->frame, 1), from = rest_place(rest, ankle);
        return fmax(vec_dot(up, vec_sub(from, rest_place(rest, tip))),
                    vec_dot(up, vec_sub(from, rest_place(rest, toe))));
    }
    double leg = sample_distance(s, f->roles.joint[foot - 2], f->roles.joint[foot - 1]) +
                 sample_distance(s, f->roles.joint[foot - 1], ankle);
    double rise = FIGURE_FOOT_RISE * FIGURE_STATURE / (adult.thigh + adult.shin) * leg;
    int n = sample_standing(s, f->upright, ankle, tip, rise, frames);
    Vec3 up = mat_apply(mat_transpose(f->upright), vec(0, 1, 0));
    double sum = 0;
    for (int i = 0; i < n; i++) {
        Vec3 from = sample_point(s, frames[i], ankle);
        sum += fmax(vec_dot(up, vec_sub(from, sample_point(s, frames[i], tip))),
                    vec_dot(up, vec_sub(from, sample_point(s, frames[i], toe)))) / n;
    }
    return sum;
}

/* --- unit --- */

/* least: the smallest child that is seen in this unit; 0 where only adults are. Babies are half a metre long,
   but rigs of no unit at all may be 50 units tall, or half a one. */
typedef struct { const char *name; double metres, least; } Unit;
static const Unit units[] = {
    {"cm", 0.01, 0.7}, {"m", 1, 0.7}, {"mm", 0.001, 0.45}, {"inch", 0.0254, 0},
    {"5.644 cm", 0.0254 / 0.45, 0}, {"dm", 0.1, 0}, {"foot", 0.3048, 0},
};
enum { NUNITS = sizeof units / sizeof units[0] };

/* Statures, metres. */
static const double ADULT_LEAST = 1.4, ADULT_MOST = 2.1, GIANT_MOST = 2.6;

/* stature: in file units. An adult in any unit comes before a child or a giant in a common one, so
   a child of 0.55 to 0.82 m in centimetres is taken for an adult in inches: those are many more. */
static void find_unit(double stature, double file_unit, Figure *f) {
    f->unit = FIGURE_STATURE / stature;
    f->unit_name = "unknown";
    f->unit_is_guess = !(file_unit > 0 && stature * file_unit > 0.5 && stature * file_unit < 2.5);
    if (!f->unit_is_guess) {
        f->unit = file_unit;
        f->unit_name = "given by the file";
        for (int i = 0; i < NUNITS; i++)
            if (fabs(file_unit / units[i].metres - 1) < 1e-6) f->unit_name = units[i].name;
        return;
    }
    for (int odd = 0; odd < 2; odd++)
        for (int i = 0; i < NUNITS; i++) {
            double size = stature * units[i].metres;
            if (odd && units[i].least == 0) continue;
            if (size < (odd ? units[i].least : ADULT_LEAST) || size > (odd ? GIANT_MOST : ADULT_MOST)) continue;
            f->unit = units[i].metres;
            f->unit_name = units[i].name;
            return;
        }
}

/* --- ends and lengths --- */

/* The hand points to what lies farthest along the forearm below it, on the mean: a finger, not
   the thumb, nor a thing in the hand. */
static void find_fingertip(const Skeleton *skeleton, const Sample *s, Figure *f, Role hand) {
    int wrist = f->roles.joint[hand], elbow = f->roles.joint[hand - 1];
    if (wrist < 0) return;
    double farthest = 0, limit = sample_distance(s, elbow, wrist);
    for (int j = wrist + 1; j < skeleton->njoints; j++) {
        if (!skeleton_below(skeleton, j, wrist) || sample_distance(s, wrist, j) > limit) continue;
        double sum = 0;
        for (int i = 0; i < s->count; i++) {
            Vec3 at = sample_point(s, i, wrist), forearm = vec_sub(at, sample_point(s, i, elbow));
            sum += vec_dot(vec_unit_or(forearm, vec(0, 0, 0)), vec_sub(sample_point(s, i, j), at));
        }
        if (sum > farthest * (1 + 1e-9)) farthest = sum, f->toward[hand] = j;
    }
}

/* Can a foot end at `tip`? Writers that know no end of a bone write one all the same: nearly in the joint, or straight
   up, where no foot points. */
static bool can_end(const Sample *s, int knee, int ankle, int tip) {
    static const double SOME_WAY = 0.05, UP_SHIN = 0.5; /* of the shin; mean cosine between foot and shin */
    double up = 0;
    if (tip < 0 || sample_distance(s, ankle, tip) < SOME_WAY * sample_distance(s, knee, ankle)) return false;
    for (int i = 0; i < s->count; i++) {
        Vec3 at = sample_point(s, i, ankle), foot = vec_sub(sample_point(s, i, tip), at);
        Vec3 shin = vec_sub(sample_point(s, i, knee), at);
        up += vec_dot(vec_unit_or(shin, vec(0, 0, 0)), vec_unit_or(foot, vec(0, 0, 0))) / s->count;
    }
    return up < UP_SHIN;
}

/* A foot whose tip cannot be its end points to the toes. */
static void check_foot(const Sample *s, Figure *f, Role foot) {
    int knee = f->roles.joint[foot - 1], ankle = f->roles.joint[foot], toe = f->roles.joint[foot + 1];
    if (ankle < 0 || can_end(s, knee, ankle, f->toward[foot])) return;
    f->toward[foot] = can_end(s, knee, ankle, toe) ? toe : -1;
}

/* The joint or end site that each bone points to. */
static void find_ends(const Skeleton *skeleton, const Sample *s, Figure *f) {
    static const Role next[ROLE_COUNT] = {
        [ROLE_NECK] = ROLE_HEAD,
        [ROLE_LEFT_CLAVICLE] = ROLE_LEFT_UPPER_ARM, [ROLE_RIGHT_CLAVICLE] = ROLE_RIGHT_UPPER_ARM,
        [ROLE_LEFT_UPPER_ARM] = ROLE_LEFT_FOREARM, [ROLE_RIGHT_UPPER_ARM] = ROLE_RIGHT_FOREARM,
        [ROLE_LEFT_FOREARM] = ROLE_LEFT_HAND, [ROLE_RIGHT_FOREARM] = ROLE_RIGHT_HAND,
        [ROLE_LEFT_THIGH] = ROLE_LEFT_SHIN, [ROLE_RIGHT_THIGH] = ROLE_RIGHT_SHIN,
        [ROLE_LEFT_SHIN] = ROLE_LEFT_FOOT, [ROLE_RIGHT_SHIN] = ROLE_RIGHT_FOOT,
    };
    static const Role tips[] = {ROLE_LEFT_FOREARM, ROLE_RIGHT_FOREARM, ROLE_LEFT_SHIN, ROLE_RIGHT_SHIN,
                                ROLE_LEFT_FOOT, ROLE_RIGHT_FOOT};
    const int *joint = f->roles.joint;
    for (int r = 0; r < ROLE_COUNT; r++) f->toward[r] = next[r] ? joint[next[r]] : -1;
    for (size_t i = 0; i < sizeof tips / sizeof tips[0]; i++) {
        Role role = tips[i];
        if (f->toward[role] >= 0 || joint[role] < 0) continue;
        /* A hand's or a foot's tip: at most as far as the bone before it is long, and a half. */
        f->toward[role] = sample_tip(s, skeleton, joint[role], 1.5 * sample_distance(s, joint[role - 1], joint[role]));
    }
    check_foot(s, f, ROLE_LEFT_FOOT);
    check_foot(s, f, ROLE_RIGHT_FOOT);
    find_fingertip(skeleton, s, f, ROLE_LEFT_HAND);
    find_fingertip(skeleton, s, f, ROLE_RIGHT_HAND);
}

static Lengths measure_lengths(const Sample *s, const Rest *rest, const Figure *f) {
    const int *j = f->roles.joint;
    double left = ankle_height(s, rest, f, ROLE_LEFT_FOOT);
    double right = ankle_height(s, rest, f, ROLE_RIGHT_FOOT);
    return (Lengths){
        .hips = median_distance(s, j[ROLE_LEFT_THIGH], j[ROLE_RIGHT_THIGH]),
        .thigh = bone_length(s, f, ROLE_LEFT_THIGH, ROLE_RIGHT_THIGH),
        .shin = bone_length(s, f, ROLE_LEFT_SHIN, ROLE_RIGHT_SHIN),
        .ankle = left >= 0 && right >= 0 ? 0.5 * (left + right) : -1,
        .torso = torso_length(s, rest, &f->roles),
        .shoulders = median_distance(s, j[ROLE_LEFT_UPPER_ARM], j[ROLE_RIGHT_UPPER_ARM]),
        .upper_arm = bone_length(s, f, ROLE_LEFT_UPPER_ARM, ROLE_RIGHT_UPPER_ARM),
        .forearm = bone_length(s, f, ROLE_LEFT_FOREARM, ROLE_RIGHT_FOREARM),
        .hand = bone_length(s, f, ROLE_LEFT_HAND, ROLE_RIGHT_HAND),
    };
}

/* The lengths in metres, kept within what a human of k times the reference may have. */
static Lengths human_lengths(const Lengths *l, double unit, double k) {
    double ankle = l->ankle >= 0 ? l->ankle * unit + SOLE * k : adult.ankle * k;
    return (Lengths){
        .hips = clamp(l->hips * unit, 0.7 * adult.hips * k, 1.5 * adult.hips * k),
        .thigh = sane(l->thigh * unit, adult.thigh * k, 0.5, 1.6),
        .shin = sane(l->shin * unit, adult.shin * k, 0.5, 1.6),
        .ankle = clamp(ankle, 0.5 * adult.ankle * k, 1.6 * adult.ankle * k),
        .torso = sane(l->torso * unit, adult.torso * k, 0.5, 1.6),
        .shoulders = clamp(l->shoulders * unit, 0.77 * adult.shoulders * k, 1.5 * adult.shoulders * k),
        .upper_arm = sane(l->upper_arm * unit, adult.upper_arm * k, 0.5, 1.6),
        .forearm = sane(l->forearm * unit, adult.forearm * k, 0.5, 1.6),
        .hand = sane(l->hand * unit, adult.hand * k, 0.75, 1.25),
    };
}

bool figure_measure(const Motion *m, const FigureOptions *options, const Sample *s, Rest *rest, Notes *notes,
                    Figure *f, Error *e) {
    if (options->up && !memchr("xyzXYZ", options->up, 6))
        return error_set(e, ERR_USAGE, "no such up axis '%c': x, y, z, X, Y or Z", options->up);
    find_ends(&m->skeleton, s, f);
    *rest = rest_find(s, f);
    f->rest = rest->name;
    f->up = options->up ? options->up : upright_find(s, f, rest, (m->nframes - 1) * m->frame_time, notes);
    f->upright = upright_turn(f->up);

    Lengths measured = measure_lengths(s, rest, f);
    double known = measured.thigh + measured.shin + measured.torso;
    if (!(known > 1e-12 && known < 1e12)) return error_set(e, ERR_INPUT, "skeleton of no size in '%s'", m->path);
    /* How many times the reference adult, in file units. */
    double k = known / (adult.thigh + adult.shin + adult.torso);
    find_unit(k * FIGURE_STATURE, m->file_unit, f);
    if (options->unit > 0) f->unit = options->unit, f->unit_name = "given", f->unit_is_guess = false;
    else if (f->unit_name[0] == 'u')
        notes_add(notes, (Place){0}, "unit unknown: %.4g units tall, taken for %.2f m", k * FIGURE_STATURE,
                  FIGURE_STATURE);
    if (options->scale > 0) f->unit *= options->scale;

    k *= f->unit;
    Lengths kept = human_lengths(&measured, f->unit, k);
    f->legs_out = 0.5 * (kept.hips - measured.hips * f->unit);
    f->arms_out = 0.5 * (kept.shoulders - measured.shoulders * f->unit);
    set_stance(k, &kept, f);
    return true;
}
