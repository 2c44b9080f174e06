/* Shards of one list dress every n-th motion each. Dealt out again in turn, their rows stand in the
   order of the list, and the joined summary is, byte for byte, the one of a single run. */
#include "app/summary.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "files/listing.h"

enum { SUMMARY_MAX = 1 << 30 };

/* A summary: head, rows by motion, and which shard it is. */
typedef struct {
    const char *path;
    Shard shard;           /* n 0: of no list */
    int total;             /* motions in the whole list */
    const char *head;
    size_t head_size;
    int count;             /* motions */
    const char **motion;   /* where the rows of each begin, and the end of the last */
    bool is_merged;
} Summary;

typedef struct { Summary *item; int count, capacity; Arena *arena; Error *e; } Merge;

static const char *line_end(const char *at) {
    const char *end = strchr(at, '\n');
    return end ? end + 1 : at + strlen(at);
}

/* Bytes of the first cell of a row; commas in quotes do not end it. */
static size_t first_cell(const char *row) {
    bool quoted = false;
    size_t n = 0;
    for (; row[n] && row[n] != '\n' && (quoted || row[n] != ','); n++) quoted ^= row[n] == '"';
    return n;
}

static bool starts_motion(const char *row, const char *before) {
    size_t n = first_cell(row);
    return !before || first_cell(before) != n || memcmp(row, before, n) != 0;
}

/* Counts the motions, and notes where they begin if there is room for it. */
static int split(const char *rows, const char **motion) {
    const char *before = NULL;
    int n = 0;
    for (; *rows && *rows != '#'; before = rows, rows = line_end(rows))
        if (starts_motion(rows, before) && n++ >= 0 && motion) motion[n - 1] = rows;
    if (motion) motion[n] = rows;
    return n;
}

static bool read_summary(Merge *m, const char *path, Summary *s) {
    Text text;
    *s = (Summary){.path = path};
    if (!text_read(path, SUMMARY_MAX, m->arena, &text, m->e)) return false;
    const char *rows = text.data, *last = text.data;
    while (*rows == '#') rows = line_end(rows);
    rows = line_end(rows);
    s->head = text.data;
    s->head_size = (size_t)(rows - text.data);
    s->count = split(rows, NULL);
    s->motion = ARENA_NEW(m->arena, const char *, s->count + 1, m->e);
    if (!s->motion) return false;
    split(rows, s->motion);
    last = s->motion[s->count];
    bool is_shard = sscanf(last, SUMMARY_SHARD, &s->shard.k, &s->shard.n, &s->total) == 3;
    if (strncmp(text.data, "# kitsuke summary", 17) != 0 || (*last && !is_shard))
        return error_set(m->e, ERR_INPUT, "'%s' is no summary of kitsuke", path);
    if (!is_shard) return true;
    int k = s->shard.k, n = s->shard.n, total = s->total;
    bool fits = 1 <= k && k <= n && n <= SHARDS_MAX && total >= 0 &&
                s->count == (total < k ? 0 : (total - k) / n + 1); /* of 0 .. total - 1 leave k - 1 when divided by n */
    return fits || error_set(m->e, ERR_INPUT, "'%s' holds %d motions, which do not fit its shard %d of %d of %d", path,
                             s->count, k, n, total);
}

static bool add(Merge *m, const char *path) {
    Summary *item = ARENA_GROW(m->arena, Summary, m->item, m->count, &m->capacity, m->e);
    if (!item) return false;
    m->item = item;
    return read_summary(m, path, &m->item[m->count++]);
}

static bool add_inside(Merge *m, const char *folder, const char *name) {
    const char *path = listing_path(folder, name, m->arena, m->e);
    return path && add(m, path);
}

static bool is_shard_name(const char *name) {
    char again[64];
    Shard p = {0, 0};
    if (strlen(name) > 40 || sscanf(name, "summary.%d-of-%d.csv", &p.k, &p.n) != 2) return false;
    snprintf(again, sizeof again, "summary.%d-of-%d.csv", p.k, p.n);
    return strcmp(name, again) == 0;
}

