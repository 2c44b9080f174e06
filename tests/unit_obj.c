/* OBJ files: the text is printf's, byte for byte, and reads back as it was. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "files/obj.h"
#include "folder.h"
#include "wave.h"
#include "tap.h"

/* The text as fprintf writes it. */
static size_t print_sheet(const Mesh *m, double unit, bool uv, bool normal, char *out, size_t n) {
    FILE *f = fmemopen(out, n, "w");
    fprintf(f, "# kitsuke: Y up, %.9g units are a metre\n", unit);
    for (int i = 0; i < m->nvertices; i++)
        fprintf(f, "v %.6f %.6f %.6f\n", m->position[i].x * unit, m->position[i].y * unit, m->position[i].z * unit);
    for (int i = 0; uv && i < m->nvertices; i++) fprintf(f, "vt %.6f %.6f\n", m->u[i], m->w[i]);
    for (int i = 0; normal && i < m->nvertices + m->nextra; i++)
        fprintf(f, "vn %.6f %.6f %.6f\n", m->normal[i].x, m->normal[i].y, m->normal[i].z);
    const Crease *crease = m->crease;
    for (int t = 0; t < m->ntriangles; t++) {
        if (t == 0) fprintf(f, "g left_back\n");
        if (t == 100) fprintf(f, "g right\n");
        fprintf(f, "f");
        for (int c = 0; c < 3; c++) {
            int i = m->triangle[t].v[c] + 1, own = i;
            if (crease < m->crease + m->ncreases && crease->corner == 3 * t + c) own = crease++->normal + 1;
            if (uv && normal) fprintf(f, " %d/%d/%d", i, i, own);
            else if (uv) fprintf(f, " %d/%d", i, i);
            else if (normal) fprintf(f, " %d//%d", i, own);
            else fprintf(f, " %d", i);
        }
        fprintf(f, "\n");
    }
    long length = ftell(f);
    fclose(f);
    return (size_t)length;
}

static bool same_text(ObjWriter *w, const Mesh *m, double unit) {
    static char wanted[1 << 17];
    Error e = {0};
    size_t n = print_sheet(m, unit, m->u != NULL, m->normal != NULL, wanted, sizeof wanted);
    return obj_format(w, m, unit, &e) && w->size == n && memcmp(w->text, wanted, n) == 0;
}

static void test_text(Vectors vectors) {
    static Wave wave;
    static const double units[] = {1, 100, 39.37007874015748, 1e6};
    ObjWriter w = {.vectors = vectors};
    bool good = true;
    make_wave(&wave);
    for (int round = 0; round < 3; round++)
        for (size_t k = 0; k < 4; k++) {
            Mesh m = wave.mesh;
            if (k & 1) m.u = m.w = NULL;
            if (k & 2) m.normal = NULL, m.ncreases = m.nextra = 0;
            good = good && same_text(&w, &m, units[k]);
        }
    OK(good, "vectors %d: OBJ text equals that of fprintf in any unit, with parameters and normals or without",
       vectors);
    obj_writer_free(&w);
}

/* Parameters and faces are kept; whatever they depend on must tell. */
static void test_what_changes(void) {
    static Wave wave;
    ObjWriter w = {0};
    make_wave(&wave);
    Mesh *m = &wave.mesh;
    bool good = same_text(&w, m, 1) && same_text(&w, m, 1);
    wave.position[7].y += 1;
    wave.normal[8].x = 0.25;
    good = good && same_text(&w, m, 1);
    OK(good, "the same faces once more, round other points");
    wave.w[VERTICES - 1] = 0.5;
    OK(same_text(&w, m, 1), "another parameter");
    wave.triangle[TRIANGLES - 1].v[2]--;
    OK(same_text(&w, m, 1), "another corner");
    wave.crease[2].corner++;
    OK(same_text(&w, m, 1), "another crease");
    m->ntriangles--;
    wave.group[2].count--;
    OK(same_text(&w, m, 1), "a triangle less");
    size_t before = w.size;
    wave.group[2].name = "upright";
    Error e = {0};
    OK(obj_format(&w, m, 1, &e) && w.size == before + 2, "another name");
    obj_writer_free(&w);
}

