/* The envelope. A ring of a skirt does not follow one bone: it is a small ellipse that holds the cross-sections of
   both legs in this pose, widened to its rest size as far as the legs leave cloth for it. Since the global shape
   then contains the legs, little is left for the local deformation, and the body's normal is the right direction to
   push.

   A ring stands at arc length s along the body: above the hip joints on the axis of the pelvis, below them on the
   mean of two paths down the legs. The paths are straight lines with kinks at hip and knee, smoothed by a triangular
   window; this convolution has a closed form. */
#include "dress/envelope.h"

/* Lengths are in centimetres of a figure of 1.70 m. */
static const double SHIN_SHARE = 0.5;  /* share of the shin's turn that the path takes at the knee: with 1 the hem
                                          would fold behind a bent knee, with 0 the shin would stick out */
static const double ROUNDING_CM = 10;  /* half width of the window: a thigh's radius */
static const double TURN_LIMIT = 115 * PI / 180; /* a ring turns no farther from the pelvis: it would pass the seat */
static const double OVER = 150 * PI / 180; /* and one that is turned backwards by more has come there forwards */
static const double SLANT_LIMIT = 0.4; /* least cosine between a leg and a ring's axis: a leg that slants more is cut as
                                          if it had this one */
static const double ABOVE_CM = 8, BELOW_CM = 10; /* above and below the hip joints, where rings turn from the pelvis to
                                                    the legs */
static const double SPLIT = 1;         /* length of the sum of both legs' unit directions: if it is less (they are more
                                          than 120 degrees apart), rings are drawn back to the pelvis */
static const double LEG_ROOM_CM = 2.2; /* room for swinging round each leg in a ring */
static const double APART_CM = 3;      /* a ring is so much wider to either side than its legs if they cross */
static const double SPARE_CM2 = 10;    /* width of the soft corner where the legs take up the last of the cloth */
static const double LAP_LEAST_CM = 14, LAP_MOST_CM = 26; /* below the hip joints: where the lap of a bent hip begins */
static const double TURNS_CM[2] = {-3, 10}; /* below the hip joints: where rings turn most */
static const double CORNER_CM = 2;     /* width of the soft corners where the lap begins, and beside the outside */
static const double TIGHT = 1.1;       /* the last ring climbs if legs need more than so many times its size, */
static const double CLIMBS = 0.4;      /* by no more than this share of its way from the hip joints, */
static const double HALF_CLIMBS = 0.32; /* by half of that if they need so much more than TIGHT */
/* Ranges of a hip's flexion, radians: over the first the front comes to hang, until the thigh is level; over the
   second it is gathered, as the thigh comes to the belly. Beyond the third a thigh that points up was certainly bent
   forwards. */
static const double HANGS[2] = {30 * PI / 180, 75 * PI / 180}, GATHERS[2] = {75 * PI / 180, 120 * PI / 180};
static const double SURELY_FORWARDS[2] = {120 * PI / 180, 150 * PI / 180};

/* Convolution of max(0, x) with a unit triangle of half width r, and its derivative. */
static double ramp(double x, double r) {
    if (x <= -r) return 0;
    if (x >= r) return x;
    double a = x < 0 ? x + r : r - x;
    return (x < 0 ? 0 : x) + a * a * a / (6 * r * r);
}

static double ramp_slope(double x, double r) {
    if (x <= -r) return 0;
    if (x >= r) return 1;
    double a = x < 0 ? x + r : r - x;
    return x < 0 ? a * a / (2 * r * r) : 1 - a * a / (2 * r * r);
}

/* The point at s of the path down one leg, and its unit tangent. */
static Vec3 leg_path(const Envelope *env, int leg, double s, Vec3 *tangent) {
    double r = ROUNDING_CM * env->cm;
    Vec3 at_hip = vec_sub(env->thigh[leg], env->down), at_knee = vec_sub(env->lower[leg], env->thigh[leg]);
    double k = s - env->thigh_length[leg];
    Vec3 p = vec_mad(env->hip[leg], env->down, s);
    p = vec_mad(p, at_hip, ramp(s, r));
    p = vec_mad(p, at_knee, ramp(k, r));
    Vec3 t = vec_mad(vec_mad(env->down, at_hip, ramp_slope(s, r)), at_knee, ramp_slope(k, r));
    *tangent = vec_unit_or(t, env->down);
    return p;
}

/* Half the way through a ring from front to back. */
static double mean_depth(const FitRing *r) { return 0.5 * (r->front + r->back); }

/* Rest size of the tube at s: a Catmull-Rom spline through the rings' sizes, straight beyond the first and the last.
   All values are the same weighted sum of four rings. */
