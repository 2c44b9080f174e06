/* Room between arms and trunk. A motion is captured on one body and played back on another: hands
   that passed the hips then go through them, and no cloth can lie where two parts overlap.

   The one idea: the arm is looked at section by section. The point of a section that is nearest to a part of
   the trunk must stand off it by what the cloth on both needs; the angle that brings it there is found by Newton's
   method along the arc on which it moves. The largest angle of all sections is the turn. A section
   has a say only as far as the turn leads it away from the trunk, which fades where the
   two directions part: what fades is continuous, and hands in the lap stay there. */
#include "figure/relax.h"

/* The parts that arms are kept off. */
static const Role TRUNK[] = {ROLE_PELVIS, ROLE_SPINE, ROLE_CHEST, ROLE_LEFT_THIGH, ROLE_RIGHT_THIGH};
enum { TRUNK_PARTS = sizeof TRUNK / sizeof TRUNK[0], SECTIONS_PER_PART = 8, FEET = 2, STEPS = 12 };

/* Cosine between the way out of the trunk and the way the arm turns: below the first a section has no
   say, from the second on its full say. */
static const double ASIDE = 0.1, ALONG = 0.4;

/* Near the shoulder every upper arm is in the chest: at the first place (in bone lengths) a section may
   be deeper in it by so much (metres, for a figure of 1.70 m), beyond the second not at all. */
static const double ARMPIT_FROM = 0.45, ARMPIT_TO = 0.85, ARMPIT_DEPTH = 0.08;

/* Sections of the forearm up to here go with the upper arm: the elbow could hardly move them. */
static const double AT_ELBOW = 0.4;

/* Degrees: an elbow that is nearly straight is a hinge that does not turn sideways; a bent one lets
   the forearm go aside, because the upper arm turns about itself. */
static const double ELBOW_STIFF = 30, ELBOW_FREE = 90;

/* Space beyond the cloth itself, for a figure of 1.70 m, and the accuracy of the search (metres). */
static const double SPARE = 0.008, CLOSE = 1e-5;

/* Beyond this distance (for a figure of 1.70 m) no part is looked at. */
static const double FAR = 0.3;

typedef struct {
    const Figure *figure;
    const Body *body;
    const Cloth *cloth;
    const Pose *pose;     /* with the turns found so far */
    int arm, ntrunk;
    const BodyPart *trunk[TRUNK_PARTS];
    Rigid to_part[TRUNK_PARTS];
} Search;

/* A turn of an arm, by any angle: about an axis through a point. */
typedef struct { Vec3 pivot, axis; double most; } Hinge;

static Role upper_arm(int arm) { return arm == ARM_LEFT ? ROLE_LEFT_UPPER_ARM : ROLE_RIGHT_UPPER_ARM; }

static Vec3 bone_direction(const Figure *f, const Pose *pose, Role role) {
    Vec3 bone = vec_unit_or(vec_sub(f->end[role], f->start[role]), vec(0, -1, 0));
    return mat_apply(pose->bone[role].r, bone);
}

/* The hinge at the start of a bone that turns it straight to its side. */
static Hinge hinge_at(const Figure *f, const Pose *pose, int arm, Role role) {
    Mat3 chest = pose->bone[ROLE_CHEST].r;
    Vec3 aside = vec_scale(mat_column(chest, 0), arm == ARM_LEFT ? 1 : -1);
    Vec3 bone = bone_direction(f, pose, role), axis = vec_cross(bone, aside);
    return (Hinge){rigid_apply(pose->bone[role], f->start[role]), vec_unit_or(axis, mat_column(chest, 2)),
                   atan2(vec_len(axis), vec_dot(bone, aside))};
}

static Rigid hinge_turn(const Hinge *h, double angle) {
    Mat3 r = mat_axis_angle(h->axis, angle);
    return (Rigid){r, vec_sub(h->pivot, mat_apply(r, h->pivot))};
}

/* Turns a bone and those behind it, down to the hand. */
static void turn_from(const Figure *f, Pose *pose, int arm, Role role, double degrees) {
    Hinge h = hinge_at(f, pose, arm, role);
    Rigid turn = hinge_turn(&h, fmin(degrees * PI / 180, h.most));
    if (degrees <= 0) return;
    for (Role r = role; r <= upper_arm(arm) + 2; r++) pose->bone[r] = rigid_mul(turn, pose->bone[r]);
}

