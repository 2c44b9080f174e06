/* From the words of a command line to Settings, and from the table to the help page.

   GNU manners: options and operands in any order, `--` ends the options, `--name=value` and
   `--name value`, `-o DIR` and `-oDIR`, switches in clusters (`-qf`), the last one wins. A
   lone `-` is an operand. What is wrong is named, and the nearest right thing suggested. With
   --job the words are read twice: once to find the file, and once more on top of what it says. */
#include "app/options.h"

#include <string.h>

#include "app/jobfile.h"

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
    const char *near = settings_nearest(name, p->command->bit);
    if (near) return error_set(e, ERR_USAGE, "unknown option '%s'; did you mean '--%s'?", word, near);
    return error_set(e, ERR_USAGE, "unknown option '%s'", word);
}

static bool unknown_letter(char letter, const char *word, Error *e) {
    if (!word[2]) return error_set(e, ERR_USAGE, "unknown option '%s'", word);
    return error_set(e, ERR_USAGE, "unknown option '-%c' in '%s'", letter, word);
}

static bool foreign_option(const Parser *p, const Option *option, Error *e) {
    return error_set(e, ERR_USAGE, "'%s' has no option '--%s'", p->command->name, option->name);
}

/* Contradictions are judged within the command line; a job file gives way to it, lists as a whole. */
static bool put(Parser *p, const Option *option, const char *value, Error *e) {
    bool *given = &p->given[option - settings_table];
    if (option->kind == KIND_LIST && !*given) *(TextList *)((char *)p->settings + option->field) = (TextList){0};
    for (size_t i = 0; i < sizeof conflicts / sizeof conflicts[0]; i++)
        for (int side = 0; side < 2; side++) {
            if (strcmp(conflicts[i][side], option->name) != 0) continue;
            const Option *other = settings_find(conflicts[i][!side], p->command->bit);
            if (!p->given[other - settings_table]) *(bool *)((char *)p->settings + other->field) = false;
        }
    *given = true;
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
    char name[64];
    bool no = false;
    size_t length = strcspn(word + 2, "=");
    const char *value = word[2 + length] ? word + 2 + length + 1 : NULL;
    snprintf(name, sizeof name, "%.*s", (int)(length < 63 ? length : 63), word + 2);
    const Option *option = settings_find_switch(name, p->command->bit, &no);
    if (!option || length >= sizeof name || (no && value)) return unknown_option(p, word, name, e);
    if (!(option->commands & p->command->bit)) return foreign_option(p, option, e);
    if (option->kind == KIND_FLAG && !value) value = no ? "no" : "yes";
    if (!value) value = next_value(p, option, e);
    return value && put(p, option, value, e);
}

/* -q, -qf, -o DIR, -oDIR, -qoDIR */
static bool parse_letters(Parser *p, const char *word, Error *e) {
    for (const char *at = word + 1; *at; at++) {
        const Option *option = settings_find_letter(*at, p->command->bit);
        if (!option) return unknown_letter(*at, word, e);
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
        const Option *a = settings_find(conflicts[i][0], p->command->bit);
        const Option *b = settings_find(conflicts[i][1], p->command->bit);
        if (p->given[a - settings_table] && p->given[b - settings_table])
            return error_set(e, ERR_USAGE, "'--%s' and '--%s' contradict each other", a->name, b->name);
    }
    const Settings *s = p->settings;
    if ((s->formats & FORMAT_NONE) && s->formats != FORMAT_NONE)
        return error_set(e, ERR_USAGE, "option '--format': 'none' cannot stand beside another format");
    if (s->method == METHOD_PAPER && s->fixed)
        return error_set(e, ERR_USAGE, "'--method paper' has no fixed topology: its patches share nothing");
    return true;
}

static bool put_operand(Parser *p, const char *word, Error *e) {
    return put(p, settings_find("motion", COMMAND_ALL), word, e); /* what operands are short for */
}

/* All words, on top of what the settings hold already. */
static bool parse_words(const Command *command, int argc, char **argv, Arena *arena, Settings *out, Error *e) {
    Parser p = {.command = command, .argc = argc, .argv = argv, .arena = arena, .settings = out};
    bool operands_only = false;
    while (p.next < argc) {
        const char *word = argv[p.next++];
        bool good = true;
        if (!operands_only && strcmp(word, "--") == 0) operands_only = true;
        else if (!operands_only && strncmp(word, "--", 2) == 0) good = parse_long(&p, word, e);
        else if (!operands_only && word[0] == '-' && word[1]) good = parse_letters(&p, word, e);
        else good = put_operand(&p, word, e);
        if (!good) return false;
        if (out->help || out->version) return true;
    }
    return check_conflicts(&p, e);
}

bool options_parse(const Command *command, int argc, char **argv, Arena *arena, Settings *out, Error *e) {
    settings_clear(out);
    if (!parse_words(command, argc, argv, arena, out, e)) return false;
    const char *job = out->job;
    if (!job || out->help || out->version) return true;
    settings_clear(out);
    return jobfile_read(job, command, arena, out, e) && parse_words(command, argc, argv, arena, out, e);
}
