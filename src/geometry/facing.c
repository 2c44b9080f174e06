/* Normals of the surface shade smoothly however coarse the facets are. But where the mesh leaves the surface, or a
   fold is narrower than a facet, a normal may point away from a facet and shade it black. Such a normal becomes the
   axis of the narrowest cone round the facets' own normals. If that cone is too wide, the facets that are turned
   away from the mean normal get normals of their own, as few as possible. */
#include "geometry/facing.h"

#include <stdlib.h>

#include "geometry/cone.h"

static const double AGREEMENT = 0.3; /* least cosine between a normal and a facet's, if another normal can be found */
static const double SEEN = 0.01;     /* least cosine of the cone's axis to all facets: still positive after rounding */
enum { FACETS_MAX = 64 };            /* round one vertex; only poles have more, which are then left out */
enum { NONE = -1, STRAIGHT = -2 };   /* instead of a corner: end of the list; the vertex needs no other normal */

bool facing_reserve(Facing *f, int vertices, int triangles, Arena *arena, Error *e) {
    *f = (Facing){.capacity = vertices};
    f->corner = ARENA_NEW(arena, int, vertices, e);
    f->next = ARENA_NEW(arena, int, 3 * triangles, e);
    f->crease = ARENA_NEW(arena, Crease, vertices, e);
    return f->corner && f->next && f->crease;
}

/* Twice its area long. */
static Vec3 facet_normal(const Vec3 *position, Triangle t) {
    Vec3 a = position[t.v[0]];
    return vec_cross(vec_sub(position[t.v[1]], a), vec_sub(position[t.v[2]], a));
}

/* Marks the vertices whose normal is too far off one of their facets, and returns whether there are any. */
static bool find_bent(const Facing *f, const Mesh *m) {
    bool any = false;
    for (int v = 0; v < m->nvertices; v++) f->corner[v] = STRAIGHT;
    for (int t = 0; t < m->ntriangles; t++) {
        Vec3 facet = facet_normal(m->position, m->triangle[t]);
        double least2 = AGREEMENT * AGREEMENT * vec_dot(facet, facet);
        for (int c = 0; c < 3; c++) {
            int v = m->triangle[t].v[c];
            double along = vec_dot(m->normal[v], facet);
            if (along > 0 && along * along >= least2) continue;
            f->corner[v] = NONE;
            any = true;
        }
    }
    return any;
}

static void list_corners(const Facing *f, const Mesh *m) {
    for (int t = 0; t < m->ntriangles; t++)
        for (int c = 0; c < 3; c++) {
            int *first = &f->corner[m->triangle[t].v[c]];
            if (*first == STRAIGHT) continue;
            f->next[3 * t + c] = *first;
            *first = 3 * t + c;
        }
}

/* The facets round a vertex that have an area. */
typedef struct {
    int n, corner[FACETS_MAX];
    Vec3 normal[FACETS_MAX], mean; /* unit; the mean by area */
} Fan;

static void find_fan(const Facing *f, const Mesh *m, int vertex, Fan *fan) {
    Vec3 sum = {0, 0, 0}, otherwise = m->normal[vertex];
    fan->n = 0;
    for (int c = f->corner[vertex]; c != NONE && fan->n < FACETS_MAX; c = f->next[c]) {
        Vec3 facet = facet_normal(m->position, m->triangle[c / 3]);
        if (vec_dot(facet, facet) <= 0) continue;
        fan->normal[fan->n] = vec_unit_or(facet, otherwise);
        fan->corner[fan->n++] = c;
        sum = vec_add(sum, facet);
    }
    fan->mean = vec_unit_or(sum, otherwise);
}

/* Gives normals of their own to the facets of a fan that disagree with its mean: the first of them gets one, which is
   shared with all that agree with it, and so on. They stand behind the normals of all vertices. */
static void crease(const Facing *f, const Fan *fan, Mesh *m) {
    bool served[FACETS_MAX];
    for (int k = 0; k < fan->n; k++) served[k] = vec_dot(fan->mean, fan->normal[k]) >= AGREEMENT;
    for (int first = 0; first < fan->n; first++) {
        Vec3 group[FACETS_MAX], axis;
        int count = 0, number = m->nvertices + m->nextra;
        for (int k = first; k < fan->n && m->ncreases < f->capacity; k++) {
            group[count] = fan->normal[k];
            if (served[k] || cone_axis(group, count + 1, &axis) < AGREEMENT) continue;
            served[k] = true;
            m->normal[number] = axis;
            f->crease[m->ncreases++] = (Crease){fan->corner[k], number};
            count++;
        }
        m->nextra += count > 0;
    }
}

static int by_corner(const void *a, const void *b) { return ((const Crease *)a)->corner - ((const Crease *)b)->corner; }

void facing_mend(const Facing *f, Mesh *m) {
    m->nextra = m->ncreases = 0;
    m->crease = f->crease;
    if (!find_bent(f, m)) return;
    list_corners(f, m);
    for (int v = 0; v < m->nvertices; v++) {
        Fan fan;
        Vec3 axis;
        if (f->corner[v] == STRAIGHT) continue;
        find_fan(f, m, v, &fan);
        bool is_seen = fan.n > 0 && cone_axis(fan.normal, fan.n, &axis) > SEEN;
        m->normal[v] = is_seen ? axis : fan.mean;
        if (!is_seen) crease(f, &fan, m);
    }
    qsort(f->crease, (size_t)m->ncreases, sizeof *f->crease, by_corner);
}
