/* make bench: how fast is it, and against what. Prints a table and writes it as CSV.
     bench FILE.csv [BASE.csv]
   With BASE, the CSV of an earlier run, each row also says how its time has changed since. */
#include "bench.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/sort.h"

enum { REPEATS_LEAST = 3, REPEATS = 11, REPEATS_MAX = 201, ROWS_MAX = 128, NAME_MAX_LENGTH = 80 };
/* Seconds: what takes less is done more than once within one measurement; measurements are repeated
   for so long, for others may be busy on the same machine; and REPEATS times, unless that takes longer. */
static const double SHORT = 0.001, ENOUGH = 0.4, PATIENCE = 30;

/* A row of the earlier run. ratio: "" where it has none. */
typedef struct { char name[NAME_MAX_LENGTH], ratio[16]; double ms; } BaseRow;

struct Bench {
    FILE *csv;
    char folder[64];
    int nbase;
    BaseRow base[ROWS_MAX];
};

void bench_need(bool good, const Error *e) {
    if (good) return;
    error_print(e, stderr);
    exit(1);
}

const char *bench_folder(const Bench *b) { return b->folder; }

static double seconds_of(void (*run)(void *context), void *context, int times) {
    double start = clock_seconds();
    for (int k = 0; k < times; k++) run(context);
    return (clock_seconds() - start) / times;
}

static void nothing(void *context) { (void)context; }

Timing bench_time(void (*run)(void *context), void *context) { return bench_time_after(nothing, run, context); }

Timing bench_time_after(void (*before)(void *context), void (*run)(void *context), void *context) {
    double seconds[REPEATS_MAX], start = clock_seconds();
    before(context);
    double first = seconds_of(run, context, 1), begun = clock_seconds();
    int times = first < SHORT && before == nothing ? (int)(SHORT / (first + 1e-7)) + 1 : 1, n = 0;
    while ((n < REPEATS && clock_seconds() < start + PATIENCE) || n < REPEATS_LEAST ||
           (n < REPEATS_MAX && clock_seconds() < begun + ENOUGH)) {
        before(context);
        seconds[n++] = seconds_of(run, context, times);
    }
    sort_numbers(seconds, n);
    return (Timing){seconds[0], seconds[n / 2]};
}

/* How the time of a row has changed, and what its ratio was; nothing where the earlier run has no such row. */
static void put_change(const Bench *b, const char *name, double ms, char *out, size_t n) {
    out[0] = 0;
    for (int k = 0; k < b->nbase; k++) {
        const BaseRow *base = &b->base[k];
        if (strcmp(base->name, name) != 0) continue;
        int used = snprintf(out, n, "%+.0f %%", 100 * (ms / base->ms - 1));
        if (base->ratio[0]) snprintf(out + used, n - (size_t)used, ", was %s", base->ratio);
    }
}

/* A time with its unit, in `n` bytes. */
static void put_time(char *out, size_t n, double seconds) {
    static const char *const unit[] = {"s", "ms", "us", "ns", "ps"};
    int k = 0;
    for (; seconds < 0.9995 && k < 4; k++) seconds *= 1000;
    snprintf(out, n, "%.3g %s", seconds, unit[k]);
}

void bench_enter(Bench *b, BenchRow r) {
    char name[NAME_MAX_LENGTH], count[40], each[24], ratio[48] = "", change[40];
    snprintf(name, sizeof name, "%s,%s", r.scene, r.what);
    snprintf(count, sizeof count, "%lld %s", r.count, r.unit);
    put_time(each, sizeof each, r.time.least / (double)(r.count > 0 ? r.count : 1));
    put_change(b, name, 1e3 * r.time.least, change, sizeof change);
    double times = r.against ? r.base.least / r.time.least : 0;
    if (r.against) snprintf(ratio, sizeof ratio, "%.4g", times);
    printf("%-10s %-24s %22s %10.4f %10.4f %9s %8s ", r.scene, r.what, count, 1e3 * r.time.least, 1e3 * r.time.median,
           each, ratio);
    if (r.asked > 0) printf("%5.4g%s ", r.asked, times < r.asked ? "!" : " ");
    else printf("%6s ", "");
    printf("%-22s %s\n", r.against ? r.against : "", change);
    fflush(stdout);
    fprintf(b->csv, "%s,%lld,%s,%.6f,%.6f,%s,%.6f,%s,%.4g\n", name, r.count, r.unit, 1e3 * r.time.least,
            1e3 * r.time.median, r.against ? r.against : "", 1e3 * r.base.least, ratio, r.asked);
}

