/* A walk begins and ends with both feet side by side. In between left and right feet meet the
   ground in turn, once in a unit of time, on a track: straight ahead, up or down, or round a
   bend. The body's way is a cubic B-spline over the middles of successive feet, so it starts
   and ends smoothly and moves evenly where the steps are even. */
#include "motion/gait_plan.h"

#include <string.h>

/* Parts of the stature. */
#define STANDING_WIDTH 0.09
#define WALKING_WIDTH 0.06
#define TURN_RADIUS 0.42

#define TOE_OUT 5.0 /* degrees */
#define NEVER 1e9

/* A walker who is about to stop takes a shorter step. */
#define LAST_STEP 0.8

/* Room between toes or heel and a riser, and under a swinging foot. */
#define RISER_ROOM 0.009
#define GROUND_ROOM 0.003

/* Pitches on stairs: going up the foot lands flat, going down with the toes first. */
#define LIFT_UP (-32.0)
#define LIFT_DOWN (-45.0)
#define STRIKE_DOWN (-18.0)

static double ground_height(const GaitGround *g, double z) {
    double stairs = g->count > 0 ? clamp(floor((z - g->first) / g->run) + 1, 0, g->count) * g->rise : 0;
    return stairs + z * tan(g->slope * PI / 180);
}

/* Length of k steps over level ground; 0 = the standing walker. */
static double walked(const GaitPlan *plan, int k) {
    int steps = plan->gait.steps;
    return 100 * plan->gait.step_length * (k < steps ? k : steps - 1 + LAST_STEP);
}

/* Straight, half a circle to the left, straight back. */
static void follow_turn(const GaitPlan *plan, int k, GaitStep *step) {
    double radius = TURN_RADIUS * plan->body.height, s = walked(plan, k);
    double bend = (walked(plan, plan->gait.steps) - PI * radius) / 2, angle = clamp((s - bend) / radius, 0, PI);
    double before = fmin(s, bend), after = fmax(0, s - bend - PI * radius);
    step->heading = angle * 180 / PI;
    step->centre = vec(radius * (1 - cos(angle)), 0, before + radius * sin(angle) - after);
}

/* Ankle of the foot on tread j; 0 is the floor before the first riser. The foot stands in the
   middle of the tread; where it is longer, heel or toes hang over the edge, not the riser. */
static double tread(const GaitPlan *plan, int j) {
    const GaitBody *b = &plan->body;
    double from = plan->ground.first + (j - 1) * plan->ground.run, to = from + plan->ground.run;
    double middle = (from + to) / 2 - (b->toe - b->heel) / 2, room = RISER_ROOM * b->height;
    return plan->ground.rise > 0 ? fmin(middle, to - b->toe - room) : fmax(middle, from + b->heel + room);
}

/* How many level steps come before the foot that stands in front of the stairs. */
static int steps_before(const GaitPlan *plan) {
    return (plan->gait.steps - plan->gait.stair_count + 1) / 2;
}

static void follow_track(const GaitPlan *plan, int k, GaitStep *step) {
    double z = walked(plan, k) * cos(plan->ground.slope * PI / 180);
    int before = steps_before(plan), above = before + plan->ground.count;
    if (plan->ground.count > 0 && k > before) {
        z = tread(plan, k < above ? k - before : plan->ground.count);
        if (k > above) z += walked(plan, k) - walked(plan, above);
    }
    step->centre = vec(0, ground_height(&plan->ground, z), z);
    step->heading = 0;
}

/* Unit, to the left of who goes on from a step. */
static Vec3 left_of(const GaitStep *step) {
    return mat_column(mat_axis_angle(vec(0, 1, 0), step->heading * PI / 180), 0);
}

/* The place of the left or right foot beside the middle of a step; width: between the two, in statures. */
static Vec3 beside(const GaitPlan *plan, const GaitStep *step, int side, double width) {
    double out = side == GAIT_LEFT ? 1 : -1;
    return vec_mad(step->centre, left_of(step), out * width / 2 * plan->body.height);
}

static void place_foot(const GaitPlan *plan, int i, double width, GaitStep *step) {
    double out = step->foot.side == GAIT_LEFT ? 1 : -1;
    Mat3 foot = mat_axis_angle(vec(0, 1, 0), (step->heading + out * TOE_OUT) * PI / 180);
    step->foot.ground.r = mat_mul(gait_pitch(plan->ground.slope), foot);
    step->foot.ground.t = beside(plan, step, step->foot.side, width);
    step->foot.contact = i < 2 ? -NEVER : i - 1;
    step->foot.release = NEVER;
}

/* Pitches of the foot round the swing from one place to the next, in proportion to its length
   against a natural one. */
static void shape_swing(const GaitPlan *plan, GaitStep *from, GaitStep *to) {
    const GaitGround *ground = &plan->ground;
    double size = vec_dist(from->centre, to->centre) / (2 * GAIT_STEP * plan->body.height);
    from->foot.release = to->foot.contact - GAIT_SWING_TIME;
    from->foot.lift = gait_foot_lift() * fmin(size, 1.1);
    to->foot.strike = gait_foot_strike() * fmin(size, 1.3);
    if (ground->slope > 0) to->foot.strike = fmax(0, to->foot.strike - 0.6 * ground->slope);
    if (ground->count == 0) return;
    to->foot.climb = to->centre.y - from->centre.y;
    if (to->foot.climb == 0) return;
    to->foot.strike = ground->rise > 0 ? 0 : STRIKE_DOWN;
    from->foot.lift = ground->rise > 0 ? LIFT_UP : LIFT_DOWN;
}

