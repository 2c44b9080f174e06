/* The walker, measured as anybody would who has only its files: BVH text is read back, posed by
   forward kinematics, and held against the published angles, the ground and the clock. */
#include "motion/gait.h"

#include <string.h>

#include "folder.h"
#include "motion/gait_curves.h"
#include "motion/motion.h"
#include "tap.h"

/* A motion read back: every row, and every joint in the world, in centimetres. */
typedef struct {
    Arena arena;
    Motion motion;
    double *row;   /* nframes x nchannels */
    Rigid *world;  /* nframes x njoints */
    double height; /* stature, cm: the thigh is 0.245 of it */
} Take;

static Gait gait(const char *preset) {
    Gait g;
    gait_defaults(&g);
    g.preset = preset;
    return g;
}

static void stairs(Gait *g, double rise, double run, int count) {
    g->stair_rise = rise;
    g->stair_run = run;
    g->stair_count = count;
}

static bool take_rows(Take *t, Error *e) {
    const Skeleton *s = &t->motion.skeleton;
    size_t n = (size_t)t->motion.nframes;
    MotionReader *reader = NULL;
    t->row = ARENA_NEW(&t->arena, double, n * (size_t)s->nchannels, e);
    t->world = ARENA_NEW(&t->arena, Rigid, n * (size_t)s->njoints, e);
    bool good = t->row && t->world && motion_reader_open(&t->motion, &t->arena, &reader, e);
    for (int f = 0; good && f < t->motion.nframes; f++) {
        double *row = t->row + f * s->nchannels;
        good = motion_row(reader, f, row, e);
        if (good) skeleton_pose(s, row, t->world + f * s->njoints);
    }
    if (reader) motion_reader_close(reader);
    return good;
}

static bool take_open(const Gait *g, Take *t) {
    Error e = {0};
    Notes notes = {0};
    memset(t, 0, sizeof *t);
    const char *path = in_folder("walk.bvh");
    FILE *out = fopen(path, "w");
    bool good = out && gait_write(g, out, &e);
    if (out) good = fclose(out) == 0 && good;
    good = good && motion_open(path, &(MotionOptions){0}, &t->arena, &notes, &t->motion, &e) && take_rows(t, &e);
    if (good) t->height = -t->motion.skeleton.joint[skeleton_find(&t->motion.skeleton, "LeftLeg")].offset.y / 0.245;
    if (notes.count) printf("# noted: %s\n", notes.note[0].text);
    if (!good) printf("# %s\n", e.text);
    return good;
}

static void take_close(Take *t) {
    motion_close(&t->motion);
    arena_free(&t->arena);
}

static int joint(const Take *t, const char *side, const char *name) {
    char whole[64];
    snprintf(whole, sizeof whole, "%s%s", side, name);
    return skeleton_find(&t->motion.skeleton, whole);
}

static Rigid place(const Take *t, int frame, int joint_index) {
    return t->world[frame * t->motion.skeleton.njoints + joint_index];
}

static double channel(const Take *t, int frame, int joint_index, ChannelKind kind) {
    const Joint *j = t->motion.skeleton.joint + joint_index;
    for (int i = 0; i < j->nchannels; i++)
        if (j->channel[i] == kind) return t->row[frame * t->motion.skeleton.nchannels + j->first_channel + i];
    return NAN;
}

static const char *const sides[2] = {"Left", "Right"};

/* Ground to walk on; the first riser is found from where the feet of the file stand. */
typedef struct { double slope, first, rise, run; int count; } Ground;

static double ground_height(const Ground *g, double z) {
    double steps = g->count ? clamp(floor((z - g->first) / g->run) + 1, 0, g->count) : 0;
    return z * tan(g->slope * PI / 180) + steps * g->rise;
}

