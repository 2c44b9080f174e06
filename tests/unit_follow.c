/* The global shape of the shipped garments on the reference figure, in made poses. */
#include "specimen.h"

enum { DETAIL = 4, DEPTH = 2 };

/* The hem before a thigh that is raised by a right angle, bound half to it and half to the pelvis, lies as far before
   the one as before the other: along the line between them at root two times its distance. */
static void folds_are_mitres(void) {
    Scene s;
    Fit fit;
    Follower follower;
    static Patch root[GARMENT_PANELS_MAX];
    scene_open(&s, "tshirt");
    s.garment->ring[0].binding[STATION_FRONT] = (Binding){2, {ROLE_PELVIS, ROLE_LEFT_THIGH}, {0.5, 0.5}};
    need(&s, fit_garment(s.garment, &s.figure, &s.body, &s.arena, &fit, &s.error));
    need(&s, follow_reserve(&follower, &fit, &s.figure, &s.body, &s.arena, &s.error));
    Pose pose = figure_rest_pose();
    Vec3 joint = s.figure.start[ROLE_LEFT_THIGH], line = vec_scale(vec(0, 1, 1), sqrt(0.5));
    follow_pose(&follower, &pose, root);
    Vec3 turned = mat_apply(mat_axis_angle(vec(-1, 0, 0), PI / 4), vec_sub(root[0].p[3][0], joint));
    scene_leg(&s, &pose, true, 90, 0);
    follow_pose(&follower, &pose, root);
    Vec3 wanted = vec_mad(turned, line, (sqrt(2) - 1) * vec_dot(turned, line));
    double off = vec_dist(wanted, vec_sub(root[0].p[3][0], joint));
    OK(vec_dot(turned, line) > 0.1 && off < 1e-9, "in the fold of a hip cloth is where both sides meet (%g m off)",
       off);
    arena_free(&s.arena);
}

static double weight_of(const Binding *b, Role bone) {
    double weight = 0;
    for (int k = 0; k < b->n; k++) weight += b->bone[k] == bone ? b->weight[k] : 0;
    return weight;
}

/* A ring half-way up the pelvis that nothing binds goes with the thighs by three tenths, at a side with that side's. */
static void hips_go_with_thighs(void) {
    enum { HIP = 1 };
    Scene s;
    Fit fit;
    scene_open(&s, "trousers");
    for (int k = 0; k < STATION_COUNT; k++) s.garment->ring[HIP].binding[k].n = 0;
    need(&s, fit_garment(s.garment, &s.figure, &s.body, &s.arena, &fit, &s.error));
    const FitNode *hip = fit.node + HIP * STATION_COUNT, *waist = fit.node;
    double off = 0, of_waist = 0;
    for (int k = 0; k < STATION_COUNT; k++) {
        double left = k == STATION_LEFT ? 0.3 : k == STATION_RIGHT ? 0 : 0.15;
        off = max_of(off, fabs(weight_of(&hip[k].binding, ROLE_LEFT_THIGH) - left));
        off = max_of(off, fabs(weight_of(&hip[k].binding, ROLE_RIGHT_THIGH) - (0.3 - left)));
        off = max_of(off, fabs(weight_of(&hip[k].binding, ROLE_PELVIS) - 0.7));
        of_waist = max_of(of_waist, fabs(weight_of(&waist[k].binding, ROLE_PELVIS) - 1));
    }
    OK(off < 1e-12 && of_waist == 0, "hips that nothing binds go partly with the thighs, a waist does not (%g, %g off)",
       off, of_waist);
    arena_free(&s.arena);
}

/* Where all places of the lattice are in the pose that was followed last. In the scene's arena. */
static Vec3 *places_now(Specimen *c) {
    Vec3 *at = ARENA_NEW(&c->scene.arena, Vec3, c->lattice.nplaces, &c->scene.error);
    need(&c->scene, at != NULL);
    for (int place = 0; place < c->lattice.nplaces; place++) at[place] = lattice_point(&c->lattice, c->root, place);
    return at;
}

/* The most by which an edge of the sheet is longer in the global shape of a pose than in the bind pose. */
static double most_stretched(Specimen *c, const Pose *pose, Vec3 *rest) {
    double most = 0;
    follow_pose(&c->follower, pose, c->root);
    for (int k = 0; k < c->sheet.nedges; k++) {
        int a = c->sheet.place[c->sheet.edge[k].v[0]], b = c->sheet.place[c->sheet.edge[k].v[1]];
        double now = vec_dist(lattice_point(&c->lattice, c->root, a), lattice_point(&c->lattice, c->root, b));
        most = max_of(most, now / vec_dist(rest[a], rest[b]));
    }
    return most;
}

/* How deep the first rows of the global shape of a pose go through a part, at the most; metres. */
static double deepest_in(Specimen *c, const Pose *pose, Role part, int rows) {
    Scene *s = &c->scene;
    double deepest = 0;
    body_frame_pose(&s->posed, pose);
    follow_pose(&c->follower, pose, c->root);
    for (int place = 0; place < c->lattice.nplaces; place++) {
        if (c->fit.patch[c->lattice.owner[place].patch].row >= rows) continue;
        Vec3 at = lattice_point(&c->lattice, c->root, place);
        deepest = max_of(deepest, -body_frame_distance(&s->posed, s->body.of_role[part], at, 0, NULL));
    }
    return deepest;
}

