/* `kitsuke walk`: checks what was asked for, fills in what was not, and writes the motion. */
#include "motion/gait.h"

#include <string.h>

#include "motion/gait_paper.h"
#include "motion/gait_squat.h"
#include "motion/gait_walk.h"

/* What a preset does where nothing else is asked for. */
typedef struct {
    const char *name;
    int steps;
    double step_length; /* statures */
    double step_time;   /* seconds */
    double arm_swing;   /* degrees */
    bool walks;         /* takes ground, step length and speed */
} Preset;

/* Natural: 110 steps a minute. Brisk: Bohannon 1997, some 25 % faster than comfortable. */
static const Preset presets[] = {
    {"normal", 10, GAIT_STEP, 60.0 / 110, 17, true},
    {"brisk", 12, 0.455, 60.0 / 124, 24, true},
    {"paper", 2, 0.41, 60.0 / 110, 18, true},
    {"turn", 10, 0.33, 60.0 / 95, 13, true},
    {"squat", 2, GAIT_STEP, 60.0 / 100, 0, false},
};
enum { PRESETS = sizeof presets / sizeof presets[0] };

/* Steps that legs can make, in statures. */
#define LEAST_STEP 0.1
#define MOST_STEP 0.6

/* Steps of a walk with stairs, apart from those on the stairs, and what a step takes there. */
enum { STEPS_BESIDE_STAIRS = 5, LEAST_BESIDE_STAIRS = 2 };
#define STAIR_STEP_TIME 0.65

/* More frames than this are a mistake rather than a wish. */
enum { FRAMES_MAX = 1000000, STEPS_A_SQUAT = 4 };

void gait_defaults(Gait *g) {
    *g = (Gait){.preset = "normal", .frames_per_step = 36, .height = 1.70, .arm_swing = -1};
}

static const Preset *find_preset(const char *name, Error *e) {
    for (int i = 0; i < PRESETS; i++)
        if (strcmp(presets[i].name, name) == 0) return presets + i;
    error_set(e, ERR_USAGE, "unknown preset '%s': normal, brisk, paper, turn or squat", name);
    return NULL;
}

/* Written so that NaN fails. */
static bool in_range(const char *what, const char *unit, double x, double low, double high, Error *e) {
    if (x >= low && x <= high) return true;
    return error_set(e, ERR_USAGE, "%s of %g%s is not between %g and %g", what, x, unit, low, high);
}

static bool check_stairs(const Gait *g, Error *e) {
    if (g->stair_rise == 0 && g->stair_run == 0 && g->stair_count == 0) return true;
    if (!in_range("stair rise", " m", fabs(g->stair_rise), 0.02 * g->height, 0.14 * g->height, e)) return false;
    if (!in_range("stair run", " m", g->stair_run, 0.13 * g->height, 0.4 * g->height, e)) return false;
    if (!in_range("stair count", "", g->stair_count, 1, 1000, e)) return false;
    if (g->slope != 0) return error_set(e, ERR_USAGE, "stairs and a slope exclude each other");
    int least = g->stair_count + LEAST_BESIDE_STAIRS;
    if (g->steps > 0 && g->steps < least)
        return error_set(e, ERR_USAGE, "%d steps are too few for %d stairs; at least %d", g->steps, g->stair_count,
                         least);
    return true;
}

static bool check(const Gait *g, const Preset *preset, Error *e) {
    if (!in_range("height", " m", g->height, 0.5, 2.5, e)) return false;
    if (!in_range("frames per step", "", g->frames_per_step, 4, 1000, e)) return false;
    if (g->steps != 0 && !in_range("number of steps", "", g->steps, 1, 10000, e)) return false;
    double least = LEAST_STEP * g->height, most = MOST_STEP * g->height;
    if (g->step_length != 0 && !in_range("step length", " m", g->step_length, least, most, e)) return false;
    if (g->speed != 0 && !in_range("speed", " m/s", g->speed, 0.05, 5, e)) return false;
    if (!in_range("knee lift", " degrees", g->knee_lift, 0, 60, e)) return false;
    if (!(g->arm_swing < 0) && !in_range("arm swing", " degrees", g->arm_swing, 0, 80, e)) return false;
    if (!in_range("slope", " degrees", g->slope, -35, 35, e)) return false;
    if (!check_stairs(g, e)) return false;
    bool plain = strcmp(preset->name, "normal") == 0 || strcmp(preset->name, "brisk") == 0;
    if (!plain && (g->slope != 0 || g->stair_count != 0))
        return error_set(e, ERR_USAGE, "preset '%s' needs level ground", preset->name);
    if (!preset->walks && (g->step_length != 0 || g->speed != 0 || g->knee_lift != 0))
        return error_set(e, ERR_USAGE, "preset '%s' takes no step length, speed or knee lift", preset->name);
    return true;
}

