/* Leaves as patches of their own: they are the surface that the mesh samples, control points and all. */
#include <string.h>

#include "specimen.h"
#include "dice.h"
#include "dress/push.h"

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
        LatticeWeights of = lattice_weights(l, level, (LatticeIndex){patch, i, j});
        for (int k = 0; k < 4; k++)
            x = vec_mad(x, p->field.displacement[p->field.start[level] + of.vertex[k]], of.weight[k]);
    }
    return x;
}

/* What is found leaf by leaf is what is found vertex by vertex. */
static void sheet_is_the_surface(const char *name, Push *push, const Leaves *leaves, const Patch *root, Sheet *sheet) {
    static Vec3 point[1 << 16], field[1 << 16], normal[1 << 16];
    const Lattice *l = push->lattice;
    const unsigned levels = (1u << LATTICE_LEVELS) - 1;
    double worst_field = 0, worst_normal = 0;
    int moved = 0;
    tessellate(sheet, leaves);
    surface_points(&push->surface, sheet, root, point);
    surface_field(&push->surface, sheet, &push->field, field);
    surface_normals(&push->surface, sheet, &push->field, root, normal);
    for (int v = 0; v < sheet->nvertices; v++) {
        Vec3 p = lattice_point(l, root, sheet->place[v]);
        moved += memcmp(&p, &point[v], sizeof p) != 0;
        worst_field = max_of(worst_field, vec_dist(field[v], field_at(&push->field, levels, sheet->place[v])));
        Vec3 n = field_normal(&push->field, root, levels, sheet->place[v]);
        worst_normal = max_of(worst_normal, vec_dist(normal[v], n));
        Vec3 plain = field_normal(&push->field, root, 0, sheet->place[v]);
        worst_normal = max_of(worst_normal, vec_dist(lattice_normal(l, root, sheet->place[v]), plain));
    }
    OK(sheet->nedges <= lattice_edges(l), "%s: no more edges than there is room for (%d)", name, sheet->nedges);
    OK(moved == 0, "%s: %d vertices on the root patches, %d beside their leaves' grids (%d differ)", name,
       sheet->nvertices, sheet->nlone, moved);
    OK(worst_field < 1e-12 && worst_normal < 1e-9, "%s: displacement and normals too (%.2g, %.2g)", name, worst_field,
       worst_normal);
}

/* The edge between two vertices, -1: it is not listed. */
static int edge_between(const Edge *edge, int n, int a, int b) {
    int k = 0;
    while (k < n && (edge[k].v[0] != (a < b ? a : b) || edge[k].v[1] != (a < b ? b : a))) k++;
    return k < n ? k : -1;
}

