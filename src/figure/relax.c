/* Room between arms and trunk. A motion is captured on one body and played back on another: hands that passed the
   hips then go through them, and no cloth can lie where two parts overlap.

   The arm is taken section by section. The point of a section that is nearest to a part of the trunk must stand off
   it by what the cloth on both needs. A turn to the side, or forwards for what is in front, moves that point on an
   arc; a search finds where on the arc there is room enough. The arm's turns are the largest that its sections ask
   for. A section counts only as far as the turn moves it away from the trunk, and this share fades smoothly, so the
   result is a continuous function of the pose. */
#include "figure/relax.h"

const double relax_most[TURNS] = {40, 20, 30};

/* The parts that arms are kept off. */
static const Role TRUNK[] = {ROLE_PELVIS, ROLE_SPINE, ROLE_CHEST, ROLE_LEFT_THIGH, ROLE_RIGHT_THIGH};
enum {
    TRUNK_PARTS = sizeof TRUNK / sizeof TRUNK[0],
    SECTIONS_PER_PART = 8, /* of an arm's part that are looked at */
    FEET = 2,              /* times that distance_of is measured again */
    STEPS = 12,            /* of the search, at most */
};

/* A skirt spans from thigh to thigh. So where one is worn, more thighs are imagined between the two, at these fractions
   of the way from left to right. */
static const double BETWEEN[] = {0.2, 0.4, 0.6, 0.8};
enum { BETWEEN_PARTS = sizeof BETWEEN / sizeof BETWEEN[0], KEPT_OFF_MOST = TRUNK_PARTS + BETWEEN_PARTS };

/* Cosine between the movement of a section's nearest point in the turn and the way out of the trunk there: below ASIDE
   the section does not count, from ALONG on it counts in full. */
static const double ASIDE = 0.1, ALONG = 0.4;

/* An arm is turned to the side, unless the trunk is more behind it than beside it. Share of the way out that turning
   forwards would win: from RIVAL_FROM on the turn to the side counts less, from RIVAL_TO on not at all. */
static const double RIVAL_FROM = 0.5, RIVAL_TO = 0.9;

/* Near the shoulder every upper arm is in the chest. Up to ARMPIT_FROM (in bone lengths) a section may be deeper in it
   by ARMPIT_DEPTH (metres, for a figure of 1.70 m), beyond ARMPIT_TO not at all. */
static const double ARMPIT_FROM = 0.45, ARMPIT_TO = 0.85, ARMPIT_DEPTH = 0.08;

/* Sections of the forearm up to here (in bone lengths) count with the upper arm: turning the elbow hardly moves
   them. */
static const double AT_ELBOW = 0.4;

/* Degrees of bend. An elbow that is nearly straight does not turn sideways; one that is bent lets the forearm go
   aside, because the upper arm turns about its axis. */
static const double ELBOW_STIFF = 30, ELBOW_FREE = 90;

/* Space beyond the cloth itself, metres for a figure of 1.70 m. */
static const double SPARE = 0.008;

/* The search: its first stride (radians; short, since distances are accurate only near the surface), and its accuracy
   (metres or radians). */
static const double STRIDE = 0.08, CLOSE = 1e-5;

/* Beyond this distance (for a figure of 1.70 m) no part is looked at. */
static const double FAR = 0.3;

static const double DEGREE = PI / 180, EVERYWHERE = 1e9;

typedef struct {
    const Figure *figure;
    const Body *body;
    const Padding *padding;
    const Pose *pose;     /* with the turns found so far */
    int arm, ntrunk;
    const BodyPart *trunk[KEPT_OFF_MOST];
    Rigid to_part[KEPT_OFF_MOST];
} Search;

/* --- joints --- */

/* Shoulder or elbow: unit axes of the turns to the side and forwards, world frame. */
typedef struct {
    Vec3 at, out, forward;
    double out_most; /* radians, to where the bone points straight to the side */
} Pivot;

static Role upper_arm(int arm) { return arm == ARM_LEFT ? ROLE_LEFT_UPPER_ARM : ROLE_RIGHT_UPPER_ARM; }

static Vec3 bone_direction(const Figure *f, const Pose *pose, Role role) {
    Vec3 bone = vec_unit_or(vec_sub(f->end[role], f->start[role]), vec(0, -1, 0));
    return mat_apply(pose->bone[role].r, bone);
}

