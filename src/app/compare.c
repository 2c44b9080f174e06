/* Every method dresses a frame before the next one comes, so all see the same body. For times the
   whole motion is run several times: what disturbs the machine for a second then spoils one run of
   a frame and not all of them. Counts are those of the first run, the others give the same. Rows
   are kept, for a picture needs them all. */
#include "app/compare.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "app/stop.h"
#include "app/take.h"
#include "app/wearer.h"
#include "files/output.h"
#include "files/plot.h"
#include "files/stats.h"

enum { RUNS_DEFAULT = 3, POINTS_PER_PATCH = 16 };

/* One method in one frame; seconds are the least of all runs. */
typedef struct {
    int frame;
    FrameStats stats;
    long long points, bytes;
    double plain_s, culled_s, solve_s;
} FrameRow;

typedef struct {
    Wardrobe wardrobe;      /* with the one garment */
    const Settings *settings;
    Arena *arena;
    ObjWriter *obj;
    unsigned methods;
    int patches;
    Wearer wearer;
    Take *take;
    Dresser *dresser[COMPARE_METHODS];
    int nframes;            /* that were dressed in this run */
    FrameRow *row[COMPARE_METHODS];
    CompareSum *sum;
} Experiment;

unsigned compare_methods(const Settings *s) { return s->methods | 1u << COMPARE_UNIFORM | 1u << COMPARE_ADAPTIVE; }

int compare_runs(const Settings *s) { return s->no_times ? 1 : s->repeat ? s->repeat : RUNS_DEFAULT; }

const char *compare_name(CompareMethod method) {
    static const char *const names[COMPARE_METHODS] = {"uniform", "adaptive", "global", "paper"};
    return names[method];
}

static bool is_run(const Experiment *x, int method) { return x->methods >> method & 1; }

static bool open_dresser(Experiment *x, int method, Error *e) {
    const Settings *s = x->settings;
    DressOptions options = {.detail = s->detail, .depth = s->depth, .plain_tests = !s->no_times};
    Dresser **dresser;
    if (method == COMPARE_UNIFORM) options.split = SPLIT_UNIFORM;
    if (method == COMPARE_GLOBAL) options.method = METHOD_GLOBAL;
    if (method == COMPARE_PAPER) options.method = METHOD_PAPER;
    if (!wearer_put_on(&x->wearer, &x->wardrobe, &options, x->arena, &dresser, e)) return false;
    x->dresser[method] = dresser[0];
    x->patches = dresser_info(dresser[0]).patches;
    x->row[method] = ARENA_NEW(x->arena, FrameRow, take_count(x->take), e);
    return x->row[method] != NULL;
}

static bool open_take(Experiment *x, Error *e) {
    const Settings *s = x->settings;
    return take_open(&x->wearer.motion, &x->wearer.figure, &s->frames, s->rate, x->arena, &x->take, e);
}

static bool open_all(Experiment *x, const Input *input, Notes *notes, Error *e) {
    if (input->is_empty) return error_set(e, ERR_INPUT, "no motion (.bvh or .amc) in the folder '%s'", input->path);
    if (!wearer_open(&x->wardrobe, input->path, 1, x->arena, notes, &x->wearer, e) || !open_take(x, e)) return false;
    for (int m = 0; m < COMPARE_METHODS; m++)
        if (is_run(x, m) && !open_dresser(x, m, e)) return false;
    return true;
}

static void add_seconds(CompareSeconds *sum, int run, double seconds, bool contact) {
    sum->all[run] += seconds;
    if (contact) sum->contact[run] += seconds;
}

static void add_row(CompareSum *sum, const FrameRow *row, bool contact) {
    const FrameStats *s = &row->stats;
    sum->frames++;
    sum->contact_frames += contact;
    sum->residual_frames += stats_has_residual(s);
    sum->nodes += s->nodes;
    sum->leaves += s->leaves;
    sum->tests += s->tests;
    sum->tests_culled += s->tests_culled;
    sum->points += row->points;
    sum->bytes += row->bytes;
    if (contact) sum->tests_contact += s->tests;
    if (s->nodes > sum->nodes_max) sum->nodes_max = s->nodes;
    if (s->leaves > sum->leaves_max) sum->leaves_max = s->leaves;
    if (s->tests > sum->tests_max) sum->tests_max = s->tests;
    if (s->displacement > sum->displacement) sum->displacement = s->displacement;
}