static FitRing rest_size(const Envelope *env, double s) {
    const Fit *fit = env->fit;
    int n = fit->garment->nrings, k = 0, at[4];
    double place[4], weight[4] = {0, 0, 0, 0};
    while (k + 2 < n && s > envelope_place(env, k + 1)) k++;
    for (int i = 0; i < 4; i++) {
        at[i] = k - 1 + i < 0 ? 0 : k - 1 + i > n - 1 ? n - 1 : k - 1 + i;
        place[i] = envelope_place(env, at[i]);
    }
    double h = fmax(place[2] - place[1], 1e-9), t = clamp((s - place[1]) / h, 0, 1), over = s - place[1] - t * h;
    double step = t * t * (3 - 2 * t), leave = h * t * (1 - t) * (1 - t), arrive = -h * t * t * (1 - t);
    if (over < 0) leave += over;
    if (over > 0) arrive += over;
    int before = place[1] > place[0] ? 0 : 1, after = place[3] > place[2] ? 3 : 2; /* chords of the end slopes */
    double leave_chord = leave / (h + place[1] - place[before]), arrive_chord = arrive / (h + place[after] - place[2]);
    weight[1] += 1 - step;
    weight[2] += step;
    weight[2] += leave_chord;
    weight[before] -= leave_chord;
    weight[after] += arrive_chord;
    weight[1] -= arrive_chord;
    FitRing out = {0};
    for (int i = 0; i < 4; i++) {
        const FitRing *r = &fit->ring[at[i]];
        out.side += weight[i] * r->side;
        out.front += weight[i] * r->front;
        out.back += weight[i] * r->back;
        out.z += weight[i] * r->z;
    }
    return out;
}

/* Radius of a cylinder that holds the leg at s, metres. */
static double leg_radius(const Envelope *env, double s) {
    const Body *b = env->body;
    bool shin = s > env->thigh_length[0];
    const BodyPart *part = &b->part[b->of_role[shin ? ROLE_LEFT_SHIN : ROLE_LEFT_THIGH]];
    Section c = body_section(part, clamp((shin ? s - env->thigh_length[0] : s) / part->length, 0, 1));
    return fmax(c.side + fabs(c.x), fmax(c.front + c.z, c.back - c.z));
}

/* A symmetric 2 x 2 matrix. A matrix C stands for the ellipse u^T C^-1 u = 1 in a ring's plane; C grows with the
   square of its size. */
typedef struct {
    double xx, xz, zz;
} Sym2;

/* An ellipse that holds two copies of the ellipse e round +-(dx, dz): in coordinates in which e is a unit disc it is
   tight along (dx, dz) and across it. */
static Sym2 hold_both(double dx, double dz, Sym2 e) {
    double det = e.xx * e.zz - e.xz * e.xz;
    double size = sqrt(fmax((e.zz * dx * dx - 2 * e.xz * dx * dz + e.xx * dz * dz) / det, 1e-12));
    double along = 1 + 1 / size, round = 1 + size;
    return (Sym2){along * dx * dx + round * e.xx, along * dx * dz + round * e.xz, along * dz * dz + round * e.zz};
}

/* The ellipse that a ring's plane cuts out of a leg, a cylinder of radius rho. (x, z): the part of the leg's unit
   tangent in the plane. */
static Sym2 cut_leg(double rho, double x, double z) {
    double stretch = rho * rho / fmax(1 - x * x - z * z, SLANT_LIMIT * SLANT_LIMIT);
    return (Sym2){rho * rho + stretch * x * x, stretch * x * z, rho * rho + stretch * z * z};
}

/* The symmetric square root. */
static Sym2 root_of(Sym2 c) {
    double det = sqrt(fmax(c.xx * c.zz - c.xz * c.xz, 0)), scale = 1 / sqrt(fmax(c.xx + c.zz + 2 * det, 1e-12));
    return (Sym2){(c.xx + det) * scale, c.xz * scale, (c.zz + det) * scale};
}

/* max(0, x) with a soft corner of width r. */
static double soft_positive(double x, double r) { return 0.5 * (x + sqrt(x * x + r * r)); }

/* The axes of a ring as columns (left, up, front): those of the pelvis, turned so that down becomes t, by TURN_LIMIT
   at most. They turn about left first, and to the side then. One turn on the shortest way would turn the ring
   about t too, and by more than half a right angle if thighs at the belly are a little to one side. */
