/* A cell that is split gets new vertices on the surface, which bulges over its facets by millimetres: at 120 frames
   a second that is a violent jump. So a new vertex begins on the side or the diagonal of a facet, midway between two
   vertices of the coarser grid, and moves to the surface in a fraction of a second; before a cell is merged its
   vertices move back. A vertex may belong to several cells that were split at different times: the one that has
   moved farthest decides. */
#include "dress/morph.h"

#include <string.h>

static const double OPENS_IN = 0.2; /* seconds: 5 mm in that time need 0.75 m/s^2, as swaying on the spot does */

static int ncells(const Lattice *l, int level) { return l->fit->npatches << (2 * level); }

bool morph_reserve(Morph *m, const Lattice *lattice, Arena *arena, Error *e) {
    *m = (Morph){.lattice = lattice};
    for (int level = 0; level < lattice->depth; level++) {
        m->open[level] = ARENA_NEW(arena, double, ncells(lattice, level), e);
        if (!m->open[level]) return false;
    }
    m->share = ARENA_NEW(arena, float, lattice->nplaces, e);
    return m->share != NULL;
}

static LatticeCell cell_of(int level, int k) {
    int mask = (1 << level) - 1;
    return (LatticeCell){k >> (2 * level), k >> level & mask, k & mask};
}

/* Is a cell of a level split, by the levels of leaves over the deepest cells? */
static bool is_split(const Lattice *l, const unsigned char *leaf, int level, LatticeCell c) {
    int cells = 1 << l->depth, shift = l->depth - level;
    return leaf[(c.patch * cells + (c.a << shift)) * cells + (c.b << shift)] > level;
}

void morph_carry(Morph *m, double dt, bool restart, Leaves *leaves, Leaves *fresh) {
    const Lattice *l = m->lattice;
    double step = dt / OPENS_IN;
    for (int level = 0; level < l->depth; level++)
        for (int k = 0; k < ncells(l, level); k++) {
            LatticeCell c = cell_of(level, k);
            double *open = &m->open[level][k];
            bool wanted = is_split(l, leaves->level, level, c);
            *open = restart ? wanted : clamp(wanted ? *open + step : *open - step, 0, 1);
            if (wanted || *open <= 0) continue;
            leaves_split(leaves, c.patch, level + 1, 2 * c.a, 2 * c.b);
            leaves_split(fresh, c.patch, level + 1, 2 * c.a, 2 * c.b);
        }
}

void morph_copy(const Morph *from, Morph *to) {
    for (int level = 0; level < from->lattice->depth; level++)
        memcpy(to->open[level], from->open[level], (size_t)ncells(from->lattice, level) * sizeof *to->open[level]);
}

/* Are all vertices of a sheet on the surface? */
static bool is_open(const Morph *m, const Sheet *sheet) {
    for (int level = 0; level < m->lattice->depth; level++)
        for (int k = 0; k < ncells(m->lattice, level); k++)
            if (m->open[level][k] < 1 && is_split(m->lattice, sheet->laid, level, cell_of(level, k))) return false;
    return true;
}

/* Gives the places that a cell gets by splitting its share, if theirs is smaller. */
static void share_out(const Morph *m, LatticeCell c, int level) {
    const Lattice *l = m->lattice;
    int size = l->side >> level, step = 1 << (l->depth - level - 1), i0 = c.a * size, j0 = c.b * size;
    float open = (float)m->open[level][(c.patch << (2 * level)) + (c.a << level) + c.b];
    for (int i = 0; i <= size; i += step)
        for (int j = i & step ? 0 : step; j <= size; j += i & step ? step : 2 * step) {
            float *share = &m->share[lattice_place(l, c.patch, i0 + i, j0 + j)];
            if (*share < open) *share = open;
        }
}

/* The share of a vertex that is new on a grid. In the middle of a facet it has the largest of the facet's sides: so the
   middles that facets get beside a finer cell open and close with that. */
static float share_at(const Morph *m, int place, LatticeIndex at, int di, int dj) {
    float share = m->share[place];
    if (!di || !dj) return share;
    const int side[4][2] = {{di, 0}, {-di, 0}, {0, dj}, {0, -dj}};
    for (int k = 0; k < 4; k++) {
        float other = m->share[lattice_place(m->lattice, at.patch, at.i + side[k][0], at.j + side[k][1])];
        if (share < other) share = other;
    }
    return share;
}

/* Moves a vertex towards the middle of the two that it is between, if it is new on the grid whose neighbours are `step`
   places apart. */
static void move_vertex(const Morph *m, const Sheet *sheet, int v, int step, Vec3 *point) {
    const Lattice *l = m->lattice;
    LatticeIndex at = l->owner[sheet->place[v]];
    int di = at.i & step, dj = at.j & step;
    if (di + dj == 0 || ((at.i | at.j) & (step - 1))) return; /* on a coarser grid, or a finer one */
    double share = smoothstep(0, 1, share_at(m, sheet->place[v], at, di, dj));
    int before = sheet->vertex[lattice_place(l, at.patch, at.i - di, at.j - dj)];
    int after = sheet->vertex[lattice_place(l, at.patch, at.i + di, at.j + dj)];
    if (share < 1 && before >= 0 && after >= 0)
        point[v] = vec_lerp(vec_mid(point[before], point[after]), point[v], share);
}

void morph_points(const Morph *m, const Sheet *sheet, Vec3 *point) {
    const Lattice *l = m->lattice;
    if (is_open(m, sheet)) return;
    memset(m->share, 0, (size_t)l->nplaces * sizeof *m->share);
    for (int level = 0; level < l->depth; level++)
        for (int k = 0; k < ncells(l, level); k++)
            if (is_split(l, sheet->laid, level, cell_of(level, k))) share_out(m, cell_of(level, k), level);
    for (int level = 0; level < l->depth; level++)
        for (int v = 0; v < sheet->nvertices; v++)
            move_vertex(m, sheet, v, 1 << (l->depth - level - 1), point);
}
