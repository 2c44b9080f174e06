/* Reading Wavefront OBJ, the polygons of it: two passes over the text.

   The first counts, so that every array has its size and a wrong index is found where it
   stands; the second fills. Lines that say nothing about a polygon mesh are skipped. */
#include "files/obj.h"

#include <string.h>

enum { INDEX_DIGITS = 9 };

typedef enum { LINE_V, LINE_VT, LINE_VN, LINE_F, LINE_G, LINE_O, LINE_USEMTL, LINE_OTHER } LineKind;
static const char *const line_words[LINE_OTHER] = {"v", "vt", "vn", "f", "g", "o", "usemtl"};

/* What the first corner of a vertex in a face says of it. */
typedef struct { bool is_there; int uv, normal; } Corner;

typedef struct {
    Cursor at;
    Arena *arena;
    Mesh *mesh;
    int lines[LINE_OTHER + 1]; /* of each kind in the whole file */
    int triangles;             /* in the whole file */
    int seen[LINE_OTHER + 1];  /* so far, for negative indices */
    LineKind grouping;         /* the lines that make groups */
    double (*uv)[2];
    Vec3 *normal;
    Corner *corner;          /* of each vertex */
    bool all_uv, all_normal; /* every corner so far had one */
} Reader;

static const char *word_end(const char *s) {
    while (!text_is_end(*s) && *s != ' ' && *s != '\t') s++;
    return s;
}

static void start_line(Cursor *c, const char *at) {
    c->at = c->line_start = at;
    c->line++;
}

/* Steps over blanks, and over a backslash that continues the line on the next one. False
   where the line ends. */
static bool find_word(Cursor *c) {
    for (;;) {
        const char *s = c->at;
        if (*s == ' ' || *s == '\t') c->at++;
        else if (*s == '\\' && s[1] == '\n') start_line(c, s + 2);
        else if (*s == '\\' && s[1] == '\r' && s[2] == '\n') start_line(c, s + 3);
        else return !text_is_end(*s) && *s != '#';
    }
}

/* To the start of the next line; false at the end of the text. */
static bool next_line(Cursor *c) {
    const char *s = c->at;
    while (!text_is_end(*s)) s++;
    if (*s == 0) return false;
    start_line(c, s + (s[0] == '\r' && s[1] == '\n' ? 2 : 1));
    return true;
}

/* What the line is; steps over the word that says so. */
static LineKind take_kind(Cursor *c) {
    if (!find_word(c)) return LINE_OTHER;
    const char *end = word_end(c->at);
    size_t length = (size_t)(end - c->at);
    LineKind kind = 0;
    while (kind < LINE_OTHER && (strlen(line_words[kind]) != length || memcmp(c->at, line_words[kind], length) != 0))
        kind++;
    c->at = end;
    return kind;
}

static void count_lines(Reader *r) {
    Cursor c = r->at;
    do {
        LineKind kind = take_kind(&c);
        r->lines[kind]++;
        int corners = 0;
        for (; kind == LINE_F && find_word(&c); corners++) c.at = word_end(c.at);
        if (corners > 2) r->triangles += corners - 2;
    } while (next_line(&c));
}

static bool take_number(Cursor *c, double *out, Error *e) {
    if (!find_word(c))
        return error_at(e, ERR_INPUT, text_place(c, c->at), "expected a number, found the end of the line");
    const char *end = word_end(c->at);
    if (text_number(c->at, end, out) != end || !isfinite(*out))
        return error_at(e, ERR_INPUT, text_place(c, c->at), "expected a number, found '%.*s'", error_shown(end - c->at),
                        c->at);
    if (fabs(*out) > MESH_REACH) return error_at(e, ERR_INPUT, text_place(c, c->at), "number out of range");
    c->at = end;
    return true;
}

static bool take_vector(Cursor *c, Vec3 *out, Error *e) {
    return take_number(c, &out->x, e) && take_number(c, &out->y, e) && take_number(c, &out->z, e);
}

/* The second texture coordinate may be missing, a third is of no use here. */
static bool take_uv(Cursor *c, double uv[2], Error *e) {
    uv[1] = 0;
    return take_number(c, &uv[0], e) && (!find_word(c) || take_number(c, &uv[1], e));
}

/* An index at the cursor, counted from 1, or backwards from the last line of its kind. */
static bool take_index(Reader *r, LineKind kind, int *out, Error *e) {
    static const char *const what[] = {"vertex", "texture coordinate", "normal"};
    Cursor *c = &r->at;
    const char *start = c->at, *s = start + (*start == '-' || *start == '+');
    long value = 0, digits = 0;
    for (; *s >= '0' && *s <= '9' && digits <= INDEX_DIGITS; s++, digits++) value = 10 * value + (*s - '0');
    if (digits == 0) return error_at(e, ERR_INPUT, text_place(c, start), "expected the number of a %s", what[kind]);
    c->at = s;
    long index = *start == '-' ? r->seen[kind] - value : value - 1;
    if (digits > INDEX_DIGITS || index < 0 || index >= r->lines[kind] || value == 0)
        return error_at(e, ERR_INPUT, text_place(c, start), "there is no %s %.*s (the file has %d)", what[kind],
                        (int)(s - start), start, r->lines[kind]);
    *out = (int)index;
    return true;
}

