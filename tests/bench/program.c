/* The program as it is used: whole jobs with their files, on one thread and on two. */
#include <stdlib.h>
#include <string.h>

#include "base/thread.h"
#include "bench.h"

typedef struct { char clear[160], command[1024]; } Run;

/* Removing what an earlier run has written can take as long as writing it. */
static void clear(void *context) {
    const Run *r = context;
    bench_need(system(r->clear) == 0, &(Error){.text = "cannot remove the files of a run"});
}

static void run(void *context) {
    const Run *r = context;
    if (system(r->command) < 0) bench_need(false, &(Error){.text = "no shell"}); /* a motion may be refused */
}

/* kitsuke dress INPUT OPTIONS, into a folder in memory. */
static Run dress(const Bench *b, const char *input, const char *options) {
    const char *program = getenv("KITSUKE");
    Run r;
    snprintf(r.clear, sizeof r.clear, "rm -rf '%s/out'", bench_folder(b));
    snprintf(r.command, sizeof r.command, "'%s' dress '%s' %s -o %s/out 2>%s/said",
             program ? program : "build/kitsuke", input, options, bench_folder(b), bench_folder(b));
    return r;
}

static Timing time_of(Run r) { return bench_time_after(clear, run, &r); }

/* How many rows the summary of the last run sums up: frames times garments. */
static long long garment_frames(const Bench *b) {
    char path[256], line[1024];
    long long sum = 0;
    snprintf(path, sizeof path, "%s/out/summary.csv", bench_folder(b));
    FILE *f = fopen(path, "r");
    while (f && fgets(line, sizeof line, f)) {
        const char *at = line;
        for (int k = 0; k < 3 && at; k++) at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL;
        if (line[0] != '#' && at) sum += atoll(at); /* the head's word counts nothing */
    }
    if (f) fclose(f);
    return sum;
}

static const char WALK[] = "motions/brisk-walk.bvh";
static const char SKIRT[] = "-g garments/skirt.garment";
static const char THREE[] = "-g garments/skirt.garment -g garments/trousers.garment -g garments/tshirt.garment";

static Timing time_walk(const Bench *b, const char *garments, const char *how) {
    char options[512];
    snprintf(options, sizeof options, "%s --frames 1:160 %s", garments, how);
    return time_of(dress(b, WALK, options));
}

/* One motion on 2, 4, 8... threads, up to as many as there are processors, and on one without files. */
static void whole_job(Bench *b, const char *scene, const char *garments) {
    BenchSeries s = {.n = 0};
    char how[32], what[32];
    int most = thread_count() > 2 ? thread_count() : 2;
    Timing one = time_walk(b, garments, "-j1");
    long long frames = garment_frames(b);
    bench_add(&s, 1, one.least);
    for (int n = 2; n <= most; n = n < most && 2 * n > most ? most : 2 * n) {
        snprintf(how, sizeof how, "-j%d", n);
        snprintf(what, sizeof what, "job on %d threads", n);
        Timing time = time_walk(b, garments, how);
        bench_add(&s, n, time.least);
        bench_enter(b, (BenchRow){scene, what, frames, "garment frames", time, "on one", one, n == 2 ? 1.85 : 0});
    }
    bench_note(b, scene, "job, by threads", thread_count() > 2 ? "exponent" : "exponent (2 processors)",
               bench_exponent(&s), 0);
    bench_enter(b, (BenchRow){scene, "job without files", frames, "garment frames",
                              time_walk(b, garments, "-j1 --format none"), "with OBJ and Draco", one, 0});
}

/* The share of the local deformation in a job that writes OBJ and Draco, from the table that --verbose prints. */
static void share_of_solving(Bench *b, const char *scene, const char *garments) {
    char options[512], path[256], line[256], stage[32];
    double share, solve = 0;
    snprintf(options, sizeof options, "%s --frames 1:160 -j1 --verbose", garments);
    Run r = dress(b, WALK, options);
    clear(&r);
    run(&r);
    snprintf(path, sizeof path, "%s/said", bench_folder(b));
    FILE *f = fopen(path, "r");
    while (f && fgets(line, sizeof line, f))
        if (sscanf(line, " %31s %*f s %lf %%", stage, &share) == 2 && strcmp(stage, "push") == 0) solve = share;
    if (f) fclose(f);
    bench_note(b, scene, "solving", "share of job in %", solve, 100.0 / 3);
}

/* Motion capture, as far as it is at hand: a thousand garment frames a second on two threads? */
static void real_motions(Bench *b) {
    const char *folder = getenv("KITSUKE_MOTIONS") ? getenv("KITSUKE_MOTIONS") : "../shared/motions";
    Run look;
    snprintf(look.command, sizeof look.command, "test -d '%s'", folder);
    if (system(look.command) != 0) return;
    char options[512];
    snprintf(options, sizeof options, "%s --format none --frames 1:30 -j2", THREE);
    Timing time = time_of(dress(b, folder, options));
    long long n = garment_frames(b);
    double wanted = (double)n / 1000;
    bench_enter(b, (BenchRow){"wardrobe", "motion capture", n, "garment frames", time, "1000 a second",
                              {wanted, wanted}, 1});
}

void bench_program(Bench *b) {
    whole_job(b, "skirt", SKIRT);
    share_of_solving(b, "skirt", SKIRT);
    whole_job(b, "wardrobe", THREE);
    share_of_solving(b, "wardrobe", THREE);
    real_motions(b);
}