static Mat3 ring_axes(const Envelope *env, Vec3 t) {
    Vec3 left = mat_column(env->pelvis, 0), front = mat_column(env->pelvis, 2);
    double aside = clamp(vec_dot(t, left), -1, 1), rest = sqrt(1 - aside * aside);
    double forwards = atan2(vec_dot(t, front), vec_dot(t, env->down));
    if (forwards < -OVER) forwards += 2 * PI;
    forwards = clamp(forwards, -TURN_LIMIT, TURN_LIMIT);
    Vec3 sagittal = vec_add(vec_scale(env->down, cos(forwards)), vec_scale(front, sin(forwards)));
    Vec3 up = vec_mad(vec_scale(left, -aside), sagittal, -rest), x = vec_mad(vec_scale(left, rest), sagittal, -aside);
    return mat_columns(x, up, vec_cross(x, up));
}

/* Where the plane through `at` with unit normal n cuts the leg that runs through p along t; no farther from p than
   ROUNDING_CM. */
static Vec3 cut_path(const Envelope *env, Vec3 p, Vec3 t, Vec3 at, Vec3 n) {
    double most = ROUNDING_CM * env->cm, along = fmin(vec_dot(t, n), -SLANT_LIMIT);
    return vec_mad(p, t, clamp(vec_dot(vec_sub(at, p), n) / along, -most, most));
}

/* A ring that turns with the legs. */
typedef struct {
    double share;        /* 0 at the pelvis, 1 at the legs */
    Vec3 left, front;    /* its axes, unit */
    Vec3 middle;         /* between the legs in its plane */
    FitRing rest;
    double rho, dx, dz;  /* radius of the legs; the left one's centre in its axes, the right one is opposite */
    Sym2 leg;            /* what the plane cuts out of one */
} EnvelopeRing;

/* The sum of the unit directions of both legs. In a split they are nearly opposite, and a little more of it would turn
   their sum by much: then it is drawn to where the pelvis's down is. */
static Vec3 along_both(const Envelope *env, const Vec3 leg[2]) {
    Vec3 sum = vec_add(leg[0], leg[1]);
    return vec_mad(sum, env->down, fmax(SPLIT - vec_len(sum), 0));
}

static EnvelopeRing ring_at(const Envelope *env, double s) {
    double cm = env->cm, share = smoothstep(-ABOVE_CM * cm, BELOW_CM * cm, s);
    Vec3 tangent[2], path[2];
    for (int leg = 0; leg < 2; leg++) path[leg] = leg_path(env, leg, s, &tangent[leg]);
    Vec3 t = vec_scale(along_both(env, tangent), share);
    t = vec_unit_or(vec_mad(t, env->down, 2 * (1 - share)), env->down);
    Mat3 axes = ring_axes(env, t);
    Vec3 ax = mat_column(axes, 0), up = mat_column(axes, 1), az = mat_column(axes, 2);
    Vec3 middle = vec_mid(path[0], path[1]);
    for (int leg = 0; leg < 2; leg++) path[leg] = cut_path(env, path[leg], tangent[leg], middle, up);
    FitRing rest = rest_size(env, s);
    Vec3 half = vec_scale(vec_sub(path[0], path[1]), 0.5), slant = vec_scale(vec_sub(tangent[0], tangent[1]), 0.5);
    /* Half the difference of front and back moves the ring's centre off the legs; half of that adds to their room. */
    double rho = leg_radius(env, s) + LEG_ROOM_CM * cm + 0.25 * fabs(rest.front - rest.back);
    return (EnvelopeRing){.share = share,
                          .left = ax,
                          .front = az,
                          .middle = vec_mid(path[0], path[1]),
                          .rest = rest,
                          .rho = rho,
                          .dx = vec_dot(half, ax),
                          .dz = vec_dot(half, az),
                          .leg = cut_leg(rho, vec_dot(slant, ax), vec_dot(slant, az))};
}

/* The ellipse of a ring. It holds both legs, and keeps the trace of the rest ellipse, about its squared perimeter, as
   long as the legs leave cloth. At the pelvis it is the rest ellipse. */
static Sym2 ring_ellipse(const Envelope *env, const EnvelopeRing *r) {
    double cm = env->cm, side = r->rest.side, depth = mean_depth(&r->rest), apart = APART_CM * cm;
    Sym2 leg = r->leg, calm = hold_both(env->rest_hip, 0, cut_leg(r->rho, 0, 0));
    leg.xx += fmax(apart * apart - r->dx * r->dx, 0);
    Sym2 need = hold_both(r->dx, r->dz, leg);
    double nx = fmax(side * side - calm.xx, cm * cm), nz = fmax(depth * depth - calm.zz, cm * cm);
    double spare = soft_positive(side * side + depth * depth - need.xx - need.zz, SPARE_CM2 * cm * cm);
    double wx = spare * nx / (nx + nz), wz = spare * nz / (nx + nz);
    return (Sym2){r->share * (need.xx + wx) + (1 - r->share) * side * side, r->share * need.xz,
                  r->share * (need.zz + wz) + (1 - r->share) * depth * depth};
}

