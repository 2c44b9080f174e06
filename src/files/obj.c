/* Writing Wavefront OBJ: the whole text is put together in one buffer and written in one go.

   A frame is some ten thousand short lines, so numbers are formatted by decimal.c and the room
   in the buffer is asked for once a line. Vertices, texture coordinates and normals share
   their numbering: a corner is i, i/i, i//i or i/i/i. What that looks like depends on i alone, so
   it is written once for all files, and faces, whatever they are, are put together from it. */
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

/* ' ' and a corner: three numbers of at most ten digits. Copied whole, which is faster than a bit of
   it; the next one goes over what is too much. */
enum { CORNER_ROOM = 36 };
struct ObjCorner { char text[CORNER_ROOM]; int length; };

enum { HAS_UV = 1, HAS_NORMAL = 2 };

static void format_corner(struct ObjCorner *c, int number, int kind) {
    *c = (struct ObjCorner){{0}, 0};
    char *first = c->text + 1, *at = decimal_put_int(first, number);
    size_t length = (size_t)(at - first);
    c->text[0] = ' ';
    if (kind) *at++ = '/';
    if (kind & HAS_UV) at = (char *)memcpy(at, first, length) + length;
    if (kind & HAS_NORMAL) {
        *at++ = '/';
        at = (char *)memcpy(at, first, length) + length;
    }
    c->length = (int)(at - c->text);
}

/* Sees to it that there are corners for n vertices. */
static bool make_corners(ObjWriter *w, int n, int kind, Error *e) {
    if (kind != w->corner_kind) w->ncorners = 0;
    w->corner_kind = kind;
    if (n > w->corner_capacity) {
        int capacity = n + n / 2;
        struct ObjCorner *corner = realloc(w->corner, (size_t)capacity * sizeof *corner);
        if (!corner) return error_set(e, ERR_INTERNAL, "out of memory for an OBJ file of %d vertices", n);
        w->corner = corner;
        w->corner_capacity = capacity;
    }
    for (; w->ncorners < n; w->ncorners++) format_corner(&w->corner[w->ncorners], w->ncorners + 1, kind);
    return true;
}

static bool put_faces(ObjWriter *w, const Mesh *mesh, Error *e) {
    int group = 0, kind = (mesh->u && mesh->w ? HAS_UV : 0) | (mesh->normal ? HAS_NORMAL : 0);
    if (!make_corners(w, mesh->nvertices, kind, e)) return false;
    for (int t = 0; t < mesh->ntriangles; t++) {
        for (; group < mesh->ngroups && mesh->group[group].first <= t; group++)
            if (mesh->group[group].count > 0 && !put_group(w, mesh->group[group].name, e)) return false;
        char *at = room_for(w, LINE_ROOM, e);
        if (!at) return false;
        *at++ = 'f';
        for (int c = 0; c < 3; c++) {
            const struct ObjCorner *corner = &w->corner[mesh->triangle[t].v[c]];
            memcpy(at, corner->text, CORNER_ROOM);
            at += corner->length;
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
    free(w->corner);
    *w = (ObjWriter){0};
}
