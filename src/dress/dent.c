/* An arm that lies on a skirt presses a hollow into it. In the sweeps it would fight with the legs, for displacements
   that make room for the one take it from the others. So it comes after them, and they win: a vertex that the arm is
   too near to is pressed in as far as there is room in front of the legs, and the cloth round it goes along, the less
   the farther away it is, so that what comes of it is a hollow and no spike. Which way leads past fingers and wrist
   may change at a hair's breadth; so a hollow is pressed deeper at once, but fills with time. */
#include "dress/dent.h"

#include <stdlib.h>
#include <string.h>

#include "geometry/boxtree.h"

enum { PASSES = 2 }; /* a hollow may bring others to the arm that went past it */
static const double DEEPEST = 0.10;            /* metres on 1.70 m */
static const double BACK = 0.005, MOST_BACK = 0.03; /* first step out of a hollow; after so much it is given up */
static const double WIDE = 0.05, WIDENS = 2.5; /* radius of a hollow: that, and this times its depth */

bool dent_reserve(Denter *d, const Lattice *lattice, Arena *arena, Error *e) {
    *d = (Denter){.npressers = 0};
    d->presser = ARENA_NEW(arena, Presser, lattice->nplaces, e);
    d->hollow = ARENA_NEW(arena, Vec3, lattice->nplaces, e);
    d->held = ARENA_NEW(arena, Vec3, lattice->nplaces, e);
    d->held_at = ARENA_NEW(arena, int, lattice->nplaces, e);
    d->nplaces = lattice->nplaces;
    d->spare = ARENA_NEW(arena, double, lattice->nplaces, e);
    d->is_back = ARENA_NEW(arena, bool, lattice->nplaces, e);
    d->back = ARENA_NEW(arena, int, lattice->nplaces, e);
    return d->presser && d->hollow && d->held && d->held_at && d->spare && d->is_back && d->back;
}

