/* Cloth that follows bones by weights knows nothing of what the bones do to each other. Behind a bent knee the cloth of
   the thigh would lie in the calf, and that of the calf in the thigh. So what belongs to one side of a fold is moved
   back to it. Only the middle of a curve is asked, and its two inner control points move by the same way: the curve
   then lies flat in the fold, rather than well before it as it would if each point had to stay on its side. */
#include "dress/crease.h"

#include "dress/yield.h"
#include "geometry/bezier.h"

static const double OWN = 0.25;   /* a point that follows the other side by no more than this belongs to the one, */
static const double APART = 0.5;  /* and one that follows other limbs by more to neither side of a hip */
static const double GAP = 0.25, ROOM = 0.5; /* of YIELD_ROOM: what cloth keeps from the plane, and from the other side's
                                               flesh where that ends before the plane */

/* How far a point in the fold of a joint lies outside of where a blend leaves it. A blend keeps its distance from the
   joint, but there the flesh of both sides meets as the sides of a mitre do: on the line that halves the angle between
   the bones, farther out by 1 / sin of that half. */
static Vec3 mitre(const Figure *figure, const Pose *pose, Role bone, Role on, Vec3 point) {
    static const double MOST = 2.2;
    Vec3 joint = figure->start[bone], down = vec_sub(figure->end[bone], joint);
    Vec3 up = on == ROLE_PELVIS ? vec(0, 1, 0) : vec_sub(figure->start[on], joint);
    Vec3 halving = vec_add(mat_apply(pose->bone[bone].r, vec_unit_or(down, vec(0, -1, 0))),
                           mat_apply(pose->bone[on].r, vec_unit_or(up, vec(0, 1, 0))));
    Vec3 line = vec_unit_or(halving, vec(0, 0, 0));
    double cosine = 0.5 * vec_len(halving), sine = sqrt(fmax(1 - cosine * cosine, 1e-12));
    double inside = vec_dot(vec_sub(point, rigid_apply(pose->bone[bone], joint)), line);
    return vec_scale(line, fmax(inside, 0) * (fmin(1 / sine, MOST) - 1));
}

Vec3 crease_mitre(const Figure *figure, const Pose *pose, const Binding *b, Vec3 at) {
    Vec3 out = at;
    for (int i = 0; i < b->n; i++)
        for (int k = 0; k < b->n; k++)
            if (fold_joins(b->bone[i], b->bone[k]))
                out = vec_mad(out, mitre(figure, pose, b->bone[i], b->bone[k], at), 4 * b->weight[i] * b->weight[k]);
    return out;
}

/* The trunk is above both hips, also where cloth follows the other leg a little. Of a limb only that limb's own cloth
   is above its knee or elbow. */
CreaseSide crease_side(const Fold *fold, const Binding *b) {
    int limb = role_limb(fold->lower);
    double below = 0, on_limb = 0, elsewhere = 0;
    for (int i = 0; i < b->n; i++) {
        int of = role_limb(b->bone[i]);
        if (of == limb) on_limb += b->weight[i];
        if (of == limb && b->bone[i] >= fold->lower) below += b->weight[i];
        if (of != limb && of != 0) elsewhere += b->weight[i];
    }
    if (fold_has_above(fold, ROLE_PELVIS) ? elsewhere > APART : on_limb == 0) return CREASE_APART;
    return below <= OWN ? CREASE_ABOVE : below >= 1 - OWN ? CREASE_BELOW : CREASE_BETWEEN;
}

CreaseSide crease_side_of_both(CreaseSide a, CreaseSide b) {
    if (a == CREASE_BETWEEN || a == b) return b;
    return b == CREASE_BETWEEN ? a : CREASE_APART;
}

/* How far the flesh of the other side is from a point, as if nothing pressed on it; metres. */
static double distance_from_other(const Body *body, const Pose *pose, const Fold *fold, CreaseSide side, Vec3 p) {
    double least = INFINITY;
    for (int k = 0; k < body->nparts; k++) {
        const BodyPart *part = &body->part[k];
        bool is_other = side == CREASE_ABOVE ? part->role == fold->lower : fold_has_above(fold, part->role);
        if (!is_other) continue;
        Vec3 at = rigid_unapply(part->frame, rigid_unapply(pose->bone[part->role], p));
        least = fmin(least, body_distance(part, at, least, NULL));
    }
    return least;
}

/* The way by which a point gets back to its side. Near the joint, where there is no fold, it is none. */
static Vec3 way_back(const Body *body, const Pose *pose, const Fold *fold, CreaseSide side, Vec3 p) {
    Vec3 none = vec(0, 0, 0), r = vec_sub(p, fold->joint);
    if (side != CREASE_ABOVE && side != CREASE_BELOW) return none;
    double scale = YIELD_ROOM * figure_scale(body->height), inside = vec_dot(r, fold->inwards);
    Vec3 across = side == CREASE_ABOVE ? fold->across : vec_scale(fold->across, -1);
    double way = GAP * scale - vec_dot(r, across);
    if (way <= 0 || inside <= 0) return none;
    double room = distance_from_other(body, pose, fold, side, vec_mad(p, across, way)) - ROOM * scale;
    if (room > 0) way = fmax(way - room, 0);
    return vec_scale(across, way * fold->closed * smoothstep(0, fold->radius, inside));
}

void crease_keep(const Body *body, const Pose *pose, const Fold *fold, CreaseSide start, CreaseSide end,
                 Vec3 curve[4]) {
    Vec3 first = way_back(body, pose, fold, start, curve[0]), last = way_back(body, pose, fold, end, curve[3]);
    for (int k = 0; k < 4; k++) curve[k] = vec_add(curve[k], k < 2 ? first : last);
    Vec3 middle = vec_mad(vec_scale(vec_add(curve[0], curve[3]), 0.125), vec_add(curve[1], curve[2]), 0.375);
    Vec3 way = way_back(body, pose, fold, crease_side_of_both(start, end), middle);
    for (int k = 1; k < 3; k++) curve[k] = vec_mad(curve[k], way, 4.0 / 3);
}

/* The ways of both thirds determine the inner control points. They are followed by four fifths: the middle, where there
   is no thigh, goes farther than the thirds. */
void crease_keep_between(const Body *body, const Pose *pose, const Fold *fold, CreaseSide side, Vec3 curve[4]) {
    static const double SHARE = 0.8;
    Vec3 way[2];
    for (int k = 0; k < 2; k++) {
        double b[4];
        bezier_basis((k + 1) / 3.0, b, NULL);
        way[k] = vec_scale(way_back(body, pose, fold, side, bezier_cubic(curve, b)), SHARE);
    }
    for (int k = 0; k < 2; k++) curve[1 + k] = vec_mad(vec_mad(curve[1 + k], way[k], 3), way[1 - k], -1.5);
}
