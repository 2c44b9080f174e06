/* Planted cases of what verify must find, and of what it must leave alone. */
#include "dress/verify.h"

#include <stdlib.h>
#include <string.h>

#include "dress/border.h"
#include "dice.h"
#include "tap.h"

enum { ROOM = 20000 };

static Arena arena;

static Mesh empty(void) {
    Error e = {0};
    Mesh m = {0};
    m.position = ARENA_NEW(&arena, Vec3, ROOM, &e);
    m.triangle = ARENA_NEW(&arena, Triangle, ROOM, &e);
    m.group = ARENA_NEW(&arena, MeshGroup, 16, &e);
    return m;
}

static int put(Mesh *m, double x, double y, double z) {
    m->position[m->nvertices] = vec(x, y, z);
    return m->nvertices++;
}

static void face(Mesh *m, int a, int b, int c) { m->triangle[m->ntriangles++] = (Triangle){{a, b, c}}; }

static void group(Mesh *m, const char *name, int first) {
    m->group[m->ngroups++] = (MeshGroup){name, first, m->ntriangles - first};
}

/* low..high with outward triangles; without its top if `open`. */
static void box(Mesh *m, const char *name, Vec3 low, Vec3 high, bool open) {
    int v = m->nvertices, first = m->ntriangles;
    static const int quad[6][4] = {{0, 2, 3, 1}, {0, 1, 5, 4}, {0, 4, 6, 2}, {7, 5, 1, 3}, {7, 3, 2, 6}, {4, 5, 7, 6}};
    for (int k = 0; k < 8; k++) put(m, k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z);
    for (int q = 0; q < (open ? 5 : 6); q++) {
        face(m, v + quad[q][0], v + quad[q][1], v + quad[q][2]);
        face(m, v + quad[q][0], v + quad[q][2], v + quad[q][3]);
    }
    group(m, name, first);
}

static Mesh cube(double at, double size) {
    Mesh m = empty();
    box(&m, "cube", vec(at, at, at), vec(at + size, at + size, at + size), false);
    return m;
}

static Mesh triangle(Vec3 a, Vec3 b, Vec3 c) {
    Mesh m = empty();
    put(&m, a.x, a.y, a.z), put(&m, b.x, b.y, b.z), put(&m, c.x, c.y, c.z);
    face(&m, 0, 1, 2);
    return m;
}

static Verdict verify(const Mesh *body, const Mesh *garment) {
    Error e = {0};
    Solid solid;
    Verdict v = {0};
    bool good = solid_make(body, NULL, &arena, &solid, &e) &&
                verify_meshes(&solid, garment, 0.002, (Findings){0}, &arena, &v, &e);
    if (!good) OK(false, "verify: %s", e.text);
    return v;
}

static void count_kinds(void *context, const Finding *f) { ((int *)context)[f->kind]++; }

/* Two unit cubes, one moved by half along the diagonal. Each of the three faces of one that hold
   the other's corner is cut by a square whose border runs through both its triangles. */
static void test_cubes(void) {
    Mesh a = cube(0, 1), b = cube(0.5, 1), apart = cube(1.25, 1);
    Verdict v = verify(&a, &b);
    OK(v.inside == 1, "a corner of the other cube is inside (%d)", v.inside);
    NEAR(v.deepest, 0.5, 0, "half a side deep");
    OK(v.worst == 0, "in the group that there is");
    OK(v.pairs == 18 && verify(&b, &a).pairs == 18, "18 pairs from either side (%d)", v.pairs);
    OK(v.borders == 0 && v.cracks == 0, "a cube has no border");
    v = verify(&a, &apart);
    OK(!v.pairs && !v.inside && v.worst < 0, "cubes apart");
    Mesh small = cube(0.25, 0.25);
    v = verify(&a, &small);
    OK(v.pairs == 0 && v.inside == 8, "inside without a crossing: 8 vertices, %d", v.inside);
    NEAR(v.deepest, 0.5, 0, "the depth of the corner that is deepest");
}

