/* The table of options. One row is all there is to an option: add it here, and it is parsed, range-checked,
   explained in the help, suggested when it is mistyped and, because a job file's keys are the long names, understood
   there too. Elsewhere names of options stand only in messages, and in options.c, where two contradict each other. */
#include "app/settings.h"

#include <string.h>

#include "base/text.h"

static const Choice split_rules[] = {
    {"adaptive", SPLIT_ADAPTIVE}, {"uniform", SPLIT_UNIFORM}, {"none", SPLIT_NONE}, {NULL, 0}};
static const Choice methods[] = {
    {"push", METHOD_PUSH}, {"paper", METHOD_PAPER}, {"global", METHOD_GLOBAL}, {NULL, 0}};
static const Choice topologies[] = {{"adaptive", 0}, {"fixed", 1}, {NULL, 0}};
static const Choice positions[] = {
    {"guess", POSITION_GUESS}, {"add", POSITION_ADD}, {"replace", POSITION_REPLACE}, {NULL, 0}};
static const Choice axes[] = {{"x", 'x'}, {"y", 'y'}, {"z", 'z'}, {"-x", 'X'}, {"-y", 'Y'}, {"-z", 'Z'}, {NULL, 0}};
static const Choice formats[] = {{"obj", FORMAT_OBJ}, {"drc", FORMAT_DRC}, {"none", FORMAT_NONE}, {NULL, 0}};
static const Choice compared[] = {
    {"uniform", 1 << COMPARE_UNIFORM}, {"adaptive", 1 << COMPARE_ADAPTIVE}, {"global", 1 << COMPARE_GLOBAL},
    {"paper", 1 << COMPARE_PAPER}, {NULL, 0}};
static const Choice presets[] = {{"normal", 0}, {"paper", 0}, {"brisk", 0}, {"squat", 0}, {"turn", 0}, {NULL, 0}};
static const Choice shows[] = {
    {"patches", SHOW_PATCHES}, {"points", SHOW_POINTS}, {"cells", SHOW_CELLS}, {NULL, 0}};
static const Choice progress_modes[] = {
    {"auto", PROGRESS_AUTO}, {"always", PROGRESS_ALWAYS}, {"never", PROGRESS_NEVER}, {"json", PROGRESS_JSON},
    {NULL, 0}};

#define FIELD(name) .field = offsetof(Settings, name)
#define RANGE(least, most) .low = (least), .high = (most)
#define BODIES (COMMAND_DRESS | COMMAND_COMPARE | COMMAND_DRAW) /* what dresses bodies */
#define MOVES (BODIES | COMMAND_INSPECT)                         /* what opens motions */

