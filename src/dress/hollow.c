/* Each limb that touches the cloth presses in one direction: into the garment, but not along an arm, which would
   only carry the cloth down. All cloth on that side that is in the limb, or outside of it, is to be moved until the
   limb is behind it. Cloth round about moves too, less with distance.

   So every vertex of the limb's skin asks for a depth that falls off round it, and the hollow is the deepest of these
   everywhere. Whatever moves, it changes no faster than the limb and the cloth do, and it does not depend on how fine
   the mesh of the cloth is. */
#include "dress/hollow.h"

#include <stdlib.h>

enum { POINTS_MAX = 4096 };                    /* of a finer skin only every second vertex presses, or third ... */
static const double WIDE = 0.05, WIDENS = 1.2; /* radius of a hollow: metres on 1.70 m, and this times its depth */
static const double NEAR = 0.03;      /* metres on 1.70 m: cloth so near to a limb counts for its direction. Less cloth
                                         turns from frame to frame, more is not where the limb presses */
static const double FACES = 0.5;      /* cosine between a vertex's inward normal and the limb's direction, from which on
                                         it is pressed in fully */
static const double POINTED = 0.3;    /* squared sine between forearm and direction: below it the arm pokes the cloth,
                                         rather than lies on it */
static const double TURNED = -0.3;    /* cosine between skin and direction: skin turned away more has deeper skin behind
                                         it */
static const double BEGINS = 0.012;   /* metres on 1.70 m: a limb that is so much too near presses in full, one that
                                         only begins to touch presses less, so that nothing jumps */
static const double BEYOND = 1.4;     /* times the cap: skin that is so much farther in is no longer at this cloth */

bool hollow_reserve(Hollow *h, Arena *arena, Error *e) {
    h->point = ARENA_NEW(arena, HollowPoint, POINTS_MAX, e);
    h->block = ARENA_NEW(arena, HollowBlock, (POINTS_MAX + HOLLOW_BLOCK - 1) / HOLLOW_BLOCK, e);
    return h->point && h->block;
}

Limb limb_of(const BodyFrame *body, int part) {
    static const Limb limb[] = {LIMB_OTHER, LIMB_LEFT_ARM, LIMB_RIGHT_ARM, LIMB_OTHER, LIMB_OTHER};
    return limb[role_limb(body->body->part[part].role)];
}

/* The inward unit normal of the global shape at a place. */
static Vec3 inwards(const Push *p, int place) {
    return vec_scale(lattice_normal(p->field.lattice, p->escape.root, place), -1);
}

static unsigned bare_parts(const Push *p) {
    unsigned parts = 0;
    for (int k = 0; k < p->body->body->nparts; k++)
        if (limb_is_bare(p, k)) parts |= 1u << k;
    return parts;
}

/* Adds the limbs' parts that a vertex is too near to. */
static void add_touching(Touch *t, const Push *p, int vertex, unsigned parts) {
    const BodyFrame *body = p->body;
    double clearance = PUSH_MARGIN * p->field.scale;
    for (; parts; parts &= parts - 1) {
        int k = near_first(parts);
        bool is_own = p->field.lattice->collide[p->sheet->place[vertex]] & part_bit(body, k);
        if (is_own || body_frame_far(body, k, p->point[vertex], clearance)) continue;
        double missing = clearance - body_frame_distance(body, k, p->point[vertex], clearance, NULL);
        if (missing <= 0) continue;
        Limb limb = limb_of(body, k);
        t->parts[limb] |= 1u << k;
        t->missing[limb] = fmax(t->missing[limb], missing);
    }
}

