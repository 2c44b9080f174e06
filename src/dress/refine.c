/* The quadtrees. All cells of one level are tested together: one set of boxes over their triangles is cheaper than many
   small ones, and the counts are the same. */
#include "dress/refine.h"

#include <string.h>

#include "geometry/boxtree.h"

bool leaves_reserve(Leaves *leaves, const Lattice *lattice, Arena *arena, Error *e) {
    leaves->lattice = lattice;
    leaves->level = ARENA_NEW(arena, unsigned char, lattice_cells(lattice), e);
    return leaves->level != NULL;
}

void leaves_fill(Leaves *leaves, int level) {
    memset(leaves->level, level, (size_t)lattice_cells(leaves->lattice));
}

void leaves_copy(const Leaves *from, Leaves *to) {
    memcpy(to->level, from->level, (size_t)lattice_cells(from->lattice));
}

/* Raises a whole cell of `level` to at least that level. */
static void raise_cell(Leaves *leaves, int patch, int level, int a, int b) {
    int depth = leaves->lattice->depth, cells = 1 << depth, size = 1 << (depth - level);
    for (int x = a * size; x < (a + 1) * size; x++)
        for (int y = b * size; y < (b + 1) * size; y++) {
            unsigned char *l = &leaves->level[(patch * cells + x) * cells + y];
            if (*l < level) *l = (unsigned char)level;
        }
}

void leaves_split(Leaves *leaves, int patch, int level, int a, int b) {
    for (int l = 1; l <= level; l++) {
        int shift = level - l + 1; /* the parent, whose four children become leaves */
        int pa = a >> shift, pb = b >> shift;
        for (int k = 0; k < 4; k++) raise_cell(leaves, patch, l, 2 * pa + k / 2, 2 * pb + k % 2);
    }
}

void leaves_open(Leaves *leaves, int level, int vertex) {
    const LatticeLevel *l = &leaves->lattice->level[level];
    for (int k = l->first_cell[vertex]; k < l->first_cell[vertex + 1]; k++)
        leaves_split(leaves, l->cell[k].patch, level, l->cell[k].a, l->cell[k].b);
}

int leaves_count(const Leaves *leaves) {
    int cells = 1 << leaves->lattice->depth, n = 0;
    for (int p = 0; p < leaves->lattice->fit->npatches; p++)
        for (int x = 0; x < cells; x++)
            for (int y = 0; y < cells; y++) n += leaf_at(leaves, p, x, y) >= 0;
    return n;
}

bool classifier_reserve(Classifier *c, const Lattice *lattice, Arena *arena, Error *e) {
    int n = lattice->detail, most = lattice_cells(lattice);
    *c = (Classifier){.lattice = lattice, .found_capacity = 16 * most * n + 4096};
    for (int level = 0; level <= lattice->depth; level++)
        if (!grid_rows(n << level, arena, &c->rows[level], e)) return false;
    c->position = ARENA_NEW(arena, Vec3, most * (n + 1) * (n + 1), e);
    c->written = ARENA_NEW(arena, Vec3, most * (n + 1) * (n + 1), e);
    c->triangle = ARENA_NEW(arena, Triangle, most * n * n * 2, e);
    c->cell = ARENA_NEW(arena, LatticeCell, most, e);
    c->next = ARENA_NEW(arena, LatticeCell, most, e);
    c->hit = ARENA_NEW(arena, bool, most, e);
    c->found = ARENA_NEW(arena, Crossing, c->found_capacity, e);
    return c->position && c->written && c->triangle && c->cell && c->next && c->hit && c->found &&
           crossing_reserve(&c->set, most * n * n * 2, arena, e);
}

/* The points of a cell on the global shape: its (detail + 1)^2 corners of facets. */
static void cell_points(const Classifier *c, const Patch *root, LatticeCell cell, int level, Vec3 *out) {
    int n = c->lattice->detail;
    GridRows u = grid_part(&c->rows[level], cell.a * n, n + 1), w = grid_part(&c->rows[level], cell.b * n, n + 1);
    grid_points(root, &u, &w, out, NULL);
}

