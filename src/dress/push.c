/* Local deformation as a feasibility problem: every mesh vertex must keep its clearance from the
   parts it collides with. A violated one is a half space; projecting onto half spaces in turn
   (Kaczmarz, POCS) needs no step size, so 30 and 120 frames a second give the same shape.

   The unknowns are the displacements of level vertices, coarse and fine together: a projection
   moves all that reach the sample, in proportion to their weights, by the least change; pinned ones
   give way last. What that cannot settle (a chord across a bulge) is left to offsets of single
   vertices. */
#include "dress/push.h"

#include <string.h>

/* Caps and tolerances, metres on a figure of 1.70 m where they are lengths. */
enum { SWEEPS_MAX = 30, STALL = 5, ROUNDS_MAX = 3, SETTLES_MAX = 4, STEPS_OUT = 6 };
static const double REACH = 0.04;      /* vertices farther from the body are not swept */
static const double SLACK = 0.1;       /* share of the clearance that may be missing after sweeps; settling makes
                                          up for it */
static const double PIN_GIVES = 0.2;   /* a pinned level vertex moves this share of what a free one would */
static const double NORM_MIN = 0.1;    /* a sample that level vertices hardly move must not fling them */
static const double BUDGET = 0.02;     /* a sample may issue twice its first violation and this */
static const double HEADWAY = 0.6;     /* pushes that get this share of their length nowhere are a pinch */
static const double OPPOSITE = -0.2;   /* cosine: normals of parts between which cloth is squeezed */
static const double WRONG_SIDE = 0.5;  /* cosine to the side at rest below which the normal is bent towards it */
static const double OUTWARDS = 0.3;    /* cosine: a limb from outside that would push cloth this much out of itself
                                          pushes it straight in */
static const double RAISE_MAX = 0.015; /* most extra clearance */
static const double OFFSET_MAX = 0.03; /* of a single vertex: more would be a spike */

bool push_reserve(Push *p, const Lattice *lattice, Arena *arena, Error *e) {
    *p = (Push){.lattice = lattice};
    if (!field_reserve(&p->field, lattice, arena, e) || !field_reserve(&p->kept, lattice, arena, e) ||
        !surface_reserve(&p->surface, lattice, arena, e))
        return false;
    int places = lattice->nplaces;
    p->active = ARENA_NEW(arena, bool, p->field.start[LATTICE_LEVELS], e);
    p->mobility = ARENA_NEW(arena, double, p->field.start[LATTICE_LEVELS], e);
    p->travel = ARENA_NEW(arena, double, p->field.start[LATTICE_LEVELS], e);
    p->rest = ARENA_NEW(arena, Vec3, places, e);
    p->global = ARENA_NEW(arena, Vec3, places, e);
    p->point = ARENA_NEW(arena, Vec3, places, e);
    p->kept_point = ARENA_NEW(arena, Vec3, places, e);
    p->clearance = ARENA_NEW(arena, double, places, e);
    p->near = ARENA_NEW(arena, Near, places, e);
    p->sample = ARENA_NEW(arena, PushSample, places, e);
    p->raised = ARENA_NEW(arena, int, places, e);
    if (!p->active || !p->mobility || !p->travel || !p->rest || !p->global || !p->point || !p->kept_point ||
        !p->clearance || !p->near || !p->sample || !p->raised)
        return false;
    return true;
}

void push_weigh(Push *p, double coarser) {
    const Lattice *l = p->lattice;
    for (int level = 0; level <= l->depth; level++) {
        double of_level = pow(coarser, l->depth - level);
        for (int v = 0; v < l->level[level].count; v++)
            p->mobility[p->field.start[level] + v] = (l->level[level].pinned[v] ? PIN_GIVES : 1) * of_level;
    }
}

void push_bind(Push *p, const Patch *root) {
    for (int place = 0; place < p->lattice->nplaces; place++) p->rest[place] = lattice_point(p->lattice, root, place);
}

