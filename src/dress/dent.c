/* An arm that lies on a skirt, or hangs into it, presses a hollow. If arms pushed in the sweeps, they would fight
   with the legs: a displacement that makes room for the one takes it from the other. So arms come after the sweeps,
   and own parts win.

   Each arm that touches the cloth presses in one direction: into the garment, but not along the arm, which would
   only carry the cloth down. All cloth on that side that is in the arm, or outside of it, is moved until the arm is
   behind it, as far as the own parts leave room. Cloth round about moves too, less with distance, and the hollow's
   sides are made so flat that they neither look like a spike nor fold over.

   All of this changes little if the pose changes little, except where the room ends. So a hollow gets deeper at
   once, but fills again slowly (dent_carry). */
#include "dress/dent.h"

#include <stdlib.h>
#include <string.h>

#include "figure/relax.h"
#include "geometry/boxtree.h"

enum { STEPS_BACK = 24, LEVEL_ROUNDS = 40 };
static const double MEETS = 0.05;              /* share of the clearance that may be missing between cloth and arm */
static const double WIDE = 0.05, WIDENS = 1.2; /* radius of a hollow: metres on 1.70 m, and this times its depth */
static const double FACES = 0.5;      /* cosine between a vertex's inward normal and the arm's direction, from which on
                                         it is pressed in fully */
static const double STEEP = 2;        /* of a hollow's sides: difference of depths per distance of two neighbours; */
static const double SHRINKS = 0.8;    /* if that moves one towards the other, at most this share of their distance */
static const double CHORD = 0.03;     /* share of its depth added to the clearance: facets cut across a round hollow */
static const double POINTED = 0.3;    /* squared sine between forearm and direction: below it the arm pokes the cloth,
                                         rather than lies on it */
static const double BACK = 0.005;     /* metres on 1.70 m that a vertex is taken back the first time; */
static const double MOST_BACK = 0.03; /* after so much in all it is no longer pressed in */

bool dent_reserve(Denter *d, const Lattice *lattice, Arena *arena, Error *e) {
    *d = (Denter){.nplaces = lattice->nplaces};
    d->presser = ARENA_NEW(arena, Presser, lattice->nplaces, e);
    d->way = ARENA_NEW(arena, Vec3, lattice->nplaces, e);
    d->depth = ARENA_NEW(arena, double, lattice->nplaces, e);
    d->hollow = ARENA_NEW(arena, Vec3, lattice->nplaces, e);
    d->spare = ARENA_NEW(arena, double, lattice->nplaces, e);
    d->is_back = ARENA_NEW(arena, bool, lattice->nplaces, e);
    d->back = ARENA_NEW(arena, int, lattice->nplaces, e);
    d->block = ARENA_NEW(arena, PresserBlock, lattice->nplaces / PRESSERS_A_BLOCK + ARMS, e);
    d->slope = ARENA_NEW(arena, int, 3 * lattice_triangles(lattice), e);
    return d->block && d->slope && d->presser && d->way && d->depth && d->hollow && d->spare && d->is_back && d->back &&
           field_reserve_spots(&d->held, lattice->nplaces, arena, e);
}

void dent_carry(Denter *d, const Field *last, const BodyFrame *body, double dt, bool goes_on) {
    Carry carry = field_carry_to(last, body, dt);
    field_drop_spots(&d->held);
    for (int k = 0; goes_on && k < last->dent.n; k++) {
        int place = last->dent.place[k];
        Vec3 dent = last->dent.at[place];
        if (field_carry_one(&dent, &carry)) field_set_spot(&d->held, place, dent);
    }
}

void dent_start(Denter *d) {
    dent_round(d);
    if (d->any_spare) memset(d->spare, 0, (size_t)d->nplaces * sizeof *d->spare);
    d->any_spare = false;
}

void dent_round(Denter *d) {
    for (int k = 0; k < d->nback; k++) d->is_back[d->back[k]] = false;
    d->nback = 0;
}

/* The arm that a part belongs to: ARM_LEFT, ARM_RIGHT, or something else for parts of no arm. */
static int arm_of(const BodyFrame *body, int part) { return role_limb(body->body->part[part].role) - 1; }

/* The inward unit normal of the global shape at a place. */
static Vec3 inwards(const Push *p, int place) {
    return vec_scale(lattice_normal(p->field.lattice, p->escape.root, place), -1);
}

/* The parts of arms that the garment is not worn over, bits 1 << part. */
static unsigned bare_arms(const Push *p) {
    const BodyFrame *body = p->body;
    unsigned parts = 0;
    for (int k = 0; k < body->body->nparts; k++) {
        bool is_arm = arm_of(body, k) == ARM_LEFT || arm_of(body, k) == ARM_RIGHT;
        if (is_arm && !(p->field.lattice->fit->collide & part_bit(body, k))) parts |= 1u << k;
    }
    return parts;
}

