/* Draco files: what is decoded is what was given, within half a step of the quantisation. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "files/drc.h"
#include "folder.h"
#include "wave.h"
#include "tap.h"

/* A step is the largest extent, here 1.1 along x and z, cut in 2^bits - 1; floats add a little. */
static DrcWriter writer; /* of all files but one */

static double tolerance(int bits, double unit) { return (0.5 * 1.1 / (pow(2, bits) - 1) + 2.4e-7) * unit; }

static double distance(Vec3 a, Vec3 b) { return max_of(fabs(a.x - b.x), max_of(fabs(a.y - b.y), fabs(a.z - b.z))); }

/* original[i]: the vertex of `a` at the place of vertex i of b; false where there is none. */
static bool match_vertices(const Mesh *a, const Mesh *b, double unit, double reach, int *original) {
    for (int i = 0; i < b->nvertices; i++) {
        original[i] = -1;
        for (int k = 0; k < a->nvertices; k++)
            if (distance(vec_scale(a->position[k], unit), b->position[i]) <= reach) original[i] = k;
        if (original[i] < 0) return false;
    }
    return true;
}

static int rank(const int v[3]) { return v[0] < v[1] ? (v[0] < v[2] ? 0 : 2) : (v[1] < v[2] ? 1 : 2); }

static int compare_triangles(const void *a, const void *b) { return memcmp(a, b, sizeof(Triangle)); }

/* Turned so that the smallest index stands first, and sorted: equal for equal sets of oriented triangles. */
static void sort_triangles(const Mesh *m, const int *original, Triangle *out) {
    for (int t = 0; t < m->ntriangles; t++) {
        int v[3], first;
        for (int c = 0; c < 3; c++) v[c] = original ? original[m->triangle[t].v[c]] : m->triangle[t].v[c];
        first = rank(v);
        out[t] = (Triangle){{v[first], v[(first + 1) % 3], v[(first + 2) % 3]}};
    }
    qsort(out, (size_t)m->ntriangles, sizeof *out, compare_triangles);
}

static bool same_surface(const Mesh *a, const Mesh *b, double unit, double reach) {
    static Triangle wanted[TRIANGLES], found[TRIANGLES];
    static int original[VERTICES];
    if (b->ntriangles != a->ntriangles || b->nvertices != a->nvertices || !match_vertices(a, b, unit, reach, original))
        return false;
    sort_triangles(a, NULL, wanted);
    sort_triangles(b, original, found);
    bool good = memcmp(wanted, found, sizeof wanted) == 0;
    for (int i = 0; good && i < b->nvertices; i++)
        good = distance(b->normal[i], a->normal[original[i]]) < 0.01 && fabs(b->u[i] - a->u[original[i]]) < 2e-4 &&
               fabs(b->w[i] - a->w[original[i]]) < 2e-4;
    return good;
}

