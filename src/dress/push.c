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
static const double AGREEMENT = 0.7;   /* cosine: an analytic normal farther off its facets is not used */
static const double FADE = 0.8;        /* of the carried displacement, in 1/30 s */
static const double FELT = 0.0002;     /* a carried displacement below this is dropped */
static const double PIN_GIVES = 0.2;   /* a pinned level vertex moves this share of what a free one would */
static const double NORM_MIN = 0.1;    /* a sample that level vertices hardly move must not fling them */
static const double BUDGET = 0.02;     /* a sample may issue twice its first violation and this */
static const double HEADWAY = 0.6;     /* pushes that get this share of their length nowhere are a pinch */
static const double RAISE_MAX = 0.02;  /* most extra clearance */
static const double OFFSET_MAX = 0.03; /* of a single vertex: more would be a spike */

bool push_reserve(Push *p, const Lattice *lattice, Arena *arena, Error *e) {
    *p = (Push){.lattice = lattice, .scale = lattice->fit->height / 1.70, .pelvis = mat_identity()};
    p->cap = lattice->fit->height / (lattice->fit->garment->loose ? 7 : 9);
    for (int l = 0; l <= lattice->depth; l++) p->start[l + 1] = p->start[l] + lattice->level[l].count;
    for (int l = lattice->depth + 1; l < LATTICE_LEVELS; l++) p->start[l + 1] = p->start[l];
    int unknowns = p->start[LATTICE_LEVELS], places = lattice->nplaces;
    p->displacement = ARENA_NEW(arena, Vec3, unknowns, e);
    p->active = ARENA_NEW(arena, bool, unknowns, e);
    p->offset = ARENA_NEW(arena, Vec3, places, e);
    p->kept_displacement = ARENA_NEW(arena, Vec3, unknowns, e);
    p->kept_offset = ARENA_NEW(arena, Vec3, places, e);
    p->kept_point = ARENA_NEW(arena, Vec3, places, e);
    p->global = ARENA_NEW(arena, Vec3, places, e);
    p->point = ARENA_NEW(arena, Vec3, places, e);
    p->clearance = ARENA_NEW(arena, double, places, e);
    p->sample = ARENA_NEW(arena, PushSample, places, e);
    p->raised = ARENA_NEW(arena, int, places, e);
    return p->displacement && p->active && p->offset && p->kept_displacement && p->kept_offset && p->kept_point &&
           p->global && p->point && p->clearance && p->sample && p->raised;
}

static bool is_zero(Vec3 v) { return v.x == 0 && v.y == 0 && v.z == 0; }

/* One carried vector; false once it is no longer felt. */
static bool carry(Vec3 *d, Mat3 turn, double fade, double felt) {
    if (is_zero(*d)) return false;
    *d = vec_scale(mat_apply(turn, *d), fade);
    if (vec_dot(*d, *d) > felt * felt) return true;
    *d = vec(0, 0, 0);
    return false;
}

void push_carry(Push *p, const BodyFrame *body, double dt, bool restart, Leaves *leaves) {
    const Lattice *l = p->lattice;
    double fade = restart ? 0 : pow(FADE, dt * 30), felt = FELT * p->scale;
    Mat3 pelvis = body->pose.bone[ROLE_PELVIS].r, turn = mat_mul(pelvis, mat_transpose(p->pelvis));
    for (int level = 0; level <= l->depth; level++)
        for (int v = 0; v < l->level[level].count; v++)
            if (carry(&p->displacement[p->start[level] + v], turn, fade, felt)) leaves_open(leaves, level, v);
    for (int v = 0; v < l->nplaces; v++) carry(&p->offset[v], turn, fade, felt);
    p->pelvis = pelvis;
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
            p->active[p->start[level] + v] = all;
        }
    }
}

static void owner_of(const Lattice *l, int place, int *patch, int *i, int *j) {
    int n = l->side + 1, o = l->owner[place];
    *patch = o / (n * n);
    *i = o / n % n;
    *j = o % n;
}

static Vec3 global_point(const Lattice *l, const Patch *root, int place) {
    int patch, i, j;
    owner_of(l, place, &patch, &i, &j);
    const double *bu = l->basis[i], *bw = l->basis[j];
    Vec3 sum = {0, 0, 0};
    for (int k = 0; k < 4; k++) {
        const Vec3 *p = root[patch].p[k];
        Vec3 row = vec_mad(vec_mad(vec_mad(vec_scale(p[0], bw[0]), p[1], bw[1]), p[2], bw[2]), p[3], bw[3]);
        sum = vec_mad(sum, row, bu[k]);
    }
    return sum;
}

/* Levels (bit 1 << level) at which anything is displaced: most frames have none or few. */
static unsigned levels_used(const Push *p) {
    unsigned used = 0;
    for (int level = 0; level <= p->lattice->depth; level++)
        for (int k = p->start[level]; k < p->start[level + 1] && !(used >> level & 1); k++)
            if (!is_zero(p->displacement[k])) used |= 1u << level;
    return used;
}

