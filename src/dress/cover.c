/* Rays from a place on a bone, at right angles to it: cloth that goes all round stops all of them. The bone of a
   group is found from its shape alone: its axis is the direction in which the vertices spread most. */
#include "dress/cover.h"

#include <string.h>

#include "figure/roles.h"
#include "geometry/predicate.h"

enum { RAYS = 32, POWER_STEPS = 40 };

/* Joints lie this share of a limb's length before its ends, which are round. */
static const double JOINT = 0.1;

const char *const cover_names[COVER_COUNT] = {"hips", "thighs", "knees", "torso"};

typedef struct {
    bool is_there;
    Vec3 middle, axis;   /* axis is a unit vector */
    double low, high;    /* where the ends are on the axis, from the middle */
} Limb;

/* The direction of the largest spread: a vector that is multiplied by the covariances again and
   again turns to it. */
static Vec3 main_axis(const Mesh *m, MeshGroup g, Vec3 middle) {
    Mat3 spread = {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
    for (int t = g.first; t < g.first + g.count; t++)
        for (int k = 0; k < 3; k++) {
            Vec3 d = vec_sub(m->position[m->triangle[t].v[k]], middle);
            spread.r[0] = vec_mad(spread.r[0], d, d.x);
            spread.r[1] = vec_mad(spread.r[1], d, d.y);
            spread.r[2] = vec_mad(spread.r[2], d, d.z);
        }
    Vec3 axis = vec(0.48, 0.6, 0.64); /* not square to anything likely */
    for (int step = 0; step < POWER_STEPS; step++) axis = vec_unit_or(mat_apply(spread, axis), axis);
    return axis;
}

static Limb find_limb(const Mesh *m, Role role) {
    Limb limb = {.middle = {0, 0, 0}};
    for (int i = 0; i < m->ngroups && !limb.is_there; i++) {
        MeshGroup g = m->group[i];
        if (strcmp(g.name, role_name(role)) != 0 || g.count == 0) continue;
        limb.is_there = true;
        for (int t = g.first; t < g.first + g.count; t++)
            for (int k = 0; k < 3; k++) limb.middle = vec_add(limb.middle, m->position[m->triangle[t].v[k]]);
        limb.middle = vec_scale(limb.middle, 1.0 / (3 * g.count));
        limb.axis = main_axis(m, g, limb.middle);
        for (int t = g.first; t < g.first + g.count; t++)
            for (int k = 0; k < 3; k++) {
                double at = vec_dot(limb.axis, vec_sub(m->position[m->triangle[t].v[k]], limb.middle));
                limb.low = fmin(limb.low, at);
                limb.high = fmax(limb.high, at);
            }
    }
    return limb;
}

/* The point of the axis a share of the way from one end to the other. */
static Vec3 on_axis(const Limb *limb, double share) {
    return vec_mad(limb->middle, limb->axis, limb->low + share * (limb->high - limb->low));
}

/* The joint at the end of the limb that is nearer to p. */
static Vec3 joint_towards(const Limb *limb, Vec3 p) {
    Vec3 a = on_axis(limb, JOINT), b = on_axis(limb, 1 - JOINT);
    return vec_dist(a, p) < vec_dist(b, p) ? a : b;
}

static bool ray_hits(const BoxTree *garment, Vec3 from, Vec3 to) {
    Box box = {from, from};
    box_add(&box, to);
    BoxWalk walk = boxtree_walk(garment, box);
    for (int t; (t = boxtree_next(&walk)) >= 0;) {
        const Vec3 *p = garment->position;
        const int *v = garment->triangle[t].v;
        if (predicate_segment_triangle(from, to, p[v[0]], p[v[1]], p[v[2]])) return true;
    }
    return false;
}

/* The share of the rays square to `axis` that meet the garment. */
static double fan(const BoxTree *garment, Vec3 from, Vec3 axis) {
    Box box = boxtree_box(garment);
    box_add(&box, from);
    double reach = vec_dist(box.low, box.high);
    Vec3 side = fabs(axis.x) < 0.6 ? vec(1, 0, 0) : vec(0, 0, 1);
    Vec3 u = vec_unit_or(vec_mad(side, axis, -vec_dot(side, axis)), vec(0, 1, 0)), w = vec_cross(axis, u);
    int hits = 0;
    for (int i = 0; i < RAYS; i++) {
        double angle = 2 * PI * i / RAYS;
        Vec3 d = vec_add(vec_scale(u, cos(angle)), vec_scale(w, sin(angle)));
        hits += ray_hits(garment, from, vec_mad(from, d, reach));
    }
    return (double)hits / RAYS;
}

/* A place of a leg is covered as far as the better of two fans says: square to the thigh, or to the
   trunk. The rays behind a leg that swings forward dive under the hem in the first. */
static double leg_cover(const BoxTree *garment, Vec3 place, Vec3 thigh, Vec3 trunk) {
    return fmax(fan(garment, place, thigh), fan(garment, place, trunk));
}

bool cover_measure(const Mesh *body, const Mesh *garment, Arena *arena, double share[COVER_COUNT], Error *e) {
    BoxTree tree;
    Limb pelvis = find_limb(body, ROLE_PELVIS), spine = find_limb(body, ROLE_SPINE);
    Limb chest = find_limb(body, ROLE_CHEST);
    Limb thigh[2] = {find_limb(body, ROLE_LEFT_THIGH), find_limb(body, ROLE_RIGHT_THIGH)};
    Limb shin[2] = {find_limb(body, ROLE_LEFT_SHIN), find_limb(body, ROLE_RIGHT_SHIN)};
    for (int p = 0; p < COVER_COUNT; p++) share[p] = NAN;
    if (!boxtree_build(&tree, garment->position, garment->triangle, NULL, garment->ntriangles, arena, e)) return false;
    if (!pelvis.is_there || !chest.is_there) return true;
    Vec3 trunk = vec_unit_or(vec_sub(chest.middle, pelvis.middle), vec(0, 1, 0)), hips = {0, 0, 0};
    share[COVER_TORSO] = fan(&tree, chest.middle, trunk);
    if (spine.is_there) share[COVER_TORSO] = fmin(share[COVER_TORSO], fan(&tree, spine.middle, trunk));
    if (!thigh[0].is_there || !thigh[1].is_there) return true;
    for (int k = 0; k < 2; k++) { /* fmin passes over NAN */
        hips = vec_mad(hips, joint_towards(&thigh[k], pelvis.middle), 0.5);
        double round = leg_cover(&tree, on_axis(&thigh[k], 0.5), thigh[k].axis, trunk);
        share[COVER_THIGHS] = fmin(share[COVER_THIGHS], round);
        if (!shin[k].is_there) continue;
        round = leg_cover(&tree, joint_towards(&thigh[k], shin[k].middle), thigh[k].axis, trunk);
        share[COVER_KNEES] = fmin(share[COVER_KNEES], round);
    }
    share[COVER_HIPS] = fan(&tree, hips, trunk);
    return true;
}
