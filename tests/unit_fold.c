/* Folds: the plane that halves the bend of a joint, the flesh that ends there, and the cloth that stays on its side. */
#include "dress/crease.h"
#include "specimen.h"
#include "turns.h"

static Fold fold_of(const Scene *s, const Pose *pose, Role lower) {
    Folds folds = folds_find(&s->body, pose);
    for (int k = 0; k < FOLDS; k++)
        if (folds.fold[k].lower == lower) return folds.fold[k];
    return (Fold){.lower = ROLE_COUNT};
}

/* A knee that is bent more and more, in a leg that stands anyhow. */
static void planes_halve_the_bend(Scene *s) {
    double off = 0, before = 0;
    int backwards = 0;
    for (int knee = 0; knee <= 160; knee += 5) {
        Pose pose = figure_rest_pose();
        scene_leg(s, &pose, true, 40, knee);
        Fold f = fold_of(s, &pose, ROLE_LEFT_SHIN);
        Vec3 hip = rigid_apply(pose.bone[ROLE_LEFT_THIGH], s->figure.start[ROLE_LEFT_THIGH]);
        Vec3 ankle = rigid_apply(pose.bone[ROLE_LEFT_SHIN], s->figure.end[ROLE_LEFT_SHIN]);
        Vec3 up = vec_unit_or(vec_sub(hip, f.joint), f.across), down = vec_unit_or(vec_sub(ankle, f.joint), f.across);
        if (knee > 0) off = max_of(off, fabs(vec_dot(up, f.across) + vec_dot(down, f.across)));
        if (knee > 0) off = max_of(off, fabs(vec_dot(up, f.inwards) - vec_dot(down, f.inwards)));
        if (knee > 0) off = max_of(off, fabs(vec_dot(f.across, f.inwards)));
        backwards += f.closed < before || vec_dot(up, f.across) < 0;
        before = f.closed;
    }
    OK(off < 1e-9, "the plane of a fold halves the bend of the joint (%g)", off);
    OK(backwards == 0 && before == 1, "the more a knee is bent the more its fold is closed, up to 1");
    Pose rest = figure_rest_pose();
    Folds folds = folds_find(&s->body, &rest);
    int closed = 0;
    for (int k = 0; k < FOLDS; k++) closed += folds.fold[k].closed > 0;
    OK(closed == 0, "none is closed in the bind pose");
}

/* A thigh that comes up along the trunk, in the plane through the neck, and goes on past it. */
static void a_fold_does_not_turn_over(Scene *s) {
    double most = 0;
    Vec3 before = {0, 0, 0}, hip = s->figure.start[ROLE_LEFT_THIGH];
    Vec3 up = vec_unit_or(vec_sub(s->figure.end[ROLE_CHEST], hip), vec(0, 1, 0));
    for (int degrees = 50; degrees >= -20; degrees--) {
        Vec3 to = mat_apply(mat_axis_angle(vec(1, 0, 0), degrees * PI / 180), up);
        Mat3 turn = mat_between(vec_unit_or(vec_sub(s->figure.end[ROLE_LEFT_THIGH], hip), up), to);
        Pose pose = figure_rest_pose();
        scene_turn(s, &pose, ROLE_LEFT_THIGH, ROLE_LEFT_TOE, turn);
        Fold f = fold_of(s, &pose, ROLE_LEFT_THIGH);
        if (degrees < 50) most = max_of(most, angle(f.across, before));
        before = f.across;
    }
    OK(most < 10, "a degree of a hip that is bent flat turns its fold by no more than %.1f degrees", most);
}

/* Behind a knee that is bent wholly, thigh and calf end at the plane, except for the bone at the joint. */
static void flesh_ends_at_the_plane(Scene *s) {
    static const double DEEP = 2, GAP = 0.001; /* radii from the joint; metres */
    Pose pose = figure_rest_pose();
    scene_leg(s, &pose, true, 90, 145);
    body_frame_pose(&s->posed, &pose);
    Fold f = fold_of(s, &pose, ROLE_LEFT_SHIN);
    int beyond = 0, near = 0;
    for (int below = 0; below < 2; below++) {
        const BodyPart *part = &s->body.part[s->body.of_role[below ? ROLE_LEFT_SHIN : ROLE_LEFT_THIGH]];
        int other = s->body.of_role[below ? ROLE_LEFT_THIGH : ROLE_LEFT_SHIN];
        for (int v = part->first_vertex; v < part->first_vertex + part->nvertices; v++) {
            Vec3 x = s->posed.position[v], r = vec_sub(x, f.joint);
            BodyPoint at;
            body_point_move(&at, x);
            if (vec_dot(r, f.inwards) < DEEP * f.radius) continue;
            if (body_point_unpressed(&s->posed, other, &at, 1) > 0.5 * f.reach) continue;
            near++;
            beyond += vec_dot(r, f.across) * (below ? -1 : 1) < GAP;
        }
    }
    OK(near > 50 && beyond == 0, "flesh in a fold ends before its plane (%d of %d vertices do not)", beyond, near);
}

