/* Numbering what patches share. Corners are shared if their control point has the same name, edges if their four
   control points have, in either direction; all other places belong to one patch. */
#include "dress/lattice.h"

#include <string.h>

/* Marks a place whose patches have no collider in common; no role has this bit. */
static const unsigned UNSHARED = 1u << 31;

/* Lattice coordinates of step k along a side. */
static void side_place(const Lattice *l, Side side, int k, int *i, int *j) {
    *i = side == SIDE_START ? 0 : side == SIDE_END ? l->side : k;
    *j = side == SIDE_TOP ? 0 : side == SIDE_BOTTOM ? l->side : k;
}

static int *slot(const Lattice *l, int patch, int i, int j) {
    return &l->place[(patch * (l->side + 1) + i) * (l->side + 1) + j];
}

/* The first side before this one that has the same names, in the same or in the opposite order. */
static bool find_twin(const Lattice *l, int patch, Side side, int *twin_patch, Side *twin, bool *reversed) {
    int mine[4], other[4];
    fit_side(&l->fit->patch[patch], side, mine);
    for (int p = 0; p <= patch; p++)
        for (int s = 0; s < (p < patch ? 4 : (int)side); s++) {
            fit_side(&l->fit->patch[p], (Side)s, other);
            bool same = true, back = true;
            for (int k = 0; k < 4; k++) {
                same = same && mine[k] == other[k];
                back = back && mine[k] == other[3 - k];
            }
            if (!same && !back) continue;
            *twin_patch = p;
            *twin = (Side)s;
            *reversed = !same;
            return true;
        }
    return false;
}

static int new_place(Lattice *l, int patch, int i, int j) {
    l->owner[l->nplaces] = (LatticeIndex){patch, i, j};
    return l->nplaces++;
}

static void number_side(Lattice *l, int patch, Side side) {
    int twin_patch = 0, i, j, ti, tj;
    Side twin = SIDE_START;
    bool reversed = false, shared = find_twin(l, patch, side, &twin_patch, &twin, &reversed);
    for (int k = 1; k < l->side; k++) {
        side_place(l, side, k, &i, &j);
        if (shared) side_place(l, twin, reversed ? l->side - k : k, &ti, &tj);
        *slot(l, patch, i, j) = shared ? *slot(l, twin_patch, ti, tj) : new_place(l, patch, i, j);
    }
}

static void number_places(Lattice *l, int *corner) {
    int end = l->side;
    for (int k = 0; k < l->fit->npoints; k++) corner[k] = -1;
    for (int p = 0; p < l->fit->npatches; p++) {
        const FitPatch *patch = &l->fit->patch[p];
        for (int c = 0; c < 4; c++) {
            int name = patch->point[(c / 2) * 12 + (c % 2) * 3], i = c / 2 * end, j = c % 2 * end;
            if (corner[name] < 0) corner[name] = new_place(l, p, i, j);
            *slot(l, p, i, j) = corner[name];
        }
        for (int s = 0; s < 4; s++) number_side(l, p, (Side)s);
        for (int i = 1; i < end; i++)
            for (int j = 1; j < end; j++) *slot(l, p, i, j) = new_place(l, p, i, j);
    }
}

/* A short sleeve ends above the elbow, but a bent arm brings the forearm to it, and a bent leg the foot to a skirt. So
   cloth that is worn over a bone of a limb counts as worn over the next bone too. */
static unsigned with_next_bones(unsigned collide) {
    unsigned next = 0;
    for (int r = 0; r + 1 < ROLE_COUNT; r++)
        if (role_limb((Role)r) > 0 && role_parent((Role)(r + 1)) == (Role)r) next |= (collide & 1u << r) << 1;
    return collide | next;
}

/* A place that patches share is worn over the parts that all of them are worn over: at a crotch, where the two legs
   touch, it cannot keep out of either. If they have no part in common, it is worn over the parts of all. */
static void mark_colliders(Lattice *l) {
    for (int place = 0; place < l->nplaces; place++) l->collide[place] = ~0u;
    for (int p = 0; p < l->fit->npatches; p++)
        for (int i = 0; i <= l->side; i++)
            for (int j = 0; j <= l->side; j++) l->collide[*slot(l, p, i, j)] &= l->fit->patch[p].collide;
    for (int p = 0; p < l->fit->npatches; p++)
        for (int i = 0; i <= l->side; i++)
            for (int j = 0; j <= l->side; j++) {
                unsigned *collide = &l->collide[*slot(l, p, i, j)];
                if (!*collide) *collide = UNSHARED;
                if (*collide & UNSHARED) *collide |= l->fit->patch[p].collide;
            }
    for (int place = 0; place < l->nplaces; place++)
        l->collide[place] = with_next_bones(l->collide[place] & ~UNSHARED);
}

static void mark_pins(Lattice *l) {
    for (int p = 0; p < l->fit->npatches; p++)
        for (int s = 0; s < 4; s++)
            for (int k = 0, i, j; l->fit->patch[p].pinned >> s & 1 && k <= l->side; k++) {
                side_place(l, (Side)s, k, &i, &j);
                l->pinned[*slot(l, p, i, j)] = true;
            }
}

/* Cells of a level that touch vertex (a, b) of a patch: up to four. */
static int cells_round(int cells, int patch, int a, int b, LatticeCell out[4]) {
    int n = 0;
    for (int x = a - 1; x <= a; x++)
        for (int y = b - 1; y <= b; y++)
            if (x >= 0 && x < cells && y >= 0 && y < cells) out[n++] = (LatticeCell){patch, x, y};
    return n;
}

