/* What the paper says and nothing else. Every edge of the body meets every triangle of a patch;
   equations (2) to (4) decide with closed signs. A patch that is hit is split in four, those that
   are hit again, until neighbours are. Then all 16 control points of each leaf that is hit move a
   step in the direction in which the skeleton moves there, and the test is repeated.

   It is known not to converge: a leg that swings back while it shows in front pulls the cloth
   further in, leaves that move alone tear away from their neighbours, and edges alone do not see
   cloth that lies inside the body. That is what it is kept for. */
#include "dress/literal.h"

#include "base/clock.h"
#include "geometry/predicate.h"

enum { STEPS_MAX = 40 };
static const double STEP = 0.005; /* metres on a figure of 1.70 m */
static const double STILL = 1e-9; /* metres: a motion below this has no direction */

bool literal_reserve(Literal *l, const Lattice *lattice, const Body *body, Arena *arena, Error *e) {
    int n = lattice->detail, leaves = lattice_cells(lattice), most = 0;
    int vertices = leaves * (n + 1) * (n + 1);
    for (int p = 0; p < body->nparts; p++)
        if (body->part[p].nvertices > most) most = body->part[p].nvertices;
    *l = (Literal){.lattice = lattice};
    Mesh *m = &l->mesh;
    l->leaf = ARENA_NEW(arena, LiteralLeaf, leaves, e);
    l->facet = ARENA_NEW(arena, Triangle, 2 * n * n, e);
    l->point = ARENA_NEW(arena, Vec3, (n + 1) * (n + 1), e);
    l->side = ARENA_NEW(arena, double, most, e);
    m->position = ARENA_NEW(arena, Vec3, vertices, e);
    m->normal = ARENA_NEW(arena, Vec3, vertices, e);
    m->u = ARENA_NEW(arena, double, vertices, e);
    m->w = ARENA_NEW(arena, double, vertices, e);
    m->triangle = ARENA_NEW(arena, Triangle, leaves * 2 * n * n, e);
    m->edge = ARENA_NEW(arena, Edge, leaves * (3 * n * n + 2 * n), e);
    l->first_of_patch = ARENA_NEW(arena, int, lattice->fit->npatches + 1, e);
    if (!l->leaf || !l->first_of_patch || !l->facet || !l->point || !l->side) return false;
    if (!m->position || !m->normal || !m->u || !m->w || !m->triangle || !m->edge) return false;
    facets_of_cell(n, 0, l->facet);
    return true;
}

/* The corners of the facets of a leaf, as a reader of the file gets them. */
static void leaf_points(const Lattice *l, const Patch *patch, double unit, Vec3 *out) {
    int n = l->detail, stride = 1 << l->depth; /* a leaf has the whole range of parameters to itself */
    for (int i = 0; i <= n; i++)
        for (int j = 0; j <= n; j++) {
            Vec3 p = bezier_weighted(patch, l->basis[i * stride], l->basis[j * stride]);
            *out++ = mesh_snap_point(vec_scale(p, unit));
        }
}

/* How far the body has moved at the point t of its edge a-b since the frame before. */
static Vec3 motion_at(const BodyFrame *body, const Pose *before, int part, Vec3 a, Vec3 b, double t) {
    Vec3 now = vec_scale(vec_add(a, vec_scale(vec_sub(b, a), t)), 1 / body->unit);
    Role role = body->body->part[part].role;
    return vec_sub(now, rigid_apply(before->bone[role], rigid_unapply(body->pose.bone[role], now)));
}

/* All edges of a part against one triangle. S_a012 of equation (2) belongs to a vertex, not to an
   edge, and most pairs are decided by its two signs. */
