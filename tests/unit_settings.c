/* Options as values and as text: whatever can be put can be shown and put again. */
#include "app/settings.h"

#include <stdlib.h>
#include <string.h>

#include "tap.h"

/* What settings_show writes of item i; the caller frees it. NULL: nothing. */
static char *show(const Settings *s, const Option *o, int i) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    bool said = out && settings_show(s, o, i, out);
    if (out) fclose(out);
    if (said) return text;
    free(text);
    return NULL;
}

static int samples(const Option *o, char text[8][64]) {
    int n = 0;
    switch (o->kind) {
    case KIND_FLAG: strcpy(text[n++], "yes"); strcpy(text[n++], "no"); break;
    case KIND_INT:
        snprintf(text[n++], 64, "%.0f", o->low);
        snprintf(text[n++], 64, "%.0f", o->high);
        break;
    case KIND_REAL:
        for (int i = 0; i < 4; i++)
            snprintf(text[n++], 64, "%.17g", o->low + (o->high - o->low) * (double[]){0, 1, 1 / 3.0, 0.1}[i]);
        break;
    case KIND_UNIT: strcpy(text[n++], "cm"); strcpy(text[n++], "in"); strcpy(text[n++], "0.123456789012345"); break;
    case KIND_TEXT:
    case KIND_CHOICE:
        for (const Choice *c = o->choices; c && c->name && n < 8; c++) strcpy(text[n++], c->name);
        if (!o->choices) strcpy(text[n++], "a name # with \"blanks\"");
        break;
    case KIND_SET:
        snprintf(text[n++], 64, "%s,%s", o->choices[0].name, o->choices[1].name);
        snprintf(text[n++], 64, "%s", o->choices[2].name);
        break;
    case KIND_SPAN:
        strcpy(text[n++], "7"); strcpy(text[n++], "3::2"); strcpy(text[n++], ":9"); strcpy(text[n++], "1:2:3");
        break;
    case KIND_SHARD: strcpy(text[n++], "3/8"); break;
    case KIND_STAIRS: strcpy(text[n++], "-0.17:0.29:8"); break;
    case KIND_LIST: strcpy(text[n++], "one thing"); break;
    }
    return n;
}

static bool comes_back(const Option *o, const char *value, Arena *arena) {
    Settings a, b;
    Error e = {0};
    settings_clear(&a);
    settings_clear(&b);
    if (!settings_put(&a, o, value, arena, &e)) return false;
    char *text = show(&a, o, 0);
    bool same = !text || settings_put(&b, o, text, arena, &e); /* the default is not shown */
    char *again = show(&b, o, 0);
    same = same && (text ? again && strcmp(text, again) == 0 : !again);
    if (o->kind == KIND_REAL || o->kind == KIND_UNIT)
        same = same && memcmp((char *)&a + o->field, (char *)&b + o->field, sizeof(double)) == 0;
    if (o->kind == KIND_SPAN)
        same = same && memcmp((char *)&a + o->field, (char *)&b + o->field, sizeof(FrameSpan)) == 0;
    if (!same) printf("# --%s %s came back as %s\n", o->name, value, text ? text : "nothing");
    free(text);
    free(again);
    return same;
}

static void test_round_trip(void) {
    Arena arena = {0};
    int options = 0, values = 0, lost = 0;
    for (const Option *o = settings_table; o->name; o++, options++) {
        char text[8][64];
        int n = samples(o, text);
        for (int i = 0; i < n; i++, values++) lost += !comes_back(o, text[i], &arena);
    }
    OK(options > 40 && options < OPTIONS_MAX, "%d options, room for %d", options, OPTIONS_MAX);
    OK(lost == 0, "%d values come back as they were put", values);
    arena_free(&arena);
}

static void test_defaults(void) {
    Settings s;
    int shown = 0;
    settings_clear(&s);
    for (const Option *o = settings_table; o->name; o++) {
        char *text = show(&s, o, 0);
        shown += text != NULL;
        free(text);
    }
    OK(shown == 0, "defaults are not shown");
}

int main(void) {
    test_round_trip();
    test_defaults();
    return tap_done();
}