/* v, v/vt, v//vn or v/vt/vn. */
static bool take_corner(Reader *r, int *vertex, Error *e) {
    Cursor *c = &r->at;
    int uv = -1, normal = -1;
    const char *start = c->at;
    if (!take_index(r, LINE_V, vertex, e)) return false;
    if (*c->at == '/') {
        c->at++;
        if (*c->at != '/' && c->at != word_end(start) && !take_index(r, LINE_VT, &uv, e)) return false;
    }
    if (*c->at == '/') {
        c->at++;
        if (c->at != word_end(start) && !take_index(r, LINE_VN, &normal, e)) return false;
    }
    if (c->at != word_end(start))
        return error_at(e, ERR_INPUT, text_place(c, c->at), "expected a corner as v, v/vt, v//vn or v/vt/vn");
    r->all_uv &= uv >= 0;
    r->all_normal &= normal >= 0;
    if (!r->corner[*vertex].is_there) r->corner[*vertex] = (Corner){true, uv, normal};
    return true;
}

static bool read_face(Reader *r, Error *e) {
    Mesh *m = r->mesh;
    find_word(&r->at);
    const char *start = r->at.at;
    int corners = 0, first = 0, last = 0;
    for (; find_word(&r->at); corners++) {
        int vertex;
        if (!take_corner(r, &vertex, e)) return false;
        if (corners == 0) first = vertex;
        if (corners >= 2) {
            m->triangle[m->ntriangles++] = (Triangle){{first, last, vertex}};
            if (m->ngroups) m->group[m->ngroups - 1].count++;
        }
        last = vertex;
    }
    if (corners < 3) return error_at(e, ERR_INPUT, text_place(&r->at, start), "a face of %d corners", corners);
    return true;
}

/* A group without a face is forgotten. */
static void start_group(Mesh *m, const char *name) {
    if (m->ngroups == 0 || m->group[m->ngroups - 1].count > 0) m->ngroups++;
    m->group[m->ngroups - 1] = (MeshGroup){name, m->ntriangles, 0};
}

/* The name is the rest of the line, blanks inside included. */
static bool read_group(Reader *r, Error *e) {
    const char *start = r->at.at, *end = start;
    if (find_word(&r->at)) start = end = r->at.at;
    while (!text_is_end(*end) && *end != '#') end++;
    while (end > start && (end[-1] == ' ' || end[-1] == '\t')) end--;
    char *name = arena_text(r->arena, start, (size_t)(end - start), e);
    if (name) start_group(r->mesh, name[0] ? name : "default");
    return name != NULL;
}

static bool read_line(Reader *r, Error *e) {
    LineKind kind = take_kind(&r->at);
    int i = r->seen[kind]++;
    switch (kind) {
    case LINE_V: return take_vector(&r->at, &r->mesh->position[i], e);
    case LINE_VT: return take_uv(&r->at, r->uv[i], e);
    case LINE_VN: return take_vector(&r->at, &r->normal[i], e);
    case LINE_F: return read_face(r, e);
    default: return kind == LINE_OTHER || kind != r->grouping || read_group(r, e);
    }
}

static bool take_memory(Reader *r, Error *e) {
    Mesh *m = r->mesh;
    int vertices = r->lines[LINE_V], groups = r->lines[r->grouping] + 1;
    m->position = ARENA_NEW(r->arena, Vec3, vertices, e);
    m->normal = ARENA_NEW(r->arena, Vec3, vertices, e);
    m->u = ARENA_NEW(r->arena, double, vertices, e);
    m->w = ARENA_NEW(r->arena, double, vertices, e);
    m->triangle = ARENA_NEW(r->arena, Triangle, r->triangles, e);
    m->group = ARENA_NEW(r->arena, MeshGroup, groups, e);
    r->uv = arena_array(r->arena, (size_t)r->lines[LINE_VT], sizeof *r->uv, e);
    r->normal = ARENA_NEW(r->arena, Vec3, r->lines[LINE_VN], e);
    r->corner = ARENA_NEW(r->arena, Corner, vertices, e);
    return e->kind == ERR_NONE;
}

/* In the end, since a face may stand before the lines that it names. */
static void fill_vertices(const Reader *r) {
    Mesh *m = r->mesh;
    if (!r->all_uv || m->ntriangles == 0) m->u = m->w = NULL;
    if (!r->all_normal || m->ntriangles == 0) m->normal = NULL;
    for (int v = 0; v < m->nvertices; v++) {
        Corner c = r->corner[v];
        if (!c.is_there) continue;
        if (m->u) m->u[v] = r->uv[c.uv][0], m->w[v] = r->uv[c.uv][1];
        if (m->normal) m->normal[v] = r->normal[c.normal];
    }
}

bool obj_parse(const Text *text, Arena *arena, Mesh *out, Error *e) {
    Reader r = {.at = text_start(text), .arena = arena, .mesh = out, .all_uv = true, .all_normal = true};
    *out = (Mesh){0};
    count_lines(&r);
    r.grouping = r.lines[LINE_G] ? LINE_G : r.lines[LINE_O] ? LINE_O : LINE_USEMTL;
    if (r.lines[LINE_V] == 0) return error_at(e, ERR_INPUT, (Place){.file = text->name}, "no vertices");
    if (!take_memory(&r, e)) return false;
    out->nvertices = r.lines[LINE_V];
    if (r.lines[r.grouping]) start_group(out, "default");
    do {
        if (!read_line(&r, e)) return false;
    } while (next_line(&r.at));
    if (out->ngroups && out->group[out->ngroups - 1].count == 0) out->ngroups--;
    fill_vertices(&r);
    return true;
}