const Option settings_table[] = {
    {"motion", 0, KIND_LIST, FIELD(inputs), "FILE", "Motion", COMMAND_DRESS | COMMAND_COMPARE,
     "motion, folder of motions or pattern in quotes; on a command line the path alone is enough"},
    {"motion", 0, KIND_LIST, FIELD(inputs), "FILE", "Motion", COMMAND_DRAW,
     "motion to draw; on a command line the path alone is enough"},
    {"motion", 0, KIND_LIST, FIELD(inputs), "FILE", "Motion", COMMAND_INSPECT,
     "motion, garment or body; on a command line the path alone is enough"},
    {"files-from", 0, KIND_TEXT, FIELD(files_from), "FILE", "Motion", COMMAND_DRESS,
     "list of more motions, one in a line, or separated by NUL; -: standard input"},
    {"asf", 0, KIND_TEXT, FIELD(asf), "FILE", "Motion", MOVES,
     "skeleton of AMC motions", .fallback = "the .asf file beside the motion"},
    {"roles", 0, KIND_TEXT, FIELD(roles), "FILE", "Motion", MOVES,
     "which joint is which bone, as lines 'role = joint'", .fallback = "found by names and shape"},
    {"frames", 0, KIND_SPAN, FIELD(frames), "A:B:STEP", "Motion", COMMAND_DRESS | COMMAND_COMPARE,
     "first and last frame, counted from 1, and step; each part may be left out", .fallback = "all"},
    {"frames", 0, KIND_SPAN, FIELD(frames), "A:B:STEP", "Motion", COMMAND_INSPECT,
     "frames that --joints prints: first and last, counted from 1, and step; each part may be left out",
     .fallback = "all"},
    {"frames", 0, KIND_TEXT, FIELD(draw.frames), "LIST", "Motion", COMMAND_DRAW,
     "frames to draw, separated by commas: A, A:B or A:B:STEP, counted from 1", .fallback = "six, evenly spread"},
    {"rate", 0, KIND_REAL, FIELD(rate), "HZ", "Motion", COMMAND_DRESS | COMMAND_COMPARE,
     "resample to so many frames a second; --frames then counts these", .fallback = "the motion's own",
     RANGE(0.001, 100000)},
    {"fps", 0, KIND_REAL, FIELD(fps), "HZ", "Motion", MOVES,
     "frames a second of the motion, instead of what the file says", .fallback = "the file's, or 120",
     RANGE(0.001, 100000)},
    {"unit", 0, KIND_UNIT, FIELD(unit), "UNIT", "Motion", MOVES,
     "length unit of the motion", .fallback = "found from the figure's size", RANGE(1e-6, 1e6)},
    {"scale", 0, KIND_REAL, FIELD(scale), "X", "Motion", MOVES,
     "make the figure so many times larger", .fallback = "1", RANGE(0.001, 1000)},
    {"up", 0, KIND_CHOICE, FIELD(up), "AXIS", "Motion", MOVES,
     "axis that points up in the motion", .fallback = "found from the poses", .choices = axes},
    {"position", 0, KIND_CHOICE, FIELD(position), "RULE", "Motion", MOVES,
     "what position channels do to a joint's OFFSET", .fallback = "guess", .choices = positions},
    {"relax-arms", 0, KIND_FLAG, FIELD(relax_arms), NULL, "Motion", COMMAND_DRESS,
     "turn arms outwards, just enough to leave room for the cloth between them and the body"},

    {"garment", 'g', KIND_LIST, FIELD(garments), "FILE", "Garments and body", BODIES,
     "garment to put on; repeat it for several"},
    {"body", 0, KIND_TEXT, FIELD(body), "FILE", "Garments and body", BODIES,
     "body to dress", .fallback = "a well-proportioned adult"},
    {"body-detail", 0, KIND_INT, FIELD(body_detail), "N", "Garments and body", BODIES,
     "facets round each section of the body", .fallback = "16", RANGE(8, 64), .step = 4},

    {"method", 0, KIND_CHOICE, FIELD(method), "NAME", "Method", COMMAND_DRESS | COMMAND_DRAW,
     "local deformation: push shared vertices out of the body, the paper's way to the letter, or none",
     .fallback = "push", .choices = methods},
    {"split", 0, KIND_CHOICE, FIELD(split), "RULE", "Method", COMMAND_DRESS | COMMAND_DRAW,
     "which patches are split: those that meet the body, all, or none", .fallback = "adaptive",
     .choices = split_rules},
    {"depth", 0, KIND_INT, FIELD(depth), "N", "Method", BODIES,
     "levels of splitting", .fallback = "2", RANGE(1, 3)},
    {"detail", 0, KIND_INT, FIELD(detail), "N", "Method", BODIES,
     "facets along each side of a patch", .fallback = "the garment's, or 8", RANGE(1, 64)},
    {"topology", 0, KIND_CHOICE, FIELD(fixed), "KIND", "Method", COMMAND_DRESS,
     "adaptive: facets follow the splitting; fixed: the same triangles in every frame", .fallback = "adaptive",
     .choices = topologies},

    {"methods", 0, KIND_SET, FIELD(methods), "LIST", "Method", COMMAND_COMPARE,
     "what to compare, separated by commas; uniform and adaptive are always compared", .fallback = "uniform,adaptive",
     .choices = compared},
    {"repeat", 0, KIND_INT, FIELD(repeat), "N", "Method", COMMAND_COMPARE,
     "runs that are timed; the fastest counts", .fallback = "3", RANGE(1, 16)},

    {"output", 'o', KIND_TEXT, FIELD(output), "DIR", "Output", COMMAND_COMPARE,
     "folder for compare.csv, tests.svg and times.svg; DIR/MOTION/GARMENT for each of several pairs"},
    {"force", 'f', KIND_FLAG, FIELD(force), NULL, "Output", COMMAND_COMPARE,
     "replace what an earlier run wrote", .manner = true},
    {"output", 'o', KIND_TEXT, FIELD(output), "DIR", "Output", COMMAND_DRESS,
     "folder for everything that is written; made if missing"},
    {"format", 0, KIND_SET, FIELD(formats), "LIST", "Output", COMMAND_DRESS,
     "mesh files, separated by commas", .fallback = "obj,drc", .choices = formats},
    {"output-unit", 0, KIND_UNIT, FIELD(output_unit), "UNIT", "Output", COMMAND_DRESS,
     "length unit of the written meshes", .fallback = "m", RANGE(1e-6, 1e6)},
    {"no-body", 0, KIND_FLAG, FIELD(no_body), NULL, "Output", COMMAND_DRESS,
     "write no meshes of the body"},
    {"no-times", 0, KIND_FLAG, FIELD(no_times), NULL, "Output", COMMAND_DRESS | COMMAND_COMPARE,
     "leave the columns of seconds out of the statistics"},
    {"force", 'f', KIND_FLAG, FIELD(force), NULL, "Output", COMMAND_DRESS,
     "replace motion folders that are there already", .manner = true},
    {"draco-position-bits", 0, KIND_INT, FIELD(drc.position_bits), "N", "Output", COMMAND_DRESS,
     "quantisation of positions", .fallback = "16", RANGE(1, 30)},
    {"draco-normal-bits", 0, KIND_INT, FIELD(drc.normal_bits), "N", "Output", COMMAND_DRESS,
     "quantisation of normals", .fallback = "10", RANGE(2, 30)},
    {"draco-uv-bits", 0, KIND_INT, FIELD(drc.uv_bits), "N", "Output", COMMAND_DRESS,
     "quantisation of patch parameters", .fallback = "12", RANGE(1, 30)},
    {"draco-speed", 0, KIND_INT, FIELD(drc.speed), "N", "Output", COMMAND_DRESS,
     "0: smallest files, 10: fastest", .fallback = "7", RANGE(0, 10), .bias = 1},
    {"draco-keep-order", 0, KIND_FLAG, FIELD(drc.keep_order), NULL, "Output", COMMAND_DRESS,
     "keep the order of vertices; larger files"},

    {"joints", 0, KIND_FLAG, FIELD(joints), NULL, "Output", COMMAND_INSPECT,
     "print frame,joint,x,y,z of every joint and frame, in the file's units and axes"},

    {"preset", 0, KIND_TEXT, FIELD(gait.preset), "NAME", "Walk", COMMAND_WALK,
     "kind of walk; paper: that of the comparison of splitting rules", .fallback = "normal", .choices = presets},
    {"steps", 0, KIND_INT, FIELD(gait.steps), "N", "Walk", COMMAND_WALK,
     "steps to walk", .fallback = "what suits the preset", RANGE(1, 10000)},
    {"frames-per-step", 0, KIND_INT, FIELD(gait.frames_per_step), "N", "Walk", COMMAND_WALK,
     "frames of one step", .fallback = "36", RANGE(4, 1000)},
    {"height", 0, KIND_REAL, FIELD(gait.height), "M", "Walk", COMMAND_WALK,
     "stature in metres", .fallback = "1.7", RANGE(0.5, 2.5)},
    {"speed", 0, KIND_REAL, FIELD(gait.speed), "M/S", "Walk", COMMAND_WALK,
     "metres a second", .fallback = "what suits the step", RANGE(0.05, 5)},
    {"step-length", 0, KIND_REAL, FIELD(gait.step_length), "M", "Walk", COMMAND_WALK,
     "metres from heel to heel", .fallback = "what suits height and preset", RANGE(0.05, 2)},
    {"knee-lift", 0, KIND_REAL, FIELD(gait.knee_lift), "DEG", "Walk", COMMAND_WALK,
     "how much more the knee bends in swing", .fallback = "0", RANGE(0, 60)},
    {"arm-swing", 0, KIND_REAL, FIELD(gait.arm_swing), "DEG", "Walk", COMMAND_WALK,
     "half the range of the upper arm", .fallback = "the preset's", RANGE(0, 80)},
    {"slope", 0, KIND_REAL, FIELD(gait.slope), "DEG", "Walk", COMMAND_WALK,
     "of the ground, up is positive", .fallback = "0", RANGE(-35, 35)},
    {"stairs", 0, KIND_STAIRS, FIELD(gait), "RISE:RUN:COUNT", "Walk", COMMAND_WALK,
     "height and depth of a stair in metres, and how many; downwards if RISE is negative", .fallback = "none"},
    {"output", 'o', KIND_TEXT, FIELD(output), "FILE", "Output", COMMAND_WALK,
     "BVH file to write", .fallback = "standard output"},

    {"view", 0, KIND_TEXT, FIELD(draw.view), "SIDE", "Picture", COMMAND_DRAW,
     "front, back, left, right, iso, or degrees AZ/EL round to the figure's left and above", .fallback = "front"},
    {"zoom", 0, KIND_REAL, FIELD(draw.zoom), "X", "Picture", COMMAND_DRAW,
     "enlarge so many times, round the garments", .fallback = "1, all", RANGE(1, 20)},
    {"follow", 0, KIND_FLAG, FIELD(draw.follow), NULL, "Picture", COMMAND_DRAW,
     "the camera goes along with the figure"},
    {"show", 0, KIND_SET, FIELD(draw.show), "LIST", "Picture", COMMAND_DRAW,
     "also draw the borders of patches, their control points, or both for the cells that the solver made of them",
     .fallback = "nothing more", .choices = shows},
    {"cell", 0, KIND_LIST, FIELD(draw.cells), "WORDS=TITLE", "Picture", COMMAND_DRAW,
     "one of several pictures of each frame: methods, rules of splitting and what to show, separated by commas, "
     "and a title if you like", .fallback = "one picture by the options above"},
    {"size", 0, KIND_INT, FIELD(draw.size), "N", "Picture", COMMAND_DRAW,
     "height of each picture in points", .fallback = "320", RANGE(50, 1000)},
    {"columns", 0, KIND_INT, FIELD(draw.columns), "N", "Picture", COMMAND_DRAW,
     "pictures in a row of the sheet", .fallback = "what suits", RANGE(1, 64)},
    {"output", 'o', KIND_TEXT, FIELD(output), "FILE", "Output", COMMAND_DRAW,
     "SVG file to write; - is standard output"},

    {"folder", 0, KIND_LIST, FIELD(inputs), "DIR", "Meshes", COMMAND_VERIFY,
     "what dress wrote; on a command line the path alone is enough"},
    {"garment", 'g', KIND_LIST, FIELD(garments), "FILE", "Meshes", COMMAND_VERIFY,
     "garment meshes, the frame's number at *, #### or %04d; repeat it for several", .fallback = "those in DIR"},
    {"body", 0, KIND_TEXT, FIELD(body), "FILE", "Meshes", COMMAND_VERIFY,
     "body meshes, likewise; without a number one body for all frames", .fallback = "those in DIR"},
    {"frames", 0, KIND_SPAN, FIELD(frames), "A:B:STEP", "Meshes", COMMAND_VERIFY,
     "first and last frame, and step; each part may be left out", .fallback = "all"},
    {"parts", 0, KIND_TEXT, FIELD(parts), "NAMES", "Meshes", COMMAND_VERIFY,
     "groups of the body that count, separated by commas", .fallback = "all"},
    {"unit", 0, KIND_UNIT, FIELD(unit), "UNIT", "Meshes", COMMAND_VERIFY,
     "length unit of the meshes", .fallback = "what the file says, or m", RANGE(1e-6, 1e6)},
    {"rate", 0, KIND_REAL, FIELD(rate), "HZ", "Meshes", COMMAND_VERIFY,
     "frames a second, for accelerations", .fallback = "that of stats.csv, or 30", RANGE(0.001, 100000)},
    {"acceleration", 0, KIND_FLAG, FIELD(acceleration), NULL, "Output", COMMAND_VERIFY,
     "also print the accelerations of garment and body", .manner = true},
    {"landmarks", 0, KIND_FLAG, FIELD(landmarks), NULL, "Output", COMMAND_VERIFY,
     "also print how far the garment goes round hips, thighs, knees and torso", .manner = true},
    {"list", 0, KIND_FLAG, FIELD(list), NULL, "Output", COMMAND_VERIFY,
     "print each pair, vertex inside and crack instead of a row for each frame", .manner = true},

    {"jobs", 'j', KIND_INT, FIELD(jobs), "N", "Run", COMMAND_DRESS,
     "threads", .fallback = "one for each processor", RANGE(1, 256), .manner = true},
    {"resume", 0, KIND_FLAG, FIELD(resume), NULL, "Run", COMMAND_DRESS,
     "leave out motions that are finished, made of the same inputs with the same options", .manner = true},
    {"shard", 0, KIND_SHARD, FIELD(shard), "K/N", "Run", COMMAND_DRESS,
     "dress every N-th motion of the list, from the K-th on; writes summary.K-of-N.csv", .manner = true},
    {"merge", 0, KIND_FLAG, FIELD(merge), NULL, "Run", COMMAND_DRESS,
     "dress nothing: join the summaries in the named folders into one summary.csv", .manner = true},
    {"max-frames", 0, KIND_INT, FIELD(max_frames), "N", "Run", MOVES,
     "refuse longer motions", .fallback = "100000000", RANGE(1, 2e9), .manner = true},
    {"max-joints", 0, KIND_INT, FIELD(max_joints), "N", "Run", MOVES,
     "refuse motions with more joints", .fallback = "10000", RANGE(1, 1e6), .manner = true},
    {"max-memory", 0, KIND_INT, FIELD(max_memory), "MB", "Run", COMMAND_DRESS,
     "refuse motions that need more for a thread", .fallback = "no limit", RANGE(1, 1e6), .manner = true},
    {"strict", 0, KIND_FLAG, FIELD(strict), NULL, "Run", COMMAND_DRESS,
     "exit with 1 if what a garment is worn over shows through it; limbs from outside do not count", .manner = true},
    {"job", 0, KIND_TEXT, FIELD(job), "FILE", "Run", COMMAND_ALL,
     "read options from lines 'name value'; what the command line says wins", .manner = true},
    {"print-job", 0, KIND_FLAG, FIELD(print_job), NULL, "Run", COMMAND_ALL,
     "print the job file that says the same as this command line, and do nothing else", .manner = true},
    {"quiet", 'q', KIND_FLAG, FIELD(quiet), NULL, "Messages", BODIES | COMMAND_VERIFY,
     "errors only", .manner = true},
    {"verbose", 'v', KIND_FLAG, FIELD(verbose), NULL, "Messages", COMMAND_DRESS,
     "more about each motion, and where the time went", .manner = true},
    {"progress", 0, KIND_CHOICE, FIELD(progress), "WHEN", "Messages", COMMAND_DRESS | COMMAND_COMPARE,
     "a line that tells how far the run has come; auto: on a terminal; json: a line a second for programs",
     .fallback = "auto", .choices = progress_modes, .manner = true},
    {"help", 'h', KIND_FLAG, FIELD(help), NULL, "Messages", COMMAND_ALL,
     "print this page", .manner = true},
    {"version", 'V', KIND_FLAG, FIELD(version), NULL, "Messages", COMMAND_ALL,
     "print the version", .manner = true},
    {0}};

