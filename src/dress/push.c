/* Local deformation as a feasibility problem: every mesh vertex near the body (a sample) must keep its clearance.
   Where one is too near to a part, all positions that are far enough form, to first order, a half space; projecting
   onto these half spaces in turn (Kaczmarz, POCS) needs no step size, so 30 and 120 frames a second give the same
   shape.

   The unknowns are the displacements of level vertices, of coarse and fine levels together. A projection changes all
   that move the sample, in proportion to their weights: the least change that does it. Pinned ones give way least. A
   push that others have made needless is taken back (Hildreth 1957), so that the cloth goes no farther than it must.
   dress/escape says which half space it is; what even the finest level is too coarse for is left to dress/settle. */
#include "dress/push.h"

#include <string.h>

/* Caps and tolerances, metres on a figure of 1.70 m where they are lengths. */
enum { SWEEPS_MAX = 30, STALL = 3, ROUNDS_MAX = 3 };
static const double REACH = 0.015;   /* vertices farther from the body are no samples in the first round, */
static const double REACHES_ON = 0.02; /* and farther than this in later ones, which follow if one moved the reach */
static const double SLACK = 0.1;     /* share of the clearance that may be missing after the sweeps */
static const double PIN_GIVES = 0.2; /* a pinned level vertex of the finest level moves this share of what a free one
                                        would, */
static const double PINNED = 0.25;   /* of each coarser level this share of the next finer one: a waist gives way in
                                        places, not as a whole */
static const double UNSURE = 0.0001; /* what sweeps have found out of distances is trusted but for this */
static const double LITTLE = 0.002;  /* once no more than this is taken back, taking back ends */
static const double NORM_MIN = 0.1;  /* least squared norm of a sample's weights: one that the unknowns hardly move must
                                        not fling them */
static const double BUDGET = 0.02;   /* a sample's pushes may sum up to twice its first violation and this */
static const double HEADWAY = 0.6;   /* if the sum of pushes is shorter than this share of their lengths, they undo each
                                        other: a pinch */

/* Fills p->cell and p->along: which unknowns move a place depends on its cell, their weights on its coordinates. */
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

/* Lists the patches that share a corner with this one, itself included; returns their number. list may be NULL. */
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

/* A level vertex may move if all cells round it are split to its level, or the surface would not stay continuous. */
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

/* Counts the levels that move anything in each cell: those down to the leaf over it. */
static void find_levels(Push *p) {
    for (int c = 0; c < lattice_cells(p->lattice); c++) {
        PushCell *cell = &p->cell[c];
        cell->levels = 0;
        for (int level = 0; level <= p->lattice->depth; level++)
            for (int k = 0; k < 4; k++)
                if (p->mobility[cell->unknown[level][k]] > 0) cell->levels = level + 1;
    }
}

/* Where a vertex is that the field displaces by d, with its offset and dent: no farther off than the cap. */
static Vec3 displaced(const Push *p, int vertex, Vec3 d) {
    bool capped = false;
    int place = p->sheet->place[vertex];
    return vec_add(p->global[vertex], field_limit(vec_add(d, field_alone(&p->field, place)), p->field.cap, &capped));
}

/* Puts all vertices where the field has them. */
static void find_points(Push *p) {
    surface_field(&p->surface, p->sheet, &p->field, p->point);
    for (int v = 0; v < p->sheet->nvertices; v++) p->point[v] = displaced(p, v, p->point[v]);
}

/* weight[level][k]: how far unknown k of a level moves the sample. */
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

/* Roles (bits 1 << role) of the parts that push the surface at a place: those that it is worn over there, and those
   that the garment is worn over elsewhere, such as the other leg for one leg of trousers. */
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

