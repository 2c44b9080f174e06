/* The text of a value becomes a field of Settings. What an option takes stands in the table; here each kind of value
   is read once, and refused in the same words. */
#include "app/settings.h"

#include <math.h>
#include <string.h>

#include "base/text.h"

/* Names that --unit takes, in metres. */
static const struct { const char *name; double metres; } units[] = {
    {"m", 1}, {"dm", 0.1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};
enum { UNITS = sizeof units / sizeof units[0] };

const char *settings_unit(double metres) {
    for (int i = 0; i < UNITS; i++)
        if (units[i].metres == metres) return units[i].name;
    return NULL;
}

static bool put_flag(bool *field, const Option *option, const char *text, Error *e) {
    *field = strcmp(text, "yes") == 0;
    return *field || strcmp(text, "no") == 0 ||
           error_set(e, ERR_USAGE, "option '--%s' is a switch: expected yes or no, found '%s'", option->name, text);
}

/* The whole text as a number. */
static bool is_number(const char *text, double *x) {
    const char *end = text + strlen(text);
    return text_number(text, end, x) == end && *text;
}

bool settings_expected(const char *option, const char *what, const char *text, Error *e) {
    return error_set(e, ERR_USAGE, "option '--%s': expected %s, found '%s'", option, what, text);
}

static bool put_int(int *field, const Option *option, const char *text, Error *e) {
    double x = 0;
    char what[80];
    int step = option->step ? option->step : 1;
    if (is_number(text, &x) && x >= option->low && x <= option->high && (int)x == x && (int)x % step == 0) {
        *field = (int)x + option->bias;
        return true;
    }
    if (step > 1) snprintf(what, sizeof what, "a multiple of %d from %.0f to %.0f", step, option->low, option->high);
    else snprintf(what, sizeof what, "a whole number from %.0f to %.0f", option->low, option->high);
    return settings_expected(option->name, what, text, e);
}

/* `what`: the range in words. */
static bool put_in_range(double *field, const Option *option, const char *what, const char *text, Error *e) {
    double x = 0;
    if (!is_number(text, &x) || !(x >= option->low && x <= option->high))
        return settings_expected(option->name, what, text, e);
    *field = x;
    return true;
}

static bool put_real(double *field, const Option *option, const char *text, Error *e) {
    char what[80];
    snprintf(what, sizeof what, "a number from %.10g to %.10g", option->low, option->high);
    return put_in_range(field, option, what, text, e);
}

static bool put_unit(double *field, const Option *option, const char *text, Error *e) {
    for (int i = 0; i < UNITS; i++) {
        if (strcmp(text, units[i].name) != 0) continue;
        *field = units[i].metres;
        return true;
    }
    char what[80];
    snprintf(what, sizeof what, "m, dm, cm, mm, in, ft or a number of metres from %g to %g", option->low, option->high);
    return put_in_range(field, option, what, text, e);
}

static const Choice *find_choice(const Option *option, const char *text, size_t length) {
    for (const Choice *c = option->choices; c->name; c++)
        if (strlen(c->name) == length && memcmp(c->name, text, length) == 0) return c;
    return NULL;
}

static bool wrong_choice(const Option *option, const char *text, size_t length, Error *e) {
    char names[160];
    return error_set(e, ERR_USAGE, "option '--%s': expected %s, found '%.*s'", option->name,
                     settings_choices(option->choices, names, sizeof names), (int)(length < 80 ? length : 80), text);
}

static bool put_choice(int *field, const Option *option, const char *text, Error *e) {
    const Choice *c = find_choice(option, text, strlen(text));
    if (!c) return wrong_choice(option, text, strlen(text), e);
    *field = c->value;
    return true;
}

static bool put_set(unsigned *field, const Option *option, const char *text, Error *e) {
    unsigned set = 0;
    for (const char *at = text;;) {
        size_t length = strcspn(at, ",");
        const Choice *c = find_choice(option, at, length);
        if (!c) return wrong_choice(option, at, length, e);
        set |= (unsigned)c->value;
        at += length;
        if (!*at++) break;
    }
    *field = set;
    return true;
}

/* A, A:B, A:B:STEP, where each part may be empty. A alone is that one frame. */
static bool put_span(FrameSpan *field, const Option *option, const char *text, Error *e) {
    int part[3] = {0, 0, 0}, n = 0;
    const char *at = text;
    for (;; at++, n++) {
        size_t length = strcspn(at, ":");
        double x = 0;
        if (n == 3) break;
        if (length && (text_number(at, at + length, &x) != at + length || !(x >= 1 && x <= 2e9) || x != (int)x)) break;
        part[n] = (int)x;
        at += length;
        if (!*at) {
            if (n == 0) part[1] = part[0];
            bool empty = n == 0 && length == 0;
            if (empty || (part[1] && part[1] < part[0])) break;
            *field = (FrameSpan){part[0], part[1], part[2]};
            return true;
        }
    }
    return settings_expected(option->name, "A:B:STEP with frames from 1 and A <= B", text, e);
}

/* Three numbers, the last a whole one from 1 on. How steep a stair may be is checked in motion/gait. */
static bool put_stairs(Gait *field, const Option *option, const char *text, Error *e) {
    double part[3] = {0, 0, 0};
    const char *at = text;
    int n = 0;
    for (; n < 3; n++, at++) {
        size_t length = strcspn(at, ":");
        if (length == 0 || text_number(at, at + length, &part[n]) != at + length) break;
        at += length;
        if (!*at) break;
    }
    bool good = n == 2 && !*at && part[0] != 0 && fabs(part[0]) <= 1e6 && part[1] > 0 && part[1] <= 1e6 &&
                part[2] >= 1 && part[2] <= 1e6;
    if (!good || part[2] != (int)part[2])
        return settings_expected(option->name, "RISE:RUN:COUNT, as in 0.17:0.29:8", text, e);
    field->stair_rise = part[0];
    field->stair_run = part[1];
    field->stair_count = (int)part[2];
    return true;
}

/* K/N with 1 <= K <= N */
static bool put_shard(Shard *field, const Option *option, const char *text, Error *e) {
    const char *slash = strchr(text, '/'), *end = text + strlen(text);
    double k = 0, n = 0;
    bool good = slash && text_number(text, slash, &k) == slash && text_number(slash + 1, end, &n) == end;
    if (!good || !(k >= 1 && k <= n && n <= SHARDS_MAX) || k != (int)k || n != (int)n)
        return settings_expected(option->name, "K/N with 1 <= K <= N", text, e);
    *field = (Shard){(int)k, (int)n};
    return true;
}

bool settings_append(TextList *list, const char *text, Arena *arena, Error *e) {
    const char **more = ARENA_GROW(arena, const char *, list->item, list->count, &list->capacity, e);
    if (!more) return false;
    list->item = more;
    list->item[list->count++] = text;
    return true;
}

bool settings_put(Settings *s, const Option *option, const char *text, Arena *arena, Error *e) {
    void *field = (char *)s + option->field;
    switch (option->kind) {
    case KIND_FLAG: return put_flag(field, option, text, e);
    case KIND_INT: return put_int(field, option, text, e);
    case KIND_REAL: return put_real(field, option, text, e);
    case KIND_LIST: return settings_append(field, text, arena, e);
    case KIND_CHOICE: return put_choice(field, option, text, e);
    case KIND_SET: return put_set(field, option, text, e);
    case KIND_SHARD: return put_shard(field, option, text, e);
    case KIND_SPAN: return put_span(field, option, text, e);
    case KIND_STAIRS: return put_stairs(field, option, text, e);
    case KIND_UNIT: return put_unit(field, option, text, e);
    case KIND_TEXT: break;
    }
    if (!*text) return error_set(e, ERR_USAGE, "option '--%s' needs a value: %s", option->name, option->argument);
    if (strcmp(option->argument, "DIR") == 0 && strcmp(text, "-") == 0)
        return settings_expected(option->name, "a folder, which standard output is not", text, e);
    if (option->choices && !find_choice(option, text, strlen(text))) return wrong_choice(option, text, strlen(text), e);
    *(const char **)field = text;
    return true;
}
