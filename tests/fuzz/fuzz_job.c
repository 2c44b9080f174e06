/* Whatever the bytes: a job, or one error with its place. A job that was read comes back from its
   text the same. */
#include "app/jobfile.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static const Command commands[] = {{.name = "dress", .bit = COMMAND_DRESS}, {.name = "walk", .bit = COMMAND_WALK}};

/* The job's text, in the form of --print-job; the caller frees it. NULL: it was refused. */
static char *reprint(const Command *command, const char *bytes, size_t size) {
    Arena arena = {0};
    Error e = {0};
    Settings settings;
    char *printed = NULL;
    size_t n = 0;
    const char *copy = arena_text(&arena, bytes, size, &e);
    Text text = {"fuzz", copy, size};
    settings_clear(&settings);
    if (!copy) abort();
    if (jobfile_parse(&text, command, &arena, &settings, &e)) {
        FILE *out = open_memstream(&printed, &n);
        if (!out || !jobfile_print(command, &settings, out, &e) || fclose(out) != 0) abort();
    } else if ((e.kind != ERR_USAGE && e.kind != ERR_INPUT) || !e.text[0] || e.line < 1) {
        abort();
    }
    arena_free(&arena);
    return printed;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (memchr(data, 0, size)) return 0; /* text_read keeps binary files out */
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++) {
        char *once = reprint(&commands[i], (const char *)data, size);
        if (!once) continue;
        char *twice = reprint(&commands[i], once, strlen(once));
        if (!twice || strcmp(once, twice) != 0) abort();
        free(once);
        free(twice);
    }
    return 0;
}
