/* The local deformation of one frame: attempts to push the cloth off the body, until one leaves nothing that shows.

   attempt    push, test the mesh as it would be written, ask for more distance round what is found, and so
              on to a cap
   prepare    what the next attempt does otherwise, where one has left something
   raise_flat the last word: no facet folds over so far that the text of a file leaves nothing of it */
#include "dress/solve.h"

#include <limits.h>

#include "base/clock.h"
#include "geometry/flat.h"

/* Rounds of asking for more distance; every third time the whole surface gives way, not only the
   vertices that were asked. */
enum { ROUNDS_MAX = 9, SOLVE_EVERY = 3 };
enum { MANY = 4 }; /* where more than this part of the vertices has moved, the whole mesh is tested */
static const double FAR = 0.65;     /* of the cap: cloth moved farther than that is tried anew from its global shape, */
static const double CLOSER = 0.6;   /* and left there if that share of the way does as well */
static const double THROWN = 2;     /* residuals of cloth at the cap count 1 + this */
static const double HOPELESS = 0.03;/* residuals per edge of the mesh: no attempt has ever mended that many */
static const double NEAR = 0.45;    /* of the cap, in the last attempt */
static const double HEADWAY = 0.7;  /* of the bad vertices may be left after a solution, or it is given up */
static const double RAISE = 0.002;  /* metres of clearance added in a round where something crosses, on 1.70 m */
/* How far a level is moved against the next finer one: in a tight garment less, so that a place that is pinched
   carries less of its neighbours away; a loose one gives way as a whole. */
static const double TIGHT = 0.7, LOOSE = 1;
enum { FLAT_ROUNDS = 4, FLAT_MOST = 256 };
static const double FLAT = 5e-6;    /* metres: no facet is left less high than that */

bool solver_reserve(Solver *s, const Fit *fit, const Lattice *lattice, const DressOptions *options, Arena *arena,
                    Error *e) {
    *s = (Solver){.fit = fit,
                  .may_split = options->split == SPLIT_ADAPTIVE,
                  .fixed_topology = options->fixed_topology};
    int triangles = 2 * fit->npatches * lattice->side * lattice->side, places = lattice->nplaces;
    if (!leaves_reserve(&s->leaves, lattice, arena, e) || !leaves_reserve(&s->fresh, lattice, arena, e) ||
        !leaves_reserve(&s->kept, lattice, arena, e) || !leaves_reserve(&s->grid, lattice, arena, e) ||
        !sheet_reserve(&s->sheet, lattice, arena, e) || !push_reserve(&s->push, lattice, arena, e) ||
        !field_reserve(&s->before, lattice, arena, e) ||
        !settle_reserve(&s->settler, lattice, arena, e) ||
        !tester_reserve(&s->tester, 3 * triangles, triangles, arena, e))
        return false;
    s->position = ARENA_NEW(arena, Vec3, places, e);
    s->moved = ARENA_NEW(arena, Vec3, places, e);
    s->clear = ARENA_NEW(arena, bool, places, e);
    leaves_fill(&s->grid, lattice->depth);
    return s->position && s->moved && s->clear;
}

/* The points that a reader of the file gets. */
static void snap_points(Solver *s, const BodyFrame *body) {
    mesh_snap_points(body->vectors, s->push.point, body->unit, s->sheet.nvertices, s->position);
    tester_build(&s->tester, s->position, s->sheet.edge, s->sheet.nedges, s->sheet.triangle, s->sheet.ntriangles,
                 s->fit->collide);
}

static void add_count(CrossingCount *sum, const CrossingCount *c) {
    sum->pairs_all += c->pairs_all;
    sum->pairs_tested += c->pairs_tested;
    sum->hits += c->hits;
}

/* What s->tester holds, against all that the garment keeps out of. */
static Wrong test_built(Solver *s, const BodyFrame *body, const Vec3 *position, int nvertices, const bool *clear,
                        CrossingCount *count) {
    Wrong w = {0};
    tester_cross(&s->tester, body, ~0u, &w.own, &w.other, &w.count);
    tester_inside(&s->tester, body, position, nvertices, clear, &w.own, &w.other);
    add_count(count, &w.count);
    return w;
}

static Wrong test_mesh(Solver *s, const BodyFrame *body, CrossingCount *count) {
    snap_points(s, body);
    push_clear(&s->push, &s->sheet, s->clear);
    return test_built(s, body, s->position, s->sheet.nvertices, s->clear, count);
}

