/* Pictures: curves that say what the pixels said, with few points, and nothing seen that is hidden. */
#include <stdlib.h>
#include <string.h>

#include "files/scene.h"
#include "tap.h"

static Arena arena;
static Error error;

static void need(bool good) {
    if (good) return;
    error_print(&error, stderr);
    exit(1);
}

enum { SIDE = 400 };

static bool asked(bool (*inside)(double x, double y), int x, int y) {
    return x >= 0 && y >= 0 && x < SIDE && y < SIDE && inside(x + 0.5, y + 0.5);
}

/* Marks the border of the region inside(x, y), asked at the middles of pixels. */
static void mark(Outline *o, bool (*inside)(double x, double y)) {
    outline_clear(o, 0, 0, SIDE, SIDE);
    for (int y = 0; y <= SIDE; y++)
        for (int x = 0; x <= SIDE; x++) {
            if (asked(inside, x, y) != asked(inside, x, y - 1)) outline_above(o, x, y);
            if (asked(inside, x, y) != asked(inside, x - 1, y)) outline_left(o, x, y);
        }
}

static bool in_disc(double x, double y) { return (x - 200) * (x - 200) + (y - 200) * (y - 200) < 150 * 150; }
static bool in_ring(double x, double y) {
    double r2 = (x - 200) * (x - 200) + (y - 200) * (y - 200);
    return r2 < 150 * 150 && r2 > 60 * 60;
}
static bool in_board(double x, double y) { return ((int)x / 40 + (int)y / 40) % 2 == 0; }
static bool in_slope(double x, double y) { return y > 150 + 0.13 * x && x > 20 && x < 380 && y < 390; }

static void curves(Outline *o) {
    mark(o, in_disc);
    OK(outline_next(o) && o->is_closed, "a disc is one closed line");
    NEAR(outline_area(o), PI * 150 * 150, 300, "of its area");
    double off = 0;
    for (int k = 0; k < o->count; k++)
        off = max_of(off, fabs(hypot(o->point[k].x - 200, o->point[k].y - 200) - 150));
    OK(off < 0.6, "whose points lie on the circle (%.2f pixels off)", off);
    OK(o->count > 20 && o->count < 100, "and are few: %d", o->count);
    OK(!outline_next(o), "and no more");

    mark(o, in_ring);
    int n = 0;
    double area[2] = {0, 0};
    while (outline_next(o)) area[n++ % 2] = outline_area(o);
    OK(n == 2, "a ring is two lines");
    NEAR(area[0] - area[1], PI * (150 * 150 - 60 * 60), 400, "with the area between them");

    mark(o, in_board);
    double sum = 0;
    for (n = 0; outline_next(o); n++) sum += o->is_closed ? outline_area(o) : 1e9;
    OK(n > 0 && sum > 0 && sum < 2.0 * SIDE * SIDE, "fields that touch at corners make closed lines");

    mark(o, in_slope);
    bool found = outline_next(o);
    OK(found && o->count <= 20, "a straight slope stays straight: %d points", o->count);

    outline_clear(o, 0, 0, SIDE, SIDE);
    for (int k = 50; k < 350; k++) outline_above(o, k, 100);
    for (int k = 100; k < 200; k++) outline_left(o, 350, k);
    OK(outline_next(o) && !o->is_closed, "a line with two ends is open");
    NEAR(outline_length(o), 400, 3, "and as long as it is");
    double ends = fabs(o->point[0].x - 50) + fabs(o->point[0].y - 100) + fabs(o->point[o->count - 1].y - 200);
    OK(ends < 1e-6 && !outline_next(o), "its ends stay where they are");
}

/* A ball of radius 1 about `centre`. */
static Mesh make_ball(Vec3 centre) {
    enum { N = 48 };
    Mesh m = {.nvertices = (N + 1) * (N + 1), .ntriangles = 2 * N * N};
    m.position = ARENA_NEW(&arena, Vec3, m.nvertices, &error);
    m.normal = ARENA_NEW(&arena, Vec3, m.nvertices, &error);
    m.triangle = ARENA_NEW(&arena, Triangle, m.ntriangles, &error);
    need(m.position && m.normal && m.triangle);
    Triangle *t = m.triangle;
    for (int i = 0; i <= N; i++)
        for (int j = 0; j <= N; j++) {
            double a = 2 * PI * i / N, b = PI * j / N;
            int v = i * (N + 1) + j;
            m.normal[v] = vec(sin(b) * sin(a), cos(b), sin(b) * cos(a));
            m.position[v] = vec_add(centre, m.normal[v]);
            if (i == N || j == N) continue;
            *t++ = (Triangle){{v, v + 1, v + N + 2}};
            *t++ = (Triangle){{v, v + N + 2, v + N + 1}};
        }
    return m;
}

static int count_label(const Raster *r, int label) {
    int n = 0;
    for (int k = 0; k < r->width * r->height; k++) n += r->label[k] == label;
    return n;
}

