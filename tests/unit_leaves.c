/* Leaves as patches of their own: they are the surface that the mesh samples, control points and all. */
#include <stdlib.h>
#include <string.h>

#include "dress/frame.h"
#include "dress/push.h"
#include "tap.h"

static Arena arena;
static Error error;
static unsigned state = 4711;

static double random_unit(void) {
    state = state * 1664525u + 1013904223u;
    return (state >> 8) / 16777216.0;
}

static void need(bool good) {
    if (good) return;
    error_print(&error, stderr);
    exit(1);
}

static Garment *read_garment(const char *name) {
    char path[128];
    Garment *g = ARENA_NEW(&arena, Garment, 1, &error);
    snprintf(path, sizeof path, "garments/%s.garment", name);
    need(g && garment_read(path, &arena, g, &error));
    return g;
}

static void split_at_random(Leaves *leaves, int npatches) {
    leaves_fill(leaves, 0);
    for (int k = 0; k < npatches; k++) {
        int level = (int)(random_unit() * (leaves->lattice->depth + 1)), cells = 1 << level;
        int a = (int)(random_unit() * cells), b = (int)(random_unit() * cells);
        leaves_split(leaves, (int)(random_unit() * npatches), level, a, b);
    }
}

static bool is_open(const Leaves *leaves, int level, int vertex) {
    const LatticeLevel *at = &leaves->lattice->level[level];
    int cells = 1 << leaves->lattice->depth, size = cells >> level;
    for (int k = at->first_cell[vertex]; k < at->first_cell[vertex + 1]; k++) {
        LatticeCell c = at->cell[k];
        if (leaves->level[(c.patch * cells + c.a * size) * cells + c.b * size] < level) return false;
    }
    return true;
}

/* The point of the displaced surface at a lattice place, by its definition. */
static Vec3 surface(const Push *p, const Patch *root, int patch, int i, int j) {
    const Lattice *l = p->lattice;
    Vec3 x = bezier_point(&root[patch], (double)i / l->side, (double)j / l->side, NULL, NULL);
    for (int level = 0; level <= l->depth; level++) {
        int id[4];
        double weight[4];
        lattice_weights(l, level, patch, i, j, id, weight, NULL, NULL);
        for (int k = 0; k < 4; k++) x = vec_mad(x, p->field.displacement[p->field.start[level] + id[k]], weight[k]);
    }
    return x;
}

static void leaves_are_the_surface(const char *name) {
    Figure figure = figure_reference();
    Body body;
    Fit fit;
    Lattice lattice;
    Leaves leaves;
    Push push;
    Sheet sheet;
    need(body_fit(body_default(), &figure, 16, &arena, &body, &error));
    need(fit_garment(read_garment(name), &figure, &body, &arena, &fit, &error));
    need(lattice_build(&fit, 4, 3, &arena, &lattice, &error) && leaves_reserve(&leaves, &lattice, &arena, &error));
    need(push_reserve(&push, &lattice, &arena, &error) && sheet_reserve(&sheet, &lattice, &arena, &error));
    Patch *root = ARENA_NEW(&arena, Patch, fit.npatches, &error);
    need(root != NULL);
    for (int p = 0; p < fit.npatches; p++)
        for (int k = 0; k < 16; k++) root[p].p[k / 4][k % 4] = vec(random_unit(), random_unit(), random_unit());
    split_at_random(&leaves, fit.npatches);
    for (int level = 0; level <= lattice.depth; level++)
        for (int v = 0; v < lattice.level[level].count; v++)
            if (is_open(&leaves, level, v))
                push.field.displacement[push.field.start[level] + v] = vec(random_unit(), random_unit(), random_unit());
    double worst = 0;
    int n = 0, cells = 1 << lattice.depth;
    for (int p = 0; p < fit.npatches; p++)
        for (int x = 0; x < cells; x++)
            for (int y = 0; y < cells; y++) {
                int level = leaf_at(&leaves, p, x, y), shift = lattice.depth - level;
                if (level < 0) continue;
                Patch leaf = field_leaf(&push.field, root, (LatticeCell){p, x >> shift, y >> shift}, level);
                int size = lattice.side >> level, step = size / 4;
                for (int i = 0; i <= size; i += step)
                    for (int j = 0; j <= size; j += step, n++) {
                        Vec3 a = bezier_point(&leaf, (double)i / size, (double)j / size, NULL, NULL);
                        Vec3 b = surface(&push, root, p, x * lattice.detail + i, y * lattice.detail + j);
                        worst = fmax(worst, vec_dist(a, b));
                    }
            }
    OK(n >= 25 * leaves_count(&leaves) && worst < 1e-13, "%s: %d leaves are the surface itself (%.1e)", name,
       leaves_count(&leaves), worst);

    tessellate(&sheet, &leaves);
    Edge *border = ARENA_NEW(&arena, Edge, 2 * sheet.nedges, &error);
    need(border != NULL);
    int *seen = ARENA_NEW(&arena, int, sheet.nvertices, &error), lost = 0;
    int count = sheet_borders(&sheet, &leaves, border);
    bool sound = true;
    for (int k = 0; k < count; k++) {
        seen[border[k].v[0]] = seen[border[k].v[1]] = 1;
        sound = sound && border[k].v[0] < border[k].v[1];
        if (k) sound = sound && memcmp(&border[k - 1], &border[k], sizeof(Edge)) != 0;
    }
    for (int p = 0; p < fit.npatches; p++)
        for (int c = 0; c < 4; c++)
            lost += !seen[sheet.vertex[lattice_place(&lattice, p, c / 2 * lattice.side, c % 2 * lattice.side)]];
    OK(sound && lost == 0, "%s: %d edges on borders, each once, and every corner of a patch on them", name, count);
}

