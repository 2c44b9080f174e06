/* The local deformation: what it must reach on poses that are hard, and what time, rate and order
   must not change. */
#include <string.h>

#include "specimen.h"
#include "dress/push.h"

static int residual(const FrameStats *s) { return s->residual_edges + s->residual_cloth + s->inside; }

/* One knee up, a stride, a stool, a squat: nothing of a garment's own colliders shows. */
static void nothing_shows(const char *name) {
    static const double legs[][4] = {
        {30, 30, -20, 10}, {60, 70, 0, 5}, {90, 90, 0, 0}, {80, 80, 80, 80}, {110, 130, 110, 130}};
    Scene s;
    scene_open(&s, name);
    Dresser *d = scene_dresser(&s, (DressOptions){0});
    for (size_t k = 0; k < sizeof legs / sizeof *legs; k++) {
        Pose pose = figure_rest_pose();
        Mesh mesh;
        scene_leg(&s, &pose, true, legs[k][0], legs[k][1]);
        scene_leg(&s, &pose, false, legs[k][2], legs[k][3]);
        FrameStats stats = scene_frame(&s, d, &pose, 1 / 30.0, TIE_AFRESH, &mesh);
        OK(residual(&stats) == 0, "%s: nothing shows with hips at %.0f and %.0f degrees (%d left)", name, legs[k][0],
           legs[k][2], residual(&stats));
        double cap = s.figure.height / (s.garment->loose ? 7 : 16);
        OK(stats.displacement <= cap + 1e-9, "%s: moved %.3f m, no farther than the cap", name, stats.displacement);
    }
    arena_free(&s.arena);
}

/* Carried displacement fades: a leg that was up leaves nothing behind, at 30 and at 120 Hz. */
static void what_is_over_fades(double rate) {
    Scene s;
    scene_open(&s, "skirt");
    Dresser *d = scene_dresser(&s, (DressOptions){0});
    Pose up = figure_rest_pose(), rest = figure_rest_pose();
    Mesh mesh;
    scene_leg(&s, &up, true, 90, 100);
    FrameStats stats = scene_frame(&s, d, &up, 1 / rate, TIE_AFRESH, &mesh);
    OK(stats.displacement > 0.01, "%.0f Hz: a raised knee displaces the cloth by %.3f m", rate, stats.displacement);
    double before = 0;
    for (int k = 0; k < (int)(2 * rate); k++) {
        stats = scene_frame(&s, d, &rest, 1 / rate, TIE_GOES_ON, &mesh);
        if (k == (int)(0.1 * rate)) before = stats.displacement;
    }
    OK(before > 0.001, "%.0f Hz: a tenth of a second later the cloth still remembers (%.4f m)", rate, before);
    OK(stats.displacement == 0 && stats.active == 0, "%.0f Hz: two seconds later it does not", rate);
    arena_free(&s.arena);
}

/* A restart is as good as a new dresser, and two dressers agree to the bit. */
static void restart_forgets(void) {
    Scene s;
    scene_open(&s, "trousers");
    Dresser *used = scene_dresser(&s, (DressOptions){0}), *fresh = scene_dresser(&s, (DressOptions){0});
    Pose before = figure_rest_pose(), pose = figure_rest_pose();
    Mesh a, b;
    scene_leg(&s, &before, true, 100, 110);
    scene_leg(&s, &pose, false, 60, 60);
    scene_frame(&s, used, &before, 1 / 30.0, TIE_AFRESH, &a);
    scene_frame(&s, used, &pose, 1 / 30.0, TIE_AFRESH, &a);
    scene_frame(&s, fresh, &pose, 1 / 30.0, TIE_AFRESH, &b);
    bool same = a.nvertices == b.nvertices && a.ntriangles == b.ntriangles &&
                memcmp(a.position, b.position, (size_t)a.nvertices * sizeof *a.position) == 0 &&
                memcmp(a.triangle, b.triangle, (size_t)a.ntriangles * sizeof *a.triangle) == 0;
    OK(same, "after a restart nothing of the frames before is left");
    arena_free(&s.arena);
}