/* A level vertex may move where all cells round it are split to its level. */
static void find_active(Push *p, const Leaves *leaves) {
    const Lattice *l = p->lattice;
    int cells = 1 << l->depth;
    for (int level = 0; level <= l->depth; level++) {
        const LatticeLevel *at = &l->level[level];
        int size = 1 << (l->depth - level);
        for (int v = 0; v < at->count; v++) {
            bool all = true;
            for (int k = at->first_cell[v]; all && k < at->first_cell[v + 1]; k++) {
                LatticeCell c = at->cell[k];
                all = leaves->level[(c.patch * cells + c.a * size) * cells + c.b * size] >= level;
            }
            p->active[p->field.start[level] + v] = all;
        }
    }
}

/* A vertex displaced by d: never farther than the cap, whatever the levels add up to. */
static Vec3 displaced(const Push *p, const Sheet *sheet, int vertex, Vec3 d) {
    bool capped = false;
    return vec_add(p->global[vertex],
                   field_limit(vec_add(d, p->field.offset[sheet->place[vertex]]), p->field.cap, &capped));
}

static void find_points(Push *p, const Sheet *sheet) {
    surface_field(&p->surface, sheet, &p->field, p->point);
    for (int v = 0; v < sheet->nvertices; v++) p->point[v] = displaced(p, sheet, v, p->point[v]);
}

static Vec3 sample_point(const Push *p, const Sheet *sheet, const PushSample *s) {
    Vec3 d = {0, 0, 0};
    for (int k = 0; k < s->n; k++) d = vec_mad(d, p->field.displacement[s->id[k]], s->weight[k]);
    return displaced(p, sheet, s->vertex, d);
}

/* Parts of `parts` that lie within `far` of x. */
static unsigned parts_near(const BodyFrame *body, unsigned parts, Vec3 x, double far) {
    unsigned near = 0;
    for (int k = 0; k < body->body->nparts; k++)
        if (parts & part_bit(body, k) && body_frame_unpressed(body, k, x, far) < far) near |= 1u << k;
    return near;
}

/* Parts that move the surface at a place: those that it is worn over, and those that the garment is worn
   over elsewhere, as the other leg is for one of trousers. */
static unsigned movers(const Push *p, int place) {
    const Lattice *l = p->lattice;
    return l->collide[place] | (l->outside[place] & l->fit->collide);
}

/* All that a place keeps out of. Arms that touch a skirt dent it by single vertices, after all else: coarse
   displacements for them and for the legs would fight. */
static unsigned parts_at(const Push *p, int place) { return p->lattice->collide[place] | p->lattice->outside[place]; }

/* Many samples are never moved nor asked again: what moves them is found when it is first needed. */
static void weigh(const Push *p, const Sheet *sheet, PushSample *s) {
    const Lattice *l = p->lattice;
    int patch, i, j, id[4];
    double weight[4];
    lattice_owner(l, sheet->place[s->vertex], &patch, &i, &j);
    s->n = 0;
    s->norm2 = 0;
    for (int level = 0; level <= l->depth; level++) {
        lattice_weights(l, level, patch, i, j, id, weight, NULL, NULL);
        for (int k = 0; k < 4; k++) {
            int unknown = p->field.start[level] + id[k];
            if (weight[k] <= 0 || !p->active[unknown]) continue;
            s->id[s->n] = unknown;
            s->weight[s->n++] = weight[k];
            s->norm2 += p->mobility[unknown] * weight[k] * weight[k];
        }
    }
}

/* Field by field: what moves it is filled in by weigh(), if ever. */
static void add_sample(Push *p, int vertex, unsigned parts, double far) {
    PushSample *s = &p->sample[p->nsamples++];
    s->vertex = vertex;
    s->n = -1;
    s->near = p->near[vertex];
    s->near.parts = parts;
    near_sum(&s->near, far);
    s->asked = 0;
    s->spent = s->travelled = 0;
    s->budget = -1;
    s->net = vec(0, 0, 0);
}

static void find_samples(Push *p, const BodyFrame *body, const Sheet *sheet) {
    double far = (PUSH_MARGIN + REACH) * p->field.scale;
    p->nsamples = 0;
    p->any_travel = false;
    memset(p->travel, 0, (size_t)p->field.start[LATTICE_LEVELS] * sizeof *p->travel);
    find_points(p, sheet);
    near_find(p->near, body, sheet, p->point, far, p->near_known);
    p->near_known = true;
    for (int v = 0; v < sheet->nvertices; v++) {
        unsigned parts = near_parts(&p->near[v], body, movers(p, sheet->place[v]));
        if (parts) add_sample(p, v, parts, far);
    }
}

