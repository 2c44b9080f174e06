/* Analytic where that can be: they are smooth across facets however coarse these are. But a normal that
   looks away from one of the facets round it shades that one black, and a vertex in a fold needs one that
   sees all of them: the axis of the narrowest cone round the facets' own normals. Where there is no such
   cone, facets that the mean does not see get normals of their own, as few as may be. */
#include "dress/normals.h"

#include <stdlib.h>

#include "geometry/cone.h"

static const double AGREEMENT = 0.3; /* cosine to a facet below which a normal is not used, if there are others */
static const double SEEN = 0.01;     /* cosine: above it a facet is seen, also by the normal that is written */
enum { FACETS_MAX = 64 };            /* that are asked round one vertex; only at poles are there more */
enum { NONE = -1, STRAIGHT = -2 };   /* instead of a corner: the last one; the vertex is not bent */

bool normals_reserve(Normals *n, const Lattice *lattice, Arena *arena, Error *e) {
    int triangles = 2 * lattice->fit->npatches * lattice->side * lattice->side;
    *n = (Normals){.capacity = lattice->nplaces};
    n->corner = ARENA_NEW(arena, int, lattice->nplaces, e);
    n->next = ARENA_NEW(arena, int, 3 * triangles, e);
    n->crease = ARENA_NEW(arena, Crease, n->capacity, e);
    return n->corner && n->next && n->crease && surface_reserve(&n->surface, lattice, arena, e);
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

/* The facets round a vertex that have an area. */
typedef struct {
    int n, corner[FACETS_MAX];
    Vec3 normal[FACETS_MAX], mean; /* unit; the mean by area */
} Fan;

static void find_fan(const Normals *n, const Sheet *sheet, const Vec3 *position, int vertex, Vec3 otherwise, Fan *fan) {
    Vec3 sum = {0, 0, 0};
    fan->n = 0;
    for (int c = n->corner[vertex]; c != NONE && fan->n < FACETS_MAX; c = n->next[c]) {
        Vec3 facet = facet_normal(position, sheet->triangle[c / 3]);
        if (vec_dot(facet, facet) <= 0) continue;
        fan->normal[fan->n] = vec_unit_or(facet, otherwise);
        fan->corner[fan->n++] = c;
        sum = vec_add(sum, facet);
    }
    fan->mean = vec_unit_or(sum, otherwise);
}

/* Normals for the facets of a fan that its mean does not see: the first of them gets one, which it shares with
   all that it can be shared with, and so on. They stand behind those of all vertices. */
static void crease(Normals *n, const Fan *fan, int nvertices, Vec3 *normal) {
    bool served[FACETS_MAX];
    for (int k = 0; k < fan->n; k++) served[k] = vec_dot(fan->mean, fan->normal[k]) >= AGREEMENT;
    for (int first = 0; first < fan->n; first++) {
        Vec3 group[FACETS_MAX], axis;
        int count = 0;
        for (int k = first; k < fan->n && n->ncreases < n->capacity; k++) {
            group[count] = fan->normal[k];
            if (served[k] || cone_axis(group, count + 1, &axis) < AGREEMENT) continue;
            served[k] = true;
            normal[nvertices + n->nextra] = axis;
            n->crease[n->ncreases++] = (Crease){fan->corner[k], nvertices + n->nextra};
            count++;
        }
        n->nextra += count > 0;
    }
}

static int by_corner(const void *a, const void *b) { return ((const Crease *)a)->corner - ((const Crease *)b)->corner; }

void normals_find(Normals *n, const Field *f, const Patch *root, const Sheet *sheet, const Vec3 *position,
                  Vec3 *normal) {
    n->nextra = n->ncreases = 0;
    surface_normals(&n->surface, sheet, f, root, normal);
    if (!find_bent(n, sheet, position, normal)) return;
    list_corners(n, sheet);
    for (int v = 0; v < sheet->nvertices; v++) {
        Fan fan;
        Vec3 axis;
        if (n->corner[v] == STRAIGHT) continue;
        find_fan(n, sheet, position, v, normal[v], &fan);
        bool is_seen = fan.n > 0 && cone_axis(fan.normal, fan.n, &axis) > SEEN;
        normal[v] = is_seen ? axis : fan.mean;
        if (!is_seen) crease(n, &fan, sheet->nvertices, normal);
    }
    qsort(n->crease, (size_t)n->ncreases, sizeof *n->crease, by_corner);
}
