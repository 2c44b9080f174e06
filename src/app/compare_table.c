/* The tables of the experiment. A ratio is uniform : method, so more is better, and it is a ratio
   of sums over all frames, never a mean of ratios. */
#include "app/compare.h"

typedef struct {
    FILE *out;
    unsigned methods;
    int runs;      /* 0: no times */
} Table;

static double mean(long long sum, int n) { return n ? (double)sum / n : 0; }

/* "4.7", or a word where there is nothing to divide. */
static void put_ratio(const Table *t, double uniform, double here, const char *word) {
    if (here > 0) fprintf(t->out, " %.2f |", uniform / here);
    else fprintf(t->out, " %s |", word);
}

static double least(const Table *t, const double *seconds) {
    double best = seconds[0];
    for (int r = 1; r < t->runs; r++) best = seconds[r] < best ? seconds[r] : best;
    return best;
}

/* How much longer the slowest run took, in percent. */
static double spread(const Table *t, const double *seconds) {
    double best = least(t, seconds), worst = best;
    for (int r = 0; r < t->runs; r++) worst = seconds[r] > worst ? seconds[r] : worst;
    return best > 0 ? 100 * (worst / best - 1) : 0;
}

/* What a method does, beside what uniform does. */
typedef void Cells(const Table *t, CompareMethod method, const CompareSum *uniform, const CompareSum *here);

static void test_cells(const Table *t, CompareMethod method, const CompareSum *u, const CompareSum *s) {
    bool same_code = method != COMPARE_PAPER; /* its tests are another loop with other signs */
    fprintf(t->out, " %d | %d | %.1f | %d | %.1f | %d | %.0f | %lld | %lld |", s->frames, s->contact_frames,
            mean(s->nodes, s->frames), s->nodes_max, mean(s->leaves, s->frames), s->leaves_max,
            mean(s->tests, s->frames), s->tests_max, s->tests);
    put_ratio(t, (double)u->tests, (double)s->tests, "no colliders");
    put_ratio(t, (double)u->tests_contact, (double)s->tests_contact, "no contact");
    if (!t->runs) return;
    fprintf(t->out, " %.3f | %.0f %% |", least(t, s->plain.all), spread(t, s->plain.all));
    put_ratio(t, least(t, u->plain.all), same_code ? least(t, s->plain.all) : 0, "-");
    put_ratio(t, least(t, u->plain.contact), same_code ? least(t, s->plain.contact) : 0,
              s->contact_frames ? "-" : "no contact");
}

static void saving_cells(const Table *t, CompareMethod method, const CompareSum *u, const CompareSum *s) {
    bool culls = method != COMPARE_PAPER;
    if (culls) fprintf(t->out, " %.0f |", mean(s->tests_culled, s->frames));
    else fputs(" - |", t->out);
    put_ratio(t, (double)u->tests_culled, culls ? (double)s->tests_culled : 0, "-");
    if (t->runs) {
        if (culls) fprintf(t->out, " %.4f |", least(t, s->culled.all));
        else fputs(" - |", t->out);
        put_ratio(t, least(t, u->culled.all), culls ? least(t, s->culled.all) : 0, "-");
        fprintf(t->out, " %.4f |", least(t, s->solve.all));
        put_ratio(t, least(t, u->solve.all), least(t, s->solve.all), "-");
    }
    fprintf(t->out, " %.0f |", mean(s->points, s->frames));
    put_ratio(t, (double)u->points, (double)s->points, "-");
    fprintf(t->out, " %.0f |", mean(s->bytes, s->frames));
    put_ratio(t, (double)u->bytes, (double)s->bytes, "-");
}

static void outcome_cells(const Table *t, CompareMethod method, const CompareSum *u, const CompareSum *s) {
    (void)method;
    (void)u;
    fprintf(t->out, " %d | %d | %.1f |", s->frames, s->residual_frames, 100 * s->displacement);
}

/* Columns whose title begins with '#' are measured times. */
static void put_head(const Table *t, const char *title, const char *const *column) {
    int n = 3;
    fprintf(t->out, "%s\n\n| motion | garment | method |", title);
    for (; *column; column++)
        if (**column != '#' || t->runs) {
            fprintf(t->out, " %s |", *column + (**column == '#'));
            n++;
        }
    fputs("\n|---|---|---|", t->out);
    while (--n > 2) fputs("---:|", t->out);
    fputc('\n', t->out);
}

static void put_rows(const Table *t, const char *motion, const char *garment, const CompareSum *sum, Cells *cells) {
    for (int m = 0; m < COMPARE_METHODS; m++) {
        if (!(t->methods >> m & 1)) continue;
        fprintf(t->out, "| %s | %s | %s |", motion, garment, compare_name((CompareMethod)m));
        cells(t, (CompareMethod)m, &sum[COMPARE_UNIFORM], &sum[m]);
        fputc('\n', t->out);
    }
}

static void put_table(const Table *t, const char *title, const char *const *column, const ComparePair *pair, int count,
                      Cells *cells) {
    CompareSum total[COMPARE_METHODS] = {{0}};
    put_head(t, title, column);
    for (int k = 0; k < count; k++) {
        if (pair[k].error.kind) continue;
        put_rows(t, pair[k].motion, pair[k].garment, pair[k].sum, cells);
        for (int m = 0; m < COMPARE_METHODS; m++) compare_add(&total[m], &pair[k].sum[m]);
    }
    if (count > 1) put_rows(t, "**total**", "", total, cells);
}

void compare_print(const ComparePair *pair, int count, const Settings *s, FILE *out) {
    static const char *const tests[] = {
        "frames", "in contact", "nodes, mean", "max", "leaves, mean", "max", "tests, mean", "max", "total",
        "uniform : this", "in contact", "#seconds", "#spread", "#uniform : this", "#in contact", NULL};
    static const char *const savings[] = {
        "tests, mean", "uniform : this", "#seconds", "#uniform : this", "#solve, seconds", "#uniform : this",
        "control points, mean", "uniform : this", "bytes, mean", "uniform : this", NULL};
    static const char *const outcome[] = {"frames", "residual frames", "largest move (cm)", NULL};
    Table t = {out, compare_methods(s), s->no_times ? 0 : compare_runs(s)};
    put_table(&t, "Tests without culling, as the paper counts", tests, pair, count, test_cells);
    put_table(&t, "\nTests with culling, and what fewer patches still save", savings, pair, count, saving_cells);
    put_table(&t, "\nWhat is left", outcome, pair, count, outcome_cells);
}
