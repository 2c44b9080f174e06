/* First the surface is pushed as a whole. Then, in rounds, every vertex that is in a part or belongs to something that
   crosses one is asked to keep a little more distance than before, until nothing is found. Most rounds move only these
   vertices and test only their edges and triangles; every third pushes the surface as a whole again. */
#include "dress/attempt.h"

#include <limits.h>

#include "base/clock.h"
#include "geometry/flat.h"

enum { ROUNDS_MAX = 9, SOLVE_EVERY = 3 }; /* rounds of asking for more distance; after so many the whole surface */
enum { MANY = 4 };                   /* if more than one in so many vertices has moved, the whole mesh is tested */
static const double HOPELESS = 0.045; /* findings per edge of the mesh: more are hardly ever mended */
static const double HEADWAY = 0.7;   /* an attempt ends if more of what shows is left after SOLVE_EVERY rounds */
static const double RAISE = 0.002;   /* clearance added to a bad vertex in a round, metres on 1.70 m */
enum { FLAT_ROUNDS = 4, FLAT_MOST = 256 }; /* of raising flat facets: rounds, and vertices moved in each */
static const double FLAT = 5e-6;     /* least height of a facet, metres on 1.70 m */

bool cloth_reserve(Cloth *c, const Fit *fit, const Lattice *lattice, Arena *arena, Error *e) {
    *c = (Cloth){.fit = fit};
    int triangles = lattice_triangles(lattice), places = lattice->nplaces, row = lattice->detail + 1;
    int most = lattice_cells(lattice) * row * row; /* vertices of leaves that share none (dress/literal) */
    if (!leaves_reserve(&c->leaves, lattice, arena, e) || !sheet_reserve(&c->sheet, lattice, arena, e) ||
        !morph_reserve(&c->morph, lattice, arena, e) || !push_reserve(&c->push, lattice, arena, e) ||
        !settle_reserve(&c->settler, lattice, arena, e) ||
        !tester_reserve(&c->tester, most, lattice_edges(lattice), triangles, fit->collide, arena, e))
        return false;
    c->position = ARENA_NEW(arena, Vec3, places, e);
    c->moved = ARENA_NEW(arena, Vec3, places, e);
    c->flag = ARENA_NEW(arena, bool, places, e);
    return c->position && c->moved && c->flag;
}

static void add_pairs(FrameStats *stats, const Wrong *w) {
    stats->pairs_all += w->count.pairs_all;
    stats->pairs_tested += w->count.pairs_tested;
}

Wrong attempt_test(Cloth *c, const BodyFrame *body, FrameStats *stats) {
    mesh_snap_points(body->vectors, c->push.point, body->unit, c->sheet.nvertices, c->position);
    Mesh mesh = sheet_mesh(&c->sheet, c->position);
    bool *is_clear = c->flag;
    for (int v = 0; v < c->sheet.nvertices; v++) is_clear[v] = push_is_clear(&c->push, v);
    Wrong w = tester_test(&c->tester, body, &mesh, is_clear);
    add_pairs(stats, &w);
    return w;
}

/* The same, if only raised vertices have moved since the last test. w: its result. */
static Wrong test_raised(Cloth *c, const BodyFrame *body, Wrong w, FrameStats *stats) {
    int n = c->settler.nraised;
    const int *raised = c->settler.raised;
    bool *is_clear = c->flag;
    for (int k = 0; k < n; k++) {
        is_clear[raised[k]] = push_is_clear(&c->push, raised[k]);
        c->moved[k] = mesh_snap_point(vec_scale(c->push.point[raised[k]], body->unit));
    }
    w = tester_again(&c->tester, body, raised, c->moved, n, is_clear, w);
    add_pairs(stats, &w);
    return w;
}

/* The global shape: of cells that were split or merged lately, between facets and surface (dress/morph). */
static void start_push(Cloth *c, const BodyFrame *body) {
    push_start(&c->push, body, c->root, &c->leaves, &c->sheet);
    morph_points(&c->morph, &c->sheet, c->push.global);
}

/* Pushes the surface as a whole, then every vertex that this leaves too near by itself. */
static void push_all(Cloth *c, PushResult *result) {
    push_solve(&c->push, result);
    settle_all(&c->settler, &c->push, &result->capped);
}

/* Asks all bad vertices to keep more distance; false if all of them keep the most already. */
static bool raise_bad(Cloth *c, int round) {
    bool raised = false;
    for (int k = 0; k < c->tester.nbad; k++)
        raised |= settle_raise(&c->settler, &c->push, c->tester.bad[k], RAISE, RAISE * (round + 1));
    return raised;
}

/* Moves what crosses a part off it, then moves the raised vertices, or all, to the distance that they have to keep. */
static void push_off(Cloth *c, bool all, PushResult *result) {
    settle_mark(&c->settler, &c->push);
    for (int k = 0; k < c->tester.nhits; k++)
        settle_hit(&c->settler, &c->push, &c->tester.hit[k], &result->capped);
    if (all) push_all(c, result);
    else settle_raised(&c->settler, &c->push, &result->capped);
}

bool attempt_is_hopeless(const Cloth *c, const Outcome *o) {
    return outcome_shows(o) > HOPELESS * c->sheet.nedges;
}

/* A round in which cloth gives way to a limb from outside may make a part show that the garment is worn over. That is
   worse, so such a round is taken back and is the last. */
