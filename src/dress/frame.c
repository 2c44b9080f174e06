/* One frame:

     follow     the root patches follow the pose (global deformation)
     classify   which patches intersect, split those in four (the paper's rule)
     carry      what the last frame displaced fades, and keeps its patches split
     tessellate leaves to one watertight mesh
     push       displace shared vertices until they keep their distance
     test       body edges against cloth, cloth edges against body, on the mesh that is written;
                what is found asks for more distance there, and so on to a cap */
#include "dress/frame.h"

#include <limits.h>

#include "base/clock.h"
#include "dress/follow.h"
#include "dress/literal.h"
#include "dress/push.h"
#include "dress/residual.h"
#include "geometry/facing.h"
#include "geometry/flat.h"

enum { DETAIL_DEFAULT = 8, DEPTH_DEFAULT = 2 };
/* Rounds of asking for more distance; every third time the whole surface gives way, not only the
   vertices that were asked. */
enum { ROUNDS_MAX = 9, SOLVE_EVERY = 3 };
enum { MANY = 4 }; /* where more than this part of the vertices has moved, the whole mesh is tested */
static const double FAR = 0.5;      /* of the cap: cloth moved farther than that is tried anew from its global shape, */
static const double CLOSER = 0.6;   /* and left there if that share of the way does as well */
static const double THROWN = 2;     /* residuals of cloth at the cap count 1 + this */
static const double HOPELESS = 0.03;/* residuals per edge of the mesh: no attempt has ever mended that many */
static const double NEAR = 0.45;    /* of the cap, in the last attempt */
static const double HEADWAY = 0.7;  /* of the bad vertices may be left after that, or it is given up */
static const double RAISE = 0.002;  /* metres of clearance added in a round where something crosses, on 1.70 m */
enum { FLAT_ROUNDS = 4, FLAT_MOST = 256 };
static const double FLAT = 5e-6;    /* metres: no facet is left less high than that */

struct Dresser {
    DressOptions options;
    Fit fit;
    Follower follower;
    Lattice lattice;
    Patch *root;
    Classifier classifier;
    Leaves by_rule, leaves; /* as the classification found them; as the solver refined them further */
    Leaves fresh, kept;     /* before anything is carried along; of the best attempt so far */
    Leaves grid;            /* what is tessellated under a fixed topology */
    Sheet sheet;
    Push push;
    Tester tester;
    Literal literal;
    Facing facing;
    Vec3 *position, *normal; /* of the written mesh */
    Vec3 *moved;             /* positions of the vertices that have moved since a test */
    unsigned *clear;         /* per vertex: parts (bits 1 << role) that it is outside of for certain */
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
        !leaves_reserve(&d->by_rule, &d->lattice, arena, e) || !leaves_reserve(&d->leaves, &d->lattice, arena, e) ||
        !leaves_reserve(&d->fresh, &d->lattice, arena, e) || !leaves_reserve(&d->kept, &d->lattice, arena, e) ||
        !leaves_reserve(&d->grid, &d->lattice, arena, e) || !sheet_reserve(&d->sheet, &d->lattice, arena, e) ||
        !push_reserve(&d->push, &d->lattice, arena, e) || !make_groups(d, arena, e))
        return false;
    int triangles = 2 * d->fit.npatches * d->lattice.side * d->lattice.side, places = d->lattice.nplaces;
    d->root = ARENA_NEW(arena, Patch, d->fit.npatches, e);
    d->position = ARENA_NEW(arena, Vec3, places, e);
    d->moved = ARENA_NEW(arena, Vec3, places, e);
    d->clear = ARENA_NEW(arena, unsigned, places, e);
    d->normal = ARENA_NEW(arena, Vec3, 2 * places, e); /* with those of creases */
    d->u = ARENA_NEW(arena, double, places, e);
    d->w = ARENA_NEW(arena, double, places, e);
    if (!d->root || !d->position || !d->moved || !d->clear || !d->normal || !d->u || !d->w) return false;
    if (!tester_reserve(&d->tester, 3 * triangles, triangles, arena, e) ||
        !facing_reserve(&d->facing, places, triangles, arena, e))
        return false;
    leaves_fill(&d->grid, depth);
    Pose rest = figure_rest_pose();
    follow_pose(&d->follower, &rest, d->root);
    push_bind(&d->push, d->root);
    if (options->method == METHOD_PAPER && !literal_reserve(&d->literal, &d->lattice, body, arena, e)) return false;
    *out = d;
    return true;
}

