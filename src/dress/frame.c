/* One frame:

     follow     the root patches follow the pose (global deformation)
     classify   which patches intersect, split those in four (the paper's rule)
     carry      what the last frame displaced fades, and keeps its patches split
     tessellate leaves to one watertight mesh
     push       displace shared vertices until they keep their distance
     test       body edges against cloth, cloth edges against body, on the mesh that is written;
                what is found asks for more distance there, and so on to a cap */
#include "dress/frame.h"

#include "base/clock.h"
#include "dress/follow.h"
#include "dress/literal.h"
#include "dress/push.h"
#include "dress/residual.h"

enum { DETAIL_DEFAULT = 8, DEPTH_DEFAULT = 2 };
/* Rounds of asking for more distance; every third time the whole surface gives way, not only the
   vertices that were asked. */
enum { ROUNDS_MAX = 9, SOLVE_EVERY = 3 };
static const double RAISE = 0.0015; /* metres of clearance added where an edge still crosses, on 1.70 m */

struct Dresser {
    DressOptions options;
    Fit fit;
    Follower follower;
    Lattice lattice;
    Patch *root;
    Classifier classifier;
    Leaves by_rule, leaves; /* as the classification found them; as the solver refined them further */
    Leaves grid;         /*  what is tessellated under a fixed topology */
    Sheet sheet;
    Push push;
    Tester tester;
    Literal literal;
    Vec3 *position, *normal; /* of the written mesh */
    unsigned *own;           /* per vertex: parts that must not show */
    double *u, *w;
    MeshGroup *group;
    int ngroups, *group_of; /* of every patch */
};

static const char *piece_name(const Fit *fit, int patch) {
    const FitPatch *p = &fit->patch[patch];
    return p->panel < 0 ? fit->garment->patch[p->row].name : fit->panel[p->panel].name;
}

/* Triangles lie patch by patch, and patches panel by panel: each panel is one group. */
static bool make_groups(Dresser *d, Arena *arena, Error *e) {
    d->group = ARENA_NEW(arena, MeshGroup, d->fit.npatches, e);
    d->group_of = ARENA_NEW(arena, int, d->fit.npatches, e);
    if (!d->group || !d->group_of) return false;
    for (int p = 0; p < d->fit.npatches; p++) {
        const char *name = piece_name(&d->fit, p);
        if (p == 0 || name != d->group[d->ngroups - 1].name) d->group[d->ngroups++].name = name;
        d->group_of[p] = d->ngroups - 1;
    }
    return true;
}

bool dresser_open(const Garment *garment, const Figure *figure, const Body *body, const DressOptions *options,
                  Arena *arena, Dresser **out, Error *e) {
    Dresser *d = ARENA_NEW(arena, Dresser, 1, e);
    if (!d) return false;
    d->options = *options;
    int detail = options->detail ? options->detail : garment->detail ? garment->detail : DETAIL_DEFAULT;
    int depth = options->depth ? options->depth : DEPTH_DEFAULT;
    if (!fit_garment(garment, figure, body, arena, &d->fit, e) ||
        !follow_reserve(&d->follower, &d->fit, figure, body, arena, e) ||
        !lattice_build(&d->fit, detail, depth, arena, &d->lattice, e) ||
        !classifier_reserve(&d->classifier, &d->lattice, arena, e) ||
        !leaves_reserve(&d->by_rule, &d->lattice, arena, e) ||
        !leaves_reserve(&d->leaves, &d->lattice, arena, e) || !leaves_reserve(&d->grid, &d->lattice, arena, e) ||
        !sheet_reserve(&d->sheet, &d->lattice, arena, e) || !push_reserve(&d->push, &d->lattice, arena, e) ||
        !make_groups(d, arena, e))
        return false;
    int triangles = 2 * d->fit.npatches * d->lattice.side * d->lattice.side, places = d->lattice.nplaces;
    d->root = ARENA_NEW(arena, Patch, d->fit.npatches, e);
    d->position = ARENA_NEW(arena, Vec3, places, e);
    d->normal = ARENA_NEW(arena, Vec3, places, e);
    d->own = ARENA_NEW(arena, unsigned, places, e);
    d->u = ARENA_NEW(arena, double, places, e);
    d->w = ARENA_NEW(arena, double, places, e);
    if (!d->root || !d->position || !d->normal || !d->own || !d->u || !d->w) return false;
    if (!tester_reserve(&d->tester, 3 * triangles, triangles, arena, e)) return false;
    leaves_fill(&d->grid, depth);
    if (options->method == METHOD_PAPER && !literal_reserve(&d->literal, &d->lattice, body, arena, e)) return false;
    *out = d;
    return true;
}

