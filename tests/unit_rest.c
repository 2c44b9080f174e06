/* Which zero poses are believed: those of a body that stands straight, its arms anywhere from level to hanging. */
#include "figure/rest.h"

#include <string.h>

#include "tap.h"

/* Unit directions of the left side's bones, Y up, left +x; the right side mirrors them. */
typedef struct { Vec3 arm, forearm, thigh, shin, foot; } Stand;

static Stand tee(void) {
    Vec3 out = vec(1, 0, 0), down = vec(0, -1, 0);
    return (Stand){out, out, down, down, vec(0, -0.3, 0.95)};
}

/* Joints are numbered as roles; where each bone points is the next one. */
static Figure figure_of_roles(void) {
    Figure f = {0};
    for (int r = 0; r < ROLE_COUNT; r++) f.roles.joint[r] = r, f.toward[r] = -1;
    for (int side = 0; side < 2; side++) {
        int thigh = side ? ROLE_RIGHT_THIGH : ROLE_LEFT_THIGH, arm = side ? ROLE_RIGHT_UPPER_ARM : ROLE_LEFT_UPPER_ARM;
        for (int k = 0; k < 3; k++) f.toward[thigh + k] = thigh + k + 1;
        for (int k = 0; k < 2; k++) f.toward[arm + k] = arm + k + 1;
    }
    return f;
}

/* A body of half a metre from hips to shoulders, in axes that `turn` gives. */
static void place(const Stand *s, Mat3 turn, Rigid *joint) {
    for (int r = 0; r < ROLE_COUNT; r++) joint[r] = (Rigid){mat_identity(), vec(0, 0, 0)};
    for (int side = 1; side >= -1; side -= 2) {
        Rigid *thigh = &joint[side > 0 ? ROLE_LEFT_THIGH : ROLE_RIGHT_THIGH];
        Rigid *arm = &joint[side > 0 ? ROLE_LEFT_UPPER_ARM : ROLE_RIGHT_UPPER_ARM];
        thigh[0].t = vec(0.1, 0, 0);
        thigh[1].t = vec_mad(thigh[0].t, s->thigh, 0.42);
        thigh[2].t = vec_mad(thigh[1].t, s->shin, 0.42);
        thigh[3].t = vec_mad(thigh[2].t, s->foot, 0.15);
        arm[0].t = vec(0.18, 0.5, 0);
        arm[1].t = vec_mad(arm[0].t, s->arm, 0.28);
        arm[2].t = vec_mad(arm[1].t, s->forearm, 0.26);
        for (int k = 0; k < 4; k++) thigh[k].t.x *= side;
        for (int k = 0; k < 3; k++) arm[k].t.x *= side;
    }
    for (int r = 0; r < ROLE_COUNT; r++) joint[r].t = mat_apply(turn, joint[r].t);
}

static Rest found(const Figure *f, const Rigid *zero, const Rigid *first) {
    Sample sample = {.zero = zero, .first = first};
    return rest_find(&sample, f);
}

static bool is_called(const Stand *s, const char *name) {
    Rigid joint[ROLE_COUNT];
    Figure f = figure_of_roles();
    place(s, mat_identity(), joint);
    return strcmp(found(&f, joint, joint).name, name) == 0;
}

static void stands(void) {
    Stand s = tee();
    OK(is_called(&s, "T-pose offsets"), "level arms");
    s.arm = s.forearm = vec_unit_or(vec(1, -1, 0), s.arm);
    OK(is_called(&s, "A-pose offsets"), "arms half-way down");
    s.arm = s.forearm = vec_unit_or(vec(0.1, -1, 0), s.arm);
    OK(is_called(&s, "offsets with hanging arms"), "hanging arms");
    s.thigh = vec_unit_or(vec(0.5, -1, 0), s.thigh);
    OK(is_called(&s, "offsets with hanging arms"), "legs astride");
}

static void does_not_stand(void) {
    static const char *const name = "upright frames";
    Stand s = tee();
    s.foot = vec_unit_or(vec(0, 0.7, 0.7), s.foot);
    OK(is_called(&s, name), "feet that point up are a heap");
    s = tee();
    s.thigh = vec(0, 0, 1);
    OK(is_called(&s, name), "thighs to the front sit");
    s = tee();
    s.shin = vec(0, 0, -1);
    OK(is_called(&s, name), "shins to the back kneel");
    s = tee();
    s.arm = s.forearm = vec_unit_or(vec(1, 1.5, 0), s.arm);
    OK(is_called(&s, name), "raised arms");
    s = tee();
    s.forearm = vec(-1, 0, 0);
    OK(is_called(&s, name), "forearms that go back to the other side");
}

