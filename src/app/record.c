/* Records compare contents, not dates: copied, moved and touched files are what they were, and one
   changed byte of an input is a change. A record is the last file of a motion that is written,
   after all others have reached the disk, and its last line is the one that is compared; so a
   whole record means a whole motion, and a torn one means none. */
#include "app/record.h"

#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <string.h>
#include <strings.h>

#include "base/text.h"

enum { RECORD_MAX = 1 << 22, KEY_LINE = 200, LIST_MAX = 1 << 15 };

static bool add_file(Digest *d, const char *path, Error *e) { return !path || digest_file(d, path, e); }

/* "name value" of everything that shapes the files, as a job file would have it. */
static void list_options(const Settings *s, FILE *out) {
    for (const Option *o = settings_table; o->name; o++) {
        if (!(o->commands & COMMAND_DRESS) || o->manner || settings_is_path(o)) continue;
        fprintf(out, "%s ", o->name);
        settings_show(s, o, 0, out);
        fputc('\n', out);
    }
    fputs(KITSUKE_VERSION "\n", out);
    stats_describe(TABLE_STATS, out);
    stats_describe(TABLE_SUMMARY, out);
}

/* Can all that is put on be read here, after it has been read for the work? */
static bool are_kept(const Settings *s) {
    bool kept = (!s->body || text_is_kept(s->body)) && (!s->roles || text_is_kept(s->roles));
    for (int i = 0; i < s->garments.count; i++) kept = kept && text_is_kept(s->garments.item[i]);
    return kept;
}

bool record_options(const Settings *s, Digest *out, Error *e) {
    char text[LIST_MAX];
    *out = 0;
    if (!are_kept(s)) return true;
    FILE *list = fmemopen(text, sizeof text, "w");
    if (!list) return error_set(e, ERR_INTERNAL, "out of memory for the list of options");
    list_options(s, list);
    bool good = fflush(list) == 0 || error_set(e, ERR_INTERNAL, "the list of options is too long");
    *out = digest_start();
    if (good) digest_add(out, text, (size_t)ftell(list));
    fclose(list);
    for (int i = 0; good && i < s->garments.count; i++) good = add_file(out, s->garments.item[i], e);
    digest_text(out, s->body ? "body" : "");
    digest_text(out, s->roles ? "roles" : "");
    return good && add_file(out, s->body, e) && add_file(out, s->roles, e);
}

/* AMC files say nothing of their skeleton: any .asf beside them may be it. The sum does not
   depend on the order in which the folder lists them. */
static bool add_skeletons(Digest *d, const char *motion, Error *e) {
    char path[OUTPUT_PATH_MAX];
    const char *slash = strrchr(motion, '/');
    int n = slash ? (int)(slash - motion) + 1 : 0;
    snprintf(path, sizeof path, "%.*s.", n, motion);
    DIR *folder = opendir(path);
    if (!folder && errno != EACCES) return error_set(e, ERR_INPUT, "cannot open '%s': %s", path, strerror(errno));
    Digest sum = 0;
    bool good = true;
    for (struct dirent *entry; folder && good && (errno = 0, entry = readdir(folder));) {
        if (!text_ends_in(entry->d_name, ".asf")) continue;
        Digest one = digest_start();
        digest_text(&one, entry->d_name);
        snprintf(path, sizeof path, "%.*s%s", n, motion, entry->d_name);
        good = digest_file(&one, path, e);
        sum += one;
    }
    if (folder && good && errno)
        good = error_set(e, ERR_INPUT, "cannot list the folder '%.*s.': %s", n, motion, strerror(errno));
    if (folder) closedir(folder);
    digest_add(d, &sum, sizeof sum);
    return good;
}

bool record_motion(const Input *input, const Settings *s, Digest *out, Error *e) {
    char word[TEXT_FIRST];
    *out = 0;
    if (!text_is_kept(input->path) || (s->asf && !text_is_kept(s->asf))) return true;
    Digest d = digest_start();
    if (!digest_file(&d, input->path, e) || !text_first_word(input->path, word, e)) return false;
    bool is_bvh = strcasecmp(word, "HIERARCHY") == 0;
    if (!is_bvh && !(s->asf ? digest_file(&d, s->asf, e) : add_skeletons(&d, input->path, e))) return false;
    *out = d ? d : 1;
    return true;
}

static void key_line(const RecordKey *key, const Record *r, char *out) {
    snprintf(out, KEY_LINE, "# done %016" PRIx64 " %016" PRIx64 " frames %d residual %d bytes %lld\n", key->options,
             key->motion, r->frames, r->residual_frames, r->bytes);
}

/* The text behind the first line that is no comment, or NULL. */
static char *behind_head(char *text) {
    while (*text == '#') {
        text = strchr(text, '\n');
        if (!text++) return NULL;
    }
    text = strchr(text, '\n');
    return text ? text + 1 : NULL;
}

bool record_read(const char *folder, const RecordKey *key, Arena *arena, Record *out, Error *e) {
    char path[OUTPUT_PATH_MAX + 16], wanted[KEY_LINE];
    Text text;
    Error why = {0};
    *out = (Record){0};
    snprintf(path, sizeof path, "%s/" RECORD_NAME, folder);
    if (!key->motion || !key->options) return false;
    if (!text_read(path, RECORD_MAX, arena, &text, &why)) return false;
    char *rows = arena_text(arena, text.data, text.size, e), *end = NULL;
    rows = rows ? behind_head(rows) : NULL;
    if (rows) end = strncmp(rows, "# done ", 7) == 0 ? rows : strstr(rows, "\n# done ");
    if (!end) return false;
    end += *end == '\n';
    if (sscanf(end, "# done %*x %*x frames %d residual %d bytes %lld", &out->frames, &out->residual_frames,
               &out->bytes) != 3)
        return false;
    key_line(key, out, wanted);
    if (strcmp(end, wanted) != 0) return false;
    *end = 0;
    out->rows = rows;
    return true;
}

bool record_write(const char *folder, const RecordKey *key, const Record *r, const SummaryRow *row, int n, bool times,
                  Error *e) {
    char path[OUTPUT_PATH_MAX + 16], line[KEY_LINE];
    StatsFile f;
    if (!key->motion || !key->options) return true;
    snprintf(path, sizeof path, "%s/" RECORD_NAME, folder);
    if (!stats_open(&f, path, TABLE_SUMMARY, times, e)) return false;
    key_line(key, r, line);
    for (int i = 0; i < n; i++) {
        if (stats_add_summary(&f, &row[i], e)) continue;
        stats_abandon(&f);
        return false;
    }
    return stats_add_text(&f, line, e) ? stats_close(&f, e) : (stats_abandon(&f), false);
}
