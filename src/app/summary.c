/* The rows of the summary, for motions that were dressed and for those that were not. */
#include "app/summary.h"

#include <string.h>

bool summary_path(const Settings *s, char path[OUTPUT_PATH_MAX], Error *e) {
    int n = snprintf(path, OUTPUT_PATH_MAX, "%s/summary.csv", s->output);
    if (s->shard.n)
        n = snprintf(path, OUTPUT_PATH_MAX, "%s/summary.%d-of-%d.csv", s->output, s->shard.k, s->shard.n);
    return n < OUTPUT_PATH_MAX || error_set(e, ERR_OUTPUT, "the name of the output folder is too long");
}

bool summary_lock(const Settings *s, Lock *lock, Error *e) {
    char path[OUTPUT_PATH_MAX], name[OUTPUT_PATH_MAX + 8];
    if (!summary_path(s, path, e) || !output_folder(s->output, e)) return false;
    char *slash = strrchr(path, '/');
    *slash = 0;
    snprintf(name, sizeof name, "%s/.%s.lock", path, slash + 1);
    return lock_file(lock, name, e);
}

/* Why a motion was not dressed, with its place; empty where it was. */
static void give_reason(const Error *why, char *reason, size_t n) {
    reason[0] = 0;
    if (why->kind <= ERR_CHECK) return;
    if (why->line) snprintf(reason, n, "%s:%d:%d: %s", why->file, why->line, why->column, why->text);
    else snprintf(reason, n, "%s", why->text);
}

static const char *status_of(ErrorKind kind) {
    if (kind <= ERR_CHECK) return "ok";
    return kind == ERR_INPUT || kind == ERR_USAGE ? "refused" : "failed";
}

static bool add_motion(StatsFile *f, const Wardrobe *w, const Input *input, const JobResult *result, Error *e) {
    char reason[720];
    if (result->recorded) return stats_add_text(f, result->recorded, e);
    give_reason(&result->error, reason, sizeof reason);
    for (int g = 0; g < w->ngarments; g++) {
        SummaryRow row = result->row[g];
        row.motion = input->name;
        row.garment = w->garment[g]->name;
        row.status = status_of(result->error.kind);
        row.reason = reason[0] ? reason : NULL;
        if (!stats_add_summary(f, &row, e)) return false;
    }
    return true;
}

static bool add_shard(StatsFile *f, Shard shard, int total, Error *e) {
    char line[80];
    snprintf(line, sizeof line, SUMMARY_SHARD, shard.k, shard.n, total);
    return shard.n == 0 || stats_add_text(f, line, e);
}

bool summary_write(const Wardrobe *w, const Input *input, const JobResult *result, int count, int total, Error *e) {
    char path[OUTPUT_PATH_MAX];
    const Settings *s = w->settings;
    StatsFile f;
    if (!summary_path(s, path, e) || !stats_open(&f, path, TABLE_SUMMARY, !s->no_times, e)) return false;
    bool good = true;
    for (int i = 0; good && i < count; i++) good = add_motion(&f, w, &input[i], &result[i], e);
    if (!good || !add_shard(&f, s->shard, total, e)) return stats_abandon(&f), false;
    return stats_close(&f, e) && sync_folder(s->output, e);
}
