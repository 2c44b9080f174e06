/* A standing foot rolls: over the heel until it lies flat, then over the toe joint, in the end
   over the tip of the toes, about points of the ground that do not move. So nothing slides,
   whatever the rest of the body does. How far it is pitched at which moment, and the way of the
   swinging ankle, come from the published joint angles, by forward kinematics of one leg. */
#include "motion/gait_foot.h"

#include "motion/gait_curves.h"

/* How far the hip is behind the ankle at contact, in statures; from there it moves evenly. */
#define HIP_BEHIND 0.178

/* The heel comes down within this part of a stride. */
#define HEEL_DOWN 0.08

/* The heel counts as flat below the first angle, and rises softly from there. */
#define HEEL_FLAT 1.0
#define HEEL_SOFT 1.5

/* In swing the toes are held up. */
#define TOE_RAISED 18.0

/* Toes give way up to the first angle, and never bend more than the second. */
#define TOE_EASY 36.0
#define TOE_LIMIT 45.0

static double free_pitch(double cycle) {
    return gait_curve(GAIT_CURVE_HIP, cycle) - GAIT_PELVIC_TILT - gait_curve(GAIT_CURVE_KNEE, cycle) +
           gait_curve(GAIT_CURVE_ANKLE, cycle);
}

/* The same for a foot on the ground: down, flat for a while, and up again. */
static double strike_pitch(double cycle) {
    return cycle < HEEL_DOWN ? free_pitch(0) * pow(1 - fmax(cycle, 0) / HEEL_DOWN, 1.7) : 0;
}

static double lift_pitch(double cycle) {
    double rise = -free_pitch(fmin(cycle, GAIT_STANCE)) - HEEL_FLAT;
    return cycle > 0.1 && rise > 0 ? -rise * rise / (rise + HEEL_SOFT) : 0;
}

double gait_foot_strike(void) {
    return strike_pitch(0);
}

double gait_foot_lift(void) {
    return lift_pitch(GAIT_STANCE);
}

/* Toes bend with the rising heel as far as they can; the rest turns the foot over its tip. */
static double toe_bend(double pitch) {
    double x = -pitch - TOE_EASY;
    return x <= 0 ? fmax(0, -pitch) : TOE_EASY + x / (1 + x / (TOE_LIMIT - TOE_EASY));
}

/* The ankle's frame in that of the ground. */
static Rigid roll(const GaitBody *body, double pitch) {
    Mat3 r = gait_pitch(pitch);
    Vec3 ankle = vec(0, body->ankle, 0), heel = vec(0, 0, -body->heel);
    if (pitch > 0) return (Rigid){r, vec_add(heel, mat_apply(r, vec_sub(ankle, heel)))};
    Vec3 ball = vec(0, body->ball_height, body->ball), tip = vec(0, 0, body->toe);
    Vec3 joint = vec_add(tip, mat_apply(gait_pitch(pitch + toe_bend(pitch)), vec_sub(ball, tip)));
    return (Rigid){r, vec_add(joint, mat_apply(r, vec_sub(ankle, ball)))};
}

FootPose gait_foot_stand(const GaitBody *body, const Footfall *f, double t) {
    double since = (t - f->contact) / 2, until = GAIT_STANCE - (f->release - t) / 2;
    double pitch = strike_pitch(since) / gait_foot_strike() * f->strike;
    pitch += lift_pitch(until) / gait_foot_lift() * f->lift;
    return (FootPose){rigid_mul(f->ground, roll(body, pitch)), toe_bend(pitch)};
}

/* Natural walking of a walker of stature 1: ankle of the standing foot, in the ground's frame
   of this contact (cycle near 0) or of the next (near 1). */
static Vec3 natural_planted(const GaitBody *unit, double cycle) {
    if (cycle < 0.8) return roll(unit, lift_pitch(cycle)).t;
    return vec_add(roll(unit, strike_pitch(cycle - 1)).t, vec(0, 0, 2 * GAIT_STEP));
}

/* The same ankle as hip, knee and the hip's way say. */
static Vec3 natural_free(const GaitBody *unit, double cycle) {
    double hip = (gait_curve(GAIT_CURVE_HIP, cycle) - GAIT_PELVIC_TILT) * PI / 180;
    double shin = hip - gait_curve(GAIT_CURVE_KNEE, cycle) * PI / 180;
    double y = gait_hip_height(cycle) + unit->hip * sin(gait_pelvis_list(cycle) * PI / 180);
    y -= unit->thigh * cos(hip) + unit->shin * cos(shin);
    return vec(0, y, 2 * GAIT_STEP * cycle - HIP_BEHIND + unit->thigh * sin(hip) + unit->shin * sin(shin));
}

static Vec3 natural_error(const GaitBody *unit, double cycle) {
    return vec_sub(natural_planted(unit, cycle), natural_free(unit, cycle));
}

/* Cubic that starts with value and slope at t = 0 and has died away, with its slope, at 1. */
static Vec3 die_away(Vec3 value, Vec3 slope, double t) {
    if (t >= 1) return vec(0, 0, 0);
    Vec3 rest = vec_scale(value, 1 - t * t * (3 - 2 * t));
    return vec_mad(rest, slope, t * (1 - t) * (1 - t));
}

/* The swinging ankle of natural walking: as the angles say, eased for a while at the start and at the
   very end so that it leaves and meets the rolling foot with its place and speed. */