/* What touches the cloth, for each arm. */
typedef struct {
    unsigned parts[ARMS];  /* its bare parts, bits 1 << part; 0 if it touches nothing */
    Vec3 way[ARMS];        /* the direction in which it presses, unit */
    Box before[ARMS];      /* holds all cloth that it may press in */
} Touch;

/* Adds the parts that a vertex is too near to. Its inward normal counts for their direction, weighted by what is
   missing of its clearance. */
static void add_touch(Touch *t, const Push *p, int vertex, unsigned parts) {
    const BodyFrame *body = p->body;
    double clearance = PUSH_MARGIN * p->field.scale;
    int place = p->sheet->place[vertex];
    for (; parts; parts &= parts - 1) {
        int k = near_first(parts);
        if (p->field.lattice->collide[place] & part_bit(body, k)) continue;
        if (body_frame_far(body, k, p->point[vertex], clearance)) continue;
        double missing = clearance - body_frame_distance(body, k, p->point[vertex], clearance, NULL);
        if (missing <= 0) continue;
        int arm = arm_of(body, k);
        t->way[arm] = vec_mad(t->way[arm], inwards(p, place), missing);
        t->parts[arm] |= 1u << k;
    }
}

/* The direction of an arm, made perpendicular to the forearm; but not if the arm stands straight on the cloth and pokes
   it. */
static Vec3 across_arm(const BodyFrame *body, int arm, Vec3 way) {
    static const Role forearm[ARMS] = {ROLE_LEFT_FOREARM, ROLE_RIGHT_FOREARM};
    int part = body->body->of_role[forearm[arm]];
    if (part < 0) return way;
    Vec3 along = mat_column(body->to_world[part], 1);
    double c = vec_dot(way, along);
    return vec_unit_or(vec_mad(way, along, -c * smoothstep(0, POINTED, 1 - c * c)), way);
}

/* Completes what is known of an arm that touches: if one part of it does, all bare parts press. */
static void complete(Touch *t, const Push *p, int arm, unsigned bare) {
    const BodyFrame *body = p->body;
    double clearance = PUSH_MARGIN * p->field.scale;
    Vec3 far = vec(clearance, clearance, clearance);
    t->way[arm] = across_arm(body, arm, vec_unit_or(t->way[arm], vec(0, 0, 0)));
    t->before[arm] = box_empty();
    for (unsigned left = bare; left; left &= left - 1) {
        int k = near_first(left);
        if (arm_of(body, k) != arm) continue;
        t->parts[arm] |= 1u << k;
        Vec3 low = vec_sub(body->box[k].low, far), high = vec_add(body->box[k].high, far);
        for (int before = 0; before < 2; before++) {
            box_add(&t->before[arm], vec_mad(low, t->way[arm], before ? -p->field.cap : 0));
            box_add(&t->before[arm], vec_mad(high, t->way[arm], before ? -p->field.cap : 0));
        }
    }
}

static Touch find_touch(const Push *p) {
    Touch t = {.parts = {0}};
    unsigned bare = bare_arms(p);
    for (int v = 0; v < p->sheet->nvertices; v++) {
        double slack = near_slack(p->near[v].least, p->clearance[v]);
        if (slack <= vec_dist(p->point[v], p->near[v].seen)) add_touch(&t, p, v, bare);
    }
    for (int arm = 0; arm < ARMS; arm++)
        if (t.parts[arm]) complete(&t, p, arm, bare);
    return t;
}

/* One axis of a ray at + t n: cuts the interval from..to of t down to where the ray is between low and high. */
static void clip(double at, double n, double low, double high, double *from, double *to) {
    if (n == 0) {
        if (at < low || at > high) *to = -1;
        return;
    }
    double enters = ((n > 0 ? low : high) - at) / n, leaves = ((n > 0 ? high : low) - at) / n;
    if (enters > *from) *from = enters;
    if (leaves < *to) *to = leaves;
}

/* How far cloth at `at` has to go along n until a part is behind it: steps back from where the ray leaves the part's
   box, or from `most`, until it meets the part. 0: the ray does not meet it. */
static double way_past(const BodyFrame *body, int part, Vec3 at, Vec3 n, double clearance, double most) {
    const Box *b = &body->box[part];
    double from = 0, way = most;
    clip(at.x, n.x, b->low.x - clearance, b->high.x + clearance, &from, &way);
    clip(at.y, n.y, b->low.y - clearance, b->high.y + clearance, &from, &way);
    clip(at.z, n.z, b->low.z - clearance, b->high.z + clearance, &from, &way);
    for (int step = 0; step < STEPS_BACK && way > from; step++) {
        double gap = near_slack(body_frame_distance(body, part, vec_mad(at, n, way), most, NULL), clearance);
        if (gap <= MEETS * clearance) return way;
        way -= gap;
    }
    return 0;
}

