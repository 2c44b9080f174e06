/* Arms that are turned outwards: enough, no more than enough, and nothing where it would not help. */
#include "figure/relax.h"

#include <stdlib.h>

#include "dress/padding.h"

#include "tap.h"

static Arena arena;

/* Everything that a search needs, for a body with cloth of an even thickness all over. */
typedef struct { Figure figure; Body body; Padding padding; double off; } Model;

static Model model(double size, double off) {
    Model m = {.figure = figure_reference(), .off = off * size};
    Error e = {0};
    m.figure.height *= size;
    for (int r = 0; r < ROLE_COUNT; r++) {
        m.figure.start[r] = vec_scale(m.figure.start[r], size);
        m.figure.end[r] = vec_scale(m.figure.end[r], size);
        for (int k = 0; k < PADDING_PLACES; k++) m.padding.side[r][k] = m.padding.front[r][k] = 0.5 * m.off;
    }
    if (!body_fit(body_default(), &m.figure, 16, &arena, &m.body, &e)) exit(1);
    return m;
}

/* Degrees: upper arm forwards and outwards of hanging, forearm forwards and inwards of the upper arm. */
typedef struct { double swing, out, bend, in; } ArmPose;

static Vec3 direction(double forward, double out, int arm) {
    double f = forward * PI / 180, o = out * PI / 180;
    return vec((arm == ARM_LEFT ? 1 : -1) * sin(o), -cos(o) * cos(f), cos(o) * sin(f));
}

static void point_bone(const Figure *f, Pose *pose, Role role, Vec3 start, Vec3 to) {
    Mat3 r = mat_between(vec_unit_or(vec_sub(f->end[role], f->start[role]), to), to);
    pose->bone[role] = (Rigid){r, vec_sub(start, mat_apply(r, f->start[role]))};
}

static Pose arms_at(const Figure *f, const ArmPose at[ARMS]) {
    Pose pose = figure_rest_pose();
    for (int arm = 0; arm < ARMS; arm++) {
        Role upper = arm == ARM_LEFT ? ROLE_LEFT_UPPER_ARM : ROLE_RIGHT_UPPER_ARM;
        point_bone(f, &pose, upper, f->start[upper], direction(at[arm].swing, at[arm].out, arm));
        Vec3 lower = direction(at[arm].swing + at[arm].bend, at[arm].out - at[arm].in, arm);
        for (Role r = upper + 1; r <= upper + 2; r++)
            point_bone(f, &pose, r, rigid_apply(pose.bone[r - 1], f->end[r - 1]), lower);
    }
    return pose;
}

static Pose both_at(const Figure *f, double swing, double out, double bend, double in) {
    ArmPose at[ARMS] = {{swing, out, bend, in}, {swing, out, bend, in}};
    return arms_at(f, at);
}

/* body_distance bounds the distance from below; walking to the foot of that bound and asking again there
   gives the distance of a point of the surface, so one from above. */
static double distance_to(const BodyPart *part, Vec3 p, double far) {
    Vec3 foot = p, normal;
    double first = body_distance(part, p, far, &normal), d = first;
    if (first >= far) return far;
    for (int i = 0; i < 20; i++) {
        foot = vec_mad(foot, normal, -d);
        d = body_distance(part, foot, far, &normal);
    }
    return first < 0 ? first : vec_dist(p, foot);
}

/* The least distance (metres) between the facets' corners of forearms and hands, and trunk and thighs. */
static double room_in(const Model *m, const Pose *pose) {
    static const Role trunk[] = {ROLE_PELVIS, ROLE_SPINE, ROLE_CHEST, ROLE_LEFT_THIGH, ROLE_RIGHT_THIGH};
    static const Role arm[] = {ROLE_LEFT_FOREARM, ROLE_LEFT_HAND, ROLE_RIGHT_FOREARM, ROLE_RIGHT_HAND};
    double least = 1;
    for (int a = 0; a < 4; a++) {
        const BodyPart *limb = &m->body.part[m->body.of_role[arm[a]]];
        for (int v = limb->first_vertex; v < limb->first_vertex + limb->nvertices; v++) {
            Vec3 p = rigid_apply(pose->bone[arm[a]], m->body.skin.position[v]);
            for (int t = 0; t < 5; t++) {
                const BodyPart *part = &m->body.part[m->body.of_role[trunk[t]]];
                Rigid g = rigid_mul(pose->bone[trunk[t]], part->frame);
                least = min_of(least, distance_to(part, rigid_unapply(g, p), 0.2));
            }
        }
    }
    return least;
}