void bench_note(Bench *b, const char *scene, const char *what, const char *how, double value, double most) {
    char limit[24] = "";
    if (most > 0) snprintf(limit, sizeof limit, "%5.3g%s", most, value > most ? "!" : "");
    printf("%-10s %-24s %22s %10s %10s %9s %8.3g %s\n", scene, what, how, "", "", "", value, limit);
    fflush(stdout);
    fprintf(b->csv, "%s,%s,,%s,,,,,%.4g,%.4g\n", scene, what, how, value, most);
}

void bench_add(BenchSeries *s, double size, double seconds) {
    if (s->n == SERIES_MAX) return;
    s->size[s->n] = size;
    s->seconds[s->n++] = seconds;
}

double bench_exponent(const BenchSeries *s) {
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (int k = 0; k < s->n; k++) {
        double x = log(s->size[k]), y = log(s->seconds[k]);
        sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    return (s->n * sxy - sx * sy) / (s->n * sxx - sx * sx);
}

void bench_series(Bench *b, const BenchSeries *s) {
    char each[24];
    printf("%-10s %-24s", "growth", s->what);
    for (int k = 0; k < s->n; k++) {
        put_time(each, sizeof each, s->seconds[k] / s->size[k]);
        printf("%s %.0f: %s", k ? "," : "", s->size[k], each);
        fprintf(b->csv, "growth,%s %.0f,%.0f,%s,%.6f,,,,,\n", s->what, s->size[k], s->size[k], s->unit,
                1e3 * s->seconds[k]);
    }
    printf(" each of %s\n", s->unit);
    bench_note(b, "growth", s->what, "exponent", bench_exponent(s), s->most);
}

/* Field k of a line of CSV, which holds no quotes. */
static void take_field(const char *line, int k, char *out, size_t n) {
    for (; k > 0 && line; k--) line = strchr(line, ',') ? strchr(line, ',') + 1 : NULL;
    snprintf(out, n, "%.*s", line ? (int)strcspn(line, ",\n") : 0, line ? line : "");
}

/* The rows of an earlier CSV that have a time. What it says of its machine is repeated. */
static void read_base(Bench *b, const char *path) {
    FILE *f = fopen(path, "r");
    char line[1024], scene[40], what[40], ms[24];
    if (!f) {
        fprintf(stderr, "bench: cannot open '%s'\n", path);
        exit(1);
    }
    printf("# compared with %s:\n", path);
    while (b->nbase < ROWS_MAX && fgets(line, sizeof line, f)) {
        BaseRow *row = &b->base[b->nbase];
        if (line[0] == '#') printf("#   %s", line + 1);
        take_field(line, 0, scene, sizeof scene);
        take_field(line, 1, what, sizeof what);
        take_field(line, 4, ms, sizeof ms);
        take_field(line, 8, row->ratio, sizeof row->ratio);
        snprintf(row->name, sizeof row->name, "%s,%s", scene, what);
        row->ms = atof(ms);
        b->nbase += line[0] != '#' && row->ms > 0;
    }
    fclose(f);
}

static void put_machine(FILE *out) {
    char line[256], *colon;
    FILE *f = fopen("/proc/cpuinfo", "r");
    while (f && fgets(line, sizeof line, f))
        if (strncmp(line, "model name", 10) == 0 && (colon = strchr(line, ':'))) {
            fprintf(out, "# machine:%s", colon + 1);
            break;
        }
    if (f) fclose(f);
    fprintf(out, "# processors: %ld\n# compiler: %s\n# flags: %s\n", sysconf(_SC_NPROCESSORS_ONLN), __VERSION__,
            BENCH_FLAGS);
}

int main(int argc, char **argv) {
    static Bench b;
    if (argc > 2) read_base(&b, argv[2]); /* before it is written over, should both be one file */
    if (argc < 2 || !(b.csv = fopen(argv[1], "w"))) {
        fprintf(stderr, "usage: bench FILE.csv [BASE.csv]\n");
        return 2;
    }
    /* In memory where that can be: no disk is to be measured. */
    snprintf(b.folder, sizeof b.folder, "%s/kitsuke-bench.XXXXXX", access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp");
    if (!mkdtemp(b.folder)) return 1;
    put_machine(stdout);
    put_machine(b.csv);
    printf("%-10s %-24s %22s %10s %10s %9s %8s %6s %-22s %s\n", "scene", "what", "count", "least ms", "median ms",
           "each", "ratio", "asked", "against", argc > 2 ? "change of time" : "");
    fprintf(b.csv, "scene,what,count,unit,least_ms,median_ms,against,against_ms,ratio,asked\n");
    bench_crossing(&b);
    bench_evaluation(&b);
    bench_writers(&b);
    bench_frames(&b);
    bench_program(&b);
    printf("ratio: how many times as fast as what stands under 'against', or the share or exponent itself\n"
           "asked: at least this ratio, at most this share or exponent; '!': not reached\n");
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", b.folder);
    return fclose(b.csv) != 0 || system(command) != 0;
}
