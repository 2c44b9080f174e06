/* Local deformation as a feasibility problem: every mesh vertex must keep its clearance from the
   parts it collides with. A violated one is a half space; projecting onto half spaces in turn
   (Kaczmarz, POCS) needs no step size, so 30 and 120 frames a second give the same shape.

   The unknowns are the displacements of level vertices, coarse and fine together: a projection
   moves all that reach the sample, in proportion to their weights, by the least change; pinned ones
   give way last. What others have made needless of it is taken back (Hildreth 1957), so that the cloth goes
   no farther than it must. Which half space it is, dress/escape tells; what the levels are too coarse for is
   left to dress/settle. */
#include "dress/push.h"

#include <string.h>

/* Caps and tolerances, metres on a figure of 1.70 m where they are lengths. */
enum { SWEEPS_MAX = 30, STALL = 3, ROUNDS_MAX = 3 };
static const double REACH = 0.04;    /* vertices farther from the body are not swept */
static const double SLACK = 0.1;     /* share of the clearance that may be missing after sweeps; settling makes
                                        up for it */
static const double PIN_GIVES = 0.2; /* a pinned level vertex moves this share of what a free one would, and one */
static const double PINNED = 0.25;   /* of a level this share of the next finer one: a waist gives way in places */
static const double LITTLE = 0.002;  /* pushes that go no farther than that are not worth taking back */
static const double NORM_MIN = 0.1;  /* a sample that level vertices hardly move must not fling them */
static const double BUDGET = 0.02;   /* a sample may issue twice its first violation and this */
static const double HEADWAY = 0.6;   /* pushes that get this share of their length nowhere are a pinch */

/* Which unknowns move a place follows from its cell, and their weights from its two coordinates. */
static void list_unknowns(Push *p) {
    const Lattice *l = p->lattice;
    int cells = 1 << l->depth, ncells = l->fit->npatches * cells * cells;
    for (int c = 0; c < ncells; c++)
        for (int level = 0; level <= l->depth; level++) {
            LatticeIndex first = {c / (cells * cells), c / cells % cells * l->detail, c % cells * l->detail};
            LatticeWeights of = lattice_weights(l, level, first);
            for (int k = 0; k < 4; k++) p->cell[c].unknown[level][k] = p->field.start[level] + of.vertex[k];
        }
    for (int i = 0; i <= l->side; i++)
        for (int level = 0; level <= l->depth; level++)
            memcpy(p->along[i].weight[level], l->level[level].step[i].weight, sizeof p->along[i].weight[level]);
}

/* Patches that share a corner are moved by the same unknowns, in part. Without a list only counts. */
static int list_neighbours(const Lattice *l, int patch, int *list) {
    const LatticeLevel *at = &l->level[0];
    int n = 0;
    for (int other = 0; other < l->fit->npatches; other++) {
        bool shares = false;
        for (int k = 0; k < 16; k++) shares |= at->vertex[4 * patch + k / 4] == at->vertex[4 * other + k % 4];
        if (shares && list) list[n] = other;
        n += shares;
    }
    return n;
}

static bool find_neighbours(Push *p, Arena *arena, Error *e) {
    int npatches = p->lattice->fit->npatches;
    p->first_neighbour = ARENA_NEW(arena, int, npatches + 1, e);
    if (!p->first_neighbour) return false;
    for (int k = 0; k < npatches; k++)
        p->first_neighbour[k + 1] = p->first_neighbour[k] + list_neighbours(p->lattice, k, NULL);
    p->neighbour = ARENA_NEW(arena, int, p->first_neighbour[npatches], e);
    for (int k = 0; k < npatches && p->neighbour; k++)
        list_neighbours(p->lattice, k, p->neighbour + p->first_neighbour[k]);
    return p->neighbour != NULL;
}

