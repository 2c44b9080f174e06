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
enum { SWEEPS_MAX = 30, STALL = 5, ROUNDS_MAX = 3, SETTLES_MAX = 4 };
static const double REACH = 0.04;      /* vertices farther from the body are not swept */
static const double SLACK = 0.1;       /* share of the clearance that may be missing after sweeps */
static const double LIPSCHITZ = 0.8;   /* distances are of first order: trust this share of a slack */
static const double PIN_GIVES = 0.2;   /* a pinned level vertex moves this share of what a free one would */
static const double NORM_MIN = 0.1;    /* a sample that level vertices hardly move must not fling them */
static const double BUDGET = 0.02;     /* a sample may issue twice its first violation and this */
static const double HEADWAY = 0.6;     /* pushes that get this share of their length nowhere are a pinch */
static const double RAISE_MAX = 0.02;  /* most extra clearance */
static const double OFFSET_MAX = 0.03; /* of a single vertex: more would be a spike */

bool push_reserve(Push *p, const Lattice *lattice, Arena *arena, Error *e) {
    *p = (Push){.lattice = lattice};
    if (!field_reserve(&p->field, lattice, arena, e) || !field_reserve(&p->kept, lattice, arena, e)) return false;
    int places = lattice->nplaces;
    p->active = ARENA_NEW(arena, bool, p->field.start[LATTICE_LEVELS], e);
    p->kept_point = ARENA_NEW(arena, Vec3, places, e);
    p->global = ARENA_NEW(arena, Vec3, places, e);
    p->point = ARENA_NEW(arena, Vec3, places, e);
    p->clearance = ARENA_NEW(arena, double, places, e);
    p->sample = ARENA_NEW(arena, PushSample, places, e);
    p->raised = ARENA_NEW(arena, int, places, e);
    return p->active && p->kept_point && p->global && p->point && p->clearance && p->sample && p->raised;
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
    unsigned levels = field_levels(&p->field);
    for (int v = 0; v < sheet->nvertices; v++)
        p->point[v] = displaced(p, sheet, v, field_at(&p->field, levels, sheet->place[v]));
}

static Vec3 sample_point(const Push *p, const Sheet *sheet, const PushSample *s) {
    Vec3 d = {0, 0, 0};
    for (int k = 0; k < s->n; k++) d = vec_mad(d, p->field.displacement[s->id[k]], s->weight[k]);
    return displaced(p, sheet, s->vertex, d);
}

/* Parts of the garment's own colliders at a place that lie within `far` of x. */
static unsigned parts_near(const Push *p, const BodyFrame *body, int place, Vec3 x, double far) {
    unsigned near = 0, collide = p->lattice->collide[place];
    for (int k = 0; k < body->body->nparts; k++)
        if (collide & part_bit(body, k) && body_frame_distance(body, k, x, far, NULL) < far) near |= 1u << k;
    return near;
}

static void add_sample(Push *p, const Sheet *sheet, int vertex, unsigned near) {
    const Lattice *l = p->lattice;
    PushSample *s = &p->sample[p->nsamples++];
    *s = (PushSample){.vertex = vertex, .near = near, .budget = -1};
    int patch, i, j, id[4];
    double weight[4];
    field_owner(l, sheet->place[vertex], &patch, &i, &j);
    for (int level = 0; level <= l->depth; level++) {
        lattice_weights(l, level, patch, i, j, id, weight, NULL, NULL);
        for (int k = 0; k < 4; k++) {
            int unknown = p->field.start[level] + id[k];
            if (weight[k] <= 0 || !p->active[unknown]) continue;
            double gives = l->level[level].pinned[id[k]] ? PIN_GIVES : 1;
            s->id[s->n] = unknown;
            s->weight[s->n] = weight[k];
            s->share[s->n++] = gives * weight[k];
            s->norm2 += gives * weight[k] * weight[k];
        }
    }
}

static void find_samples(Push *p, const BodyFrame *body, const Sheet *sheet) {
    double far = (PUSH_MARGIN + REACH) * p->field.scale;
    p->nsamples = 0;
    find_points(p, sheet);
    for (int v = 0; v < sheet->nvertices; v++) {
        unsigned near = parts_near(p, body, sheet->place[v], p->point[v], far);
        if (near) add_sample(p, sheet, v, near);
    }
}

/* Moves a sample by `depth` along n with the least change of the unknowns. */
static void project(Push *p, const PushSample *s, Vec3 n, double depth, PushResult *result) {
    double step = depth / fmax(s->norm2, NORM_MIN);
    for (int k = 0; k < s->n; k++) {
        Vec3 *d = &p->field.displacement[s->id[k]];
        *d = field_limit(vec_mad(*d, n, step * s->share[k]), p->field.cap, &result->capped);
    }
}

/* Between two parts that overlap there is no room: each push undoes the one before, and all that
   would come of it is that the neighbours are carried away. */
static bool is_pinched(const Push *p, const PushSample *s) {
    return s->spent > s->budget || (s->spent > BUDGET * p->field.scale && vec_len(s->net) < HEADWAY * s->spent);
}