/* A thigh raised into the skirt: all but the vertices with offsets lie on the leaves. */
static void mesh_lies_on_leaves(void) {
    enum { MOST = 4096 };
    Figure figure = figure_reference();
    Body body;
    BodyFrame frame;
    Dresser *d;
    Mesh mesh;
    FrameStats stats;
    Pose pose = figure_rest_pose();
    Vec3 hip = figure.start[ROLE_LEFT_THIGH];
    Mat3 turn = mat_axis_angle(vec(1, 0, 0), -0.4);
    Rigid raised = {turn, vec_sub(hip, mat_apply(turn, hip))};
    pose.bone[ROLE_LEFT_THIGH] = pose.bone[ROLE_LEFT_SHIN] = pose.bone[ROLE_LEFT_FOOT] = raised;
    need(body_fit(body_default(), &figure, 16, &arena, &body, &error));
    need(body_frame_init(&frame, &body, 1, &arena, &error));
    need(dresser_open(read_garment("paper-skirt"), &figure, &body, &(DressOptions){0}, &arena, &d, &error));
    body_frame_pose(&frame, &pose);
    dresser_frame(d, &frame, 0, true, &mesh, &stats);
    static LeafPatch leaf[MOST];
    int n = dresser_leaves(d, LEAVES_CELLS, leaf, MOST), corners = 0, on = 0;
    for (int k = 0; k < n; k++)
        for (int c = 0; c < 4; c++, corners++)
            for (int v = 0; v < mesh.nvertices; v++)
                if (vec_dist(mesh.position[v], leaf[k].patch.p[c / 2 * 3][c % 2 * 3]) < 2e-6) {
                    on++;
                    break;
                }
    OK(n == stats.cells && stats.displacement > 0.02, "%d leaves of a skirt that was moved by %.0f mm", n,
       1000 * stats.displacement);
    OK(on >= corners * 9 / 10, "%d of %d corners of leaves are vertices of the mesh", on, corners);
    OK(dresser_leaves(d, LEAVES_CELLS, leaf, 1) == n, "the number of leaves does not depend on the room for them");
    OK(dresser_leaves(d, LEAVES_BY_RULE, NULL, 0) == stats.leaves && stats.leaves < n, "the rule alone makes %d leaves",
       stats.leaves);
}

int main(void) {
    leaves_are_the_surface("paper-skirt");
    leaves_are_the_surface("trousers");
    mesh_lies_on_leaves();
    arena_free(&arena);
    return tap_done();
}
