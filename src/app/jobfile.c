/* Job files are read with the table of the command line and written from it: a key is an option's
   long name, a value goes through settings_put, and whatever is wrong gets its place in the file.
   Nothing here knows what options there are. */
#include "app/jobfile.h"

#include <stdlib.h>
#include <string.h>

enum { JOB_FILE_MAX = 1 << 24 };

typedef struct {
    const char *folder; /* of the file, for relative paths */
    size_t folder_length;
    const Command *command;
    Arena *arena;
    Settings *settings;
    Error *e;
} Reader;

static bool wrong(const Reader *r, const Line *line, const char *at, const char *text) {
    return error_at(r->e, ERR_USAGE, text_place(&line->at, at), "%s", text);
}

/* "..." from its opening quote on, unescaped. NULL with an error. */
static char *quoted(const Reader *r, const Line *line) {
    static const char letters[] = "\"\\nrt", meant[] = "\"\\\n\r\t";
    const char *at = line->word[1] + 1;
    size_t n = 0;
    while (!text_is_end(at[n])) n++;
    char *out = ARENA_NEW(r->arena, char, n + 1, r->e), *to = out;
    if (!out) return NULL;
    for (; *at != '"'; at++) {
        const char *letter = *at == '\\' && at[1] ? strchr(letters, at[1]) : NULL;
        if (text_is_end(*at)) return wrong(r, line, at, "expected '\"' at the end of the value"), NULL;
        if (*at == '\\' && !letter) return wrong(r, line, at, "expected \\\", \\\\, \\n, \\r or \\t"), NULL;
        *to++ = letter ? meant[letter - letters] : *at;
        at += letter != NULL;
    }
    at++;
    const char *end = at;
    while (*at == ' ' || *at == '\t') at++;
    if (!text_is_end(*at) && (*at != '#' || at == end))
        return wrong(r, line, at, "expected nothing behind the closing '\"'"), NULL;
    return out;
}

/* The value of a line: the rest of it, NULL with an error. */
static char *value_of(const Reader *r, const Line *line, const Option *option) {
    char text[120];
    if (line->count > 1 && line->word[1][0] == '"') return quoted(r, line);
    if (line->count > 1) {
        const char *start = line->word[1], *last = line->word[line->count - 1];
        return arena_text(r->arena, start, (size_t)(last - start) + (size_t)line->length[line->count - 1], r->e);
    }
    if (option->kind == KIND_FLAG) return arena_text(r->arena, "yes", 3, r->e);
    snprintf(text, sizeof text, "'%s' needs a value: %s", option->name, option->argument);
    return wrong(r, line, line->word[0] + line->length[0], text), NULL;
}

static char *beside(const Reader *r, char *path) {
    if (path[0] == '/' || strcmp(path, "-") == 0 || !path[0] || !r->folder_length) return path;
    size_t n = strlen(path);
    char *out = ARENA_NEW(r->arena, char, r->folder_length + n + 1, r->e);
    if (!out) return NULL;
    memcpy(out, r->folder, r->folder_length);
    memcpy(out + r->folder_length, path, n + 1);
    return out;
}

static bool read_line(const Reader *r, const Line *line) {
    char key[64], text[160];
    bool no = false;
    Error why = {0};
    int n = line->length[0] < (int)sizeof key ? line->length[0] : (int)sizeof key - 1;
    snprintf(key, sizeof key, "%.*s", n, line->word[0]);
    const Option *option = settings_find_switch(key, r->command->bit, &no);
    if (!option || !(option->commands & r->command->bit) || line->length[0] != n) {
        const char *near = option ? NULL : settings_nearest(key, r->command->bit);
        if (option) snprintf(text, sizeof text, "'%s' has no option '%s'", r->command->name, key);
        else if (near) snprintf(text, sizeof text, "unknown option '%s'; did you mean '%s'?", key, near);
        else snprintf(text, sizeof text, "unknown option '%s'", key);
        return wrong(r, line, line->word[0], text);
    }
    if (option->field == offsetof(Settings, job) || option->field == offsetof(Settings, print_job))
        return wrong(r, line, line->word[0], "a job file cannot name another or print itself");
    if (no && line->count > 1)
        return wrong(r, line, line->word[1], "expected nothing behind a switch that is taken back");
    char *value = no ? arena_text(r->arena, "no", 2, r->e) : value_of(r, line, option);
    if (value && settings_is_path(option)) value = beside(r, value);
    if (!value) return false;
    return settings_put(r->settings, option, value, r->arena, &why) ||
           wrong(r, line, line->count > 1 ? line->word[1] : line->word[0], why.text);
}

bool jobfile_parse(const Text *text, const Command *command, Arena *arena, Settings *out, Error *e) {
    const char *slash = strrchr(text->name, '/');
    Reader r = {.folder = text->name, .command = command, .arena = arena, .settings = out, .e = e};
    Line line;
    r.folder_length = slash ? (size_t)(slash - text->name) + 1 : 0;
    for (Cursor c = text_start(text); text_line(&c, &line, e);)
        if (!read_line(&r, &line)) return false;
    return e->kind == ERR_NONE;
}

bool jobfile_read(const char *path, const Command *command, Arena *arena, Settings *out, Error *e) {
    Text text;
    return text_read(path, JOB_FILE_MAX, arena, &text, e) && jobfile_parse(&text, command, arena, out, e);
}

/* A value that could be mistaken for something else goes in quotes. */
static void print_value(const char *value, size_t n, FILE *out) {
    bool plain = n && value[0] != '"' && value[0] != '#' && value[0] != ' ' && value[n - 1] != ' ';
    int words = 1;
    for (size_t i = 0; plain && i < n; i++) {
        words += value[i] == ' ';
        plain = !strchr("\n\r\t", value[i]) && (value[i] != '#' || value[i - 1] != ' ') && words < TEXT_WORDS_MAX;
    }
    if (plain) {
        fwrite(value, 1, n, out);
        return;
    }
    fputc('"', out);
    for (size_t i = 0; i < n; i++) {
        if (value[i] == '\n') fputs("\\n", out);
        else if (value[i] == '\r') fputs("\\r", out);
        else if (value[i] == '\t') fputs("\\t", out);
        else fprintf(out, value[i] == '"' || value[i] == '\\' ? "\\%c" : "%c", value[i]);
    }
    fputc('"', out);
}

/* The line of an option's item i; *is_said tells whether it has one. */
static bool print_item(const Settings *s, const Option *option, int i, FILE *out, bool *is_said) {
    char *text = NULL;
    size_t size = 0;
    FILE *memory = open_memstream(&text, &size);
    if (!memory) return false;
    *is_said = settings_show(s, option, i, memory);
    bool good = !ferror(memory);
    good = fclose(memory) == 0 && good;
    if (good && *is_said) {
        fprintf(out, "%s ", option->name);
        print_value(text, size, out);
        fputc('\n', out);
    }
    free(text);
    return good;
}

static bool print_option(const Settings *s, const Option *option, FILE *out, Error *e) {
    bool is_said = true;
    for (int i = 0; is_said; i++)
        if (!print_item(s, option, i, out, &is_said)) return error_set(e, ERR_INTERNAL, "out of memory for the job");
    return true;
}

bool jobfile_print(const Command *command, const Settings *s, FILE *out, Error *e) {
    Settings job = *s;
    job.job = NULL;
    job.print_job = false;
    fprintf(out, "# kitsuke %s --job FILE; relative paths are seen from the folder of the file\n", command->name);
    for (const Option *o = settings_table; o->name; o++)
        if ((o->commands & command->bit) && !print_option(&job, o, out, e)) return false;
    return true;
}