/* The same, where the last test has found w, and since then n vertices have moved to where s->moved says. */
static Wrong test_moved(Solver *s, const BodyFrame *body, const int *vertex, int n, const bool *clear, Wrong w,
                        CrossingCount *count) {
    tester_move(&s->tester, body, ~0u, vertex, s->moved, n, &w.own, &w.other, &w.count);
    w.own.inside = w.other.inside = 0;
    w.own.deepest = w.other.deepest = 0;
    tester_inside(&s->tester, body, s->position, s->sheet.nvertices, clear, &w.own, &w.other);
    add_count(count, &w.count);
    return w;
}

static Wrong test_raised(Solver *s, const BodyFrame *body, Wrong w, CrossingCount *count) {
    int n = s->settler.nraised;
    const int *raised = s->settler.raised;
    for (int k = 0; k < n; k++) s->moved[k] = mesh_snap_point(vec_scale(s->push.point[raised[k]], body->unit));
    push_clear(&s->push, &s->sheet, s->clear);
    return test_moved(s, body, raised, n, s->clear, w, count);
}

/* The surface as a whole, then what that leaves of every vertex. */
static void push_all(Solver *s, const BodyFrame *body, PushResult *result) {
    push_solve(&s->push, body, &s->sheet, result);
    settle_all(&s->settler, &s->push, body, &s->sheet, &result->capped);
}

static int total(const Residual *r) { return r->edges + r->cloth + r->inside; }

/* One attempt: pushes, tests the mesh, pushes off what still crosses a part and asks for more distance round
   it, until nothing does, or nothing gets better, or a cap. What a limb from outside is left with is not mended
   at the price of a part that the garment is worn over. */
static Wrong attempt(Solver *s, const BodyFrame *body, FrameStats *stats, PushResult *result, CrossingCount *count) {
    double start = clock_seconds();
    int before = INT_MAX;
    bool all_moved = true, was_clean = false;
    Wrong w = {0};
    push_start(&s->push, s->root, &s->leaves, &s->sheet);
    settle_start(&s->settler);
    push_all(s, body, result);
    for (int round = 0;; round++) {
        double pushed = clock_seconds();
        stats->push_s += pushed - start;
        w = all_moved ? test_mesh(s, body, count) : test_raised(s, body, w, count);
        bool is_clean = total(&w.own) == 0;
        bool is_spoilt = was_clean && !is_clean && settle_back(&s->settler, &s->push, &s->sheet);
        if (is_spoilt) w = test_raised(s, body, w, count);
        bool raised = false, solve = round % SOLVE_EVERY == SOLVE_EVERY - 1;
        for (int k = 0; !is_spoilt && k < s->tester.nbad; k++)
            raised |= settle_raise(&s->settler, &s->push, s->tester.bad[k], RAISE, RAISE * (round + 1));
        start = clock_seconds();
        stats->test_s += start - pushed;
        bool hopeless = solve && (is_clean || s->tester.nbad > HEADWAY * before);
        if (!raised || round == ROUNDS_MAX || hopeless) { /* nothing has moved since the test */
            push_measure(&s->push, body, &s->sheet, result);
            return w;
        }
        settle_mark(&s->settler, &s->push, &s->sheet);
        for (int k = 0; k < s->tester.nhits; k++)
            settle_hit(&s->settler, &s->push, body, &s->sheet, &s->tester.hit[k]);
        if (solve) push_all(s, body, result);
        else settle_raised(&s->settler, &s->push, body, &s->sheet, &result->capped);
        if (solve) before = s->tester.nbad;
        all_moved = solve || s->settler.nraised > s->sheet.nvertices / MANY;
        was_clean = is_clean;
    }
}

static void lay_sheet(Solver *s) { tessellate(&s->sheet, s->fixed_topology ? &s->grid : &s->leaves); }

/* Splits to the deepest level round every vertex that must not be where it is. */
static void split_where_bad(Solver *s) {
    const Lattice *l = s->push.lattice;
    const LatticeStep *step = l->level[l->depth].step;
    int patch, i, j;
    for (int k = 0; k < s->tester.nbad; k++) {
        lattice_owner(l, s->sheet.place[s->tester.bad[k]], &patch, &i, &j);
        leaves_split(&s->leaves, patch, l->depth, step[i].cell, step[j].cell);
    }
    lay_sheet(s);
}