/* The left arm from where it hangs until it points straight up. */
static void raised_arms_stretch_little(void) {
    Specimen c;
    specimen_open(&c, "tshirt", DETAIL, DEPTH);
    Scene *s = &c.scene;
    Vec3 *rest = places_now(&c);
    double most = 0;
    for (int degrees = -135; degrees <= 45; degrees += 15) {
        Pose pose = scene_reaching(s, degrees);
        most = max_of(most, most_stretched(&c, &pose, rest));
    }
    OK(most > 1.5 && most < 2.5, "below a raised arm cloth is spanned, to %.2f times its length", most);
    arena_free(&s->arena);
}

/* Hips bent until the thighs are at the belly, both alike or one less than the other. */
static void cloth_rides_up_round_the_seat(void) {
    Specimen c;
    specimen_open(&c, "skirt", DETAIL, DEPTH);
    Scene *s = &c.scene;
    Vec3 *rest = places_now(&c);
    double most = 0, deepest = 0;
    for (int left = 0; left <= 120; left += 15)
        for (int less = 0; less <= 30; less += 30) {
            Pose pose = figure_rest_pose();
            scene_leg(s, &pose, true, left, left);
            scene_leg(s, &pose, false, left - less, left);
            most = max_of(most, most_stretched(&c, &pose, rest));
            deepest = max_of(deepest, deepest_in(&c, &pose, ROLE_PELVIS, GARMENT_ROWS_MAX));
        }
    OK(most > 1.5 && most < 1.95, "round the seat of who sits a skirt is spread, to %.2f times its length", most);
    OK(deepest < 0.005, "and goes no deeper through it than %.0f mm before it is pushed", 1e3 * deepest);
    arena_free(&s->arena);
}

/* One leg stands, the other one is raised, forwards and outwards. */
static void trousers_ride_up_a_raised_thigh(void) {
    Specimen c;
    specimen_open(&c, "trousers", DETAIL, DEPTH);
    Scene *s = &c.scene;
    Vec3 *rest = places_now(&c);
    double most = 0;
    for (int degrees = 0; degrees <= 90; degrees += 10)
        for (int out = 0; out <= 60; out += 30) {
            Pose pose = figure_rest_pose();
            scene_leg(s, &pose, true, degrees, degrees);
            scene_turn(s, &pose, ROLE_LEFT_THIGH, ROLE_LEFT_TOE, mat_axis_angle(vec(0, 1, 0), out * PI / 180));
            most = max_of(most, most_stretched(&c, &pose, rest));
        }
    OK(most > 1.5 && most < 2.2, "between crotch and raised thigh trousers are stretched to %.2f times", most);
    arena_free(&s->arena);
}

/* A thigh that comes to the belly and beyond, the other one less. */
static void waists_stay_between_belly_and_thigh(void) {
    Specimen c;
    specimen_open(&c, "skirt", DETAIL, DEPTH);
    Scene *s = &c.scene;
    double deepest = 0;
    for (int left = 90; left <= 150; left += 15)
        for (int right = 0; right <= 90; right += 45) {
            Pose pose = figure_rest_pose();
            scene_leg(s, &pose, true, left, left);
            scene_leg(s, &pose, false, right, right);
            deepest = max_of(deepest, deepest_in(&c, &pose, ROLE_LEFT_THIGH, 1));
        }
    OK(deepest < 0.035, "between belly and thigh a skirt's waist goes %.0f mm through the thigh", 1e3 * deepest);
    arena_free(&s->arena);
}

/* The least distance from the left shoulder, in its bind pose's, of what is bound to chest and left upper arm. */
static double nearest_to_shoulder(Specimen *c, const Pose *pose) {
    const Follower *f = &c->follower;
    Vec3 joint = f->figure->start[ROLE_LEFT_UPPER_ARM], now = rigid_apply(pose->bone[ROLE_LEFT_UPPER_ARM], joint);
    double least = INFINITY;
    follow_pose(&c->follower, pose, c->root);
    for (int k = 0; k < 2 * f->fit->ncurves; k++) {
        const FitCurve *curve = &f->fit->curve[k / 2];
        const Binding *b = &f->fit->node[curve->node[k % 2]].binding;
        if (b->n != 2 || b->bone[0] != ROLE_CHEST || b->bone[1] != ROLE_LEFT_UPPER_ARM) continue;
        double then = vec_dist(curve->rest[3 * (k % 2)], joint);
        least = min_of(least, vec_dist(f->curve[k / 2][3 * (k % 2)], now) / then);
    }
    return least;
}