/* From 0 to 1: how far cloth with that inward normal is pressed in by an arm that presses along n. Cloth on the far
   side of the garment is not. */
static double facing(Vec3 inwards, Vec3 n) { return smoothstep(0, FACES, vec_dot(inwards, n)); }

/* Does an arm press a vertex in? *out: by the part that does so farthest. */
static bool find_presser(const Push *p, int vertex, const Touch *t, int arm, Presser *out) {
    const BodyFrame *body = p->body;
    int place = p->sheet->place[vertex];
    double clearance = PUSH_MARGIN * p->field.scale, depth = 0;
    Vec3 at = p->point[vertex], n = t->way[arm];
    for (unsigned left = t->parts[arm]; left; left &= left - 1) {
        int k = near_first(left);
        if (p->field.lattice->collide[place] & part_bit(body, k)) continue;
        depth = fmax(depth, way_past(body, k, at, n, clearance, p->field.cap));
    }
    if (depth > 0) depth *= facing(inwards(p, place), n);
    if (depth > 0) depth = escape_free(&p->escape, body, place, at, clearance, n, depth);
    *out = (Presser){at, depth, WIDE * p->field.scale + WIDENS * depth};
    return depth > 0;
}

/* The hollow of an arm in this frame: the deepest of its pressers' hollows everywhere. Vertices that follow each
   other are near each other, so a box round sixteen pressers rules out most of them at once. */
typedef struct {
    Vec3 way;
    const PresserBlock *block;
    int nblocks;
    Box reach;
} Hollow;

/* Adds a presser to the last block, or to a new one. */
static void add_presser(Denter *d, Hollow *h, const Presser *by) {
    if (h->nblocks == 0 || d->block[d->nblocks - 1].n == PRESSERS_A_BLOCK) {
        d->block[d->nblocks++] = (PresserBlock){.presser = d->presser + d->npressers, .box = box_empty()};
        h->nblocks++;
    }
    PresserBlock *last = &d->block[d->nblocks - 1];
    d->presser[d->npressers++] = *by;
    last->n++;
    last->deepest = fmax(last->deepest, by->depth);
    last->radius = fmax(last->radius, by->radius);
    box_add(&last->box, by->at);
    Vec3 far = vec_scale(vec(1, 1, 1), by->radius);
    box_add(&h->reach, vec_sub(by->at, far));
    box_add(&h->reach, vec_add(by->at, far));
}

static int deepest_first(const void *a, const void *b) {
    const PresserBlock *x = a, *y = b;
    if (x->deepest != y->deepest) return x->deepest > y->deepest ? -1 : 1;
    return x->presser < y->presser ? -1 : 1;
}

static Hollow find_hollow(Denter *d, const Push *p, const Touch *t, int arm) {
    Hollow h = {.way = t->way[arm], .block = d->block + d->nblocks, .reach = box_empty()};
    for (int v = 0; v < p->sheet->nvertices && d->npressers < d->nplaces; v++) {
        Presser by;
        if (box_touches(t->before[arm], (Box){p->point[v], p->point[v]}) && find_presser(p, v, t, arm, &by))
            add_presser(d, &h, &by);
    }
    qsort(d->block + d->nblocks - h.nblocks, (size_t)h.nblocks, sizeof *d->block, deepest_first);
    return h;
}

/* The depth of a hollow of that depth and radius at a squared distance from its middle. */
static double depth_beside(double depth, double radius, double away2) {
    double radius2 = radius * radius, rest = 1 - away2 / radius2;
    return away2 < radius2 ? rest * rest * depth : 0;
}

/* How deep a hollow is at x. Blocks that can make it no deeper are left out. */
static double depth_at(const Hollow *h, Vec3 x) {
    double depth = 0;
    for (const PresserBlock *b = h->block; b < h->block + h->nblocks; b++) {
        if (b->deepest <= depth || depth_beside(b->deepest, b->radius, box_distance2(b->box, x)) <= depth) continue;
        for (const Presser *by = b->presser; by < b->presser + b->n; by++) {
            Vec3 off = vec_sub(x, by->at);
            depth = fmax(depth, depth_beside(by->depth, by->radius, vec_dot(off, off)));
        }
    }
    return depth;
}