/* The points that a reader of the file gets. */
static void snap_points(Dresser *d, double unit) {
    for (int v = 0; v < d->sheet.nvertices; v++) {
        Vec3 p = vec_scale(d->push.point[v], unit);
        d->own[v] = d->lattice.collide[d->sheet.place[v]];
        d->position[v] = mesh_snap_point(p);
    }
    tester_build(&d->tester, d->position, d->sheet.edge, d->sheet.nedges, d->sheet.triangle, d->sheet.ntriangles,
                 d->own);
}

/* Tests the mesh as it would be written: what crosses the garment's colliders, and, where nothing
   does, what lies inside them. Vertices that must not be are in d->tester.bad. */
static void test_mesh(Dresser *d, const BodyFrame *body, Residual *own, Residual *other, CrossingCount *count) {
    *own = *other = (Residual){0};
    snap_points(d, body->unit);
    tester_cross(&d->tester, body, d->fit.collide, own, other, count);
    if (!d->tester.nbad) tester_inside(&d->tester, body, d->position, d->sheet.nvertices, own, other);
}

/* One attempt: pushes, tests the mesh, asks for more distance round everything that still crosses
   a collider of its own, until nothing does or a cap. Returns how many vertices are left that
   must not be where they are. */
static int attempt(Dresser *d, const BodyFrame *body, FrameStats *stats, PushResult *result, Residual *own,
                   Residual *other, CrossingCount *count) {
    double start = clock_seconds();
    push_start(&d->push, d->root, &d->leaves, &d->sheet);
    push_solve(&d->push, body, &d->sheet, result);
    for (int round = 0;; round++) {
        double pushed = clock_seconds();
        stats->push_s += pushed - start;
        test_mesh(d, body, own, other, count);
        bool raised = false;
        for (int k = 0; k < d->tester.nbad; k++) raised |= push_raise(&d->push, d->tester.bad[k], RAISE);
        start = clock_seconds();
        stats->test_s += start - pushed;
        if (!raised || round == ROUNDS_MAX) return d->tester.nbad;
        if (round % SOLVE_EVERY == SOLVE_EVERY - 1) push_solve(&d->push, body, &d->sheet, result);
        else push_settle(&d->push, body, &d->sheet, result);
    }
}

/* A second attempt, from the global shape alone, where the first leaves something; the better
   one stays. */
static void push_and_test(Dresser *d, const BodyFrame *body, FrameStats *stats, Residual *own, Residual *other,
                          CrossingCount *count) {
    PushResult result = {0};
    int left = attempt(d, body, stats, &result, own, other, count);
    if (left) {
        push_afresh(&d->push);
        if (attempt(d, body, stats, &result, own, other, count) >= left) {
            push_back(&d->push);
            test_mesh(d, body, own, other, count);
        }
        stats->capped = true;
    }
    push_measure(&d->push, body, &d->sheet, &result);
    stats->sweeps = result.sweeps;
    stats->active = result.active;
    stats->pinched = result.pinched;
    stats->displacement = result.displacement;
    stats->capped |= result.capped;
}

/* The parts that the garment does not collide with, and what lies inside any. */
static void final_test(Dresser *d, const BodyFrame *body, const Vec3 *position, int nvertices, FrameStats *stats,
                       Residual *own, Residual *other, CrossingCount *count) {
    double start = clock_seconds();
    tester_cross(&d->tester, body, ~d->fit.collide, own, other, count);
    tester_inside(&d->tester, body, position, nvertices, own, other);
    stats->residual_edges = own->edges;
    stats->residual_cloth = own->cloth;
    stats->inside = own->inside;
    stats->deepest = own->deepest;
    stats->limb_edges = other->edges;
    stats->limb_cloth = other->cloth;
    stats->limb_inside = other->inside;
    stats->test_s += clock_seconds() - start;
}