/* Makes a sample of every vertex that is near to such a part. */
static void find_samples(Push *p) {
    const Sheet *sheet = p->sheet;
    double far = PUSH_MARGIN * p->field.scale + p->reach;
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

/* A bound on how far a sample has been moved since it was found. */
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

/* Between two parts that overlap there is no room. There each push undoes the one before, and only carries the
   neighbours away, so the sample is left alone. */
static bool is_pinched(const Push *p, const PushSample *s) {
    return s->spent > s->budget || (s->spent > BUDGET * p->field.scale && vec_len(s->net) < HEADWAY * s->spent);
}

/* The distance from all parts that is enough for a sample in this sweep. */
static double enough_for(const Push *p, const PushSample *s) { return (1 - p->slack) * p->clearance[s->vertex]; }

/* Has the sample's patch moved so little that the sample cannot have come too near to a part since they were last
   asked? The cheapest test, for most samples of most sweeps. */
static inline bool is_at_rest(const Push *p, const PushSample *s) {
    return near_slack(s->near.least, enough_for(p, s)) > p->patch_travel[s->patch] - s->patch_travelled;
}

/* May the sample itself have come too near? Asked of the bound on its own movement, then of its position. Fills weight
   and near.seen, where it is now, if so. */
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

/* Other samples may have carried this one farther out than it asked for. Then it takes back its own pushes, as far
   as it keeps its clearance. Returns how far that is, in metres. */
static double take_back(Push *p, PushSample *s, double weight[][4], double clearance, PushResult *result) {
    double pushed = vec_len(s->net), way = fmin(s->near.least - clearance, pushed);
    if (pushed <= 0 || way <= 0) return 0;
    Vec3 n = vec_scale(s->net, -1 / pushed);
    s->net = vec_mad(s->net, n, way);
    project(p, s, weight, n, way, result);
    near_move(&s->near, sample_point(p, s, weight));
    return way;
}

/* Pushes one sample out of the parts that it is too near to. A part that was far enough is not asked again until the
   sample has moved by the difference; but one that gives way, once asked, is asked each time, for how far it does may
   change at once in a fold. Returns the largest violation that was acted on, in metres. */
static double push_sample(Push *p, PushSample *s, PushResult *result) {
    const BodyFrame *body = p->body;
    if (s->budget >= 0 && is_pinched(p, s)) return 0;
    double clearance = p->clearance[s->vertex], enough = enough_for(p, s), most = 0;
    double far = clearance + p->reach, weight[LATTICE_LEVELS][4];
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

/* One pass over all samples. Returns the largest push in metres; 0: all keep their clearance. */
static double sweep(Push *p, PushResult *result) {
    double most = 0;
    p->taken = 0;
    for (int k = 0; k < p->nsamples; k++)
        if (!is_at_rest(p, &p->sample[k])) most = fmax(most, push_sample(p, &p->sample[k], result));
    return most;
}

/* Sweeps until all samples keep their clearance and little is taken back, or until it stalls (after STALL sweeps the
   largest push is not halved), or SWEEPS_MAX. Returns the sum of the largest moves, a bound on all of them. */
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

/* What the sweeps have found out is known of the vertices too, if no other part is near them: then most need not be
   asked about again when they are settled and tested. */
static void tell_near(Push *p) {
    for (int k = 0; k < p->nsamples; k++) {
        const Near *found = &p->sample[k].near;
        Near *near = &p->near[p->sample[k].vertex];
        if (found->parts != near->parts) continue;
        *near = *found;
        near->least -= (float)(UNSURE * p->field.scale);
    }
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

/* What was found within a shorter reach tells nothing of the parts beyond it. */
static void set_reach(Push *p, double reach) {
    if (reach > p->reach) p->near_known = false;
    p->reach = reach;
}

void push_solve(Push *p, PushResult *result) {
    double moved = INFINITY;
    field_drop_dents(&p->field);
    for (int round = 0; round < ROUNDS_MAX && moved >= p->reach; round++) {
        set_reach(p, (round == 0 ? REACH : REACHES_ON) * p->field.scale);
        find_samples(p);
        moved = sweep_all(p, result); /* if less than its reach, no vertex that was far away can have come near */
    }
    result->capped |= moved >= p->reach;
    tell_near(p);
    if (moved > 0) find_points(p);
}

void push_vertex(Push *p, int vertex, Vec3 by, bool *capped) {
    Vec3 d = vec_add(vec_sub(p->point[vertex], p->global[vertex]), by);
    p->point[vertex] = vec_add(p->global[vertex], field_limit(d, p->field.cap, capped));
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
    result->active = 0;
    result->displacement = 0;
    for (int k = 0; k < p->field.start[LATTICE_LEVELS]; k++) result->active += !field_is_zero(p->field.displacement[k]);
    for (int v = 0; v < p->sheet->nvertices; v++)
        result->displacement = fmax(result->displacement, vec_dist(p->point[v], p->global[v]));
}
