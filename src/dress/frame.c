/* One frame:

     follow     the root patches follow the pose (global deformation)
     refine     which patches intersect, those are split in four (the paper's rule)
     solve      what the last frame displaced is carried along; leaves become one watertight mesh, which is pushed
                off the body and tested as it will be written, until nothing is found
     fill_mesh  normals, parameters and groups of what is written

   Where no frame went before, cloth may not find its way into a deep squat. Then it is led there through poses between
   (lead_in). */
#include "dress/frame.h"

#include "base/clock.h"
#include "dress/bodypose.h"
#include "dress/follow.h"
#include "dress/literal.h"
#include "dress/solve.h"
#include "geometry/facing.h"

enum { DETAIL_DEFAULT = 8, DEPTH_DEFAULT = 2 };
enum { LEAD_STEPS = 24 };                /* poses through which cloth is led, */
static const double LEAD_SECONDS = 1;    /* which follow each other as if all took this long */

struct Dresser {
    DressOptions options;
    Fit fit;
    Follower follower;
    Lattice lattice;
    Patch *root;
    BodyFrame between;      /* the body in a pose through which cloth is led */
    Classifier classifier;
    Leaves by_rule;         /* as the classification found them; the solver refines them further */
    Solver solver;
    Literal literal;
    Facing facing;
    Vec3 *normal;           /* of the written mesh, */
    double *u, *w;          /* and its parameters */
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
        !body_frame_init(&d->between, body, 1, arena, e) ||
        !follow_reserve(&d->follower, &d->fit, figure, body, arena, e) ||
        !lattice_build(&d->fit, detail, depth, arena, &d->lattice, e) ||
        !classifier_reserve(&d->classifier, &d->lattice, arena, e) ||
        !leaves_reserve(&d->by_rule, &d->lattice, arena, e) ||
        !solver_reserve(&d->solver, &d->fit, &d->lattice, options, arena, e) || !make_groups(d, arena, e))
        return false;
    int triangles = lattice_triangles(&d->lattice), places = d->lattice.nplaces;
    d->root = ARENA_NEW(arena, Patch, d->fit.npatches, e);
    d->normal = ARENA_NEW(arena, Vec3, 2 * places, e); /* with those of creases */
    d->u = ARENA_NEW(arena, double, places, e);
    d->w = ARENA_NEW(arena, double, places, e);
    if (!d->root || !d->normal || !d->u || !d->w) return false;
    if (!facing_reserve(&d->facing, places, triangles, arena, e)) return false;
    Pose rest = figure_rest_pose();
    follow_pose(&d->follower, &rest, d->root);
    escape_bind(&d->solver.cloth.push.escape, d->root);
    if (options->method == METHOD_PAPER && !literal_reserve(&d->literal, &d->lattice, body, arena, e)) return false;
    *out = d;
    return true;
}

static void tell(const Wrong *w, FrameStats *stats) {
    stats->residual_edges = w->own.edges;
    stats->residual_cloth = w->own.cloth;
    stats->inside = w->own.inside;
    stats->deepest = w->own.deepest;
    stats->limb_edges = w->other.edges;
    stats->limb_cloth = w->other.cloth;
    stats->limb_inside = w->other.inside;
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
    const Sheet *s = &d->solver.cloth.sheet;
    int side = d->lattice.side;
    surface_normals(&d->solver.cloth.push.surface, s, &d->solver.cloth.push.field, d->root, d->normal);
    for (int v = 0; v < s->nvertices; v++) {
        LatticeIndex at = d->lattice.owner[s->place[v]];
        d->u[v] = (double)at.i / side;
        d->w[v] = (double)at.j / side;
    }
    *mesh = sheet_mesh(s, d->solver.cloth.position);
    mesh->normal = d->normal;
    mesh->u = d->u;
    mesh->w = d->w;
    facing_mend(&d->facing, mesh);
    set_groups(d, s->first_of_patch, mesh);
}

/* The same classification without boxes, for its seconds alone. */
static double plain_seconds(Dresser *d, const BodyFrame *body) {
    Classification found;
    double start = clock_seconds();
    d->classifier.plain = true;
    classify(&d->classifier, d->root, body, d->options.split, &d->by_rule, &d->solver.cloth.leaves, &found);
    d->classifier.plain = false;
    return clock_seconds() - start;
}

static void split_by_rule(Dresser *d, const BodyFrame *body, FrameStats *stats) {
    Classification found;
    if (d->options.plain_tests) stats->plain_s = plain_seconds(d, body);
    double start = clock_seconds();
    classify(&d->classifier, d->root, body, d->options.split, &d->by_rule, &d->solver.cloth.leaves, &found);
    stats->classify_s = stats->test_s = clock_seconds() - start;
    stats->nodes = found.nodes;
    stats->leaves = found.leaves;
    stats->depth = found.depth;
    stats->tests = stats->pairs_all = found.count.pairs_all;
    stats->tests_culled = stats->pairs_tested = found.count.pairs_tested;
    stats->hits_before = found.hits;
    stats->capped = found.capped;
}

/* A frame begins: nothing is known of it, and the global deformation is made. */
static void begin(Dresser *d, const BodyFrame *body, Tie tie, FrameStats *stats) {
    *stats = (FrameStats){.restarted = tie != TIE_GOES_ON};
    double start = clock_seconds();
    follow_pose(&d->follower, &body->pose, d->root);
    stats->global_s = clock_seconds() - start;
}