static void set_groups(Dresser *d, const int *first_of_patch, Mesh *mesh) {
    for (int g = 0; g < d->ngroups; g++) d->group[g].count = 0;
    for (int p = d->fit.npatches - 1; p >= 0; p--) {
        MeshGroup *group = &d->group[d->group_of[p]];
        group->first = first_of_patch[p];
        group->count += first_of_patch[p + 1] - first_of_patch[p];
    }
    mesh->group = d->group;
    mesh->ngroups = d->ngroups;
}

static void fill_mesh(Dresser *d, Mesh *mesh) {
    const Sheet *s = &d->sheet;
    int n = d->lattice.side + 1;
    field_normals(&d->push.field, d->root, s, d->position, d->normal);
    for (int v = 0; v < s->nvertices; v++) {
        int owner = d->lattice.owner[s->place[v]];
        d->u[v] = (double)(owner / n % n) / d->lattice.side;
        d->w[v] = (double)(owner % n) / d->lattice.side;
    }
    *mesh = (Mesh){.nvertices = s->nvertices,
                   .ntriangles = s->ntriangles,
                   .nedges = s->nedges,
                   .position = d->position,
                   .normal = d->normal,
                   .u = d->u,
                   .w = d->w,
                   .triangle = s->triangle,
                   .edge = s->edge};
    set_groups(d, s->first_of_patch, mesh);
}

/* The same classification without boxes, for its seconds alone. */
static double plain_seconds(Dresser *d, const BodyFrame *body) {
    Classification found;
    double start = clock_seconds();
    d->classifier.plain = true;
    classify(&d->classifier, d->root, body, d->options.split, &d->by_rule, &d->leaves, &found);
    d->classifier.plain = false;
    return clock_seconds() - start;
}

static void split_by_rule(Dresser *d, const BodyFrame *body, FrameStats *stats, Classification *found) {
    if (d->options.plain_tests) stats->plain_s = plain_seconds(d, body);
    double start = clock_seconds();
    classify(&d->classifier, d->root, body, d->options.split, &d->by_rule, &d->leaves, found);
    stats->classify_s = stats->test_s = clock_seconds() - start;
    stats->nodes = found->nodes;
    stats->leaves = found->leaves;
    stats->depth = found->depth;
    stats->tests = found->count.pairs_all;
    stats->tests_culled = found->count.pairs_tested;
}

/* Nothing but the global deformation, tested like all. */
static void rest_and_test(Dresser *d, const BodyFrame *body, FrameStats *stats, Residual *own, Residual *other,
                          CrossingCount *count) {
    double start = clock_seconds();
    push_start(&d->push, d->root, &d->leaves, &d->sheet);
    push_rest(&d->push, &d->sheet);
    snap_points(d, body->unit);
    *own = *other = (Residual){0};
    tester_cross(&d->tester, body, d->fit.collide, own, other, count);
    stats->test_s += clock_seconds() - start;
}

/* Split, move and repeat as the paper says, then the tests that all methods undergo. */
static void frame_to_the_letter(Dresser *d, const BodyFrame *body, bool restart, Mesh *mesh, FrameStats *stats) {
    Literal *l = &d->literal;
    CrossingCount count = {0};
    Residual own = {0}, other = {0};
    literal_frame(l, d->root, body, restart, d->options.split, stats);
    *mesh = l->mesh;
    set_groups(d, l->first_of_patch, mesh);
    double start = clock_seconds();
    tester_build(&d->tester, mesh->position, mesh->edge, mesh->nedges, mesh->triangle, mesh->ntriangles, l->own);
    tester_cross(&d->tester, body, d->fit.collide, &own, &other, &count);
    stats->test_s += clock_seconds() - start;
    final_test(d, body, mesh->position, mesh->nvertices, stats, &own, &other, &count);
    stats->pairs_all += count.pairs_all;
    stats->pairs_tested += count.pairs_tested;
}

