/* Analytic where that can be: they are smooth across facets however coarse these are. But a normal that
   looks away from one of the facets round it shades that one black, and a vertex in a fold needs one that
   sees all of them: the axis of the narrowest cone round the facets' own normals. */
#include "dress/normals.h"

#include "geometry/cone.h"

static const double AGREEMENT = 0.3; /* cosine: an analytic normal farther off one of its facets is not used */
enum { FACETS_MAX = 64 };            /* that are asked round one vertex; only at poles are there more */
enum { NONE = -1, STRAIGHT = -2 };   /* instead of a corner: the last one; the vertex is not bent */

bool normals_reserve(Normals *n, const Lattice *lattice, Arena *arena, Error *e) {
    int triangles = 2 * lattice->fit->npatches * lattice->side * lattice->side;
    n->corner = ARENA_NEW(arena, int, lattice->nplaces, e);
    n->next = ARENA_NEW(arena, int, 3 * triangles, e);
    return n->corner && n->next;
}

/* Twice its area long. */
static Vec3 facet_normal(const Vec3 *position, Triangle t) {
    Vec3 a = position[t.v[0]];
    return vec_cross(vec_sub(position[t.v[1]], a), vec_sub(position[t.v[2]], a));
}

/* Marks the vertices whose normal is too far off one of their facets, and returns whether there are any. */
static bool find_bent(const Normals *n, const Sheet *sheet, const Vec3 *position, const Vec3 *normal) {
    bool any = false;
    for (int v = 0; v < sheet->nvertices; v++) n->corner[v] = STRAIGHT;
    for (int t = 0; t < sheet->ntriangles; t++) {
        Vec3 facet = facet_normal(position, sheet->triangle[t]);
        double least2 = AGREEMENT * AGREEMENT * vec_dot(facet, facet);
        for (int c = 0; c < 3; c++) {
            int v = sheet->triangle[t].v[c];
            double along = vec_dot(normal[v], facet);
            if (along > 0 && along * along >= least2) continue;
            n->corner[v] = NONE;
            any = true;
        }
    }
    return any;
}

static void list_corners(const Normals *n, const Sheet *sheet) {
    for (int corner = 0; corner < 3 * sheet->ntriangles; corner++) {
        int *first = &n->corner[sheet->triangle[corner / 3].v[corner % 3]];
        if (*first == STRAIGHT) continue;
        n->next[corner] = *first;
        *first = corner;
    }
}

/* A normal for the facets of a vertex; `other` where they have none. */
static Vec3 bent_normal(const Normals *n, const Sheet *sheet, const Vec3 *position, int vertex, Vec3 other) {
    Vec3 sum = {0, 0, 0}, unit[FACETS_MAX], axis;
    int count = 0, corner = n->corner[vertex];
    for (; corner != NONE && count < FACETS_MAX; corner = n->next[corner]) {
        Vec3 facet = facet_normal(position, sheet->triangle[corner / 3]);
        if (vec_dot(facet, facet) <= 0) continue;
        unit[count++] = vec_unit_or(facet, other);
        sum = vec_add(sum, facet);
    }
    return count && cone_axis(unit, count, &axis) ? axis : vec_unit_or(sum, other);
}

void normals_find(const Normals *n, const Field *f, const Patch *root, const Sheet *sheet, const Vec3 *position,
                  Vec3 *normal) {
    unsigned levels = field_levels(f);
    for (int v = 0; v < sheet->nvertices; v++) normal[v] = field_normal(f, root, levels, sheet->place[v]);
    if (!find_bent(n, sheet, position, normal)) return;
    list_corners(n, sheet);
    for (int v = 0; v < sheet->nvertices; v++)
        if (n->corner[v] != STRAIGHT) normal[v] = bent_normal(n, sheet, position, v, normal[v]);
}
