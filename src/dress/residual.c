/* The test of a frame's mesh: body edges through the cloth, cloth edges through the body, and cloth vertices inside it,
   part by part.

   While single vertices are moved the mesh is tested again and again. Then only their edges and triangles are tested:
   what these had counted is subtracted, and what they count at their new places is added. */
#include "dress/residual.h"

#include <string.h>

#include "geometry/boxtree.h"

enum { FOUND_MAX = 1 << 13, BAD_MAX = 3 * FOUND_MAX, HITS_MAX = BAD_MAX / 2 };
enum { BLOCK = 16, LOT = 256 }; /* vertices that share a box; that are asked about at a time */
enum { SOME = 8 }; /* one in so many of all edges and triangles may move; of more, the whole mesh is tested */

static bool reserve_sets(TesterCloth *c, int edges, int triangles, Arena *arena, Error *e) {
    return crossing_reserve(&c->edges, edges, arena, e) && crossing_reserve(&c->triangles, triangles, arena, e);
}

bool tester_reserve(Tester *t, int vertices, int edges, int triangles, unsigned own, Arena *arena, Error *e) {
    *t = (Tester){.own = own};
    t->found = ARENA_NEW(arena, Crossing, FOUND_MAX, e);
    t->hit = ARENA_NEW(arena, TesterHit, HITS_MAX, e);
    t->bad = ARENA_NEW(arena, int, BAD_MAX, e);
    t->block = ARENA_NEW(arena, Box, vertices / BLOCK + 1, e);
    t->moves = ARENA_NEW(arena, bool, vertices, e);
    t->some_edges_most = edges / SOME + 1;
    t->some_triangles_most = triangles / SOME + 1;
    t->some_edge = ARENA_NEW(arena, Edge, t->some_edges_most, e);
    t->some_triangle = ARENA_NEW(arena, Triangle, t->some_triangles_most, e);
    t->sunk = ARENA_NEW(arena, TesterSunk, vertices, e);
    t->inside = ARENA_NEW(arena, int, vertices, e);
    return t->found && t->hit && t->bad && t->block && t->moves && t->sunk && t->inside && t->some_edge &&
           t->some_triangle && reserve_sets(&t->all, edges, triangles, arena, e) &&
           reserve_sets(&t->some, t->some_edges_most, t->some_triangles_most, arena, e);
}

static void box(TesterCloth *c, const Vec3 *position) {
    crossing_build_edges(&c->edges, position, c->edge, c->nedges);
    crossing_build_triangles(&c->triangles, position, c->triangle, c->ntriangles);
}

static void add_bad(Tester *t, const int *v, int n) {
    for (int c = 0; c < n && t->nbad < BAD_MAX; c++) t->bad[t->nbad++] = v[c];
}

/* How far along the segment from a to b it meets the plane of a triangle, 0..1. */
static double share_along(Vec3 a, Vec3 b, const Vec3 *position, const int v[3]) {
    Vec3 n = vec_cross(vec_sub(position[v[1]], position[v[0]]), vec_sub(position[v[2]], position[v[0]]));
    double above = vec_dot(n, vec_sub(a, position[v[0]])), below = vec_dot(n, vec_sub(position[v[0]], b));
    return above + below == 0 ? 0.5 : fmin(fmax(above / (above + below), 0), 1);
}

/* The weights of x, a point of a triangle, at its corners; none is negative. */
static void weigh_corners(Vec3 x, const Vec3 *position, const int v[3], double weight[3]) {
    double sum = 0;
    for (int c = 0; c < 3; c++) {
        Vec3 to = vec_sub(position[v[(c + 1) % 3]], x), from = vec_sub(position[v[(c + 2) % 3]], x);
        weight[c] = vec_len(vec_cross(to, from)); /* twice the area across from the corner */
        sum += weight[c];
    }
    for (int c = 0; c < 3; c++) weight[c] = sum > 0 ? weight[c] / sum : 1.0 / 3;
}

/* An edge of the body through a triangle of the cloth. */
static TesterHit hit_of_triangle(const Tester *t, const TesterCloth *c, const BodyFrame *body, int part, Crossing x) {
    const Edge *edge = body->body->skin.edge + body->body->part[part].first_edge + x.edge;
    Vec3 a = body->position[edge->v[0]], b = body->position[edge->v[1]];
    const int *v = c->triangle[x.triangle].v;
    TesterHit hit = {part, 3, {v[0], v[1], v[2]}, {0}};
    weigh_corners(vec_lerp(a, b, share_along(a, b, t->position, v)), t->position, v, hit.weight);
    return hit;
}