static void test_round_trip(void) {
    static Wave wave;
    make_wave(&wave);
    static const struct {
        DrcOptions options;
        double unit;
        int bits;
        const char *what;
    } cases[] = {
        {{0}, 1, 16, "default"},
        {{0}, 100, 16, "centimetres"},
        {{.position_bits = 9}, 1, 9, "9 bits"},
        {{.position_bits = 20, .speed = 1}, 1, 20, "20 bits, smallest"},
        {{.position_bits = 14, .speed = 11}, 1, 14, "14 bits, fastest"},
        {{.keep_order = true}, 1, 16, "order kept"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        Arena arena = {0};
        Error e = {0};
        Mesh m;
        long long bytes = 0;
        struct stat info;
        const char *path = in_folder("sheet.drc");
        bool good = drc_write(&writer, path, &wave.mesh, cases[k].unit, &cases[k].options, &bytes, &e) &&
                    stat(path, &info) == 0 && info.st_size == bytes && drc_read(path, &arena, &m, &e);
        good = good && same_surface(&wave.mesh, &m, cases[k].unit, tolerance(cases[k].bits, cases[k].unit));
        if (!OK(good, "the same triangles within half a step: %s, %lld bytes", cases[k].what, bytes))
            printf("# %s\n", e.text);
        if (cases[k].options.keep_order)
            OK(memcmp(m.triangle, wave.triangle, sizeof wave.triangle) == 0 &&
                   distance(m.position[VERTICES - 1], wave.position[VERTICES - 1]) < tolerance(16, 1),
               "vertices and triangles stay in order");
        arena_free(&arena);
    }
}

static size_t load(const char *path, char *data, size_t n) {
    FILE *f = fopen(path, "rb");
    size_t got = f ? fread(data, 1, n, f) : 0;
    if (f) fclose(f);
    return got;
}

/* A writer that has written much else, and a new one. */
static void test_same_bytes(void) {
    static Wave wave;
    static char first[20000], second[20000];
    make_wave(&wave);
    Error e = {0};
    DrcOptions options = {0};
    DrcWriter fresh = {0};
    bool good = drc_write(&writer, in_folder("a.drc"), &wave.mesh, 1, &options, NULL, &e) &&
                drc_write(&fresh, in_folder("b.drc"), &wave.mesh, 1, &options, NULL, &e);
    size_t n = load(in_folder("a.drc"), first, sizeof first);
    OK(good && n > 100 && n == load(in_folder("b.drc"), second, sizeof second) && memcmp(first, second, n) == 0,
       "the same mesh gives the same bytes");
    drc_writer_free(&fresh);
}

static void test_refusals(void) {
    static Wave wave;
    make_wave(&wave);
    Error e = {0};
    Arena arena = {0};
    Mesh m = wave.mesh;
    DrcOptions options = {0};
    wave.position[7].y = INFINITY;
    OK(!drc_write(&writer, in_folder("x.drc"), &m, 1, &options, NULL, &e) && e.kind == ERR_INTERNAL,
       "a number that is not finite is refused: %s", e.text);
    make_wave(&wave);
    e = (Error){0};
    OK(!drc_write(&writer, in_folder("x.drc"), &m, 1, &(DrcOptions){.position_bits = 31}, NULL, &e) &&
           e.kind == ERR_INTERNAL,
       "31 bits are refused: %s", e.text);
    e = (Error){0};
    OK(!drc_write(&writer, in_folder("none/x.drc"), &m, 1, &options, NULL, &e) && e.kind == ERR_OUTPUT,
       "a missing folder: %s", e.text);
    e = (Error){0};
    OK(!drc_read(in_folder("none.drc"), &arena, &m, &e) && e.kind == ERR_INPUT, "a missing file: %s", e.text);
    e = (Error){0};
    OK(!drc_read(folder, &arena, &m, &e) && e.kind == ERR_INPUT, "a folder: %s", e.text);
    e = (Error){0};
    folder_put("text.drc", "solid text\n", 11);
    OK(!drc_read(in_folder("text.drc"), &arena, &m, &e) && e.kind == ERR_INPUT, "a text: %s", e.text);
    arena_free(&arena);
}

/* The least x of the mesh stands as a float in the file; here it becomes another number. */
static void test_places(void) {
    static const float others[] = {NAN, INFINITY, 1e13f};
    static Wave wave;
    static char bytes[1 << 16];
    make_wave(&wave);
    wave.position[0].x = -1.2345678;
    float least = (float)wave.position[0].x;
    Error e = {0};
    bool good = drc_write(&writer, in_folder("a.drc"), &wave.mesh, 1, &(DrcOptions){0}, NULL, &e);
    size_t n = good ? load(in_folder("a.drc"), bytes, sizeof bytes) : 0, at = 0;
    while (at + sizeof least <= n && memcmp(bytes + at, &least, sizeof least) != 0) at++;
    OK(at + sizeof least <= n, "the least x stands in the file");
    for (size_t k = 0; at + sizeof least <= n && k < sizeof others / sizeof *others; k++) {
        Arena arena = {0};
        Mesh m;
        e = (Error){0};
        memcpy(bytes + at, &others[k], sizeof others[k]);
        folder_put("b.drc", bytes, n);
        OK(!drc_read(in_folder("b.drc"), &arena, &m, &e) && e.kind == ERR_INPUT, "%g is refused: %s",
           (double)others[k], e.text);
        arena_free(&arena);
    }
}

static void test_cut(void) {
    static char data[20000];
    size_t n = load(in_folder("a.drc"), data, sizeof data);
    Arena arena = {0};
    int refused = 0, tried = 0;
    for (size_t k = 0; k < n; k += k < 64 ? 1 : 37, tried++) {
        Error e = {0};
        Mesh m;
        folder_put("cut.drc", data, k);
        if (!drc_read(in_folder("cut.drc"), &arena, &m, &e) && e.kind == ERR_INPUT) refused++;
        arena_reset(&arena);
    }
    OK(refused == tried, "cut short it is refused (%d of %d)", refused, tried);
    arena_free(&arena);
}

/* Does the writer that has written many meshes write the bytes that a new one writes? */
static bool as_a_new_one(const Mesh *m, const DrcOptions *options) {
    DrcWriter fresh = {0};
    Error e = {0};
    char command[1024], one[256];
    snprintf(one, sizeof one, "%s", in_folder("used.drc"));
    bool good = drc_write(&writer, one, m, 1, options, NULL, &e) &&
                drc_write(&fresh, in_folder("fresh.drc"), m, 1, options, NULL, &e);
    drc_writer_free(&fresh);
    snprintf(command, sizeof command, "cmp -s '%s' '%s'", one, in_folder("fresh.drc"));
    return good && system(command) == 0;
}

/* Connectivities come again, with other points, other attributes, other speeds, more than are kept. */
static void test_again(void) {
    static Wave wave;
    int wrong = 0;
    for (int k = 0; k < 120; k++) {
        make_wave(&wave);
        Mesh m = wave.mesh;
        DrcOptions options = {.speed = k % 4 ? 0 : 1 + k / 4 % 11, .keep_order = k % 17 == 0};
        for (int v = 0; v < VERTICES; v++) wave.position[v].y += 0.01 * sin(k + 0.3 * v);
        m.ntriangles -= k * 7 % 11; /* less than 11, more than 8: some are forgotten in between */
        m.group[2].count = m.ntriangles - 100;
        if (k % 3 == 1) m.u = m.w = NULL;
        if (k % 5 == 1) m.normal = NULL;
        wrong += !as_a_new_one(&m, &options);
    }
    OK(wrong == 0, "a mesh is encoded as if none had been before it (%d of 120 are not)", wrong);
}

int main(void) {
    if (!folder_make()) return 1;
    test_round_trip();
    test_same_bytes();
    test_again();
    test_refusals();
    test_places();
    test_cut();
    folder_remove();
    drc_writer_free(&writer);
    return tap_done();
}