/* Heel, ball and tip of the toes on the sole: the skeleton's joints lie above it. */
enum { HEEL, BALL, TIP, SOLE };
static void sole(const Take *t, int frame, int side, Vec3 *point) {
    double h = t->height;
    Rigid foot = place(t, frame, joint(t, sides[side], "Foot"));
    Rigid toe = place(t, frame, joint(t, sides[side], "ToeBase"));
    point[HEEL] = rigid_apply(foot, vec(0, -0.039 * h, -0.038 * h));
    point[BALL] = rigid_apply(toe, vec(0, -0.011 * h, 0));
    point[TIP] = rigid_apply(toe, vec(0, -0.011 * h, 0.043 * h));
}

/* Centimetres: lowest height of any point of the soles over the ground; how far a point moves
   while it stays within a millimetre of it (for a stature of 1.70 m); and how high the lower
   foot ever gets. */
typedef struct { double lowest, slide, floating; } Feet;

static Feet measure_feet(const Take *t, const Ground *ground) {
    Feet feet = {INFINITY, 0, -INFINITY};
    double near = 0.1 * t->height / 170;
    Vec3 start[2][SOLE] = {{{0, 0, 0}}};
    bool down[2][SOLE] = {{false}};
    for (int f = 0; f < t->motion.nframes; f++) {
        double lower = INFINITY;
        for (int i = 0; i < 2 * SOLE; i++) {
            int side = i / SOLE, part = i % SOLE;
            Vec3 point[SOLE];
            sole(t, f, side, point);
            double height = point[part].y - ground_height(ground, point[part].z);
            lower = min_of(lower, height);
            bool touches = fabs(height) <= near;
            if (touches && !down[side][part]) start[side][part] = point[part];
            down[side][part] = touches;
            if (touches) feet.slide = max_of(feet.slide, vec_dist(start[side][part], point[part]));
        }
        feet.lowest = min_of(feet.lowest, lower);
        feet.floating = max_of(feet.floating, lower);
    }
    return feet;
}

static void test_feet(const char *what, const Gait *g, Ground ground) {
    Take t;
    Feet feet = {-INFINITY, INFINITY, INFINITY};
    if (take_open(g, &t)) feet = measure_feet(&t, &ground);
    OK(feet.lowest > -0.05, "%s: no sole is below the ground (%.3f cm)", what, feet.lowest);
    OK(feet.slide < 0.5, "%s: what touches the ground stays there (%.3f cm)", what, feet.slide);
    OK(feet.floating < 0.05, "%s: a foot is always on the ground (%.3f cm)", what, feet.floating);
    take_close(&t);
}

/* The highest stairs that the feet never enter: going up their first riser is as near as can be,
   going down as far. NAN: there are none. */
static double find_riser(const Gait *g) {
    Take t;
    double riser = NAN;
    if (!take_open(g, &t)) return NAN;
    double way = place(&t, t.motion.nframes - 1, 0).t.z;
    bool up = g->stair_rise > 0;
    for (double z = 0; z < way; z += 0.25) {
        double first = up ? z : way - z;
        Ground ground = {0, first, 100 * g->stair_rise, 100 * g->stair_run, g->stair_count};
        if (measure_feet(&t, &ground).lowest > -0.05) {
            riser = first;
            break;
        }
    }
    take_close(&t);
    return riser;
}

/* Every tread carries a foot that lies flat for a while. */
static void test_treads(const char *what, const Gait *g) {
    Take t;
    int trodden = 0;
    if (!take_open(g, &t)) return;
    for (int tread = 0; tread <= g->stair_count; tread++) {
        int flat = 0;
        for (int f = 0; f < t.motion.nframes; f++)
            for (int side = 0; side < 2; side++) {
                Vec3 point[SOLE];
                sole(&t, f, side, point);
                double top = 100 * g->stair_rise * tread, off = fabs(point[HEEL].y - top) + fabs(point[TIP].y - top);
                flat += off < 0.1;
            }
        trodden += flat > g->frames_per_step / 4;
    }
    OK(trodden == g->stair_count + 1, "%s: a foot lies flat on every tread (%d)", what, trodden);
    take_close(&t);
}