static Pivot pivot_at(const Figure *f, const Pose *pose, int arm, Role role) {
    Mat3 chest = pose->bone[ROLE_CHEST].r;
    Vec3 left = mat_column(chest, 0), side = vec_scale(left, arm == ARM_LEFT ? 1 : -1);
    Vec3 bone = bone_direction(f, pose, role), axis = vec_cross(bone, side);
    return (Pivot){rigid_apply(pose->bone[role], f->start[role]), vec_unit_or(axis, mat_column(chest, 2)),
                   vec_scale(left, -1), atan2(vec_len(axis), vec_dot(bone, side))};
}

static Rigid turn_about(Vec3 at, Vec3 axis, double angle) {
    Mat3 r = mat_axis_angle(axis, angle);
    return (Rigid){r, vec_sub(at, mat_apply(r, at))};
}

/* Turns a bone and those behind it, down to the hand, either to the side or forwards. Degrees. */
static void turn_from(const Figure *f, Pose *pose, int arm, Role role, double out, double forward) {
    if (out <= 0 && forward <= 0) return;
    Pivot p = pivot_at(f, pose, arm, role);
    Rigid turn = out > 0 ? turn_about(p.at, p.out, fmin(out * DEGREE, p.out_most))
                         : turn_about(p.at, p.forward, forward * DEGREE);
    for (Role r = role; r <= upper_arm(arm) + 2; r++) pose->bone[r] = rigid_mul(turn, pose->bone[r]);
}

/* Forwards comes last, so that the other turns are what they would be without it. */
static void turn_arm(const Figure *f, Pose *pose, int arm, const ArmTurn *turn) {
    turn_from(f, pose, arm, upper_arm(arm), turn->angle[TURN_OUT], 0);
    turn_from(f, pose, arm, upper_arm(arm) + 1, turn->angle[TURN_ELBOW], 0);
    turn_from(f, pose, arm, upper_arm(arm), 0, turn->angle[TURN_FORWARD]);
}

void relax_apply(const Figure *figure, const ArmTurn turn[ARMS], Pose *pose) {
    for (int arm = 0; arm < ARMS; arm++) turn_arm(figure, pose, arm, &turn[arm]);
}

/* --- gaps --- */

/* How far the cloth on a part stands off it at height y of the part's frame: in front of it as far as
   `facing` (cosine) says, else beside it. */
static double padding_at(const Padding *padding, const BodyPart *part, double y, double facing) {
    double place = clamp((y - part->low) / (part->high - part->low), 0, 1) * (PADDING_PLACES - 1);
    int i = place < PADDING_PLACES - 2 ? (int)place : PADDING_PLACES - 2;
    const double *side = padding->side[part->role] + i, *front = padding->front[part->role] + i;
    double share = facing > 0 ? facing * facing : 0, t = place - i;
    return (1 - share) * (side[0] + t * (side[1] - side[0])) + share * (front[0] + t * (front[1] - front[0]));
}

/* A section of the arm, posed. */
typedef struct {
    Vec3 centre;
    Mat3 frame;
    Section section;
    double cloth; /* metres of cloth on it */
    double grace; /* metres that it may be nearer than the cloth asks */
} Slice;