/* A point of the ring at s that turns with the legs. */
static Vec3 turning_point(const Envelope *env, double s, double x, double z) {
    EnvelopeRing r = ring_at(env, s);
    Sym2 m = root_of(ring_ellipse(env, &r));
    Vec3 centre = vec_lerp(vec_mad(env->root, env->down, s), r.middle, r.share);
    centre = vec_mad(centre, r.front, r.rest.z + 0.5 * (r.rest.front - r.rest.back));
    return vec_mad(vec_mad(centre, r.left, m.xx * x + m.xz * z), r.front, m.xz * x + m.zz * z);
}

/* Where the last ring is, s. Legs that are far apart do not find room in it farther down: then the cloth climbs. */
static double climbed(const Envelope *env) {
    double end = envelope_place(env, env->fit->garment->nrings - 1);
    EnvelopeRing r = ring_at(env, end);
    double depth = mean_depth(&r.rest), cloth = r.rest.side * r.rest.side + depth * depth;
    Sym2 need = hold_both(r.dx, r.dz, r.leg);
    double over = fmax(sqrt((need.xx + need.zz) / cloth) - TIGHT, 0);
    return end - CLIMBS * end * over * over / (over * over + HALF_CLIMBS * HALF_CLIMBS);
}

/* The same point of the ring at rest, moved rigidly with the pelvis. */
static Vec3 pelvis_point(const Envelope *env, double s, double x, double z) {
    FitRing rest = rest_size(env, s);
    double depth = mean_depth(&rest);
    Vec3 p = vec(rest.side * x, -s, rest.z + 0.5 * (rest.front - rest.back) + depth * z);
    return vec_add(env->root, mat_apply(env->pelvis, p));
}

/* The x at which x + rise * smoothstep(a, b, x) is y; rise >= 0. Newton's method from the middle of the step, on either
   side of which the slope only falls, comes nearer from that side alone. */
static double before_step(double a, double b, double rise, double y) {
    enum { STEPS = 6 };
    if (y <= a) return y;
    if (y >= b + rise) return y - rise;
    double x = 0.5 * (a + b);
    for (int k = 0; k < STEPS; k++) {
        double t = clamp((x - a) / (b - a), 0, 1);
        x -= (x + rise * t * t * (3 - 2 * t) - y) / (1 + rise * 6 * t * (1 - t) / (b - a));
    }
    return x;
}

/* Round the outside of a bent hip the way is longer than the cloth, round the seat of who sits by half its length. If
   only the two rings next to the hip made up for that, they would be far apart, and the cloth between them would take a
   short cut through the seat. So cloth rides up there: it is spread evenly over the whole way between the first ring
   and the last, which stay where they are for that. Returns the s of the body at which cloth of s lies. */
static double ridden_up(const Envelope *env, double s, double x, double z) {
    double outside = soft_positive(x * env->outside[0] + z * env->outside[1], CORNER_CM * env->cm);
    double top = envelope_place(env, 0), end = envelope_place(env, env->fit->garment->nrings - 1);
    double longer = env->turn * outside, evenly = s + (env->last - end + longer) * (s - top) / (end - top);
    return before_step(TURNS_CM[0] * env->cm, TURNS_CM[1] * env->cm, longer, evenly);
}

double envelope_place(const Envelope *env, int ring) { return env->hip_height - env->fit->ring[ring].y; }

Vec3 envelope_point(const Envelope *env, double s, double x, double z) {
    const Bend *of = env->bend;
    s = ridden_up(env, s, x, z);
    double left = 0.5 + 0.5 * clamp(x, -1, 1), front = clamp(0.5 + 0.5 * z, 0, 1);
    Bend bend = {.hangs = front * lerp(of[1].hangs, of[0].hangs, left),
                 .gathers = lerp(of[1].gathers, of[0].gathers, left),
                 .lap = lerp(of[1].lap, of[0].lap, left)};
    Vec3 turning = turning_point(env, s, x, z);
    if (bend.hangs <= 0) return turning;
    /* The rings of a bent hip would cross in the groin. So in front the tube hangs straight from the pelvis to where
       the lap begins; behind it keeps the rings, which wrap the seat. */
    double top = envelope_place(env, 0), beyond = bend.lap + soft_positive(s - bend.lap, CORNER_CM * env->cm);
    double down = smoothstep(top, bend.lap, s), from = s < top ? s : lerp(s, top, bend.gathers);
    Vec3 linear = vec_lerp(pelvis_point(env, from, x, z), turning_point(env, beyond, x, z), down);
    return vec_lerp(turning, linear, bend.hangs);
}

