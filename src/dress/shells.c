/* A point is inside where the surface winds round it. A ray goes up from the point (along z); each
   triangle that it leaves through counts 1, each that it enters through -1, and the sum is the
   winding number.

   A ray may hit a side or a corner. So the point is thought to be moved by an infinitely small
   amount, in x and still less in y; in the shadow of the triangles on the plane z = 0 that is
   the rule "y <= is below, y > is above" for ends of sides, and the ray then passes each side on
   a definite side. With exact signs no hit is lost and none counted twice, on any closed surface.

   Real surfaces are not always closed or turned alike. Triangles that share an edge of two are
   turned to agree (union-find that knows who is turned against whom). Edges at which the ways
   then do not cancel are the borders of holes, and lids there make the surface closed. */
#include "dress/shells.h"

#include "geometry/predicate.h"
#include "geometry/sets.h"
#include "geometry/topology.h"

typedef struct {
    const Mesh *mesh;
    Arena *arena;
    Topology topology;
    Sets triangles;
    Triangle *turned; /* the triangles, turned alike in each shell */
    int *shell;       /* of each triangle; -1: not wanted */
    Vec3 *position;   /* the mesh's vertices, and the middles of lids behind them */
    Triangle *lid;
    int *lid_shell, nlids;
} Maker;

static void join_triangles(Maker *m) {
    const Topology *t = &m->topology;
    for (int i = 0, n; i < t->nsides; i += n) {
        n = topology_run(t, i);
        for (int k = 1; k < n; k++)
            sets_join(&m->triangles, t->side[i].triangle, t->side[i + k].triangle,
                      n == 2 && t->side[i].way == t->side[i + 1].way);
    }
}

/* Numbers the shells in the order of their first triangles. */
static int number_shells(Maker *m, const bool *wanted) {
    int count = 0;
    bool against;
    for (int t = 0; t < m->mesh->ntriangles; t++) {
        int root = sets_find(&m->triangles, t, &against);
        Triangle v = m->mesh->triangle[t];
        m->turned[t] = against ? (Triangle){{v.v[0], v.v[2], v.v[1]}} : v;
        m->shell[t] = wanted && !wanted[t] ? -1 : root == t ? count++ : m->shell[root];
    }
    return count;
}

/* How often the sides i..i+n-1 run from low to high, less how often back. */
static int surplus(Maker *m, int i, int n) {
    int sum = 0;
    for (int k = 0; k < n; k++) {
        bool against;
        const Side *s = &m->topology.side[i + k];
        sets_find(&m->triangles, s->triangle, &against);
        sum += against ? -s->way : s->way;
    }
    return sum;
}

/* Borders that hang together get one middle, the mean of their vertices. */
static bool make_lids(Maker *m, Error *e) {
    const Topology *t = &m->topology;
    int nvertices = m->mesh->nvertices;
    Sets border;
    int *members = ARENA_NEW(m->arena, int, nvertices, e);
    if (!members || !sets_make(&border, nvertices, m->arena, e)) return false;
    for (int i = 0, n; i < t->nsides; i += n) {
        n = topology_run(t, i);
        const Side *s = &t->side[i];
        for (int k = surplus(m, i, n); k != 0; k += k > 0 ? -1 : 1) {
            m->lid_shell[m->nlids] = m->shell[s->triangle];
            m->lid[m->nlids++] = (Triangle){{k > 0 ? s->high : s->low, k > 0 ? s->low : s->high, 0}};
            sets_join(&border, s->low, s->high, false);
        }
    }
    for (int l = 0; l < m->nlids; l++) { /* each border vertex begins as many lids as it ends, so once is fair */
        int v = m->lid[l].v[0], root = sets_find(&border, v, NULL);
        m->lid[l].v[2] = nvertices + root;
        members[root]++;
        m->position[nvertices + root] = vec_add(m->position[nvertices + root], m->position[v]);
    }
    for (int v = 0; v < nvertices; v++)
        if (members[v]) m->position[nvertices + v] = vec_scale(m->position[nvertices + v], 1.0 / members[v]);
    return true;
}

/* Six times the volume under the triangles of a tree, seen from `origin`. */
static double volume(const BoxTree *tree, Vec3 origin) {
    double sum = 0;
    for (int i = 0; i < tree->count; i++) {
        const int *v = tree->triangle[tree->item[i]].v;
        Vec3 a = vec_sub(tree->position[v[0]], origin), b = vec_sub(tree->position[v[1]], origin);
        sum += vec_dot(a, vec_cross(b, vec_sub(tree->position[v[2]], origin)));
    }
    return sum;
}