static void pixels(void) {
    Raster r;
    Camera camera = {scene_view(vec(0, 0, 1), 0, 0), {0, 0, 0}, 100};
    Mesh near = make_ball(vec(0, 0, 3)), far = make_ball(vec(0.5, 0, -3));
    need(raster_reserve(&r, SIDE, SIDE, &arena, &error));
    raster_clear(&r, &camera);
    raster_mesh(&r, &near, 1, RASTER_PAPER);
    NEAR(count_label(&r, 1), PI * 100 * 100, 150, "a ball covers its disc");
    int alone = count_label(&r, 1);
    raster_mesh(&r, &far, 2, RASTER_PAPER);
    OK(count_label(&r, 1) == alone, "what lies behind covers nothing of it");
    OK(count_label(&r, 2) > 5000 && count_label(&r, 2) < alone, "and is seen where it stands out");
    Vec3 front = raster_place(&r, vec(0, 0, 4)), behind = raster_place(&r, vec(0, 0, 1.9));
    Vec3 beside = raster_place(&r, vec(0, 1.5, -5));
    OK(raster_visible(&r, front, 0.001), "a point is seen before a ball");
    OK(!raster_visible(&r, behind, 0.001), "not behind it");
    OK(raster_visible(&r, beside, 0.001), "and beside it, however far");
    OK(!raster_visible(&r, raster_place(&r, vec(0, 7, 9)), 0.001), "and not outside the picture");
    int left = SIDE * 130 + 150, right = SIDE * 270 + 250;
    OK(r.tone[left] > r.tone[right], "light comes from the upper left");
    raster_clear(&r, &camera);
    for (int v = 0; v < near.nvertices; v++) near.normal[v] = vec_scale(near.normal[v], -1);
    for (int t = 0; t < near.ntriangles; t++) {
        int swap = near.triangle[t].v[1];
        near.triangle[t].v[1] = near.triangle[t].v[2];
        near.triangle[t].v[2] = swap;
    }
    raster_mesh(&r, &near, 1, 2);
    OK(count_label(&r, 2) > 0 && count_label(&r, 1) == 0, "inside out, its back side is before its front");
}

static void views(void) {
    Vec3 heading = vec(1, 0.4, 0); /* uphill, towards +x; its left is -z */
    Mat3 front = scene_view(heading, 0, 0), left = scene_view(heading, 90, 0), above = scene_view(heading, 30, 89);
    OK(vec_dist(front.r[2], vec(1, 0, 0)) < 1e-12, "the front view looks the figure in the face, level");
    OK(vec_dist(left.r[2], vec(0, 0, -1)) < 1e-12, "the left view stands to its left");
    OK(vec_dist(left.r[1], vec(0, 1, 0)) < 1e-12, "upright");
    OK(above.r[2].y > 0.999, "89 degrees look down");
    double off = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) off = max_of(off, fabs(vec_dot(above.r[i], above.r[j]) - (i == j)));
    NEAR(off, 0, 1e-12, "views are rotations");
    NEAR(vec_dot(vec_cross(above.r[0], above.r[1]), above.r[2]), 1, 1e-12, "and do not mirror");
}

/* Draws a scene to a text. */
static char *draw(const Scene *scene) {
    static Canvas canvas;
    Camera camera = {scene_view(vec(0, 0, 1), 0, 0), {0, 0, 0}, 40};
    FILE *f = tmpfile();
    if (!f) exit(1);
    need(canvas_reserve(&canvas, 120, 120, 8, &arena, &error));
    scene_draw(&canvas, scene, &camera, 3, 4, f);
    long n = ftell(f);
    char *text = ARENA_NEW(&arena, char, n + 1, &error);
    rewind(f);
    if (!text || fread(text, 1, (size_t)n, f) != (size_t)n) exit(1);
    fclose(f);
    return text;
}

static void scenes(void) {
    static Scene scene;
    Edge edge[2] = {{{24, 25}}, {{0, 1}}};
    Vec3 dots[3] = {{0, 0, 1.2}, {0, 0, 1.2}, {0, 0, -1.2}};
    scene.count = 1;
    scene.surface[0] = (SceneSurface){.mesh = make_ball(vec(0, 0, 0)), .is_closed = true, .nlines = 2, .line = edge,
                                      .ndots = 3, .dot = dots};
    char *text = draw(&scene), *again = draw(&scene);
    OK(strcmp(text, again) == 0, "the same scene, the same bytes");
    char *seen = strstr(text, "#9c1c12"), *hidden = strstr(text, "#8a8a8a");
    OK(seen && strstr(seen, "d=\"M600 600h0\"/>"), "a dot is drawn once, where it is");
    OK(hidden && strstr(hidden, "d=\"M600 600h0\"/>"), "and hinted at where it is hidden");
    OK(strstr(text, "stroke-width=\"9\" stroke-linecap=\"round\" d=\"M"), "there is a contour");
    OK(strlen(text) < 20000, "all in %zu bytes", strlen(text));
    scene.surface[0].is_closed = false;
    scene.surface[0].ndots = 0;
    OK(!strstr(draw(&scene), "#9c1c12"), "no dots, none drawn");
    scene.count = 0;
    OK(strlen(draw(&scene)) < 700, "an empty scene is an empty picture");
}

int main(void) {
    Outline o;
    need(outline_reserve(&o, SIDE, SIDE, &arena, &error));
    curves(&o);
    pixels();
    views();
    scenes();
    arena_free(&arena);
    return tap_done();
}
