/* Whatever the bytes: a mesh whose indices are valid, or one error with a reason. And what was
   read can be written, read and written again with the same bytes. */
#include "files/obj.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static bool parse(const char *bytes, size_t size, Arena *arena, Mesh *mesh) {
    Error e = {0};
    char *copy = arena_text(arena, bytes, size, &e);
    bool good = copy && obj_parse(&(Text){"fuzz", copy, size}, arena, mesh, &e);
    if (!good && (e.kind != ERR_INPUT || !e.text[0])) abort();
    return good;
}

static void check(const Mesh *m) {
    for (int t = 0; t < m->ntriangles; t++)
        for (int c = 0; c < 3; c++)
            if (m->triangle[t].v[c] < 0 || m->triangle[t].v[c] >= m->nvertices) abort();
    int next = 0;
    for (int g = 0; g < m->ngroups; g++) {
        if (m->group[g].first != next || m->group[g].count <= 0) abort();
        next += m->group[g].count;
    }
    if (m->ngroups && next != m->ntriangles) abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (memchr(data, 0, size)) return 0; /* text_read keeps binary files out */
    Arena arena = {0};
    ObjWriter once = {0}, twice = {0};
    Error e = {0};
    Mesh mesh;
    if (parse((const char *)data, size, &arena, &mesh)) {
        check(&mesh);
        if (!obj_format(&once, &mesh, 1, &e) || !parse(once.text, once.size, &arena, &mesh)) abort();
        if (!obj_format(&twice, &mesh, 1, &e) || once.size != twice.size) abort();
        if (memcmp(once.text, twice.text, once.size) != 0) abort();
    }
    obj_writer_free(&once);
    obj_writer_free(&twice);
    arena_free(&arena);
    return 0;
}