void compare_add(CompareSum *sum, const CompareSum *other) {
    CompareSum all = *other;
    all.frames += sum->frames;
    all.contact_frames += sum->contact_frames;
    all.residual_frames += sum->residual_frames;
    all.nodes += sum->nodes;
    all.leaves += sum->leaves;
    all.tests += sum->tests;
    all.tests_contact += sum->tests_contact;
    all.tests_culled += sum->tests_culled;
    all.points += sum->points;
    all.bytes += sum->bytes;
    if (sum->nodes_max > all.nodes_max) all.nodes_max = sum->nodes_max;
    if (sum->leaves_max > all.leaves_max) all.leaves_max = sum->leaves_max;
    if (sum->tests_max > all.tests_max) all.tests_max = sum->tests_max;
    if (sum->displacement > all.displacement) all.displacement = sum->displacement;
    CompareSeconds *to[] = {&all.plain, &all.culled, &all.solve};
    const CompareSeconds *from[] = {&sum->plain, &sum->culled, &sum->solve};
    for (int k = 0; k < 3; k++)
        for (int r = 0; r < COMPARE_RUNS_MAX; r++) {
            to[k]->all[r] += from[k]->all[r];
            to[k]->contact[r] += from[k]->contact[r];
        }
    *sum = all;
}

/* One method in one frame of run r. */
static bool dress_method(Experiment *x, int r, int method, const TakeFrame *frame, FrameStats *stats, Error *e) {
    FrameRow *row = &x->row[method][x->nframes];
    Mesh mesh;
    dresser_frame(x->dresser[method], &x->wearer.posed, frame->dt, frame->tie, &mesh, stats);
    if (r == 0 || stats->plain_s < row->plain_s) row->plain_s = stats->plain_s;
    if (r == 0 || stats->classify_s < row->culled_s) row->culled_s = stats->classify_s;
    if (r == 0 || stats->push_s < row->solve_s) row->solve_s = stats->push_s;
    if (r > 0) return true;
    if (!obj_format(x->obj, &mesh, 1, e)) return false;
    row->frame = frame->number;
    row->stats = *stats;
    row->points = (long long)POINTS_PER_PATCH * stats->cells;
    row->bytes = (long long)x->obj->size;
    return true;
}

static bool dress_frame(Experiment *x, int r, const TakeFrame *frame, Error *e) {
    FrameStats stats[COMPARE_METHODS];
    body_frame_pose(&x->wearer.posed, &frame->pose);
    for (int m = 0; m < COMPARE_METHODS; m++)
        if (is_run(x, m) && !dress_method(x, r, m, frame, &stats[m], e)) return false;
    bool contact = stats[COMPARE_ADAPTIVE].nodes > x->patches;
    for (int m = 0; m < COMPARE_METHODS; m++) {
        if (!is_run(x, m)) continue;
        if (r == 0) add_row(&x->sum[m], &x->row[m][x->nframes], contact);
        add_seconds(&x->sum[m].plain, r, stats[m].plain_s, contact);
        add_seconds(&x->sum[m].culled, r, stats[m].classify_s, contact);
        add_seconds(&x->sum[m].solve, r, stats[m].push_s, contact);
    }
    x->nframes++;
    return true;
}

/* The frames of run r. */
static bool dress_frames(Experiment *x, int r, Notes *notes, Error *e) {
    TakeFrame frame;
    if (r > 0 && !open_take(x, e)) return false; /* the first one is open */
    x->nframes = 0;
    while (take_next(x->take, &frame, e)) {
        if (!dress_frame(x, r, &frame, e)) return false;
        if (stop_requested()) return error_set(e, ERR_INTERRUPTED, "interrupted");
    }
    if (r == 0) take_notes(x->take, notes);
    take_close(x->take);
    x->take = NULL;
    return e->kind == ERR_NONE;
}

static void put_row(const FrameRow *row, const char *method, bool times, FILE *out) {
    const FrameStats *s = &row->stats;
    fprintf(out, "%d,%s,%d,%d,%lld,%lld,%d,%d,%d,%.6f", row->frame, method, s->nodes, s->leaves, s->tests,
            s->tests_culled, s->depth, s->cells, s->hits_before, s->displacement);
    fprintf(out, ",%d,%d,%d,%lld,%lld", s->residual_edges, s->residual_cloth, s->inside, row->points, row->bytes);
    if (times) fprintf(out, ",%.6f,%.6f,%.6f", row->plain_s, row->culled_s, row->solve_s);
    fputc('\n', out);
}