/* An edge of the cloth through a triangle of the body. */
static TesterHit hit_of_edge(const Tester *t, const TesterCloth *c, const BodyFrame *body, int part, Crossing x) {
    const int *v = c->edge[x.edge].v;
    const int *triangle = body->body->skin.triangle[body->body->part[part].first_triangle + x.triangle].v;
    double share = share_along(t->position[v[0]], t->position[v[1]], body->position, triangle);
    return (TesterHit){part, 2, {v[0], v[1], -1}, {1 - share, share}};
}

/* Appends crossings that were found to the hits, and their vertices to the bad: of edges of the cloth (corners = 2) or
   of its triangles (3). */
static void add_hits(Tester *t, const TesterCloth *c, const BodyFrame *body, int part, int corners, int found) {
    for (int k = 0; k < found && t->nhits < HITS_MAX; k++) {
        TesterHit *hit = &t->hit[t->nhits++];
        *hit = (corners == 3 ? hit_of_triangle : hit_of_edge)(t, c, body, part, t->found[k]);
        add_bad(t, hit->v, hit->n);
    }
}

/* Adds to *w what the edges and triangles of c cross. */
static void cross(Tester *t, const TesterCloth *c, const BodyFrame *body, Wrong *w) {
    Box cloth = crossing_box(&c->edges);
    for (int p = 0; p < body->body->nparts; p++) {
        const BodyPart *part = &body->body->part[p];
        const CrossingSet *edges = body_frame_edges(body, p, cloth), *triangles = body_frame_triangles(body, p, cloth);
        if (!edges || !triangles) { /* nothing to find, but pairs all the same */
            w->count.pairs_all += (long long)part->nedges * c->ntriangles + (long long)c->nedges * part->ntriangles;
            continue;
        }
        Residual *r = t->own & part_bit(body, p) ? &w->own : &w->other;
        int before = w->count.hits;
        add_hits(t, c, body, p, 3, crossing_find(edges, &c->triangles, t->found, FOUND_MAX, &w->count));
        r->edges += w->count.hits - before;
        before = w->count.hits;
        add_hits(t, c, body, p, 2, crossing_find(&c->edges, triangles, t->found, FOUND_MAX, &w->count));
        r->cloth += w->count.hits - before;
    }
}

/* Boxes the whole mesh where it is now, and finds what it crosses. */
static Wrong cross_all(Tester *t, const BodyFrame *body) {
    Wrong w = {0};
    t->nbad = t->nhits = 0;
    box(&t->all, t->position);
    cross(t, &t->all, body, &w);
    return w;
}

/* --- again, for what has moved --- */

static bool any_moves(const Tester *t, const int *v, int n) {
    bool any = false;
    for (int c = 0; c < n; c++) any |= t->moves[v[c]];
    return any;
}

/* Lists the edges and triangles with a vertex that moves. False where there is no room for so many. */
static bool find_some(Tester *t) {
    const TesterCloth *all = &t->all;
    TesterCloth *some = &t->some;
    int edges = 0, triangles = 0;
    for (int k = 0; k < all->nedges; k++)
        if (any_moves(t, all->edge[k].v, 2)) {
            if (edges == t->some_edges_most) return false;
            t->some_edge[edges++] = all->edge[k];
        }
    for (int k = 0; k < all->ntriangles; k++)
        if (any_moves(t, all->triangle[k].v, 3)) {
            if (triangles == t->some_triangles_most) return false;
            t->some_triangle[triangles++] = all->triangle[k];
        }
    some->edge = t->some_edge;
    some->nedges = edges;
    some->triangle = t->some_triangle;
    some->ntriangles = triangles;
    return true;
}

/* Adds to *w (sign 1), or subtracts from it (-1), what those that move cross where they are now; but for pairs_all,
   which stays that of one whole test. */
static void count_some(Tester *t, const BodyFrame *body, int sign, Wrong *w) {
    Wrong some = {0};
    box(&t->some, t->position);
    cross(t, &t->some, body, &some);
    w->own.edges += sign * some.own.edges;
    w->own.cloth += sign * some.own.cloth;
    w->other.edges += sign * some.other.edges;
    w->other.cloth += sign * some.other.cloth;
    w->count.hits += sign * some.count.hits;
    w->count.pairs_tested += sign * some.count.pairs_tested;
}

/* Drops the hits of those that move. */
static void forget_hits(Tester *t) {
    int n = 0;
    for (int k = 0; k < t->nhits; k++)
        if (!any_moves(t, t->hit[k].v, t->hit[k].n)) t->hit[n++] = t->hit[k];
    t->nhits = n;
    t->nbad = 0;
    for (int k = 0; k < n; k++) add_bad(t, t->hit[k].v, t->hit[k].n);
}

static void move(Tester *t, const BodyFrame *body, const int *vertex, const Vec3 *to, int n, Wrong *w) {
    for (int k = 0; k < n; k++) t->moves[vertex[k]] = vec_dist(t->position[vertex[k]], to[k]) > 0;
    bool fits = find_some(t);
    if (fits) {
        count_some(t, body, -1, w);
        forget_hits(t);
    }
    for (int k = 0; k < n; k++) {
        t->position[vertex[k]] = to[k];
        t->moves[vertex[k]] = false;
    }
    if (fits) count_some(t, body, 1, w);
    else *w = cross_all(t, body);
}