static void test_triangle(const Literal *l, LiteralLeaf *leaf, const BodyFrame *body, int part, Triangle facet) {
    const BodyPart *of = &body->body->part[part];
    const Edge *edge = body->body->skin.edge + of->first_edge;
    const Vec3 *at = body->position + of->first_vertex;
    Vec3 v0 = l->point[facet.v[0]], v1 = l->point[facet.v[1]], v2 = l->point[facet.v[2]];
    Vec3 normal = vec_cross(vec_sub(v1, v0), vec_sub(v2, v0));
    for (int v = 0; v < of->nvertices; v++) l->side[v] = vec_dot(vec_sub(at[v], v0), normal);
    for (int k = 0; k < of->nedges; k++) {
        int a = edge[k].v[0] - of->first_vertex, b = edge[k].v[1] - of->first_vertex;
        if (l->side[a] * l->side[b] > 0 || !predicate_paper(at[a], at[b], v0, v1, v2)) continue;
        leaf->hits++;
        if (!l->has_before) continue;
        double t = l->side[a] != l->side[b] ? l->side[a] / (l->side[a] - l->side[b]) : 0.5;
        leaf->motion = vec_add(leaf->motion, motion_at(body, &l->before, part, at[a], at[b], t));
    }
}

static void test_leaf(const Literal *l, LiteralLeaf *leaf, const BodyFrame *body, FrameStats *stats) {
    int n = l->lattice->detail, ntriangles = 2 * n * n;
    unsigned parts = l->lattice->fit->patch[leaf->cell.patch].collide;
    leaf->hits = 0;
    leaf->motion = vec(0, 0, 0);
    leaf_points(l->lattice, &leaf->patch, body->unit, l->point);
    for (int p = 0; p < body->body->nparts; p++) {
        if (!(parts & part_bit(body, p))) continue;
        for (int t = 0; t < ntriangles; t++) test_triangle(l, leaf, body, p, l->facet[t]);
        stats->pairs_all += (long long)ntriangles * body->body->part[p].nedges;
    }
}

static void make_children(const LiteralLeaf *parent, LiteralLeaf child[4]) {
    Patch quarter[4];
    bezier_split(&parent->patch, quarter);
    for (int k = 0; k < 4; k++)
        child[k] = (LiteralLeaf){.patch = quarter[k],
                                 .level = parent->level + 1,
                                 .cell = {parent->cell.patch, 2 * parent->cell.a + k / 2, 2 * parent->cell.b + k % 2}};
}

/* Four children of a leaf that is hit, and theirs. */
static void split(Literal *l, const LiteralLeaf *parent, const BodyFrame *body, FrameStats *stats) {
    LiteralLeaf child[4];
    bool hit[4];
    make_children(parent, child);
    for (int k = 0; k < 4; k++) {
        test_leaf(l, &child[k], body, stats);
        hit[k] = child[k].hits > 0;
    }
    stats->nodes += 4;
    if (child->level > stats->depth) stats->depth = child->level;
    bool ends = neighbours_hit(hit) || child->level == l->lattice->depth;
    for (int k = 0; k < 4; k++) {
        if (hit[k] && !ends) split(l, &child[k], body, stats);
        else l->leaf[l->nleaves++] = child[k];
    }
}

/* All leaves at the deepest level, untested before. */
static void split_all(Literal *l, LiteralLeaf *leaf, const BodyFrame *body, FrameStats *stats) {
    if (leaf->level < l->lattice->depth) {
        LiteralLeaf child[4];
        make_children(leaf, child);
        for (int k = 0; k < 4; k++) split_all(l, &child[k], body, stats);
        return;
    }
    test_leaf(l, leaf, body, stats);
    stats->nodes++;
    stats->hits_before += leaf->hits;
    l->leaf[l->nleaves++] = *leaf;
}

static void split_roots(Literal *l, const Patch *root, const BodyFrame *body, SplitRule rule, FrameStats *stats) {
    stats->depth = rule == SPLIT_UNIFORM ? l->lattice->depth : 0;
    l->nleaves = 0;
    for (int p = 0; p < l->lattice->fit->npatches; p++) {
        LiteralLeaf leaf = {.patch = root[p], .cell = {p, 0, 0}};
        if (rule == SPLIT_UNIFORM) {
            split_all(l, &leaf, body, stats);
            continue;
        }
        test_leaf(l, &leaf, body, stats);
        stats->nodes++;
        stats->hits_before += leaf.hits;
        if (leaf.hits && rule == SPLIT_ADAPTIVE) split(l, &leaf, body, stats);
        else l->leaf[l->nleaves++] = leaf;
    }
    stats->leaves = stats->cells = l->nleaves;
    stats->tests = stats->tests_culled = stats->pairs_all; /* there is no culling */
}