static void test_touching(void) {
    Mesh body = cube(0, 1), m;
    m = triangle(vec(0.5, 0.25, 1), vec(0.75, 0.25, 1), vec(0.75, 0.5, 1));
    Verdict v = verify(&body, &m);
    OK(v.pairs == 1 && v.inside == 0, "in the plane of a face, within a triangle of it: one pair (%d)", v.pairs);
    m = triangle(vec(0.5, 0.25, nextafter(1, 2)), vec(0.75, 0.25, nextafter(1, 2)), vec(0.75, 0.5, nextafter(1, 2)));
    v = verify(&body, &m);
    OK(v.pairs == 0 && v.inside == 0, "the next number above it: nothing");
    m = triangle(vec(0.5, 0.25, nextafter(1, 0)), vec(0.75, 0.25, nextafter(1, 0)), vec(0.75, 0.5, nextafter(1, 0)));
    v = verify(&body, &m);
    OK(v.pairs == 0 && v.inside == 3, "the next number below it: three vertices inside (%d)", v.inside);
    m = triangle(vec(1, 1, 1), vec(2, 1, 2), vec(1, 2, 2));
    v = verify(&body, &m);
    int at_corner = 0;
    for (int t = 0; t < body.ntriangles; t++)
        for (int k = 0; k < 3; k++) at_corner += body.triangle[t].v[k] == 7;
    OK(v.pairs == at_corner && !v.inside, "a shared corner: a pair with each of %d triangles (%d)", at_corner, v.pairs);
    m = triangle(vec(0, 0, 2), vec(1, 0, 2), vec(0, 0, 2));
    OK(verify(&body, &m).pairs == 0, "a collapsed triangle apart");
    m = triangle(vec(0.2, 0.1, 0.5), vec(0.2, 0.1, 2), vec(0.2, 0.1, 2));
    v = verify(&body, &m);
    OK(v.pairs == 1 && v.inside == 1, "one that pierces a face is a pair (%d)", v.pairs);
    m = triangle(vec(3, 3, 1), vec(4, 3, 1), vec(3, 4, 1));
    OK(verify(&body, &m).pairs == 0, "in the plane of a face, beside it");
    m = triangle(vec(-9, -9, 1), vec(30, -9, 1), vec(-9, 30, 1));
    v = verify(&body, &m);
    OK(v.pairs == 10 && v.inside == 0, "in its plane, all round it: two triangles lie in it, eight touch it (%d)",
       v.pairs);
}

static Shells shells(const Mesh *m) {
    Error e = {0};
    Shells s = {0};
    if (!shells_find(m, NULL, &arena, &s, &e)) OK(false, "shells: %s", e.text);
    return s;
}

static bool holds(const Shells *s, double x, double y, double z) { return shell_holds(&s->shell[0], vec(x, y, z)); }

static void turn(Mesh *m, int t) {
    Triangle x = m->triangle[t];
    m->triangle[t] = (Triangle){{x.v[0], x.v[2], x.v[1]}};
}