static double largest(const ArmTurn turn[ARMS]) {
    double most = 0;
    for (int i = 0; i < ARMS * TURNS; i++) most = max_of(most, turn[i / TURNS].angle[i % TURNS]);
    return most;
}

/* The pose turned as it needs, but the largest angle by so many degrees less and the others in
   proportion. */
static Pose relaxed(const Model *m, const Pose *pose, double less) {
    ArmTurn turn[ARMS];
    Pose out = *pose;
    relax_find(&m->figure, &m->body, &m->padding, pose, turn);
    double share = 1 - less / fmax(largest(turn), 1e-9);
    for (int i = 0; i < ARMS * TURNS; i++) turn[i / TURNS].angle[i % TURNS] *= share;
    relax_apply(&m->figure, turn, &out);
    return out;
}

/* Arms that hang and swing beside the body, from far too near to free. */
static void test_enough(void) {
    Model m = model(1, 0.03);
    double worst = 1, least = 90, again = 0;
    int n = 0, turned = 0;
    for (double swing = -35; swing <= 35; swing += 7)
        for (double out = -6; out <= 14; out += 4)
            for (double bend = 0; bend <= 60; bend += 20) {
                Pose pose = both_at(&m.figure, swing, out, bend, 0);
                ArmTurn turn[ARMS], rest[ARMS];
                relax_find(&m.figure, &m.body, &m.padding, &pose, turn);
                Pose free = relaxed(&m, &pose, 0), near = relaxed(&m, &pose, 1);
                relax_find(&m.figure, &m.body, &m.padding, &free, rest);
                again = max_of(again, largest(rest));
                worst = min_of(worst, room_in(&m, &free));
                n++;
                if (largest(turn) < 1) continue;
                turned++;
                relax_find(&m.figure, &m.body, &m.padding, &near, rest);
                least = min_of(least, largest(rest));
            }
    OK(turned > n / 4 && worst > m.off - 0.004, "%d poses, %d with too little room: %.1f cm are left for cloth of %.1f",
       n, turned, 100 * worst, 100 * m.off);
    OK(again < 0.5, "who is turned needs no more (%.3f degrees)", again);
    OK(least > 0.3, "a degree less would not do: then at least %.2f more are needed", least);
}

static void test_nothing(void) {
    Model m = model(1, 0.03), bare = model(1, 0);
    ArmTurn turn[ARMS];
    Pose rest = figure_rest_pose(), hanging = both_at(&m.figure, 0, 0, 0, 0);
    relax_find(&m.figure, &m.body, &m.padding, &rest, turn);
    OK(largest(turn) == 0, "arms that are free stay");
    relax_find(&m.figure, &m.body, &bare.padding, &hanging, turn);
    OK(largest(turn) == 0, "nobody who is bare needs room");
    static const struct { ArmPose at; const char *what; } kept[] = {
        {{25, 10, 100, 75}, "folded arms"}, {{45, 8, 30, 25}, "hands in front of the belly"},
        {{80, 0, 30, 0}, "arms held out to the front"}, {{40, 25, 120, 60}, "hands on the chest"}};
    for (size_t i = 0; i < sizeof kept / sizeof kept[0]; i++) {
        ArmPose at[ARMS] = {kept[i].at, kept[i].at};
        Pose pose = arms_at(&m.figure, at);
        relax_find(&m.figure, &m.body, &m.padding, &pose, turn);
        OK(largest(turn) < 6, "%s stay nearly as they are (%.1f degrees)", kept[i].what, largest(turn));
    }
    Pose lap = both_at(&m.figure, 15, 8, 45, 35);
    for (int leg = 0; leg < 2; leg++)
        point_bone(&m.figure, &lap, leg ? ROLE_RIGHT_THIGH : ROLE_LEFT_THIGH,
                   m.figure.start[leg ? ROLE_RIGHT_THIGH : ROLE_LEFT_THIGH], vec(0, 0, 1));
    relax_find(&m.figure, &m.body, &m.padding, &lap, turn);
    OK(turn[0].angle[TURN_FORWARD] > 1 && turn[0].angle[TURN_FORWARD] > 2 * turn[0].angle[TURN_OUT],
       "hands in the lap go forwards (%.1f degrees, %.1f out)", turn[0].angle[TURN_FORWARD],
       turn[0].angle[TURN_OUT]);
    Pose same = hanging;
    ArmTurn none[ARMS] = {{{0, 0, 0}}, {{0, 0, 0}}};
    relax_apply(&m.figure, none, &same);
    OK(vec_dist(same.bone[ROLE_LEFT_HAND].t, hanging.bone[ROLE_LEFT_HAND].t) == 0, "a turn of 0 changes nothing");
}

