/* An arm that lies on a skirt, or hangs into it, presses a hollow. If limbs from outside pushed in the sweeps, they
   would fight with the legs: a displacement that makes room for the one takes it from the other. So they come after
   the sweeps, and own parts win.

   The hollow of each limb is one number at each vertex: how far the limb presses it in, all in the same direction.
   These numbers change so little from vertex to vertex that no edge is torn (dress/slope); so two hollows may lie in
   one place and add up to cloth that is whole. Where cloth cannot get out of a limb's way like that, or would have to
   go beyond the cap, it is better that the limb shows, and is reported.

   All of this changes little if the pose changes little, except where the room ends. So a hollow gets deeper at
   once, but fills again slowly (dent_carry). */
#include "dress/dent.h"

#include <string.h>

static const double CHORD = 0.03;     /* share of its depth added to the clearance: facets cut across a round hollow */
static const double BACK = 0.005;     /* metres on 1.70 m that a vertex is taken back the first time; */
static const double MOST_BACK = 0.03; /* after so much in all it is no longer pressed in */
static const double TURNS = 15;       /* radians a second by which the direction of a limb may turn: with much less it
                                         would press where the limb no longer is */
static const double LEAST = 0.999;    /* cloth follows if it may keep no more than this share of its dent */
enum { LOOSE_A_PLACE = 4 };           /* so often may it do so for each place */

bool dent_reserve(Denter *d, const Lattice *lattice, Arena *arena, Error *e) {
    *d = (Denter){.nplaces = lattice->nplaces};
    for (int limb = 0; limb < LIMBS; limb++) {
        d->depth[limb] = ARENA_NEW(arena, double, lattice->nplaces, e);
        d->held[limb] = ARENA_NEW(arena, double, lattice->nplaces, e);
        d->wanted[limb] = ARENA_NEW(arena, double, lattice->nplaces, e);
        if (!d->depth[limb] || !d->held[limb] || !d->wanted[limb]) return false;
    }
    d->is_out_of_reach = ARENA_NEW(arena, bool, lattice->nplaces, e);
    d->kept_out_of_reach = ARENA_NEW(arena, bool, lattice->nplaces, e);
    d->spare = ARENA_NEW(arena, double, lattice->nplaces, e);
    d->is_back = ARENA_NEW(arena, bool, lattice->nplaces, e);
    d->back = ARENA_NEW(arena, int, lattice->nplaces, e);
    d->loose = ARENA_NEW(arena, int, LOOSE_A_PLACE * lattice->nplaces, e);
    return d->is_out_of_reach && d->kept_out_of_reach && d->spare && d->is_back && d->back && d->loose &&
           hollow_reserve(&d->hollow, arena, e) && slopes_reserve(&d->slopes, lattice, arena, e);
}

void dent_carry(Denter *d, const Field *last, const BodyFrame *body, double dt, bool goes_on) {
    Carry carry = field_carry_to(last, body, dt);
    d->turn = TURNS * dt;
    for (int limb = 0; limb < LIMBS; limb++) {
        const FieldSpots *dent = &last->dent[limb];
        if (d->is_held[limb]) memset(d->held[limb], 0, (size_t)d->nplaces * sizeof(double));
        d->is_held[limb] = false;
        d->held_way[limb] = mat_apply(carry.turn, last->way[limb]);
        for (int k = 0; goes_on && k < dent->n; k++) {
            double deep = vec_dot(dent->at[dent->place[k]], last->way[limb]);
            Vec3 held = vec_scale(last->way[limb], deep);
            if (deep <= 0 || !field_carry_one(&held, &carry)) continue;
            d->held[limb][dent->place[k]] = vec_len(held);
            d->is_held[limb] = true;
        }
    }
}

void dent_start(Denter *d) {
    dent_round(d);
    if (d->any_spare) memset(d->spare, 0, (size_t)d->nplaces * sizeof *d->spare);
    d->any_spare = false;
}

