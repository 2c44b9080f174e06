/* Stitching by shared numbers: first every leaf marks the lattice places of its own grid, then a
   facet looks along its sides for places that a finer neighbour has marked in between. */
#include "dress/tessellate.h"

#include <stdlib.h>
#include <string.h>

bool sheet_reserve(Sheet *s, const Lattice *lattice, Arena *arena, Error *e) {
    int places = lattice->nplaces, triangles = lattice_triangles(lattice), edges = lattice_edges(lattice);
    *s = (Sheet){.lattice = lattice};
    s->place = ARENA_NEW(arena, int, places, e);
    s->vertex = ARENA_NEW(arena, int, places, e);
    s->lone = ARENA_NEW(arena, int, places, e);
    s->triangle = ARENA_NEW(arena, Triangle, triangles, e);
    s->first_of_patch = ARENA_NEW(arena, int, lattice->fit->npatches + 1, e);
    s->edge = ARENA_NEW(arena, Edge, edges, e);
    s->first_edge = ARENA_NEW(arena, int, places, e);
    s->next_edge = ARENA_NEW(arena, int, edges, e);
    s->laid = ARENA_NEW(arena, unsigned char, lattice_cells(lattice), e);
    return s->place && s->vertex && s->lone && s->triangle && s->first_of_patch && s->edge && s->first_edge &&
           s->next_edge && s->laid;
}

static int vertex_at(Sheet *s, int patch, int i, int j) {
    int place = lattice_place(s->lattice, patch, i, j);
    if (s->vertex[place] < 0) {
        s->vertex[place] = s->nvertices;
        s->place[s->nvertices++] = place;
    }
    return s->vertex[place];
}

static void add_edge(Sheet *s, int a, int b) {
    int low = a < b ? a : b, high = a < b ? b : a, k = s->first_edge[low];
    while (k >= 0 && s->edge[k].v[1] != high) k = s->next_edge[k];
    if (k >= 0) return;
    s->edge[s->nedges] = (Edge){{low, high}};
    s->next_edge[s->nedges] = s->first_edge[low];
    s->first_edge[low] = s->nedges++;
}

/* A triangle whose corners are three; patches with a pole have none there. */
static void add_triangle(Sheet *s, bool flip, int a, int b, int c) {
    if (a == b || b == c || c == a) return;
    s->triangle[s->ntriangles++] = flip ? (Triangle){{a, c, b}} : (Triangle){{a, b, c}};
    add_edge(s, a, b);
    add_edge(s, b, c);
    add_edge(s, c, a);
}

/* One side of a facet or a leaf: so many lattice steps from a corner to the next, each by (di, dj). */
typedef struct { LatticeIndex from; int di, dj, steps; } GridSide;

static int side_place(const Sheet *s, const GridSide *side, int k) {
    return lattice_place(s->lattice, side->from.patch, side->from.i + k * side->di, side->from.j + k * side->dj);
}

/* Lists a facet's corner and the marked places on the side that begins there, up to the next corner. */
static int side_vertices(Sheet *s, GridSide side, int *out) {
    int n = 0;
    out[n++] = vertex_at(s, side.from.patch, side.from.i, side.from.j);
    for (int k = 1; k < side.steps; k++) {
        int v = s->vertex[side_place(s, &side, k)];
        if (v >= 0) out[n++] = v;
    }
    return n;
}

static void add_facet(Sheet *s, int patch, int i, int j, int stride) {
    bool flip = s->lattice->fit->patch[patch].flip;
    int ring[4 << LATTICE_DEPTH_MAX], n = 0;
    n += side_vertices(s, (GridSide){{patch, i, j}, 1, 0, stride}, ring);
    n += side_vertices(s, (GridSide){{patch, i + stride, j}, 0, 1, stride}, ring + n);
    n += side_vertices(s, (GridSide){{patch, i + stride, j + stride}, -1, 0, stride}, ring + n);
    n += side_vertices(s, (GridSide){{patch, i, j + stride}, 0, -1, stride}, ring + n);
    if (n == 4) {
        add_triangle(s, flip, ring[0], ring[1], ring[2]);
        add_triangle(s, flip, ring[0], ring[2], ring[3]);
        return;
    }
    int middle = vertex_at(s, patch, i + stride / 2, j + stride / 2); /* a finer neighbour: stride >= 2 */
    for (int k = 0; k < n; k++) add_triangle(s, flip, middle, ring[k], ring[(k + 1) % n]);
}

static void mark_leaf(Sheet *s, int patch, int i0, int j0, int stride) {
    int n = s->lattice->detail;
    for (int i = 0; i <= n; i++)
        for (int j = 0; j <= n; j++) vertex_at(s, patch, i0 + i * stride, j0 + j * stride);
}

