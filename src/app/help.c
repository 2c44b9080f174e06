/* Help pages, made from the tables of commands and options, so that they always
   agree with what is parsed. The example comes first: it is what most readers look for. */
#include "app/help.h"

#include <string.h>

enum { HELP_COLUMN = 29, HELP_WIDTH = 80 };

/* Prints text word by word from `column` on, wrapped to the width with a hanging indent. */
static void print_wrapped(const char *text, int column, FILE *out) {
    int at = column;
    for (const char *word = text; *word;) {
        int length = (int)strcspn(word, " ");
        if (at > column && at + 1 + length >= HELP_WIDTH) {
            fprintf(out, "\n%*s", column, "");
            at = column;
        }
        at += fprintf(out, "%s%.*s", at > column ? " " : "", length, word);
        word += length;
        while (*word == ' ') word++;
    }
    fputc('\n', out);
}

/* "help (1..64; default: 8)" */
static void describe(const Option *o, char *text, size_t n) {
    char extra[240] = "";
    size_t used = 0;
    if (o->choices) {
        settings_choices(o->choices, extra, sizeof extra);
        used = strlen(extra);
    } else if (o->kind == KIND_UNIT) {
        used = (size_t)snprintf(extra, sizeof extra, "m, dm, cm, mm, in, ft or metres");
    } else if (o->kind == KIND_INT || o->kind == KIND_REAL) {
        used = (size_t)snprintf(extra, sizeof extra, "%.10g..%.10g", o->low, o->high);
        if (o->step > 1) used += (size_t)snprintf(extra + used, sizeof extra - used, ", a multiple of %d", o->step);
    }
    if (o->fallback) snprintf(extra + used, sizeof extra - used, "%sdefault: %s", used ? "; " : "", o->fallback);
    snprintf(text, n, extra[0] ? "%s (%s)" : "%s", o->help, extra);
}

static void print_option(const Option *o, FILE *out) {
    char head[80], text[480];
    int n = o->letter ? snprintf(head, sizeof head, "  -%c, --%s", o->letter, o->name)
                      : snprintf(head, sizeof head, "      --%s", o->name);
    if (o->argument) n += snprintf(head + n, sizeof head - (size_t)n, " %s", o->argument);
    describe(o, text, sizeof text);
    fprintf(out, "%s", head);
    if (n + 2 > HELP_COLUMN) fprintf(out, "\n%*s", HELP_COLUMN, "");
    else fprintf(out, "%*s", HELP_COLUMN - n, "");
    print_wrapped(text, HELP_COLUMN, out);
}

void help_command(const Command *command, FILE *out) {
    fprintf(out, "kitsuke %s - %s\n\n", command->name, command->summary);
    fprintf(out, "Usage: kitsuke %s %s\n\nExample:\n", command->name, command->operands);
    for (const char *line = command->example; *line;) {
        int length = (int)strcspn(line, "\n");
        fprintf(out, "  %.*s\n", length, line);
        line += length;
        if (*line) line++;
    }
    const char *group = "";
    for (const Option *o = settings_table; o->name; o++) {
        if (!(o->commands & command->bit)) continue;
        if (strcmp(group, o->group) != 0) fprintf(out, "\n%s\n", group = o->group);
        print_option(o, out);
    }
    fprintf(out, "\n--no-NAME turns a switch off again. A list (motions, garments) grows each time\n"
                 "it is given; of any other option the last one counts.\n");
}

static const char exit_codes[] =
    "Exit status: 0 done; 1 done, but --strict found the body showing through, or\n"
    "verify found anything; 2 wrong usage; 3 bad input; 4 cannot write; 5 internal, or\n"
    "out of memory; 130 interrupted.\n"
    "With several motions the worst one decides.\n";

void help_program(const Command *commands, FILE *out) {
    fprintf(out, "kitsuke - dress moving bodies in garments of bicubic Bezier patches\n\n"
                 "Usage: kitsuke COMMAND [OPTION]... [FILE]...\n\nExample:\n");
    for (const Command *c = commands; c->name; c++)
        fprintf(out, "  %.*s\n", (int)strcspn(c->example, "\n"), c->example);
    fprintf(out, "\nCommands\n");
    for (const Command *c = commands; c->name; c++) fprintf(out, "  %-10s %s\n", c->name, c->summary);
    fprintf(out, "\n'kitsuke COMMAND --help' explains a command's options.\n\n%s", exit_codes);
}

void help_hint(const Command *commands, FILE *out) {
    fprintf(out, "kitsuke dresses moving bodies in garments of bicubic Bezier patches, for example\n\n  %.*s\n\n"
                 "Use 'kitsuke --help' for more.\n", (int)strcspn(commands->example, "\n"), commands->example);
}