/* The inward normal of the cloth near some parts: the mean of its vertices, weighted by how near they are. */
static Vec3 inwards_near(const Push *p, unsigned parts) {
    const BodyFrame *body = p->body;
    double near = NEAR * p->field.scale;
    Vec3 sum = {0, 0, 0};
    for (; parts; parts &= parts - 1) {
        int k = near_first(parts);
        for (int v = 0; v < p->sheet->nvertices; v++) {
            if (body_frame_far(body, k, p->point[v], near)) continue;
            int place = p->sheet->place[v];
            bool is_own = p->field.lattice->collide[place] & part_bit(body, k);
            double distance = is_own ? near : body_frame_distance(body, k, p->point[v], near, NULL);
            if (distance < near) sum = vec_mad(sum, inwards(p, place), near - distance);
        }
    }
    return vec_unit_or(sum, vec(0, 0, 0));
}

/* The direction of an arm, made perpendicular to the forearm; but not if the arm stands straight on the cloth and pokes
   it. */
static Vec3 across_arm(const BodyFrame *body, Limb limb, Vec3 way) {
    int part = body->body->of_role[limb == LIMB_LEFT_ARM ? ROLE_LEFT_FOREARM : ROLE_RIGHT_FOREARM];
    if (limb == LIMB_OTHER || part < 0) return way;
    Vec3 along = mat_column(body->to_world[part], 1);
    double c = vec_dot(way, along);
    return vec_unit_or(vec_mad(way, along, -c * smoothstep(0, POINTED, 1 - c * c)), way);
}

Touch touch_find(const Push *p) {
    const BodyFrame *body = p->body;
    Touch t = {.parts = {0}};
    unsigned bare = bare_parts(p);
    for (int v = 0; v < p->sheet->nvertices; v++) {
        double slack = near_slack(p->near[v].least, p->clearance[v]);
        if (slack <= vec_dist(p->point[v], p->near[v].seen)) add_touching(&t, p, v, bare);
    }
    for (int limb = 0; limb < LIMBS; limb++) {
        if (!t.parts[limb]) continue;
        for (int k = 0; k < body->body->nparts && limb != LIMB_OTHER; k++) /* an arm presses with all bare parts */
            if (bare >> k & 1 && limb_of(body, k) == (Limb)limb) t.parts[limb] |= 1u << k;
        t.way[limb] = across_arm(body, (Limb)limb, inwards_near(p, t.parts[limb]));
    }
    return t;
}

/* How much of the clearance from own parts would be missing for cloth behind a point of the skin, metres. */
static double missing_behind(const Push *p, Vec3 at) {
    double needed = 2 * PUSH_MARGIN * p->field.scale, missing = 0;
    for (int k = 0; k < p->body->body->nparts; k++)
        if (!limb_is_bare(p, k))
            missing = fmax(missing, needed - body_frame_distance(p->body, k, at, needed, NULL));
    return missing;
}

/* Adds a vertex of the skin to the last block, or to a new one. Vertices that follow each other are near each other, so
   the ball round a block rules out most of them at once. */
static void add_point(Hollow *h, const Push *p, Vec3 at) {
    double deep = vec_dot(at, h->way) + PUSH_MARGIN * p->field.scale - missing_behind(p, at);
    if (h->npoints % HOLLOW_BLOCK == 0)
        h->block[h->nblocks++] = (HollowBlock){.point = h->point + h->npoints};
    h->point[h->npoints++] = (HollowPoint){at, deep};
    h->block[h->nblocks - 1].n++;
}

static void enclose(HollowBlock *b) {
    Box box = box_empty();
    b->deepest = -INFINITY;
    for (int k = 0; k < b->n; k++) {
        box_add(&box, b->point[k].at);
        b->deepest = fmax(b->deepest, b->point[k].deep);
    }
    b->middle = vec_mid(box.low, box.high);
    b->radius = 0.5 * vec_dist(box.low, box.high);
}

static int deepest_first(const void *a, const void *b) {
    const HollowBlock *x = a, *y = b;
    if (x->deepest != y->deepest) return x->deepest > y->deepest ? -1 : 1;
    return x->point < y->point ? -1 : 1;
}

