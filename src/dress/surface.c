/* The vertices of a leaf form a grid on its root patch, and on the field's patch of each level over it: these are
   evaluated as grids and added up. A place that patches share gets the value of the patch that owns it. A vertex
   that is on no grid of its owner's leaves, since only a finer neighbour needs it, is evaluated by itself. */
#include "dress/surface.h"

#include <string.h>

bool surface_reserve(Surface *s, const Lattice *lattice, Arena *arena, Error *e) {
    int points = (lattice->detail + 1) * (lattice->detail + 1);
    *s = (Surface){.lattice = lattice};
    for (int k = 0; k <= lattice->depth; k++)
        if (!grid_rows(lattice->detail << k, arena, &s->rows[k], e)) return false;
    s->grid = ARENA_NEW(arena, Vec3, points, e);
    s->part = ARENA_NEW(arena, Vec3, points, e);
    s->normal = ARENA_NEW(arena, Vec3, points, e);
    return s->grid && s->part && s->normal;
}

/* A leaf: cell of a level. */
typedef struct { LatticeCell cell; int level; } Leaf;

/* The next leaf of the sheet from *at on, which counts the deepest cells of all patches. */
static bool next_leaf(const Sheet *sheet, int *at, Leaf *leaf) {
    const Lattice *l = sheet->lattice;
    Leaves laid = {l, sheet->laid};
    int bits = l->depth, mask = (1 << bits) - 1, end = lattice_cells(l);
    for (; *at < end; ++*at) {
        int patch = *at >> (2 * bits), x = *at >> bits & mask, y = *at & mask, level = leaf_at(&laid, patch, x, y);
        if (level < 0) continue;
        *leaf = (Leaf){{patch, x >> (bits - level), y >> (bits - level)}, level};
        ++*at;
        return true;
    }
    return false;
}

/* The points of a leaf on a patch over the cell that holds it, `above` levels above. */
static void leaf_points(const Surface *s, const Patch *patch, Leaf leaf, int above, Vec3 *out) {
    int detail = s->lattice->detail, mask = (1 << above) - 1;
    GridRows u = grid_part(&s->rows[above], (leaf.cell.a & mask) * detail, detail + 1);
    GridRows w = grid_part(&s->rows[above], (leaf.cell.b & mask) * detail, detail + 1);
    grid_points(patch, &u, &w, out, NULL);
}

/* Copies the values of a leaf's grid to the vertices that its patch owns. */
static void hand_out(const Sheet *sheet, Leaf leaf, const Vec3 *grid, Vec3 *out) {
    const Lattice *l = sheet->lattice;
    int stride = 1 << (l->depth - leaf.level), patch = leaf.cell.patch;
    int i0 = leaf.cell.a * l->detail * stride, j0 = leaf.cell.b * l->detail * stride;
    for (int i = i0; i <= i0 + l->detail * stride; i += stride)
        for (int j = j0; j <= j0 + l->detail * stride; j += stride, grid++) {
            int place = lattice_place(l, patch, i, j);
            LatticeIndex owner = l->owner[place];
            if (owner.patch == patch && owner.i == i && owner.j == j) out[sheet->vertex[place]] = *grid;
        }
}

void surface_points(const Surface *s, const Sheet *sheet, const Patch *root, Vec3 *out) {
    Leaf leaf;
    for (int at = 0; next_leaf(sheet, &at, &leaf);) {
        leaf_points(s, &root[leaf.cell.patch], leaf, leaf.level, s->grid);
        hand_out(sheet, leaf, s->grid, out);
    }
    for (int k = 0; k < sheet->nlone; k++)
        out[sheet->lone[k]] = lattice_point(s->lattice, root, sheet->place[sheet->lone[k]]);
}

void surface_field(const Surface *s, const Sheet *sheet, const Field *f, Vec3 *out) {
    unsigned levels = field_levels(f);
    int points = (s->lattice->detail + 1) * (s->lattice->detail + 1);
    Leaf leaf;
    if (!levels) memset(out, 0, (size_t)sheet->nvertices * sizeof *out);
    for (int at = 0; levels && next_leaf(sheet, &at, &leaf);) {
        for (int k = 0; k < points; k++) s->grid[k] = vec(0, 0, 0);
        for (int level = 0; level <= leaf.level; level++) {
            Patch patch;
            if (!(levels >> level & 1) || !field_patch(f, leaf.cell, leaf.level, level, &patch)) continue;
            leaf_points(s, &patch, leaf, leaf.level - level, s->part);
            for (int k = 0; k < points; k++) s->grid[k] = vec_add(s->grid[k], s->part[k]);
        }
        hand_out(sheet, leaf, s->grid, out);
    }
    for (int k = 0; k < sheet->nlone; k++) out[sheet->lone[k]] = field_at(f, levels, sheet->place[sheet->lone[k]]);
}

void surface_normals(const Surface *s, const Sheet *sheet, const Field *f, const Patch *root, Vec3 *out) {
    unsigned levels = field_levels(f);
    const GridRows *rows = &s->rows[0];
    int points = rows->n * rows->n;
    Leaf leaf;
    for (int at = 0; next_leaf(sheet, &at, &leaf);) {
        Patch patch = field_leaf(f, root, leaf.cell, leaf.level);
        grid_points(&patch, rows, rows, s->grid, s->normal);
        if (s->lattice->fit->patch[leaf.cell.patch].flip)
            for (int k = 0; k < points; k++) s->normal[k] = vec_scale(s->normal[k], -1);
        hand_out(sheet, leaf, s->normal, out);
    }
    for (int k = 0; k < sheet->nlone; k++)
        out[sheet->lone[k]] = field_normal(f, root, levels, sheet->place[sheet->lone[k]]);
}
