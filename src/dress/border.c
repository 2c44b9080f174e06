/* Where a border comes near to itself there are three cases. A narrow fold: the way along the border is not much
   longer than the way across. Two hems that touch, as those of trousers do when the feet are close: they are two pieces
   of the border of one cloth, or the cloth is on the same side of both. Else it is a crack, with cloth on both sides of
   it: both its lips are one piece of the border, or belong to parts that nothing holds together. */
#include "dress/border.h"

#include "geometry/boxtree.h"
#include "geometry/sets.h"
#include "geometry/topology.h"

/* Up to so many times the distance across, the way along the border is that of a corner or a narrow fold. */
static const double FOLD = 6;
/* Cosine between the directions into the cloth above which it is on the same side of both borders. */
static const double SAME_SIDE = 0.5;

typedef struct {
    const Mesh *mesh;
    int n;
    Edge *edge;     /* of the border */
    Triangle *flat; /* the same as collapsed triangles, for the tree */
    int *degree;    /* per vertex: edges of the border there */
    int (*at)[2];   /* per vertex: the first two of them */
    Vec3 *inward;   /* per edge: square to it, into its triangle; unit */
    Sets piece;     /* vertices that edges of the border join */
    Sets cloth;     /* vertices that any edges join */
    BoxTree tree;
} Rim;

/* The unit vector into the triangle of a side, perpendicular to the side: only one of the corners is off its line. */
static Vec3 inward(const Mesh *mesh, const Side *side) {
    const int *v = mesh->triangle[side->triangle].v;
    Vec3 a = mesh->position[side->low], sum = {0, 0, 0}, none = {0, 0, 0};
    Vec3 along = vec_unit_or(vec_sub(mesh->position[side->high], a), none);
    for (int k = 0; k < 3; k++) sum = vec_add(sum, vec_sub(mesh->position[v[k]], a));
    return vec_unit_or(vec_mad(sum, along, -vec_dot(sum, along)), none);
}

/* Is the cloth on the same side of the border at a vertex as at edge k? */
static bool is_same_side(const Rim *r, int vertex, int k) {
    Vec3 sum = r->inward[r->at[vertex][0]];
    if (r->degree[vertex] > 1) sum = vec_add(sum, r->inward[r->at[vertex][1]]);
    return vec_dot(vec_unit_or(sum, sum), r->inward[k]) > SAME_SIDE;
}

static bool find_rim(Rim *r, Arena *arena, int *pieces, Error *e) {
    Topology t;
    int n = r->mesh->nvertices;
    if (!topology_find(r->mesh, NULL, arena, &t, e)) return false;
    if (!sets_make(&r->piece, n, arena, e) || !sets_make(&r->cloth, n, arena, e)) return false;
    r->edge = ARENA_NEW(arena, Edge, t.nsides, e);
    r->flat = ARENA_NEW(arena, Triangle, t.nsides, e);
    r->degree = ARENA_NEW(arena, int, n, e);
    r->at = arena_array(arena, (size_t)n, sizeof *r->at, e);
    r->inward = ARENA_NEW(arena, Vec3, t.nsides, e);
    if (!r->edge || !r->flat || !r->degree || !r->at || !r->inward) return false;
    for (int i = 0, run; i < t.nsides; i += run) {
        int end[2] = {t.side[i].low, t.side[i].high};
        run = topology_run(&t, i);
        sets_join(&r->cloth, end[0], end[1], false);
        if (run > 1) continue;
        r->edge[r->n] = (Edge){{end[0], end[1]}};
        r->flat[r->n] = (Triangle){{end[0], end[1], end[1]}};
        r->inward[r->n] = inward(r->mesh, &t.side[i]);
        for (int k = 0; k < 2; k++)
            if (r->degree[end[k]]++ < 2) r->at[end[k]][r->degree[end[k]] - 1] = r->n;
        sets_join(&r->piece, end[0], end[1], false);
        r->n++;
    }
    for (int v = 0; v < n; v++) *pieces += r->degree[v] > 0 && sets_find(&r->piece, v, NULL) == v;
    return boxtree_build(&r->tree, r->mesh->position, r->flat, NULL, r->n, arena, e);
}

/* Are two vertices of the border on different pieces of it, and yet on one cloth? */
static bool are_two_hems(Rim *r, int a, int b) {
    return sets_find(&r->piece, a, NULL) != sets_find(&r->piece, b, NULL) &&
           sets_find(&r->cloth, a, NULL) == sets_find(&r->cloth, b, NULL);
}

/* Does the way along the border from `vertex`, setting out on edge k, come to `point` on the edge
   `goal` within `limit`? A vertex where more than two edges meet ends it. */
static bool comes_to(const Rim *r, int vertex, int k, int goal, Vec3 point, double limit) {
    const Vec3 *p = r->mesh->position;
    double way = 0;
    for (int steps = 0; steps < r->n; steps++) {
        int next = r->edge[k].v[r->edge[k].v[0] == vertex];
        way += vec_dist(p[vertex], p[next]);
        if (way > limit || r->degree[next] != 2) return false;
        vertex = next;
        k = r->at[next][r->at[next][0] == k];
        if (k == goal) return way + vec_dist(p[next], point) <= limit;
    }
    return false;
}

static bool is_near_along(const Rim *r, int vertex, int goal, Vec3 point, double limit) {
    for (int k = 0; k < 2 && k < r->degree[vertex]; k++)
        if (comes_to(r, vertex, r->at[vertex][k], goal, point, limit)) return true;
    return false;
}

/* Distance to the nearest edge that is near across and not along; `reach` if there is none. */
static double crack_width(Rim *r, int vertex, double reach, bool *found) {
    Vec3 p = r->mesh->position[vertex], out = vec(reach, reach, reach);
    BoxWalk walk = boxtree_walk(&r->tree, (Box){vec_sub(p, out), vec_add(p, out)});
    *found = false;
    for (int k; (k = boxtree_next(&walk)) >= 0;) {
        Edge edge = r->edge[k];
        Vec3 a = r->mesh->position[edge.v[0]], b = r->mesh->position[edge.v[1]];
        Vec3 point = boxtree_triangle_point(p, a, b, b);
        double d = vec_dist(p, point);
        if (edge.v[0] == vertex || edge.v[1] == vertex || d > reach) continue;
        if (are_two_hems(r, vertex, edge.v[0]) || is_same_side(r, vertex, k)) continue;
        if (is_near_along(r, vertex, k, point, FOLD * d)) continue;
        *found = true;
        reach = d;
    }
    return reach;
}

bool border_find(const Mesh *mesh, double reach, Arena *arena, Border *out, Error *e) {
    Rim r = {.mesh = mesh};
    *out = (Border){0};
    if (!find_rim(&r, arena, &out->pieces, e)) return false;
    out->crack = ARENA_NEW(arena, Crack, mesh->nvertices, e);
    if (!out->crack) return false;
    for (int v = 0; v < mesh->nvertices; v++) {
        bool found = false;
        double width = r.degree[v] > 0 ? crack_width(&r, v, reach, &found) : 0;
        if (found) out->crack[out->ncracks++] = (Crack){v, width};
    }
    return true;
}
