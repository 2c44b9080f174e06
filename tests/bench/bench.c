/* make bench: how fast is it, and against what. Prints a table and writes it as CSV.
     bench FILE.csv [BASE.csv]
   With BASE, the CSV of an earlier run, each row also says how its time has changed since. */
#include "bench.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"

enum { REPEATS = 11, REPEATS_MAX = 201, ROWS_MAX = 128, NAME_MAX_LENGTH = 80 };
/* Seconds: what takes less is done more than once within one measurement; measurements are repeated
   for so long, for others may be busy on the same machine. */
static const double SHORT = 0.001, ENOUGH = 0.4;

struct Bench {
    FILE *csv;
    char folder[64];
    int nbase;
    struct { char name[NAME_MAX_LENGTH]; double ms; } base[ROWS_MAX];
};

void bench_need(bool good, const Error *e) {
    if (good) return;
    error_print(e, stderr);
    exit(1);
}

const char *bench_folder(const Bench *b) { return b->folder; }

static int by_size(const void *a, const void *b) {
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

static double seconds_of(void (*run)(void *context), void *context, int times) {
    double start = clock_seconds();
    for (int k = 0; k < times; k++) run(context);
    return (clock_seconds() - start) / times;
}

Timing bench_time(void (*run)(void *context), void *context) {
    double seconds[REPEATS_MAX], first = seconds_of(run, context, 1), end = clock_seconds() + ENOUGH;
    int times = first < SHORT ? (int)(SHORT / (first + 1e-7)) + 1 : 1, n = 0;
    while (n < REPEATS || (n < REPEATS_MAX && clock_seconds() < end)) seconds[n++] = seconds_of(run, context, times);
    qsort(seconds, (size_t)n, sizeof seconds[0], by_size);
    return (Timing){seconds[0], seconds[n / 2]};
}

/* Milliseconds of the same row in the earlier run; 0 where it has none. */
static double base_of(const Bench *b, const char *name) {
    for (int k = 0; k < b->nbase; k++)
        if (strcmp(b->base[k].name, name) == 0) return b->base[k].ms;
    return 0;
}

void bench_enter(Bench *b, BenchRow r) {
    char name[NAME_MAX_LENGTH], count[40], ratio[48] = "", change[32] = "";
    snprintf(name, sizeof name, "%s,%s", r.scene, r.what);
    snprintf(count, sizeof count, "%lld %s", r.count, r.unit);
    double times = r.against ? r.base.least / r.time.least : 0, before = base_of(b, name);
    if (r.against) snprintf(ratio, sizeof ratio, "%.4g", times);
    if (before > 0) snprintf(change, sizeof change, "%+.0f %%", 100 * (1e3 * r.time.least / before - 1));
    printf("%-10s %-26s %22s %10.4f %10.4f %8s ", r.scene, r.what, count, 1e3 * r.time.least, 1e3 * r.time.median,
           ratio);
    if (r.asked > 0) printf("%5.4g%s ", r.asked, times < r.asked ? "!" : " ");
    else printf("%6s ", "");
    printf("%-22s %s\n", r.against ? r.against : "", change);
    fflush(stdout);
    fprintf(b->csv, "%s,%lld,%s,%.6f,%.6f,%s,%.6f,%s,%.4g\n", name, r.count, r.unit, 1e3 * r.time.least,
            1e3 * r.time.median, r.against ? r.against : "", 1e3 * r.base.least, ratio, r.asked);
}

void bench_note(Bench *b, const char *scene, const char *what, const char *how, double value) {
    printf("%-10s %-26s %22s %10.4g\n", scene, what, how, value);
    fprintf(b->csv, "%s,%s,,%s,,,,,%.4g,\n", scene, what, how, value);
}

double bench_exponent(const double *size, const double *seconds, int n) {
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (int k = 0; k < n; k++) {
        double x = log(size[k]), y = log(seconds[k]);
        sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/* Rows of an earlier CSV: scene,what,count,unit,least_ms,... */
static void read_base(Bench *b, const char *path) {
    FILE *f = fopen(path, "r");
    char line[512], scene[40], what[40];
    if (!f) {
        fprintf(stderr, "bench: cannot open '%s'\n", path);
        exit(1);
    }
    while (b->nbase < ROWS_MAX && fgets(line, sizeof line, f)) {
        double ms;
        if (sscanf(line, "%39[^,],%39[^,],%*[^,],%*[^,],%lf", scene, what, &ms) != 3) continue;
        snprintf(b->base[b->nbase].name, NAME_MAX_LENGTH, "%s,%s", scene, what);
        b->base[b->nbase++].ms = ms;
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
    if (argc < 2 || !(b.csv = fopen(argv[1], "w"))) {
        fprintf(stderr, "usage: bench FILE.csv [BASE.csv]\n");
        return 2;
    }
    if (argc > 2) read_base(&b, argv[2]);
    /* In memory where that can be: no disk is to be measured. */
    snprintf(b.folder, sizeof b.folder, "%s/kitsuke-bench.XXXXXX", access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp");
    if (!mkdtemp(b.folder)) return 1;
    put_machine(stdout);
    put_machine(b.csv);
    printf("%-10s %-26s %22s %10s %10s %8s %6s %-22s %s\n", "scene", "what", "count", "least ms", "median ms", "ratio",
           "asked", "against", argc > 2 ? "change" : "");
    fprintf(b.csv, "scene,what,count,unit,least_ms,median_ms,against,against_ms,ratio,asked\n");
    bench_crossing(&b);
    bench_evaluation(&b);
    bench_writers(&b);
    bench_frames(&b);
    bench_program(&b);
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", b.folder);
    return fclose(b.csv) != 0 || system(command) != 0;
}
