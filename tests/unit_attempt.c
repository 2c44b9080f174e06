/* What is left of an attempt: facets that are too flat to be written, and places that have no room for cloth. */
#include "worn.h"

#include <string.h>

#include "geometry/flat.h"

static const double FLAT = 5e-6; /* as in src/dress/attempt.c */

static bool same(const Residual *a, const Residual *b) {
    return a->edges == b->edges && a->cloth == b->cloth && a->inside == b->inside && a->deepest == b->deepest;
}

static int count_flat(const Cloth *c, double least) {
    static int aside[1 << 14];
    static Vec3 to[1 << 14];
    return flat_find(c->position, c->sheet.triangle, c->sheet.ntriangles, least, 0, aside, to, 1 << 14);
}

/* How deep a facet's middle is in the left thigh, metres. */
static double depth_of(const Worn *w, int triangle) {
    const int *v = w->cloth.sheet.triangle[triangle].v;
    const Vec3 *x = w->cloth.push.point;
    Vec3 middle = vec_scale(vec_add(vec_add(x[v[0]], x[v[1]]), x[v[2]]), 1.0 / 3);
    return -body_frame_distance(&w->of.scene.posed, w->of.scene.body.of_role[ROLE_LEFT_THIGH], middle, 0.1, NULL);
}

/* A thigh is raised through a skirt, and of the facet that is deepest in it and of every so many others one corner lies
   on the side across. */
static void flat_facets_are_raised(void) {
    enum { EVERY = 40 };
    static Worn w;
    static Vec3 flat[1 << 14];
    FrameStats stats = {0};
    worn_open(&w, "skirt", 5, 1);
    Cloth *c = &w.cloth;
    const BodyFrame *body = &w.of.scene.posed;
    Pose pose = figure_rest_pose();
    scene_leg(&w.of.scene, &pose, true, 70, 20);
    worn_pose(&w, &pose, 1);
    push_rest(&c->push);
    int deepest = 0;
    for (int k = 0; k < c->sheet.ntriangles; k++)
        if (depth_of(&w, k) > depth_of(&w, deepest)) deepest = k;
    for (int k = deepest % EVERY; k < c->sheet.ntriangles; k += EVERY) {
        const int *v = c->sheet.triangle[k].v;
        c->push.point[v[0]] = vec_mid(c->push.point[v[1]], c->push.point[v[2]]);
    }
    double least = FLAT * c->push.field.scale;
    Wrong before = attempt_test(c, body, &stats);
    int was_flat = count_flat(c, least), moved = 0;
    memcpy(flat, c->position, (size_t)c->sheet.nvertices * sizeof *flat);
    Wrong after = attempt_raise_flat(c, body, before, &stats);
    double farthest = 0;
    for (int v = 0; v < c->sheet.nvertices; v++) farthest = max_of(farthest, vec_dist(flat[v], c->position[v]));
    for (int v = 0; v < c->sheet.nvertices; v++) moved += vec_dist(flat[v], c->position[v]) > 0;
    int left = count_flat(c, least);
    OK(was_flat >= c->sheet.ntriangles / EVERY - 1 && left == 0 && !stats.capped, "of %d flat facets %d are left",
       was_flat, left);
    OK(moved <= 2 * was_flat && farthest < 0.0001, "%d vertices were moved, by %.3f mm at most", moved,
       1000 * farthest);
    Mesh mesh = sheet_mesh(&c->sheet, c->position);
    Wrong whole = tester_test(&c->tester, body, &mesh, NULL);
    OK(residual_total(&whole.own) > 0 && same(&after.own, &whole.own) && same(&after.other, &whole.other),
       "what shows then is told (%d)", residual_total(&whole.own));
    arena_free(&w.of.scene.arena);
}

/* Of a skirt that is drawn in to a line no facet has any height, and more than may be moved would have to be. */
static void too_many_are_told(void) {
    static Worn w;
    FrameStats stats = {0};
    worn_open(&w, "skirt", 8, 2);
    Cloth *c = &w.cloth;
    const BodyFrame *body = &w.of.scene.posed;
    Pose pose = figure_rest_pose();
    worn_pose(&w, &pose, 1);
    push_rest(&c->push);
    for (int v = 0; v < c->sheet.nvertices; v++) c->push.point[v] = vec(0, c->push.point[v].y, 0);
    (void)attempt_raise_flat(c, body, attempt_test(c, body, &stats), &stats);
    OK(count_flat(c, FLAT * c->push.field.scale) > 0 && stats.capped, "facets that stay flat are told as capped");
    arena_free(&w.of.scene.arena);
}

/* A leg swings into the other one. Where cloth between them shows them, that is for want of room. */
static void legs_leave_no_room(void) {
    enum { STEPS = 40 };
    Scene s;
    scene_open(&s, "trousers");
    Dresser *push = scene_dresser(&s, (DressOptions){.depth = 1});
    int shown = 0, told = 0, told_of_nothing = 0;
    for (int k = 0; k < STEPS; k++) {
        Pose pose = figure_rest_pose();
        Mesh mesh;
        scene_turn(&s, &pose, ROLE_LEFT_THIGH, ROLE_LEFT_TOE, mat_axis_angle(vec(0, 0, 1), -0.5 * k * PI / 180));
        FrameStats stats = scene_frame(&s, push, &pose, 0, TIE_AFRESH, &mesh);
        bool shows = stats.residual_edges + stats.residual_cloth + stats.inside > 0;
        shown += shows;
        told += shows && stats.pinched > 0;
        told_of_nothing += !shows && stats.pinched > 0;
    }
    OK(shown > 0 && shown < STEPS && told == shown, "legs show in %d of %d poses, %d of which say so", shown, STEPS,
       told);
    OK(told_of_nothing == 0, "and none in which they do not (%d)", told_of_nothing);
    arena_free(&s.arena);
}

int main(void) {
    flat_facets_are_raised();
    too_many_are_told();
    legs_leave_no_room();
    return tap_done();
}
