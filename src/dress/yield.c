/* Two parts A and B with signed distances a and b lack the room o = ROOM - a - b at a point. A
   gives way by its share of it, B by the rest: a + s o and b + (1 - s) o add up to ROOM, so
   wherever both may give way there is a gap that wide, and where nothing is lacking nothing
   changes. It is a function of the pose alone: no state, no popping. */
#include "dress/yield.h"

/* How far the flesh of a role gives way, metres on 1.70 m: soft over belly, thigh and calf,
   hardly at all over bone. */
static double softness(Role role) {
    switch (role) {
    case ROLE_PELVIS: return 0.030;
    case ROLE_SPINE: return 0.035;
    case ROLE_CHEST: return 0.025;
    case ROLE_NECK: return 0.008;
    case ROLE_LEFT_UPPER_ARM:
    case ROLE_RIGHT_UPPER_ARM: return 0.018;
    case ROLE_LEFT_FOREARM:
    case ROLE_RIGHT_FOREARM: return 0.012;
    case ROLE_LEFT_HAND:
    case ROLE_RIGHT_HAND: return 0.006;
    case ROLE_LEFT_THIGH:
    case ROLE_RIGHT_THIGH: return 0.035;
    case ROLE_LEFT_SHIN:
    case ROLE_RIGHT_SHIN: return 0.022;
    case ROLE_LEFT_FOOT:
    case ROLE_RIGHT_FOOT: return 0.006;
    default: return 0.003;
    }
}

static bool is_upper(Role r) {
    return r == ROLE_LEFT_UPPER_ARM || r == ROLE_RIGHT_UPPER_ARM || r == ROLE_LEFT_THIGH || r == ROLE_RIGHT_THIGH;
}

bool yield_concerns(Role a, Role b) {
    if (a > b) return yield_concerns(b, a);
    if (role_limb(a) != role_limb(b)) return true;
    if (role_limb(a) == 0) return a == ROLE_CHEST && b == ROLE_HEAD; /* a bowed head comes to the chest */
    return a != b && (b - a > 1 || is_upper(a));
}

/* Captured legs that swing past each other pass through each other by more than flesh would give. */
static double softness_of_legs(Role role) {
    switch (role) {
    case ROLE_LEFT_SHIN:
    case ROLE_RIGHT_SHIN: return 0.032;
    case ROLE_LEFT_FOOT:
    case ROLE_RIGHT_FOOT:
    case ROLE_LEFT_TOE:
    case ROLE_RIGHT_TOE: return 0.020;
    default: return softness(role);
    }
}
static bool are_legs(Role a, Role b) {
    int leg = role_limb(ROLE_LEFT_THIGH);
    return role_limb(a) != role_limb(b) && role_limb(a) >= leg && role_limb(b) >= leg;
}

/* Parts that meet at a joint of the body: at its outside they are one surface, and only where they
   fold against each other do they press. */
static bool share_joint(Role a, Role b) {
    if (a > b) return share_joint(b, a);
    if (role_limb(a) == role_limb(b)) return b - a == 1;
    bool is_leg = role_limb(b) == role_limb(ROLE_LEFT_THIGH) || role_limb(b) == role_limb(ROLE_RIGHT_THIGH);
    return is_upper(b) && a == (is_leg ? ROLE_PELVIS : ROLE_CHEST);
}

void yield_contact(Role a, Role b, double scale, Contact *of_a, Contact *of_b) {
    bool legs = are_legs(a, b);
    double soft_a = legs ? softness_of_legs(a) : softness(a), soft_b = legs ? softness_of_legs(b) : softness(b);
    *of_a = (Contact){.share = soft_a / (soft_a + soft_b), .most = soft_a * scale, .folds = share_joint(a, b)};
    *of_b = (Contact){.share = 1 - of_a->share, .most = soft_b * scale, .folds = of_a->folds};
}

bool yield_hinges(Role upper, Role lower) { return is_upper(upper) && lower == upper + 1; }

void yield_fold(Vec3 centre, Vec3 up, Vec3 down, double radius, Contact *upper, Contact *lower) {
    static const double OPEN = 40 * PI / 180, FOLDED = 80 * PI / 180; /* bends of the joint */
    static const double BEYOND = 1.5; /* radii: an open joint has no fold, its skin does not reach that far in */
    static const double GIVES = 0.8;  /* of the radius: there is a bone in it */
    double bend = atan2(vec_len(vec_cross(up, down)), -vec_dot(up, down));
    upper->fold = (Fold){.centre = centre, .across = vec_unit_or(vec_sub(up, down), up)};
    upper->fold.inwards = vec_unit_or(vec_add(up, down), vec(0, 0, 0));
    if (bend > OPEN) upper->fold.bottom = radius * (BEYOND + (1 - BEYOND) * smoothstep(OPEN, FOLDED, bend));
    lower->fold = upper->fold;
    lower->fold.across = vec_scale(upper->fold.across, -1);
    upper->most = fmax(upper->most, GIVES * radius);
    lower->most = fmax(lower->most, GIVES * radius);
}

/* In a fold a part ends at the plane that halves the bend, half the room before it; towards the joint, where
   both bones are one, the wall falls away steeply. It ends there only where the other is near. */
static double yield_in_fold(const Contact *c, double scale, Vec3 p, double distance, double other, Vec3 away,
                            Vec3 *normal) {
    static const double STEEP = 3;
    const Fold *fold = &c->fold;
    Vec3 r = vec_sub(p, fold->centre), floor = vec_unit_or(vec_mad(fold->across, fold->inwards, -STEEP), fold->across);
    double half = 0.5 * YIELD_ROOM * scale, near = YIELD_ROOM * scale - other;
    double wall = half - vec_dot(r, fold->across);
    double below = half * vec_dot(floor, fold->across) - vec_dot(vec_mad(r, fold->inwards, -fold->bottom), floor);
    double least = fmin(fmin(wall, below), near);
    if (least <= distance) return 0;
    *normal = vec_scale(least == near ? away : least == wall ? fold->across : floor, -1);
    return fmin(least - distance, c->most);
}

static double yield_by_share(const Contact *c, double scale, double distance, double other, Vec3 away, Vec3 *normal) {
    static const double FACING = 0.6; /* cosine between a normal and the other's opposite: folded, all of the way */
    double lacking = YIELD_ROOM * scale - distance - other, share = c->share;
    if (lacking <= 0) return 0;
    if (c->folds) share *= smoothstep(0, FACING, -vec_dot(*normal, away));
    if (share * lacking >= c->most) return c->most;
    *normal = vec_unit_or(vec_sub(vec_scale(*normal, 1 - share), vec_scale(away, share)), *normal);
    return share * lacking;
}

bool yield_may(const Contact *c, Vec3 normal, Vec3 away) {
    static const double SURE = 0.2; /* cosine: they do not face each other, however roughly the normal is known */
    return !c->folds || c->fold.bottom > 0 || vec_dot(normal, away) < SURE;
}

double yield_by(const Contact *c, double scale, Vec3 p, double distance, double other, Vec3 away, Vec3 *normal) {
    Vec3 shared = *normal, folded = *normal;
    double by = yield_by_share(c, scale, distance, other, away, &shared);
    double in_fold = c->fold.bottom > 0 ? yield_in_fold(c, scale, p, distance, other, away, &folded) : 0;
    *normal = in_fold > by ? folded : shared;
    return fmax(by, in_fold);
}
