/* All that a fold needs is the joint and the directions from there along both sides. Above a hip that is the line to
   the neck: a bent back folds over the thigh as a whole. */
#include "dress/fold.h"

/* Bends (degrees; 0: straight) at which a joint begins to fold, and is folded; and `reach` against its radius. */
typedef struct { Role lower; double opens, folds, reach; } Hinge;
static const Hinge hinges[FOLDS] = {
    {ROLE_LEFT_THIGH, 100, 130, 1},     {ROLE_RIGHT_THIGH, 100, 130, 1},  {ROLE_LEFT_SHIN, 40, 80, 1.5},
    {ROLE_RIGHT_SHIN, 40, 80, 1.5},     {ROLE_LEFT_FOREARM, 40, 80, 1.5}, {ROLE_RIGHT_FOREARM, 40, 80, 1.5}};

static const double FLAT = 0.3; /* length of the difference of unit directions along both sides of a hip: less is bent
                                   nearly flat, by more than 163 degrees */

static bool is_hip(Role lower) { return lower == ROLE_LEFT_THIGH || lower == ROLE_RIGHT_THIGH; }

/* A point `at` metres along a part's bone; world. */
static Vec3 along_bone(const BodyPart *part, const Pose *pose, double at) {
    return rigid_apply(pose->bone[part->role], rigid_apply(part->frame, vec(0, at, 0)));
}

/* The direction from a thigh to the trunk. If the hip is bent by nearly 180 degrees, the lines along both hardly
   differ, and what they differ by turns over as the thigh goes on past the trunk. Then the thigh is beside the
   belly, so that direction is drawn to the midline. */
static Vec3 apart_at_hip(const Pose *pose, const Fold *f, Vec3 up, Vec3 down) {
    Vec3 left = mat_column(pose->bone[ROLE_PELVIS].r, 0), apart = vec_sub(up, down);
    Vec3 midline = f->lower == ROLE_LEFT_THIGH ? vec_scale(left, -1) : left;
    Vec3 aside = vec_unit_or(vec_mad(midline, f->inwards, -vec_dot(midline, f->inwards)), apart);
    return vec_mad(apart, aside, fmax(FLAT - vec_len(apart), 0));
}

static Fold find(const Body *body, const Pose *pose, const Hinge *hinge) {
    Role upper = is_hip(hinge->lower) ? ROLE_CHEST : hinge->lower - 1;
    int below = body->of_role[hinge->lower], above = body->of_role[upper];
    Fold f = {.lower = hinge->lower};
    if (below < 0 || above < 0) return f;
    const BodyPart *lower = &body->part[below], *farthest = &body->part[above];
    Section s = body_section_at(lower, 0);
    f.joint = along_bone(lower, pose, 0);
    f.radius = fmax(s.front, s.back);
    f.reach = hinge->reach * f.radius;
    Vec3 end = along_bone(farthest, pose, is_hip(hinge->lower) ? farthest->length : 0);
    Vec3 up = vec_unit_or(vec_sub(end, f.joint), vec(0, 1, 0));
    Vec3 down = vec_unit_or(vec_sub(along_bone(lower, pose, lower->length), f.joint), vec(0, -1, 0));
    double bend = atan2(vec_len(vec_cross(up, down)), -vec_dot(up, down));
    f.closed = smoothstep(hinge->opens * PI / 180, hinge->folds * PI / 180, bend);
    f.inwards = vec_unit_or(vec_add(up, down), vec(0, 0, 0));
    f.across = vec_unit_or(is_hip(hinge->lower) ? apart_at_hip(pose, &f, up, down) : vec_sub(up, down), up);
    return f;
}

Folds folds_find(const Body *body, const Pose *pose) {
    Folds folds;
    for (int k = 0; k < FOLDS; k++) folds.fold[k] = find(body, pose, &hinges[k]);
    return folds;
}

bool fold_joins(Role bone, Role on) {
    bool folds = false;
    for (int k = 0; k < FOLDS; k++) folds |= hinges[k].lower == bone;
    return folds && on == (is_hip(bone) ? ROLE_PELVIS : bone - 1);
}

bool fold_has_above(const Fold *fold, Role role) {
    bool bends_over = is_hip(fold->lower) && (role == ROLE_SPINE || role == ROLE_CHEST);
    return bends_over || fold_joins(fold->lower, role);
}

const Fold *folds_between(const Folds *folds, Role a, Role b) {
    for (int k = 0; k < FOLDS; k++) {
        const Fold *f = &folds->fold[k];
        bool meet = (f->lower == a && fold_has_above(f, b)) || (f->lower == b && fold_has_above(f, a));
        if (meet && f->closed > 0) return f;
    }
    return NULL;
}