/* The state of the last attempt, to take back after another. The test is made anew for what the tester holds. */
static void keep(Solver *s) {
    push_keep(&s->push, s->sheet.nvertices);
    leaves_copy(&s->leaves, &s->kept);
}

static void take_back(Solver *s, const BodyFrame *body, CrossingCount *count) {
    push_back(&s->push);
    leaves_copy(&s->kept, &s->leaves);
    lay_sheet(s);
    test_mesh(s, body, count);
}

/* Where an attempt leaves something of the parts that the garment is worn over, others are made from the
   global shape alone: as if nothing had been before; with finer patches where that leaves something; and so that
   nothing may move far, for what has been thrown across a limb comes to rest beside it then. The best stays. */
enum { CARRIED, FRESH, FINER, CLOSE_BY, ATTEMPTS };
static void prepare(Solver *s, int attempt, double cap) {
    if (attempt == FRESH) {
        leaves_copy(&s->fresh, &s->leaves);
        lay_sheet(s);
    } else if (attempt > FRESH && s->may_split) {
        split_where_bad(s);
    }
    if (attempt > CARRIED) field_forget(&s->push.field);
    s->push.coarser = s->fit->garment->loose ? LOOSE : TIGHT;
    s->push.field.cap = attempt == CLOSE_BY ? NEAR * cap : cap;
}

typedef struct {
    Wrong wrong;
    PushResult push;
} Outcome;

/* Parts that the garment is worn over count first: nothing of them may show. Among outcomes that leave some, and
   among those that do not, cloth that has been thrown far counts too. For parts from outside alone cloth does not
   jump unless nothing is left of them. */
static bool is_better(const Outcome *a, const Outcome *b, double cap) {
    int own_a = total(&a->wrong.own), own_b = total(&b->wrong.own);
    double far_a = a->push.displacement / cap, far_b = b->push.displacement / cap;
    if (own_a > 0 && own_b > 0) return own_a * (1 + THROWN * far_a) < own_b * (1 + THROWN * far_b);
    if (own_a + own_b > 0) return own_a == 0;
    if (far_b > FAR && far_a < CLOSER * far_b) return true;
    return total(&a->wrong.other) == 0 && total(&b->wrong.other) > 0 && far_a <= fmax(far_b, FAR);
}

/* Is attempt k worth making? Where something is left, but not so much that the body leaves no room at all; and
   the first, which forgets what was carried, also where that has kept cloth far away. */
static bool is_wanting(const Solver *s, const Outcome *o, int k, bool is_carried) {
    int own = total(&o->wrong.own);
    if (k == FRESH) return own > 0 || (is_carried && o->push.displacement > FAR * s->push.field.cap);
    return own > 0 && own <= HOPELESS * s->sheet.nedges;
}

/* Does the body leave cloth that is worn over `worn` no room before a part from outside, at a point of either? */
static bool has_no_room(const BodyFrame *body, unsigned worn, int part, Vec3 at, double needed) {
    BodyPoint x;
    body_point_move(&x, at);
    double left = needed - body_point_unpressed(body, part, &x, needed);
    for (int k = 0; k < body->body->nparts; k++)
        if (worn & part_bit(body, k) && yield_concerns(body->body->part[part].role, body->body->part[k].role) &&
            body_point_unpressed(body, k, &x, left) < left)
            return true;
    return false;
}

/* Vertices where a part from outside is left in the cloth because there is no room for its clearance on either side. */
static int count_pinched(Solver *s, const BodyFrame *body) {
    int pinched = 0;
    for (int v = 0; v < s->sheet.nvertices; v++) s->clear[v] = true;
    for (int k = 0; k < s->tester.nhits; k++) {
        const TesterHit *hit = &s->tester.hit[k];
        int v = tester_hit_vertex(hit);
        Vec3 x = {0, 0, 0};
        if (s->fit->collide & part_bit(body, hit->part)) continue;
        for (int c = 0; c < hit->n; c++) x = vec_mad(x, s->position[hit->v[c]], hit->weight[c] / body->unit);
        unsigned worn = s->push.lattice->collide[s->sheet.place[v]];
        if (!s->clear[v] || !has_no_room(body, worn, hit->part, x, 2 * PUSH_MARGIN * s->push.field.scale)) continue;
        s->clear[v] = false;
        pinched++;
    }
    return pinched;
}