/* The line of a foot may only go down to the ground. */
static void shows_soles(void) {
    Rigid joint[ROLE_COUNT];
    Figure f = figure_of_roles();
    Stand s = tee();
    place(&s, mat_identity(), joint);
    OK(found(&f, joint, joint).soles, "feet across the shins show the soles");
    s.foot = s.shin;
    place(&s, mat_identity(), joint);
    Rest rest = found(&f, joint, joint);
    OK(rest.human && !rest.soles, "who stands with feet along the shins stands, but shows no soles");
}

static void is_even(void) {
    Rigid joint[ROLE_COUNT];
    Figure f = figure_of_roles();
    Stand s = tee();
    place(&s, mat_identity(), joint);
    for (int k = 1; k < 3; k++) joint[ROLE_RIGHT_UPPER_ARM + k].t.x = 0.18 + 0.3 * k;
    OK(!found(&f, joint, joint).human, "both arms to one side are a heap");
    place(&s, mat_identity(), joint);
    for (int k = 1; k < 4; k++) joint[ROLE_LEFT_THIGH + k].t.z += 0.15 * k;
    OK(!found(&f, joint, joint).human, "legs that stride are a frame of the motion");
    place(&s, mat_identity(), joint);
    for (int k = 0; k < 3; k++) {
        joint[ROLE_LEFT_UPPER_ARM + k].t.x *= -1;
        joint[ROLE_RIGHT_UPPER_ARM + k].t.x *= -1;
    }
    OK(!found(&f, joint, joint).human, "so are shoulders against the hips");
}

static void knows_its_axes(void) {
    Rigid joint[ROLE_COUNT];
    Figure f = figure_of_roles();
    Stand s = tee();
    int wrong = 0, tried = 0;
    for (int axis = 0; axis < 3; axis++)
        for (int quarter = 0; quarter < 4; quarter++, tried++) {
            Vec3 about = vec(axis == 0, axis == 1, axis == 2);
            Mat3 turn = mat_axis_angle(about, quarter * PI / 2 + 0.05); /* a little askew: rigs are not exact */
            place(&s, turn, joint);
            Rest rest = found(&f, joint, joint);
            Mat3 even = mat_axis_angle(about, quarter * PI / 2);
            for (int k = 0; k < 3; k++) wrong += vec_dist(mat_column(rest.frame, k), mat_column(even, k)) > 1e-12;
            wrong += !rest.human;
        }
    OK(wrong == 0, "left, up and forward are the nearest axes of the file (%d ways to lie in it)", tried);
}

/* A heap in the offsets, and a first frame that says more. */
static void first_frame(void) {
    Rigid heap[ROLE_COUNT], joint[ROLE_COUNT];
    Figure f = figure_of_roles();
    Stand s = tee(), up = tee();
    up.thigh = up.shin = up.foot = vec(0, 1, 0);
    place(&up, mat_identity(), heap);
    place(&s, mat_identity(), joint);
    OK(strcmp(found(&f, heap, joint).name, "T-pose in frame 1") == 0, "a T-pose in front counts");
    s.thigh = vec_unit_or(vec(0, -1, 0.6), s.thigh);
    place(&s, mat_identity(), joint);
    OK(!found(&f, heap, joint).human, "not where the knees are bent");
    s = tee();
    s.arm = s.forearm = vec_unit_or(vec(0.2, -1, 0), s.arm);
    place(&s, mat_identity(), joint);
    OK(!found(&f, heap, joint).human, "nor where arms hang: so a motion may begin");
}

int main(void) {
    stands();
    does_not_stand();
    shows_soles();
    is_even();
    knows_its_axes();
    first_frame();
    Vec3 askew = vec(0, 0.8, 0.6);
    OK(rest_snap(askew, 0.7).y == 1 && rest_snap(askew, 0.9).y == 0.8, "an axis is taken that is near enough");
    return tap_done();
}