/* Moves a sample by `depth` along n with the least change of the unknowns. */
static void project(Push *p, const PushSample *s, Vec3 n, double depth, PushResult *result) {
    double step = depth / fmax(s->norm2, NORM_MIN);
    for (int k = 0; k < s->n; k++) {
        Vec3 *d = &p->field.displacement[s->id[k]];
        double by = step * (p->mobility[s->id[k]] * s->weight[k]);
        *d = field_limit(vec_mad(*d, n, by), p->field.cap, &result->capped);
        p->travel[s->id[k]] += fabs(by);
    }
    p->any_travel = true;
}

/* The most that a sample can have been moved since it was found. */
static double travelled(const Push *p, const PushSample *s) {
    double sum = 0;
    for (int k = 0; k < s->n; k++) sum += p->travel[s->id[k]] * s->weight[k];
    return sum;
}

/* Between two parts that overlap there is no room: each push undoes the one before, and all that
   would come of it is that the neighbours are carried away. */
static bool is_pinched(const Push *p, const PushSample *s) {
    return s->spent > s->budget || (s->spent > BUDGET * p->field.scale && vec_len(s->net) < HEADWAY * s->spent);
}

/* The distance to ask for from a part with outward normal n at x, `distance` away from it: the
   clearance, but where another part stands opposite no more than half the room between the two.
   Where there is none, a part that comes from outside asks for nothing. */
static double room_for(const BodyFrame *body, unsigned near, unsigned worn, int part, Vec3 x, double clearance,
                       double distance, Vec3 n) {
    double far = 2 * clearance - distance;
    unsigned opposite = 0;
    for (int other = 0; near >> other; other++) {
        Vec3 m;
        if (other == part || !(near >> other & 1)) continue;
        double d = body_frame_distance(body, other, x, far, &m);
        if (d >= far || vec_dot(n, m) >= OPPOSITE) continue;
        far = d;
        opposite = part_bit(body, other);
    }
    if (distance + far > 0) return 0.5 * (distance + far);
    return opposite & worn && !(part_bit(body, part) & worn) ? distance : clearance;
}

/* A place that belongs to the other bone of a fold, and is in it: the side is the plane between the two. */
static bool side_in_fold(const BodyFrame *body, int part, Vec3 x, bool above, Vec3 *side) {
    const Contacts *c = &body->contacts[part];
    for (int k = 0; k < c->n; k++) {
        const Fold *fold = &c->contact[k].fold;
        if (fold->bottom <= 0 || (c->contact[k].other < part) != above) continue;
        *side = vec_scale(fold->across, -1);
        return vec_dot(vec_sub(x, fold->centre), fold->inwards) > 0;
    }
    return false;
}

/* The side of a part on which a place, now at x, belongs. Along the part: where it was in the bind pose, as seen
   from the part's axis. Past a bent joint that means nothing; false where there is no telling. Unit; world. */
static bool side_of(const Push *p, const BodyFrame *body, int place, int part, Vec3 x, Vec3 *side) {
    const BodyPart *b = &body->body->part[part];
    Vec3 q = rigid_unapply(b->frame, p->rest[place]);
    if (q.y < 0 || q.y > b->length)
        return !p->lattice->fit->garment->loose && side_in_fold(body, part, x, q.y < 0, side);
    Section c = body_section_at(b, q.y, NULL);
    *side = mat_apply(body->to_world[part], vec_unit_or(vec(q.x - c.x, 0, q.z - c.z), vec(1, 0, 0)));
    return true;
}

/* A foot stands across the leg of trousers: it has no side along it. */
static bool has_side(Role role) {
    return role != ROLE_LEFT_FOOT && role != ROLE_RIGHT_FOOT && role != ROLE_LEFT_TOE && role != ROLE_RIGHT_TOE;
}

/* The nearest way out of a limb that lies across the cloth may lead to its other side. *n, the normal of
   the part at a place: bent towards the side where the place belongs. A part that comes from outside never
   pushes cloth out of the garment: the other leg of trousers is left at that; for an arm the normal is bent
   into the garment, the more the less it leads there, so that one that sweeps through does not throw
   cloth to one side and then to the other. Returns whether it has changed. */