static Wrong push_and_test(Solver *s, const BodyFrame *body, FrameStats *stats, CrossingCount *count) {
    Outcome best = {.push = {0}};
    double cap = s->push.field.cap;
    bool is_carried = field_levels(&s->push.field) > 0;
    prepare(s, CARRIED, cap);
    best.wrong = attempt(s, body, stats, &best.push, count);
    for (int k = FRESH; k < ATTEMPTS && is_wanting(s, &best, k, is_carried); k++) {
        Outcome other = {.push.sweeps = best.push.sweeps};
        keep(s);
        s->settler.denter.is_off = total(&best.wrong.own) > 0;
        prepare(s, k, cap);
        other.wrong = attempt(s, body, stats, &other.push, count);
        if (is_better(&other, &best, cap)) {
            best = other;
        } else {
            take_back(s, body, count);
            best.push.sweeps = other.push.sweeps;
        }
    }
    s->push.field.cap = cap;
    s->settler.denter.is_off = false;
    stats->capped = total(&best.wrong.own) + total(&best.wrong.other) > 0 || best.push.capped;
    stats->sweeps = best.push.sweeps;
    stats->active = best.push.active;
    stats->pinched = best.push.pinched + count_pinched(s, body);
    stats->displacement = best.push.displacement;
    return best.wrong;
}

/* Facets that fold over pass a moment at which text would leave nothing of them, or a vertex on the side of
   another: there a corner steps aside by some hundredths of a millimetre. */
static Wrong raise_flat(Solver *s, const BodyFrame *body, Wrong w, FrameStats *stats, CrossingCount *count) {
    double start = clock_seconds();
    for (int round = 0; round < FLAT_ROUNDS; round++) {
        int aside[FLAT_MOST], n = flat_find(s->position, s->sheet.triangle, s->sheet.ntriangles, FLAT * body->unit,
                                            round, aside, s->moved, FLAT_MOST);
        if (n == 0) break;
        for (int k = 0; k < n; k++) s->moved[k] = mesh_snap_point(s->moved[k]);
        w = test_moved(s, body, aside, n, NULL, w, count);
    }
    stats->test_s += clock_seconds() - start;
    return w;
}

/* Nothing but the global deformation, tested like all. */
static Wrong rest_and_test(Solver *s, const BodyFrame *body, FrameStats *stats, CrossingCount *count) {
    double start = clock_seconds();
    push_start(&s->push, s->root, &s->leaves, &s->sheet);
    push_rest(&s->push, &s->sheet);
    Wrong w = test_mesh(s, body, count);
    stats->test_s += clock_seconds() - start;
    return w;
}

/* A frame that is astray leaves nothing behind. */
static void carry(Solver *s, const BodyFrame *body, double dt, Tie tie) {
    if (tie == TIE_ASTRAY && !s->is_astray) field_copy(&s->push.field, &s->before);
    if (tie == TIE_GOES_ON && s->is_astray) field_copy(&s->before, &s->push.field);
    s->is_astray = tie == TIE_ASTRAY;
    dent_carry(&s->settler.denter, &s->push.field, body, dt, tie == TIE_GOES_ON);
    field_carry(&s->push.field, body, dt, tie != TIE_GOES_ON, &s->leaves);
}

Wrong solver_frame(Solver *s, const BodyFrame *body, const Patch *root, double dt, Tie tie, bool is_global,
                   FrameStats *stats, CrossingCount *count) {
    double start = clock_seconds();
    s->root = root;
    leaves_copy(&s->leaves, &s->fresh);
    carry(s, body, dt, is_global ? TIE_AFRESH : tie);
    lay_sheet(s);
    stats->mesh_s = clock_seconds() - start;
    Wrong w = (is_global ? rest_and_test : push_and_test)(s, body, stats, count);
    return raise_flat(s, body, w, stats, count);
}

Wrong solver_test(Solver *s, const BodyFrame *body, const Mesh *mesh, CrossingCount *count) {
    tester_build(&s->tester, mesh->position, mesh->edge, mesh->nedges, mesh->triangle, mesh->ntriangles,
                 s->fit->collide);
    return test_built(s, body, mesh->position, mesh->nvertices, NULL, count);
}