static Slice slice_of(const Search *s, const BodyPart *part, double y) {
    Rigid g = rigid_mul(s->pose->bone[part->role], part->frame);
    Section c = body_section_at(part, y);
    Slice out = {rigid_apply(g, vec(c.x, y, c.z)), g.r, c, padding_at(s->padding, part, y, 0), 0};
    if (part->role == upper_arm(s->arm))
        out.grace = ARMPIT_DEPTH * figure_scale(s->figure->height) *
                    (1 - smoothstep(ARMPIT_FROM, ARMPIT_TO, y / part->length));
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

/* What there is between a slice and a part of the trunk. */
typedef struct {
    double lack;  /* metres that are missing; negative: there is more room than needed */
    Vec3 point, normal; /* of the slice, nearest to the part, and the way out of the part there; world */
} Gap;

/* After a turn of the slice. */
static Gap gap_after(const Search *s, const Slice *slice, int trunk, Rigid turn) {
    const BodyPart *part = s->trunk[trunk];
    Vec3 centre = rigid_apply(turn, slice->centre), point = centre, local, normal;
    double size = figure_scale(s->figure->height), distance = 0, facing = 0;
    for (int pass = 0; pass < 2; pass++) {
        local = rigid_apply(s->to_part[trunk], point);
        normal = vec(0, 0, 0);
        distance = distance_of(part, local, FAR * size, &normal);
        facing = normal.z;
        normal = mat_apply(mat_transpose(s->to_part[trunk].r), normal);
        if (pass == 0) point = rim_point(slice, turn.r, centre, vec_scale(normal, -1));
    }
    double cloth = padding_at(s->padding, part, local.y, facing) + slice->cloth;
    double wanted = cloth > 0 ? cloth + SPARE * size : -FAR * size;
    return (Gap){wanted - slice->grace - distance, point, normal};
}

/* --- turns --- */

/* A way to turn an arm: pivot and unit axis, world frame. rival: the axis of another turn that is preferred where it
   wins more room; a zero vector if there is none. */
typedef struct { Vec3 at, axis, rival; } Swing;

static double lack_after(const Search *s, const Slice *slice, int trunk, const Swing *w, double angle) {
    return gap_after(s, slice, trunk, turn_about(w->at, w->axis, angle)).lack;
}

/* The least angle of the swing (radians, at most `most`) at which no room is missing. lack: what is missing at angle 0.
   Goes in strides until there is room, then by the Illinois rule: the secant between two bounds, where one that has
   stayed twice is given half the weight. */
static double least_angle(const Search *s, const Slice *slice, int trunk, const Swing *w, double lack, double most) {
    double low = 0, high = 0, lack_low = lack, lack_high = lack;
    while (lack_high > 0) {
        if (high >= most) return most;
        low = high;
        lack_low = lack_high;
        high = fmin(high + STRIDE, most);
        lack_high = lack_after(s, slice, trunk, w, high);
    }
    for (int i = 0, stayed = 0; i < STEPS && high - low > CLOSE; i++) {
        double angle = low + (high - low) * lack_low / (lack_low - lack_high);
        lack = lack_after(s, slice, trunk, w, angle);
        if (fabs(lack) < CLOSE) return angle;
        if (lack > 0) {
            low = angle;
            lack_low = lack;
            if (stayed > 0) lack_high *= 0.5;
            stayed = 1;
        } else {
            high = angle;
            lack_high = lack;
            if (stayed < 0) lack_low *= 0.5;
            stayed = -1;
        }
    }
    return high;
}

/* The angle (degrees, at most `most`) that a slice asks for because of a part of the trunk. */
static double angle_of(const Search *s, const Slice *slice, int trunk, const Swing *w, double most) {
    Gap gap = gap_after(s, slice, trunk, rigid_identity());
    if (gap.lack <= 0) return 0;
    Vec3 lever = vec_sub(gap.point, w->at), gain = vec_scale(vec_cross(lever, gap.normal), 1 / vec_len(lever));
    double own = vec_dot(gain, w->axis), rival = fmax(vec_dot(gain, w->rival), 0);
    double share = smoothstep(ASIDE, ALONG, own);
    if (share > 0) share *= 1 - smoothstep(RIVAL_FROM, RIVAL_TO, rival / hypot(own, rival));
    if (share <= 0) return 0;
    return share * least_angle(s, slice, trunk, w, gap.lack, most * DEGREE) / DEGREE;
}

/* The largest that the sections of a part between two places (bone lengths) ask for. */
static double angle_of_part(const Search *s, Role role, double from, double to, const Swing *w, double most) {
    int found = s->body->of_role[role];
    const BodyPart *part = &s->body->part[found < 0 ? 0 : found];
    double all = 0;
    for (int i = 0; i < SECTIONS_PER_PART && found >= 0 && most > 0; i++) {
        double y = part->low + (part->high - part->low) * (i + 0.5) / SECTIONS_PER_PART, at = y / part->length;
        if (at < from || at > to) continue;
        Slice slice = slice_of(s, part, y);
        for (int t = 0; t < s->ntrunk; t++) all = fmax(all, angle_of(s, &slice, t, w, most));
    }
    return all;
}

/* What upper arm and elbow ask for, and what lies beyond the elbow. */
static double near_angle(const Search *s, const Swing *w, double most) {
    Role upper = upper_arm(s->arm);
    return fmax(angle_of_part(s, upper, ARMPIT_FROM, EVERYWHERE, w, most),
                angle_of_part(s, upper + 1, -EVERYWHERE, AT_ELBOW, w, most));
}

static double far_angle(const Search *s, const Swing *w, double most) {
    Role upper = upper_arm(s->arm);
    return fmax(angle_of_part(s, upper + 1, AT_ELBOW, EVERYWHERE, w, most),
                angle_of_part(s, upper + 2, -EVERYWHERE, EVERYWHERE, w, most));
}

/* First the shoulder makes room for the elbow, to the side; then the elbow for the hand as far as it
   can, and the shoulder does the rest; what is still missing in front is won forwards. */
static ArmTurn find_arm(Search *s, const Pose *pose) {
    const Figure *f = s->figure;
    Role upper = upper_arm(s->arm);
    double bend = acos(clamp(vec_dot(bone_direction(f, pose, upper), bone_direction(f, pose, upper + 1)), -1, 1));
    double elbow_most = relax_most[TURN_ELBOW] * smoothstep(ELBOW_STIFF, ELBOW_FREE, bend / DEGREE);
    Pose turned = *pose;
    s->pose = &turned;

    Pivot shoulder = pivot_at(f, pose, s->arm, upper);
    Swing out = {shoulder.at, shoulder.out, shoulder.forward}, forward = {shoulder.at, shoulder.forward, {0, 0, 0}};
    double near = near_angle(s, &out, relax_most[TURN_OUT]);
    turn_from(f, &turned, s->arm, upper, near, 0);

    Pivot elbow = pivot_at(f, &turned, s->arm, upper + 1);
    Swing aside = {elbow.at, elbow.out, elbow.forward};
    double at_elbow = far_angle(s, &aside, elbow_most);
    turn_from(f, &turned, s->arm, upper + 1, at_elbow, 0);

    double far = far_angle(s, &out, relax_most[TURN_OUT] - near);
    ArmTurn turn = {{near + far, 0, at_elbow}};
    turned = *pose;
    turn_arm(f, &turned, s->arm, &turn);
    turn.angle[TURN_FORWARD] = fmax(near_angle(s, &forward, relax_most[TURN_FORWARD]),
                                    far_angle(s, &forward, relax_most[TURN_FORWARD]));
    return turn;
}

static void keep_off(Search *s, const BodyPart *part, Rigid frame) {
    s->trunk[s->ntrunk] = part;
    s->to_part[s->ntrunk++] = rigid_inverse(frame);
}

static void keep_off_between(Search *s, const BodyPart *left, const BodyPart *right, const Pose *pose) {
    Rigid a = rigid_mul(pose->bone[left->role], left->frame), b = rigid_mul(pose->bone[right->role], right->frame);
    for (int i = 0; i < BETWEEN_PARTS; i++) {
        Rigid frame = {mat_nlerp(a.r, b.r, BETWEEN[i]), vec_lerp(a.t, b.t, BETWEEN[i])};
        keep_off(s, BETWEEN[i] < 0.5 ? left : right, frame);
    }
}

void relax_find(const Figure *figure, const Body *body, const Padding *padding, const Pose *pose, ArmTurn out[ARMS]) {
    Search s = {.figure = figure, .body = body, .padding = padding};
    int left = body->of_role[ROLE_LEFT_THIGH], right = body->of_role[ROLE_RIGHT_THIGH];
    for (int t = 0; t < TRUNK_PARTS; t++) {
        if (body->of_role[TRUNK[t]] < 0) continue;
        const BodyPart *part = &body->part[body->of_role[TRUNK[t]]];
        keep_off(&s, part, rigid_mul(pose->bone[part->role], part->frame));
    }
    if (padding->is_tube && left >= 0 && right >= 0)
        keep_off_between(&s, &body->part[left], &body->part[right], pose);
    for (int arm = 0; arm < ARMS; arm++) {
        s.arm = arm;
        out[arm] = find_arm(&s, pose);
    }
}
