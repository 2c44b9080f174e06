/* What the attempts of a frame leave to each other: of one that is not kept, nothing. */
#include "dress/solve.h"

#include "worn.h"

/* A garment with a solver of its own, and its cloth for a single attempt. */
typedef struct {
    Worn worn;
    Solver solver;
} Dressed;

static void open(Dressed *d, const char *garment) {
    DressOptions options = {.split = SPLIT_NONE};
    Scene *s = &d->worn.of.scene;
    worn_open(&d->worn, garment, 5, 1);
    need(s, solver_reserve(&d->solver, &d->worn.of.fit, &d->worn.of.lattice, &options, &s->arena, &s->error));
    escape_bind(&d->solver.cloth.push.escape, d->worn.of.root);
}

static Wrong solve(Dressed *d, FrameStats *stats) {
    *stats = (FrameStats){.nodes = 0};
    leaves_copy(&d->worn.of.leaves, &d->solver.cloth.leaves);
    return solver_frame(&d->solver, &d->worn.of.scene.posed, d->worn.of.root, 1 / 30.0, TIE_AFRESH, false, stats);
}

/* The first attempt of the same frame, and how many vertices it leaves pinched. */
static Outcome attempt(Dressed *d, int *pinched) {
    FrameStats stats = {0};
    Cloth *c = &d->worn.cloth;
    Leaves fresh = d->worn.of.leaves;
    field_forget(&c->push.field);
    c->push.coarser = d->solver.cloth.push.coarser;
    morph_carry(&c->morph, 0, true, &c->leaves, &fresh);
    Outcome out = attempt_push(c, &d->worn.of.scene.posed, &stats);
    *pinched = attempt_pinched(c, &d->worn.of.scene.posed);
    return out;
}

/* An arm goes through a shirt and the trunk below it. After the first attempt both show, and no other one is better. */
static void rejected_attempts(void) {
    enum { POSES = 20 };
    static Dressed d;
    int kept = 0, wrong = 0;
    open(&d, "tshirt");
    for (int k = 0; k < POSES; k++) {
        FrameStats stats;
        Pose pose = scene_reaching(&d.worn.of.scene, 54);
        scene_bend(&d.worn.of.scene, &pose, ROLE_LEFT_UPPER_ARM, ROLE_LEFT_HAND, 2 * k - 20);
        worn_pose(&d.worn, &pose, 1);
        Wrong left = solve(&d, &stats);
        int pinched;
        Outcome first = attempt(&d, &pinched);
        bool is_first = residual_total(&left.own) == residual_total(&first.wrong.own) &&
                        stats.displacement == first.push.displacement;
        if (!is_first || residual_total(&left.own) == 0 || residual_total(&left.other) == 0) continue;
        kept++;
        wrong += stats.pinched != pinched;
    }
    OK(kept > 0 && wrong == 0, "in %d poses the first attempt is kept, with its pinched vertices (not in %d)", kept,
       wrong);
    arena_free(&d.worn.of.scene.arena);
}

/* Legs through each other leave no room on any way there. Then the frame is what it is without one. */
static void leads_in_vain(void) {
    static Dressed d;
    FrameStats stats;
    Mesh mesh;
    open(&d, "trousers");
    Scene *s = &d.worn.of.scene;
    Dresser *led = scene_dresser(s, (DressOptions){.split = SPLIT_UNIFORM, .detail = 5, .depth = 1});
    Pose pose = figure_rest_pose();
    scene_turn(s, &pose, ROLE_LEFT_THIGH, ROLE_LEFT_TOE, mat_axis_angle(vec(0, 0, -1), 18 * PI / 180));
    FrameStats tried = scene_frame(s, led, &pose, 0, TIE_AFRESH, &mesh);
    worn_pose(&d.worn, &pose, 1);
    Wrong left = solve(&d, &stats);
    bool same = mesh.nvertices == d.solver.cloth.sheet.nvertices && tried.inside == left.own.inside;
    for (int v = 0; same && v < mesh.nvertices; v++)
        same = vec_dist(mesh.position[v], d.solver.cloth.position[v]) == 0;
    OK(same && left.own.inside > 0 && tried.sweeps > 2 * stats.sweeps,
       "trousers of crossed legs that were led there in vain, in %d sweeps, are as without it, in %d", tried.sweeps,
       stats.sweeps);
    arena_free(&s->arena);
}

int main(void) {
    rejected_attempts();
    leads_in_vain();
    return tap_done();
}
