/* The rows of the summary, for motions that were dressed and for those that were not. */
#include "app/summary.h"

bool summary_path(const Settings *s, char path[OUTPUT_PATH_MAX], Error *e) {
    int n = snprintf(path, OUTPUT_PATH_MAX, "%s/summary.csv", s->output);
    if (s->shard.n)
        n = snprintf(path, OUTPUT_PATH_MAX, "%s/summary.%d-of-%d.csv", s->output, s->shard.k, s->shard.n);
    return n < OUTPUT_PATH_MAX || error_set(e, ERR_OUTPUT, "the name of the output folder is too long");
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

bool summary_end(StatsFile *f, const Settings *s, int total, Error *e) {
    char line[80];
    if (!s->shard.n) return true;
    snprintf(line, sizeof line, SHARD_LINE, s->shard.k, s->shard.n, total);
    return stats_add_text(f, line, e);
}

bool summary_add_motion(StatsFile *f, const Wardrobe *w, const Input *input, const JobResult *result, const char *rows,
                        Error *e) {
    char reason[720];
    if (rows) return stats_add_text(f, rows, e);
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
