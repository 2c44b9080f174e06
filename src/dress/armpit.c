/* Below an arm that is raised nothing holds cloth out as a kneecap does. There it does not keep its distance from the
   joint, as a blend does, but is spanned straight from the trunk to the arm; only the shoulder itself it goes round.
   An arm that hangs, or lies across the chest, has no such room below it: cloth would be crushed there. */
#include "dress/armpit.h"

static Armpit armpit_find(const Figure *figure, const Body *body, const Pose *pose, Role arm) {
    static const double AWAY = 0.5; /* an arm that points sideways or up by so much of its length has all the room */
    int part = body->of_role[arm];
    if (part < 0) return (Armpit){.spanned = 0};
    Vec3 along = mat_apply(pose->bone[arm].r, vec_sub(figure->end[arm], figure->start[arm]));
    Vec3 d = mat_apply(mat_transpose(pose->bone[ROLE_CHEST].r), vec_unit_or(along, vec(0, 0, 0)));
    Section shoulder = body_section_at(&body->part[part], 0);
    return (Armpit){.joint = rigid_apply(pose->bone[arm], figure->start[arm]),
                    .radius = fmax(shoulder.side, fmax(shoulder.front, shoulder.back)),
                    .spanned = smoothstep(0, AWAY, fmax(arm == ROLE_LEFT_UPPER_ARM ? d.x : -d.x, d.y))};
}

Armpits armpits_find(const Figure *figure, const Body *body, const Pose *pose) {
    return (Armpits){{armpit_find(figure, body, pose, ROLE_LEFT_UPPER_ARM),
                      armpit_find(figure, body, pose, ROLE_RIGHT_UPPER_ARM)}};
}

/* The side (0 left, 1 right) of the arm that a binding to trunk and arm names; -1 for any other. */
static int side_of(const Binding *b) {
    int side = -1;
    for (int i = 0; i < b->n; i++)
        if (b->bone[i] == ROLE_LEFT_UPPER_ARM || b->bone[i] == ROLE_RIGHT_UPPER_ARM)
            side = b->bone[i] == ROLE_RIGHT_UPPER_ARM;
        else if (role_limb(b->bone[i]) != 0)
            return -1;
    return side;
}

Vec3 armpits_span(const Armpits *a, const Pose *pose, const Binding *b, Vec3 rest, Vec3 at) {
    int side = side_of(b);
    if (side < 0 || a->side[side].spanned <= 0) return at;
    const Armpit *armpit = &a->side[side];
    Vec3 straight = {0, 0, 0};
    for (int i = 0; i < b->n; i++)
        straight = vec_mad(straight, rigid_apply(pose->bone[b->bone[i]], rest), b->weight[i]);
    double away = vec_dist(at, armpit->joint), left = fmax(vec_dist(straight, armpit->joint), armpit->radius);
    return left < away ? vec_lerp(at, vec_lerp(armpit->joint, at, left / away), armpit->spanned) : at;
}
