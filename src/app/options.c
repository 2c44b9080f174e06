/* From the words of a command line to Settings.

   GNU manners: options and operands in any order, `--` ends the options, `--name=value` and
   `--name value`, `-o DIR` and `-oDIR`, switches in clusters (`-qf`), the last one wins. A
   lone `-` is an operand. What is wrong is named, and the nearest right thing suggested. With
   --job the words are read twice: once to find the file, and once more on top of what it says. */
#include "app/options.h"

#include <string.h>
#include <sys/stat.h>

#include "app/jobfile.h"

typedef struct {
    const Command *command;
    int argc, next; /* argv[next] is the next word */
    char **argv;
    Arena *arena;
    Settings *settings;
    bool given[OPTIONS_MAX]; /* by place in the table */
} Parser;

/* Switches that contradict each other. */
static const char *const conflicts[][2] = {{"quiet", "verbose"}, {"list", "acceleration"}, {"list", "landmarks"}};
enum { CONFLICTS = sizeof conflicts / sizeof conflicts[0] };

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

static void *field_of(const Settings *s, const Option *option) { return (char *)s + option->field; }

/* A job file gives way to the command line: a list as a whole, a switch to the one that contradicts it. */
static void displace(Parser *p, const Option *option) {
    if (p->given[option - settings_table]) return;
    if (option->kind == KIND_LIST) *(TextList *)field_of(p->settings, option) = (TextList){0};
    for (int i = 0; i < CONFLICTS; i++)
        for (int side = 0; side < 2; side++) {
            if (strcmp(conflicts[i][side], option->name) != 0) continue;
            const Option *other = settings_find(conflicts[i][!side], p->command->bit);
            if (!p->given[other - settings_table]) *(bool *)field_of(p->settings, other) = false;
        }
}

static bool put(Parser *p, const Option *option, const char *value, Error *e) {
    displace(p, option);
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

/* What a word without a dash is short for. */
static const Option *find_operand(const Command *command) {
    for (const Option *o = settings_table; o->name; o++)
        if (o->field == offsetof(Settings, inputs) && (o->commands & command->bit)) return o;
    return settings_find("motion", COMMAND_ALL);
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
        else good = put(&p, find_operand(command), word, e);
        if (!good) return false;
        if (out->help || out->version) return true;
    }
    return true;
}

static bool check_conflicts(const Command *command, const Settings *s, Error *e) {
    for (int i = 0; i < CONFLICTS; i++) {
        const Option *a = settings_find(conflicts[i][0], command->bit);
        const Option *b = settings_find(conflicts[i][1], command->bit);
        if (*(bool *)field_of(s, a) && *(bool *)field_of(s, b))
            return error_set(e, ERR_USAGE, "'--%s' and '--%s' contradict each other", a->name, b->name);
    }
    if ((s->formats & FORMAT_NONE) && s->formats != FORMAT_NONE)
        return error_set(e, ERR_USAGE, "option '--format': 'none' cannot stand beside another format");
    if (s->method == METHOD_PAPER && s->fixed)
        return error_set(e, ERR_USAGE, "'--method paper' has no fixed topology: its patches share nothing");
    return true;
}

/* Nothing that is read may be written over. */
static bool check_input(const Settings *s, const char *path, Error *e) {
    struct stat input, output;
    bool is_same = stat(path, &input) == 0 && S_ISREG(input.st_mode) && stat(s->output, &output) == 0 &&
                   input.st_dev == output.st_dev && input.st_ino == output.st_ino;
    return !is_same || error_set(e, ERR_USAGE, "'%s' is read: it cannot be the output as well", path);
}

static bool check_output(const Command *command, const Settings *s, Error *e) {
    for (const Option *o = settings_table; o->name && s->output; o++) {
        if (!(o->commands & command->bit) || !settings_is_path(o) || o->field == offsetof(Settings, output)) continue;
        void *field = field_of(s, o);
        const TextList one = {.count = 1, .item = field}, *list = o->kind == KIND_LIST ? field : &one;
        for (int i = 0; i < list->count; i++)
            if (list->item[i] && !check_input(s, list->item[i], e)) return false;
    }
    return true;
}

bool options_parse(const Command *command, int argc, char **argv, Arena *arena, Settings *out, Error *e) {
    settings_clear(out);
    if (!parse_words(command, argc, argv, arena, out, e)) return false;
    const char *job = out->help || out->version ? NULL : out->job;
    if (job) {
        settings_clear(out);
        if (!jobfile_read(job, command, arena, out, e)) return false;
        if (!parse_words(command, argc, argv, arena, out, e)) return false;
    }
    return out->help || out->version || (check_conflicts(command, out, e) && check_output(command, out, e));
}