static void lay_leaf(Sheet *s, int patch, int i0, int j0, int stride) {
    int n = s->lattice->detail;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) add_facet(s, patch, i0 + i * stride, j0 + j * stride, stride);
}

/* Is a place on the grid of a leaf of its owner? On a border between leaves, of any of them. */
static bool on_grid(const Lattice *l, const Leaves *leaves, int place) {
    LatticeIndex at = l->owner[place];
    int cells = 1 << l->depth, x = at.i / l->detail, y = at.j / l->detail;
    for (int k = 0; k < 4; k++) {
        int a = x - (k / 2 && x * l->detail == at.i), b = y - (k % 2 && y * l->detail == at.j);
        if (a < 0 || b < 0 || a >= cells || b >= cells) continue;
        int stride = 1 << (l->depth - leaves->level[(at.patch * cells + a) * cells + b]);
        if (at.i % stride == 0 && at.j % stride == 0) return true;
    }
    return false;
}

static void list_lone(Sheet *s, const Leaves *leaves) {
    s->nlone = 0;
    for (int v = 0; v < s->nvertices; v++)
        if (!on_grid(s->lattice, leaves, s->place[v])) s->lone[s->nlone++] = v;
}

void tessellate(Sheet *s, const Leaves *leaves) {
    const Lattice *l = s->lattice;
    int cells = 1 << l->depth;
    if (s->ntriangles && memcmp(s->laid, leaves->level, (size_t)lattice_cells(l)) == 0) return;
    memcpy(s->laid, leaves->level, (size_t)lattice_cells(l));
    s->made++;
    s->nvertices = s->ntriangles = s->nedges = 0;
    memset(s->vertex, -1, (size_t)l->nplaces * sizeof *s->vertex);
    for (int pass = 0; pass < 2; pass++) {
        if (pass == 1) memset(s->first_edge, -1, (size_t)l->nplaces * sizeof *s->first_edge);
        for (int p = 0; p < l->fit->npatches; p++) {
            s->first_of_patch[p] = s->ntriangles;
            for (int x = 0; x < cells; x++)
                for (int y = 0; y < cells; y++) {
                    int level = leaf_at(leaves, p, x, y);
                    if (level < 0) continue;
                    int stride = 1 << (l->depth - level);
                    if (pass == 0) mark_leaf(s, p, x * l->detail, y * l->detail, stride);
                    else lay_leaf(s, p, x * l->detail, y * l->detail, stride);
                }
        }
    }
    s->first_of_patch[l->fit->npatches] = s->ntriangles;
    list_lone(s, leaves);
}

Mesh sheet_mesh(const Sheet *s, Vec3 *position) {
    return (Mesh){.nvertices = s->nvertices,
                  .ntriangles = s->ntriangles,
                  .nedges = s->nedges,
                  .position = position,
                  .triangle = s->triangle,
                  .edge = s->edge};
}

/* Lists the edges that the mesh has along one side of a leaf. */
static int side_borders(const Sheet *s, GridSide side, Edge *out) {
    int n = 0, last = s->vertex[side_place(s, &side, 0)];
    for (int k = 1; k <= side.steps; k++) {
        int v = s->vertex[side_place(s, &side, k)];
        if (v < 0 || v == last) continue; /* no vertex here, or a pole */
        out[n++] = last < v ? (Edge){{last, v}} : (Edge){{v, last}};
        last = v;
    }
    return n;
}

static int by_vertices(const void *a, const void *b) {
    const Edge *p = a, *q = b;
    int c = p->v[0] == q->v[0]; /* the first in which they differ, if any */
    return (p->v[c] > q->v[c]) - (p->v[c] < q->v[c]);
}

/* Neighbours list a border once each: twice in all, however different their levels. */
int sheet_borders(const Sheet *s, const Leaves *leaves, Edge *out) {
    const Lattice *l = s->lattice;
    int cells = 1 << l->depth, listed = 0, n = 0;
    for (int p = 0; p < l->fit->npatches; p++)
        for (int x = 0; x < cells; x++)
            for (int y = 0; y < cells; y++) {
                int level = leaf_at(leaves, p, x, y), i = x * l->detail, j = y * l->detail;
                if (level < 0) continue;
                int size = l->side >> level;
                listed += side_borders(s, (GridSide){{p, i, j}, 1, 0, size}, out + listed);
                listed += side_borders(s, (GridSide){{p, i, j}, 0, 1, size}, out + listed);
                listed += side_borders(s, (GridSide){{p, i, j + size}, 1, 0, size}, out + listed);
                listed += side_borders(s, (GridSide){{p, i + size, j}, 0, 1, size}, out + listed);
            }
    qsort(out, (size_t)listed, sizeof *out, by_vertices);
    for (int k = 0; k < listed; k++)
        if (k == 0 || by_vertices(&out[k], &out[n - 1]) != 0) out[n++] = out[k];
    return n;
}