/* Pushes one sample out of the parts it is too near to. Distances change no faster than the
   point moves, so a sample that has been found clear is left alone until it has used up its
   slack. Returns the depth of the worst violation that was acted on. */
static double push_sample(Push *p, const BodyFrame *body, const Sheet *sheet, PushSample *s, PushResult *result) {
    double clearance = p->clearance[s->vertex], most = 0, slack = INFINITY;
    Vec3 x = sample_point(p, sheet, s);
    if (s->slack > 0 && vec_dist(x, s->seen) < s->slack) return 0;
    s->seen = x;
    for (int part = 0; s->near >> part; part++) {
        if (!(s->near >> part & 1)) continue;
        Vec3 n;
        double depth = clearance - body_frame_distance(body, part, x, clearance + REACH * p->field.scale, &n);
        slack = fmin(slack, SLACK * clearance - depth);
        if (depth <= SLACK * clearance) continue;
        if (s->budget < 0) s->budget = 2 * depth + BUDGET * p->field.scale;
        if (is_pinched(p, s)) continue; /* it has had its say */
        s->spent += depth;
        s->net = vec_mad(s->net, n, depth);
        project(p, s, n, depth, result);
        x = sample_point(p, sheet, s);
        most = fmax(most, depth);
    }
    s->slack = LIPSCHITZ * slack;
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
    double moved = 0, before = INFINITY;
    for (int k = 0; k < SWEEPS_MAX; k++) {
        double most = sweep(p, body, sheet, result);
        if (most <= 0) return moved;
        moved += most;
        result->sweeps++;
        if (k % STALL == STALL - 1) {
            if (most > 0.5 * before) break;
            before = most;
        }
    }
    result->capped = true;
    return moved;
}

/* Single vertices that the sweeps left too near are moved by their own offset. */
static void settle_vertex(Push *p, const BodyFrame *body, const Sheet *sheet, int vertex, unsigned near, bool *capped) {
    Vec3 *o = &p->field.offset[sheet->place[vertex]];
    for (int step = 0; step < SETTLES_MAX; step++) {
        bool moved = false;
        for (int part = 0; near >> part; part++) {
            if (!(near >> part & 1)) continue;
            Vec3 n;
            double depth =
                p->clearance[vertex] - body_frame_distance(body, part, p->point[vertex], p->clearance[vertex], &n);
            if (depth <= SLACK * p->clearance[vertex]) continue;
            Vec3 longer = field_limit(vec_mad(*o, n, depth), OFFSET_MAX * p->field.scale, capped);
            p->point[vertex] = vec_add(p->point[vertex], vec_sub(longer, *o));
            *o = longer;
            moved = true;
        }
        if (!moved) return;
    }
}

void push_start(Push *p, const Patch *root, const Leaves *leaves, const Sheet *sheet) {
    p->nraised = 0;
    find_active(p, leaves);
    for (int v = 0; v < sheet->nvertices; v++) {
        p->global[v] = field_global(p->lattice, root, sheet->place[v]);
        p->clearance[v] = PUSH_MARGIN * p->field.scale;
    }
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
    for (int k = 0; k < p->nsamples; k++)
        settle_vertex(p, body, sheet, p->sample[k].vertex, p->sample[k].near, &result->capped);
}

bool push_raise(Push *p, int vertex, double by) {
    double most = (PUSH_MARGIN + RAISE_MAX) * p->field.scale;
    if (p->clearance[vertex] >= most) return false;
    if (p->clearance[vertex] <= PUSH_MARGIN * p->field.scale) p->raised[p->nraised++] = vertex; /* its first time */
    p->clearance[vertex] = fmin(p->clearance[vertex] + by * p->field.scale, most);
    return true;
}

void push_settle(Push *p, const BodyFrame *body, const Sheet *sheet, PushResult *result) {
    for (int k = 0; k < p->nraised; k++) {
        int v = p->raised[k];
        settle_vertex(p, body, sheet, v, parts_near(p, body, sheet->place[v], p->point[v], p->clearance[v]),
                      &result->capped);
    }
}

void push_back(Push *p) {
    Field field = p->field;
    Vec3 *point = p->point;
    p->field = p->kept;
    p->point = p->kept_point;
    p->kept = field;
    p->kept_point = point;
}

void push_afresh(Push *p) {
    push_back(p);
    p->field.pelvis = p->kept.pelvis;
    field_forget(&p->field);
}

void push_measure(const Push *p, const BodyFrame *body, const Sheet *sheet, PushResult *result) {
    result->active = result->pinched = 0;
    result->displacement = 0;
    for (int k = 0; k < p->field.start[LATTICE_LEVELS]; k++) result->active += !field_is_zero(p->field.displacement[k]);
    for (int v = 0; v < sheet->nvertices; v++)
        result->displacement = fmax(result->displacement, vec_dist(p->point[v], p->global[v]));
    for (int k = 0; k < p->nsamples; k++) {
        const PushSample *s = &p->sample[k];
        if (s->budget >= 0 && parts_near(p, body, sheet->place[s->vertex], p->point[s->vertex], 0)) result->pinched++;
    }
}