/* The points that a reader of the file gets. */
static void snap_points(Dresser *d, double unit) {
    for (int v = 0; v < d->sheet.nvertices; v++) {
        Vec3 p = vec_scale(d->push.point[v], unit);
        d->position[v] = mesh_snap_point(p);
    }
    tester_build(&d->tester, d->position, d->sheet.edge, d->sheet.nedges, d->sheet.triangle, d->sheet.ntriangles,
                 d->fit.collide);
}

/* What is wrong with the mesh as it would be written, and what finding that has cost; vertices that must not
   be where they are stand in d->tester.bad. */
typedef struct {
    Residual own, other;
    CrossingCount count;
} Wrong;

static void add_count(CrossingCount *sum, const CrossingCount *c) {
    sum->pairs_all += c->pairs_all;
    sum->pairs_tested += c->pairs_tested;
    sum->hits += c->hits;
}

/* What d->tester holds, against all that the garment keeps out of. */
static Wrong test_built(Dresser *d, const BodyFrame *body, const Vec3 *position, int nvertices, const unsigned *clear,
                        CrossingCount *count) {
    Wrong w = {0};
    tester_cross(&d->tester, body, d->fit.collide | d->fit.outside, &w.own, &w.other, &w.count);
    tester_inside(&d->tester, body, position, nvertices, clear, &w.own, &w.other);
    add_count(count, &w.count);
    return w;
}

static Wrong test_mesh(Dresser *d, const BodyFrame *body, CrossingCount *count) {
    snap_points(d, body->unit);
    push_clear(&d->push, &d->sheet, d->clear);
    return test_built(d, body, d->position, d->sheet.nvertices, d->clear, count);
}

/* The same, where the last test has found w, and since then n vertices have moved to where d->moved says. */
static Wrong test_moved(Dresser *d, const BodyFrame *body, const int *vertex, int n, const unsigned *clear, Wrong w,
                        CrossingCount *count) {
    tester_move(&d->tester, body, d->fit.collide | d->fit.outside, vertex, d->moved, n, &w.own, &w.other, &w.count);
    w.own.inside = w.other.inside = 0;
    w.own.deepest = w.other.deepest = 0;
    tester_inside(&d->tester, body, d->position, d->sheet.nvertices, clear, &w.own, &w.other);
    add_count(count, &w.count);
    return w;
}

static Wrong test_raised(Dresser *d, const BodyFrame *body, Wrong w, CrossingCount *count) {
    int n = d->push.nraised;
    for (int k = 0; k < n; k++)
        d->moved[k] = mesh_snap_point(vec_scale(d->push.point[d->push.raised[k]], body->unit));
    push_clear(&d->push, &d->sheet, d->clear);
    return test_moved(d, body, d->push.raised, n, d->clear, w, count);
}

static int total(const Residual *r) { return r->edges + r->cloth + r->inside; }

/* One attempt: pushes, tests the mesh, pushes off what still crosses a part and asks for more distance round
   it, until nothing does, or nothing gets better, or a cap. */
static Wrong attempt(Dresser *d, const BodyFrame *body, FrameStats *stats, PushResult *result, CrossingCount *count) {
    double start = clock_seconds();
    int before = INT_MAX;
    bool all_moved = true;
    Wrong w = {0};
    push_start(&d->push, d->root, &d->leaves, &d->sheet);
    push_solve(&d->push, body, &d->sheet, result);
    for (int round = 0;; round++) {
        double pushed = clock_seconds();
        stats->push_s += pushed - start;
        w = all_moved ? test_mesh(d, body, count) : test_raised(d, body, w, count);
        bool raised = false, solve = round % SOLVE_EVERY == SOLVE_EVERY - 1;
        for (int k = 0; k < d->tester.nbad; k++)
            raised |= push_raise(&d->push, d->tester.bad[k], RAISE, RAISE * (round + 1));
        for (int k = 0; raised && k < d->tester.nhits; k++) push_off(&d->push, body, &d->sheet, &d->tester.hit[k]);
        start = clock_seconds();
        stats->test_s += start - pushed;
        bool hopeless = solve && (total(&w.own) == 0 || d->tester.nbad > HEADWAY * before);
        if (!raised || round == ROUNDS_MAX || hopeless) {
            push_measure(&d->push, body, &d->sheet, result);
            return w;
        }
        (solve ? push_solve : push_settle)(&d->push, body, &d->sheet, result);
        if (solve) before = d->tester.nbad;
        all_moved = solve || d->push.nraised > d->sheet.nvertices / MANY;
    }
}

