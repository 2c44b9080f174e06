/* Whatever the bytes: a body, or one error with a reason. A body that was read comes back from
   its text the same, and has a skin of finite points. */
#include "figure/body.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static bool parse(const char *bytes, size_t size, BodySpec *spec) {
    Arena arena = {0};
    Error e = {0};
    const char *copy = arena_text(&arena, bytes, size, &e);
    Text text = {"fuzz", copy, size};
    bool good = copy && body_parse(&text, spec, &e);
    if (!good && (e.kind != ERR_INPUT || !e.text[0] || e.line < 1)) abort();
    arena_free(&arena);
    return good;
}

static void check_text(const BodySpec *spec) {
    static BodySpec again;
    char *bytes = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&bytes, &size);
    if (!out || !body_write(spec, out)) abort();
    fclose(out);
    if (!parse(bytes, size, &again) || memcmp(spec, &again, sizeof again) != 0) abort();
    free(bytes);
}

static void check_skin(const BodySpec *spec) {
    static Body body;
    Arena arena = {0};
    Error e = {0};
    Figure figure = figure_reference();
    if (!body_fit(spec, &figure, 8, &arena, &body, &e)) abort();
    for (int i = 0; i < body.skin.nvertices; i++)
        if (!vec_finite(body.skin.position[i]) || !vec_finite(body.skin.normal[i])) abort();
    arena_free(&arena);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static BodySpec spec;
    if (memchr(data, 0, size)) return 0; /* text_read keeps binary files out */
    if (!parse((const char *)data, size, &spec)) return 0;
    check_text(&spec);
    check_skin(&spec);
    return 0;
}