void relax_apply(const Figure *figure, const ArmTurn turn[ARMS], Pose *pose) {
    for (int arm = 0; arm < ARMS; arm++) {
        turn_from(figure, pose, arm, upper_arm(arm), turn[arm].shoulder);
        turn_from(figure, pose, arm, upper_arm(arm) + 1, turn[arm].elbow);
    }
}

/* How far the cloth on a part stands off it at height y of the part's frame. */
static double cloth_at(const Cloth *cloth, const BodyPart *part, double y) {
    double place = clamp((y - part->low) / (part->high - part->low), 0, 1) * (CLOTH_PLACES - 1);
    int i = place < CLOTH_PLACES - 2 ? (int)place : CLOTH_PLACES - 2;
    const double *off = cloth->off[part->role];
    return off[i] + (place - i) * (off[i + 1] - off[i]);
}

/* A section of the arm, posed. */
typedef struct {
    Vec3 centre;
    Mat3 frame;
    Section section;
    double cloth, grace; /* metres: of cloth on it, and that it may be nearer than cloth asks */
} Slice;

static Slice slice_of(const Search *s, const BodyPart *part, double y) {
    Rigid g = rigid_mul(s->pose->bone[part->role], part->frame);
    Section c = body_section_at(part, y, NULL);
    Slice out = {rigid_apply(g, vec(c.x, y, c.z)), g.r, c, cloth_at(s->cloth, part, y), 0};
    if (part->role == upper_arm(s->arm))
        out.grace = (1 - smoothstep(ARMPIT_FROM, ARMPIT_TO, y / part->length)) * ARMPIT_DEPTH * s->figure->height / 1.7;
    return out;
}

/* The point of the slice's rim that is farthest in a direction. */
static Vec3 rim_point(const Slice *s, Mat3 turn, Vec3 centre, Vec3 direction) {
    Vec3 d = mat_apply(mat_transpose(s->frame), mat_apply(mat_transpose(turn), direction));
    double a = s->section.side, b = d.z >= 0 ? s->section.front : s->section.back;
    double size = sqrt(a * a * d.x * d.x + b * b * d.z * d.z);
    if (size < 1e-9) return centre;
    Vec3 rim = vec(a * a * d.x / size, 0, b * b * d.z / size);
    return vec_add(centre, mat_apply(turn, mat_apply(s->frame, rim)));
}

/* Signed distance of a point in the part's frame from its surface. body_distance is exact only near the
   surface, so it is asked again at the foot that it finds. */
static double distance_of(const BodyPart *part, Vec3 p, double far, Vec3 *normal) {
    Vec3 foot = p;
    double first = body_distance(part, p, far, normal), d = first;
    if (first >= far) return far;
    for (int i = 0; i < FEET; i++) {
        foot = vec_mad(foot, *normal, -d);
        d = body_distance(part, foot, far, normal);
    }
    return first < 0 ? -vec_dist(p, foot) : vec_dist(p, foot);
}

/* What a turn of the slice by some angle leaves between it and a part of the trunk. */
typedef struct {
    double lack;  /* metres that are missing; negative: there is more room than needed */
    double speed; /* metres of room that are won by a radian */
    double lever; /* metres that the nearest point moves by a radian */
} Gap;

static Gap gap_after(const Search *s, const Slice *slice, const Hinge *h, double angle, int trunk) {
    const BodyPart *part = s->trunk[trunk];
    Rigid turn = hinge_turn(h, angle);
    Vec3 centre = rigid_apply(turn, slice->centre), point = centre, local, normal;
    double size = s->figure->height / 1.7, distance = 0;
    for (int pass = 0; pass < 2; pass++) {
        local = rigid_apply(s->to_part[trunk], point);
        normal = vec(0, 0, 0);
        distance = distance_of(part, local, FAR * size, &normal);
        normal = mat_apply(mat_transpose(s->to_part[trunk].r), normal);
        if (pass == 0) point = rim_point(slice, turn.r, centre, vec_scale(normal, -1));
    }
    Vec3 way = vec_cross(h->axis, vec_sub(point, h->pivot));
    double cloth = cloth_at(s->cloth, part, local.y) + slice->cloth;
    double wanted = cloth > 0 ? cloth + SPARE * size : -FAR * size;
    return (Gap){wanted - slice->grace - distance, vec_dot(way, normal), vec_len(way)};
}

/* The angle (radians, at most `most`) that this slice asks for because of this part: the root of the
   lack, by the Illinois rule, which keeps it between two bounds. */