static void lay_sheet(Dresser *d) { tessellate(&d->sheet, d->options.fixed_topology ? &d->grid : &d->leaves); }

/* Splits to the deepest level round every vertex that must not be where it is. */
static void split_where_bad(Dresser *d) {
    const Lattice *l = &d->lattice;
    const LatticeStep *step = l->level[l->depth].step;
    int patch, i, j;
    for (int k = 0; k < d->tester.nbad; k++) {
        lattice_owner(l, d->sheet.place[d->tester.bad[k]], &patch, &i, &j);
        leaves_split(&d->leaves, patch, l->depth, step[i].cell, step[j].cell);
    }
    lay_sheet(d);
}

/* The state of the last attempt, to take back after another. The test is made anew for what the tester holds. */
static void keep(Dresser *d) {
    push_keep(&d->push, d->sheet.nvertices);
    leaves_copy(&d->leaves, &d->kept);
}

static void take_back(Dresser *d, const BodyFrame *body, CrossingCount *count) {
    push_back(&d->push);
    leaves_copy(&d->kept, &d->leaves);
    lay_sheet(d);
    test_mesh(d, body, count);
}

/* How far a level is moved against the next finer one: in a tight garment less, so that a place that is pinched
   carries less of its neighbours away; a loose one gives way as a whole. `turned`: the other way. */
static double coarser_of(const Dresser *d, bool turned) {
    static const double TIGHT = 0.7, LOOSE = 1;
    return d->fit.garment->loose != turned ? LOOSE : TIGHT;
}

/* Where an attempt leaves something of the parts that the garment is worn over, others are made from the
   global shape alone: as if nothing had been before; with finer patches where that leaves something; with
   coarse and fine levels weighed anew; and so that nothing may move far, for what has been thrown across
   a limb comes to rest beside it then. The best stays. */
enum { CARRIED, FRESH, FINER, WEIGHED, CLOSE_BY, ATTEMPTS };
static void prepare(Dresser *d, int attempt, double cap) {
    if (attempt == FRESH) {
        leaves_copy(&d->fresh, &d->leaves);
        lay_sheet(d);
    } else if (attempt > FRESH && d->options.split == SPLIT_ADAPTIVE) {
        split_where_bad(d);
    }
    if (attempt > CARRIED) field_forget(&d->push.field);
    push_weigh(&d->push, coarser_of(d, attempt == WEIGHED));
    d->push.field.cap = attempt == CLOSE_BY ? NEAR * cap : cap;
}

typedef struct {
    Wrong wrong;
    PushResult push;
} Outcome;

/* Parts that the garment is worn over count first: nothing of them may show. Among outcomes that leave some, and
   among those that do not, cloth that has been thrown far counts too. */
static bool is_better(const Outcome *a, const Outcome *b, double cap) {
    int own_a = total(&a->wrong.own), own_b = total(&b->wrong.own);
    double far_a = a->push.displacement / cap, far_b = b->push.displacement / cap;
    if (own_a > 0 && own_b > 0) return own_a * (1 + THROWN * far_a) < own_b * (1 + THROWN * far_b);
    if (own_a + own_b > 0) return own_a == 0;
    if (far_b > FAR && far_a < CLOSER * far_b) return true;
    return total(&a->wrong.other) < total(&b->wrong.other) && far_a <= fmax(far_b, FAR);
}

/* Is attempt k worth making? Where something is left, but not so much that the body leaves no room at all; and
   the first, which forgets what was carried, also where that has kept cloth far away. */
static bool is_wanting(const Dresser *d, const Outcome *o, int k, bool is_carried) {
    int own = total(&o->wrong.own);
    if (k == FRESH) return own > 0 || (is_carried && o->push.displacement > FAR * d->push.field.cap);
    return own > 0 && own <= HOPELESS * d->sheet.nedges;
}