/* Sets depth and way of a vertex: pressed in by arms, or still from the frame before, as far as there is room. */
static void find_depth(Denter *d, const Push *p, int vertex, const Hollow *hollow, int nhollows) {
    int place = p->sheet->place[vertex];
    Vec3 at = p->point[vertex], way = d->held.at[place], n = {0, 0, 0};
    double depth = vec_len(way);
    d->depth[vertex] = 0;
    if (d->spare[place] > MOST_BACK * p->field.scale) return;
    for (int k = 0; k < nhollows; k++) {
        double deep = box_touches(hollow[k].reach, (Box){at, at}) ? depth_at(&hollow[k], at) : 0;
        if (deep <= 0) continue;
        if (vec_dot(n, n) == 0) n = inwards(p, place);
        deep *= facing(n, hollow[k].way);
        way = vec_mad(way, hollow[k].way, deep);
        depth = fmax(depth, deep);
    }
    if (depth <= 0) return;
    d->way[vertex] = vec_unit_or(way, inwards(p, place));
    double clearance = p->clearance[vertex] + d->spare[place] + CHORD * depth, most = fmin(depth, p->field.cap);
    d->depth[vertex] = escape_free(&p->escape, p->body, place, at, clearance, d->way[vertex], most);
}

/* By how much a vertex may be deeper than its neighbour, metres. */
static double step_between(const Denter *d, const Push *p, int deep, int other) {
    Vec3 to = vec_sub(p->point[other], p->point[deep]);
    double length = vec_len(to), towards = vec_dot(d->way[deep], to);
    return STEEP * towards > SHRINKS * length ? SHRINKS * length * length / towards : STEEP * length;
}

/* The edges in and round the hollows: depths elsewhere are 0 and stay so. */
static int find_slopes(const Denter *d, const Sheet *sheet) {
    int n = 0;
    for (int k = 0; k < sheet->nedges; k++) {
        const int *v = sheet->edge[k].v;
        if (d->depth[v[0]] > 0 || d->depth[v[1]] > 0) d->slope[n++] = k;
    }
    return n;
}

/* Makes vertices shallower until all such differences are small enough, so that cloth beside a vertex that has no room
   stays behind too. Returns whether they are. */
static bool level(const Denter *d, const Push *p) {
    int nslopes = find_slopes(d, p->sheet);
    bool moved = true;
    for (int round = 0; round < LEVEL_ROUNDS && moved; round++) {
        moved = false;
        for (int k = 0; k < nslopes; k++) {
            const int *v = p->sheet->edge[d->slope[round % 2 ? nslopes - 1 - k : k]].v;
            if (d->depth[v[0]] == d->depth[v[1]]) continue;
            int deep = v[d->depth[v[0]] < d->depth[v[1]]], other = v[0] + v[1] - deep;
            double most = d->depth[other] + step_between(d, p, deep, other);
            if (d->depth[deep] <= most) continue;
            d->depth[deep] = most;
            moved = true;
        }
    }
    return !moved;
}

static void set_dent(Push *p, int vertex, Vec3 dent, bool *capped) {
    int place = p->sheet->place[vertex];
    push_vertex(p, vertex, vec_sub(dent, p->field.dent.at[place]), capped);
    field_set_spot(&p->field.dent, place, dent);
}

void dent_all(Denter *d, Push *p, bool *capped) {
    const Sheet *sheet = p->sheet;
    Hollow hollow[ARMS];
    int n = 0;
    Touch t = {.parts = {0}};
    if (!d->is_off) t = find_touch(p);
    d->npressers = d->nblocks = 0;
    for (int arm = 0; arm < ARMS; arm++)
        if (t.parts[arm]) hollow[n++] = find_hollow(d, p, &t, arm);
    bool any = !d->is_off && d->npressers + d->held.n > 0;
    for (int v = 0; v < sheet->nvertices && any; v++) find_depth(d, p, v, hollow, n);
    if (any && !level(d, p)) *capped = true;
    for (int v = 0; v < sheet->nvertices && any; v++)
        if (d->depth[v] > 0) set_dent(p, v, vec_scale(d->way[v], d->depth[v]), capped);
    for (int v = 0; v < sheet->nvertices; v++) d->hollow[v] = p->field.dent.at[sheet->place[v]];
}

void dent_add(const Denter *d, Push *p, int vertex, Vec3 by, double most, bool *capped) {
    Vec3 more = vec_sub(vec_add(p->field.dent.at[p->sheet->place[vertex]], by), d->hollow[vertex]);
    set_dent(p, vertex, vec_add(d->hollow[vertex], field_limit(more, most, capped)), capped);
}

void dent_back(Denter *d, Push *p, int vertex) {
    int place = p->sheet->place[vertex];
    Vec3 dent = p->field.dent.at[place];
    if (d->is_back[place] || field_is_zero(dent)) return;
    double *spare = &d->spare[place], step = *spare + BACK * p->field.scale, depth = vec_len(dent);
    *spare += step;
    d->any_spare = true;
    bool capped, is_out = *spare > MOST_BACK * p->field.scale || step >= depth;
    set_dent(p, vertex, is_out ? vec(0, 0, 0) : vec_scale(dent, 1 - step / depth), &capped);
    d->back[d->nback++] = place;
    d->is_back[place] = true;
}