/* Poses that change little need turns that change little: no step where a section comes near, or
   where the elbow takes over. */
static void test_continuous(void) {
    Model m = model(1, 0.04);
    double widest = 0, most = 0;
    ArmTurn before = {{0, 0, 0}};
    for (int path = 0; path < 6; path++)
        for (int k = 0; k <= 700; k++) {
            double swing = 0.1 * k - 35;
            Pose pose = both_at(&m.figure, swing, 10 - 3.0 * path, 15.0 * path + swing, 2.0 * path);
            ArmTurn turn[ARMS];
            relax_find(&m.figure, &m.body, &m.padding, &pose, turn);
            for (int i = 0; i < TURNS && k; i++) widest = max_of(widest, fabs(turn[0].angle[i] - before.angle[i]));
            before = turn[0];
            most = max_of(most, largest(turn));
        }
    OK(widest < 1.5 && most > 10, "a tenth of a degree of swing changes the turn by %.2f at most (of %.1f)", widest,
       most);
}

static double difference(const ArmTurn *a, const ArmTurn *b) {
    double most = 0;
    for (int i = 0; i < TURNS; i++) most = max_of(most, fabs(a->angle[i] - b->angle[i]));
    return most;
}

static void test_invariant(void) {
    Model m = model(1, 0.03), child = model(0.6, 0.03);
    ArmPose at[ARMS] = {{10, 0, 20, 3}, {-15, 2, 40, 5}}, other[ARMS] = {at[1], at[0]};
    Pose pose = arms_at(&m.figure, at), mirrored = arms_at(&m.figure, other), small = arms_at(&child.figure, at);
    Pose moved = pose;
    Rigid world = {mat_mul(mat_axis_angle(vec(0, 1, 0), 2), mat_axis_angle(vec(1, 0, 0), 1)), {30, -2, 7}};
    for (int r = 0; r < ROLE_COUNT; r++) moved.bone[r] = rigid_mul(world, pose.bone[r]);
    ArmTurn a[ARMS], b[ARMS], c[ARMS], d[ARMS];
    relax_find(&m.figure, &m.body, &m.padding, &pose, a);
    relax_find(&m.figure, &m.body, &m.padding, &moved, b);
    relax_find(&m.figure, &m.body, &m.padding, &mirrored, c);
    relax_find(&child.figure, &child.body, &child.padding, &small, d);
    OK(a[0].angle[TURN_OUT] > 1 && a[1].angle[TURN_OUT] > 1 &&
           difference(&a[0], &b[0]) + difference(&a[1], &b[1]) < 1e-6,
       "the same anywhere in the world");
    OK(difference(&a[0], &c[1]) + difference(&a[1], &c[0]) < 1e-6, "the same in a mirror");
    OK(difference(&a[0], &d[0]) + difference(&a[1], &d[1]) < 0.01, "the same for a child");
    m.padding.is_tube = true;
    relax_find(&m.figure, &m.body, &m.padding, &pose, b);
    relax_find(&m.figure, &m.body, &m.padding, &mirrored, c);
    OK(difference(&b[0], &c[1]) + difference(&b[1], &c[0]) < 1e-6, "in a mirror also with a skirt");
    relax_apply(&m.figure, a, &pose);
    relax_apply(&m.figure, a, &moved);
    Vec3 hand = m.figure.end[ROLE_LEFT_HAND];
    Vec3 there = rigid_apply(world, rigid_apply(pose.bone[ROLE_LEFT_HAND], hand));
    OK(vec_dist(there, rigid_apply(moved.bone[ROLE_LEFT_HAND], hand)) < 1e-9, "and so are the arms that were turned");
}

