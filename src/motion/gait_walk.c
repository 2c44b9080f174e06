/* From feet to a body: the hips ride over the feet as the published angles carry them, the
   legs reach for the feet by inverse kinematics, and the trunk and arms swing against the
   legs. Where a leg would be too short for that (long steps, stairs) the hips come down,
   gently: the largest want of a third of a step, smoothed over as much. */
#include "motion/gait_walk.h"

#include "motion/gait_curves.h"

/* Parts of the stature: hips before the middle of the feet, below their full height in quiet
   standing, and their wave from side to side. */
#define HIPS_AHEAD 0.0155
#define STANDING_DROP 0.0020
#define WAVE_ASIDE 0.0090

/* Pelvis and chest in degrees (Perry and Burnfield 2010: about 4 either way), arms after
   Murray 1967. */
#define PELVIS_TURN 4.0
#define CHEST_TURN 4.0
#define ARM_BEHIND 3.0
#define ARM_OUT 11.0

/* On a slope the hips stay somewhere between upright over the feet (0) and at right angles to
   the ground (1), so that neither leg has to do all the reaching. */
#define SLOPE_SHIFT 0.6

/* Of the steepness of the way. */
#define LEAN_UP 0.18
#define LEAN_DOWN 0.05

/* A leg is never straighter than this, in degrees. Knees that stretch fully and bend again
   jerk; only the published angles of natural walking go so far. */
#define STRAIGHT_KNEE 2.0
#define CAREFUL_KNEE 9.0
#define BENT_KNEE 155.0 /* nor more bent */

/* How far the hips may come down, in statures, and over which part of a step that is spread. */
#define LOWEST 0.2
#define SMOOTHING 0.34

/* On stairs the body rises, or sinks, mainly while one leg carries it: so many steps after
   the feet have, or before them. */
#define STAIR_LAG 0.15

typedef struct {
    double time;
    double vigour;  /* 0 standing, 1 walking */
    double cycle;   /* of the left leg, in strides */
} Moment;

static Moment moment_of(const GaitPlan *plan, int frame) {
    int per = plan->gait.frames_per_step;
    double t = plan->start + (double)(frame / per) + (double)(frame % per) / per;
    double vigour = smoothstep(0, 2, t) * (1 - smoothstep(plan->end - 3, plan->end - 1, t));
    return (Moment){t, vigour, (t - 1) / 2};
}

static double wave(double cycle) {
    return cos(2 * PI * cycle);
}

/* Leaning into the way: degrees, for the pelvis and the same again for the spine. */
static double lean(const GaitPlan *plan, double t) {
    Vec3 way = vec_sub(gait_plan_centre(plan, t + 0.5), gait_plan_centre(plan, t - 0.5));
    double level = sqrt(way.x * way.x + way.z * way.z);
    double steepness = atan2(way.y, fmax(level, 0.1 * plan->body.height)) * 180 / PI;
    return steepness > 0 ? LEAN_UP * steepness : LEAN_DOWN * steepness;
}

/* Sets place and turn of the hips, without the drop. */
static void pose_hips(const GaitPlan *plan, const Moment *m, GaitPose *pose) {
    double h = plan->body.height, size = 100 * plan->gait.step_length / (GAIT_STEP * h), lag = STAIR_LAG;
    if (plan->ground.rise < 0) lag = -lag;
    double heading = gait_plan_heading(plan, m->time), angle = heading * PI / 180;
    Vec3 centre = gait_plan_centre(plan, m->time);
    if (plan->ground.count > 0) centre.y = gait_plan_centre(plan, m->time - lag).y;
    double standing = plan->body.stand / h - STANDING_DROP;
    double rise = standing + m->vigour * size * size * (gait_hip_height(m->cycle) - standing);
    Vec3 ahead = vec(sin(angle), 0, cos(angle)), aside = vec(cos(angle), 0, -sin(angle));
    double aslant = SLOPE_SHIFT * m->vigour * plan->body.stand * sin(plan->gait.slope * PI / 180);
    centre = vec_mad(centre, ahead, HIPS_AHEAD * h - aslant);
    centre = vec_mad(centre, aside, m->vigour * WAVE_ASIDE * h * wave(m->cycle - 0.31));
    pose->hips = vec(centre.x, centre.y + rise * h, centre.z);
    double turn = -PELVIS_TURN * m->vigour * size * wave(m->cycle), list = m->vigour * gait_pelvis_list(m->cycle);
    pose->turn[GAIT_HIPS] = vec(lean(plan, m->time), heading + turn, list);
}

/* The trunk undoes what the pelvis does, the chest turns the other way, the head looks ahead. */
static void pose_trunk(const GaitPlan *plan, const Moment *m, GaitPose *pose) {
    Vec3 pelvis = pose->turn[GAIT_HIPS];
    double heading = gait_plan_heading(plan, m->time), chest = CHEST_TURN * m->vigour * wave(m->cycle);
    double twist = (chest - (pelvis.y - heading)) / 2;
    pose->turn[GAIT_SPINE] = vec(1.5 * m->vigour + pelvis.x, twist, -0.7 * pelvis.z);
    pose->turn[GAIT_CHEST] = vec(0, twist, -0.3 * pelvis.z);
    pose->turn[GAIT_NECK] = vec(0, -chest / 2, 0);
    pose->turn[GAIT_HEAD] = vec(-1.5 * m->vigour - 1.5 * pelvis.x, -chest / 2, 0);
}