/* The ray up from the points passes sides and corners of the faces exactly. */
static void test_rays(void) {
    Mesh body = cube(0, 1), octahedron = empty();
    static const double ends[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    int wrong = 0, good = 0;
    for (int k = 0; k < 6; k++) put(&octahedron, ends[k][0], ends[k][1], ends[k][2]);
    for (int k = 0; k < 8; k++) {
        int x = k & 1, y = 2 + (k >> 1 & 1), z = 4 + (k >> 2), odd = (k ^ k >> 1 ^ k >> 2) & 1;
        face(&octahedron, x, odd ? z : y, odd ? y : z);
    }
    Shells cubes = shells(&body), eight = shells(&octahedron);
    OK(cubes.count == 1 && !cubes.open && !cubes.inverted, "a cube is a shell");
    OK(eight.count == 1 && !eight.open && !eight.inverted, "an octahedron is a shell");
    for (int x = -9; x <= 9; x++)
        for (int y = -9; y <= 9; y++)
            for (int z = -9; z <= 9; z++) {
                Vec3 p = vec(x / 8.0, y / 8.0, z / 8.0);
                bool in_cube = x > 0 && x < 8 && y > 0 && y < 8 && z > 0 && z < 8;
                bool in_eight = abs(x) + abs(y) + abs(z) < 8;
                wrong += shell_holds(&cubes.shell[0], p) != in_cube;
                wrong += shell_holds(&eight.shell[0], p) != in_eight;
                good += in_cube + in_eight;
            }
    OK(wrong == 0 && good > 500, "points on a grid that meets all sides and corners: %d wrong", wrong);
}

static void test_shells(void) {
    Mesh two = empty();
    Error e = {0};
    box(&two, "left", vec(0, 0, 0), vec(1, 1, 1), false);
    box(&two, "right", vec(0.5, 0, 0), vec(2, 1, 1), false);
    OK(shells(&two).count == 2, "two limbs that overlap are two shells");
    Mesh dart = triangle(vec(0.875, 0.5, 0.5), vec(0.875, 0.5, 3), vec(0.9, 0.5, 3));
    Verdict v = verify(&two, &dart);
    OK(v.inside == 1, "a vertex in both is one vertex inside");
    NEAR(v.deepest, 0.375, 0, "as deep as in the one where it is deepest");
    bool wanted[2] = {true, false};
    Solid left;
    Mesh far = triangle(vec(1.5, 0.5, 0.5), vec(1.5, 0.5, 3), vec(1.6, 0.5, 3));
    bool good =
        solid_make(&two, wanted, &arena, &left, &e) && verify_meshes(&left, &far, 0.002, (Findings){0}, &arena, &v, &e);
    OK(good && v.pairs == 0 && v.inside == 0, "a part that is not wanted does not count");
    OK(verify(&two, &far).worst == 1, "and is the worst where it does");

    Mesh seam = empty(); /* every triangle with vertices of its own, as other programs write them */
    for (int t = 0; t < 12; t++) {
        for (int k = 0; k < 3; k++) {
            Vec3 p = two.position[two.triangle[t].v[k]];
            double zero = k == 0 ? -0.0 : 0;
            put(&seam, p.x == 0 ? zero : p.x, p.y == 0 ? zero : p.y, p.z == 0 ? zero : p.z);
        }
        face(&seam, 3 * t, 3 * t + 1, 3 * t + 2);
    }
    Shells s = shells(&seam);
    OK(s.count == 1 && s.open == 0, "vertices in one place are one");
    for (int t = 0; t < 12; t += 5) turn(&seam, t);
    s = shells(&seam);
    OK(s.count == 1 && s.open == 0 && holds(&s, 0.5, 0.25, 0.5) && !holds(&s, 0.5, 0.25, 1.5),
       "triangles that are turned against the others are turned back");
    for (int t = 0; t < two.ntriangles; t++) turn(&two, t);
    s = shells(&two);
    OK(s.inverted == 2 && holds(&s, 0.25, 0.5, 0.5), "a shell that is inside out holds what it holds");

    Mesh bowl = empty();
    box(&bowl, "bowl", vec(0, 0, 0), vec(1, 1, 1), true);
    s = shells(&bowl);
    OK(s.open == 1, "a box without its top is open");
    OK(holds(&s, 0.5, 0.3, 0.9) && !holds(&s, 0.5, 0.3, 1.1) && !holds(&s, 1.5, 0.3, 0.9),
       "and holds what it would with a lid");
}

/* A sheet of n x n squares; gap: how far the right half is moved away from the left one. */
static Mesh sheet(int n, double size, double gap) {
    Mesh m = empty();
    int row = n + 2;
    for (int i = 0; i <= n; i++)
        for (int k = 0; k <= n + 1; k++) put(&m, k <= n / 2 ? k * size : (k - 1) * size + gap, i * size, 0);
    for (int i = 0; i < n; i++)
        for (int k = 0; k <= n; k++) {
            if (k == n / 2) continue; /* between the halves */
            int a = i * row + k;
            face(&m, a, a + 1, a + row);
            face(&m, a + 1, a + row + 1, a + row);
        }
    return m;
}

/* A tube bent to a ring, whose two ends are `apart`. */
static Mesh bent_tube(double apart) {
    enum { AROUND = 8, ALONG = 24 };
    Mesh m = empty();
    for (int i = 0; i <= ALONG; i++)
        for (int k = 0; k < AROUND; k++) {
            double turn = (2 * PI - apart) * i / ALONG, angle = 2 * PI * k / AROUND, r = 1 + 0.3 * cos(angle);
            put(&m, r * cos(turn), r * sin(turn), 0.3 * sin(angle));
        }
    for (int i = 0; i < ALONG; i++)
        for (int k = 0; k < AROUND; k++) {
            int a = i * AROUND + k, b = i * AROUND + (k + 1) % AROUND;
            face(&m, a, b, a + AROUND);
            face(&m, b, b + AROUND, a + AROUND);
        }
    return m;
}

static Border border(const Mesh *m) {
    Error e = {0};
    Border b = {0};
    if (!border_find(m, 0.002, &arena, &b, &e)) OK(false, "border: %s", e.text);
    return b;
}

static void test_border(void) {
    Mesh m = sheet(10, 0.02, 0);
    Border b = border(&m);
    OK(b.pieces == 1 && b.ncracks == 0, "a sheet whose halves meet in the same coordinates is whole");
    m = sheet(10, 0.02, 0.001);
    b = border(&m);
    OK(b.pieces == 2 && b.ncracks == 22, "a crack of 1 mm: both lips, 11 vertices each (%d)", b.ncracks);
    NEAR(b.crack[0].distance, 0.001, 1e-15, "its width");
    for (int k = 6; k < 24; k += k == 11 ? 7 : 1) m.position[k].x -= 0.001; /* its first square is sewn on again */
    b = border(&m);
    OK(b.pieces == 1 && b.ncracks == 18, "one with a closed end: 9 vertices a lip (%d)", b.ncracks);
    m = sheet(10, 0.02, 0.003);
    OK(border(&m).ncracks == 0, "3 mm is a slit");
    m = sheet(40, 0.0005, 0.01);
    OK(border(&m).ncracks == 0, "a border of 0.5 mm edges is near itself along the border, no crack");

    m = sheet(10, 0.02, 0.001);
    for (int v = 0; v < m.nvertices; v++) { /* the halves upright, back to back: now their borders are two hems */
        double x = m.position[v].x - 0.1;
        m.position[v].z = fabs(x);
        m.position[v].x = x > 0 ? 0.001 : 0;
    }
    b = border(&m);
    OK(b.pieces == 2 && b.ncracks == 0, "two hems that touch are no crack (%d)", b.ncracks);

    m = bent_tube(0.001);
    b = border(&m);
    OK(b.pieces == 2 && b.ncracks == 0, "nor are the two ends of one tube (%d)", b.ncracks);

    m = empty(); /* one square of two triangles beside one whose side has a vertex in the middle */
    put(&m, 0, 0, 0), put(&m, 1, 0, 0), put(&m, 0, 1, 0), put(&m, 1, 1, 0), put(&m, 2, 0.5, 0), put(&m, 1, 0.5, 0);
    face(&m, 0, 1, 2), face(&m, 1, 3, 2), face(&m, 1, 4, 5), face(&m, 5, 4, 3);
    b = border(&m);
    OK(b.ncracks == 1 && b.crack[0].vertex == 5 && b.crack[0].distance == 0,
       "a vertex on the side of a triangle is a crack");
    int kinds[3] = {0};
    Error e = {0};
    Solid solid;
    Verdict v;
    Mesh body = cube(5, 1);
    bool good = solid_make(&body, NULL, &arena, &solid, &e) &&
                verify_meshes(&solid, &m, 0.002, (Findings){count_kinds, kinds}, &arena, &v, &e);
    OK(good && v.cracks == 1 && kinds[FINDING_CRACK] == 1, "and is told");
}

/* Half of them on a small grid, so that they touch in every way. */
static void test_heap(void) {
    int wrong = 0, some = 0, kinds[3] = {0};
    for (int round = 0; round < 60; round++) {
        Mesh m[2] = {empty(), empty()};
        for (int k = 0; k < 2; k++)
            for (int t = 0; t < 40; t++) {
                for (int c = 0; c < 3; c++) {
                    double x[3];
                    for (int i = 0; i < 3; i++) {
                        x[i] = dice_unit();
                        if (round & 1) x[i] = floor(8 * x[i]);
                    }
                    put(&m[k], x[0], x[1], x[2]);
                }
                face(&m[k], 3 * t, 3 * t + 1, 3 * t + 2);
            }
        Verdict v = verify(&m[0], &m[1]), back = verify(&m[1], &m[0]);
        wrong += v.pairs != back.pairs;
        some += v.pairs;
        Error e = {0};
        Solid solid;
        memset(kinds, 0, sizeof kinds);
        wrong += !solid_make(&m[0], NULL, &arena, &solid, &e) ||
                 !verify_meshes(&solid, &m[1], 0.002, (Findings){count_kinds, kinds}, &arena, &v, &e);
        wrong += kinds[FINDING_PAIR] != v.pairs || kinds[FINDING_INSIDE] != v.inside;
        wrong += kinds[FINDING_CRACK] != v.cracks;
        arena_reset(&arena);
    }
    OK(wrong == 0 && some > 1000, "heaps of triangles: the same pairs from either side, each told (%d pairs)", some);
}

static void test_nearest(void) {
    Error e = {0};
    Mesh m = empty();
    BoxTree tree;
    double x[9], worst = 0;
    int lost = 0;
    for (int t = 0; t < 500; t++) {
        for (int i = 0; i < 9; i++) x[i] = dice_unit();
        for (int c = 0; c < 9; c += 3) put(&m, x[0] + 0.2 * x[c], x[1] + 0.2 * x[c + 1], x[2] + 0.2 * x[c + 2]);
        face(&m, 3 * t, 3 * t + 1, 3 * t + 2);
    }
    OK(boxtree_build(&tree, m.position, m.triangle, NULL, m.ntriangles, &arena, &e), "a tree over 500 triangles");
    for (int k = 0; k < 500; k++) {
        for (int i = 0; i < 3; i++) x[i] = dice_unit();
        Vec3 p = vec(x[0], x[1], x[2]);
        double least = INFINITY;
        int found = 0, all = 0;
        Box b = {vec(x[0] - 0.1, x[1] - 0.1, x[2] - 0.1), p};
        for (int t = 0; t < m.ntriangles; t++) {
            const Vec3 *v = &m.position[3 * t];
            least = min_of(least, vec_dist(p, boxtree_triangle_point(p, v[0], v[1], v[2])));
            all += box_touches(box_of_triangle(m.position, m.triangle[t]), b);
        }
        BoxWalk walk = boxtree_walk(&tree, b);
        while (boxtree_next(&walk) >= 0) found++;
        lost += found != all;
        worst = max_of(worst, fabs(least - boxtree_nearest(&tree, p, NULL, NULL)));
    }
    NEAR(worst, 0, 0, "the nearest of all is the nearest in the tree");
    OK(lost == 0, "and all that touch a box are found");
    Vec3 q = boxtree_triangle_point(vec(2, 1, 0), vec(0, 0, 0), vec(1, 0, 0), vec(3, 0, 0));
    NEAR(vec_dist(q, vec(2, 0, 0)), 0, 0, "a collapsed triangle has a nearest point too");
}

/* Each allocation fails once. */
static void test_memory(void) {
    Mesh body = empty(), garment = sheet(4, 0.02, 0.001);
    Verdict v;
    int failures = 0, wrong = 0;
    bool good = false;
    box(&body, "bowl", vec(0, 0, -0.5), vec(1, 1, 0.5), true);
    for (int n = 1; n < 200 && !good; n++) {
        Arena small = {.fail_after = n};
        Error e = {0};
        Solid solid;
        good = solid_make(&body, NULL, &small, &solid, &e) &&
               verify_meshes(&solid, &garment, 0.002, (Findings){0}, &small, &v, &e);
        wrong += good == (e.kind == ERR_INTERNAL);
        failures += !good;
        arena_free(&small);
    }
    OK(good && failures > 20 && wrong == 0 && v.inside > 0, "%d allocations that fail, each told", failures);
}

int main(void) {
    test_cubes();
    test_touching();
    test_rays();
    test_shells();
    test_border();
    test_heap();
    test_nearest();
    test_memory();
    arena_free(&arena);
    return tap_done();
}
