/* The table of options, and how the text of a value becomes a field of Settings.

   One row is all there is to an option: add it here, and it is parsed, range-checked,
   explained in the help, suggested when it is mistyped and, because a job file's keys are the
   long names, understood there too. Nothing else in the program knows an option's name. */
#include "app/settings.h"

#include <string.h>

#include "base/text.h"

static const Choice split_rules[] = {{"adaptive", SPLIT_ADAPTIVE}, {"uniform", SPLIT_UNIFORM}, {"none", SPLIT_NONE}, {NULL, 0}};
static const Choice topologies[] = {{"adaptive", 0}, {"fixed", 1}, {NULL, 0}};
static const Choice positions[] = {{"guess", POSITION_GUESS}, {"add", POSITION_ADD}, {"replace", POSITION_REPLACE}, {NULL, 0}};
static const Choice axes[] = {{"x", 'x'}, {"y", 'y'}, {"z", 'z'}, {"-x", 'X'}, {"-y", 'Y'}, {"-z", 'Z'}, {NULL, 0}};
static const Choice formats[] = {{"obj", FORMAT_OBJ}, {"drc", FORMAT_DRC}, {"none", FORMAT_NONE}, {NULL, 0}};
static const Choice presets[] = {{"normal", 0}, {"paper", 0}, {"brisk", 0}, {"squat", 0}, {"turn", 0}, {NULL, 0}};
static const Choice progress_modes[] = {{"auto", PROGRESS_AUTO}, {"always", PROGRESS_ALWAYS}, {"never", PROGRESS_NEVER}, {NULL, 0}};

