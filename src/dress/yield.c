/* At a point with signed distances a and b from two parts, the room o = ROOM - a - b is missing between them. The
   first gives way by its share s of it, the other by the rest: a + s o and b + (1 - s) o add up to ROOM, so wherever
   both may give way there is a gap of that width. Where nothing is missing nothing changes. All this depends on the
   pose alone, so nothing can jump from frame to frame. */
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

/* Captured legs that swing past each other overlap by more than flesh would give way. So legs are softer to each
   other. */
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

bool yield_share_joint(Role a, Role b) {
    if (a > b) return yield_share_joint(b, a);
    if (role_limb(a) == role_limb(b)) return b - a == 1;
    bool is_leg = role_limb(b) == role_limb(ROLE_LEFT_THIGH) || role_limb(b) == role_limb(ROLE_RIGHT_THIGH);
    return is_upper(b) && a == (is_leg ? ROLE_PELVIS : ROLE_CHEST);
}

void yield_contact(Role a, Role b, double scale, Contact *of_a, Contact *of_b) {
    bool legs = are_legs(a, b);
    double soft_a = legs ? softness_of_legs(a) : softness(a), soft_b = legs ? softness_of_legs(b) : softness(b);
    bool joined = yield_share_joint(a, b);
    double share = soft_a / (soft_a + soft_b);
    *of_a = (Contact){.share = share, .soft = soft_a * scale, .joined = joined};
    *of_b = (Contact){.share = 1 - share, .soft = soft_b * scale, .joined = joined};
    of_a->most = of_a->soft;
    of_b->most = of_b->soft;
    of_a->reach = of_b->reach = YIELD_ROOM * scale;
}

/* One side of a fold. The nearer to closed, the deeper it begins, and the farther the flesh gives way there. */
static void enter_fold(const Fold *fold, Vec3 across, Contact *of) {
    static const double STEEP = 3;
    static const double BEYOND = 1.5; /* radii: an open joint has no fold, its skin does not reach that far in */
    double c = fold->closed;
    of->fold = fold;
    of->across = across;
    of->floor = vec_unit_or(vec_mad(across, fold->inwards, -STEEP), across);
    of->bottom = fold->radius * (BEYOND + (1 - BEYOND) * c);
    of->most += c * fmax(fold->radius - of->most, 0);
    of->reach += c * fmax(fold->reach - of->reach, 0);
}

void yield_fold(const Fold *fold, Contact *above, Contact *below) {
    enter_fold(fold, fold->across, above);
    enter_fold(fold, vec_scale(fold->across, -1), below);
}

/* The walls at which a part ends in a fold, as distances of a point from them: half the room before the plane that
   halves the bend (wall), and before the steep wall towards the joint, where both bones are one (below). */
typedef struct { double wall, below; } FoldEnd;
static FoldEnd end_in_fold(const Contact *c, double room, Vec3 at) {
    Vec3 r = vec_sub(at, c->fold->joint);
    double half = 0.5 * room;
    return (FoldEnd){.wall = half - vec_dot(r, c->across),
                     .below = half * vec_dot(c->floor, c->across) -
                              vec_dot(vec_mad(r, c->fold->inwards, -c->bottom), c->floor)};
}

static inline double lesser(double a, double b) { return a < b ? a : b; }

double yield_within(const Contact *c, double room, Vec3 at, double distance) {
    if (!c->fold) return room - distance;
    FoldEnd end = end_in_fold(c, room, at);
    return (lesser(end.wall, end.below) > distance ? c->reach : room) - distance;
}

static double yield_in_fold(const Contact *c, double room, const Meeting *m) {
    if (!c->fold) return 0;
    FoldEnd end = end_in_fold(c, room, m->at);
    double least = lesser(lesser(end.wall, end.below), c->reach - m->other);
    return least <= m->distance ? 0 : lesser(least - m->distance, c->most);
}

static Vec3 normal_in_fold(const Contact *c, double room, const Meeting *m) {
    FoldEnd end = end_in_fold(c, room, m->at);
    double near = c->reach - m->other;
    bool is_near = near <= end.wall && near <= end.below;
    return vec_scale(is_near ? m->away : end.wall <= end.below ? c->across : c->floor, -1);
}

/* The share of the missing room that a part makes at a point. */
static double share_at(const Contact *c, const Meeting *m) {
    static const double FACING = 0.6; /* cosine of one normal to the opposite of the other: from here on in full */
    return c->joined ? c->share * smoothstep(0, FACING, -vec_dot(m->normal, m->away)) : c->share;
}

static double yield_by_share(const Contact *c, double room, const Meeting *m) {
    double lacking = room - m->distance - m->other;
    return lacking <= 0 ? 0 : lesser(share_at(c, m) * lacking, c->soft);
}

static Vec3 normal_by_share(const Contact *c, double room, const Meeting *m) {
    double share = share_at(c, m);
    if (yield_by_share(c, room, m) >= c->soft) return m->normal;
    return vec_unit_or(vec_sub(vec_scale(m->normal, 1 - share), vec_scale(m->away, share)), m->normal);
}

bool yield_may(const Contact *c, Vec3 normal, Vec3 away) {
    static const double SURE = 0.2; /* cosine between the normals below which they may face each other */
    return !c->joined || c->fold || vec_dot(normal, away) < SURE;
}

double yield_by(const Contact *c, double room, const Meeting *m) {
    double by_share = yield_by_share(c, room, m), in_fold = yield_in_fold(c, room, m);
    return in_fold > by_share ? in_fold : by_share;
}

Vec3 yield_normal(const Contact *c, double room, const Meeting *m) {
    bool is_folded = yield_in_fold(c, room, m) > yield_by_share(c, room, m);
    return is_folded ? normal_in_fold(c, room, m) : normal_by_share(c, room, m);
}