static bool turn_inside(const Push *p, const BodyFrame *body, int place, int part, Vec3 x, Vec3 *n) {
    if (p->lattice->collide[place] & part_bit(body, part)) {
        Vec3 side;
        if (!has_side(body->body->part[part].role) || !side_of(p, body, place, part, x, &side)) return false;
        double turn = 2 * (1 - smoothstep(-WRONG_SIDE, WRONG_SIDE, vec_dot(*n, side)));
        if (turn > 0) *n = vec_unit_or(vec_mad(*n, side, turn), side);
        return turn > 0;
    }
    Vec3 outwards = field_normal(&p->field, p->root, 0, place);
    if (p->lattice->fit->collide & part_bit(body, part)) {
        if (vec_dot(*n, outwards) <= OUTWARDS) return false;
        *n = vec_scale(outwards, -1);
        return true;
    }
    double turn = smoothstep(-1, OUTWARDS, vec_dot(*n, outwards));
    *n = vec_unit_or(vec_mad(vec_scale(*n, 1 - turn), outwards, -turn), vec_scale(outwards, -1));
    return turn > 0;
}

/* How far x must go along *n, the outward normal, to be `wanted` away from a part that is
   `distance` away. Turns *n where that leads to the wrong side. */
static double way_out(const Push *p, const BodyFrame *body, int place, int part, Vec3 x, double wanted, double distance,
                      Vec3 *n) {
    double way = wanted - distance;
    if (!turn_inside(p, body, place, part, x, n)) return way;
    for (int k = 0; k < STEPS_OUT; k++) {
        double d = body_frame_distance(body, part, vec_mad(x, *n, way), wanted, NULL);
        if (d >= wanted - SLACK * wanted) break;
        way += wanted - d;
    }
    return way;
}

/* How far x, `distance` away from a part, must go along *n, the outward normal, to keep its clearance from
   it: as far as there is room. 0: it may stay. */
static double way_asked(const Push *p, const BodyFrame *body, int place, unsigned near, int part, Vec3 x,
                        double clearance, double distance, Vec3 *n) {
    if (clearance - distance <= p->slack * clearance) return 0;
    double wanted = room_for(body, near, p->lattice->collide[place], part, x, clearance, distance, *n);
    return wanted - distance <= p->slack * clearance ? 0 : way_out(p, body, place, part, x, wanted, distance, n);
}

/* May a sample have come too near to any part since they were last asked? First the way that what moves it
   has gone is held against its slack, then its own. If so it is placed. */
static bool needs_asking(Push *p, const Sheet *sheet, PushSample *s, double enough) {
    double slack = near_slack(s->near.least, enough);
    if (slack > 0 && !p->any_travel) return false;
    if (s->n < 0) weigh(p, sheet, s);
    double way = travelled(p, s);
    if (slack > way - s->travelled) return false;
    Vec3 x = sample_point(p, sheet, s);
    double gone = vec_dist(x, s->near.seen);
    s->travelled = way;
    if (slack > gone) s->travelled -= gone;
    else near_move(&s->near, x);
    return slack <= gone;
}

/* Pushes one sample out of the parts it is too near to. Parts that have been found clear are left alone until the
   sample has used up its slack, but for those that give way: in a fold that may change at once. Returns the depth
   of the worst violation that was acted on. */
static double push_sample(Push *p, const BodyFrame *body, const Sheet *sheet, PushSample *s, PushResult *result) {
    if (s->budget >= 0 && is_pinched(p, s)) return 0; /* it has had its say */
    double clearance = p->clearance[s->vertex], enough = (1 - p->slack) * clearance, most = 0;
    double far = clearance + REACH * p->field.scale;
    int place = sheet->place[s->vertex];
    if (!needs_asking(p, sheet, s, enough)) return 0;
    for (int part = 0; s->near.parts >> part; part++) {
        if (!(s->near.parts >> part & 1)) continue;
        if (near_slack(s->near.distance[part], enough) > 0 && !(s->asked >> part & 1)) continue;
        Vec3 n, x = s->near.seen;
        double distance = body_frame_distance(body, part, x, far, &n);
        double depth = way_asked(p, body, place, s->near.parts, part, x, clearance, distance, &n);
        s->near.distance[part] = (float)distance;
        if (body->contacts[part].n > 0) s->asked |= 1u << part;
        if (depth <= 0) continue;
        if (s->budget < 0) s->budget = 2 * depth + BUDGET * p->field.scale;
        s->spent += depth;
        s->net = vec_mad(s->net, n, depth);
        project(p, s, n, depth, result);
        near_move(&s->near, sample_point(p, sheet, s));
        most = fmax(most, depth);
    }
    near_sum(&s->near, far);
    return most;
}

