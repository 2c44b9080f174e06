/* The way back from a field of Settings to the text that was put there: for --print-job, and for the
   record of what a motion was dressed with. What settings_put makes of the text is the same
   value again, to the last bit. */
#include <string.h>

#include "app/settings.h"
#include "base/text.h"

static void show_real(double x, FILE *out) {
    char text[TEXT_SHORTEST];
    fputs(text_shortest(x, text), out);
}

static void show_unit(double metres, FILE *out) {
    const char *name = settings_unit(metres);
    if (name) fputs(name, out);
    else show_real(metres, out);
}

static void show_choice(const Choice *choices, int value, FILE *out) {
    for (const Choice *c = choices; c->name; c++)
        if (c->value == value) {
            fputs(c->name, out);
            return;
        }
}

static void show_set(const Choice *choices, unsigned set, FILE *out) {
    const char *separator = "";
    for (const Choice *c = choices; c->name; c++)
        if (set & (unsigned)c->value) {
            fprintf(out, "%s%s", separator, c->name);
            separator = ",";
        }
}

static void show_span(FrameSpan span, FILE *out) {
    if (span.first) fprintf(out, "%d", span.first);
    fputc(':', out);
    if (span.last) fprintf(out, "%d", span.last);
    if (span.step) fprintf(out, ":%d", span.step);
}

static void show_stairs(const Gait *g, FILE *out) {
    show_real(g->stair_rise, out);
    fputc(':', out);
    show_real(g->stair_run, out);
    fprintf(out, ":%d", g->stair_count);
}

static bool same_text(const char *a, const char *b) { return a == b || (a && b && strcmp(a, b) == 0); }

/* Is the field what nobody has asked for? */
static bool is_default(const Option *option, const void *field, const Settings *defaults) {
    const void *usual = (const char *)defaults + option->field;
    const FrameSpan *span = field;
    switch (option->kind) {
    case KIND_FLAG: return *(const bool *)field == *(const bool *)usual;
    case KIND_INT:
    case KIND_CHOICE: return *(const int *)field == *(const int *)usual;
    case KIND_SET: return *(const unsigned *)field == *(const unsigned *)usual;
    case KIND_REAL:
    case KIND_UNIT: return *(const double *)field == *(const double *)usual;
    case KIND_TEXT: return same_text(*(const char *const *)field, *(const char *const *)usual);
    case KIND_SHARD: return ((const Shard *)field)->n == 0;
    case KIND_SPAN: return !span->first && !span->last && !span->step;
    case KIND_STAIRS: return ((const Gait *)field)->stair_count == 0;
    case KIND_LIST: break;
    }
    return false;
}

bool settings_show(const Settings *s, const Option *option, int i, FILE *out) {
    const void *field = (const char *)s + option->field;
    const TextList *list = field;
    Settings defaults;
    if (option->kind == KIND_LIST) return i < list->count && fputs(list->item[i], out) >= 0;
    settings_clear(&defaults);
    if (i > 0 || is_default(option, field, &defaults)) return false;
    switch (option->kind) {
    case KIND_FLAG: fputs(*(const bool *)field ? "yes" : "no", out); break;
    case KIND_INT: fprintf(out, "%d", *(const int *)field - option->bias); break;
    case KIND_REAL: show_real(*(const double *)field, out); break;
    case KIND_UNIT: show_unit(*(const double *)field, out); break;
    case KIND_TEXT: fputs(*(const char *const *)field, out); break;
    case KIND_CHOICE: show_choice(option->choices, *(const int *)field, out); break;
    case KIND_SET: show_set(option->choices, *(const unsigned *)field, out); break;
    case KIND_SHARD: fprintf(out, "%d/%d", ((const Shard *)field)->k, ((const Shard *)field)->n); break;
    case KIND_SPAN: show_span(*(const FrameSpan *)field, out); break;
    case KIND_STAIRS: show_stairs(field, out); break;
    case KIND_LIST: break;
    }
    return true;
}