/* One step of a leaf that is hit, if it has a direction. */
static bool push_leaf(Literal *l, LiteralLeaf *leaf, const BodyFrame *body, FrameStats *stats) {
    double speed = vec_len(leaf->motion);
    if (!leaf->hits || speed < STILL) return false;
    Vec3 step = vec_scale(leaf->motion, STEP * figure_scale(l->lattice->fit->height) / speed);
    for (int k = 0; k < 16; k++) leaf->patch.p[k / 4][k % 4] = vec_add(leaf->patch.p[k / 4][k % 4], step);
    leaf->moved = vec_add(leaf->moved, step);
    test_leaf(l, leaf, body, stats);
    return true;
}

static void push_leaves(Literal *l, const BodyFrame *body, FrameStats *stats) {
    for (bool pushed = true; pushed && stats->sweeps < STEPS_MAX; stats->sweeps += pushed) {
        pushed = false;
        for (int k = 0; k < l->nleaves; k++) pushed |= push_leaf(l, &l->leaf[k], body, stats);
    }
    for (int k = 0; k < l->nleaves; k++) {
        double moved = vec_len(l->leaf[k].moved);
        stats->active += moved > 0;
        stats->displacement = fmax(stats->displacement, moved);
        stats->capped |= l->leaf[k].hits > 0;
    }
}

static void mesh_leaf(Literal *l, const LiteralLeaf *leaf, double unit) {
    Mesh *m = &l->mesh;
    const Lattice *lattice = l->lattice;
    const FitPatch *of = &lattice->fit->patch[leaf->cell.patch];
    int n = lattice->detail, first = m->nvertices, stride = 1 << (lattice->depth - leaf->level);
    leaf_points(lattice, &leaf->patch, unit, m->position + first);
    for (int v = first, i = 0; i <= n; i++)
        for (int j = 0; j <= n; j++, v++) {
            double u = (double)i / n, w = (double)j / n;
            int a = leaf->cell.a * n + i, b = leaf->cell.b * n + j;
            m->normal[v] = vec_scale(bezier_normal(&leaf->patch, u, w), of->flip ? -1 : 1);
            m->u[v] = (double)a * stride / lattice->side;
            m->w[v] = (double)b * stride / lattice->side;
            if (i < n) m->edge[m->nedges++] = (Edge){{v, v + n + 1}};
            if (j < n) m->edge[m->nedges++] = (Edge){{v, v + 1}};
            if (i < n && j < n) m->edge[m->nedges++] = (Edge){{v, v + n + 2}};
        }
    for (int t = 0; t < 2 * n * n; t++) {
        const int *v = l->facet[t].v;
        m->triangle[m->ntriangles++] = of->flip ? (Triangle){{first + v[0], first + v[2], first + v[1]}}
                                                : (Triangle){{first + v[0], first + v[1], first + v[2]}};
    }
    m->nvertices += (n + 1) * (n + 1);
}

static void make_mesh(Literal *l, double unit, FrameStats *stats) {
    int patch = -1;
    l->mesh.nvertices = l->mesh.ntriangles = l->mesh.nedges = 0;
    for (int k = 0; k < l->nleaves; k++) {
        if (l->leaf[k].cell.patch != patch) l->first_of_patch[patch = l->leaf[k].cell.patch] = l->mesh.ntriangles;
        mesh_leaf(l, &l->leaf[k], unit);
    }
    l->first_of_patch[patch + 1] = l->mesh.ntriangles;
    stats->vertices = l->mesh.nvertices;
    stats->triangles = l->mesh.ntriangles;
}

void literal_frame(Literal *l, const Patch *root, const BodyFrame *body, Tie tie, SplitRule rule, FrameStats *stats) {
    double start = clock_seconds();
    bool had_before = l->has_before;
    if (tie != TIE_GOES_ON) l->has_before = false;
    split_roots(l, root, body, rule, stats);
    double classified = clock_seconds();
    stats->classify_s = stats->plain_s = stats->test_s = classified - start;
    push_leaves(l, body, stats);
    double pushed = clock_seconds();
    stats->push_s = pushed - classified;
    make_mesh(l, body->unit, stats);
    stats->mesh_s = clock_seconds() - pushed;
    stats->pairs_tested = stats->pairs_all;
    if (tie != TIE_ASTRAY) l->before = body->pose;
    l->has_before = tie != TIE_ASTRAY || had_before;
}