const Option *settings_find(const char *name, unsigned commands) {
    const Option *other = NULL;
    for (const Option *o = settings_table; o->name; o++) {
        if (strcmp(o->name, name) != 0) continue;
        if (o->commands & commands) return o;
        other = o;
    }
    return other;
}

const Option *settings_find_switch(const char *name, unsigned commands, bool *no) {
    const Option *option = settings_find(name, commands);
    *no = false;
    if (option || strncmp(name, "no-", 3) != 0) return option;
    option = settings_find(name + 3, commands);
    *no = true;
    return option && option->kind == KIND_FLAG ? option : NULL;
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

const char *settings_nearest(const char *name, unsigned commands) {
    Nearest n = {.word = name};
    for (const Option *o = settings_table; o->name; o++)
        if (o->commands & commands) nearest_try(&n, o->name);
    return n.best;
}

void settings_clear(Settings *s) {
    memset(s, 0, sizeof *s);
    gait_defaults(&s->gait);
}

bool settings_is_path(const Option *option) {
    return option->argument && (strcmp(option->argument, "FILE") == 0 || strcmp(option->argument, "DIR") == 0);
}

const char *settings_choices(const Choice *choices, char *out, size_t n) {
    size_t used = 0;
    for (const Choice *c = choices; c->name && used < n; c++)
        used += (size_t)snprintf(out + used, n - used, "%s%s", c == choices ? "" : c[1].name ? ", " : " or ", c->name);
    return out;
}