/* What is turned are arms, and they keep their length. */
static void test_apply(void) {
    Model m = model(1, 0.03);
    const Figure *f = &m.figure;
    Pose pose = both_at(f, 10, 0, 60, 0), out = pose;
    ArmTurn turn[ARMS] = {{{20, 5, 10}}, {{500, 0, 0}}};
    relax_apply(f, turn, &out);
    int changed = 0;
    for (int r = 0; r < ROLE_COUNT; r++)
        changed += vec_dist(rigid_apply(pose.bone[r], f->end[r]), rigid_apply(out.bone[r], f->end[r])) > 1e-12;
    OK(changed == 6, "both arms' three bones move, nothing else");
    double torn = 0;
    for (Role r = ROLE_LEFT_FOREARM; r <= ROLE_LEFT_HAND; r++)
        torn = max_of(torn, vec_dist(rigid_apply(out.bone[r], f->start[r]),
                                     rigid_apply(out.bone[r - 1], f->end[r - 1])));
    OK(torn < 1e-12, "they hang together");
    Vec3 right = vec_sub(rigid_apply(out.bone[ROLE_RIGHT_UPPER_ARM], f->end[ROLE_RIGHT_UPPER_ARM]),
                         rigid_apply(out.bone[ROLE_RIGHT_UPPER_ARM], f->start[ROLE_RIGHT_UPPER_ARM]));
    OK(right.x < 0 && fabs(right.y) + fabs(right.z) < 1e-9, "outwards ends where the arm points straight to the side");
}

/* How far real garments stand off. */
static void test_padding(void) {
    Model m = model(1, 0);
    Error e = {0};
    Garment *skirt = ARENA_NEW(&arena, Garment, 1, &e), *shirt = ARENA_NEW(&arena, Garment, 1, &e);
    Padding skirts = {.is_tube = false}, shirts = skirts;
    bool good = skirt && shirt && garment_read("garments/skirt.garment", &arena, skirt, &e) &&
                garment_read("garments/tshirt.garment", &arena, shirt, &e) &&
                padding_add(skirt, &m.figure, &m.body, &arena, &skirts, &e) &&
                padding_add(shirt, &m.figure, &m.body, &arena, &shirts, &e);
    OK(good && skirts.is_tube && !shirts.is_tube, "a skirt is a tube, a T-shirt is none");
    double uneven = 0, thigh = 0, lap = 0, belly = 0, sleeve = 0, bare = 0;
    for (int k = 0; k < PADDING_PLACES; k++) {
        for (int r = ROLE_LEFT_CLAVICLE; r <= ROLE_LEFT_HAND; r++)
            uneven = max_of(uneven, fabs(shirts.side[r][k] - shirts.side[r + ROLE_RIGHT_HAND - ROLE_LEFT_HAND][k]));
        for (int r = ROLE_LEFT_THIGH; r <= ROLE_LEFT_SHIN; r++) {
            int right = r + ROLE_RIGHT_THIGH - ROLE_LEFT_THIGH;
            uneven = max_of(uneven, fabs(skirts.side[r][k] - skirts.side[right][k]));
            uneven = max_of(uneven, fabs(skirts.front[r][k] - skirts.front[right][k]));
        }
        thigh = max_of(thigh, skirts.side[ROLE_LEFT_THIGH][k]);
        lap = max_of(lap, skirts.front[ROLE_LEFT_THIGH][k]);
        belly = max_of(belly, shirts.front[ROLE_CHEST][k]);
        sleeve = max_of(sleeve, shirts.side[ROLE_LEFT_UPPER_ARM][k]);
        bare = max_of(bare, skirts.side[ROLE_LEFT_HAND][k] + shirts.side[ROLE_LEFT_SHIN][k]);
    }
    OK(uneven < 1e-6, "left and right alike");
    OK(thigh > 0.05 && thigh < 0.2 && sleeve > 0.01 && sleeve <= 0.0301 && bare == 0,
       "a skirt stands %.1f cm off the thighs, a sleeve %.1f off the arm", 100 * thigh, 100 * sleeve);
    OK(lap > 0.02 && lap < 0.2 && belly > 0.01 && belly <= 0.0301,
       "in front a skirt stands %.1f cm off the thighs, a shirt %.1f off the chest", 100 * lap, 100 * belly);
}

int main(void) {
    test_padding();
    test_enough();
    test_nothing();
    test_continuous();
    test_invariant();
    test_apply();
    arena_free(&arena);
    return tap_done();
}