/* Quicker walking is longer and faster steps in equal parts. */
static double step_for_speed(const Gait *g, double natural, double step_time) {
    double quicker = g->speed * step_time / natural;
    return clamp(natural * sqrt(quicker), LEAST_STEP * g->height, MOST_STEP * g->height);
}

/* Fills in what was left open. */
static bool complete(Gait *g, const Preset *preset, double *frame_time, Error *e) {
    bool stairs = g->stair_count > 0;
    double step_time = stairs ? STAIR_STEP_TIME : preset->step_time, natural = preset->step_length * g->height;
    if (g->steps == 0) g->steps = stairs ? g->stair_count + STEPS_BESIDE_STAIRS : preset->steps;
    if (g->step_length == 0) g->step_length = g->speed > 0 ? step_for_speed(g, natural, step_time) : natural;
    if (g->speed == 0) g->speed = g->step_length / step_time;
    if (g->arm_swing < 0) g->arm_swing = preset->arm_swing;
    step_time = g->step_length / g->speed;
    *frame_time = step_time / g->frames_per_step;
    if (!in_range("time of a step", " s", step_time, 0.15, 5, e)) return false;
    if ((g->steps + 4.0) * STEPS_A_SQUAT * g->frames_per_step > FRAMES_MAX)
        return error_set(e, ERR_USAGE, "%d steps of %d frames are too many: %d are possible", g->steps,
                         g->frames_per_step, FRAMES_MAX / (STEPS_A_SQUAT * g->frames_per_step) - 4);
    return true;
}

static bool write_paper(const Gait *g, double frame_time, FILE *out) {
    GaitBody body = gait_body(100 * g->height);
    int frames = g->steps * g->frames_per_step;
    double hips = gait_paper_height(g, &body);
    gait_write_head(&body, frames, frame_time, out);
    for (int i = 0; i < frames; i++) {
        GaitPose pose = gait_paper_pose(g, hips, i);
        gait_write_pose(&body, &pose, out);
    }
    return true;
}

/* A pause of a step's time before, between and after. */
static bool write_squat(const Gait *g, double frame_time, FILE *out) {
    GaitBody body = gait_body(100 * g->height);
    int per = g->frames_per_step, cycle = STEPS_A_SQUAT * per, frames = g->steps * cycle + per + 1;
    gait_write_head(&body, frames, frame_time, out);
    for (int i = 0; i < frames; i++) {
        double place = (double)(i % cycle - per) / (cycle - per), depth = 0.5 - 0.5 * cos(2 * PI * fmax(0, place));
        GaitPose pose = gait_squat_pose(&body, i < g->steps * cycle ? smoothstep(0, 1, depth) : 0);
        gait_write_pose(&body, &pose, out);
    }
    return true;
}

static bool write_walk(const Gait *g, double frame_time, FILE *out, Error *e) {
    Arena arena = {0};
    GaitPlan plan;
    GaitWalk walk;
    bool good = gait_plan(g, &arena, &plan, e) && gait_walk(&plan, &arena, &walk, e);
    if (good) gait_write_head(&plan.body, walk.frames, frame_time, out);
    for (int i = 0; good && i < walk.frames; i++) {
        GaitPose pose = gait_walk_pose(&walk, i);
        gait_write_pose(&plan.body, &pose, out);
    }
    arena_free(&arena);
    return good;
}

bool gait_write(const Gait *g, FILE *out, Error *e) {
    Gait full = *g;
    double frame_time;
    const Preset *preset = find_preset(g->preset, e);
    if (!preset || !check(g, preset, e) || !complete(&full, preset, &frame_time, e)) return false;
    if (strcmp(preset->name, "paper") == 0) return write_paper(&full, frame_time, out);
    if (strcmp(preset->name, "squat") == 0) return write_squat(&full, frame_time, out);
    return write_walk(&full, frame_time, out, e);
}
