/* A shipped garment on the reference figure, for the unit programs of the dress floor. */
#ifndef TESTS_SCENE_H
#define TESTS_SCENE_H

#include <stdlib.h>

#include "dress/bodypose.h"
#include "dress/frame.h"
#include "tap.h"

typedef struct {
    Arena arena;
    Error error;
    Figure figure;
    Body body;
    Garment *garment;
    BodyFrame posed;
} Scene;

/* A test's own preparations must not fail. */
static inline void need(const Scene *s, bool good) {
    if (good) return;
    error_print(&s->error, stderr);
    exit(1);
}

/* size: of the figure, 1 is the reference; meshes are in as many metres. */
static inline void scene_open_sized(Scene *s, const char *garment, double size) {
    char path[128];
    snprintf(path, sizeof path, "garments/%s.garment", garment);
    *s = (Scene){.figure = figure_reference()};
    s->figure.height *= size;
    for (int r = 0; r < ROLE_COUNT; r++) {
        s->figure.start[r] = vec_scale(s->figure.start[r], size);
        s->figure.end[r] = vec_scale(s->figure.end[r], size);
    }
    s->garment = ARENA_NEW(&s->arena, Garment, 1, &s->error);
    need(s, s->garment && garment_read(path, &s->arena, s->garment, &s->error));
    need(s, body_fit(body_default(), &s->figure, 16, &s->arena, &s->body, &s->error));
    need(s, body_frame_init(&s->posed, &s->body, 1 / size, &s->arena, &s->error));
}

static inline void scene_open(Scene *s, const char *garment) { scene_open_sized(s, garment, 1); }

static inline Dresser *scene_dresser(Scene *s, DressOptions options) {
    Dresser *d = NULL;
    need(s, dresser_open(s->garment, &s->figure, &s->body, &options, &s->arena, &d, &s->error));
    return d;
}

/* Turns a bone, and those that hang on it up to `last`, about its start. */
static inline void scene_turn(const Scene *s, Pose *p, Role bone, Role last, Mat3 turn) {
    Vec3 pivot = rigid_apply(p->bone[bone], s->figure.start[bone]);
    Rigid about = {turn, vec_sub(pivot, mat_apply(turn, pivot))};
    for (int r = (int)bone; r <= (int)last; r++) p->bone[r] = rigid_mul(about, p->bone[r]);
}

/* The same by `degrees` to the front (forwards is positive). */
static inline void scene_bend(const Scene *s, Pose *p, Role bone, Role last, double degrees) {
    scene_turn(s, p, bone, last, mat_axis_angle(vec(-1, 0, 0), degrees * PI / 180));
}

/* A leg raised at the hip and bent at the knee, degrees. */
static inline void scene_leg(const Scene *s, Pose *p, bool left, double hip, double knee) {
    Role thigh = left ? ROLE_LEFT_THIGH : ROLE_RIGHT_THIGH;
    scene_bend(s, p, thigh, (Role)(thigh + 3), hip);
    scene_bend(s, p, (Role)(thigh + 1), (Role)(thigh + 3), -knee);
}

/* The left arm, turned from the bind pose about an axis through the shoulder. */
static inline Pose scene_arm_turned(const Scene *s, Vec3 axis, double degrees) {
    Pose pose = figure_rest_pose();
    scene_turn(s, &pose, ROLE_LEFT_UPPER_ARM, ROLE_LEFT_HAND, mat_axis_angle(axis, degrees * PI / 180));
    return pose;
}

/* The left arm, turned towards the trunk by `degrees`. */
static inline Pose scene_reaching(const Scene *s, double degrees) {
    return scene_arm_turned(s, vec(0, 0, -1), degrees);
}

/* Sits with the knees apart, and the left arm hangs down between them. */
static inline Pose scene_hand_in_lap(const Scene *s, double forwards) {
    enum { SEAT = 75, APART = 25, ACROSS = 60 };
    Pose pose = scene_reaching(s, ACROSS);
    scene_bend(s, &pose, ROLE_LEFT_UPPER_ARM, ROLE_LEFT_HAND, forwards);
    for (int left = 0; left < 2; left++) {
        Role thigh = left ? ROLE_LEFT_THIGH : ROLE_RIGHT_THIGH;
        Mat3 outwards = mat_axis_angle(vec(0, 1, 0), (left ? APART : -APART) * PI / 180);
        scene_leg(s, &pose, left, SEAT, SEAT);
        scene_turn(s, &pose, thigh, (Role)(thigh + 3), outwards);
    }
    return pose;
}

/* One frame in a pose. */
static inline FrameStats scene_frame(Scene *s, Dresser *d, const Pose *pose, double dt, Tie tie, Mesh *mesh) {
    FrameStats stats;
    body_frame_pose(&s->posed, pose);
    dresser_frame(d, &s->posed, dt, tie, mesh, &stats);
    return stats;
}

#endif