Outcome attempt_push(Cloth *c, const BodyFrame *body, FrameStats *stats) {
    double start = clock_seconds();
    int before = INT_MAX;
    bool all_moved = true, was_clean = false;
    Outcome out = {.push = {0}};
    start_push(c, body);
    settle_start(&c->settler);
    push_all(c, &out.push);
    for (int round = 0;; round++) {
        stats->push_s += clock_lap(&start);
        out.wrong = all_moved ? attempt_test(c, body, stats) : test_raised(c, body, out.wrong, stats);
        bool is_clean = outcome_shows(&out) == 0, solve = round % SOLVE_EVERY == SOLVE_EVERY - 1;
        bool is_spoilt = was_clean && !is_clean && settle_restore(&c->settler, &c->push);
        if (is_spoilt) out.wrong = test_raised(c, body, out.wrong, stats);
        bool raised = !is_spoilt && raise_bad(c, round);
        stats->test_s += clock_lap(&start);
        bool give_up = solve && (is_clean || attempt_is_hopeless(c, &out) || outcome_shows(&out) > HEADWAY * before);
        if (!raised || round == ROUNDS_MAX || give_up) break; /* nothing has moved since the test */
        if (solve) before = outcome_shows(&out);
        all_moved = solve || c->settler.nraised > c->sheet.nvertices / MANY;
        was_clean = is_clean;
        push_off(c, solve, &out.push);
    }
    push_measure(&c->push, &out.push);
    return out;
}

Outcome attempt_rest(Cloth *c, const BodyFrame *body, FrameStats *stats) {
    double start = clock_seconds();
    start_push(c, body);
    push_rest(&c->push);
    Outcome out = {.wrong = attempt_test(c, body, stats)};
    push_measure(&c->push, &out.push);
    stats->test_s += clock_lap(&start);
    return out;
}

/* A facet that folds over is flat for a moment: then rounding to the precision of the text would leave no area, or
   put a vertex on the side of another facet. So one of its corners is moved by some hundredths of a millimetre. */
Wrong attempt_raise_flat(Cloth *c, const BodyFrame *body, Wrong w, FrameStats *stats) {
    double start = clock_seconds(), least = FLAT * c->push.field.scale * body->unit;
    for (int round = 0;; round++) {
        int aside[FLAT_MOST], n = flat_find(c->position, c->sheet.triangle, c->sheet.ntriangles, least, round, aside,
                                            c->moved, FLAT_MOST);
        stats->capped |= n > 0 && round == FLAT_ROUNDS;
        if (n == 0 || round == FLAT_ROUNDS) break;
        for (int k = 0; k < n; k++) c->moved[k] = mesh_snap_point(c->moved[k]);
        w = tester_again(&c->tester, body, aside, c->moved, n, NULL, w);
        add_pairs(stats, &w);
    }
    stats->test_s += clock_lap(&start);
    return w;
}

/* Is there less than `needed` metres of room at a point between a part and one of the parts `others` (bits 1 << role)?
   Only parts that may press on each other count; where they meet at a joint, only if they face each other. */
static bool has_no_room(const BodyFrame *body, unsigned others, int part, Vec3 at, double needed) {
    static const double FACING = 0.2; /* cosine between their normals */
    double distance, other;
    Vec3 normal, away;
    Role role = body->body->part[part].role;
    body_frame_unpressed_many(body, part, &at, 1, needed, &distance, &normal);
    for (int k = 0; k < body->body->nparts && distance < needed; k++) {
        Role of = body->body->part[k].role;
        if (!(others & part_bit(body, k)) || !yield_concerns(role, of)) continue;
        body_frame_unpressed_many(body, k, &at, 1, needed - distance, &other, &away);
        if (other < needed - distance && (!yield_share_joint(role, of) || vec_dot(normal, away) < FACING)) return true;
    }
    return false;
}

/* Is cloth that shows a part at a point (output units) near a vertex there for want of room? */
static bool is_tight(const Cloth *c, const BodyFrame *body, int part, int vertex, Vec3 at) {
    bool is_own = c->fit->collide & part_bit(body, part);
    unsigned others = is_own ? c->fit->collide : c->push.lattice->collide[c->sheet.place[vertex]];
    return has_no_room(body, others, part, vec_scale(at, 1 / body->unit), 2 * PUSH_MARGIN * c->push.field.scale);
}

/* Would cloth have to go beyond its cap there, or be stretched too far? */
static bool is_out_of_reach(const Cloth *c, int vertex) {
    return c->settler.denter.is_out_of_reach[c->sheet.place[vertex]];
}

static bool is_hit_pinched(const Cloth *c, const BodyFrame *body, const TesterHit *hit) {
    bool is_limb = !(c->fit->collide & part_bit(body, hit->part));
    for (int k = 0; is_limb && k < hit->n; k++)
        if (is_out_of_reach(c, hit->v[k])) return true;
    return is_tight(c, body, hit->part, tester_hit_vertex(hit), tester_hit_point(hit, c->position));
}

/* Is a vertex inside a part that it was pushed out of in vain, or inside a limb that leaves it no room? */
static bool is_sunk_pinched(const Cloth *c, const BodyFrame *body, int vertex) {
    for (unsigned left = c->tester.sunk[vertex].parts; left; left &= left - 1) {
        int part = near_first(left);
        bool is_own = c->fit->collide & part_bit(body, part);
        if (is_own || is_out_of_reach(c, vertex) || is_tight(c, body, part, vertex, c->position[vertex])) return true;
    }
    return false;
}

int attempt_pinched(Cloth *c, const BodyFrame *body) {
    int pinched = 0;
    bool *is_pinched = c->flag;
    for (int v = 0; v < c->sheet.nvertices; v++) is_pinched[v] = is_sunk_pinched(c, body, v);
    for (int k = 0; k < c->tester.nhits; k++)
        if (is_hit_pinched(c, body, &c->tester.hit[k])) is_pinched[tester_hit_vertex(&c->tester.hit[k])] = true;
    for (int v = 0; v < c->sheet.nvertices; v++) pinched += is_pinched[v];
    return pinched;
}