bool push_reserve(Push *p, const Lattice *lattice, Arena *arena, Error *e) {
    *p = (Push){.lattice = lattice};
    if (!escape_reserve(&p->escape, lattice, arena, e) || !field_reserve(&p->field, lattice, arena, e) ||
        !field_reserve(&p->kept, lattice, arena, e) || !surface_reserve(&p->surface, lattice, arena, e))
        return false;
    int places = lattice->nplaces;
    p->cell = ARENA_NEW(arena, PushCell, lattice_cells(lattice), e);
    p->along = ARENA_NEW(arena, PushAlong, lattice->side + 1, e);
    if (!p->cell || !p->along) return false;
    list_unknowns(p);
    if (!find_neighbours(p, arena, e)) return false;
    p->patch_travel = ARENA_NEW(arena, double, lattice->fit->npatches, e);
    p->mobility = ARENA_NEW(arena, double, p->field.start[LATTICE_LEVELS], e);
    p->travel = ARENA_NEW(arena, double, p->field.start[LATTICE_LEVELS], e);
    p->global = ARENA_NEW(arena, Vec3, places, e);
    p->point = ARENA_NEW(arena, Vec3, places, e);
    p->kept_point = ARENA_NEW(arena, Vec3, places, e);
    p->clearance = ARENA_NEW(arena, double, places, e);
    p->near = ARENA_NEW(arena, Near, places, e);
    p->sample = ARENA_NEW(arena, PushSample, places, e);
    return p->mobility && p->patch_travel && p->travel && p->global && p->point && p->kept_point && p->clearance &&
           p->near && p->sample;
}

/* A level vertex may move where all cells round it are split to its level; where they are not, it is at rest. */
static void find_mobility(Push *p, const Leaves *leaves) {
    const Lattice *l = p->lattice;
    int cells = 1 << l->depth;
    for (int level = 0; level <= l->depth; level++) {
        const LatticeLevel *at = &l->level[level];
        int size = 1 << (l->depth - level);
        double of_level = pow(p->coarser, l->depth - level), if_pinned = PIN_GIVES * pow(PINNED, l->depth - level);
        for (int v = 0; v < at->count; v++) {
            bool all = true;
            for (int k = at->first_cell[v]; all && k < at->first_cell[v + 1]; k++) {
                LatticeCell c = at->cell[k];
                all = leaves->level[(c.patch * cells + c.a * size) * cells + c.b * size] >= level;
            }
            p->mobility[p->field.start[level] + v] = !all ? 0 : at->pinned[v] ? if_pinned : of_level;
        }
    }
}

/* Levels deeper than the leaf over a cell have nothing to say there. */
static void find_levels(Push *p) {
    for (int c = 0; c < lattice_cells(p->lattice); c++) {
        PushCell *cell = &p->cell[c];
        cell->levels = 0;
        for (int level = 0; level <= p->lattice->depth; level++)
            for (int k = 0; k < 4; k++)
                if (p->mobility[cell->unknown[level][k]] > 0) cell->levels = level + 1;
    }
}

/* A vertex displaced by d: never farther than the cap, whatever the levels add up to. */
static Vec3 displaced(const Push *p, int vertex, Vec3 d) {
    bool capped = false;
    int place = p->sheet->place[vertex];
    Vec3 own = vec_add(p->field.offset.at[place], p->field.dent.at[place]);
    return vec_add(p->global[vertex], field_limit(vec_add(d, own), p->field.cap, &capped));
}

static void find_points(Push *p) {
    surface_field(&p->surface, p->sheet, &p->field, p->point);
    for (int v = 0; v < p->sheet->nvertices; v++) p->point[v] = displaced(p, v, p->point[v]);
}

static void weigh(const PushSample *s, double weight[][4]) {
    for (int level = 0; level < s->cell->levels; level++)
        for (int k = 0; k < 4; k++) weight[level][k] = s->u->weight[level][k / 2] * s->w->weight[level][k % 2];
}

static Vec3 sample_point(const Push *p, const PushSample *s, double weight[][4]) {
    Vec3 d = {0, 0, 0};
    for (int level = 0; level < s->cell->levels; level++)
        for (int k = 0; k < 4; k++) d = vec_mad(d, p->field.displacement[s->cell->unknown[level][k]], weight[level][k]);
    return displaced(p, s->vertex, d);
}

