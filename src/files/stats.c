/* CSV tables from a table of columns: name, unit, meaning, and where the value stands in the
   row. Head, rows and documentation are all read off it, so they cannot drift apart. A new
   column goes to the end of its table, for others read these files by position. */
#include "files/stats.h"

#include <assert.h>
#include <stddef.h>

#include "files/csv.h"

typedef enum { KIND_INT, KIND_LONG, KIND_FLAG, KIND_REAL, KIND_SECONDS, KIND_TEXT, KIND_SPLIT, KIND_METHOD } Kind;

/* kind SECONDS is measured time, which `times` may leave out. */
typedef struct {
    const char *name, *unit;
    Kind kind;
    size_t at; /* offset in the row */
    const char *about;
} Column;

#define AT(field) offsetof(StatsRow, field)
static const Column frame_columns[] = {
    {"frame", "", KIND_INT, AT(frame), "frame number, from 1 as in the source"},
    {"time", "s", KIND_REAL, AT(time), "time in the motion"},
    {"garment", "", KIND_TEXT, AT(garment), "name of the garment"},
    {"split", "", KIND_SPLIT, AT(split), "rule of splitting: adaptive, uniform or none"},
    {"nodes", "", KIND_INT, AT(stats.nodes), "patches that the classification by the paper's rule looked at"},
    {"leaves", "", KIND_INT, AT(stats.leaves), "patches that it did not split"},
    {"depth", "", KIND_INT, AT(stats.depth), "levels of splitting that it used"},
    {"cells", "", KIND_INT, AT(stats.cells), "leaves after the solver refined further"},
    {"vertices", "", KIND_INT, AT(stats.vertices), "of the written mesh"},
    {"triangles", "", KIND_INT, AT(stats.triangles), "of the written mesh"},
    {"pairs_all", "", KIND_LONG, AT(stats.pairs_all), "edge-triangle pairs that tests of all pairs would need"},
    {"pairs_tested", "", KIND_LONG, AT(stats.pairs_tested), "pairs that culling left to be tested"},
    {"hits_before", "", KIND_INT, AT(stats.hits_before), "body edges through the garment before the local deformation"},
    {"sweeps", "", KIND_INT, AT(stats.sweeps), "sweeps of the local deformation"},
    {"active", "", KIND_INT, AT(stats.active), "vertices that it may move"},
    {"displacement", "m", KIND_REAL, AT(stats.displacement), "largest move from the global to the final shape"},
    {"residual_edges", "", KIND_INT, AT(stats.residual_edges),
     "body edges through the written garment, of parts that it is worn over (`collide` in its file)"},
    {"residual_cloth", "", KIND_INT, AT(stats.residual_cloth), "garment edges through the body, likewise"},
    {"inside", "", KIND_INT, AT(stats.inside), "garment vertices inside such parts, once for each part"},
    {"deepest", "m", KIND_REAL, AT(stats.deepest), "depth of the deepest of them"},
    {"limb_edges", "", KIND_INT, AT(stats.limb_edges),
     "body edges through it, of all other parts: arms that come from outside"},
    {"limb_cloth", "", KIND_INT, AT(stats.limb_cloth), "garment edges through these parts"},
    {"limb_inside", "", KIND_INT, AT(stats.limb_inside), "garment vertices inside these parts"},
    {"pinched", "", KIND_INT, AT(stats.pinched), "vertices for which there is no room, or none that cloth could reach"},
    {"capped", "", KIND_FLAG, AT(stats.capped), "1: a cap of sweeps, rounds or displacement was reached"},
    {"restarted", "", KIND_FLAG, AT(stats.restarted),
     "1: the shape of the frame before was forgotten, the motion jumps"},
    {"method", "", KIND_METHOD, AT(method), "local deformation: push, paper or global (none)"},
    {"tests", "", KIND_LONG, AT(stats.tests), "edge-triangle pairs of the classification, all, as the paper counts"},
    {"tests_culled", "", KIND_LONG, AT(stats.tests_culled), "those of them that culling left to be tested"},
    {"pose_s", "s", KIND_SECONDS, AT(pose_s), "posing the body, shared by all garments"},
    {"global_s", "s", KIND_SECONDS, AT(stats.global_s), "global deformation"},
    {"test_s", "s", KIND_SECONDS, AT(stats.test_s), "intersection tests"},
    {"push_s", "s", KIND_SECONDS, AT(stats.push_s), "local deformation"},
    {"mesh_s", "s", KIND_SECONDS, AT(stats.mesh_s), "making the mesh"},
    {"write_s", "s", KIND_SECONDS, AT(write_s), "writing it"},
    {"arm_turn", "deg", KIND_REAL, AT(arm_turn), "the most by which `--relax-arms` turned a joint of an arm, up to 40"},
};
#undef AT