void dent_keep(Denter *d) { memcpy(d->kept_out_of_reach, d->is_out_of_reach, (size_t)d->nplaces * sizeof(bool)); }

void dent_restore(Denter *d) { memcpy(d->is_out_of_reach, d->kept_out_of_reach, (size_t)d->nplaces * sizeof(bool)); }

void dent_round(Denter *d) {
    for (int k = 0; k < d->nback; k++) d->is_back[d->back[k]] = false;
    d->nback = 0;
}

/* Sets the depth of a limb's hollow at every vertex: as deep as the limb presses, or as it still is from the frame
   before; false if it is 0 everywhere. */
static bool find_depths(Denter *d, const Push *p, const Touch *t, Limb limb) {
    memset(d->depth[limb], 0, (size_t)p->sheet->nvertices * sizeof(double));
    if (d->is_off || !(t->parts[limb] || d->is_held[limb])) return false;
    hollow_find(&d->hollow, p, t, limb);
    for (int v = 0; v < p->sheet->nvertices; v++) {
        int place = p->sheet->place[v];
        if (d->spare[place] > MOST_BACK * p->field.scale) continue;
        d->depth[limb][v] = fmax(hollow_depth(&d->hollow, p, v), d->held[limb][place]);
        d->is_out_of_reach[place] |= d->depth[limb][v] >= p->field.cap;
    }
    return true;
}

/* What the hollows make of the dents of a vertex. */
static Dents hollows_at(const Denter *d, const Push *p, int vertex) {
    Dents hollows;
    for (int limb = 0; limb < LIMBS; limb++)
        hollows.by[limb] = vec_scale(p->field.way[limb], d->depth[limb][vertex]);
    return hollows;
}

/* Makes hollows shallower where own parts leave less room. */
static void make_room(Denter *d, const Push *p) {
    for (int v = 0; v < p->sheet->nvertices; v++) {
        Vec3 dent = dents_sum(hollows_at(d, p, v));
        double depth = vec_len(dent);
        if (depth <= 0) continue;
        int place = p->sheet->place[v];
        double clearance = p->clearance[v] + d->spare[place] + CHORD * depth, most = fmin(depth, p->field.cap);
        double room = escape_free(&p->escape, p->body, place, p->point[v], clearance, vec_scale(dent, 1 / depth), most);
        for (int limb = 0; limb < LIMBS; limb++) d->depth[limb][v] *= room / depth;
    }
}

/* Makes them shallower where cloth would be torn. has: of which limbs are there any? */
static void level(Denter *d, const Push *p, const bool has[LIMBS], bool *capped) {
    int n = p->sheet->nvertices;
    for (int limb = 0; limb < LIMBS; limb++) memcpy(d->wanted[limb], d->depth[limb], (size_t)n * sizeof(double));
    for (int limb = 0; limb < LIMBS; limb++) {
        if (has[limb] && !slopes_level(&d->slopes, p, (Limb)limb, d->wanted, d->depth[limb])) *capped = true;
        for (int v = 0; v < n; v++) d->is_out_of_reach[p->sheet->place[v]] |= d->depth[limb][v] < d->wanted[limb][v];
    }
}

static void set_dents(Push *p, int vertex, Dents dents, bool *capped) {
    int place = p->sheet->place[vertex];
    push_vertex(p, vertex, vec_sub(dents_sum(dents), field_dent(&p->field, place)), capped);
    field_set_dents(&p->field, place, dents);
}

/* The direction in which a limb presses. It comes from the cloth, which is folded and may turn in a moment. So while
   there is a hollow of the frame before, the direction goes on from what it was then. */
static Vec3 way_of(const Denter *d, const Touch *t, Limb limb) {
    if (!t->parts[limb] || !d->is_held[limb]) return t->parts[limb] ? t->way[limb] : d->held_way[limb];
    Vec3 from = d->held_way[limb], to = t->way[limb], axis = vec_cross(from, to);
    double angle = atan2(vec_len(axis), vec_dot(from, to));
    if (angle <= d->turn) return to;
    return mat_apply(mat_axis_angle(vec_unit_or(axis, vec(0, 1, 0)), d->turn), from);
}

