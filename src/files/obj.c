/* Writing Wavefront OBJ: the whole text is put together in one buffer and written in one go.

   A frame is some ten thousand short lines, so numbers are formatted by decimal.c and the room
   in the buffer is asked for once a line. Vertices, texture coordinates and normals share
   their numbering: a corner is i, i/i, i//i or i/i/i. */
#include "files/obj.h"

#include <stdlib.h>
#include <string.h>

#include "files/decimal.h"
#include "files/output.h"

/* No line without a name is longer: three numbers and what stands round them. */
enum { LINE_ROOM = 3 * DECIMAL_MAX + 64 };

/* The place for the next `need` bytes. */
static char *room_for(ObjWriter *w, size_t need, Error *e) {
    if (w->capacity - w->size < need) {
        size_t capacity = w->capacity + need + (w->capacity > (64 << 10) ? w->capacity / 2 : 64 << 10);
        char *text = realloc(w->text, capacity);
        if (!text) {
            error_set(e, ERR_INTERNAL, "out of memory for %zu bytes of OBJ text", capacity);
            return NULL;
        }
        w->text = text;
        w->capacity = capacity;
    }
    return w->text + w->size;
}

static void advance(ObjWriter *w, const char *end) { w->size = (size_t)(end - w->text); }

static bool put_head(ObjWriter *w, double unit, Error *e) {
    char *at = room_for(w, LINE_ROOM, e);
    if (!at) return false;
    advance(w, at + snprintf(at, LINE_ROOM, "# kitsuke: Y up, %.9g units are a metre\n", unit));
    return true;
}

/* One line: the tag and n numbers. */
static bool put_numbers(ObjWriter *w, const char *tag, const double *x, int n, Error *e) {
    char *at = room_for(w, LINE_ROOM, e);
    if (!at) return false;
    while (*tag) *at++ = *tag++;
    for (int i = 0; i < n; i++) {
        if (!isfinite(x[i])) return error_set(e, ERR_INTERNAL, "the mesh has a number that is not finite");
        *at++ = ' ';
        at = decimal_put(at, x[i]);
    }
    *at++ = '\n';
    advance(w, at);
    return true;
}

static bool put_vertices(ObjWriter *w, const Mesh *mesh, double unit, Error *e) {
    for (int i = 0; i < mesh->nvertices; i++) {
        Vec3 p = mesh->position[i];
        if (!put_numbers(w, "v", (double[]){p.x * unit, p.y * unit, p.z * unit}, 3, e)) return false;
    }
    for (int i = 0; i < mesh->nvertices && mesh->u && mesh->w; i++)
        if (!put_numbers(w, "vt", (double[]){mesh->u[i], mesh->w[i]}, 2, e)) return false;
    for (int i = 0; i < mesh->nvertices && mesh->normal; i++) {
        Vec3 n = mesh->normal[i];
        if (!put_numbers(w, "vn", (double[]){n.x, n.y, n.z}, 3, e)) return false;
    }
    return true;
}

/* A blank would make two groups of one name, and a control byte breaks the line. */
static bool put_group(ObjWriter *w, const char *name, Error *e) {
    size_t n = strlen(name);
    char *at = room_for(w, n + 16, e);
    if (!at) return false;
    memcpy(at, "g ", 2);
    at += 2;
    if (n == 0) *at++ = '_';
    for (size_t i = 0; i < n; i++) {
        unsigned char c = (unsigned char)name[i];
        *at++ = (char)(c <= ' ' || c == 127 || c == '#' || c == '\\' ? '_' : c);
    }
    *at++ = '\n';
    advance(w, at);
    return true;
}

static bool put_faces(ObjWriter *w, const Mesh *mesh, Error *e) {
    bool has_uv = mesh->u && mesh->w, has_normal = mesh->normal != NULL;
    int group = 0;
    for (int t = 0; t < mesh->ntriangles; t++) {
        for (; group < mesh->ngroups && mesh->group[group].first <= t; group++)
            if (mesh->group[group].count > 0 && !put_group(w, mesh->group[group].name, e)) return false;
        char *at = room_for(w, LINE_ROOM, e);
        if (!at) return false;
        *at++ = 'f';
        for (int c = 0; c < 3; c++) {
            char *number = at + 1;
            *at = ' ';
            at = decimal_put_int(number, mesh->triangle[t].v[c] + 1);
            size_t length = (size_t)(at - number);
            if (has_uv || has_normal) *at++ = '/';
            if (has_uv) at = (char *)memcpy(at, number, length) + length;
            if (has_normal) {
                *at++ = '/';
                at = (char *)memcpy(at, number, length) + length;
            }
        }
        *at++ = '\n';
        advance(w, at);
    }
    return true;
}

bool obj_format(ObjWriter *w, const Mesh *mesh, double unit, Error *e) {
    w->size = 0;
    return put_head(w, w->metre > 0 ? w->metre : unit, e) && put_vertices(w, mesh, unit, e) && put_faces(w, mesh, e);
}

bool obj_write(ObjWriter *w, const char *path, const Mesh *mesh, double unit, long long *bytes, Error *e) {
    if (!obj_format(w, mesh, unit, e) || !output_file(path, w->text, w->size, e)) return false;
    if (bytes) *bytes = (long long)w->size;
    return true;
}

void obj_writer_free(ObjWriter *w) {
    free(w->text);
    *w = (ObjWriter){0};
}