#define AT(field) offsetof(SummaryRow, field)
static const Column summary_columns[] = {
    {"motion", "", KIND_TEXT, AT(motion), "name of the motion, its folder in the output"},
    {"garment", "", KIND_TEXT, AT(garment), "name of the garment"},
    {"status", "", KIND_TEXT, AT(status), "ok, failed or refused"},
    {"frames", "", KIND_INT, AT(frames), "frames that were dressed"},
    {"residual_frames", "", KIND_INT, AT(residual_frames), "frames with any residual or inside vertex"},
    {"residual_edges", "", KIND_LONG, AT(residual_edges), "sum over the frames"},
    {"residual_cloth", "", KIND_LONG, AT(residual_cloth), "sum over the frames"},
    {"inside", "", KIND_LONG, AT(inside), "sum over the frames"},
    {"deepest", "m", KIND_REAL, AT(deepest), "of all frames"},
    {"limb_frames", "", KIND_INT, AT(limb_frames), "frames where any other part shows (`limb_*`)"},
    {"pinched_frames", "", KIND_INT, AT(pinched_frames), "frames with pinched vertices"},
    {"capped_frames", "", KIND_INT, AT(capped_frames), "frames that reached a cap"},
    {"max_displacement", "m", KIND_REAL, AT(max_displacement), "of all frames"},
    {"mean_nodes", "", KIND_REAL, AT(mean_nodes), "nodes of a frame, mean"},
    {"max_nodes", "", KIND_INT, AT(max_nodes), "nodes of a frame, maximum"},
    {"pairs_all", "", KIND_LONG, AT(pairs_all), "sum over the frames"},
    {"pairs_tested", "", KIND_LONG, AT(pairs_tested), "sum over the frames"},
    {"bytes", "", KIND_LONG, AT(bytes), "written for this garment"},
    {"seconds", "s", KIND_SECONDS, AT(seconds), "time that this motion and garment took"},
    {"reason", "", KIND_TEXT, AT(reason), "why it failed or was refused"},
    {"max_arm_turn", "deg", KIND_REAL, AT(arm_turn), "of all frames"},
};
#undef AT

#define COUNT_OF(array) (sizeof(array) / sizeof *(array))
static const struct {
    const Column *column;
    size_t n;
    const char *title;
} tables[] = {
    [TABLE_STATS] = {frame_columns, COUNT_OF(frame_columns), "a row for each frame and garment"},
    [TABLE_SUMMARY] = {summary_columns, COUNT_OF(summary_columns), "a row for each motion and garment"},
};

bool stats_has_residual(const FrameStats *s) { return s->residual_edges > 0 || s->residual_cloth > 0 || s->inside > 0; }
bool stats_has_limb(const FrameStats *s) { return s->limb_edges > 0 || s->limb_cloth > 0 || s->limb_inside > 0; }

void summary_add(SummaryRow *sum, const StatsRow *row) {
    const FrameStats *s = &row->stats;
    sum->frames++;
    sum->residual_frames += stats_has_residual(s);
    sum->limb_frames += stats_has_limb(s);
    sum->pinched_frames += s->pinched > 0;
    sum->capped_frames += s->capped;
    sum->residual_edges += s->residual_edges;
    sum->residual_cloth += s->residual_cloth;
    sum->inside += s->inside;
    sum->deepest = larger(sum->deepest, s->deepest);
    sum->arm_turn = larger(sum->arm_turn, row->arm_turn);
    sum->max_displacement = larger(sum->max_displacement, s->displacement);
    sum->nodes += s->nodes;
    sum->mean_nodes = (double)sum->nodes / sum->frames;
    if (s->nodes > sum->max_nodes) sum->max_nodes = s->nodes;
    sum->pairs_all += s->pairs_all;
    sum->pairs_tested += s->pairs_tested;
}