static void test_all_feet(void) {
    Gait g = gait("normal");
    test_feet("level", &g, (Ground){0});
    g = gait("brisk");
    test_feet("brisk", &g, (Ground){0});
    g = gait("normal");
    g.step_length = 0.95;
    test_feet("the longest steps", &g, (Ground){0});
    g = gait("turn");
    test_feet("turn", &g, (Ground){0});
    g = gait("squat");
    test_feet("squat", &g, (Ground){0});
    g = gait("normal");
    g.height = 1.15;
    g.step_length = 0.3;
    g.knee_lift = 30;
    test_feet("a child's short high steps", &g, (Ground){0});
    for (int i = 0; i < 4; i++) {
        const double slopes[] = {12, -12, 35, -35};
        char what[32];
        g = gait("normal");
        g.slope = slopes[i];
        snprintf(what, sizeof what, "slope of %g degrees", g.slope);
        test_feet(what, &g, (Ground){.slope = g.slope});
    }
    for (int i = 0; i < 4; i++) {
        const double rises[] = {0.17, -0.17, 0.20, -0.20}, runs[] = {0.29, 0.29, 0.24, 0.24};
        char what[64];
        g = gait("normal");
        stairs(&g, rises[i], runs[i], 5);
        snprintf(what, sizeof what, "stairs %g:%g", g.stair_rise, g.stair_run);
        test_feet(what, &g, (Ground){0, find_riser(&g), 100 * g.stair_rise, 100 * g.stair_run, 5});
        test_treads(what, &g);
    }
}

/* Step k meets the ground (k + 1) steps after the first frame, and the first is the left one's. */
static double cycle_of(int frame, int per, int side) {
    return ((double)frame / per - 2 - side) / 2;
}

static void test_curves(double height) {
    static const struct { const char *joint, *name; GaitCurve curve; double sign, shift; } angles[] = {
        {"UpLeg", "hip", GAIT_CURVE_HIP, -1, GAIT_PELVIC_TILT},
        {"Leg", "knee", GAIT_CURVE_KNEE, 1, 0},
        {"Foot", "ankle", GAIT_CURVE_ANKLE, -1, 0}};
    Gait g = gait("normal");
    Take t;
    g.height = height;
    if (!OK(take_open(&g, &t), "a walk for a stature of %g m", height)) return;
    int per = g.frames_per_step;
    for (int i = 0; i < 3; i++) {
        double worst = 0;
        for (int side = 0; side < 2; side++) {
            int j = joint(&t, sides[side], angles[i].joint);
            for (int f = 4 * per; f < 8 * per; f++) {
                double found = angles[i].sign * channel(&t, f, j, CHANNEL_RX) + angles[i].shift;
                worst = max_of(worst, fabs(found - gait_curve(angles[i].curve, cycle_of(f, per, side))));
            }
        }
        OK(worst < 5, "%s within 5 degrees of the published one, over two strides (%.2f)", angles[i].name, worst);
    }
    take_close(&t);
}

/* The table itself, at the extremes that every textbook names. */
static void test_table(void) {
    NEAR(gait_curve(GAIT_CURVE_KNEE, 0.72), 63.4, 1e-9, "knee: most bent in swing");
    NEAR(gait_curve(GAIT_CURVE_HIP, 0.52), -8.3, 1e-9, "hip: most extended before the toes leave");
    NEAR(gait_curve(GAIT_CURVE_ANKLE, 0.64), -19.9, 1e-9, "ankle: pushed off");
    NEAR(gait_curve(GAIT_CURVE_KNEE, -0.28), gait_curve(GAIT_CURVE_KNEE, 5.72), 1e-9, "the same in every stride");
    NEAR(gait_curve(GAIT_CURVE_HIP, 0.9999999), gait_curve(GAIT_CURVE_HIP, 0), 1e-4, "no seam");
}