/* One pass over all samples; returns how far one was pushed at most, 0 = nothing to do. */
static double sweep(Push *p, const BodyFrame *body, const Sheet *sheet, PushResult *result) {
    double most = 0;
    for (int k = 0; k < p->nsamples; k++) most = fmax(most, push_sample(p, body, sheet, &p->sample[k], result));
    return most;
}

/* Sweeps until nothing is violated, or nothing gets better, or the cap. Returns the sum of the
   largest moves: nobody has gone farther. */
static double sweep_all(Push *p, const BodyFrame *body, const Sheet *sheet, PushResult *result) {
    double moved = 0, before = INFINITY, most = 0;
    bool stalls = false;
    for (int k = 0; k < SWEEPS_MAX && !stalls; k++) {
        p->slack = k == 0 ? 0 : SLACK;
        most = sweep(p, body, sheet, result);
        if (most <= 0) break;
        moved += most;
        result->sweeps++;
        if (k % STALL != STALL - 1) continue;
        stalls = most > 0.5 * before;
        before = most;
    }
    p->slack = 0;
    result->capped |= most > 0;
    return moved;
}

static void add_offset(Push *p, const Sheet *sheet, int vertex, Vec3 by, bool *capped) {
    int place = sheet->place[vertex];
    Vec3 offset = p->field.offset[place];
    Vec3 longer = field_limit(vec_add(offset, by), OFFSET_MAX * p->field.scale, capped);
    p->point[vertex] = vec_add(p->point[vertex], vec_sub(longer, offset));
    field_set_offset(&p->field, place, longer);
}

/* Single vertices that the sweeps left too near are moved by their own offset. */
static void settle_vertex(Push *p, const BodyFrame *body, const Sheet *sheet, int vertex, bool *capped) {
    int place = sheet->place[vertex];
    double clearance = p->clearance[vertex];
    const Vec3 *x = &p->point[vertex];
    if (near_slack(p->near[vertex].least, clearance) > vec_dist(*x, p->near[vertex].seen)) return;
    unsigned near = parts_near(body, parts_at(p, place), *x, clearance), worn = p->lattice->collide[place];
    for (int step = 0; step < SETTLES_MAX && near; step++) {
        bool moved = false;
        for (int part = 0; near >> part; part++) {
            if (!(near >> part & 1)) continue;
            Vec3 n, plain;
            double distance = body_frame_distance(body, part, *x, clearance, &n), most = OFFSET_MAX * p->field.scale;
            plain = n;
            double way = way_asked(p, body, place, near, part, *x, clearance, distance, &n);
            if (way <= 0) continue;
            if (!(worn & part_bit(body, part)) && way > most) { /* the way into the garment is too far: the nearest */
                way = clearance - distance;
                n = plain;
                if (way > most) continue;
            }
            add_offset(p, sheet, vertex, vec_scale(n, way), capped);
            moved = true;
        }
        if (!moved) return;
    }
}

void push_start(Push *p, const Patch *root, const Leaves *leaves, const Sheet *sheet) {
    p->nraised = 0;
    p->near_known = false;
    p->root = root;
    find_active(p, leaves);
    surface_points(&p->surface, sheet, root, p->global);
    for (int v = 0; v < sheet->nvertices; v++) p->clearance[v] = PUSH_MARGIN * p->field.scale;
}

void push_rest(Push *p, const Sheet *sheet) {
    p->nsamples = 0;
    for (int v = 0; v < sheet->nvertices; v++) p->point[v] = p->global[v];
}

void push_solve(Push *p, const BodyFrame *body, const Sheet *sheet, PushResult *result) {
    for (int round = 0; round < ROUNDS_MAX; round++) {
        find_samples(p, body, sheet);
        double moved = sweep_all(p, body, sheet, result);
        if (moved < REACH * p->field.scale) break; /* nobody can have come near who was not */
    }
    find_points(p, sheet);
    for (int v = 0; v < sheet->nvertices; v++) settle_vertex(p, body, sheet, v, &result->capped);
}

