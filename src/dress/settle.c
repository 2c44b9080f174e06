/* The field is smooth between level vertices, so it cannot satisfy every vertex of the mesh: where a facet cuts
   across a bulge, or where an arm touches a skirt. What is missing then is small. The vertex is moved by itself,
   after the sweeps: by an offset, no longer than what would be seen as a spike. */
#include "dress/settle.h"

enum { STEPS_MAX = 4 };
static const double AT_REST = 0.05; /* share of its clearance: a vertex whose last step was shorter has come to rest */
static const double RAISE_MAX = 0.015; /* most extra clearance, metres on 1.70 m */
static const double OFFSET_MAX = 0.03; /* longest offset: more would be a spike; metres on 1.70 m */
static const double JUST_CLEAR = 0.5;  /* share of PUSH_MARGIN by which a facet that crosses a part is moved off it. It
                                          sinks in again by less than a millimetre in a frame; with the whole margin
                                          it would jump in every tenth frame */

bool settle_reserve(Settler *s, const Lattice *lattice, Arena *arena, Error *e) {
    *s = (Settler){.nraised = 0};
    s->raised = ARENA_NEW(arena, int, lattice->nplaces, e);
    s->is_listed = ARENA_NEW(arena, bool, lattice->nplaces, e);
    return s->raised && s->is_listed && dent_reserve(&s->denter, lattice, arena, e);
}

void settle_start(Settler *s) {
    for (int k = 0; k < s->nraised; k++) s->is_listed[s->raised[k]] = false;
    s->nraised = s->nmarked = 0;
    dent_start(&s->denter);
}

/* Parts nearer than `far` to p: bits 1 << part. */
static unsigned parts_near(const BodyFrame *body, BodyPoint *p, double far) {
    unsigned near = 0;
    for (int k = 0; k < body->body->nparts; k++)
        if (body_point_unpressed(body, k, p, far) < far) near |= 1u << k;
    return near;
}

/* Moves a vertex by a vector because of a part: by a deeper dent if the part is bare, else by an offset. */
static void move(Settler *s, Push *p, int vertex, Vec3 by, int part, bool *capped) {
    double most = OFFSET_MAX * p->field.scale;
    if (limb_is_bare(p, part)) {
        dent_add(&s->denter, p, vertex, part, by, most, capped);
        return;
    }
    int place = p->sheet->place[vertex];
    Vec3 offset = p->field.offset.at[place];
    Vec3 longer = field_limit(vec_add(offset, by), most, capped);
    push_vertex(p, vertex, vec_sub(longer, offset), capped);
    field_set_spot(&p->field.offset, place, longer);
}

/* The vector that takes a vertex at `at` out of a part; false if there is none. For a part from outside it leads
   into the garment, or, if that is too far, the nearest way out, and only as far as the own parts leave room. */
static bool step_out(const Push *p, EscapePoint *at, int part, Vec3 *step) {
    const BodyFrame *body = p->body;
    Vec3 n, plain;
    double distance = body_point_distance(body, part, &at->point, at->clearance, &plain);
    double most = OFFSET_MAX * p->field.scale;
    n = plain;
    double way = escape_asked(&p->escape, body, at, part, distance, &n);
    if (way <= 0) return false;
    if (!escape_is_own(&p->escape, body, at->place, part)) {
        if (way > most) {
            way = at->clearance - distance;
            n = plain;
            if (way > most) return false;
        }
        way = escape_free(&p->escape, body, at->place, at->point.at, at->clearance, n, way);
    }
    *step = vec_scale(n, way);
    return way > 0;
}

/* Takes a vertex out of all parts that it is too near to. */
static void settle_vertex(Settler *s, Push *p, int vertex, bool *capped) {
    const BodyFrame *body = p->body;
    const Near *seen = &p->near[vertex];
    if (near_slack(seen->least, p->clearance[vertex]) > vec_dist(p->point[vertex], seen->seen)) return;
    EscapePoint at;
    escape_at(&at, p->sheet->place[vertex], p->point[vertex], p->clearance[vertex]);
    at.near = parts_near(body, &at.point, at.clearance);
    double moved = INFINITY;
    for (int step = 0; step < STEPS_MAX && moved > 0; step++) {
        moved = 0;
        for (unsigned left = at.near; left; left &= left - 1) {
            int part = near_first(left);
            Vec3 by;
            if (!step_out(p, &at, part, &by)) continue;
            move(s, p, vertex, by, part, capped);
            body_point_move(&at.point, p->point[vertex]);
            moved = fmax(moved, vec_len(by));
        }
    }
    *capped |= moved > AT_REST * at.clearance;
}