/* The world may stand anywhere: far away and turned round, the shape is the same. */
static void place_does_not_matter(void) {
    Scene s;
    scene_open(&s, "skirt");
    Dresser *here = scene_dresser(&s, (DressOptions){.fixed_topology = true, .detail = 4});
    Dresser *there = scene_dresser(&s, (DressOptions){.fixed_topology = true, .detail = 4});
    Rigid move = {mat_axis_angle(vec(0, 1, 0), 2.0), {8, 0.5, -6}};
    Pose pose = figure_rest_pose(), moved;
    scene_leg(&s, &pose, true, 70, 80);
    for (int r = 0; r < ROLE_COUNT; r++) moved.bone[r] = rigid_mul(move, pose.bone[r]);
    Mesh a, b;
    scene_frame(&s, here, &pose, 1 / 30.0, TIE_AFRESH, &a);
    FrameStats stats = scene_frame(&s, there, &moved, 1 / 30.0, TIE_AFRESH, &b);
    double worst = 0;
    for (int v = 0; v < a.nvertices; v++)
        worst = max_of(worst, vec_dist(rigid_apply(move, a.position[v]), b.position[v]));
    OK(residual(&stats) == 0, "nothing shows 10 m away either");
    NEAR(worst, 0, 1e-4, "a moved and turned world gives the moved and turned mesh");
    arena_free(&s.arena);
}

/* Whichever way patches are split, the same code reaches the same end; the same grid every frame
   under a fixed topology. */
static void every_split(void) {
    static const char *const name[] = {"adaptive", "uniform", "none"};
    for (int rule = 0; rule < 3; rule++)
        for (int fixed = 0; fixed < 2; fixed++) {
            Scene s;
            scene_open(&s, "skirt");
            Dresser *d =
                scene_dresser(&s, (DressOptions){.split = (SplitRule)rule, .fixed_topology = fixed, .detail = 6});
            Pose rest = figure_rest_pose(), pose = figure_rest_pose();
            Mesh first, second;
            scene_leg(&s, &pose, true, 50, 50);
            scene_frame(&s, d, &rest, 1 / 30.0, TIE_AFRESH, &first);
            int triangles = first.ntriangles;
            FrameStats stats = scene_frame(&s, d, &pose, 1 / 30.0, TIE_GOES_ON, &second);
            OK(residual(&stats) == 0, "--split %s%s: nothing shows", name[rule], fixed ? ", fixed topology" : "");
            if (fixed) OK(second.ntriangles == triangles, "--split %s: a fixed topology stays", name[rule]);
            arena_free(&s.arena);
        }
}

/* How far the pushed sample that is farthest from all it was pushed out of could go back; metres. */
static double most_needless(const Push *p, const BodyFrame *body) {
    double most = 0;
    for (int k = 0; k < p->nsamples; k++) {
        const PushSample *s = &p->sample[k];
        double room = INFINITY;
        for (int part = 0; s->near.parts >> part; part++)
            if (s->near.parts >> part & 1)
                room = min_of(room, body_frame_distance(body, part, s->near.seen, 1, NULL) - p->clearance[s->vertex]);
        most = max_of(most, min_of(room, vec_len(s->net)));
    }
    return most;
}

/* Cloth that was pushed touches what pushed it, though its neighbours were pushed after it and took it along. */
static void nothing_is_needless(const char *name) {
    Specimen c;
    static Push push;
    PushResult result = {0};
    specimen_open(&c, name, 5, 2);
    Scene *s = &c.scene;
    need(s, push_reserve(&push, &c.lattice, &s->arena, &s->error));
    escape_bind(&push.escape, c.root);
    Pose pose = figure_rest_pose();
    scene_leg(s, &pose, true, 100, 110);
    body_frame_pose(&s->posed, &pose);
    follow_pose(&c.follower, &pose, c.root);
    push.coarser = 1;
    push_start(&push, &s->posed, c.root, &c.leaves, &c.sheet);
    push_solve(&push, &result);
    push_measure(&push, &result);
    double needless = most_needless(&push, &s->posed);
    OK(result.displacement > 0.01 && needless < 0.001, "%s: moved %.1f mm, no more than %.1f mm of it needless", name,
       1e3 * result.displacement, 1e3 * needless);
    arena_free(&s->arena);
}

int main(void) {
    nothing_shows("skirt");
    nothing_shows("trousers");
    nothing_shows("tshirt");
    what_is_over_fades(30);
    what_is_over_fades(120);
    restart_forgets();
    place_does_not_matter();
    every_split();
    nothing_is_needless("skirt");
    nothing_is_needless("trousers");
    return tap_done();
}