bool push_raise(Push *p, int vertex, double by, double most) {
    double limit = (PUSH_MARGIN + fmin(most, RAISE_MAX)) * p->field.scale;
    if (p->clearance[vertex] >= limit) return false;
    if (p->clearance[vertex] <= PUSH_MARGIN * p->field.scale) p->raised[p->nraised++] = vertex; /* its first time */
    p->clearance[vertex] = fmin(p->clearance[vertex] + by * p->field.scale, limit);
    return true;
}

void push_off(Push *p, const BodyFrame *body, const Sheet *sheet, const TesterHit *hit) {
    double clearance = PUSH_MARGIN * p->field.scale, norm2 = 0;
    int nearest = 0;
    bool capped = false;
    Vec3 x = {0, 0, 0}, n;
    for (int c = 0; c < hit->n; c++) {
        bool is_raised = p->clearance[hit->v[c]] > clearance;
        if (!is_raised || !(parts_at(p, sheet->place[hit->v[c]]) & part_bit(body, hit->part))) return;
        x = vec_mad(x, p->point[hit->v[c]], hit->weight[c]);
        norm2 += hit->weight[c] * hit->weight[c];
        if (hit->weight[c] > hit->weight[nearest]) nearest = c;
    }
    double distance = body_frame_distance(body, hit->part, x, clearance, &n);
    if (distance >= clearance) return; /* another hit has moved it */
    double way = way_out(p, body, sheet->place[hit->v[nearest]], hit->part, x, clearance, distance, &n);
    if (way > OFFSET_MAX * p->field.scale) return; /* out of reach */
    for (int c = 0; c < hit->n; c++)
        add_offset(p, sheet, hit->v[c], vec_scale(n, way * hit->weight[c] / norm2), &capped);
}

void push_settle(Push *p, const BodyFrame *body, const Sheet *sheet, PushResult *result) {
    for (int k = 0; k < p->nraised; k++) settle_vertex(p, body, sheet, p->raised[k], &result->capped);
}

void push_mark(Push *p, const Sheet *sheet) {
    p->nmarked = p->nraised;
    for (int k = 0; k < p->nmarked && k < MARKS_MAX; k++) {
        p->was_offset[k] = p->field.offset[sheet->place[p->raised[k]]];
        p->was_point[k] = p->point[p->raised[k]];
    }
}

bool push_unsettle(Push *p, const Sheet *sheet) {
    for (int k = 0; k < p->nmarked && p->nmarked <= MARKS_MAX; k++) {
        field_set_offset(&p->field, sheet->place[p->raised[k]], p->was_offset[k]);
        p->point[p->raised[k]] = p->was_point[k];
    }
    return p->nmarked <= MARKS_MAX;
}

void push_clear(const Push *p, const Sheet *sheet, unsigned *clear) {
    for (int v = 0; v < sheet->nvertices; v++) clear[v] = p->near_known ? near_clear(&p->near[v], p->point[v]) : 0;
}

void push_keep(Push *p, int nvertices) {
    p->nkept = nvertices;
    field_copy(&p->field, &p->kept);
    memcpy(p->kept_point, p->point, (size_t)nvertices * sizeof *p->point);
}

void push_back(Push *p) {
    p->near_known = false;
    field_copy(&p->kept, &p->field);
    memcpy(p->point, p->kept_point, (size_t)p->nkept * sizeof *p->point);
}

void push_measure(const Push *p, const BodyFrame *body, const Sheet *sheet, PushResult *result) {
    result->active = result->pinched = 0;
    result->displacement = 0;
    for (int k = 0; k < p->field.start[LATTICE_LEVELS]; k++) result->active += !field_is_zero(p->field.displacement[k]);
    for (int v = 0; v < sheet->nvertices; v++)
        result->displacement = fmax(result->displacement, vec_dist(p->point[v], p->global[v]));
    for (int k = 0; k < p->nsamples; k++) {
        const PushSample *s = &p->sample[k];
        bool pushed = s->budget >= 0;
        result->pinched += pushed && body_frame_inside(body, movers(p, sheet->place[s->vertex]), p->point[s->vertex]);
    }
}