static void test_obj_write(void) {
    static Wave wave;
    ObjWriter w = {0};
    Error e = {0};
    make_wave(&wave);
    if (!OK(obj_format(&w, &wave.mesh, 1, &e), "a mesh is a text")) return;
    long long bytes = 0;
    const char *text = w.text;
    const char *path = in_folder("sheet.obj");
    OK(obj_write(&w, path, &wave.mesh, 1, &bytes, &e), "a file is written");
    struct stat info;
    OK(stat(path, &info) == 0 && info.st_size == bytes && w.text == text, "its size is told, the memory is used again");
    Mesh bad = wave.mesh;
    Vec3 nowhere[VERTICES] = {{NAN, 0, 0}};
    bad.position = nowhere;
    OK(!obj_write(&w, path, &bad, 1, NULL, &e) && e.kind == ERR_INTERNAL, "a number that is not finite is refused");
    obj_writer_free(&w);
}

static bool same_mesh(const Mesh *a, const Mesh *b) {
    bool good = a->nvertices == b->nvertices && a->ntriangles == b->ntriangles &&
                memcmp(a->triangle, b->triangle, (size_t)a->ntriangles * sizeof(Triangle)) == 0 && a->normal && a->u &&
                a->w;
    for (int i = 0; good && i < a->nvertices; i++) {
        int n = i == 0 ? b->crease[0].normal : i; /* that of its first corner */
        good = a->position[i].x == b->position[i].x && a->position[i].y == b->position[i].y &&
               a->position[i].z == b->position[i].z && vec_dist(a->normal[i], b->normal[n]) < 2e-6 &&
               fabs(a->u[i] - b->u[i]) < 1e-6 && fabs(a->w[i] - b->w[i]) < 1e-6;
    }
    return good;
}

static void test_read_back(void) {
    static Wave wave;
    make_wave(&wave);
    for (int i = 0; i < VERTICES; i++) wave.position[i].z = round(1e6 * wave.position[i].z) / 1e6;
    Arena arena = {0};
    Error e = {0};
    Text text;
    Mesh m;
    OK(text_read(in_folder("sheet.obj"), 1 << 20, &arena, &text, &e) && obj_parse(&text, &arena, &m, &e) &&
           same_mesh(&m, &wave.mesh), "positions come back exactly, the rest too");
    OK(m.ngroups == 2 && strcmp(m.group[0].name, "left_back") == 0 && m.group[0].count == 100 &&
           m.group[1].first == 100 && m.group[1].count == TRIANGLES - 100,
       "groups come back, names without blanks, the empty one left out");
    arena_free(&arena);
}

static bool parse(const char *text, Arena *arena, Mesh *m, Error *e) {
    *e = (Error){0};
    return obj_parse(&(Text){"t.obj", text, strlen(text)}, arena, m, e);
}

#define SQUARE "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"