static int by_shard(const void *a, const void *b) {
    const Summary *x = a, *y = b;
    return x->shard.n != y->shard.n ? (x->shard.n > y->shard.n) - (x->shard.n < y->shard.n) : x->shard.k - y->shard.k;
}

/* The shards in a folder, or its summary.csv if there are none. A file is taken as it is. */
static bool add_folder(Merge *m, const char *path) {
    struct stat info;
    if (stat(path, &info) == 0 && S_ISREG(info.st_mode)) return add(m, path);
    Listing names;
    int before = m->count;
    if (!listing_read(path, m->arena, &names, m->e)) return false;
    for (int i = 0; i < names.count; i++)
        if (is_shard_name(names.name[i]) && !add_inside(m, path, names.name[i])) return false;
    if (m->count > before) qsort(m->item + before, (size_t)(m->count - before), sizeof *m->item, by_shard);
    return m->count > before || add_inside(m, path, "summary.csv");
}

/* All shards that belong to *first, in their order; NULL with an error. */
static Summary **gather(Merge *m, Summary *first) {
    int n = first->shard.n;
    Summary **shard = ARENA_NEW(m->arena, Summary *, n, m->e);
    for (Summary *s = m->item; shard && s < m->item + m->count; s++) {
        if (s->shard.n != n) continue;
        Summary **place = &shard[s->shard.k - 1];
        s->is_merged = true;
        if (*place || s->total != first->total)
            return error_set(m->e, ERR_INPUT, "'%s' and '%s' are shards of different lists, or the same one twice",
                             first->path, s->path), NULL;
        *place = s;
    }
    for (int k = 0; shard && k < n; k++)
        if (!shard[k]) return error_set(m->e, ERR_INPUT, "shard %d of %d is missing", k + 1, n), NULL;
    return shard;
}

static void write_motion(const Summary *s, int i, FILE *out) {
    fwrite(s->motion[i], 1, (size_t)(s->motion[i + 1] - s->motion[i]), out);
}

static bool write_all(Merge *m, FILE *out) {
    fwrite(m->item[0].head, 1, m->item[0].head_size, out);
    for (Summary *s = m->item; s < m->item + m->count; s++) {
        if (s->is_merged) continue;
        if (!s->shard.n) {
            for (int i = 0; i < s->count; i++) write_motion(s, i, out);
            continue;
        }
        Summary **shard = gather(m, s);
        if (!shard) return false;
        for (int i = 0; i < s->total; i++) write_motion(shard[i % s->shard.n], i / s->shard.n, out);
    }
    return true;
}

static bool check_heads(const Merge *m) {
    const Summary *a = m->item;
    for (const Summary *s = m->item; s < m->item + m->count; s++)
        if (s->head_size != a->head_size || memcmp(s->head, a->head, a->head_size) != 0)
            return error_set(m->e, ERR_INPUT, "'%s' and '%s' have different columns", a->path, s->path);
    return true;
}

bool summary_merge(const Settings *s, Arena *arena, Error *e) {
    Merge m = {.arena = arena, .e = e};
    Settings whole = {.output = s->output ? s->output : s->inputs.item[0]};
    char path[OUTPUT_PATH_MAX];
    Output out;
    int motions = 0;
    if (!s->output && s->inputs.count > 1)
        return error_set(e, ERR_USAGE, "several folders to merge: say with -o DIR where their summary goes");
    for (int i = 0; i < s->inputs.count; i++)
        if (!add_folder(&m, s->inputs.item[i])) return false;
    if (!check_heads(&m) || !summary_path(&whole, path, e) || !output_folder(whole.output, e) ||
        !output_open(&out, path, e))
        return false;
    if (!write_all(&m, out.file)) return output_abandon(&out), false;
    for (int i = 0; i < m.count; i++) motions += m.item[i].count;
    if (!output_close(&out, e)) return false;
    if (!s->quiet)
        fprintf(stderr, "%d summar%s with %d motion%s joined in '%s'\n", m.count, m.count == 1 ? "y" : "ies", motions,
                motions == 1 ? "" : "s", path);
    return true;
}