/* The field at a place: the sum over the levels in use (without the offset). */
static Vec3 field(const Push *p, unsigned levels, int place) {
    const Lattice *l = p->lattice;
    int patch, i, j, vertex[4];
    double weight[4];
    Vec3 d = {0, 0, 0};
    owner_of(l, place, &patch, &i, &j);
    for (int level = 0; levels >> level; level++) {
        if (!(levels >> level & 1)) continue;
        lattice_weights(l, level, patch, i, j, vertex, weight, NULL, NULL);
        for (int k = 0; k < 4; k++) d = vec_mad(d, p->displacement[p->start[level] + vertex[k]], weight[k]);
    }
    return d;
}

static Vec3 limit(Vec3 d, double cap, bool *capped) {
    double n = vec_len(d);
    if (n <= cap) return d;
    *capped = true;
    return vec_scale(d, cap / n);
}

/* A vertex displaced by d: never farther than the cap, whatever the levels add up to. */
static Vec3 displaced(const Push *p, const Sheet *sheet, int vertex, Vec3 d) {
    bool capped = false;
    return vec_add(p->global[vertex], limit(vec_add(d, p->offset[sheet->place[vertex]]), p->cap, &capped));
}

static void find_points(Push *p, const Sheet *sheet) {
    unsigned levels = levels_used(p);
    for (int v = 0; v < sheet->nvertices; v++) p->point[v] = displaced(p, sheet, v, field(p, levels, sheet->place[v]));
}