static void sides_are_told_by_the_bones(const Scene *s) {
    Pose pose = figure_rest_pose();
    scene_leg(s, &pose, true, 120, 120);
    Fold knee = fold_of(s, &pose, ROLE_LEFT_SHIN), hip = fold_of(s, &pose, ROLE_LEFT_THIGH);
    Binding thigh = {1, {ROLE_LEFT_THIGH}, {1}}, shin = {1, {ROLE_LEFT_SHIN}, {1}}, spine = {1, {ROLE_SPINE}, {1}};
    Binding both = {2, {ROLE_LEFT_THIGH, ROLE_LEFT_SHIN}, {0.5, 0.5}}, right = {1, {ROLE_RIGHT_SHIN}, {1}};
    OK(crease_side(&knee, &thigh) == CREASE_ABOVE && crease_side(&knee, &shin) == CREASE_BELOW &&
       crease_side(&knee, &both) == CREASE_BETWEEN, "at a knee the thigh's cloth is above, the shin's below");
    OK(crease_side(&knee, &spine) == CREASE_APART && crease_side(&knee, &right) == CREASE_APART &&
       crease_side(&hip, &right) == CREASE_APART, "trunk and other leg have nothing to do with it");
    OK(crease_side(&hip, &spine) == CREASE_ABOVE && crease_side(&hip, &shin) == CREASE_BELOW,
       "at a hip the trunk's cloth is above, the whole leg's below");
    OK(crease_side_of_both(CREASE_BETWEEN, CREASE_ABOVE) == CREASE_ABOVE &&
       crease_side_of_both(CREASE_BELOW, CREASE_BETWEEN) == CREASE_BELOW &&
       crease_side_of_both(CREASE_BELOW, CREASE_ABOVE) == CREASE_APART &&
       crease_side_of_both(CREASE_APART, CREASE_BETWEEN) == CREASE_APART, "between two points is what they agree on");
}

/* How far the middle line of a patch of thigh or shin lies beyond the plane of the knee, at the most, where the other
   bone's flesh would be; metres. */
static double beyond_knee(Specimen *c, const Pose *pose) {
    Scene *s = &c->scene;
    Fold f = fold_of(s, pose, ROLE_LEFT_SHIN);
    double most = 0;
    follow_pose(&c->follower, pose, c->root);
    for (int k = 0; k < c->fit.npatches; k++) {
        const FitPanel *panel = &c->fit.panel[c->fit.patch[k].panel];
        const int *curve = &panel->curve[c->fit.patch[k].row];
        const FitCurve *row = &c->fit.curve[curve[0]], *next = &c->fit.curve[curve[1]];
        CreaseSide side = crease_side_of_both(crease_side(&f, &c->fit.node[row->node[0]].binding),
                                              crease_side(&f, &c->fit.node[next->node[0]].binding));
        if (side != CREASE_ABOVE && side != CREASE_BELOW) continue;
        for (int w = 0; w <= 8; w++) {
            Vec3 x = bezier_point(&c->root[k], 0.5, w / 8.0, NULL, NULL), r = vec_sub(x, f.joint);
            double d = vec_dot(r, f.across) * (side == CREASE_ABOVE ? -1 : 1);
            BodyPoint at;
            body_point_move(&at, x);
            int other = s->body.of_role[side == CREASE_ABOVE ? ROLE_LEFT_SHIN : ROLE_LEFT_THIGH];
            if (vec_dot(r, f.inwards) > f.radius && body_point_unpressed(&s->posed, other, &at, 1) < 0)
                most = max_of(most, d);
        }
    }
    return most;
}

static void cloth_stays_on_its_side(void) {
    static Specimen c;
    specimen_open(&c, "trousers", 4, 1);
    double most = 0;
    for (int knee = 90; knee <= 155; knee += 5) {
        Pose pose = figure_rest_pose();
        scene_leg(&c.scene, &pose, true, 90, knee);
        body_frame_pose(&c.scene.posed, &pose);
        most = max_of(most, beyond_knee(&c, &pose));
    }
    OK(most < 0.012, "cloth of thigh and shin stays on its side of a bent knee (%.1f mm beyond)", 1000 * most);
    arena_free(&c.scene.arena);
}

/* Cloth that is on its side, or where there is no fold, stays where it is. */
static void nothing_else_moves(Scene *s) {
    Pose pose = figure_rest_pose();
    scene_leg(s, &pose, true, 90, 120);
    Fold f = fold_of(s, &pose, ROLE_LEFT_SHIN);
    int moved = 0, tried = 0;
    for (int k = 0; k < 2000; k++) {
        CreaseSide side = k % 2 ? CREASE_ABOVE : CREASE_BELOW;
        Vec3 curve[4], was[4];
        for (int i = 0; i < 4; i++) {
            double way = 0.01 + 0.2 * dice_unit(), inside = 0.4 * (dice_unit() - 0.5);
            was[i] = vec_mad(vec_mad(f.joint, f.across, k % 2 ? way : -way), f.inwards, inside);
            if (k % 4 > 1) was[i] = vec_mad(vec_mad(f.joint, f.across, k % 2 ? -way : way), f.inwards, -fabs(inside));
            curve[i] = was[i];
        }
        crease_keep(&s->body, &pose, &f, side, side, curve);
        for (int i = 0; i < 4; i++, tried++) moved += vec_dist(curve[i], was[i]) > 0;
    }
    OK(moved == 0, "cloth that is on its side, or out of the fold, stays where it is (%d of %d moved)", moved, tried);
}

int main(void) {
    Scene s;
    scene_open(&s, "trousers");
    planes_halve_the_bend(&s);
    a_fold_does_not_turn_over(&s);
    flesh_ends_at_the_plane(&s);
    sides_are_told_by_the_bones(&s);
    nothing_else_moves(&s);
    arena_free(&s.arena);
    cloth_stays_on_its_side();
    return tap_done();
}
