/* The local deformation of one frame: attempts (dress/attempt), until one leaves nothing that shows.

   carry      what the frame before has displaced
   prepare    what the next attempt does otherwise, where one has left something
   is_better  which of two outcomes stays */
#include "dress/solve.h"

#include "base/clock.h"

static const double FAR = 0.65;     /* of the cap: cloth thrown farther than that, while something was left, is laid */
static const double CLOSER = 0.6;   /* anew, and stays there if that share of the way does as well */
static const double THROWN = 2;     /* residuals of cloth at the cap count 1 + this */
static const double SLOW = 0.25;    /* metres a second on 1.70 m: so fast goes what nothing helps, */
static const double DEEPER = 0.01;  /* unless the body came that many metres deeper into it */
/* How far a level is moved against the next finer one: in a tight garment less, so that a place that is pinched
   carries less of its neighbours away; a loose one gives way as a whole. */
static const double TIGHT = 0.7, LOOSE = 1;

bool solver_reserve(Solver *s, const Fit *fit, const Lattice *lattice, const DressOptions *options, Arena *arena,
                    Error *e) {
    *s = (Solver){.may_split = options->split == SPLIT_ADAPTIVE, .fixed_topology = options->fixed_topology};
    if (!cloth_reserve(&s->cloth, fit, lattice, arena, e) || !leaves_reserve(&s->fresh, lattice, arena, e) ||
        !leaves_reserve(&s->kept, lattice, arena, e) || !leaves_reserve(&s->grid, lattice, arena, e) ||
        !field_reserve(&s->before, lattice, arena, e))
        return false;
    leaves_fill(&s->grid, lattice->depth);
    s->cloth.push.coarser = fit->garment->loose ? LOOSE : TIGHT;
    return true;
}

static void lay_sheet(Solver *s) { tessellate(&s->cloth.sheet, s->fixed_topology ? &s->grid : &s->cloth.leaves); }

/* Splits to the deepest level round every vertex that must not be where it is. */
static void split_where_bad(Cloth *c) {
    const Lattice *l = c->push.lattice;
    const LatticeStep *step = l->level[l->depth].step;
    for (int k = 0; k < c->tester.nbad; k++) {
        LatticeIndex at = l->owner[c->sheet.place[c->tester.bad[k]]];
        leaves_split(&c->leaves, at.patch, l->depth, step[at.i].cell, step[at.j].cell);
    }
}

/* The state of the last attempt, to take back after another. The test is made anew for what the tester holds. */
static void keep(Solver *s) {
    push_keep(&s->cloth.push, s->cloth.sheet.nvertices);
    leaves_copy(&s->cloth.leaves, &s->kept);
}

static void take_back(Solver *s, const BodyFrame *body, FrameStats *stats) {
    push_restore(&s->cloth.push);
    leaves_copy(&s->kept, &s->cloth.leaves);
    lay_sheet(s);
    attempt_test(&s->cloth, body, stats);
}

/* Where an attempt leaves something of the parts that the garment is worn over, others are made from the
   global shape alone: as if nothing had been before; and with finer patches where that leaves something. The best
   stays. */
enum { CARRIED, FRESH, FINER, ATTEMPTS };
static void prepare(Solver *s, int attempt) {
    Cloth *c = &s->cloth;
    if (attempt == FRESH) leaves_copy(&s->fresh, &c->leaves);
    else if (attempt > FRESH && s->may_split) split_where_bad(c);
    if (attempt > CARRIED) {
        lay_sheet(s);
        field_forget(&c->push.field);
    }
}

static bool is_far(const Outcome *o, double cap) { return o->push.displacement > FAR * cap; }

/* Of outcomes that leave something, cloth that has been thrown far counts too. */
static bool is_better(const Outcome *a, const Outcome *b, double cap) {
    int own_a = residual_total(&a->wrong.own), own_b = residual_total(&b->wrong.own);
    double far_a = a->push.displacement / cap, far_b = b->push.displacement / cap;
    if (own_a == 0 && own_b == 0) return far_a < CLOSER * far_b;
    return own_a * (1 + THROWN * far_a) < own_b * (1 + THROWN * far_b);
}

/* Is another attempt worth making? Where something is left, but not so much that the body leaves no room at all. The
   first also while cloth lies far away that has been thrown there when something was left. */