void dent_carry(Denter *d, const Field *last, const BodyFrame *body, double dt, bool goes_on) {
    Carry carry = field_carry_to(last, body, dt);
    d->nheld = 0;
    for (int k = 0; goes_on && k < last->dent.n; k++) {
        int place = last->dent.place[k];
        Vec3 dent = last->dent.at[place];
        if (!field_carry_one(&dent, &carry)) continue;
        d->held[d->nheld] = dent;
        d->held_at[d->nheld++] = place;
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

/* The farthest that parts from outside press a vertex. Those that the garment is worn over elsewhere have moved it
   in the sweeps. */
static Vec3 press_of(const Push *p, const BodyFrame *body, const Sheet *sheet, int vertex) {
    const Lattice *l = p->field.lattice;
    int place = sheet->place[vertex];
    double most = DEEPEST * p->field.scale, farthest = 0;
    Vec3 press = {0, 0, 0}, n;
    EscapePoint at;
    escape_at(&at, place, p->point[vertex], PUSH_MARGIN * p->field.scale);
    for (int k = 0; k < body->body->nparts; k++) {
        if ((l->collide[place] | l->fit->collide) & part_bit(body, k)) continue;
        if (body_frame_far(body, k, at.point.at, at.clearance)) continue;
        double distance = body_point_distance(body, k, &at.point, at.clearance, &n);
        if (distance >= at.clearance) continue;
        double way = fmin(escape_way(&p->escape, body, &at, k, at.clearance, distance, &n), most);
        way = escape_free(&p->escape, body, place, at.point.at, at.clearance, n, way);
        if (way <= farthest) continue;
        farthest = way;
        press = vec_scale(n, way);
    }
    return press;
}

static int deepest_first(const void *a, const void *b) {
    const Presser *x = a, *y = b;
    if (x->depth != y->depth) return x->depth > y->depth ? -1 : 1;
    return x->vertex - y->vertex;
}

static void find_pressers(Denter *d, const Push *p, const BodyFrame *body, const Sheet *sheet) {
    d->npressers = 0;
    for (int v = 0; v < sheet->nvertices; v++) {
        Vec3 at = p->point[v];
        if (near_slack(p->near[v].least, p->clearance[v]) > vec_dist(at, p->near[v].seen)) continue;
        Vec3 press = press_of(p, body, sheet, v);
        double depth = vec_len(press);
        if (depth <= 0) continue;
        d->presser[d->npressers++] = (Presser){at, press, depth, WIDE * p->field.scale + WIDENS * depth, v};
    }
    qsort(d->presser, (size_t)d->npressers, sizeof *d->presser, deepest_first);
}

/* What the pressers make of a vertex at x: the deepest of their hollows there. */
static Vec3 hollow_at(const Denter *d, Vec3 x) {
    Vec3 hollow = {0, 0, 0};
    double deepest = 0;
    for (int k = 0; k < d->npressers && d->presser[k].depth > deepest; k++) {
        const Presser *by = &d->presser[k];
        Vec3 off = vec_sub(x, by->at);
        double rest = 1 - vec_dot(off, off) / (by->radius * by->radius);
        if (rest <= 0 || rest * rest * by->depth <= deepest) continue;
        deepest = rest * rest * by->depth;
        hollow = vec_scale(by->press, rest * rest);
    }
    return hollow;
}

/* All that any hollow reaches. */
static Box reach(const Denter *d) {
    Box box = box_empty();
    double widest = d->presser[0].radius;
    for (int k = 0; k < d->npressers; k++) box_add(&box, d->presser[k].at);
    Vec3 far = vec(widest, widest, widest);
    return (Box){vec_sub(box.low, far), vec_add(box.high, far)};
}

static void set_dent(Push *p, const Sheet *sheet, int vertex, Vec3 dent, bool *capped) {
    int place = sheet->place[vertex];
    push_vertex(p, vertex, vec_sub(dent, p->field.dent.at[place]), capped);
    field_set_spot(&p->field.dent, place, dent);
}

/* Presses a vertex in by `hollow`, as far as there is room. */
static void press_vertex(const Denter *d, Push *p, const BodyFrame *body, const Sheet *sheet, int vertex, Vec3 hollow) {
    int place = sheet->place[vertex];
    double depth = vec_len(hollow), clearance = p->clearance[vertex] + d->spare[place];
    if (depth <= 0 || d->spare[place] > MOST_BACK * p->field.scale) return;
    Vec3 at = p->point[vertex], n = vec_scale(hollow, 1 / depth);
    double way = escape_free(&p->escape, body, place, at, clearance, n, depth);
    if (way <= 0) return;
    bool capped;
    Vec3 deeper = vec_mad(p->field.dent.at[place], n, way);
    set_dent(p, sheet, vertex, field_limit(deeper, DEEPEST * p->field.scale, &capped), &capped);
}

static void press_held(const Denter *d, Push *p, const BodyFrame *body, const Sheet *sheet) {
    for (int k = 0; k < d->nheld; k++) {
        int vertex = sheet->vertex[d->held_at[k]];
        if (vertex >= 0) press_vertex(d, p, body, sheet, vertex, d->held[k]);
    }
}

static void press_in(const Denter *d, Push *p, const BodyFrame *body, const Sheet *sheet) {
    Box box = reach(d);
    for (int v = 0; v < sheet->nvertices; v++) {
        Vec3 at = p->point[v];
        if (box_touches(box, (Box){at, at})) press_vertex(d, p, body, sheet, v, hollow_at(d, at));
    }
}

void dent_all(Denter *d, Push *p, const BodyFrame *body, const Sheet *sheet) {
    if (!d->is_off) press_held(d, p, body, sheet);
    for (int pass = 0; pass < PASSES && !d->is_off; pass++) {
        find_pressers(d, p, body, sheet);
        if (d->npressers == 0) break;
        press_in(d, p, body, sheet);
    }
    for (int v = 0; v < sheet->nvertices; v++) d->hollow[v] = p->field.dent.at[sheet->place[v]];
}

void dent_add(const Denter *d, Push *p, const Sheet *sheet, int vertex, Vec3 by, double most, bool *capped) {
    Vec3 more = vec_sub(vec_add(p->field.dent.at[sheet->place[vertex]], by), d->hollow[vertex]);
    set_dent(p, sheet, vertex, vec_add(d->hollow[vertex], field_limit(more, most, capped)), capped);
}

void dent_back(Denter *d, Push *p, const Sheet *sheet, int vertex) {
    int place = sheet->place[vertex];
    Vec3 dent = p->field.dent.at[place];
    if (d->is_back[place] || field_is_zero(dent)) return;
    double *spare = &d->spare[place], step = *spare + BACK * p->field.scale, depth = vec_len(dent);
    *spare += step;
    d->any_spare = true;
    bool capped, is_out = *spare > MOST_BACK * p->field.scale || step >= depth;
    set_dent(p, sheet, vertex, is_out ? vec(0, 0, 0) : vec_scale(dent, 1 - step / depth), &capped);
    d->back[d->nback++] = place;
    d->is_back[place] = true;
}