void hollow_find(Hollow *h, const Push *p, const Touch *t, Limb limb) {
    const BodyFrame *body = p->body;
    double metre = 1 / body->unit;
    int total = 0;
    h->way = t->way[limb];
    h->share = smoothstep(0, BEGINS * p->field.scale, t->missing[limb]);
    h->wide = WIDE * p->field.scale;
    h->cap = p->field.cap;
    h->npoints = h->nblocks = 0;
    for (unsigned left = t->parts[limb]; left; left &= left - 1) total += body->body->part[near_first(left)].nvertices;
    int step = total / POINTS_MAX + 1;
    for (unsigned left = t->parts[limb]; left; left &= left - 1) {
        const BodyPart *part = &body->body->part[near_first(left)];
        for (int v = part->first_vertex; v < part->first_vertex + part->nvertices && h->npoints < POINTS_MAX; v += step)
            if (vec_dot(body_frame_rest_normal(body, part, v), h->way) > TURNED)
                add_point(h, p, vec_scale(body->position[v], metre));
    }
    for (int k = 0; k < h->nblocks; k++) enclose(&h->block[k]);
    h->all = (HollowBlock){.point = h->point, .n = h->npoints};
    enclose(&h->all);
    qsort(h->block, (size_t)h->nblocks, sizeof *h->block, deepest_first);
}

static double radius_of(const Hollow *h, double depth) { return h->wide + WIDENS * depth; }

/* How deep a hollow of that depth is `aside` metres, squared, from its middle, or `least` if it is not that deep. */
static double depth_beside(const Hollow *h, double depth, double aside2, double least) {
    double radius2 = square(radius_of(h, depth)), rest = radius2 - aside2;
    bool is_less = rest <= 0 || rest * rest * depth <= least * radius2 * radius2;
    return is_less ? least : square(rest / radius2) * depth;
}

/* The depth that is asked for by skin that is `deep` metres behind the cloth. */
static double asked(const Hollow *h, double deep) {
    return deep < h->cap ? deep : h->cap * (1 - smoothstep(h->cap, BEYOND * h->cap, deep));
}

/* How far `at` is from x, across the way, squared. */
static double aside2(const Hollow *h, Vec3 at, Vec3 x) {
    Vec3 off = vec_sub(at, x);
    double along = vec_dot(off, h->way);
    return vec_dot(off, off) - along * along;
}

/* May a point of a block ask for more than `least` at x, `here` metres along the way? */
static bool may_ask(const Hollow *h, const HollowBlock *b, Vec3 x, double here, double least) {
    double most = fmin(b->deepest - here, h->cap), beside2 = aside2(h, b->middle, x);
    if (most <= least || beside2 >= square(radius_of(h, most) + b->radius)) return false;
    double beside = fmax(0, sqrt(fmax(0, beside2)) - b->radius);
    return depth_beside(h, most, beside * beside, least) > least;
}

/* From 0 to 1: how far cloth with that inward normal is pressed in by a limb that presses along n. Cloth on the far
   side of the garment is not. */
static double facing(Vec3 inwards, Vec3 n) { return smoothstep(0, FACES, vec_dot(inwards, n)); }

double hollow_depth(const Hollow *h, const Push *p, int vertex) {
    Vec3 x = p->point[vertex];
    double depth = 0, here = vec_dot(x, h->way);
    if (h->nblocks == 0 || !may_ask(h, &h->all, x, here, 0)) return 0;
    for (const HollowBlock *b = h->block; b < h->block + h->nblocks && b->deepest - here > depth; b++) {
        if (!may_ask(h, b, x, here, depth)) continue;
        for (const HollowPoint *at = b->point; at < b->point + b->n; at++)
            if (at->deep - here > depth)
                depth = depth_beside(h, asked(h, at->deep - here), aside2(h, at->at, x), depth);
    }
    if (depth <= 0) return 0; /* the normal is dear */
    return depth * facing(inwards(p, p->sheet->place[vertex]), h->way) * h->share;
}