/* Largest difference of two frames in anything but the way that the hips have gone. */
static double difference(const Take *t, int a, int b) {
    double worst = 0;
    int n = t->motion.skeleton.nchannels;
    for (int i = 0; i < n; i++)
        if (i != 2) worst = max_of(worst, fabs(t->row[a * n + i] - t->row[b * n + i]));
    return worst;
}

static void test_period(const char *preset, int per, double step) {
    Gait g = gait(preset);
    Take t;
    g.frames_per_step = per;
    g.steps = 12;
    g.step_length = step;
    if (!OK(take_open(&g, &t), "%s, %d frames a step", preset, per)) return;
    double worst = 0, way = 0;
    for (int f = 4 * per; f < 8 * per; f++) {
        worst = max_of(worst, difference(&t, f, f + 2 * per));
        double gone = channel(&t, f + 2 * per, 0, CHANNEL_TZ) - channel(&t, f, 0, CHANNEL_TZ);
        way = max_of(way, fabs(gone - 2 * 100 * g.step_length));
    }
    OK(worst < 0.00011, "a stride later the pose is the same in its printed digits (%g)", worst);
    OK(way < 0.00011, "and the walker two steps further on (%g)", way);
    take_close(&t);
}

/* Fastest speed of any joint between two frames, cm a frame. */
static double speed(const Take *t, int a, int b) {
    double fastest = 0;
    for (int j = 0; j < t->motion.skeleton.njoints; j++)
        fastest = max_of(fastest, vec_dist(place(t, a, j).t, place(t, b, j).t));
    return fastest;
}

static void test_start_and_end(void) {
    Gait g = gait("normal");
    Take t;
    if (!OK(take_open(&g, &t), "a walk from standing to standing")) return;
    int last = t.motion.nframes - 1, per = g.frames_per_step;
    int left = joint(&t, "Left", "Foot"), right = joint(&t, "Right", "Foot");
    OK(speed(&t, 0, 1) < 0.05 && speed(&t, last - 1, last) < 0.05, "it begins and ends at rest");
    OK(fabs(place(&t, 0, left).t.z - place(&t, 0, right).t.z) < 0.01, "at first the feet are side by side");
    OK(fabs(place(&t, last, left).t.z - place(&t, last, right).t.z) < 0.01, "and so they are at last");
    double jerk = 0, fastest = 0;
    for (int f = 1; f < last; f++) {
        Vec3 now = place(&t, f, 0).t, ahead = vec_sub(place(&t, f + 1, 0).t, now);
        Vec3 behind = vec_sub(now, place(&t, f - 1, 0).t);
        jerk = max_of(jerk, vec_dist(ahead, behind));
        fastest = max_of(fastest, fabs(ahead.z));
    }
    OK(jerk < 0.1, "the hips never jerk (%.3f cm a frame a frame)", jerk);
    OK(fastest < 1.05 * 100 * 0.394 * g.height / per, "nor hurry more than the steps do (%.3f cm a frame)", fastest);
    take_close(&t);
}

static void test_clock(void) {
    Gait g = gait("normal");
    Take t;
    g.step_length = 0.6;
    g.speed = 1.2;
    g.steps = 6;
    if (!OK(take_open(&g, &t), "step length and speed as asked for")) return;
    NEAR(t.motion.frame_time * g.frames_per_step, 0.5, 1e-6, "a step takes its length over the speed");
    OK(t.motion.nframes == 9 * g.frames_per_step + 1, "six steps, one to close the feet, and rest");
    int left = joint(&t, "Left", "Foot"), per = g.frames_per_step, flat = 4 * per + per / 3;
    double apart = place(&t, flat, left).t.z - place(&t, flat - 2 * per, left).t.z;
    NEAR(apart, 120, 0.01, "a stride is two steps long");
    take_close(&t);
}

