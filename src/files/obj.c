/* Writing Wavefront OBJ: the whole text is put together in one buffer and written in one go.

   A frame is some ten thousand short lines. Those of points and normals are formatted by digits.c,
   sixteen at a time. Parameters and faces mostly are those of an earlier file, and copied from
   there (memo.c). Vertices, texture coordinates and normals share their numbering, but at creases: a
   corner is i, i/i, i//i or i/i/i. What that looks like depends on i alone, so it is written once for all
   files, and faces, where they are new, are put together from it. */
#include "files/obj.h"

#include <stdlib.h>
#include <string.h>

#include "files/decimal.h"
#include "files/digits.h"
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

/* Numbers that digits.c leaves to us. */
static bool put_slowly(ObjWriter *w, const char *tag, const double *x, double unit, int columns, int lines,
                       Error *e) {
    for (int line = 0, i = 0; line < lines; line++) {
        char *at = room_for(w, LINE_ROOM, e);
        if (!at) return false;
        at = stpcpy(at, tag);
        for (int c = 0; c < columns; c++, i++) {
            if (!isfinite(x[i] * unit)) return error_set(e, ERR_INTERNAL, "the mesh has a number that is not finite");
            *at++ = ' ';
            at = decimal_put(at, x[i] * unit);
        }
        *at++ = '\n';
        advance(w, at);
    }
    return true;
}

/* Lines of the tag and some of the numbers x, times unit. */
static bool put_lines(ObjWriter *w, const char *tag, const double *x, double unit, int columns, int lines, Error *e) {
    char *at = room_for(w, DIGITS_LINES * DIGITS_ROOM, e), *end = NULL;
    if (!at) return false;
    if (lines == DIGITS_LINES) end = digits_lines(at, tag, x, unit, columns, w->vectors);
    if (!end) return put_slowly(w, tag, x, unit, columns, lines, e);
    advance(w, end);
    return true;
}

static int lines_left(int n, int done) { return n - done < DIGITS_LINES ? n - done : DIGITS_LINES; }

static bool put_vectors(ObjWriter *w, const char *tag, const Vec3 *v, int n, double unit, Error *e) {
    for (int i = 0; i < n; i += DIGITS_LINES)
        if (!put_lines(w, tag, (const double *)(v + i), unit, 3, lines_left(n, i), e)) return false;
    return true;
}

static bool put_parameters(ObjWriter *w, const Mesh *mesh, Error *e) {
    double x[DIGITS_LINES * DIGITS_COLUMNS] = {0};
    for (int i = 0; i < mesh->nvertices; i += DIGITS_LINES) {
        int lines = lines_left(mesh->nvertices, i);
        for (int k = 0; k < lines; k++) x[2 * k] = mesh->u[i + k], x[2 * k + 1] = mesh->w[i + k];
        if (!put_lines(w, "vt", x, 1, 2, lines, e)) return false;
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

static int kind_of(const Mesh *mesh) { return (mesh->u && mesh->w ? HAS_UV : 0) | (mesh->normal ? HAS_NORMAL : 0); }

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

/* The corner of a crease: number and normal differ. */
static char *put_crease(char *at, int number, int normal, int kind) {
    *at++ = ' ';
    at = decimal_put_int(at, number);
    *at++ = '/';
    if (kind & HAS_UV) at = decimal_put_int(at, number);
    *at++ = '/';
    return decimal_put_int(at, normal);
}

static bool put_faces(ObjWriter *w, const Mesh *mesh, Error *e) {
    int group = 0, crease = 0;
    if (!make_corners(w, mesh->nvertices, kind_of(mesh), e)) return false;
    for (int t = 0; t < mesh->ntriangles; t++) {
        for (; group < mesh->ngroups && mesh->group[group].first <= t; group++)
            if (mesh->group[group].count > 0 && !put_group(w, mesh->group[group].name, e)) return false;
        char *at = room_for(w, LINE_ROOM, e);
        if (!at) return false;
        *at++ = 'f';
        for (int c = 0; c < 3; c++) {
            const struct ObjCorner *corner = &w->corner[mesh->triangle[t].v[c]];
            if (crease < mesh->ncreases && mesh->crease[crease].corner == 3 * t + c) {
                at = put_crease(at, mesh->triangle[t].v[c] + 1, mesh->crease[crease++].normal + 1, w->corner_kind);
                continue;
            }
            memcpy(at, corner->text, CORNER_ROOM);
            at += corner->length;
        }
        *at++ = '\n';
        advance(w, at);
    }
    return true;
}

/* What was written in an earlier file under the same key, or what `put` writes now. */
static bool put_again(ObjWriter *w, bool (*put)(ObjWriter *w, const Mesh *mesh, Error *e), const Mesh *mesh,
                      Error *e) {
    size_t size, before = w->size;
    const char *text = memo_find(&w->memo, &size);
    if (text) {
        char *at = room_for(w, size, e);
        if (at) advance(w, (char *)memcpy(at, text, size) + size);
        return at != NULL;
    }
    if (!put(w, mesh, e)) return false;
    memo_keep(&w->memo, w->text + before, w->size - before);
    return true;
}

static bool put_parameters_again(ObjWriter *w, const Mesh *mesh, Error *e) {
    size_t size = (size_t)mesh->nvertices * sizeof(double);
    memo_begin(&w->memo);
    memo_add(&w->memo, "vt", 2);
    memo_add(&w->memo, mesh->u, size);
    memo_add(&w->memo, mesh->w, size);
    return put_again(w, put_parameters, mesh, e);
}

static bool put_faces_again(ObjWriter *w, const Mesh *mesh, Error *e) {
    int shape[] = {kind_of(mesh), mesh->ntriangles, mesh->ncreases, mesh->ngroups};
    memo_begin(&w->memo);
    memo_add(&w->memo, "f", 1);
    memo_add(&w->memo, shape, sizeof shape);
    memo_add(&w->memo, mesh->triangle, (size_t)mesh->ntriangles * sizeof(Triangle));
    memo_add(&w->memo, mesh->crease, (size_t)mesh->ncreases * sizeof(Crease));
    for (int g = 0; g < mesh->ngroups; g++) {
        memo_add(&w->memo, &mesh->group[g].first, sizeof(int));
        memo_add(&w->memo, &mesh->group[g].count, sizeof(int));
        memo_add(&w->memo, mesh->group[g].name, strlen(mesh->group[g].name) + 1);
    }
    return put_again(w, put_faces, mesh, e);
}

bool obj_format(ObjWriter *w, const Mesh *mesh, double unit, Error *e) {
    w->size = 0;
    return put_head(w, w->metre > 0 ? w->metre : unit, e) &&
           put_vectors(w, "v", mesh->position, mesh->nvertices, unit, e) &&
           (!mesh->u || !mesh->w || put_parameters_again(w, mesh, e)) &&
           (!mesh->normal || put_vectors(w, "vn", mesh->normal, mesh->nvertices + mesh->nextra, 1, e)) &&
           put_faces_again(w, mesh, e);
}

bool obj_write(ObjWriter *w, const char *path, const Mesh *mesh, double unit, long long *bytes, Error *e) {
    if (!obj_format(w, mesh, unit, e) || !output_file(path, w->text, w->size, e)) return false;
    if (bytes) *bytes = (long long)w->size;
    return true;
}

void obj_writer_free(ObjWriter *w) {
    free(w->text);
    free(w->corner);
    memo_free(&w->memo);
    *w = (ObjWriter){0};
}