/* Names that --unit takes, in metres. */
static const struct { const char *name; double metres; } units[] = {
    {"m", 1}, {"dm", 0.1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};
enum { UNITS = sizeof units / sizeof units[0] };

#define FIELD(name) .field = offsetof(Settings, name)
#define RANGE(least, most) .low = (least), .high = (most)
#define MOVES (COMMAND_DRESS | COMMAND_INSPECT) /* both open motions */

const Option settings_table[] = {
    {"asf", 0, KIND_TEXT, FIELD(asf), "FILE", "skeleton of AMC motions", "the .asf file beside the motion", "Motion", MOVES},
    {"roles", 0, KIND_TEXT, FIELD(roles), "FILE", "which joint is which bone, as lines 'role = joint'",
     "found by names and shape", "Motion", MOVES},
    {"frames", 0, KIND_SPAN, FIELD(frames), "A:B:STEP", "first and last frame, counted from 1, and step; each part may be left out",
     "all", "Motion", MOVES},
    {"rate", 0, KIND_REAL, FIELD(rate), "HZ", "resample to so many frames a second; --frames then counts these", "the motion's own",
     "Motion", COMMAND_DRESS, RANGE(0.001, 100000)},
    {"fps", 0, KIND_REAL, FIELD(fps), "HZ", "frames a second of the motion, instead of what the file says", "the file's, or 120",
     "Motion", MOVES, RANGE(0.001, 100000)},
    {"unit", 0, KIND_UNIT, FIELD(unit), "UNIT", "length unit of the motion", "found from the figure's size", "Motion", MOVES,
     RANGE(1e-6, 1e6)},
    {"scale", 0, KIND_REAL, FIELD(scale), "X", "makes the figure so many times larger", "1", "Motion", MOVES, RANGE(0.001, 1000)},
    {"up", 0, KIND_CHOICE, FIELD(up), "AXIS", "axis that points up in the motion", "found from the poses", "Motion", MOVES,
     .choices = axes},
    {"position", 0, KIND_CHOICE, FIELD(position), "RULE", "what position channels do to a joint's OFFSET", "guess", "Motion", MOVES,
     .choices = positions},

    {"garment", 'g', KIND_LIST, FIELD(garments), "FILE", "garment to put on; repeat it for several", NULL, "Garments and body",
     COMMAND_DRESS},
    {"body", 0, KIND_TEXT, FIELD(body), "FILE", "body to dress", "a well-proportioned adult", "Garments and body", COMMAND_DRESS},
    {"body-detail", 0, KIND_INT, FIELD(body_detail), "N", "facets round each section of the body", "16", "Garments and body",
     COMMAND_DRESS, RANGE(8, 64), .step = 4},

    {"split", 0, KIND_CHOICE, FIELD(split), "RULE", "which patches are split: those that meet the body, all, or none", "adaptive",
     "Method", COMMAND_DRESS, .choices = split_rules},
    {"depth", 0, KIND_INT, FIELD(depth), "N", "levels of splitting", "2", "Method", COMMAND_DRESS, RANGE(1, 3)},
    {"detail", 0, KIND_INT, FIELD(detail), "N", "facets along each side of a patch", "the garment's, or 8", "Method", COMMAND_DRESS,
     RANGE(1, 64)},
    {"topology", 0, KIND_CHOICE, FIELD(fixed), "KIND", "adaptive: facets follow the splitting; fixed: the same triangles in every frame",
     "adaptive", "Method", COMMAND_DRESS, .choices = topologies},

    {"output", 'o', KIND_TEXT, FIELD(output), "DIR", "folder for everything that is written; made if missing", NULL, "Output",
     COMMAND_DRESS},
    {"format", 0, KIND_SET, FIELD(formats), "LIST", "mesh files, separated by commas", "obj", "Output", COMMAND_DRESS,
     .choices = formats},
    {"output-unit", 0, KIND_UNIT, FIELD(output_unit), "UNIT", "length unit of the written meshes", "m", "Output", COMMAND_DRESS,
     RANGE(1e-6, 1e6)},
    {"no-body", 0, KIND_FLAG, FIELD(no_body), NULL, "write no meshes of the body", NULL, "Output", COMMAND_DRESS},
    {"no-times", 0, KIND_FLAG, FIELD(no_times), NULL, "leave the columns of seconds out of the statistics", NULL, "Output", COMMAND_DRESS},
    {"force", 'f', KIND_FLAG, FIELD(force), NULL, "replace motion folders that are there already", NULL, "Output", COMMAND_DRESS},
    {"draco-position-bits", 0, KIND_INT, FIELD(drc.position_bits), "N", "quantisation of positions", "14", "Output", COMMAND_DRESS,
     RANGE(1, 30)},
    {"draco-normal-bits", 0, KIND_INT, FIELD(drc.normal_bits), "N", "quantisation of normals", "10", "Output", COMMAND_DRESS, RANGE(2, 30)},
    {"draco-uv-bits", 0, KIND_INT, FIELD(drc.uv_bits), "N", "quantisation of patch parameters", "12", "Output", COMMAND_DRESS,
     RANGE(1, 30)},
    {"draco-speed", 0, KIND_INT, FIELD(drc.speed), "N", "0: smallest files, 10: fastest", "7", "Output", COMMAND_DRESS, RANGE(0, 10),
     .bias = 1},
    {"draco-keep-order", 0, KIND_FLAG, FIELD(drc.keep_order), NULL, "keep the order of vertices; larger files", NULL, "Output",
     COMMAND_DRESS},

    {"joints", 0, KIND_FLAG, FIELD(joints), NULL, "print frame,joint,x,y,z of every joint and frame, in the file's units and axes",
     NULL, "Output", COMMAND_INSPECT},

    {"preset", 0, KIND_TEXT, FIELD(gait.preset), "NAME", "kind of walk; paper: the walk of the paper's figures", "normal", "Walk",
     COMMAND_WALK, .choices = presets},
    {"steps", 0, KIND_INT, FIELD(gait.steps), "N", "steps to walk", "what suits the preset", "Walk", COMMAND_WALK, RANGE(1, 10000)},
    {"frames-per-step", 0, KIND_INT, FIELD(gait.frames_per_step), "N", "frames of one step", "36", "Walk", COMMAND_WALK, RANGE(4, 1000)},
    {"height", 0, KIND_REAL, FIELD(gait.height), "M", "stature in metres", "1.7", "Walk", COMMAND_WALK, RANGE(0.5, 2.5)},
    {"speed", 0, KIND_REAL, FIELD(gait.speed), "M/S", "metres a second", "what suits the step", "Walk", COMMAND_WALK, RANGE(0.05, 10)},
    {"step-length", 0, KIND_REAL, FIELD(gait.step_length), "M", "metres from heel to heel", "what suits height and preset", "Walk",
     COMMAND_WALK, RANGE(0.05, 2)},
    {"knee-lift", 0, KIND_REAL, FIELD(gait.knee_lift), "DEG", "how much more the knee bends in swing", "0", "Walk", COMMAND_WALK,
     RANGE(0, 90)},
    {"arm-swing", 0, KIND_REAL, FIELD(gait.arm_swing), "DEG", "half the range of the upper arm", "the preset's", "Walk", COMMAND_WALK,
     RANGE(0, 90)},
    {"slope", 0, KIND_REAL, FIELD(gait.slope), "DEG", "of the ground, up is positive", "0", "Walk", COMMAND_WALK, RANGE(-40, 40)},
    {"stairs", 0, KIND_INT, FIELD(gait.stair_count), "N", "steps of a stair", "0", "Walk", COMMAND_WALK, RANGE(0, 1000)},
    {"stair-rise", 0, KIND_REAL, FIELD(gait.stair_rise), "M", "height of each, downwards if negative", "0", "Walk", COMMAND_WALK,
     RANGE(-0.4, 0.4)},
    {"stair-run", 0, KIND_REAL, FIELD(gait.stair_run), "M", "depth of each", "0", "Walk", COMMAND_WALK, RANGE(0, 1)},
    {"output", 'o', KIND_TEXT, FIELD(output), "FILE", "BVH file to write", "standard output", "Output", COMMAND_WALK},

    {"jobs", 'j', KIND_INT, FIELD(jobs), "N", "motions that are dressed at the same time", "one for each processor", "Run",
     COMMAND_DRESS, RANGE(1, 256)},
    {"strict", 0, KIND_FLAG, FIELD(strict), NULL, "exit with 1 if the body shows through a garment anywhere", NULL, "Run",
     COMMAND_DRESS},
    {"quiet", 'q', KIND_FLAG, FIELD(quiet), NULL, "errors only", NULL, "Messages", COMMAND_DRESS},
    {"verbose", 'v', KIND_FLAG, FIELD(verbose), NULL, "more about each motion, and where the time went", NULL, "Messages",
     COMMAND_DRESS},
    {"progress", 0, KIND_CHOICE, FIELD(progress), "WHEN", "a line that tells how far it is; auto: on a terminal", "auto", "Messages",
     COMMAND_DRESS, .choices = progress_modes},
    {"help", 'h', KIND_FLAG, FIELD(help), NULL, "print this page", NULL, "Messages", COMMAND_ALL},
    {"version", 'V', KIND_FLAG, FIELD(version), NULL, "print the version", NULL, "Messages", COMMAND_ALL},
    {0}};

const Option *settings_find(const char *name, size_t length, unsigned commands) {
    const Option *other = NULL;
    for (const Option *o = settings_table; o->name; o++) {
        if (strlen(o->name) != length || memcmp(o->name, name, length) != 0) continue;
        if (o->commands & commands) return o;
        other = o;
    }
    return other;
}

const Option *settings_find_letter(char letter, unsigned commands) {
    const Option *other = NULL;
    for (const Option *o = settings_table; o->name; o++) {
        if (!o->letter || o->letter != letter) continue;
        if (o->commands & commands) return o;
        other = o;
    }
    return other;
}

/* A beginning of a name counts as near, however much is missing. */
const Option *settings_nearest(const char *name, unsigned commands) {
    const Option *best = NULL;
    int least = 4, length = (int)strlen(name);
    for (const Option *o = settings_table; o->name; o++) {
        if (!(o->commands & commands)) continue;
        int distance = length >= 3 && strncmp(o->name, name, (size_t)length) == 0 ? 1 : text_distance(o->name, name);
        if (distance < least && distance < (int)strlen(o->name) / 2 + 1) {
            least = distance;
            best = o;
        }
    }
    return best;
}

const char *settings_choices(const Choice *choices, char *out, size_t n) {
    size_t used = 0;
    for (const Choice *c = choices; c->name && used < n; c++)
        used += (size_t)snprintf(out + used, n - used, "%s%s", c == choices ? "" : c[1].name ? ", " : " or ", c->name);
    return out;
}

static bool put_flag(bool *field, const Option *option, const char *text, Error *e) {
    *field = strcmp(text, "yes") == 0;
    return *field || strcmp(text, "no") == 0 ||
           error_set(e, ERR_USAGE, "option '--%s' is a switch: expected yes or no, found '%s'", option->name, text);
}

/* The whole text as a number. */
static bool is_number(const char *text, double *x) {
    const char *end = text + strlen(text);
    return text_number(text, end, x) == end && *text;
}

static bool put_int(int *field, const Option *option, const char *text, Error *e) {
    double x = 0;
    int step = option->step ? option->step : 1;
    bool good = is_number(text, &x) && x >= option->low && x <= option->high && (int)x == x && (int)x % step == 0;
    if (good) *field = (int)x + option->bias;
    else if (step > 1)
        error_set(e, ERR_USAGE, "option '--%s': expected a multiple of %d from %.0f to %.0f, found '%s'", option->name, step,
                  option->low, option->high, text);
    else
        error_set(e, ERR_USAGE, "option '--%s': expected a whole number from %.0f to %.0f, found '%s'", option->name, option->low,
                  option->high, text);
    return good;
}

static bool put_real(double *field, const Option *option, const char *text, Error *e) {
    double x = 0;
    if (!is_number(text, &x) || !(x >= option->low && x <= option->high))
        return error_set(e, ERR_USAGE, "option '--%s': expected a number from %g to %g, found '%s'", option->name, option->low,
                         option->high, text);
    *field = x;
    return true;
}

static bool put_unit(double *field, const Option *option, const char *text, Error *e) {
    for (int i = 0; i < UNITS; i++) {
        if (strcmp(text, units[i].name) != 0) continue;
        *field = units[i].metres;
        return true;
    }
    double x = 0;
    if (!is_number(text, &x) || !(x >= option->low && x <= option->high))
        return error_set(e, ERR_USAGE, "option '--%s': expected m, dm, cm, mm, in, ft or a number of metres from %g to %g, found '%s'",
                         option->name, option->low, option->high, text);
    *field = x;
    return true;
}

static const Choice *find_choice(const Option *option, const char *text, size_t length) {
    for (const Choice *c = option->choices; c->name; c++)
        if (strlen(c->name) == length && memcmp(c->name, text, length) == 0) return c;
    return NULL;
}

static bool wrong_choice(const Option *option, const char *text, size_t length, Error *e) {
    char names[160];
    return error_set(e, ERR_USAGE, "option '--%s': expected %s, found '%.*s'", option->name,
                     settings_choices(option->choices, names, sizeof names), (int)(length < 80 ? length : 80), text);
}

static bool put_choice(int *field, const Option *option, const char *text, Error *e) {
    const Choice *c = find_choice(option, text, strlen(text));
    if (!c) return wrong_choice(option, text, strlen(text), e);
    *field = c->value;
    return true;
}

static bool put_set(unsigned *field, const Option *option, const char *text, Error *e) {
    unsigned set = 0;
    for (const char *at = text;;) {
        size_t length = strcspn(at, ",");
        const Choice *c = find_choice(option, at, length);
        if (!c) return wrong_choice(option, at, length, e);
        set |= (unsigned)c->value;
        at += length;
        if (!*at++) break;
    }
    *field = set;
    return true;
}

/* A, A:B, A:B:STEP, where each part may be empty. A alone is that one frame. */
static bool put_span(FrameSpan *field, const Option *option, const char *text, Error *e) {
    int part[3] = {0, 0, 0}, n = 0;
    const char *at = text;
    for (;; at++, n++) {
        size_t length = strcspn(at, ":");
        double x = 0;
        if (n == 3) break;
        if (length && (text_number(at, at + length, &x) != at + length || !(x >= 1 && x <= 2e9) || x != (int)x)) break;
        part[n] = (int)x;
        at += length;
        if (!*at) {
            if (n == 0) part[1] = part[0];
            bool empty = n == 0 && length == 0;
            if (empty || (part[1] && part[1] < part[0])) break;
            *field = (FrameSpan){part[0], part[1], part[2]};
            return true;
        }
    }
    return error_set(e, ERR_USAGE, "option '--%s': expected A:B:STEP with frames from 1 and A <= B, found '%s'", option->name, text);
}

bool settings_append(TextList *list, const char *text, Arena *arena, Error *e) {
    if ((list->count & (list->count - 1)) == 0) { /* full at every power of two */
        const char **more = ARENA_NEW(arena, const char *, list->count ? 2 * list->count : 1, e);
        if (!more) return false;
        if (list->count) memcpy(more, list->item, (size_t)list->count * sizeof *more);
        list->item = more;
    }
    list->item[list->count++] = text;
    return true;
}

bool settings_put(Settings *s, const Option *option, const char *text, Arena *arena, Error *e) {
    void *field = (char *)s + option->field;
    switch (option->kind) {
    case KIND_FLAG: return put_flag(field, option, text, e);
    case KIND_INT: return put_int(field, option, text, e);
    case KIND_REAL: return put_real(field, option, text, e);
    case KIND_LIST: return settings_append(field, text, arena, e);
    case KIND_CHOICE: return put_choice(field, option, text, e);
    case KIND_SET: return put_set(field, option, text, e);
    case KIND_SPAN: return put_span(field, option, text, e);
    case KIND_UNIT: return put_unit(field, option, text, e);
    case KIND_TEXT: break;
    }
    if (!*text) return error_set(e, ERR_USAGE, "option '--%s' needs a %s", option->name, option->argument);
    if (option->choices && !find_choice(option, text, strlen(text))) return wrong_choice(option, text, strlen(text), e);
    *(const char **)field = text;
    return true;
}
