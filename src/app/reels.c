/* Looks through folders as deep as they go: whatever holds NAME.0001.obj is a motion's folder, in
   which the sequence called `body` is the body and all others are garments. Where there are no
   OBJ files, Draco files do. */
#include "app/reels.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "files/listing.h"

enum { DEPTH_MAX = 64, STATS_LIMIT = 1 << 28 };

typedef struct { const Settings *settings; Arena *arena; Reel *reel; int count, capacity; Error *e; } Finder;

static Reel *add_reel(Finder *f, const char *motion) {
    Reel *reel = ARENA_GROW(f->arena, Reel, f->reel, f->count, &f->capacity, f->e);
    if (!reel) return NULL;
    f->reel = reel;
    f->reel[f->count] = (Reel){.motion = motion};
    return &f->reel[f->count++];
}

/* Frames a second, from the first and the last whole row of stats.csv: its first columns are frame and
   time. 0 where there is no such file, or only one frame in it. */
static double find_rate(Finder *f, const char *folder) {
    Error e = {0};
    Text text;
    double frame[2] = {0, 0}, time[2] = {0, 0};
    const char *path = listing_path(folder, "stats.csv", f->arena, &e);
    if (!path || !text_read(path, STATS_LIMIT, f->arena, &text, &e)) return 0;
    int rows = 0;
    for (const char *line = text.data, *end; *line; line = end + (*end == '\n')) {
        double number, seconds;
        end = line + strcspn(line, "\n");
        const char *comma = text_number(line, end, &number);
        if (!comma || *comma != ',' || !text_number(comma + 1, end, &seconds) || *end != '\n') continue;
        frame[rows > 0] = number;
        time[rows > 0] = seconds;
        rows++;
    }
    return rows > 1 && time[1] > time[0] && frame[1] > frame[0] ? (frame[1] - frame[0]) / (time[1] - time[0]) : 0;
}

/* The sequences of a folder as a reel, if it holds any. */
static bool add_folder(Finder *f, const char *folder, const char *motion) {
    Sequence *found = NULL;
    int n = 0, body = -1;
    for (int k = 0; k < 2 && n == 0; k++)
        if (!sequence_scan(folder, k ? "drc" : "obj", f->arena, &found, &n, f->e)) return false;
    if (n == 0) return true;
    Reel *reel = add_reel(f, motion);
    if (!reel) return false;
    for (int i = 0; i < n; i++)
        if (strcmp(found[i].name, "body") == 0) body = i;
    Place place = {.file = folder};
    if (body < 0) error_at(&reel->error, ERR_INPUT, place, "garments without a body ('body.0001.obj' and so on)");
    else if (n == 1) error_at(&reel->error, ERR_INPUT, place, "a body without garments");
    if (reel->error.kind) return true;
    reel->body = found[body];
    for (int i = body; i + 1 < n; i++) found[i] = found[i + 1];
    reel->garment = found;
    reel->ngarments = n - 1;
    if (f->settings->acceleration) reel->rate = find_rate(f, folder);
    return true;
}

/* Links to folders are not followed: they could lead round in a circle. */
static bool search_folder(Finder *f, const char *folder, const char *motion, int depth) {
    Listing names;
    if (!add_folder(f, folder, motion) || !listing_read(folder, f->arena, &names, f->e)) return false;
    for (int i = 0; i < names.count && depth < DEPTH_MAX; i++) {
        struct stat info;
        const char *inside = listing_path(folder, names.name[i], f->arena, f->e);
        if (!inside) return false;
        if (lstat(inside, &info) != 0 || !S_ISDIR(info.st_mode)) continue;
        const char *name = listing_path(motion, names.name[i], f->arena, f->e);
        if (!name || !search_folder(f, inside, name, depth + 1)) return false;
    }
    return true;
}

static bool add_patterns(Finder *f) {
    const Settings *s = f->settings;
    Reel *reel = add_reel(f, "");
    if (!reel) return false;
    reel->ngarments = s->garments.count;
    reel->garment = ARENA_NEW(f->arena, Sequence, reel->ngarments, f->e);
    bool good = reel->garment && sequence_find(s->body, f->arena, &reel->body, f->e);
    for (int g = 0; good && g < reel->ngarments; g++)
        good = sequence_find(s->garments.item[g], f->arena, &reel->garment[g], f->e);
    return good;
}

static bool check_needed(const Settings *s, Error *e) {
    bool patterns = s->body || s->garments.count;
    if (!patterns && s->inputs.count == 0)
        return error_set(e, ERR_USAGE, "nothing to verify: name a folder, or meshes with --garment and --body");
    if (patterns && s->inputs.count > 0)
        return error_set(e, ERR_USAGE, "'%s' and '--%s': name either folders or meshes", s->inputs.item[0],
                         s->body ? "body" : "garment");
    if (patterns && !s->body) return error_set(e, ERR_USAGE, "'--garment' needs '--body' beside it");
    if (patterns && !s->garments.count) return error_set(e, ERR_USAGE, "'--body' needs '--garment' beside it");
    return true;
}

bool reels_find(const Settings *s, Arena *arena, Reel **out, int *count, Error *e) {
    Finder f = {.settings = s, .arena = arena, .e = e};
    bool good = check_needed(s, e) && (!s->body || add_patterns(&f));
    for (int i = 0; good && i < s->inputs.count; i++) {
        int before = f.count;
        const char *folder = s->inputs.item[i];
        good = search_folder(&f, folder, "", 0);
        if (good && f.count == before)
            good = error_set(e, ERR_INPUT, "no meshes ('body.0001.obj' and so on) in '%s'", folder);
    }
    *out = f.reel;
    *count = f.count;
    return good;
}

static int by_value(const void *a, const void *b) {
    int x = *(const int *)a, y = *(const int *)b;
    return (x > y) - (x < y);
}

static bool is_selected(int number, const FrameSpan *span, int first) {
    int step = span->step ? span->step : 1, start = span->first ? span->first : first;
    return number >= start && (!span->last || number <= span->last) && (number - start) % step == 0;
}

bool reel_frames(const Reel *reel, const FrameSpan *span, Arena *arena, int **out, int *count, int *step, Error *e) {
    size_t total = 1;
    int n = 0, kept = 0;
    for (int g = -1; g < reel->ngarments; g++) total += (size_t)(g < 0 ? reel->body : reel->garment[g]).count;
    int *number = ARENA_NEW(arena, int, total, e);
    if (!number) return false;
    for (int g = -1; g < reel->ngarments; g++) {
        const Sequence *s = g < 0 ? &reel->body : &reel->garment[g];
        for (int i = 0; !s->still && i < s->count; i++) number[n++] = s->file[i].number;
    }
    if (n == 0) number[n++] = 1;
    qsort(number, (size_t)n, sizeof *number, by_value);
    *step = 0;
    for (int i = 0, first = number[0]; i < n; i++) {
        if ((kept && number[i] == number[kept - 1]) || !is_selected(number[i], span, first)) continue;
        number[kept++] = number[i];
        int gap = kept > 1 ? number[kept - 1] - number[kept - 2] : 0;
        if (gap && (*step == 0 || gap < *step)) *step = gap;
    }
    *out = number;
    *count = kept;
    return true;
}