/* Sorts 0..n-1 by the shell they belong to: those of shell s are item[end[s-1]..end[s]-1]. */
static void sort_by_shell(const int *shell, int n, int nshells, int *item, int *end) {
    for (int s = 0; s <= nshells; s++) end[s] = 0;
    for (int i = 0; i < n; i++)
        if (shell[i] >= 0) end[shell[i] + 1]++;
    for (int s = 0; s < nshells; s++) end[s + 1] += end[s];
    for (int i = 0; i < n; i++)
        if (shell[i] >= 0) item[end[shell[i]]++] = i;
}

static bool build_shells(Maker *m, Shells *out, Error *e) {
    int n = m->mesh->ntriangles;
    int *item = ARENA_NEW(m->arena, int, n, e), *lid = ARENA_NEW(m->arena, int, m->nlids, e);
    int *end = ARENA_NEW(m->arena, int, out->count + 1, e), *lid_end = ARENA_NEW(m->arena, int, out->count + 1, e);
    if (!item || !lid || !end || !lid_end) return false;
    sort_by_shell(m->shell, n, out->count, item, end);
    sort_by_shell(m->lid_shell, m->nlids, out->count, lid, lid_end);
    for (int s = 0, first = 0, first_lid = 0; s < out->count; first = end[s], first_lid = lid_end[s], s++) {
        Shell *shell = &out->shell[s];
        int lids = lid_end[s] - first_lid;
        if (!boxtree_build(&shell->surface, m->position, m->turned, item + first, end[s] - first, m->arena, e) ||
            !boxtree_build(&shell->lids, m->position, m->lid, lid + first_lid, lids, m->arena, e))
            return false;
        Box box = boxtree_box(&shell->surface);
        Vec3 middle = vec_mid(box.low, box.high);
        shell->outward = volume(&shell->surface, middle) + volume(&shell->lids, middle) < 0 ? -1 : 1;
        out->open += lids > 0;
        out->inverted += shell->outward < 0;
    }
    return true;
}

bool shells_find(const Mesh *mesh, const bool *wanted, Arena *arena, Shells *out, Error *e) {
    Maker m = {.mesh = mesh, .arena = arena};
    int n = mesh->ntriangles, nvertices = mesh->nvertices;
    *out = (Shells){0};
    m.turned = ARENA_NEW(arena, Triangle, n, e);
    m.shell = ARENA_NEW(arena, int, n, e);
    m.position = ARENA_NEW(arena, Vec3, 2 * (size_t)nvertices, e);
    m.lid = ARENA_NEW(arena, Triangle, 3 * (size_t)n, e);
    m.lid_shell = ARENA_NEW(arena, int, 3 * (size_t)n, e);
    if (!m.turned || !m.shell || !m.position || !m.lid || !m.lid_shell || !sets_make(&m.triangles, n, arena, e) ||
        !topology_find(mesh, wanted, arena, &m.topology, e))
        return false;
    for (int v = 0; v < nvertices; v++) m.position[v] = mesh->position[v];
    join_triangles(&m);
    out->count = number_shells(&m, wanted);
    out->shell = ARENA_NEW(arena, Shell, out->count, e);
    return out->shell && make_lids(&m, e) && build_shells(&m, out, e);
}

/* Does the ray up from p pass the triangle's shadow, and which way round does the shadow run?
   1: counter-clockwise, -1: clockwise, 0: passes beside. */
static int winds(Vec3 p, const Vec3 corner[3]) {
    int sum = 0;
    for (int k = 0; k < 3; k++) {
        Vec3 a = corner[k], b = corner[(k + 1) % 3];
        bool a_below = a.y <= p.y, b_below = b.y <= p.y;
        if (a_below == b_below) continue;
        int side = predicate_orient2(a.x, a.y, b.x, b.y, p.x, p.y);
        if (a_below && side > 0) sum++;
        if (b_below && side < 0) sum--;
    }
    return sum;
}

/* Adds to *winding what the ray up from p meets. Is p on a triangle? */
static bool shoot(const BoxTree *tree, Vec3 p, int *winding) {
    bool on = false;
    BoxWalk walk = boxtree_walk(tree, (Box){p, {p.x, p.y, INFINITY}});
    for (int t; (t = boxtree_next(&walk)) >= 0;) {
        const int *v = tree->triangle[t].v;
        Vec3 corner[3] = {tree->position[v[0]], tree->position[v[1]], tree->position[v[2]]};
        int way = winds(p, corner), side = predicate_orient(corner[0], corner[1], corner[2], p);
        on = on || (side == 0 && predicate_segment_triangle(p, p, corner[0], corner[1], corner[2]));
        if (way * side < 0) *winding += way; /* p is below: behind a triangle that looks up, in front of others */
    }
    return on;
}

bool shell_holds(const Shell *shell, Vec3 p) {
    int winding = 0;
    if (!box_touches(boxtree_box(&shell->surface), (Box){p, p}) || shoot(&shell->surface, p, &winding)) return false;
    (void)shoot(&shell->lids, p, &winding); /* on a lid is as good as above it */
    return winding * shell->outward > 0;
}