void facets_of_cell(int n, int first, Triangle *out) {
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            int a = first + i * (n + 1) + j, b = a + n + 1;
            *out++ = (Triangle){{a, b, b + 1}};
            *out++ = (Triangle){{a, b + 1, a + 1}};
        }
}

/* The facets of `ncells` cells of one level. */
static void lay_cells(Classifier *c, const Patch *root, int level, int ncells) {
    int n = c->lattice->detail, npoints = (n + 1) * (n + 1);
    for (int k = 0; k < ncells; k++) {
        cell_points(c, &root[c->cell[k].patch], c->cell[k], level, c->position + k * npoints);
        facets_of_cell(n, k * npoints, c->triangle + k * 2 * n * n);
    }
}

static bool collides(const Classifier *c, const BodyFrame *body, int cell, int part) {
    return c->lattice->fit->patch[c->cell[cell].patch].collide & part_bit(body, part);
}

/* Marks the cells whose facets are crossed by an edge of one of their colliders. */
static void cross_cells(Classifier *c, const BodyFrame *body, int ncells, Classification *out) {
    int n = c->lattice->detail, ntriangles = 2 * n * n;
    for (int v = 0; v < ncells * (n + 1) * (n + 1); v++) c->written[v] = vec_scale(c->position[v], body->unit);
    crossing_build_triangles(&c->set, c->written, c->triangle, ncells * ntriangles);
    Box cloth = c->plain ? box_all() : crossing_box(&c->set);
    for (int p = 0; p < body->body->nparts; p++) {
        if (!(c->lattice->fit->collide & part_bit(body, p))) continue;
        const CrossingSet *edges = body_frame_edges(body, p, cloth);
        if (!edges) { /* nothing to find, but pairs all the same */
            out->count.pairs_all += (long long)body->body->part[p].nedges * ncells * ntriangles;
            continue;
        }
        int before = out->count.hits;
        int found = (c->plain ? crossing_find_plainly : crossing_find)(edges, &c->set, c->found, c->found_capacity,
                                                                       &out->count);
        if (found < out->count.hits - before) out->capped = true;
        for (int k = 0; k < found; k++) {
            int cell = c->found[k].triangle / ntriangles;
            if (collides(c, body, cell, p)) c->hit[cell] = true;
        }
    }
}

/* Tests `ncells` cells of one level: fills c->hit. Whether corners lie inside is asked only of cells that no edge
   crosses. */
static void test_cells(Classifier *c, const Patch *root, const BodyFrame *body, int level, int ncells,
                       Classification *out) {
    int n = c->lattice->detail, npoints = (n + 1) * (n + 1);
    for (int k = 0; k < ncells; k++) c->hit[k] = false;
    lay_cells(c, root, level, ncells);
    cross_cells(c, body, ncells, out);
    for (int k = 0; k < ncells; k++) {
        unsigned parts = c->lattice->fit->patch[c->cell[k].patch].collide;
        c->hit[k] = c->hit[k] || body_frame_any_inside(body, parts, c->position + k * npoints, npoints);
    }
    if (out->nodes == 0) out->hits = out->count.hits;
    out->nodes += ncells;
}

/* Lists the cells to split next: on the first level all that are hit, below it those that are hit among four
   children of which no two neighbours are. Returns their number. */
static int choose(const Classifier *c, int level, int ncells, LatticeCell *out) {
    int n = 0;
    for (int k = 0; k < ncells; k++) {
        const bool *family = &c->hit[k / 4 * 4];
        if (c->hit[k] && (level == 0 || !neighbours_hit(family))) out[n++] = c->cell[k];
    }
    return n;
}

/* Lets the corners of the cells that are hit move: for that, all cells round a corner must be split to its level. */
static void open_corners(const Classifier *c, int level, int ncells, Leaves *leaves) {
    const LatticeLevel *l = &c->lattice->level[level];
    int n = (1 << level) + 1;
    for (int k = 0; k < ncells; k++)
        for (int corner = 0; c->hit[k] && corner < 4; corner++) {
            LatticeCell cell = c->cell[k];
            leaves_open(leaves, level, l->vertex[(cell.patch * n + cell.a + corner / 2) * n + cell.b + corner % 2]);
        }
}

