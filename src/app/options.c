/* From the words of a command line to Settings, and from the table to the help page.

   GNU manners: options and operands in any order, `--` ends the options, `--name=value` and
   `--name value`, `-o DIR` and `-oDIR`, switches in clusters (`-qf`), the last one wins. A
   lone `-` is an operand. What is wrong is named, and the nearest right thing suggested. */
#include "app/options.h"

#include <string.h>

typedef struct {
    const Command *command;
    int argc, next; /* argv[next] is the next word */
    char **argv;
    Arena *arena;
    Settings *settings;
    bool given[OPTIONS_MAX]; /* by place in the table */
} Parser;

/* Pairs that contradict each other. */
static const char *const conflicts[][2] = {{"quiet", "verbose"}};

static bool unknown_option(const Parser *p, const char *word, const char *name, Error *e) {
    const Option *near = settings_nearest(name, p->command->bit);
    if (near) return error_set(e, ERR_USAGE, "unknown option '%s'; did you mean '--%s'?", word, near->name);
    return error_set(e, ERR_USAGE, "unknown option '%s'", word);
}

static bool foreign_option(const Parser *p, const Option *option, Error *e) {
    return error_set(e, ERR_USAGE, "'%s' has no option '--%s'", p->command->name, option->name);
}

static bool put(Parser *p, const Option *option, const char *value, Error *e) {
    p->given[option - settings_table] = true;
    return settings_put(p->settings, option, value, p->arena, e);
}

/* The value of an option that stands in the next word. */
static const char *next_value(Parser *p, const Option *option, Error *e) {
    if (p->next < p->argc) return p->argv[p->next++];
    error_set(e, ERR_USAGE, "option '--%s' needs a value: %s", option->name, option->argument);
    return NULL;
}

/* --name, --name=value, --name value, --no-name */
static bool parse_long(Parser *p, const char *word, Error *e) {
    const char *name = word + 2;
    size_t length = strcspn(name, "=");
    const char *value = name[length] ? name + length + 1 : NULL;
    const Option *option = settings_find(name, length, p->command->bit);
    if (!option && !value && strncmp(name, "no-", 3) == 0) {
        option = settings_find(name + 3, length - 3, p->command->bit);
        if (option && option->kind != KIND_FLAG) option = NULL;
        value = "no";
    }
    if (!option) {
        char copy[64];
        snprintf(copy, sizeof copy, "%.*s", (int)(length < 63 ? length : 63), name);
        return unknown_option(p, word, copy, e);
    }
    if (!(option->commands & p->command->bit)) return foreign_option(p, option, e);
    if (!value) value = option->kind == KIND_FLAG ? "yes" : next_value(p, option, e);
    return value && put(p, option, value, e);
}

/* -q, -qf, -o DIR, -oDIR, -qoDIR */
static bool parse_letters(Parser *p, const char *word, Error *e) {
    for (const char *at = word + 1; *at; at++) {
        const Option *option = settings_find_letter(*at, p->command->bit);
        if (!option) return error_set(e, ERR_USAGE, "unknown option '-%c' in '%s'", *at, word);
        if (!(option->commands & p->command->bit)) return foreign_option(p, option, e);
        if (option->kind != KIND_FLAG) {
            const char *value = at[1] ? at + 1 : next_value(p, option, e);
            return value && put(p, option, value, e);
        }
        if (!put(p, option, "yes", e)) return false;
    }
    return true;
}

static bool check_conflicts(const Parser *p, Error *e) {
    for (size_t i = 0; i < sizeof conflicts / sizeof conflicts[0]; i++) {
        const Option *a = settings_find(conflicts[i][0], strlen(conflicts[i][0]), p->command->bit);
        const Option *b = settings_find(conflicts[i][1], strlen(conflicts[i][1]), p->command->bit);
        if (p->given[a - settings_table] && p->given[b - settings_table])
            return error_set(e, ERR_USAGE, "'--%s' and '--%s' contradict each other", a->name, b->name);
    }
    const Settings *s = p->settings;
    if ((s->formats & FORMAT_NONE) && s->formats != FORMAT_NONE)
        return error_set(e, ERR_USAGE, "option '--format': 'none' cannot stand beside another format");
    return true;
}

bool options_parse(const Command *command, int argc, char **argv, Arena *arena, Settings *out, Error *e) {
    Parser p = {.command = command, .argc = argc, .argv = argv, .arena = arena, .settings = out};
    bool operands_only = false;
    memset(out, 0, sizeof *out);
    gait_defaults(&out->gait);
    while (p.next < argc) {
        const char *word = argv[p.next++];
        bool good = true;
        if (!operands_only && strcmp(word, "--") == 0) operands_only = true;
        else if (!operands_only && strncmp(word, "--", 2) == 0) good = parse_long(&p, word, e);
        else if (!operands_only && word[0] == '-' && word[1]) good = parse_letters(&p, word, e);
        else good = settings_append(&out->inputs, word, arena, e);
        if (!good) return false;
        if (out->help || out->version) return true;
    }
    return check_conflicts(&p, e);
}