static double angle_of(const Search *s, const Slice *slice, const Hinge *h, int trunk, double most) {
    Gap at_low = gap_after(s, slice, h, 0, trunk);
    double say = smoothstep(ASIDE, ALONG, at_low.speed / fmax(at_low.lever, 1e-9));
    if (at_low.lack <= 0 || say <= 0) return 0;
    double low = 0, high = most, lack_low = at_low.lack, lack_high = gap_after(s, slice, h, most, trunk).lack;
    if (lack_high > 0) return say * most;
    int kept = 0;
    for (int i = 0; i < STEPS && high - low > CLOSE; i++) {
        double angle = low + (high - low) * lack_low / (lack_low - lack_high);
        double lack = gap_after(s, slice, h, angle, trunk).lack;
        if (lack > 0) {
            low = angle;
            lack_low = lack;
            if (kept == 1) lack_high *= 0.5;
            kept = 1;
        } else {
            high = angle;
            lack_high = lack;
            if (kept == -1) lack_low *= 0.5;
            kept = -1;
        }
        if (fabs(lack) < CLOSE) return say * angle;
    }
    return say * high;
}

/* The largest angle that the sections of a part between two places (bone lengths) ask for. */
static double angle_of_part(const Search *s, Role role, const Hinge *h, double from, double to, double most) {
    int found = s->body->of_role[role];
    const BodyPart *part = &s->body->part[found < 0 ? 0 : found];
    double least = 0;
    if (found < 0) return 0;
    for (int i = 0; i < SECTIONS_PER_PART; i++) {
        double y = part->low + (part->high - part->low) * (i + 0.5) / SECTIONS_PER_PART, at = y / part->length;
        if (at < from || at > to) continue;
        Slice slice = slice_of(s, part, y);
        for (int t = 0; t < s->ntrunk; t++) least = fmax(least, angle_of(s, &slice, h, t, most));
    }
    return least;
}

/* First the shoulder makes room for the elbow, then the elbow for the hand as far as it can, then
   the shoulder for the hand. */
static ArmTurn find_arm(Search *s, Pose *pose) {
    static const double everywhere = 1e9;
    const Figure *f = s->figure;
    Role upper = upper_arm(s->arm), forearm = upper + 1, hand = upper + 2;
    double bend = acos(clamp(vec_dot(bone_direction(f, pose, upper), bone_direction(f, pose, forearm)), -1, 1));
    double elbow_most = ELBOW_TURN_MOST * smoothstep(ELBOW_STIFF, ELBOW_FREE, bend * 180 / PI);
    double most = SHOULDER_TURN_MOST * PI / 180;
    Pose turned = *pose;
    ArmTurn out = {0, 0};
    s->pose = &turned;

    Hinge shoulder = hinge_at(f, pose, s->arm, upper);
    double first = fmax(angle_of_part(s, upper, &shoulder, ARMPIT_FROM, everywhere, most),
                        angle_of_part(s, forearm, &shoulder, -everywhere, AT_ELBOW, most));
    turn_from(f, &turned, s->arm, upper, first * 180 / PI);

    Hinge elbow = hinge_at(f, &turned, s->arm, forearm);
    double second = fmax(angle_of_part(s, forearm, &elbow, AT_ELBOW, everywhere, elbow_most * PI / 180),
                         angle_of_part(s, hand, &elbow, -everywhere, everywhere, elbow_most * PI / 180));
    out.elbow = second * 180 / PI;
    turn_from(f, &turned, s->arm, forearm, out.elbow);

    double third = fmax(angle_of_part(s, forearm, &shoulder, AT_ELBOW, everywhere, most - first),
                        angle_of_part(s, hand, &shoulder, -everywhere, everywhere, most - first));
    out.shoulder = (first + third) * 180 / PI;
    return out;
}

void relax_find(const Figure *figure, const Body *body, const Cloth *cloth, const Pose *pose, ArmTurn out[ARMS]) {
    Search s = {.figure = figure, .body = body, .cloth = cloth};
    Pose scratch = *pose;
    for (int t = 0; t < TRUNK_PARTS; t++) {
        if (body->of_role[TRUNK[t]] < 0) continue;
        const BodyPart *part = s.trunk[s.ntrunk] = &body->part[body->of_role[TRUNK[t]]];
        s.to_part[s.ntrunk++] = rigid_inverse(rigid_mul(pose->bone[part->role], part->frame));
    }
    for (int arm = 0; arm < ARMS; arm++) {
        s.arm = arm;
        out[arm] = find_arm(&s, &scratch);
    }
}