/* Parts that move the surface at a place: those that it is worn over, and those that the garment is worn
   over elsewhere, as the other leg is for one of trousers. */
static unsigned movers(const Push *p, int place) {
    return p->lattice->collide[place] | p->lattice->fit->collide;
}

static void add_sample(Push *p, int vertex, int place, unsigned parts, double far) {
    const Lattice *l = p->lattice;
    const LatticeStep *deepest = l->level[l->depth].step;
    PushSample *s = &p->sample[p->nsamples++];
    LatticeIndex at = l->owner[place];
    int cells = 1 << l->depth;
    s->vertex = vertex;
    s->patch = at.patch;
    s->cell = &p->cell[(at.patch * cells + deepest[at.i].cell) * cells + deepest[at.j].cell];
    s->u = &p->along[at.i];
    s->w = &p->along[at.j];
    s->near = p->near[vertex];
    s->near.parts = parts;
    near_sum(&s->near, far);
    s->asked = 0;
    s->spent = s->travelled = s->patch_travelled = 0;
    s->budget = -1;
    s->net = vec(0, 0, 0);
}

static void find_samples(Push *p) {
    const Sheet *sheet = p->sheet;
    double far = (PUSH_MARGIN + REACH) * p->field.scale;
    p->nsamples = 0;
    memset(p->patch_travel, 0, (size_t)p->lattice->fit->npatches * sizeof *p->patch_travel);
    memset(p->travel, 0, (size_t)p->field.start[LATTICE_LEVELS] * sizeof *p->travel);
    find_points(p);
    near_find(p->near, p->body, sheet, p->point, far, p->near_known);
    p->near_known = true;
    for (int v = 0; v < sheet->nvertices; v++) {
        unsigned parts = near_parts(&p->near[v], p->body, movers(p, sheet->place[v]));
        if (parts) add_sample(p, v, sheet->place[v], parts, far);
    }
}

/* Moves a sample by `depth` along n with the least change of the unknowns. */
static void project(Push *p, const PushSample *s, double weight[][4], Vec3 n, double depth, PushResult *result) {
    double norm2 = 0, mobile[LATTICE_LEVELS][4];
    for (int level = 0; level < s->cell->levels; level++)
        for (int k = 0; k < 4; k++) {
            mobile[level][k] = p->mobility[s->cell->unknown[level][k]] * weight[level][k];
            norm2 += mobile[level][k] * weight[level][k];
        }
    double step = depth / fmax(norm2, NORM_MIN), sum = 0;
    for (int level = 0; level < s->cell->levels; level++) {
        double most = 0;
        for (int k = 0; k < 4; k++) {
            int unknown = s->cell->unknown[level][k];
            double by = step * mobile[level][k];
            if (by <= 0) continue;
            Vec3 *d = &p->field.displacement[unknown];
            *d = field_limit(vec_mad(*d, n, by), p->field.cap, &result->capped);
            p->travel[unknown] += by;
            most = fmax(most, by);
        }
        sum += most;
    }
    for (int k = p->first_neighbour[s->patch]; k < p->first_neighbour[s->patch + 1]; k++)
        p->patch_travel[p->neighbour[k]] += sum;
}

/* The most that a sample can have been moved since it was found. */
static double travelled(const Push *p, const PushSample *s) {
    const double *t = p->travel;
    double sum = 0;
    for (int level = 0; level < s->cell->levels; level++) {
        const int *k = s->cell->unknown[level];
        const double *u = s->u->weight[level], *w = s->w->weight[level];
        sum += u[0] * (w[0] * t[k[0]] + w[1] * t[k[1]]) + u[1] * (w[0] * t[k[2]] + w[1] * t[k[3]]);
    }
    return sum;
}

/* Between two parts that overlap there is no room: each push undoes the one before, and all that
   would come of it is that the neighbours are carried away. */