void settle_all(Settler *s, Push *p, bool *capped) {
    dent_all(&s->denter, p, capped);
    for (int v = 0; v < p->sheet->nvertices; v++) settle_vertex(s, p, v, capped);
}

void settle_raised(Settler *s, Push *p, bool *capped) {
    for (int k = 0; k < s->nraised; k++) settle_vertex(s, p, s->raised[k], capped);
}

static void list(Settler *s, int vertex) {
    if (!s->is_listed[vertex]) s->raised[s->nraised++] = vertex;
    s->is_listed[vertex] = true;
}

static bool is_raised(const Push *p, int vertex) { return p->clearance[vertex] > PUSH_MARGIN * p->field.scale; }

bool settle_raise(Settler *s, Push *p, int vertex, double by, double most) {
    double limit = (PUSH_MARGIN + fmin(most, RAISE_MAX)) * p->field.scale;
    if (p->clearance[vertex] >= limit) return false;
    list(s, vertex);
    p->clearance[vertex] = fmin(p->clearance[vertex] + by * p->field.scale, limit);
    return true;
}

/* Moves the vertices of a hit by the least that takes the point where it crosses as far off the part as it should
   be. */
static void move_off(Settler *s, Push *p, const TesterHit *hit, bool *capped) {
    const BodyFrame *body = p->body;
    int place = p->sheet->place[tester_hit_vertex(hit)];
    bool is_worn = escape_is_own(&p->escape, body, place, hit->part);
    double clearance = (is_worn ? JUST_CLEAR : 1) * PUSH_MARGIN * p->field.scale, norm2 = 0;
    EscapePoint at;
    Vec3 x = tester_hit_point(hit, p->point), n;
    double distance = body_frame_distance(body, hit->part, x, clearance, &n);
    if (distance >= clearance) return; /* another hit has moved it */
    escape_at(&at, place, x, clearance);
    double way = escape_way(&p->escape, body, &at, hit->part, clearance, distance, &n);
    if (way > OFFSET_MAX * p->field.scale) return; /* out of reach */
    for (int c = 0; c < hit->n; c++) norm2 += hit->weight[c] * hit->weight[c];
    for (int c = 0; c < hit->n; c++) {
        int v = hit->v[c];
        double by = way * hit->weight[c] / norm2;
        if (!is_worn) by = escape_free(&p->escape, body, p->sheet->place[v], p->point[v], clearance, n, by);
        if (by > 0) move(s, p, v, vec_scale(n, by), hit->part, capped);
    }
}

/* Takes the dent of a vertex back. Others that follow it are tested again like raised ones. */
static void take_back(Settler *s, Push *p, int vertex, bool *capped) {
    Denter *d = &s->denter;
    dent_back(d, p, vertex, capped);
    for (int k = 0; k < d->nloose; k++) list(s, d->loose[k]);
}

/* If the part is an own one, a hollow that an arm presses may be the reason: then the vertices are taken back out of
   it. Moving them off waits until all of them were raised, which is often enough. */
void settle_hit(Settler *s, Push *p, const TesterHit *hit, bool *capped) {
    bool is_worn_over = p->field.lattice->fit->collide & part_bit(p->body, hit->part);
    bool is_all_raised = true;
    for (int c = 0; c < hit->n; c++) {
        if (is_worn_over) take_back(s, p, hit->v[c], capped);
        is_all_raised = is_all_raised && is_raised(p, hit->v[c]);
    }
    if (is_all_raised) move_off(s, p, hit, capped);
}

void settle_mark(Settler *s, const Push *p) {
    dent_round(&s->denter);
    s->nmarked = s->nraised;
    for (int k = 0; k < s->nmarked && k < MARKED_MOST; k++) {
        s->was_offset[k] = p->field.offset.at[p->sheet->place[s->raised[k]]];
        s->were_dents[k] = field_dents(&p->field, p->sheet->place[s->raised[k]]);
        s->was_point[k] = p->point[s->raised[k]];
    }
}

bool settle_restore(const Settler *s, Push *p) {
    for (int k = 0; k < s->nmarked && s->nmarked <= MARKED_MOST; k++) {
        field_set_spot(&p->field.offset, p->sheet->place[s->raised[k]], s->was_offset[k]);
        field_set_dents(&p->field, p->sheet->place[s->raised[k]], s->were_dents[k]);
        p->point[s->raised[k]] = s->was_point[k];
    }
    return s->nmarked <= MARKED_MOST;
}