static void pose_arms(const GaitPlan *plan, const Moment *m, GaitPose *pose) {
    double swing = plan->gait.arm_swing;
    for (int side = 0; side < GAIT_SIDES; side++) {
        double back = m->vigour * wave(m->cycle + side * 0.5); /* with the own leg ahead */
        double elbow = 12 + 8 * m->vigour - 0.45 * swing * back;
        gait_pose_arm(pose, side, -swing * back - ARM_BEHIND * m->vigour, ARM_OUT, elbow);
    }
}

static double straightest_knee(const GaitPlan *plan) {
    double size = 100 * plan->gait.step_length / (GAIT_STEP * plan->body.height);
    double other = fabs(plan->gait.slope) / 10 + (plan->ground.count > 0) + 2 * fmax(0, size - 1);
    return STRAIGHT_KNEE + (CAREFUL_KNEE - STRAIGHT_KNEE) * fmin(1, other);
}

/* How far the hips are too high for a foot; negative: not at all. False: too far away at any
   height. */
static bool excess(const GaitPlan *plan, const GaitPose *pose, int side, Vec3 ankle, double *out) {
    Vec3 hip = gait_pose_hip(&plan->body, pose, side), away = vec_sub(hip, ankle);
    double reach = gait_leg_length(&plan->body, straightest_knee(plan)), level = away.x * away.x + away.z * away.z;
    if (level >= reach * reach) return false;
    *out = away.y - sqrt(reach * reach - level);
    return true;
}

static bool too_far(Error *e) {
    return error_set(e, ERR_USAGE, "the legs are too short for such steps");
}

static bool measure_drop(const GaitPlan *plan, int frame, double *drop, Error *e) {
    Moment m = moment_of(plan, frame);
    GaitPose pose = {0};
    pose_hips(plan, &m, &pose);
    *drop = 0;
    for (int side = 0; side < GAIT_SIDES; side++) {
        double swing, more;
        Vec3 ankle = gait_plan_foot(plan, side, m.time, &swing).frame.t;
        if (!excess(plan, &pose, side, ankle, &more)) return too_far(e);
        *drop = fmax(*drop, more);
    }
    return *drop < LOWEST * plan->body.height || too_far(e);
}

/* The value at i of n, those at the ends going on. */
static double value_at(const double *in, int n, int i) { return in[i < 0 ? 0 : i >= n ? n - 1 : i]; }

/* out[i] = the largest of the neighbours in[i - radius..i + radius]. */
static void spread(const double *in, int n, int radius, double *out) {
    for (int i = 0; i < n; i++) {
        out[i] = 0;
        for (int d = -radius; d <= radius; d++) out[i] = fmax(out[i], value_at(in, n, i + d));
    }
}

/* out[i] = their mean, weighted. */
static void smooth(const double *in, int n, int radius, double *out) {
    for (int i = 0; i < n; i++) {
        double sum = 0, weights = 0;
        for (int d = -radius; d <= radius; d++) {
            double w = 1 + cos(PI * d / (radius + 1));
            sum += w * value_at(in, n, i + d);
            weights += w;
        }
        out[i] = sum / weights;
    }
}

bool gait_walk(const GaitPlan *plan, Arena *arena, GaitWalk *out, Error *e) {
    int per = plan->gait.frames_per_step, radius = (int)(SMOOTHING * per);
    *out = (GaitWalk){.plan = plan, .frames = (int)(plan->end - plan->start) * per + 1};
    out->drop = ARENA_NEW(arena, double, out->frames, e);
    double *wanted = ARENA_NEW(arena, double, out->frames, e);
    if (!out->drop || !wanted) return false;
    for (int i = 0; i < out->frames; i++)
        if (!measure_drop(plan, i, out->drop + i, e)) return false;
    spread(out->drop, out->frames, radius, wanted);
    smooth(wanted, out->frames, radius, out->drop);
    return true;
}

/* A swinging foot comes nearer to the hip, so that the knee bends by nearly so much more. */
static void lift_knee(const GaitBody *body, Vec3 hip, double degrees, Vec3 *ankle) {
    Vec3 leg = vec_sub(*ankle, hip);
    double length = vec_len(leg), knee = gait_leg_knee(body, length), room = fmax(1, BENT_KNEE - knee);
    *ankle = vec_mad(hip, leg, gait_leg_length(body, knee + room * (1 - exp(-degrees / room))) / length);
}

GaitPose gait_walk_pose(const GaitWalk *walk, int frame) {
    const GaitPlan *plan = walk->plan;
    Moment m = moment_of(plan, frame);
    GaitPose pose = {0};
    pose_hips(plan, &m, &pose);
    pose.hips.y -= walk->drop[frame];
    pose_trunk(plan, &m, &pose);
    pose_arms(plan, &m, &pose);
    double angle = gait_plan_heading(plan, m.time) * PI / 180;
    for (int side = 0; side < GAIT_SIDES; side++) {
        double swing;
        FootPose foot = gait_plan_foot(plan, side, m.time, &swing);
        double most = sin(PI * pow(swing, 0.6)), lift = plan->gait.knee_lift * most * most; /* early, as the knee is */
        if (lift > 0) lift_knee(&plan->body, gait_pose_hip(&plan->body, &pose, side), lift, &foot.frame.t);
        gait_pose_reach(&plan->body, &pose, side, foot.frame, vec(sin(angle), 0, cos(angle)));
        gait_pose_toe(&pose, side, foot.toe);
    }
    return pose;
}