/* Parts from outside whose box touches a patch, bits 1 << role. */
static unsigned limbs_at(const Lattice *l, const Patch *root, const BodyFrame *body, int patch) {
    Box box = box_empty();
    unsigned limbs = 0;
    for (int k = 0; k < 16; k++) box_add(&box, root[patch].p[k / 4][k % 4]);
    for (int k = 0; k < body->body->nparts; k++)
        if (box_touches(box, body->box[k])) limbs |= part_bit(body, k);
    return limbs & ~l->fit->patch[patch].collide;
}

/* Is any place of a patch, of every other row and column, inside of a part that comes to it from outside? point: the
   places of the global shape, (side / 2 + 1)^2. */
static bool is_inside_limb(const Lattice *l, const BodyFrame *body, int patch, int part, const Vec3 *point) {
    enum { LOT = 64 };
    double distance[LOT];
    Vec3 at[LOT];
    int rows = l->side / 2 + 1, n = 0;
    for (int k = 0; k < rows * rows; k++) {
        bool may_be = !body_frame_far(body, part, point[k], 0) &&
                      !(l->collide[lattice_place(l, patch, k / rows * 2, k % rows * 2)] & part_bit(body, part));
        if (may_be) at[n++] = point[k];
        if (n < LOT && k + 1 < rows * rows) continue;
        if (n > 0) body_frame_distances(body, part, at, n, 0, distance);
        for (int i = 0; i < n; i++)
            if (distance[i] < 0) return true;
        n = 0;
    }
    return false;
}

/* Splits root patches once into which a limb reaches from outside, so that the cloth can give way there. The paper's
   rule does not know such limbs. */
static void open_to_limbs(const Classifier *c, const Patch *root, const BodyFrame *body, Leaves *leaves) {
    const Lattice *l = c->lattice;
    const GridRows *rows = &c->rows[l->depth - 1];
    for (int p = 0; p < l->fit->npatches; p++) {
        unsigned limbs = limbs_at(l, root, body, p);
        if (limbs) grid_points(&root[p], rows, rows, c->position, NULL);
        for (int k = 0; limbs && k < body->body->nparts; k++) {
            if (!(limbs & part_bit(body, k)) || !is_inside_limb(l, body, p, k, c->position)) continue;
            leaves_split(leaves, p, 1, 0, 0);
            break;
        }
    }
}

static int all_cells(const Lattice *l, int level, LatticeCell *out) {
    int n = 0, cells = 1 << level;
    for (int p = 0; p < l->fit->npatches; p++)
        for (int a = 0; a < cells; a++)
            for (int b = 0; b < cells; b++) out[n++] = (LatticeCell){p, a, b};
    return n;
}

void classify(Classifier *c, const Patch *root, const BodyFrame *body, SplitRule rule, Leaves *by_rule, Leaves *leaves,
              Classification *out) {
    const Lattice *l = c->lattice;
    *out = (Classification){0};
    int level = rule == SPLIT_UNIFORM ? l->depth : 0, ncells = all_cells(l, level, c->cell);
    leaves_fill(by_rule, level);
    leaves_fill(leaves, level);
    test_cells(c, root, body, level, ncells, out);
    if (rule == SPLIT_ADAPTIVE) open_to_limbs(c, root, body, leaves);
    out->leaves = ncells;
    out->depth = level;
    while (rule == SPLIT_ADAPTIVE && level < l->depth) {
        int nsplit = choose(c, level, ncells, c->next);
        if (!nsplit) break;
        level++;
        ncells = 0;
        for (int k = 0; k < nsplit; k++)
            for (int child = 0; child < 4; child++) {
                LatticeCell cell = {c->next[k].patch, 2 * c->next[k].a + child / 2, 2 * c->next[k].b + child % 2};
                c->cell[ncells++] = cell;
                if (child > 0) continue; /* it splits the parent, once */
                leaves_split(by_rule, cell.patch, level, cell.a, cell.b);
                leaves_split(leaves, cell.patch, level, cell.a, cell.b);
            }
        test_cells(c, root, body, level, ncells, out);
        open_corners(c, level, ncells, leaves);
        out->leaves += 3 * nsplit;
        out->depth = level;
    }
}