static void put_table(const Experiment *x, FILE *out) {
    bool times = !x->settings->no_times;
    fprintf(out, "frame,method,nodes,leaves,tests,tests_culled,depth,cells,hits,displacement,residual_edges,"
                 "residual_cloth,inside,control_points,bytes%s\n", times ? ",tests_s,tests_culled_s,solve_s" : "");
    for (int f = 0; f < x->nframes; f++)
        for (int m = 0; m < COMPARE_METHODS; m++)
            if (is_run(x, m)) put_row(&x->row[m][f], compare_name((CompareMethod)m), times, out);
}

/* Figure 7: tests (a) or milliseconds in them (b) over the frames. Nothing is tested more or less
   for want of a local deformation, so `global` would only cover `adaptive`. */
static bool draw(const Experiment *x, const char *path, bool times, Error *e) {
    static const PlotStyle style[COMPARE_METHODS] = {PLOT_SOLID, PLOT_DASHED, PLOT_DASHED, PLOT_DOTTED};
    PlotSeries series[COMPARE_METHODS];
    Plot plot = {.x_label = "frame", .y_label = times ? "time in tests (ms)" : "intersection tests", .series = series};
    for (int m = 0; m < COMPARE_METHODS; m++) {
        if (!is_run(x, m) || m == COMPARE_GLOBAL) continue;
        double *at = ARENA_NEW(x->arena, double, x->nframes, e), *value = ARENA_NEW(x->arena, double, x->nframes, e);
        if (!at || !value) return false;
        for (int f = 0; f < x->nframes; f++) {
            at[f] = x->row[m][f].frame;
            value[f] = times ? 1000 * x->row[m][f].plain_s : (double)x->row[m][f].stats.tests;
        }
        series[plot.nseries++] = (PlotSeries){compare_name((CompareMethod)m), style[m], x->nframes, at, value};
    }
    return plot_lines(path, &plot, 1, e);
}

/* Every file of an earlier run goes, also the one that this run does not make. */
static bool clear(const char *path, bool force, Error *e) {
    if (access(path, F_OK) != 0) return true;
    if (!force) return error_set(e, ERR_OUTPUT, "'%s' is there from an earlier run; --force replaces it", path);
    return unlink(path) == 0 || error_set(e, ERR_OUTPUT, "cannot remove '%s': %s", path, strerror(errno));
}

/* Paths are made, and looked at, before anything is computed. */
typedef enum { FILE_TABLE, FILE_TESTS, FILE_TIMES, FILES } File;
static bool prepare_files(const Experiment *x, const char *folder, char path[FILES][OUTPUT_PATH_MAX], Error *e) {
    static const char *const names[FILES] = {"compare.csv", "tests.svg", "times.svg"};
    for (int f = 0; f < FILES; f++)
        if (snprintf(path[f], OUTPUT_PATH_MAX, "%s/%s", folder, names[f]) >= OUTPUT_PATH_MAX)
            return error_set(e, ERR_OUTPUT, "the name of the folder is too long: '%.80s...'", folder);
    if (!output_folder(folder, e)) return false;
    for (int f = 0; f < FILES; f++)
        if (!clear(path[f], x->settings->force, e)) return false;
    return true;
}

/* The table is opened first: where it cannot be written nobody should wait for it. */
static bool run(Experiment *x, const Input *input, const char *folder, Notes *notes, Error *e) {
    char path[FILES][OUTPUT_PATH_MAX];
    Output table;
    if (!open_all(x, input, notes, e) || !prepare_files(x, folder, path, e) ||
        !output_open(&table, path[FILE_TABLE], e))
        return false;
    for (int r = 0; r < compare_runs(x->settings); r++)
        if (!dress_frames(x, r, notes, e)) return output_abandon(&table), false;
    put_table(x, table.file);
    if (!output_close(&table, e)) return false;
    if (x->sum[COMPARE_ADAPTIVE].contact_frames == 0) return true;
    return draw(x, path[FILE_TESTS], false, e) && (x->settings->no_times || draw(x, path[FILE_TIMES], true, e));
}

void compare_run(const Wardrobe *wardrobe, int g, const Input *input, const char *folder, Arena *arena, ObjWriter *obj,
                 Notes *notes, ComparePair *out) {
    const Settings *s = wardrobe->settings;
    Experiment *x = ARENA_NEW(arena, Experiment, 1, &out->error);
    if (!x) return;
    x->wardrobe = *wardrobe;
    x->wardrobe.garment = &wardrobe->garment[g];
    x->wardrobe.ngarments = 1;
    x->settings = s;
    x->arena = arena;
    x->obj = obj;
    x->methods = compare_methods(s);
    x->sum = out->sum;
    run(x, input, folder, notes, &out->error);
    take_close(x->take);
    wearer_close(&x->wearer);
}