/* --- inside --- */

/* Boxes in metres round vertices that follow each other, and so lie near each other. */
static void box_vertices(Tester *t, double to_metres) {
    for (int v = 0; v < t->nvertices; v++) {
        Box *box = &t->block[v / BLOCK];
        if (v % BLOCK == 0) *box = box_empty();
        box_add(box, vec_scale(t->position[v], to_metres));
    }
}

/* Vertices that may be inside a part, and their points in metres. */
typedef struct {
    int n, vertex[LOT];
    Vec3 point[LOT];
} Suspects;

/* Marks those that are. None is left. */
static void ask(Tester *t, const BodyFrame *body, int part, Suspects *of) {
    bool is_own = t->own & part_bit(body, part);
    double distance[LOT];
    body_frame_distances(body, part, of->point, of->n, 0, distance);
    for (int k = 0; k < of->n; k++) {
        if (distance[k] >= 0) continue;
        TesterSunk *sunk = &t->sunk[of->vertex[k]];
        sunk->parts |= 1u << part;
        double *deepest = is_own ? &sunk->own : &sunk->other;
        *deepest = fmax(*deepest, -distance[k]);
    }
    of->n = 0;
}

static void suspect(Tester *t, const BodyFrame *body, int part, const bool *clear, int v, Suspects *of) {
    if (clear && clear[v]) return;
    Vec3 x = vec_scale(t->position[v], 1 / body->unit);
    of->vertex[of->n] = v;
    of->point[of->n] = x;
    of->n += !body_frame_far(body, part, x, 0);
    if (of->n == LOT) ask(t, body, part, of);
}

/* Asks all parts about all vertices. */
static void find_inside(Tester *t, const BodyFrame *body, const bool *clear) {
    Suspects of;
    of.n = 0;
    memset(t->sunk, 0, (size_t)t->nvertices * sizeof *t->sunk);
    box_vertices(t, 1 / body->unit);
    for (int p = 0; p < body->body->nparts; p++) {
        for (int v = 0; v < t->nvertices; v++) {
            bool is_near = v % BLOCK || box_touches(t->block[v / BLOCK], body->box[p]);
            if (is_near) suspect(t, body, p, clear, v, &of);
            else v += BLOCK - 1;
        }
        ask(t, body, p, &of);
    }
}

/* Asks all parts about n vertices. */
static void find_inside_again(Tester *t, const BodyFrame *body, const int *vertex, int n, const bool *clear) {
    Suspects of;
    of.n = 0;
    for (int k = 0; k < n; k++) t->sunk[vertex[k]] = (TesterSunk){0};
    for (int p = 0; p < body->body->nparts; p++) {
        for (int k = 0; k < n; k++) suspect(t, body, p, clear, vertex[k], &of);
        ask(t, body, p, &of);
    }
}

/* Counts the vertices inside parts, and appends them to the bad. */
static void count_inside(Tester *t, const BodyFrame *body, Wrong *w) {
    int n = 0;
    w->own.inside = w->other.inside = 0;
    w->own.deepest = w->other.deepest = 0;
    for (int v = 0; v < t->nvertices; v++) {
        if (!t->sunk[v].parts) continue;
        t->inside[n++] = v;
        w->own.deepest = fmax(w->own.deepest, t->sunk[v].own);
        w->other.deepest = fmax(w->other.deepest, t->sunk[v].other);
    }
    for (int p = 0; n > 0 && p < body->body->nparts; p++) {
        Residual *r = t->own & part_bit(body, p) ? &w->own : &w->other;
        for (int k = 0; k < n; k++) {
            if (!(t->sunk[t->inside[k]].parts >> p & 1)) continue;
            r->inside++;
            add_bad(t, &t->inside[k], 1);
        }
    }
}

Wrong tester_test(Tester *t, const BodyFrame *body, const Mesh *mesh, const bool *clear) {
    t->all.edge = mesh->edge;
    t->all.nedges = mesh->nedges;
    t->all.triangle = mesh->triangle;
    t->all.ntriangles = mesh->ntriangles;
    t->position = mesh->position;
    t->nvertices = mesh->nvertices;
    Wrong w = cross_all(t, body);
    find_inside(t, body, clear);
    count_inside(t, body, &w);
    return w;
}

Wrong tester_again(Tester *t, const BodyFrame *body, const int *vertex, const Vec3 *to, int n, const bool *clear,
                   Wrong w) {
    move(t, body, vertex, to, n, &w);
    find_inside_again(t, body, vertex, n, clear);
    count_inside(t, body, &w);
    return w;
}