/* Half way round a bend the swinging foot passes the standing one as far aside as if it stepped there. */
static void shape_bend(const GaitPlan *plan, const GaitStep *from, const GaitStep *past, GaitStep *to) {
    Vec3 left = left_of(past), passing = beside(plan, past, to->foot.side, WALKING_WIDTH);
    Vec3 middle = vec_mid(from->foot.ground.t, to->foot.ground.t);
    to->foot.detour = vec_scale(left, vec_dot(vec_sub(passing, middle), left));
}

/* Ground as a careful walker sees it: risers are a little thicker than they are. */
static double cautious_height(const GaitPlan *plan, double z) {
    double room = 0.5 * RISER_ROOM * plan->body.height;
    return fmax(ground_height(&plan->ground, z - room), ground_height(&plan->ground, z + room));
}

/* Lifts the swinging foot over what stands in its way. */
static void clear_ground(const GaitPlan *plan, const GaitStep *from, GaitStep *to) {
    const int samples = 64;
    double room = GROUND_ROOM * plan->body.height, lift = 0;
    for (int i = samples / 8; i <= samples - samples / 8; i++) {
        double x = (double)i / samples, weight = gait_foot_clearance(&to->foot, x);
        double t = from->foot.release + x * (to->foot.contact - from->foot.release);
        FootPose foot = gait_foot_swing(&plan->body, &from->foot, &to->foot, t);
        Vec3 sole[GAIT_SOLE];
        gait_foot_sole(&plan->body, &foot, sole);
        for (int j = 0; j < GAIT_SOLE; j++) {
            double missing = cautious_height(plan, sole[j].z) + room * weight - sole[j].y;
            if (missing > 0) lift = fmax(lift, missing / weight);
        }
    }
    to->foot.clearance = lift;
}

bool gait_plan(const Gait *g, Arena *arena, GaitPlan *out, Error *e) {
    *out = (GaitPlan){.gait = *g, .body = gait_body(100 * g->height), .nsteps = g->steps + 3};
    out->ground = (GaitGround){g->slope, 0, 100 * g->stair_rise, 100 * g->stair_run, g->stair_count};
    out->step = ARENA_NEW(arena, GaitStep, out->nsteps, e);
    if (!out->step) return false;
    /* The first riser stands so that the last level step ends right before it. */
    if (g->stair_count > 0) out->ground.first = walked(out, steps_before(out)) - tread(out, 0);
    bool turns = strcmp(g->preset, "turn") == 0;
    if (turns && walked(out, g->steps) < PI * TURN_RADIUS * out->body.height)
        return error_set(e, ERR_USAGE, "%d steps of %.3g m are too few to turn round", g->steps, g->step_length);
    for (int i = 0; i < out->nsteps; i++) {
        GaitStep *step = out->step + i;
        int k = i < 1 ? 0 : i > g->steps + 1 ? g->steps : i - 1;
        step->foot.side = i % 2;
        if (turns) follow_turn(out, k, step);
        else follow_track(out, k, step);
        place_foot(out, i, i < 2 || i > g->steps ? STANDING_WIDTH : WALKING_WIDTH, step);
        if (i >= 2) shape_swing(out, step - 2, step);
        if (i >= 2 && turns) shape_bend(out, step - 2, step - 1, step);
    }
    for (int i = 2; i < out->nsteps; i++) clear_ground(out, out->step + i - 2, out->step + i);
    out->start = -1;
    out->end = g->steps + 2;
    return true;
}

/* Middle of the feet that meet the ground at times k - 1 and k. */
static GaitStep between(const GaitPlan *plan, int k) {
    int last = plan->nsteps - 1, a = k < 0 ? 0 : k > last ? last : k, b = k + 1 < 0 ? 0 : k + 1 > last ? last : k + 1;
    const GaitStep *p = plan->step + a, *q = plan->step + b;
    return (GaitStep){.centre = vec_mid(p->centre, q->centre), .heading = (p->heading + q->heading) / 2};
}

/* Uniform cubic B-spline: weight of the control point `away` from t. */
static double spline_weight(double away) {
    double x = fabs(away);
    return x >= 2 ? 0 : x >= 1 ? (2 - x) * (2 - x) * (2 - x) / 6 : 2.0 / 3 - x * x + x * x * x / 2;
}

Vec3 gait_plan_centre(const GaitPlan *plan, double t) {
    Vec3 sum = {0, 0, 0};
    for (int k = (int)floor(t) - 1; k <= (int)floor(t) + 2; k++)
        sum = vec_mad(sum, between(plan, k).centre, spline_weight(t - k));
    return sum;
}

double gait_plan_heading(const GaitPlan *plan, double t) {
    double sum = 0;
    for (int k = (int)floor(t) - 1; k <= (int)floor(t) + 2; k++)
        sum += between(plan, k).heading * spline_weight(t - k);
    return sum;
}

FootPose gait_plan_foot(const GaitPlan *plan, int side, double t, double *swing) {
    int i = (int)floor(clamp(t, -1, plan->nsteps)) + 1;
    if (i >= plan->nsteps) i = plan->nsteps - 1;
    if (i % 2 != side) i += i > 0 ? -1 : 1;
    const GaitStep *now = plan->step + i;
    *swing = 0;
    if (t < now->foot.release || i + 2 >= plan->nsteps) return gait_foot_stand(&plan->body, &now->foot, t);
    *swing = clamp((t - now->foot.release) / (now[2].foot.contact - now->foot.release), 0, 1);
    return gait_foot_swing(&plan->body, &now->foot, &now[2].foot, t);
}
