/* Each limb that touches the cloth presses in one direction: into the garment, but not along an arm, which would
   only carry the cloth down. All cloth on that side that is in the limb, or outside of it, is to be moved until the
   limb is behind it, as far as the own parts leave room. Cloth round about moves too, less with distance. */
#include "dress/hollow.h"

#include <stdlib.h>

#include "geometry/boxtree.h"

enum { STEPS_BACK = 24 };
static const double MEETS = 0.05;              /* share of the clearance that may be missing between cloth and limb */
static const double WIDE = 0.05, WIDENS = 1.2; /* radius of a hollow: metres on 1.70 m, and this times its depth */
static const double FACES = 0.5;      /* cosine between a vertex's inward normal and the limb's direction, from which on
                                         it is pressed in fully */
static const double POINTED = 0.3;    /* squared sine between forearm and direction: below it the arm pokes the cloth,
                                         rather than lies on it */

bool hollow_reserve(Hollow *h, const Lattice *lattice, Arena *arena, Error *e) {
    h->presser = ARENA_NEW(arena, Presser, lattice->nplaces, e);
    h->block = ARENA_NEW(arena, PresserBlock, lattice->nplaces / PRESSERS_A_BLOCK + 1, e);
    return h->presser && h->block;
}

/* The inward unit normal of the global shape at a place. */
static Vec3 inwards(const Push *p, int place) {
    return vec_scale(lattice_normal(p->field.lattice, p->escape.root, place), -1);
}

Limb limb_of(const BodyFrame *body, int part) {
    static const Limb limb[] = {LIMB_OTHER, LIMB_LEFT_ARM, LIMB_RIGHT_ARM, LIMB_OTHER, LIMB_OTHER};
    return limb[role_limb(body->body->part[part].role)];
}

static unsigned bare_parts(const Push *p) {
    unsigned parts = 0;
    for (int k = 0; k < p->body->body->nparts; k++)
        if (limb_is_bare(p, k)) parts |= 1u << k;
    return parts;
}

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
        Limb limb = limb_of(body, k);
        t->way[limb] = vec_mad(t->way[limb], inwards(p, place), missing);
        t->parts[limb] |= 1u << k;
    }
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

/* Completes what is known of a limb that touches: if one part of it does, all bare parts press. */
static void complete(Touch *t, const Push *p, Limb limb, unsigned bare) {
    const BodyFrame *body = p->body;
    double clearance = PUSH_MARGIN * p->field.scale;
    Vec3 far = vec(clearance, clearance, clearance);
    t->way[limb] = across_arm(body, limb, vec_unit_or(t->way[limb], vec(0, 0, 0)));
    t->before[limb] = box_empty();
    for (unsigned left = bare; left; left &= left - 1) {
        int k = near_first(left);
        if (limb_of(body, k) != limb) continue;
        t->parts[limb] |= 1u << k;
        Vec3 low = vec_sub(body->box[k].low, far), high = vec_add(body->box[k].high, far);
        for (int before = 0; before < 2; before++) {
            box_add(&t->before[limb], vec_mad(low, t->way[limb], before ? -p->field.cap : 0));
            box_add(&t->before[limb], vec_mad(high, t->way[limb], before ? -p->field.cap : 0));
        }
    }
}

Touch touch_find(const Push *p) {
    Touch t = {.parts = {0}};
    unsigned bare = bare_parts(p);
    for (int v = 0; v < p->sheet->nvertices; v++) {
        double slack = near_slack(p->near[v].least, p->clearance[v]);
        if (slack <= vec_dist(p->point[v], p->near[v].seen)) add_touch(&t, p, v, bare);
    }
    for (int limb = 0; limb < LIMBS; limb++)
        if (t.parts[limb]) complete(&t, p, (Limb)limb, bare);
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

/* From 0 to 1: how far cloth with that inward normal is pressed in by a limb that presses along n. Cloth on the far
   side of the garment is not. */
static double facing(Vec3 inwards, Vec3 n) { return smoothstep(0, FACES, vec_dot(inwards, n)); }

/* Does a limb press a vertex in? *out: by the part that does so farthest. *far: would it have to go farther than the
   cap? */
static bool find_presser(const Push *p, int vertex, const Touch *t, Limb limb, Presser *out, bool *far) {
    const BodyFrame *body = p->body;
    int place = p->sheet->place[vertex];
    double clearance = PUSH_MARGIN * p->field.scale, depth = 0;
    Vec3 at = p->point[vertex], n = t->way[limb];
    for (unsigned left = t->parts[limb]; left; left &= left - 1) {
        int k = near_first(left);
        if (p->field.lattice->collide[place] & part_bit(body, k)) continue;
        depth = fmax(depth, way_past(body, k, at, n, clearance, p->field.cap));
    }
    *far = depth >= p->field.cap;
    if (depth > 0) depth *= facing(inwards(p, place), n);
    if (depth > 0) depth = escape_free(&p->escape, body, place, at, clearance, n, depth);
    *out = (Presser){at, depth, WIDE * p->field.scale + WIDENS * depth};
    return depth > 0;
}

/* Adds a presser to the last block, or to a new one. Vertices that follow each other are near each other, so a box
   round sixteen pressers rules out most of them at once. */
static void add_presser(Hollow *h, const Presser *by) {
    if (h->npressers % PRESSERS_A_BLOCK == 0)
        h->block[h->nblocks++] = (PresserBlock){.presser = h->presser + h->npressers, .box = box_empty()};
    PresserBlock *last = &h->block[h->nblocks - 1];
    h->presser[h->npressers++] = *by;
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

void hollow_find(Hollow *h, const Push *p, const Touch *t, Limb limb, bool *out_of_reach) {
    h->way = t->way[limb];
    h->npressers = h->nblocks = 0;
    h->reach = box_empty();
    for (int v = 0; v < p->sheet->nvertices && t->parts[limb]; v++) {
        Presser by;
        bool far;
        if (!box_touches(t->before[limb], (Box){p->point[v], p->point[v]})) continue;
        if (find_presser(p, v, t, limb, &by, &far)) add_presser(h, &by);
        out_of_reach[v] |= far;
    }
    qsort(h->block, (size_t)h->nblocks, sizeof *h->block, deepest_first);
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

double hollow_depth(const Hollow *h, const Push *p, int vertex) {
    Vec3 at = p->point[vertex];
    double depth = box_touches(h->reach, (Box){at, at}) ? depth_at(h, at) : 0;
    return depth > 0 ? depth * facing(inwards(p, p->sheet->place[vertex]), h->way) : 0;
}