/* Numbers that are none print alike on every system. */
static void put_real(double x, FILE *out) {
    if (x != x) fputs("nan", out);
    else fprintf(out, "%.6f", x);
}

static void put_cell(const Column *c, const void *row, FILE *out) {
    static const char *const rules[] = {
        [SPLIT_ADAPTIVE] = "adaptive", [SPLIT_UNIFORM] = "uniform", [SPLIT_NONE] = "none"};
    static const char *const methods[] = {[METHOD_PUSH] = "push", [METHOD_PAPER] = "paper", [METHOD_GLOBAL] = "global"};
    const void *at = (const char *)row + c->at;
    switch (c->kind) {
    case KIND_INT: fprintf(out, "%d", *(const int *)at); break;
    case KIND_LONG: fprintf(out, "%lld", *(const long long *)at); break;
    case KIND_FLAG: fputc(*(const bool *)at ? '1' : '0', out); break;
    case KIND_REAL:
    case KIND_SECONDS: put_real(*(const double *)at, out); break;
    case KIND_TEXT: csv_text(*(const char *const *)at, out); break;
    case KIND_SPLIT: fputs(rules[*(const SplitRule *)at], out); break;
    case KIND_METHOD: fputs(methods[*(const Method *)at], out); break;
    }
}

/* row NULL: the names of the columns. */
static bool put_row(StatsFile *f, const void *row, Error *e) {
    const char *separator = "";
    for (size_t i = 0; i < tables[f->table].n; i++) {
        const Column *c = &tables[f->table].column[i];
        if (c->kind == KIND_SECONDS && !f->times) continue;
        fputs(separator, f->out.file);
        if (row) put_cell(c, row, f->out.file);
        else fputs(c->name, f->out.file);
        separator = ",";
    }
    fputc('\n', f->out.file);
    return output_good(&f->out, e);
}

static void put_units(const StatsFile *f) {
    fprintf(f->out.file, "# kitsuke %s: %s\n# units:", f->table == TABLE_STATS ? "stats" : "summary",
            tables[f->table].title);
    for (size_t i = 0; i < tables[f->table].n; i++) {
        const Column *c = &tables[f->table].column[i];
        if (c->unit[0] && (c->kind != KIND_SECONDS || f->times)) fprintf(f->out.file, " %s %s;", c->name, c->unit);
    }
    fputs(" all other numbers are counts or flags\n", f->out.file);
}

bool stats_open(StatsFile *f, const char *path, StatsTable table, bool times, Error *e) {
    f->table = table;
    f->times = times;
    if (!output_open(&f->out, path, e)) return false;
    put_units(f);
    if (put_row(f, NULL, e)) return true;
    stats_abandon(f);
    return false;
}

bool stats_add(StatsFile *f, const StatsRow *row, Error *e) {
    assert(f->table == TABLE_STATS);
    return put_row(f, row, e);
}

bool stats_add_summary(StatsFile *f, const SummaryRow *row, Error *e) {
    assert(f->table == TABLE_SUMMARY);
    return put_row(f, row, e);
}

bool stats_add_text(StatsFile *f, const char *lines, Error *e) {
    fputs(lines, f->out.file);
    return output_good(&f->out, e);
}

bool stats_close(StatsFile *f, Error *e) { return output_close(&f->out, e); }

void stats_abandon(StatsFile *f) { output_abandon(&f->out); }

void stats_describe(StatsTable table, FILE *out) {
    fputs("| column | unit | meaning |\n|---|---|---|\n", out);
    for (size_t i = 0; i < tables[table].n; i++) {
        const Column *c = &tables[table].column[i];
        fprintf(out, "| `%s` | %s | %s |\n", c->name, c->unit, c->about);
    }
}