/* Below an arm that points away from the trunk there is room for cloth to be spanned, across the chest there is not. */
static void arms_across_the_chest_crush_nothing(void) {
    Specimen c;
    specimen_open(&c, "tshirt", DETAIL, DEPTH);
    Pose across = scene_arm_turned(&c.scene, vec(0, 1, 0), -110), raised = scene_reaching(&c.scene, -120);
    double kept = nearest_to_shoulder(&c, &across), spanned = nearest_to_shoulder(&c, &raised);
    OK(kept > 0.99, "cloth below an arm across the chest keeps its distance from the shoulder, %.3f of it", kept);
    OK(spanned < 0.8, "below a raised arm it comes nearer, to %.3f", spanned);
    arena_free(&c.scene.arena);
}

/* A long step, and legs apart to the sides as far. */
static void cloth_climbs_between_legs_that_are_far_apart(void) {
    Specimen c;
    specimen_open(&c, "skirt", DETAIL, DEPTH);
    Scene *s = &c.scene;
    Vec3 *rest = places_now(&c);
    double most = 0;
    for (int degrees = 0; degrees <= 60; degrees += 10) {
        Pose step = figure_rest_pose(), straddle = step;
        scene_leg(s, &step, true, degrees, 0);
        scene_leg(s, &step, false, -degrees, 0);
        Mat3 outwards = mat_axis_angle(vec(0, 0, 1), degrees * PI / 180);
        scene_turn(s, &straddle, ROLE_LEFT_THIGH, ROLE_LEFT_TOE, outwards);
        scene_turn(s, &straddle, ROLE_RIGHT_THIGH, ROLE_RIGHT_TOE, mat_transpose(outwards));
        most = max_of(most, max_of(most_stretched(&c, &step, rest), most_stretched(&c, &straddle, rest)));
    }
    OK(most > 1.5 && most < 2.5, "between legs that are far apart a skirt is spread, to %.2f times its length", most);
    arena_free(&s->arena);
}

/* A split, forwards and backwards, that goes on until the legs are beyond opposite. */
static void a_split_turns_no_skirt_over(void) {
    Specimen c;
    specimen_open(&c, "skirt", DETAIL, DEPTH);
    Scene *s = &c.scene;
    double most = 0, leg = 0;
    Vec3 *before = NULL, foot = {0, 0, 0};
    for (int degrees = 80; degrees <= 100; degrees++) {
        Pose pose = figure_rest_pose();
        scene_leg(s, &pose, true, degrees, 0);
        scene_leg(s, &pose, false, -degrees, 0);
        follow_pose(&c.follower, &pose, c.root);
        Vec3 *now = places_now(&c), at = rigid_apply(pose.bone[ROLE_LEFT_FOOT], s->figure.start[ROLE_LEFT_FOOT]);
        for (int place = 0; before && place < c.lattice.nplaces; place++)
            most = max_of(most, vec_dist(now[place], before[place]));
        if (before) leg = max_of(leg, vec_dist(at, foot));
        before = now;
        foot = at;
    }
    OK(most < leg, "in a split a degree moves a foot by %.0f mm and the skirt by no more than %.0f", 1e3 * leg,
       1e3 * most);
    arena_free(&s->arena);
}

/* The least cosine, over the rings, between the pelvis's left and the line from a ring's right side to its left one. */
static double least_to_the_left(Specimen *c, const Pose *pose) {
    const Fit *fit = &c->fit;
    double least = 1;
    follow_pose(&c->follower, pose, c->root);
    for (int k = 0; k < fit->ncurves; k++) {
        Vec3 across = vec_sub(c->follower.curve[k][0], c->follower.curve[k][3]); /* in front they begin on the left */
        if (fit->curve[k].unit[1][1] < 0) across = vec_scale(across, -1);
        least = min_of(least, vec_dot(mat_column(pose->bone[ROLE_PELVIS].r, 0), vec_unit_or(across, vec(0, 0, 0))));
    }
    return least;
}

/* One thigh comes to the belly and beyond; the other one is raised, and goes outwards. */
static void sides_of_a_skirt_stay_at_the_sides(void) {
    Specimen c;
    specimen_open(&c, "skirt", DETAIL, DEPTH);
    Scene *s = &c.scene;
    double least = 1;
    for (int left = 90; left <= 170; left += 10)
        for (int out = 0; out <= 60; out += 10) {
            Pose pose = figure_rest_pose();
            scene_leg(s, &pose, true, left, left);
            scene_leg(s, &pose, false, 110, 110);
            scene_turn(s, &pose, ROLE_RIGHT_THIGH, ROLE_RIGHT_TOE, mat_axis_angle(vec(0, -1, 0), out * PI / 180));
            least = min_of(least, least_to_the_left(&c, &pose));
        }
    OK(least > 0.6, "a skirt's sides stay left and right of who squats, within %.0f degrees", acos(least) * 180 / PI);
    arena_free(&s->arena);
}

int main(void) {
    folds_are_mitres();
    hips_go_with_thighs();
    raised_arms_stretch_little();
    cloth_rides_up_round_the_seat();
    waists_stay_between_belly_and_thigh();
    trousers_ride_up_a_raised_thigh();
    cloth_climbs_between_legs_that_are_far_apart();
    arms_across_the_chest_crush_nothing();
    a_split_turns_no_skirt_over();
    sides_of_a_skirt_stay_at_the_sides();
    return tap_done();
}