static Vec3 natural_swing(const GaitBody *unit, double x) {
    const double swing = 1 - GAIT_STANCE, first = 0.3, last = 0.3, tiny = 1e-4;
    Vec3 leave = natural_error(unit, GAIT_STANCE), meet = natural_error(unit, 1);
    Vec3 leaving = vec_scale(vec_sub(leave, natural_error(unit, GAIT_STANCE - tiny)), swing / tiny);
    Vec3 meeting = vec_scale(vec_sub(meet, natural_error(unit, 1 + tiny)), swing / tiny);
    Vec3 ankle = natural_free(unit, GAIT_STANCE + swing * x);
    ankle = vec_add(ankle, die_away(leave, vec_scale(leaving, first), x / first));
    return vec_add(ankle, die_away(meet, vec_scale(meeting, last), (1 - x) / last));
}

/* Natural swing taken apart: progress from place to place, and height over the straight line. */
static void swing_shape(double x, double *progress, double *height) {
    GaitBody unit = gait_body(1);
    Vec3 a = natural_swing(&unit, 0), b = natural_swing(&unit, 1), p = natural_swing(&unit, x);
    *progress = (p.z - a.z) / (b.z - a.z);
    *height = p.y - a.y - (b.y - a.y) * *progress;
}

/* As the angles say; on stairs simply back to level, upwards at once, lest the toes meet the next
   riser. */
static double swing_pitch(const Footfall *from, const Footfall *to, double x) {
    double pitch = free_pitch(GAIT_STANCE + (1 - GAIT_STANCE) * x);
    if (to->climb != 0) pitch = from->lift * smoothstep(to->climb > 0 ? 0.5 : 0.7, 0.1, x);
    else if (pitch < 0) pitch *= from->lift / free_pitch(GAIT_STANCE);
    else pitch *= fmax(to->strike, 0) / gait_foot_strike();
    return pitch + fmin(to->strike, 0) * smoothstep(0.6, 1, x);
}

/* Most where a natural foot passes closest to the ground, after 0.6 of the swing; on stairs all
   along the middle. */
double gait_foot_clearance(const Footfall *to, double x) {
    return to->climb == 0 ? 17.5 * x * x * x * (1 - x) * sqrt(1 - x) : smoothstep(0, 0.35, x) * smoothstep(1, 0.65, x);
}

/* Over level ground the ankle goes as the angles say, and leaves in the direction in which the
   foot points; up a stair it rises first, then goes forward; down a stair it goes forward first. */
static Vec3 swing_ankle(const GaitBody *body, const Footfall *from, const Footfall *to, Vec3 a, Vec3 b, double x) {
    double progress, height, soon, ignored, length = vec_dist(a, b), size = length / (2 * GAIT_STEP * body->height);
    swing_shape(x, &progress, &height);
    swing_shape(0.001, &soon, &ignored);
    Vec3 astray = vec_mad(vec_sub(a, b), mat_column(from->ground.r, 2), length);
    Vec3 ankle = vec_mad(vec_lerp(a, b, progress), astray, soon / 0.001 * x * (1 - x) * (1 - x) * (1 - x));
    ankle = vec_mad(ankle, to->detour, 16 * x * x * (1 - x) * (1 - x));
    if (to->climb > 0) {
        ankle = vec_lerp(a, b, smoothstep(0.25, 1, x));
        ankle.y = a.y + (b.y - a.y) * smoothstep(0, 0.55, x);
    } else if (to->climb < 0) {
        ankle = vec_lerp(a, b, smoothstep(0, 0.8, x));
        ankle.y = a.y + (b.y - a.y) * smoothstep(0.3, 1, x);
        height /= 2;
    }
    height = height * sqrt(size) * body->height + to->clearance * gait_foot_clearance(to, x);
    return vec_mad(ankle, mat_column(to->ground.r, 1), height);
}

FootPose gait_foot_swing(const GaitBody *body, const Footfall *from, const Footfall *to, double t) {
    double x = clamp((t - from->release) / (to->contact - from->release), 0, 1);
    Rigid a = rigid_mul(from->ground, roll(body, from->lift)), b = rigid_mul(to->ground, roll(body, to->strike));
    Vec3 ankle = swing_ankle(body, from, to, a.t, b.t, x);
    double pitch = swing_pitch(from, to, x);
    Mat3 ground = mat_nlerp(from->ground.r, to->ground.r, smoothstep(0.12, 0.95, x));
    double toe = toe_bend(pitch) * smoothstep(0.35, 0, x) + toe_bend(to->strike) * smoothstep(0.6, 1, x);
    toe += TOE_RAISED * smoothstep(0, 0.3, x) * smoothstep(1, 0.75, x);
    return (FootPose){{mat_mul(ground, gait_pitch(pitch)), ankle}, toe};
}

void gait_foot_sole(const GaitBody *body, const FootPose *foot, Vec3 *sole) {
    Vec3 ball = vec(0, body->ball_height - body->ankle, body->ball);
    Vec3 tip = vec(0, -body->ball_height, body->toe - body->ball);
    sole[0] = rigid_apply(foot->frame, vec(0, -body->ankle, -body->heel));
    sole[1] = rigid_apply(foot->frame, vec(0, -body->ankle, 0));
    sole[2] = rigid_apply(foot->frame, vec(0, -body->ankle, body->ball));
    sole[3] = rigid_apply(foot->frame, vec_add(ball, mat_apply(gait_pitch(foot->toe), tip)));
}