/* Split, move and repeat as the paper says, then the tests that all methods undergo. */
static void frame_to_the_letter(Dresser *d, const BodyFrame *body, Tie tie, Mesh *mesh, FrameStats *stats) {
    Literal *l = &d->literal;
    begin(d, body, tie, stats);
    literal_frame(l, d->root, body, tie, d->options.split, stats);
    if (mesh) {
        *mesh = l->mesh;
        set_groups(d, l->first_of_patch, mesh);
    }
    double start = clock_seconds();
    Wrong w = tester_test(&d->solver.cloth.tester, body, &l->mesh, NULL);
    stats->test_s += clock_seconds() - start;
    stats->pairs_all += w.count.pairs_all;
    stats->pairs_tested += w.count.pairs_tested;
    tell(&w, stats);
}

static Wrong deform(Dresser *d, const BodyFrame *body, double dt, Tie tie, FrameStats *stats) {
    begin(d, body, tie, stats);
    split_by_rule(d, body, stats);
    return solver_frame(&d->solver, body, d->root, dt, tie, d->options.method == METHOD_GLOBAL, stats);
}

static void add_costs(FrameStats *to, const FrameStats *from) {
    to->pairs_all += from->pairs_all;
    to->pairs_tested += from->pairs_tested;
    to->sweeps += from->sweeps;
    to->global_s += from->global_s;
    to->test_s += from->test_s;
    to->push_s += from->push_s;
    to->mesh_s += from->mesh_s;
}

/* The same as deform, but cloth is led there from the canonical stance through poses between. */
static Wrong lead_in(Dresser *d, const BodyFrame *body, FrameStats *stats) {
    FrameStats spent = {0}, of_step;
    d->between.unit = body->unit;
    d->between.vectors = body->vectors;
    for (int k = 1; k < LEAD_STEPS; k++) {
        Pose pose = figure_pose_towards(d->follower.figure, &body->pose, (double)k / LEAD_STEPS);
        body_frame_pose(&d->between, &pose);
        deform(d, &d->between, LEAD_SECONDS / LEAD_STEPS, k == 1 ? TIE_AFRESH : TIE_GOES_ON, &of_step);
        add_costs(&spent, &of_step);
    }
    Wrong w = deform(d, body, LEAD_SECONDS / LEAD_STEPS, TIE_GOES_ON, stats);
    stats->restarted = true;
    add_costs(stats, &spent);
    return w;
}

/* Where nothing was before, and something shows. If leading in does not help, all is as it was. */
static Wrong try_to_lead_in(Dresser *d, const BodyFrame *body, double dt, Wrong w, FrameStats *stats) {
    FrameStats plain = *stats, again;
    Wrong led = lead_in(d, body, stats);
    if (residual_total(&led.own) < residual_total(&w.own)) {
        add_costs(stats, &plain);
        return led;
    }
    add_costs(&plain, stats);
    w = deform(d, body, dt, TIE_AFRESH, &again);
    *stats = plain;
    return w;
}

void dresser_frame(Dresser *d, const BodyFrame *body, double dt, Tie tie, Mesh *mesh, FrameStats *stats) {
    if (d->options.method == METHOD_PAPER) {
        frame_to_the_letter(d, body, tie, mesh, stats);
        return;
    }
    Wrong w = deform(d, body, dt, tie, stats);
    bool may_lead_in = tie == TIE_AFRESH && d->options.method == METHOD_PUSH;
    if (may_lead_in && residual_total(&w.own) > 0) w = try_to_lead_in(d, body, dt, w, stats);
    tell(&w, stats);

    double start = clock_seconds();
    if (mesh) fill_mesh(d, mesh);
    stats->mesh_s += clock_seconds() - start;
    stats->cells = leaves_count(&d->solver.cloth.leaves);
    stats->vertices = d->solver.cloth.sheet.nvertices;
    stats->triangles = d->solver.cloth.sheet.ntriangles;
}

static int literal_leaves(const Literal *l, Patch *out, int capacity) {
    for (int k = 0; k < l->nleaves && k < capacity; k++) out[k] = l->leaf[k].patch;
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
    return kind == LEAVES_BY_RULE ? &d->by_rule : &d->solver.cloth.leaves;
}

int dresser_leaves(const Dresser *d, LeafKind kind, Patch *out, int capacity) {
    if (d->options.method == METHOD_PAPER) return literal_leaves(&d->literal, out, capacity);
    int depth = d->lattice.depth, cells = 1 << depth, n = 0;
    for (int p = 0; p < d->fit.npatches; p++)
        for (int x = 0; x < cells; x++)
            for (int y = 0; y < cells; y++) {
                int level = leaf_at(leaves_of(d, kind), p, x, y), shift = depth - level;
                if (level < 0 || n++ >= capacity) continue;
                LatticeCell cell = {p, x >> shift, y >> shift};
                out[n - 1] = field_leaf(&d->solver.cloth.push.field, d->root, cell, level);
            }
    return n;
}

int dresser_borders(const Dresser *d, LeafKind kind, Edge *out) {
    if (d->options.method == METHOD_PAPER) return literal_borders(&d->literal, out);
    return sheet_borders(&d->solver.cloth.sheet, leaves_of(d, kind), out);
}

DresserInfo dresser_info(const Dresser *d) {
    Box box = fit_box(&d->fit);
    return (DresserInfo){.patches = d->fit.npatches, .openings = d->fit.nopenings, .own_parts = d->fit.collide,
                         .size = vec_sub(box.high, box.low)};
}