static bool is_pinched(const Push *p, const PushSample *s) {
    return s->spent > s->budget || (s->spent > BUDGET * p->field.scale && vec_len(s->net) < HEADWAY * s->spent);
}

/* The distance that a sample must have from all parts to be left alone. */
static double enough_for(const Push *p, const PushSample *s) { return (1 - p->slack) * p->clearance[s->vertex]; }

/* Has the patch of a sample gone so little that it cannot have come too near to any part since they were last
   asked? */
static inline bool is_at_rest(const Push *p, const PushSample *s) {
    return near_slack(s->near.least, enough_for(p, s)) > p->patch_travel[s->patch] - s->patch_travelled;
}

/* May a sample have? What moves it is held against its slack, then its own way. If so it is placed. */
static bool needs_asking(Push *p, PushSample *s, double weight[][4]) {
    double slack = near_slack(s->near.least, enough_for(p, s)), way = travelled(p, s);
    s->patch_travelled = p->patch_travel[s->patch] - (way - s->travelled);
    if (slack > way - s->travelled) return false;
    weigh(s, weight);
    Vec3 x = sample_point(p, s, weight);
    double gone = vec_dist(x, s->near.seen);
    s->travelled = way;
    s->patch_travelled = p->patch_travel[s->patch];
    if (slack > gone) s->travelled -= gone, s->patch_travelled -= gone;
    else near_move(&s->near, x);
    return slack <= gone;
}

/* Others may have carried a sample farther out than it asked for itself. Then it takes its own pushes back, as far as
   it keeps its clearance; they stay spent. Returns how far that is. */
static double take_back(Push *p, PushSample *s, double weight[][4], double clearance, PushResult *result) {
    double pushed = vec_len(s->net), way = fmin(s->near.least - clearance, pushed);
    if (pushed <= 0 || way <= 0) return 0;
    Vec3 n = vec_scale(s->net, -1 / pushed);
    s->net = vec_mad(s->net, n, way);
    project(p, s, weight, n, way, result);
    near_move(&s->near, sample_point(p, s, weight));
    return way;
}

/* Pushes one sample out of the parts it is too near to. Parts that have been found clear are left alone until the
   sample has used up its slack, but for those that give way: in a fold that may change at once. Returns the depth
   of the worst violation that was acted on. */
static double push_sample(Push *p, PushSample *s, PushResult *result) {
    const BodyFrame *body = p->body;
    if (s->budget >= 0 && is_pinched(p, s)) return 0; /* it has had its say */
    double clearance = p->clearance[s->vertex], enough = enough_for(p, s), most = 0;
    double far = clearance + REACH * p->field.scale, weight[LATTICE_LEVELS][4];
    if (!needs_asking(p, s, weight)) return 0;
    EscapePoint at;
    escape_at(&at, p->sheet->place[s->vertex], s->near.seen, clearance);
    at.near = s->near.parts;
    at.slack = p->slack;
    for (unsigned left = s->near.parts; left; left &= left - 1) {
        int part = near_first(left);
        if (near_slack(s->near.distance[part], enough) > 0 && !(s->asked >> part & 1)) continue;
        Vec3 n;
        double distance = body_point_distance(body, part, &at.point, far, &n);
        double depth = escape_asked(&p->escape, body, &at, part, distance, &n);
        s->near.distance[part] = (float)distance;
        if (body->contacts[part].n > 0) s->asked |= 1u << part;
        if (depth <= 0) continue;
        if (s->budget < 0) s->budget = 2 * depth + BUDGET * p->field.scale;
        s->spent += depth;
        s->net = vec_mad(s->net, n, depth);
        project(p, s, weight, n, depth, result);
        near_move(&s->near, sample_point(p, s, weight));
        body_point_move(&at.point, s->near.seen);
        most = fmax(most, depth);
    }
    near_sum(&s->near, far);
    if (most == 0 && p->takes_back) p->taken = fmax(p->taken, take_back(p, s, weight, at.clearance, result));
    return most;
}

