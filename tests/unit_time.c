/* What happens between frames: a garment is as still as what it hangs on, has the same shape at any
   frame rate, begins and ends contact gently, and forgets a frame that did not belong to the motion.
   The topology is fixed, which keeps the points the same. */
#include <string.h>

#include "scene.h"

enum { FIXED_DETAIL = 6 };

/* Lifts the left leg to `degrees`, the knee bent a little more. */
static Pose lifted(const Scene *s, double degrees) {
    Pose pose = figure_rest_pose();
    scene_leg(s, &pose, true, degrees, 1.1 * degrees);
    return pose;
}

static Dresser *open_dresser(Scene *s, Method method) {
    return scene_dresser(s, (DressOptions){.method = method, .fixed_topology = true, .detail = FIXED_DETAIL});
}

static int compare_doubles(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Positions of the last three frames, and the second differences in all of them. */
typedef struct {
    int n, seen;
    Vec3 *at[3];
    double *change, largest;
    int nchanges;
} Trace;

static void trace_open(Trace *t, Scene *s, int nvertices, int nframes) {
    *t = (Trace){.n = nvertices};
    for (int k = 0; k < 3; k++) t->at[k] = ARENA_NEW(&s->arena, Vec3, nvertices, &s->error);
    t->change = ARENA_NEW(&s->arena, double, nvertices * nframes, &s->error);
    need(s, t->at[2] && t->change);
}

static void trace_add(Trace *t, const Mesh *mesh) {
    Vec3 *oldest = t->at[0];
    t->at[0] = t->at[1];
    t->at[1] = t->at[2];
    t->at[2] = memcpy(oldest, mesh->position, (size_t)t->n * sizeof *oldest);
    if (++t->seen < 3) return;
    for (int v = 0; v < t->n; v++) {
        Vec3 mean = vec_scale(vec_add(t->at[0][v], t->at[2][v]), 0.5);
        double change = 2 * vec_dist(mean, t->at[1][v]);
        t->change[t->nchanges++] = change;
        t->largest = fmax(t->largest, change);
    }
}

/* The second difference that 99 in 100 do not exceed, millimetres. */
static double trace_most(Trace *t) {
    qsort(t->change, (size_t)t->nchanges, sizeof *t->change, compare_doubles);
    return 1000 * t->change[(int)(0.99 * (t->nchanges - 1))];
}

/* A leg that is held up, trembling by a tenth of a degree: neither clearances that are made up for only
   once enough is missing, nor displacement that fades and is pushed out again, may be seen. */
static void held_is_still(const char *name) {
    enum { FRAMES = 90, SETTLED = 30 };
    Scene s;
    scene_open(&s, name);
    Dresser *dresser[2] = {open_dresser(&s, METHOD_PUSH), open_dresser(&s, METHOD_GLOBAL)};
    double most[2];
    for (int k = 0; k < 2; k++) {
        Trace trace = {0};
        for (int f = 0; f < FRAMES; f++) {
            Pose pose = lifted(&s, 50 + 0.1 * sin(f * 0.3));
            Mesh mesh;
            scene_frame(&s, dresser[k], &pose, 1 / 120.0, f == 0, &mesh);
            if (f == 0) trace_open(&trace, &s, mesh.nvertices, FRAMES);
            if (f >= SETTLED) trace_add(&trace, &mesh);
        }
        most[k] = trace_most(&trace);
    }
    OK(most[0] < 0.1, "%s: on a leg that is held up cloth is still (%.3f mm a frame^2, without contact %.3f)", name,
       most[0], most[1]);
    arena_free(&s.arena);
}

/* Up and down within a second and a half. */
static double swing(double t) { return t > 1.5 ? 0 : 40 * (1 - cos(t / 1.5 * 2 * PI)); }

/* The shape at each tenth of the motion's two seconds, at some frame rate. */
enum { INSTANTS = 20 };
static void dress_at(Scene *s, double rate, Vec3 *shape[INSTANTS], int *nvertices) {
    Dresser *d = open_dresser(s, METHOD_PUSH);
    int every = (int)(rate / 10 + 0.5);
    for (int f = 0; f < INSTANTS * every; f++) {
        Pose pose = lifted(s, swing(f / rate));
        Mesh mesh;
        scene_frame(s, d, &pose, 1 / rate, f == 0, &mesh);
        if (f % every) continue;
        *nvertices = mesh.nvertices;
        shape[f / every] = ARENA_NEW(&s->arena, Vec3, mesh.nvertices, &s->error);
        need(s, shape[f / every] != NULL);
        memcpy(shape[f / every], mesh.position, (size_t)mesh.nvertices * sizeof(Vec3));
    }
}

static void rate_does_not_matter(const char *name) {
    static const double rate[] = {60, 30};
    Scene s;
    scene_open(&s, name);
    Vec3 *best[INSTANTS], *other[INSTANTS];
    int n;
    dress_at(&s, 120, best, &n);
    for (int r = 0; r < 2; r++) {
        double worst = 0, sum = 0;
        dress_at(&s, rate[r], other, &n);
        for (int k = 0; k < INSTANTS; k++)
            for (int v = 0; v < n; v++) {
                double off = vec_dist(best[k][v], other[k][v]);
                worst = fmax(worst, off);
                sum += off / (n * INSTANTS);
            }
        OK(sum < 0.0005 && worst < 0.01, "%s: at %.0f frames a second the same shape as at 120 (%.2f mm, at most %.1f)",
           name, rate[r], 1000 * sum, 1000 * worst);
    }
    arena_free(&s.arena);
}

/* The left arm, turned towards the trunk by `degrees`. */
static Pose reaching(const Scene *s, double degrees) {
    Pose pose = figure_rest_pose();
    Mat3 turn = mat_axis_angle(vec(0, 0, 1), -degrees * PI / 180);
    Vec3 pivot = s->figure.start[ROLE_LEFT_UPPER_ARM];
    Rigid about = {turn, vec_sub(pivot, mat_apply(turn, pivot))};
    for (int r = ROLE_LEFT_UPPER_ARM; r <= ROLE_LEFT_HAND; r++) pose.bone[r] = rigid_mul(about, pose.bone[r]);
    return pose;
}

/* An arm that comes to lie against the shirt and leaves it again, at 22 degrees a second: its elbow goes 1 mm a
   frame, and so does no vertex go much farther where contact begins or ends. Patches are not split, so that
   facets are wide: most of them touch before their corners do. */
static void contact_is_gentle(void) {
    enum { FRAMES = 240 };
    Scene s;
    scene_open(&s, "tshirt");
    Dresser *d = scene_dresser(&s, (DressOptions){.split = SPLIT_NONE});
    Trace trace = {0};
    int touched = 0;
    for (int f = 0; f < FRAMES; f++) {
        Pose pose = reaching(&s, 20 + 22 * (1 - fabs(2.0 * f / FRAMES - 1)));
        Mesh mesh;
        FrameStats stats = scene_frame(&s, d, &pose, 1 / 120.0, f == 0, &mesh);
        if (f == 0) trace_open(&trace, &s, mesh.nvertices, FRAMES);
        trace_add(&trace, &mesh);
        touched += stats.displacement > 0.0055;
    }
    OK(touched > 20, "in %d frames the arm presses on the shirt", touched);
    OK(trace.largest < 0.007, "none of its vertices jumps (%.2f mm a frame^2)", 1000 * trace.largest);
    arena_free(&s.arena);
}

/* A frame in another pose, in front of and behind which the take has seen a jump. Cloth in contact has a
   memory, so what comes after may differ, but not by more than that. */
static void teleport_is_forgotten(void) {
    enum { JUMP = 40, FRAMES = 100 };
    Scene s;
    scene_open(&s, "trousers");
    Dresser *plain = open_dresser(&s, METHOD_PUSH), *jumps = open_dresser(&s, METHOD_PUSH);
    double before = 0, at_once = 0, later = 0;
    for (int f = 0; f < FRAMES; f++) {
        Pose pose = lifted(&s, 60 + 0.3 * f), astray = lifted(&s, 95);
        Mesh a, b;
        scene_frame(&s, plain, &pose, 1 / 60.0, f == 0, &a);
        scene_frame(&s, jumps, f == JUMP ? &astray : &pose, 1 / 60.0, f == 0 || f == JUMP || f == JUMP + 1, &b);
        double *off = f < JUMP ? &before : f < JUMP + 30 ? &at_once : &later;
        for (int v = 0; v < a.nvertices && f != JUMP; v++) *off = fmax(*off, vec_dist(a.position[v], b.position[v]));
    }
    OK(before == 0, "a teleport changes nothing of the frames before it");
    OK(at_once < 0.02 && later < 0.012, "after it the shape is about as without (%.1f mm off, then %.1f)",
       1000 * at_once, 1000 * later);
    arena_free(&s.arena);
}

int main(void) {
    contact_is_gentle();
    teleport_is_forgotten();
    rate_does_not_matter("skirt");
    rate_does_not_matter("trousers");
    rate_does_not_matter("tshirt");
    held_is_still("skirt");
    held_is_still("trousers");
    held_is_still("tshirt");
    return tap_done();
}