/* What the paper preset is by definition: see motion/gait_paper.h. */
static void test_paper(void) {
    Gait g = gait("paper");
    Take t;
    if (!OK(take_open(&g, &t), "the paper's walk")) return;
    OK(t.motion.nframes == 72, "one stride of 72 frames");
    double hip = 0, knee = 0, level = 0, pace = 0, clear = INFINITY;
    for (int f = 0; f < 72; f++)
        for (int side = 0; side < 2; side++) {
            double phase = 2 * PI * f / 72 + side * PI, d = remainder(phase + 1.35, 2 * PI), left = side ? -1 : 1;
            double wanted = 6 + 54 * exp(-d * d / (2 * 0.62 * 0.62));
            hip = max_of(hip, fabs(-channel(&t, f, joint(&t, sides[side], "UpLeg"), CHANNEL_RX) - 8 - 24 * cos(phase)));
            knee = max_of(knee, fabs(channel(&t, f, joint(&t, sides[side], "Leg"), CHANNEL_RX) - wanted));
            level = max_of(level, fabs(channel(&t, f, 0, CHANNEL_TY) - channel(&t, 0, 0, CHANNEL_TY)));
            pace = max_of(pace, fabs(channel(&t, f, 0, CHANNEL_TZ) - f * 41 * 1.7 / 36));
            clear = min_of(clear, left * place(&t, f, joint(&t, sides[side], "Hand")).t.x);
        }
    OK(hip < 0.0001 && knee < 0.0001, "hips and knees as the formula says (%g, %g degrees)", hip, knee);
    OK(level < 1e-9 && pace < 0.0001, "the pelvis glides evenly at one height (%g, %g cm)", level, pace);
    OK(clear > 23 + 8, "hands keep 8 cm away from a skirt 23 cm half-wide at the hips (%.1f cm)", clear - 23);
    take_close(&t);
}

/* The least distance between the shins, from knee to ankle, in any frame. */
static double least_between_shins(const Take *t) {
    const double step = 1.0 / 8;
    int knee[2] = {joint(t, "Left", "Leg"), joint(t, "Right", "Leg")};
    int ankle[2] = {joint(t, "Left", "Foot"), joint(t, "Right", "Foot")};
    double least = INFINITY;
    for (int f = 0; f < t->motion.nframes; f++)
        for (double a = 0; a <= 1; a += step)
            for (double b = 0; b <= 1; b += step)
                least = min_of(least, vec_dist(vec_lerp(place(t, f, knee[0]).t, place(t, f, ankle[0]).t, a),
                                             vec_lerp(place(t, f, knee[1]).t, place(t, f, ankle[1]).t, b)));
    return least;
}

static void test_squat_and_turn(void) {
    Gait g = gait("squat");
    Take t;
    if (OK(take_open(&g, &t), "squatting")) {
        double lowest = INFINITY, knee = 0;
        for (int f = 0; f < t.motion.nframes; f++) {
            lowest = min_of(lowest, channel(&t, f, 0, CHANNEL_TY));
            knee = max_of(knee, channel(&t, f, joint(&t, "Left", "Leg"), CHANNEL_RX));
        }
        OK(lowest < 0.31 * t.height, "the hips go down to the height of the knees (%.1f cm)", lowest);
        OK(knee > 100 && knee < 115, "and the knees bend beyond a right angle (%.0f degrees)", knee);
    }
    take_close(&t);
    g = gait("turn");
    if (OK(take_open(&g, &t), "turning round")) {
        int last = t.motion.nframes - 1;
        NEAR(channel(&t, last, 0, CHANNEL_RY), 180, 0.01, "the walker looks back");
        OK(fabs(place(&t, last, 0).t.z - place(&t, 0, 0).t.z) < 10, "and has come back");
        double between = least_between_shins(&t);
        OK(between > 0.03 * t.height, "with no leg through the other (shins %.1f cm apart)", between);
    }
    take_close(&t);
}