/* One pass over all samples; returns how far one was pushed at most, 0 = nothing to do. */
static double sweep(Push *p, PushResult *result) {
    double most = 0;
    p->taken = 0;
    for (int k = 0; k < p->nsamples; k++)
        if (!is_at_rest(p, &p->sample[k])) most = fmax(most, push_sample(p, &p->sample[k], result));
    return most;
}

/* Sweeps until nothing is violated and little taken back, or nothing gets better, or the cap; the last ones take
   nothing back. Returns the sum of the largest moves: nobody has gone farther. */
static double sweep_all(Push *p, PushResult *result) {
    double moved = 0, before = INFINITY, most = 0;
    bool stalls = false;
    p->takes_back = true;
    for (int k = 0; k < SWEEPS_MAX && !stalls; k++) {
        p->slack = k == 0 ? 0 : SLACK;
        most = sweep(p, result);
        if (most <= 0 && p->taken <= 0) break;
        moved += fmax(most, p->taken);
        result->sweeps++;
        if (most <= 0 && p->taken < LITTLE * p->field.scale) p->takes_back = false;
        if (k % STALL != STALL - 1) continue;
        stalls = most > 0.5 * before;
        before = most;
    }
    p->slack = 0;
    result->capped |= most > 0;
    return moved;
}

void push_start(Push *p, const BodyFrame *body, const Patch *root, const Leaves *leaves, const Sheet *sheet) {
    p->body = body;
    p->sheet = sheet;
    p->near_known = false;
    p->escape.root = root;
    find_mobility(p, leaves);
    find_levels(p);
    surface_points(&p->surface, sheet, root, p->global);
    for (int v = 0; v < sheet->nvertices; v++) p->clearance[v] = PUSH_MARGIN * p->field.scale;
}

void push_rest(Push *p) {
    p->nsamples = 0;
    find_points(p);
}

void push_solve(Push *p, PushResult *result) {
    double moved = INFINITY;
    field_drop_spots(&p->field.dent);
    for (int round = 0; round < ROUNDS_MAX && moved >= REACH * p->field.scale; round++) {
        find_samples(p);
        moved = sweep_all(p, result); /* when it is less nobody can have come near who was not */
    }
    if (moved > 0) find_points(p);
}

void push_vertex(Push *p, int vertex, Vec3 by, bool *capped) {
    Vec3 d = vec_add(vec_sub(p->point[vertex], p->global[vertex]), by);
    p->point[vertex] = vec_add(p->global[vertex], field_limit(d, p->field.cap, capped));
}

void push_clear(const Push *p, bool *clear) {
    for (int v = 0; v < p->sheet->nvertices; v++) clear[v] = p->near_known && near_clear(&p->near[v], p->point[v]);
}

void push_keep(Push *p, int nvertices) {
    p->nkept = nvertices;
    field_copy(&p->field, &p->kept);
    memcpy(p->kept_point, p->point, (size_t)nvertices * sizeof *p->point);
}

void push_restore(Push *p) {
    p->near_known = false;
    field_copy(&p->kept, &p->field);
    memcpy(p->point, p->kept_point, (size_t)p->nkept * sizeof *p->point);
}

void push_measure(const Push *p, PushResult *result) {
    result->active = result->pinched = 0;
    result->displacement = 0;
    for (int k = 0; k < p->field.start[LATTICE_LEVELS]; k++) result->active += !field_is_zero(p->field.displacement[k]);
    for (int v = 0; v < p->sheet->nvertices; v++)
        result->displacement = fmax(result->displacement, vec_dist(p->point[v], p->global[v]));
    for (int k = 0; k < p->nsamples; k++) {
        const PushSample *s = &p->sample[k];
        unsigned parts = movers(p, p->sheet->place[s->vertex]);
        bool pushed = s->budget >= 0;
        result->pinched += pushed && body_frame_inside(p->body, parts, p->point[s->vertex]);
    }
}
