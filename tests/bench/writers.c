/* One mesh as a file, by our writers and by what people use: fprintf, and Draco's own program. */
#include <math.h>
#include <stdlib.h>

#include "bench.h"
#include "files/drc.h"
#include "files/obj.h"

typedef struct {
    Mesh mesh;
    ObjWriter obj;
    DrcWriter drc;
    char path[96], other[96], command[320];
} Sheet;

/* A wavy sheet with normals and parameters. */
static void make_sheet(Sheet *s, const char *folder, int vertices, Arena *arena) {
    Error e = {0};
    int rows = (int)sqrt(vertices), columns = vertices / rows, n = rows * columns;
    Mesh m = {.nvertices = n, .ntriangles = 2 * (rows - 1) * (columns - 1), .ngroups = 1};
    m.position = ARENA_NEW(arena, Vec3, n, &e);
    m.normal = ARENA_NEW(arena, Vec3, n, &e);
    m.u = ARENA_NEW(arena, double, n, &e);
    m.w = ARENA_NEW(arena, double, n, &e);
    m.triangle = ARENA_NEW(arena, Triangle, m.ntriangles, &e);
    m.group = ARENA_NEW(arena, MeshGroup, 1, &e);
    bench_need(m.position && m.normal && m.u && m.w && m.triangle && m.group, &e);
    for (int i = 0; i < n; i++) {
        double u = m.u[i] = (double)(i / columns) / (rows - 1), w = m.w[i] = (double)(i % columns) / (columns - 1);
        double slope = 0.1 * cos(20 * u) * 20;
        m.position[i] = vec(mesh_snap(u), mesh_snap(w), mesh_snap(0.1 * sin(20 * u)));
        m.normal[i] = vec_scale(vec(-slope, 0, 1), 1 / sqrt(slope * slope + 1));
    }
    for (int i = 0, t = 0; i + 1 < rows; i++)
        for (int j = 0; j + 1 < columns; j++) {
            int a = i * columns + j, b = a + columns;
            m.triangle[t++] = (Triangle){{a, b, b + 1}};
            m.triangle[t++] = (Triangle){{a, b + 1, a + 1}};
        }
    m.group[0] = (MeshGroup){"sheet", 0, m.ntriangles};
    *s = (Sheet){.mesh = m};
    snprintf(s->path, sizeof s->path, "%s/ours", folder);
    snprintf(s->other, sizeof s->other, "%s/other.obj", folder);
    snprintf(s->command, sizeof s->command,
             "draco_encoder -i %s -o %s/other.drc -qp 16 -qn 10 -qt 12 -cl 3 >%s/said", s->other, folder, folder);
}

static void our_obj(void *context) {
    Sheet *s = context;
    Error e = {0};
    bench_need(obj_write(&s->obj, s->path, &s->mesh, 1, NULL, &e), &e);
}

static void with_fprintf(void *context) {
    Sheet *s = context;
    const Mesh *m = &s->mesh;
    FILE *f = fopen(s->other, "w");
    fprintf(f, "# kitsuke: Y up, 1 units are a metre\n");
    for (int i = 0; i < m->nvertices; i++)
        fprintf(f, "v %.6f %.6f %.6f\n", m->position[i].x, m->position[i].y, m->position[i].z);
    for (int i = 0; i < m->nvertices; i++) fprintf(f, "vt %.6f %.6f\n", m->u[i], m->w[i]);
    for (int i = 0; i < m->nvertices; i++)
        fprintf(f, "vn %.6f %.6f %.6f\n", m->normal[i].x, m->normal[i].y, m->normal[i].z);
    fprintf(f, "g %s\n", m->group[0].name);
    for (int t = 0; t < m->ntriangles; t++) {
        int a = m->triangle[t].v[0] + 1, b = m->triangle[t].v[1] + 1, c = m->triangle[t].v[2] + 1;
        fprintf(f, "f %d/%d/%d %d/%d/%d %d/%d/%d\n", a, a, a, b, b, b, c, c, c);
    }
    fclose(f);
}

static void our_drc(void *context) {
    Sheet *s = context;
    Error e = {0};
    bench_need(drc_write(&s->drc, s->path, &s->mesh, 1, &(DrcOptions){0}, NULL, &e), &e);
}

static void draco_encoder(void *context) {
    Sheet *s = context;
    bench_need(system(s->command) == 0, &(Error){.text = "draco_encoder fails"});
}

static long long file_size(const char *path) {
    FILE *f = fopen(path, "r");
    if (!f) return -1;
    fseek(f, 0, SEEK_END);
    long long n = ftell(f);
    fclose(f);
    return n;
}

static void compare(Bench *b, int vertices, double obj_asked, double drc_asked) {
    Arena arena = {0};
    Sheet s;
    char scene[32];
    make_sheet(&s, bench_folder(b), vertices, &arena);
    snprintf(scene, sizeof scene, "%dk", vertices / 1000);
    Timing base = bench_time(with_fprintf, &s), time = bench_time(our_obj, &s);
    char command[256];
    snprintf(command, sizeof command, "cmp '%s' '%s'", s.path, s.other);
    bench_need(system(command) == 0, &(Error){.text = "the OBJ files differ"});
    bench_enter(b, (BenchRow){scene, "OBJ", file_size(s.path), "bytes", time, "fprintf", base, obj_asked});
    if (system("command -v draco_encoder >/dev/null") == 0) {
        base = bench_time(draco_encoder, &s);
        time = bench_time(our_drc, &s);
        bench_enter(b, (BenchRow){scene, "Draco", file_size(s.path), "bytes", time, "draco_encoder", base, drc_asked});
    }
    obj_writer_free(&s.obj);
    drc_writer_free(&s.drc);
    arena_free(&arena);
}

void bench_writers(Bench *b) {
    compare(b, 2000, 9, 4);
    compare(b, 20000, 9, 2.5);
}