static bool is_wanting(const Solver *s, const Outcome *o, int attempt) {
    int own = residual_total(&o->wrong.own);
    if (attempt == FRESH) return own > 0 || (s->is_thrown && is_far(o, s->cloth.push.field.cap));
    return own > 0 && !attempt_is_hopeless(&s->cloth, o);
}

/* A loose garment finds its ways. */
static bool may_go_slowly(const Solver *s) { return !s->cloth.fit->garment->loose; }

/* Where the body leaves a tight garment no room, in every frame another way out is the one that helps most, and cloth
   would fly to and fro: there it goes slowly, unless that lets the body in deeper. */
static void go_slowly(Solver *s, const BodyFrame *body, double dt, Outcome *best, FrameStats *stats) {
    Cloth *c = &s->cloth;
    double scale = c->push.field.scale;
    keep(s);
    field_hold(&c->push.field, &s->before, SLOW * scale * dt, &c->leaves);
    lay_sheet(s);
    Outcome slow = attempt_rest(c, body, stats);
    if (slow.wrong.own.deepest > best->wrong.own.deepest + DEEPER * scale) {
        take_back(s, body, stats);
        return;
    }
    slow.push.pinched = best->push.pinched;
    slow.push.capped = best->push.capped;
    *best = slow;
}

static Wrong push_and_test(Solver *s, const BodyFrame *body, double dt, Tie tie, FrameStats *stats) {
    Cloth *c = &s->cloth;
    double cap = c->push.field.cap;
    prepare(s, CARRIED);
    Outcome best = attempt_push(c, body, stats);
    stats->sweeps = best.push.sweeps;
    for (int k = FRESH; k < ATTEMPTS && is_wanting(s, &best, k); k++) {
        keep(s);
        c->settler.denter.is_off = residual_total(&best.wrong.own) > 0;
        prepare(s, k);
        Outcome other = attempt_push(c, body, stats);
        stats->sweeps += other.push.sweeps;
        if (is_better(&other, &best, cap)) best = other;
        else take_back(s, body, stats);
    }
    c->settler.denter.is_off = false;
    bool goes_slowly = tie == TIE_GOES_ON && may_go_slowly(s) && residual_total(&best.wrong.own) > 0;
    if (goes_slowly) go_slowly(s, body, dt, &best, stats);
    s->is_thrown = is_far(&best, cap) && (s->is_thrown || residual_total(&best.wrong.own) > 0);
    stats->capped |= residual_total(&best.wrong.own) + residual_total(&best.wrong.other) > 0 || best.push.capped;
    stats->active = best.push.active;
    stats->pinched = best.push.pinched + attempt_pinched(c, body);
    stats->displacement = best.push.displacement;
    return best.wrong;
}

/* A frame that is astray leaves nothing behind. */
static void carry(Solver *s, const BodyFrame *body, double dt, Tie tie) {
    Cloth *c = &s->cloth;
    if (tie == TIE_ASTRAY && !s->is_astray) field_copy(&c->push.field, &s->before);
    if (tie == TIE_GOES_ON && s->is_astray) field_copy(&s->before, &c->push.field);
    s->is_astray = tie == TIE_ASTRAY;
    dent_carry(&c->settler.denter, &c->push.field, body, dt, tie == TIE_GOES_ON);
    field_carry(&c->push.field, body, dt, tie != TIE_GOES_ON, &c->leaves);
    if (tie == TIE_GOES_ON && may_go_slowly(s)) field_copy(&c->push.field, &s->before);
    Leaves *wanted = s->fixed_topology ? &s->grid : &c->leaves;
    if (!s->is_astray) morph_carry(&c->morph, dt, tie == TIE_AFRESH, wanted, &s->fresh);
}

Wrong solver_frame(Solver *s, const BodyFrame *body, const Patch *root, double dt, Tie tie, bool is_global,
                   FrameStats *stats) {
    double start = clock_seconds();
    s->cloth.root = root;
    leaves_copy(&s->cloth.leaves, &s->fresh);
    carry(s, body, dt, is_global ? TIE_AFRESH : tie);
    lay_sheet(s);
    stats->mesh_s = clock_lap(&start);
    Wrong w = is_global ? attempt_rest(&s->cloth, body, stats).wrong : push_and_test(s, body, dt, tie, stats);
    return attempt_raise_flat(&s->cloth, body, w, stats);
}
