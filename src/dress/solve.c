/* The local deformation of one frame: attempts (dress/attempt), until after one of them nothing shows.

   carry      takes over the displacement of the frame before
   prepare    says from where each attempt begins
   is_better  says which of two outcomes is kept */
#include "dress/solve.h"

#include "base/clock.h"

static const double FAR = 0.65;     /* of the cap: cloth displaced farther is far away */
static const double CLOSER = 0.6;   /* if nothing shows after either of two outcomes, the new one is better only if its
                                       displacement is below this share of the old one's */
static const double THROWN = 2;     /* what shows counts (1 + this) times if the cloth is displaced up to the cap */
static const double SLOW = 0.25;    /* metres a second on 1.70 m: speed of cloth for which no attempt finds room, */
static const double DEEPER = 0.01;  /* unless the body would be this much deeper in it (metres on 1.70 m) */
/* How far a level is moved against the next finer one. In a tight garment it is less, so that a place that is pinched
   carries less of its neighbours away; a loose one gives way as a whole. */
static const double TIGHT = 0.7, LOOSE = 1;

bool solver_reserve(Solver *s, const Fit *fit, const Lattice *lattice, const DressOptions *options, Arena *arena,
                    Error *e) {
    *s = (Solver){.may_split = options->split == SPLIT_ADAPTIVE, .fixed_topology = options->fixed_topology};
    if (!cloth_reserve(&s->cloth, fit, lattice, arena, e) || !leaves_reserve(&s->fresh, lattice, arena, e) ||
        !leaves_reserve(&s->kept, lattice, arena, e) || !leaves_reserve(&s->grid, lattice, arena, e) ||
        !field_reserve(&s->before, lattice, arena, e) || !morph_reserve(&s->morph_before, lattice, arena, e))
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

/* Keeps the state of the last attempt; take_back returns to it after another one. */
static void keep(Solver *s) {
    push_keep(&s->cloth.push, s->cloth.sheet.nvertices);
    dent_keep(&s->cloth.settler.denter);
    leaves_copy(&s->cloth.leaves, &s->kept);
}

/* Tests again, so that the tester's lists belong to this state. */
static void take_back(Solver *s, const BodyFrame *body, FrameStats *stats) {
    push_restore(&s->cloth.push);
    dent_restore(&s->cloth.settler.denter);
    leaves_copy(&s->kept, &s->cloth.leaves);
    lay_sheet(s);
    attempt_test(&s->cloth, body, stats);
}

/* The attempts of a frame. The first begins with the displacement of the frame before. If after it something shows,
   another begins with the global shape alone, as if there had been no frame before, and a third in addition with finer
   patches where something showed. */
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

/* If something shows after both, it counts the more the farther the cloth has been displaced for it. */
static bool is_better(const Outcome *a, const Outcome *b, double cap) {
    int shows_a = outcome_shows(a), shows_b = outcome_shows(b);
    double far_a = a->push.displacement / cap, far_b = b->push.displacement / cap;
    if (shows_a == 0 && shows_b == 0) return far_a < CLOSER * far_b;
    return shows_a * (1 + THROWN * far_a) < shows_b * (1 + THROWN * far_b);
}

/* Is this attempt, after the first, worth making? Yes if something shows, but not so much that there is no room at all.
   FRESH also if nothing shows, but the cloth is still far away since a frame in which something did. */
static bool is_wanting(const Solver *s, const Outcome *o, int attempt, bool is_thrown) {
    bool shows = outcome_shows(o) > 0;
    if (attempt == FRESH) return shows || (is_thrown && is_far(o, s->cloth.push.field.cap));
    return shows && !attempt_is_hopeless(&s->cloth, o);
}

/* Only tight garments: a loose one nearly always finds room. */
static bool may_go_slowly(const Solver *s) { return !s->cloth.fit->garment->loose; }

/* Where the body leaves a tight garment no room, the best way out is another one in every frame, and cloth would fly to
   and fro. So there its displacement may change by SLOW at most, unless the body would be deeper in it then. */
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
    slow.push.capped = best->push.capped;
    *best = slow;
}

static Wrong push_and_test(Solver *s, const BodyFrame *body, double dt, Tie tie, FrameStats *stats) {
    Cloth *c = &s->cloth;
    double cap = c->push.field.cap;
    bool is_thrown = s->is_thrown && tie == TIE_GOES_ON;
    prepare(s, CARRIED);
    Outcome best = attempt_push(c, body, stats);
    stats->sweeps = best.push.sweeps;
    for (int k = FRESH; k < ATTEMPTS && is_wanting(s, &best, k, is_thrown); k++) {
        keep(s);
        c->settler.denter.is_off = outcome_shows(&best) > 0;
        prepare(s, k);
        Outcome other = attempt_push(c, body, stats);
        stats->sweeps += other.push.sweeps;
        if (is_better(&other, &best, cap)) best = other;
        else take_back(s, body, stats);
    }
    c->settler.denter.is_off = false;
    bool goes_slowly = tie == TIE_GOES_ON && may_go_slowly(s) && outcome_shows(&best) > 0;
    if (goes_slowly) go_slowly(s, body, dt, &best, stats);
    if (tie != TIE_ASTRAY) s->is_thrown = is_far(&best, cap) && (is_thrown || outcome_shows(&best) > 0);
    stats->capped |= best.push.capped;
    stats->active = best.push.active;
    stats->pinched = attempt_pinched(c, body);
    stats->displacement = best.push.displacement;
    return best.wrong;
}

/* Takes over the displacement of the frame before. Frames that are astray leave nothing behind: the first of them puts
   field and morph aside, and the first frame after them goes on from there. */
static void carry(Solver *s, const BodyFrame *body, double dt, Tie tie) {
    Cloth *c = &s->cloth;
    if (tie == TIE_ASTRAY && !s->is_astray) {
        field_copy(&c->push.field, &s->before);
        morph_copy(&c->morph, &s->morph_before);
    }
    if (tie == TIE_GOES_ON && s->is_astray) {
        field_copy(&s->before, &c->push.field);
        morph_copy(&s->morph_before, &c->morph);
    }
    s->is_astray = tie == TIE_ASTRAY;
    dent_carry(&c->settler.denter, &c->push.field, body, dt, tie == TIE_GOES_ON);
    field_carry(&c->push.field, body, dt, tie != TIE_GOES_ON, &c->leaves);
    if (tie == TIE_GOES_ON && may_go_slowly(s)) field_copy(&c->push.field, &s->before);
    Leaves *wanted = s->fixed_topology ? &s->grid : &c->leaves;
    morph_carry(&c->morph, dt, tie != TIE_GOES_ON, wanted, &s->fresh);
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
    w = attempt_raise_flat(&s->cloth, body, w, stats);
    stats->capped |= !is_global && residual_total(&w.own) + residual_total(&w.other) > 0;
    return w;
}