static void test_knee_lift(void) {
    double knee[2] = {0, 0};
    for (int i = 0; i < 2; i++) {
        Gait g = gait("normal");
        Take t;
        g.knee_lift = 25 * i;
        if (take_open(&g, &t))
            for (int f = 0; f < t.motion.nframes; f++)
                knee[i] = max_of(knee[i], channel(&t, f, joint(&t, "Left", "Leg"), CHANNEL_RX));
        take_close(&t);
    }
    OK(knee[1] - knee[0] > 15, "knee lift bends the knee more in swing (%.1f, %.1f degrees)", knee[0], knee[1]);
}

static void refused(const char *word, const Gait *g) {
    Error e = {0};
    FILE *out = tmpfile();
    bool good = out && gait_write(g, out, &e);
    OK(!good && e.kind == ERR_USAGE && strstr(e.text, word) && out && ftell(out) == 0, "refused: %s", e.text);
    if (out) fclose(out);
}

/* Spoils one or two fields of a good wish. */
#define REFUSED(word, spoil)                                                                       \
    do {                                                                                           \
        Gait g = gait("normal");                                                                   \
        spoil;                                                                                     \
        refused(word, &g);                                                                         \
    } while (0)

static void test_refusals(void) {
    REFUSED("preset", g.preset = "moonwalk");
    REFUSED("height", g.height = 0.2);
    REFUSED("height", g.height = NAN);
    REFUSED("frames per step", g.frames_per_step = 3);
    REFUSED("frames per step", g.frames_per_step = 1001);
    REFUSED("number of steps", g.steps = -1);
    REFUSED("number of steps", g.steps = 10001);
    REFUSED("too many", g.steps = 10000; g.frames_per_step = 1000);
    REFUSED("step length", g.step_length = 0.05);
    REFUSED("step length", g.step_length = 1.1);
    REFUSED("legs are too short", g.step_length = 1.0; g.slope = 35);
    REFUSED("speed", g.speed = -1);
    REFUSED("speed", g.speed = INFINITY);
    REFUSED("time of a step", g.speed = 5; g.step_length = 0.2);
    REFUSED("knee lift", g.knee_lift = 61);
    REFUSED("arm swing", g.arm_swing = 90);
    REFUSED("arm swing", g.arm_swing = NAN);
    REFUSED("slope", g.slope = 35.1);
    REFUSED("slope", g.slope = -36);
    REFUSED("exclude", g.slope = 3; stairs(&g, 0.17, 0.29, 3));
    REFUSED("stair rise", stairs(&g, 0.5, 0.29, 3));
    REFUSED("stair rise", stairs(&g, 0, 0.29, 3));
    REFUSED("stair run", stairs(&g, 0.17, 0.05, 3));
    REFUSED("stair count", stairs(&g, 0.17, 0.29, 0));
    REFUSED("stair count", stairs(&g, 0.17, 0.29, 100000));
    REFUSED("too few for 9 stairs", stairs(&g, 0.17, 0.29, 9); g.steps = 4);
    REFUSED("level ground", g.preset = "turn"; g.slope = 3);
    REFUSED("level ground", g.preset = "paper"; stairs(&g, 0.17, 0.29, 3));
    REFUSED("too few to turn", g.preset = "turn"; g.steps = 2);
    REFUSED("takes no", g.preset = "squat"; g.speed = 1);
}

int main(void) {
    if (!folder_make()) return 1;
    test_table();
    test_curves(1.7);
    test_curves(1.1);
    test_curves(2.0);
    test_period("normal", 36, 0.67);
    test_period("brisk", 25, 0.8);
    test_period("paper", 36, 0.7);
    test_start_and_end();
    test_clock();
    test_all_feet();
    test_paper();
    test_squat_and_turn();
    test_knee_lift();
    test_refusals();
    folder_remove();
    return tap_done();
}