/* By how much a thigh is bent forwards from the pelvis's down, 0 to pi; 0 for a thigh to the side or back. One that
   points up has come there forwards. */
static double flexion_of(const Envelope *env, Vec3 thigh) {
    double down = clamp(vec_dot(thigh, env->down), -1, 1), flexion = acos(down);
    double forwards = vec_dot(thigh, mat_column(env->pelvis, 2)) / fmax(sqrt(1 - down * down), 1e-6);
    return flexion * fmax(smoothstep(0, 0.5, forwards), smoothstep(SURELY_FORWARDS[0], SURELY_FORWARDS[1], flexion));
}

/* Where the lap begins, metres along the thigh: a thigh that is bent far is at the belly there, and leaves it farther
   down. */
static double lap_of(const Envelope *env, double flexion) {
    FitRing waist = rest_size(env, envelope_place(env, 0));
    double least = LAP_LEAST_CM * env->cm, most = LAP_MOST_CM * env->cm;
    if (flexion < 0.5 * PI) return least;
    double out = (waist.z + waist.front - leg_radius(env, 0) * cos(flexion)) / fmax(sin(flexion), 0.3);
    return clamp(out, least, most);
}

static Bend bend_of(const Envelope *env, Vec3 thigh, Vec3 mean) {
    double flexion = flexion_of(env, thigh), most = fmax(flexion, flexion_of(env, mean));
    return (Bend){.hangs = smoothstep(HANGS[0], HANGS[1], most),
                  .gathers = smoothstep(GATHERS[0], GATHERS[1], flexion),
                  .lap = lap_of(env, flexion)};
}

/* How far the tube turns at the hips, and which side of it is outside. mean: unit direction of the thighs. */
static void bend_outside(Envelope *env, Vec3 mean) {
    double down = clamp(vec_dot(mean, env->down), -1, 1);
    Vec3 inwards = vec_unit_or(vec_mad(mean, env->down, -down), mat_column(env->pelvis, 2));
    FitRing rest = rest_size(env, 0);
    env->turn = fmin(acos(down), TURN_LIMIT);
    env->outside[0] = -rest.side * vec_dot(mat_column(env->pelvis, 0), inwards);
    env->outside[1] = -mean_depth(&rest) * vec_dot(mat_column(env->pelvis, 2), inwards);
}

void envelope_pose(Envelope *env, const Fit *fit, const Figure *figure, const Body *body, const Pose *pose) {
    static const Role thigh[2] = {ROLE_LEFT_THIGH, ROLE_RIGHT_THIGH}, shin[2] = {ROLE_LEFT_SHIN, ROLE_RIGHT_SHIN};
    *env = (Envelope){.fit = fit, .body = body, .cm = fit->height / 170, .pelvis = pose->bone[ROLE_PELVIS].r};
    env->down = vec_scale(mat_column(env->pelvis, 1), -1);
    for (int leg = 0; leg < 2; leg++) {
        const Rigid *t = &pose->bone[thigh[leg]], *s = &pose->bone[shin[leg]];
        env->hip[leg] = rigid_apply(*t, figure->start[thigh[leg]]);
        env->knee[leg] = rigid_apply(*t, figure->end[thigh[leg]]);
        env->thigh[leg] = vec_unit_or(vec_sub(env->knee[leg], env->hip[leg]), env->down);
        Vec3 ankle = rigid_apply(*s, figure->end[shin[leg]]), knee = rigid_apply(*s, figure->start[shin[leg]]);
        Vec3 direction = vec_unit_or(vec_sub(ankle, knee), env->thigh[leg]);
        env->lower[leg] = vec_unit_or(vec_lerp(env->thigh[leg], direction, SHIN_SHARE), env->thigh[leg]);
        env->thigh_length[leg] = vec_dist(env->hip[leg], env->knee[leg]);
    }
    env->root = vec_mid(env->hip[0], env->hip[1]);
    env->rest_hip = 0.5 * vec_dist(figure->start[ROLE_LEFT_THIGH], figure->start[ROLE_RIGHT_THIGH]);
    env->hip_height = figure->start[ROLE_LEFT_THIGH].y;
    Vec3 mean = vec_unit_or(along_both(env, env->thigh), env->down);
    bend_outside(env, mean);
    env->last = climbed(env);
    for (int leg = 0; leg < 2; leg++) env->bend[leg] = bend_of(env, env->thigh[leg], mean);
}
