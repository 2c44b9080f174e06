/* The program as it is used: whole jobs with their files, on one thread and on two. */
#include <stdlib.h>
#include <string.h>

#include "bench.h"

typedef struct { char command[1024]; } Run;

static void run(void *context) {
    const Run *r = context;
    if (system(r->command) < 0) bench_need(false, &(Error){.text = "no shell"}); /* a motion may be refused */
}

/* kitsuke dress INPUT OPTIONS, into a folder in memory. */
static Run dress(const Bench *b, const char *input, const char *options) {
    const char *program = getenv("KITSUKE");
    Run r;
    snprintf(r.command, sizeof r.command, "'%s' dress '%s' %s -o %s/out --force --quiet 2>%s/said",
             program ? program : "build/kitsuke", input, options, bench_folder(b), bench_folder(b));
    return r;
}

static Timing time_of(Run r) { return bench_time(run, &r); }

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

static void whole_job(Bench *b, const char *scene, const char *garments) {
    char options[512];
    Timing time[3];
    static const char *const how[] = {"-j1", "-j2", "-j1 --format none"};
    for (int k = 0; k < 3; k++) {
        snprintf(options, sizeof options, "%s %s", garments, how[k]);
        time[k] = time_of(dress(b, "motions/paper-walk.bvh", options));
    }
    long long n = garment_frames(b);
    bench_enter(b, (BenchRow){scene, "job on two threads", n, "garment frames", time[1], "on one", time[0], 1.85});
    bench_enter(b, (BenchRow){scene, "job without files", n, "garment frames", time[2], "with OBJ and Draco", time[0],
                              3});
}

/* Motion capture, as far as it is at hand: a thousand garment frames a second on two threads? */
static void real_motions(Bench *b) {
    const char *folder = getenv("KITSUKE_MOTIONS") ? getenv("KITSUKE_MOTIONS") : "../shared/motions";
    Run look;
    snprintf(look.command, sizeof look.command, "test -d '%s'", folder);
    if (system(look.command) != 0) return;
    Timing time = time_of(dress(b, folder, "-g garments/skirt.garment -g garments/trousers.garment "
                                           "-g garments/tshirt.garment --format none --frames 1:30 -j2"));
    long long n = garment_frames(b);
    double wanted = (double)n / 1000;
    bench_enter(b, (BenchRow){"wardrobe", "motion capture", n, "garment frames", time, "1000 a second",
                              {wanted, wanted}, 1});
}

void bench_program(Bench *b) {
    whole_job(b, "skirt", "-g garments/skirt.garment");
    whole_job(b, "wardrobe", "-g garments/skirt.garment -g garments/trousers.garment -g garments/tshirt.garment");
    real_motions(b);
}
