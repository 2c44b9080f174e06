/* One line that tells whether all went well, and a table of the stages for those who want to know. */
#include "app/report.h"

static void print_stages(const JobResult *result, int count, int workers, double seconds, FILE *out) {
    static const char *const names[STAGE_COUNT] = {"open and fit", "pose", "global shape", "test",
                                                   "push",         "mesh", "write",        "other"};
    double sum[STAGE_COUNT] = {0}, whole = 0;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < STAGE_COUNT; k++) sum[k] += result[i].seconds[k];
    for (int k = 0; k < STAGE_COUNT; k++) whole += sum[k];
    for (int k = 0; k < STAGE_COUNT; k++)
        fprintf(out, "  %-14s %9.3f s  %5.1f %%\n", names[k], sum[k], whole > 0 ? 100 * sum[k] / whole : 0);
    fprintf(out, "  %-14s %9.3f s  on %d thread%s in %.3f s\n", "together", whole, workers, workers == 1 ? "" : "s",
            seconds);
}

static void print_bytes(double bytes, FILE *out) {
    if (bytes >= 1e9) fprintf(out, "%.2f GB", bytes / 1e9);
    else if (bytes >= 1e6) fprintf(out, "%.1f MB", bytes / 1e6);
    else fprintf(out, "%.1f kB", bytes / 1e3);
}

void report_print(const Settings *s, const JobResult *result, int count, int workers, double seconds, FILE *out) {
    long long frames = 0, residual = 0, limb = 0, bytes = 0;
    int done = 0, before = 0;
    for (int i = 0; i < count; i++) {
        done += result[i].error.kind <= ERR_CHECK;
        before += result[i].recorded != NULL;
        frames += result[i].frames;
        residual += result[i].residual_frames;
        limb += result[i].limb_frames;
        bytes += result[i].bytes;
    }
    if (s->quiet) return;
    if (s->verbose) print_stages(result, count, workers, seconds, out);
    if (count == 1 && done + frames == 0) return; /* the error has said it all */
    fprintf(out, "%d of %d motion%s dressed", done, count, count == 1 ? "" : "s");
    if (before) fprintf(out, " (%d before)", before);
    if (frames) {
        fprintf(out, ", %lld frame%s, %lld with residuals, ", frames, frames == 1 ? "" : "s", residual);
        if (limb) fprintf(out, "%lld with limbs in the cloth, ", limb);
        print_bytes((double)bytes, out);
        fprintf(out, " in %.1f s (%.0f frames/s)", seconds, (double)frames / seconds);
    }
    fputc('\n', out);
}