static Vec3 sample_point(const Push *p, const Sheet *sheet, const PushSample *s) {
    Vec3 d = {0, 0, 0};
    for (int k = 0; k < s->n; k++) d = vec_mad(d, p->displacement[s->id[k]], s->weight[k]);
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
    owner_of(l, sheet->place[vertex], &patch, &i, &j);
    for (int level = 0; level <= l->depth; level++) {
        lattice_weights(l, level, patch, i, j, id, weight, NULL, NULL);
        for (int k = 0; k < 4; k++) {
            int unknown = p->start[level] + id[k];
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
    double far = (PUSH_MARGIN + REACH) * p->scale;
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
        Vec3 *d = &p->displacement[s->id[k]];
        *d = limit(vec_mad(*d, n, step * s->share[k]), p->cap, &result->capped);
    }
}

/* Between two parts that overlap there is no room: each push undoes the one before, and all that
   would come of it is that the neighbours are carried away. */
static bool is_pinched(const Push *p, const PushSample *s) {
    return s->spent > s->budget || (s->spent > BUDGET * p->scale && vec_len(s->net) < HEADWAY * s->spent);
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
        double depth = clearance - body_frame_distance(body, part, x, clearance + REACH * p->scale, &n);
        slack = fmin(slack, SLACK * clearance - depth);
        if (depth <= SLACK * clearance) continue;
        if (s->budget < 0) s->budget = 2 * depth + BUDGET * p->scale;
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
    Vec3 *o = &p->offset[sheet->place[vertex]];
    for (int step = 0; step < SETTLES_MAX; step++) {
        bool moved = false;
        for (int part = 0; near >> part; part++) {
            if (!(near >> part & 1)) continue;
            Vec3 n;
            double depth =
                p->clearance[vertex] - body_frame_distance(body, part, p->point[vertex], p->clearance[vertex], &n);
            if (depth <= SLACK * p->clearance[vertex]) continue;
            Vec3 longer = limit(vec_mad(*o, n, depth), OFFSET_MAX * p->scale, capped);
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
        p->global[v] = global_point(p->lattice, root, sheet->place[v]);
        p->clearance[v] = PUSH_MARGIN * p->scale;
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
        if (moved < REACH * p->scale) break; /* nobody can have come near who was not */
    }
    find_points(p, sheet);
    for (int k = 0; k < p->nsamples; k++)
        settle_vertex(p, body, sheet, p->sample[k].vertex, p->sample[k].near, &result->capped);
}

bool push_raise(Push *p, int vertex, double by) {
    double most = (PUSH_MARGIN + RAISE_MAX) * p->scale;
    if (p->clearance[vertex] >= most) return false;
    if (p->clearance[vertex] <= PUSH_MARGIN * p->scale) p->raised[p->nraised++] = vertex; /* its first time */
    p->clearance[vertex] = fmin(p->clearance[vertex] + by * p->scale, most);
    return true;
}

void push_settle(Push *p, const BodyFrame *body, const Sheet *sheet, PushResult *result) {
    for (int k = 0; k < p->nraised; k++) {
        int v = p->raised[k];
        settle_vertex(p, body, sheet, v, parts_near(p, body, sheet->place[v], p->point[v], p->clearance[v]),
                      &result->capped);
    }
}

static void swap(Vec3 **a, Vec3 **b) {
    Vec3 *t = *a;
    *a = *b;
    *b = t;
}

void push_back(Push *p) {
    swap(&p->displacement, &p->kept_displacement);
    swap(&p->offset, &p->kept_offset);
    swap(&p->point, &p->kept_point);
}

void push_afresh(Push *p) {
    push_back(p);
    memset(p->displacement, 0, (size_t)p->start[LATTICE_LEVELS] * sizeof *p->displacement);
    memset(p->offset, 0, (size_t)p->lattice->nplaces * sizeof *p->offset);
}

void push_measure(const Push *p, const BodyFrame *body, const Sheet *sheet, PushResult *result) {
    result->active = result->pinched = 0;
    result->displacement = 0;
    for (int k = 0; k < p->start[LATTICE_LEVELS]; k++) result->active += !is_zero(p->displacement[k]);
    for (int v = 0; v < sheet->nvertices; v++)
        result->displacement = fmax(result->displacement, vec_dist(p->point[v], p->global[v]));
    for (int k = 0; k < p->nsamples; k++) {
        const PushSample *s = &p->sample[k];
        if (s->budget >= 0 && parts_near(p, body, sheet->place[s->vertex], p->point[s->vertex], 0)) result->pinched++;
    }
}

/* Derivatives of the displaced patch at a place, by the parameters of its owner. */
static Vec3 analytic_normal(const Push *p, const Patch *root, unsigned levels, int place) {
    const Lattice *l = p->lattice;
    int patch, i, j, id[4];
    owner_of(l, place, &patch, &i, &j);
    Vec3 du = {0, 0, 0}, dw = {0, 0, 0};
    for (int a = 0; a < 4; a++)
        for (int b = 0; b < 4; b++) {
            du = vec_mad(du, root[patch].p[a][b], l->basis_slope[i][a] * l->basis[j][b]);
            dw = vec_mad(dw, root[patch].p[a][b], l->basis[i][a] * l->basis_slope[j][b]);
        }
    for (int level = 0; levels >> level; level++) {
        if (!(levels >> level & 1)) continue;
        double weight[4], wu[4], ww[4];
        lattice_weights(l, level, patch, i, j, id, weight, wu, ww);
        for (int k = 0; k < 4; k++) {
            du = vec_mad(du, p->displacement[p->start[level] + id[k]], wu[k]);
            dw = vec_mad(dw, p->displacement[p->start[level] + id[k]], ww[k]);
        }
    }
    Vec3 n = vec_cross(du, dw);
    return l->fit->patch[patch].flip ? vec_scale(n, -1) : n;
}

void push_normals(const Push *p, const Patch *root, const Sheet *sheet, const Vec3 *position, Vec3 *normal) {
    unsigned levels = levels_used(p);
    for (int v = 0; v < sheet->nvertices; v++) normal[v] = vec(0, 0, 0);
    for (int t = 0; t < sheet->ntriangles; t++) {
        const int *v = sheet->triangle[t].v;
        Vec3 n = vec_cross(vec_sub(position[v[1]], position[v[0]]), vec_sub(position[v[2]], position[v[0]]));
        for (int c = 0; c < 3; c++) normal[v[c]] = vec_add(normal[v[c]], n);
    }
    for (int v = 0; v < sheet->nvertices; v++) {
        Vec3 faces = vec_unit_or(normal[v], vec(0, 1, 0)),
             smooth = vec_unit_or(analytic_normal(p, root, levels, sheet->place[v]), faces);
        normal[v] = vec_dot(smooth, faces) > AGREEMENT ? smooth : faces;
    }
}

/* The field of one level over cell (a, b) of a deeper one, as a patch: of the cell of that level
   that holds it the four corners' vectors, each to its quarter of the control points, then cut. */
static Patch field_part(const Push *p, LatticeCell cell, int level, int deeper) {
    int shift = deeper - level, n = (1 << level) + 1, a = cell.a >> shift, b = cell.b >> shift;
    const int *vertex = p->lattice->level[level].vertex;
    Patch whole;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            int v = vertex[(cell.patch * n + a + i / 2) * n + b + j / 2];
            whole.p[i][j] = p->displacement[p->start[level] + v];
        }
    double size = 1.0 / (1 << shift), u = (cell.a - (a << shift)) * size, w = (cell.b - (b << shift)) * size;
    return bezier_part(&whole, u, u + size, w, w + size);
}

Patch push_leaf(const Push *p, const Patch *root, LatticeCell cell, int level) {
    double size = 1.0 / (1 << level), u = cell.a * size, w = cell.b * size;
    Patch leaf = bezier_part(&root[cell.patch], u, u + size, w, w + size);
    for (int l = 0; l <= level; l++) {
        Patch field = field_part(p, cell, l, level);
        for (int k = 0; k < 16; k++) leaf.p[k / 4][k % 4] = vec_add(leaf.p[k / 4][k % 4], field.p[k / 4][k % 4]);
    }
    return leaf;
}