static void test_obj_parse(void) {
    Arena arena = {0};
    Error e;
    Mesh m;
    OK(parse(SQUARE "f 1 2 3 4", &arena, &m, &e) && m.ntriangles == 2 && m.triangle[1].v[0] == 0 &&
           m.triangle[1].v[1] == 2 && m.triangle[1].v[2] == 3 && !m.u && !m.normal && m.ngroups == 0,
       "a square without a final newline is a fan of two");
    OK(parse(SQUARE "f -4 -3 -2\r\nf -4/ -2/ -1/\r\n", &arena, &m, &e) && m.ntriangles == 2 && m.triangle[1].v[2] == 3,
       "negative indices, CRLF");
    OK(parse(SQUARE "f 1 2 \\\n 3 4 # four\n", &arena, &m, &e) && m.ntriangles == 2, "a continued line and a comment");
    OK(parse("f 1 2 3\n" SQUARE, &arena, &m, &e) && m.ntriangles == 1, "a face before its vertices");
    OK(parse(SQUARE "vt .5\nvt 1 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/2/1\n", &arena, &m, &e) && m.u[0] == 0.5 && m.w[0] == 0 &&
           m.w[1] == 1 && m.normal[2].z == 1,
       "one texture coordinate is enough");
    OK(parse(SQUARE "f 1/1/1 2/2/1 3/-1/-1\nvt .5 1\nvt 1 1\nvn 0 0 1\n", &arena, &m, &e) == false,
       "backwards from the last line so far there may be none");
    OK(parse(SQUARE "f 1/1/1 2/2/1 3/2/1\nvt .5\nvt 1 1\nvn 0 0 1\n", &arena, &m, &e) && m.u[0] == 0.5 && m.u[1] == 1 &&
           m.w[1] == 1 && m.normal[0].z == 1 && m.normal[2].z == 1,
       "a face before its texture coordinates and normals");
    OK(parse(SQUARE "vn 0 0 1\nf 1//1 2//1 3\n", &arena, &m, &e) && !m.normal,
       "normals that not every corner has are left out");
    OK(parse(SQUARE "o a\nusemtl x\nf 1 2 3\no b c \nusemtl x\nf 1 3 4\no d\n", &arena, &m, &e) && m.ngroups == 2 &&
           strcmp(m.group[1].name, "b c") == 0 && m.group[1].first == 1,
       "objects are groups where there are none, materials are not");
    OK(parse(SQUARE "usemtl x\nf 1 2 3\nusemtl y\nf 1 3 4\n", &arena, &m, &e) && m.ngroups == 2 &&
           strcmp(m.group[1].name, "y") == 0,
       "but where there are no objects either");
    OK(parse(SQUARE "f 1 2 3\ng a\nf 1 3 4\n", &arena, &m, &e) && m.ngroups == 2 &&
           strcmp(m.group[0].name, "default") == 0,
       "what comes before the first group is the default group");
    OK(parse("\n\nmtllib x.mtl\ns off\nvp 1\nl 1 2\nv 1 2 3 0.5 0.5 0.5\n", &arena, &m, &e) && m.nvertices == 1 &&
           m.ntriangles == 0,
       "other lines and colours are skipped");

    static const struct {
        const char *text, *wanted;
        int line, column;
    } bad[] = {
        {SQUARE "f 1 2 1000000000\n", "there is no vertex 1000000000 (the file has 4)", 5, 7},
        {SQUARE "f 1 2 99999999999999999999\n", "there is no vertex 9999999999", 5, 7},
        {SQUARE "f 1 2 0\n", "there is no vertex 0", 5, 7},
        {SQUARE "f 1 2 5\n", "there is no vertex 5", 5, 7},
        {SQUARE "f 1 2 -5\n", "there is no vertex -5", 5, 7},
        {SQUARE "f 1/1 2/1 3/1\n", "there is no texture coordinate 1", 5, 5},
        {SQUARE "f 1//2 2//2 3//2\n", "there is no normal 2", 5, 6},
        {SQUARE "f 1 2\n", "a face of 2 corners", 5, 3},
        {SQUARE "f 1 2 3x\n", "expected a corner", 5, 8},
        {SQUARE "f 1 2 x\n", "expected the number of a vertex", 5, 7},
        {SQUARE "f 1 2 3/1/1/1\n", "there is no texture coordinate 1", 5, 9},
        {SQUARE "f 1 2 -\n", "expected the number of a vertex", 5, 7},
        {"v 0 0\n", "expected a number, found the end of the line", 1, 6},
        {"v 0 0 1.5y\n", "expected a number, found '1.5y'", 1, 7},
        {"v 0 0 nan\n", "expected a number, found 'nan'", 1, 7},
        {"v 0 0 1e999\n", "expected a number, found '1e999'", 1, 7},
        {"v 0 -1e13 1\n", "number out of range", 1, 5},
        {"", "no vertices", 0, 0},
        {"hello\n", "no vertices", 0, 0},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        bool refused = !parse(bad[i].text, &arena, &m, &e) && e.kind == ERR_INPUT &&
                       strncmp(e.text, bad[i].wanted, strlen(bad[i].wanted)) == 0 && e.line == bad[i].line &&
                       e.column == bad[i].column;
        if (!OK(refused, "refused: %s", bad[i].wanted)) printf("# %s:%d:%d: %s\n", e.file, e.line, e.column, e.text);
    }
    static const char sample[] = SQUARE "vt 0 0\nvn 0 0 1\ng a b\nf 1/1/1 -3/1/1 \\\n3/1/1\n";
    int survived = 0;
    for (size_t n = 0; n <= strlen(sample); n++) {
        char *cut = malloc(n + 1); /* of that size, so that a sanitizer sees a byte too many */
        memcpy(cut, sample, n);
        cut[n] = 0;
        if (!parse(cut, &arena, &m, &e)) survived += e.kind == ERR_INPUT;
        else survived++;
        free(cut);
        arena_reset(&arena);
    }
    OK(survived == (int)strlen(sample) + 1, "cut at any byte it is read or refused");
    bool stopped = false;
    for (int k = 1; k < 20 && !stopped; k++) {
        arena.fail_after = k;
        stopped = parse(sample, &arena, &m, &e);
        if (!stopped && e.kind != ERR_INTERNAL) break;
    }
    OK(stopped, "each allocation may fail");
    arena_free(&arena);
}

int main(void) {
    if (!folder_make()) return 1;
    for (Vectors v = VECTORS_BEST; v < VECTORS_COUNT; v++)
        if (vectors_usable(v)) test_text(v);
    test_what_changes();
    test_obj_write();
    test_read_back();
    test_obj_parse();
    folder_remove();
    return tap_done();
}