void dent_all(Denter *d, Push *p, bool *capped) {
    const Sheet *sheet = p->sheet;
    Touch t = touch_find(p);
    bool has[LIMBS], any = false;
    memset(d->is_out_of_reach, d->is_off, (size_t)d->nplaces * sizeof *d->is_out_of_reach);
    for (int limb = 0; limb < LIMBS; limb++) {
        p->field.way[limb] = way_of(d, &t, (Limb)limb);
        has[limb] = find_depths(d, p, &t, (Limb)limb);
        any |= has[limb];
    }
    if (!any) return;
    make_room(d, p);
    level(d, p, has, capped);
    for (int v = 0; v < sheet->nvertices; v++) {
        Dents hollows = hollows_at(d, p, v);
        bool is_short = false;
        if (field_is_zero(dents_sum(hollows))) continue;
        set_dents(p, v, hollows, &is_short);
        d->is_out_of_reach[sheet->place[v]] |= is_short;
        *capped |= is_short;
    }
}

void dent_add(Denter *d, Push *p, int vertex, int part, Vec3 by, double most, bool *capped) {
    Limb limb = limb_of(p->body, part);
    double share = slopes_share(&d->slopes, p, vertex, by);
    bool is_short = share < 1;
    Dents dents = field_dents(&p->field, p->sheet->place[vertex]);
    Vec3 hollow = hollows_at(d, p, vertex).by[limb];
    Vec3 more = vec_sub(vec_mad(dents.by[limb], by, share), hollow);
    dents.by[limb] = vec_add(hollow, field_limit(more, most, &is_short));
    set_dents(p, vertex, dents, &is_short);
    d->is_out_of_reach[p->sheet->place[vertex]] |= is_short;
    *capped |= is_short;
}

/* Shortens the dents of a vertex to a share. */
static void shorten(Push *p, int vertex, double share) {
    Dents dents = field_dents(&p->field, p->sheet->place[vertex]);
    bool capped;
    for (int limb = 0; limb < LIMBS; limb++) dents.by[limb] = vec_scale(dents.by[limb], share);
    set_dents(p, vertex, dents, &capped);
}

/* Cloth round a vertex whose dents were shortened is drawn along, and the cloth round that. */
static void draw_along(Denter *d, Push *p, int vertex, bool *capped) {
    d->loose[0] = vertex;
    d->nloose = 1;
    for (int k = 0; k < d->nloose; k++) {
        int n;
        const int *beside = slopes_beside(&d->slopes, p->sheet, d->loose[k], &n);
        for (int i = 0; i < n; i++) {
            double share = slopes_keeps(p, beside[i], d->loose[k]);
            if (share > LEAST) continue;
            if (d->nloose == LOOSE_A_PLACE * d->nplaces) {
                *capped = true;
                return;
            }
            shorten(p, beside[i], share);
            d->is_out_of_reach[p->sheet->place[beside[i]]] = true;
            d->loose[d->nloose++] = beside[i];
        }
    }
}

void dent_back(Denter *d, Push *p, int vertex, bool *capped) {
    int place = p->sheet->place[vertex];
    double depth = vec_len(field_dent(&p->field, place)), *spare = &d->spare[place];
    d->nloose = 0;
    if (d->is_back[place] || depth <= 0) return;
    double step = *spare + BACK * p->field.scale;
    *spare += step;
    d->any_spare = true;
    bool is_out = *spare > MOST_BACK * p->field.scale || step >= depth;
    shorten(p, vertex, is_out ? 0 : 1 - step / depth);
    draw_along(d, p, vertex, capped);
    d->back[d->nback++] = place;
    d->is_back[place] = true;
}