static Wrong push_and_test(Dresser *d, const BodyFrame *body, FrameStats *stats, CrossingCount *count) {
    Outcome best = {.push = {0}};
    double cap = d->push.field.cap;
    bool is_carried = field_levels(&d->push.field) > 0;
    prepare(d, CARRIED, cap);
    best.wrong = attempt(d, body, stats, &best.push, count);
    for (int k = FRESH; k < ATTEMPTS && is_wanting(d, &best, k, is_carried); k++) {
        Outcome other = {.push.sweeps = best.push.sweeps};
        keep(d);
        prepare(d, k, cap);
        other.wrong = attempt(d, body, stats, &other.push, count);
        if (is_better(&other, &best, cap)) {
            best = other;
        } else {
            take_back(d, body, count);
            best.push.sweeps = other.push.sweeps;
        }
    }
    d->push.field.cap = cap;
    stats->capped = total(&best.wrong.own) + total(&best.wrong.other) > 0 || best.push.capped;
    stats->sweeps = best.push.sweeps;
    stats->active = best.push.active;
    stats->pinched = best.push.pinched;
    stats->displacement = best.push.displacement;
    return best.wrong;
}

/* Facets that fold over pass a moment at which text would leave nothing of them, or a vertex on the side of
   another: there a corner steps aside by some hundredths of a millimetre. */
static Wrong raise_flat(Dresser *d, const BodyFrame *body, Wrong w, FrameStats *stats, CrossingCount *count) {
    double start = clock_seconds();
    for (int round = 0; round < FLAT_ROUNDS; round++) {
        int aside[FLAT_MOST], n = flat_find(d->position, d->sheet.triangle, d->sheet.ntriangles, FLAT * body->unit,
                                            round, aside, d->moved, FLAT_MOST);
        if (n == 0) break;
        for (int k = 0; k < n; k++) d->moved[k] = mesh_snap_point(d->moved[k]);
        w = test_moved(d, body, aside, n, NULL, w, count);
    }
    stats->test_s += clock_seconds() - start;
    return w;
}

/* The parts that nothing was done about, and what is left in all. */
static void final_test(Dresser *d, const BodyFrame *body, Wrong *w, FrameStats *stats, CrossingCount *count) {
    double start = clock_seconds();
    tester_cross(&d->tester, body, ~(d->fit.collide | d->fit.outside), &w->own, &w->other, count);
    stats->residual_edges = w->own.edges;
    stats->residual_cloth = w->own.cloth;
    stats->inside = w->own.inside;
    stats->deepest = w->own.deepest;
    stats->limb_edges = w->other.edges;
    stats->limb_cloth = w->other.cloth;
    stats->limb_inside = w->other.inside;
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
    surface_normals(&d->push.surface, s, &d->push.field, d->root, d->normal);
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
    facing_mend(&d->facing, mesh);
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
static Wrong rest_and_test(Dresser *d, const BodyFrame *body, FrameStats *stats, CrossingCount *count) {
    double start = clock_seconds();
    push_start(&d->push, d->root, &d->leaves, &d->sheet);
    push_rest(&d->push, &d->sheet);
    Wrong w = test_mesh(d, body, count);
    stats->test_s += clock_seconds() - start;
    return w;
}

/* Split, move and repeat as the paper says, then the tests that all methods undergo. */
static void frame_to_the_letter(Dresser *d, const BodyFrame *body, bool restart, Mesh *mesh, FrameStats *stats) {
    Literal *l = &d->literal;
    CrossingCount count = {0};
    literal_frame(l, d->root, body, restart, d->options.split, stats);
    *mesh = l->mesh;
    set_groups(d, l->first_of_patch, mesh);
    double start = clock_seconds();
    tester_build(&d->tester, mesh->position, mesh->edge, mesh->nedges, mesh->triangle, mesh->ntriangles,
                 d->fit.collide);
    Wrong w = test_built(d, body, mesh->position, mesh->nvertices, NULL, &count);
    stats->test_s += clock_seconds() - start;
    final_test(d, body, &w, stats, &count);
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
    leaves_copy(&d->leaves, &d->fresh);
    field_carry(&d->push.field, body, dt, restart || is_global, &d->leaves);
    lay_sheet(d);
    stats->mesh_s = clock_seconds() - start;

    Wrong w = (is_global ? rest_and_test : push_and_test)(d, body, stats, &found.count);
    w = raise_flat(d, body, w, stats, &found.count);
    final_test(d, body, &w, stats, &found.count);

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