/* Lists the cells round every vertex of a level: first their number, then they themselves. */
static void list_cells(const Lattice *l, LatticeLevel *level, int cells) {
    LatticeCell round[4];
    for (int pass = 0; pass < 2; pass++) {
        for (int p = 0; p < l->fit->npatches; p++)
            for (int a = 0; a <= cells; a++)
                for (int b = 0; b <= cells; b++) {
                    int v = level->vertex[(p * (cells + 1) + a) * (cells + 1) + b],
                        n = cells_round(cells, p, a, b, round);
                    if (pass == 1) memcpy(&level->cell[level->first_cell[v]], round, (size_t)n * sizeof *round);
                    level->first_cell[v] += n;
                }
        if (pass == 0) { /* numbers become starts */
            int sum = 0;
            for (int v = 0; v <= level->count; v++) {
                int n = level->first_cell[v];
                level->first_cell[v] = sum;
                sum += n;
            }
        } else { /* filling has moved each start to the next one's */
            for (int v = level->count; v > 0; v--) level->first_cell[v] = level->first_cell[v - 1];
            level->first_cell[0] = 0;
        }
    }
}

static LatticeStep step_at(int i, int stride, int cells) {
    int cell = i / stride < cells ? i / stride : cells - 1;
    double t = (double)(i - cell * stride) / stride, r = (double)(stride - (i - cell * stride)) / stride;
    return (LatticeStep){
        cell, {1 - t * t * (3 - 2 * t), 1 - r * r * (3 - 2 * r)}, {-6 * t * (1 - t) * cells, 6 * r * (1 - r) * cells}};
}

static bool build_level(Lattice *l, int number, int *of_place, Arena *arena, Error *e) {
    LatticeLevel *level = &l->level[number];
    int cells = 1 << number, n = cells + 1, stride = l->side / cells, most = l->fit->npatches * n * n;
    level->vertex = ARENA_NEW(arena, int, most, e);
    level->first_cell = ARENA_NEW(arena, int, most + 1, e);
    level->cell = ARENA_NEW(arena, LatticeCell, 4 * most, e);
    level->pinned = ARENA_NEW(arena, bool, most, e);
    level->step = ARENA_NEW(arena, LatticeStep, l->side + 1, e);
    if (!level->vertex || !level->first_cell || !level->cell || !level->pinned || !level->step) return false;
    for (int i = 0; i <= l->side; i++) level->step[i] = step_at(i, stride, cells);
    for (int k = 0; k < l->nplaces; k++) of_place[k] = -1;
    for (int p = 0; p < l->fit->npatches; p++)
        for (int a = 0; a < n; a++)
            for (int b = 0; b < n; b++) {
                int place = lattice_place(l, p, a * stride, b * stride);
                if (of_place[place] < 0) {
                    of_place[place] = level->count;
                    level->pinned[level->count++] = l->pinned[place];
                }
                level->vertex[(p * n + a) * n + b] = of_place[place];
            }
    list_cells(l, level, cells);
    return true;
}

bool lattice_build(const Fit *fit, int detail, int depth, Arena *arena, Lattice *out, Error *e) {
    int side = detail << depth, n = side + 1, most = fit->npatches * n * n;
    *out = (Lattice){.fit = fit, .detail = detail, .depth = depth, .side = side};
    out->place = ARENA_NEW(arena, int, most, e);
    out->owner = ARENA_NEW(arena, LatticeIndex, most, e);
    out->collide = ARENA_NEW(arena, unsigned, most, e);
    out->pinned = ARENA_NEW(arena, bool, most, e);
    out->basis = arena_array(arena, (size_t)n, sizeof *out->basis, e);
    out->basis_slope = arena_array(arena, (size_t)n, sizeof *out->basis_slope, e);
    int *scratch = ARENA_NEW(arena, int, most > fit->npoints ? most : fit->npoints, e);
    if (!out->place || !out->owner || !out->collide || !out->pinned || !out->basis || !out->basis_slope ||
        !scratch)
        return false;
    number_places(out, scratch);
    mark_colliders(out);
    mark_pins(out);
    for (int level = 0; level <= depth; level++)
        if (!build_level(out, level, scratch, arena, e)) return false;
    for (int i = 0; i < n; i++) bezier_basis((double)i / side, out->basis[i], out->basis_slope[i]);
    return true;
}

LatticeWeights lattice_weights(const Lattice *l, int number, LatticeIndex at) {
    const LatticeLevel *level = &l->level[number];
    const LatticeStep *u = &level->step[at.i], *w = &level->step[at.j];
    int n = (1 << number) + 1;
    const int *corner = &level->vertex[(at.patch * n + u->cell) * n + w->cell];
    LatticeWeights out;
    for (int k = 0; k < 4; k++) {
        int x = k / 2, y = k % 2;
        out.vertex[k] = corner[x * n + y];
        out.weight[k] = u->weight[x] * w->weight[y];
        out.du[k] = u->slope[x] * w->weight[y];
        out.dw[k] = u->weight[x] * w->slope[y];
    }
    return out;
}

Vec3 lattice_point(const Lattice *l, const Patch *root, int place) {
    LatticeIndex at = l->owner[place];
    return bezier_weighted(&root[at.patch], l->basis[at.i], l->basis[at.j]);
}

Vec3 lattice_outwards(const Lattice *l, int patch, Vec3 du, Vec3 dw) {
    Vec3 n = vec_cross(du, dw);
    return vec_unit_or(l->fit->patch[patch].flip ? vec_scale(n, -1) : n, vec(0, 1, 0));
}

Vec3 lattice_normal(const Lattice *l, const Patch *root, int place) {
    LatticeIndex at = l->owner[place];
    Vec3 du = bezier_weighted(&root[at.patch], l->basis_slope[at.i], l->basis[at.j]);
    Vec3 dw = bezier_weighted(&root[at.patch], l->basis[at.i], l->basis_slope[at.j]);
    return lattice_outwards(l, at.patch, du, dw);
}
