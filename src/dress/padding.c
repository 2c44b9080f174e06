/* Samples the garment in the canonical stance. Each sample belongs to the nearest of the parts that its patch is
   worn over, and counts where arm and trunk would touch (on the outer side of trunk and legs, on the inner side of
   arms), and in front. */
#include "dress/padding.h"

#include "dress/follow.h"

enum { SAMPLES = 12 }; /* along each side of a patch */

/* Cosine to the side, or to the front, up to which cloth stands off there. */
static const double FACING = 0.6;

/* Distances that differ by less (metres) are the same. */
static const double SAME = 1e-6;

/* No tight garment stands off by more (metres, for a figure of 1.70 m): its cloth under the armpit
   belongs to the sleeve and to the trunk, and lies on neither. */
static const double TIGHT_MOST = 0.03;

/* The way from a part of the trunk to the arm beside it, or from an arm to the trunk. */
static Vec3 side_of(const BodyPart *part, Vec3 p) {
    int limb = role_limb(part->role);
    bool is_arm = limb == 1 || limb == 2, is_left = limb == 0 ? p.x > 0 : limb % 2 == 1;
    Vec3 along = mat_column(part->frame.r, 1), out = vec(is_left != is_arm ? 1 : -1, 0, 0);
    return vec_unit_or(vec_mad(out, along, -vec_dot(out, along)), out);
}

/* p belongs to the nearest part, and to both legs where it is as near to one as to the other. */
static void add_sample(const Body *body, unsigned collide, Vec3 p, double most, Padding *sum) {
    double least = 1;
    for (int i = 0; i < body->nparts; i++) {
        const BodyPart *part = &body->part[i];
        if (collide >> part->role & 1)
            least = fmin(least, body_distance(part, rigid_unapply(part->frame, p), least, NULL));
    }
    for (int i = 0; i < body->nparts; i++) {
        const BodyPart *part = &body->part[i];
        Vec3 normal, local = rigid_unapply(part->frame, p);
        if (!(collide >> part->role & 1) || body_distance(part, local, least + SAME, &normal) >= least + SAME) continue;
        normal = mat_apply(part->frame.r, normal);
        int place = (int)(clamp((local.y - part->low) / (part->high - part->low), 0, 1) * (PADDING_PLACES - 1) + 0.5);
        double *side = &sum->side[part->role][place], *front = &sum->front[part->role][place];
        if (vec_dot(normal, side_of(part, p)) >= FACING) *side = fmax(*side, fmin(least, most));
        if (normal.z >= FACING) *front = fmax(*front, fmin(least, most));
    }
}

bool padding_add(const Garment *garment, const Figure *figure, const Body *body, Arena *arena, Padding *sum,
                 Error *e) {
    Fit *fit = ARENA_NEW(arena, Fit, 1, e);
    Follower follower;
    Pose stance = figure_rest_pose();
    if (!fit || !fit_garment(garment, figure, body, arena, fit, e) ||
        !follow_reserve(&follower, fit, figure, body, arena, e))
        return false;
    Patch *patch = ARENA_NEW(arena, Patch, fit->npatches, e);
    if (!patch) return false;
    follow_pose(&follower, &stance, patch);
    sum->is_tube = sum->is_tube || garment->follow == FOLLOW_ENVELOPE;
    double most = garment->loose ? INFINITY : TIGHT_MOST * figure_scale(figure->height);
    for (int p = 0; p < fit->npatches; p++)
        for (int k = 0; k <= SAMPLES * (SAMPLES + 2); k++) {
            double u = k % (SAMPLES + 1) / (double)SAMPLES, w = k / (SAMPLES + 1) / (double)SAMPLES;
            add_sample(body, fit->patch[p].collide, bezier_point(&patch[p], u, w, NULL, NULL), most, sum);
        }
    return true;
}
