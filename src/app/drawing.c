/* The options of `draw` that are small languages: --view, --cell and --frames. */
#include "app/drawing.h"

#include <string.h>

/* Frames that are drawn where none are asked for. */
enum { SPREAD = 6 };

static bool read_degrees(const char *from, const char *end, double low, double high, double *out) {
    return end > from && text_number(from, end, out) == end && *out >= low && *out <= high;
}

static bool read_view(const char *text, Drawing *d, Error *e) {
    static const struct { const char *name; double azimuth, elevation; } names[] = {
        {"front", 0, 0}, {"back", 180, 0}, {"left", 90, 0}, {"right", -90, 0}, {"iso", 45, 30}};
    for (size_t i = 0; text && i < sizeof names / sizeof names[0]; i++)
        if (strcmp(text, names[i].name) == 0) {
            d->azimuth = names[i].azimuth;
            d->elevation = names[i].elevation;
            return true;
        }
    if (!text) return true;
    const char *slash = strchr(text, '/'), *end = text + strlen(text);
    if (read_degrees(text, slash ? slash : end, -360, 360, &d->azimuth) &&
        (!slash || read_degrees(slash + 1, end, -89, 89, &d->elevation)))
        return true;
    return settings_expected("view", "front, back, left, right, iso or AZ/EL in degrees, EL from -89 to 89", text, e);
}

/* Words of --cell, and what each does to one; -1 leaves it as it is. */
static const struct { const char *name; int method, split; unsigned show; } words[] = {
    {"push", METHOD_PUSH, -1, 0},        {"paper", METHOD_PAPER, -1, 0},
    {"global", METHOD_GLOBAL, -1, 0},    {"adaptive", -1, SPLIT_ADAPTIVE, 0},
    {"uniform", -1, SPLIT_UNIFORM, 0},   {"none", -1, SPLIT_NONE, 0},
    {"patches", -1, -1, SHOW_PATCHES},   {"points", -1, -1, SHOW_POINTS},
    {"cells", -1, -1, SHOW_CELLS}};

static bool read_word(const char *word, size_t length, DrawingCell *c) {
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (strlen(words[i].name) != length || memcmp(words[i].name, word, length) != 0) continue;
        if (words[i].method >= 0) c->method = (Method)words[i].method;
        if (words[i].split >= 0) c->split = (SplitRule)words[i].split;
        c->show |= words[i].show;
        return true;
    }
    return false;
}

/* WORD,WORD=TITLE. Without a title the words are it. */
static bool read_cell(const char *text, DrawingCell *c, Error *e) {
    size_t length = strcspn(text, "=");
    for (const char *at = text; length > 0;) {
        size_t n = strcspn(at, ",=");
        if (!read_word(at, n, c)) break;
        if (at[n] != ',') {
            snprintf(c->title, sizeof c->title, "%s", at[n] ? at + n + 1 : text);
            return true;
        }
        at += n + 1;
    }
    return settings_expected(
        "cell", "some of push, paper, global, adaptive, uniform, none, patches, points, cells and =TITLE", text, e);
}

static bool read_cells(const Settings *s, Drawing *d, Error *e) {
    DrawingCell usual = {.method = (Method)s->method, .split = (SplitRule)s->split, .show = s->draw.show};
    d->ncells = s->draw.cells.count ? s->draw.cells.count : 1;
    if (d->ncells > DRAWING_CELLS_MAX)
        return error_set(e, ERR_USAGE, "option '--cell': at most %d of them, found %d", DRAWING_CELLS_MAX, d->ncells);
    d->cell[0] = usual;
    for (int c = 0; c < s->draw.cells.count; c++) {
        d->cell[c] = usual;
        if (!read_cell(s->draw.cells.item[c], &d->cell[c], e)) return false;
    }
    return true;
}

/* Each part between commas is what --frames of the other commands takes. */
static bool read_spans(const char *text, Arena *arena, Drawing *d, Error *e) {
    const Option *option = settings_find("frames", COMMAND_DRESS);
    for (const char *at = text; at;) {
        size_t n = strcspn(at, ",");
        Settings one = {0};
        char *part = arena_text(arena, at, n, e);
        if (!part || !settings_put(&one, option, part, arena, e)) return false;
        if (d->nspans == DRAWING_SPANS_MAX)
            return error_set(e, ERR_USAGE, "option '--frames': at most %d parts, found more", DRAWING_SPANS_MAX);
        d->span[d->nspans++] = one.frames;
        at = at[n] ? at + n + 1 : NULL;
    }
    return true;
}

bool drawing_read(const Settings *s, Arena *arena, Drawing *out, Error *e) {
    *out = (Drawing){0};
    return read_view(s->draw.view, out, e) && read_cells(s, out, e) && read_spans(s->draw.frames, arena, out, e);
}

static bool is_in(const FrameSpan *span, int frame) {
    int first = span->first ? span->first : 1, step = span->step ? span->step : 1;
    return frame >= first && (!span->last || frame <= span->last) && (frame - first) % step == 0;
}

static bool is_drawn(const Drawing *d, int frame, int total) {
    for (int s = 0; s < d->nspans; s++)
        if (is_in(&d->span[s], frame)) return true;
    for (int k = 0; k < SPREAD && !d->nspans; k++)
        if (frame == 1 + (int)((long long)k * (total - 1) / (SPREAD - 1))) return true;
    return false;
}

bool drawing_frames(const Drawing *d, const char *motion, int total, Arena *arena, int **frame, int *count, Error *e) {
    int most = DRAWING_PICTURES_MAX / d->ncells, n = 0;
    for (int s = 0; s < d->nspans; s++)
        if (d->span[s].first > total)
            return error_set(e, ERR_USAGE, "'--frames' asks for frame %d, but '%s' has %d", d->span[s].first, motion,
                             total);
    *frame = ARENA_NEW(arena, int, most, e);
    if (!*frame) return false;
    for (int f = 1; f <= total; f++) {
        if (!is_drawn(d, f, total)) continue;
        if (n < most) (*frame)[n] = f;
        n++;
    }
    *count = n;
    return n <= most || error_set(e, ERR_USAGE, "%d pictures are too many for a sheet of %d: use '--frames A:B:STEP'",
                                  n * d->ncells, DRAWING_PICTURES_MAX);
}