void dresser_frame(Dresser *d, const BodyFrame *body, double dt, bool restart, Mesh *mesh, FrameStats *stats) {
    *stats = (FrameStats){.restarted = restart};
    double start = clock_seconds();
    follow_pose(&d->follower, &body->pose, d->root);
    stats->global_s = clock_seconds() - start;
    if (d->options.method == METHOD_PAPER) {
        frame_to_the_letter(d, body, restart, mesh, stats);
        return;
    }
    Classification found;
    split_by_rule(d, body, stats, &found);

    start = clock_seconds();
    bool is_global = d->options.method == METHOD_GLOBAL;
    field_carry(&d->push.field, body, dt, restart || is_global, &d->leaves);
    tessellate(&d->sheet, d->options.fixed_topology ? &d->grid : &d->leaves);
    stats->mesh_s = clock_seconds() - start;

    Residual own, other;
    (is_global ? rest_and_test : push_and_test)(d, body, stats, &own, &other, &found.count);
    final_test(d, body, d->position, d->sheet.nvertices, stats, &own, &other, &found.count);

    start = clock_seconds();
    fill_mesh(d, mesh);
    stats->mesh_s += clock_seconds() - start;
    stats->cells = leaves_count(&d->leaves);
    stats->vertices = d->sheet.nvertices;
    stats->triangles = d->sheet.ntriangles;
    stats->pairs_all = found.count.pairs_all;
    stats->pairs_tested = found.count.pairs_tested;
    stats->hits_before = found.hits;
    stats->capped |= found.capped;
}

static int literal_leaves(const Literal *l, LeafPatch *out, int capacity) {
    for (int k = 0; k < l->nleaves && k < capacity; k++)
        out[k] = (LeafPatch){l->leaf[k].patch, l->leaf[k].cell.patch, l->leaf[k].level};
    return l->nleaves;
}

/* Its leaves have pieces of their own, so the edges of each piece are all there is. */
static int literal_borders(const Literal *l, Edge *out) {
    int side = l->lattice->detail, row = side + 1, n = 0;
    for (int k = 0; k < l->nleaves; k++)
        for (int i = 0, first = k * row * row; i < side; i++) {
            out[n++] = (Edge){{first + i, first + i + 1}};
            out[n++] = (Edge){{first + side * row + i, first + side * row + i + 1}};
            out[n++] = (Edge){{first + i * row, first + (i + 1) * row}};
            out[n++] = (Edge){{first + i * row + side, first + (i + 1) * row + side}};
        }
    return n;
}

static const Leaves *leaves_of(const Dresser *d, LeafKind kind) {
    return kind == LEAVES_BY_RULE ? &d->by_rule : &d->leaves;
}

int dresser_leaves(const Dresser *d, LeafKind kind, LeafPatch *out, int capacity) {
    if (d->options.method == METHOD_PAPER) return literal_leaves(&d->literal, out, capacity);
    int depth = d->lattice.depth, cells = 1 << depth, n = 0;
    for (int p = 0; p < d->fit.npatches; p++)
        for (int x = 0; x < cells; x++)
            for (int y = 0; y < cells; y++) {
                int level = leaf_at(leaves_of(d, kind), p, x, y), shift = depth - level;
                if (level < 0 || n++ >= capacity) continue;
                LatticeCell cell = {p, x >> shift, y >> shift};
                out[n - 1] = (LeafPatch){field_leaf(&d->push.field, d->root, cell, level), p, level};
            }
    return n;
}

int dresser_borders(const Dresser *d, LeafKind kind, Edge *out) {
    if (d->options.method == METHOD_PAPER) return literal_borders(&d->literal, out);
    return sheet_borders(&d->sheet, leaves_of(d, kind), out);
}

DresserInfo dresser_info(const Dresser *d) {
    return (DresserInfo){
        .patches = d->fit.npatches, .panels = d->ngroups, .openings = d->fit.nopenings, .own_parts = d->fit.collide};
}