/* Walks round every leaf, from vertex to vertex of the sheet: the edges on the way are the borders, and all of them. */
static void borders_go_round(const char *name, const Sheet *sheet, const Leaves *leaves, const Edge *border, int n) {
    static const int way[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const Lattice *l = sheet->lattice;
    int cells = 1 << l->depth, missing = 0, walked = 0;
    bool *met = calloc((size_t)n, sizeof *met);
    for (int at = 0; at < lattice_cells(l); at++) {
        int p = at / (cells * cells), x = at / cells % cells, y = at % cells, level = leaf_at(leaves, p, x, y);
        int i = x * l->detail, j = y * l->detail, size = l->side >> (level < 0 ? 0 : level);
        int last = sheet->vertex[lattice_place(l, p, i, j)];
        for (int k = 0; level >= 0 && k < 4 * size; k++) {
            i += way[k / size][0], j += way[k / size][1];
            int v = sheet->vertex[lattice_place(l, p, i, j)];
            if (v < 0 || v == last) continue; /* none here, or a pole */
            int edge = edge_between(border, n, last, v);
            walked++;
            missing += edge < 0;
            if (edge >= 0) met[edge] = true;
            last = v;
        }
    }
    int needless = 0;
    for (int b = 0; b < n; b++) needless += !met[b];
    free(met);
    OK(missing == 0 && needless == 0, "%s: %d edges round the leaves, %d are missing, %d needless", name, walked,
       missing, needless);
}

static void leaves_are_the_surface(const char *name) {
    Specimen c;
    Push push;
    specimen_open(&c, name, 4, 3);
    Scene *s = &c.scene;
    Leaves *leaves = &c.leaves;
    const Lattice *lattice = &c.lattice;
    const Sheet *sheet = &c.sheet;
    Patch *root = c.root;
    int npatches = c.fit.npatches;
    need(s, push_reserve(&push, lattice, &s->arena, &s->error));
    for (int p = 0; p < npatches; p++)
        for (int k = 0; k < 16; k++) root[p].p[k / 4][k % 4] = dice_point();
    specimen_split_at_random(&c);
    for (int level = 0; level <= lattice->depth; level++)
        for (int v = 0; v < lattice->level[level].count; v++)
            if (is_open(leaves, level, v)) push.field.displacement[push.field.start[level] + v] = dice_point();
    double worst = 0;
    int n = 0, cells = 1 << lattice->depth;
    for (int p = 0; p < npatches; p++)
        for (int x = 0; x < cells; x++)
            for (int y = 0; y < cells; y++) {
                int level = leaf_at(leaves, p, x, y), shift = lattice->depth - level;
                if (level < 0) continue;
                Patch leaf = field_leaf(&push.field, root, (LatticeCell){p, x >> shift, y >> shift}, level);
                int size = lattice->side >> level, step = size / 4;
                for (int i = 0; i <= size; i += step)
                    for (int j = 0; j <= size; j += step, n++) {
                        Vec3 a = bezier_point(&leaf, (double)i / size, (double)j / size, NULL, NULL);
                        Vec3 b = surface(&push, root, p, x * lattice->detail + i, y * lattice->detail + j);
                        worst = max_of(worst, vec_dist(a, b));
                    }
            }
    OK(n >= 25 * leaves_count(leaves) && worst < 1e-13, "%s: %d leaves are the surface itself (%.1e)", name,
       leaves_count(leaves), worst);

    sheet_is_the_surface(name, &push, leaves, root, &c.sheet);
    Edge *border = ARENA_NEW(&s->arena, Edge, 2 * sheet->nedges, &s->error);
    int *seen = ARENA_NEW(&s->arena, int, sheet->nvertices, &s->error), lost = 0;
    need(s, border && seen);
    int count = sheet_borders(sheet, leaves, border);
    bool sound = true;
    for (int k = 0; k < count; k++) {
        seen[border[k].v[0]] = seen[border[k].v[1]] = 1;
        sound = sound && border[k].v[0] < border[k].v[1];
        if (k) sound = sound && memcmp(&border[k - 1], &border[k], sizeof(Edge)) != 0;
    }
    for (int p = 0; p < npatches; p++)
        for (int k = 0; k < 4; k++)
            lost += !seen[sheet->vertex[lattice_place(lattice, p, k / 2 * lattice->side, k % 2 * lattice->side)]];
    borders_go_round(name, sheet, leaves, border, count);
    OK(sound && lost == 0, "%s: %d edges on borders, each once, and every corner of a patch on them", name, count);
    arena_free(&s->arena);
}

/* A field that is held by another one: near to it everywhere, its own where that is near anyhow. */
static void field_is_held(void) {
    const double most = 0.01;
    Specimen c;
    Field field, by;
    specimen_open(&c, "trousers", 4, 2);
    Scene *s = &c.scene;
    need(s, field_reserve(&field, &c.lattice, &s->arena, &s->error) &&
                field_reserve(&by, &c.lattice, &s->arena, &s->error));
    int n = field.start[LATTICE_LEVELS], level = c.lattice.depth, far = 0, moved = 0, shut = 0;
    leaves_fill(&c.leaves, 0);
    for (int k = 0; k < n; k++) {
        by.displacement[k] = vec_scale(dice_point(), 0.05);
        field.displacement[k] = vec_mad(by.displacement[k], dice_point(), k % 2 ? 0.002 : 0.05);
    }
    field_set_spot(&field.offset, 5, vec(0.03, 0, 0));
    field_set_spot(&by.offset, 6, vec(0, 0.03, 0));
    Vec3 kept = field.displacement[1];
    field_hold(&field, &by, most, &c.leaves);
    for (int k = 0; k < n; k++) {
        far += vec_dist(field.displacement[k], by.displacement[k]) > most * (1 + 1e-12);
        moved += vec_dist(field.displacement[k], by.displacement[k]) > 0;
    }
    for (int v = 0; v < c.lattice.level[level].count; v++) shut += !is_open(&c.leaves, level, v);
    OK(far == 0 && moved == n && shut == 0, "of %d vectors %d are held too loosely, and all cells are split", n, far);
    OK(vec_dist(field.displacement[1], kept) < 1e-15, "what is near stays");
    OK(vec_dist(field.offset.at[5], vec(most, 0, 0)) < 1e-12 &&
           vec_dist(field.offset.at[6], vec(0, 0.03 - most, 0)) < 1e-12,
       "offsets come and go at the same pace");
    arena_free(&s->arena);
}

/* Pushes piled up at the same vertices on all levels, in directions that nearly agree. */
static void nothing_beyond_the_cap_is_carried(void) {
    Specimen c;
    Field field;
    specimen_open(&c, "trousers", 4, 2);
    Scene *s = &c.scene;
    Pose rest = figure_rest_pose();
    need(s, field_reserve(&field, &c.lattice, &s->arena, &s->error));
    body_frame_pose(&s->posed, &rest);
    for (int k = 0; k < field.start[LATTICE_LEVELS]; k++) {
        Vec3 way = vec_unit_or(vec_mad(vec(1, 0, 0), dice_point(), 0.2), vec(1, 0, 0));
        field.displacement[k] = vec_scale(way, field.cap);
    }
    double before = 0, after = 0;
    for (int round = 0; round < 2; round++) {
        double *most = round ? &after : &before;
        for (int place = 0; place < c.lattice.nplaces; place++)
            *most = max_of(*most, vec_len(field_at(&field, field_levels(&field), place)));
        field_carry(&field, &s->posed, 0, false, &c.leaves);
    }
    OK(before > 2.5 * field.cap && after < 1.05 * field.cap, "of %.1f caps that have piled up %.2f are carried on",
       before / field.cap, after / field.cap);
    arena_free(&s->arena);
}

/* A thigh raised into the skirt: all but the vertices with offsets lie on the leaves. */
static void mesh_lies_on_leaves(void) {
    enum { MOST = 4096 };
    Scene s;
    Mesh mesh;
    FrameStats stats;
    Pose pose = figure_rest_pose();
    scene_open(&s, "paper-skirt");
    Dresser *d = scene_dresser(&s, (DressOptions){0});
    scene_leg(&s, &pose, true, 23, 0);
    body_frame_pose(&s.posed, &pose);
    dresser_frame(d, &s.posed, 0, TIE_AFRESH, &mesh, &stats);
    static Patch leaf[MOST];
    int n = dresser_leaves(d, LEAVES_CELLS, leaf, MOST), corners = 0, on = 0;
    for (int k = 0; k < n; k++)
        for (int c = 0; c < 4; c++, corners++)
            for (int v = 0; v < mesh.nvertices; v++)
                if (vec_dist(mesh.position[v], leaf[k].p[c / 2 * 3][c % 2 * 3]) < 2e-6) {
                    on++;
                    break;
                }
    OK(n == stats.cells && stats.displacement > 0.02, "%d leaves of a skirt that was moved by %.0f mm", n,
       1000 * stats.displacement);
    OK(on >= corners * 9 / 10, "%d of %d corners of leaves are vertices of the mesh", on, corners);
    OK(dresser_leaves(d, LEAVES_CELLS, leaf, 1) == n, "the number of leaves does not depend on the room for them");
    OK(dresser_leaves(d, LEAVES_BY_RULE, NULL, 0) == stats.leaves && stats.leaves < n, "the rule alone makes %d leaves",
       stats.leaves);
    arena_free(&s.arena);
}

int main(void) {
    leaves_are_the_surface("paper-skirt");
    leaves_are_the_surface("trousers");
    field_is_held();
    nothing_beyond_the_cap_is_carried();
    mesh_lies_on_leaves();
    return tap_done();
}
