/* What happens between frames: a garment is as still as what it hangs on, has the same shape at any
   frame rate, begins and ends contact gently, and knows nothing of frames that did not belong to the motion.
   The topology is fixed, which keeps the points the same. */
#include <string.h>

#include "base/sort.h"
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
        t->largest = max_of(t->largest, change);
    }
}

/* The second difference that 99 in 100 do not exceed, millimetres. */
static double trace_most(Trace *t) {
    sort_numbers(t->change, t->nchanges);
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
            scene_frame(&s, dresser[k], &pose, 1 / 120.0, f == 0 ? TIE_AFRESH : TIE_GOES_ON, &mesh);
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
        scene_frame(s, d, &pose, 1 / rate, f == 0 ? TIE_AFRESH : TIE_GOES_ON, &mesh);
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
    int n = 0;
    dress_at(&s, 120, best, &n);
    for (int r = 0; r < 2; r++) {
        double worst = 0, sum = 0;
        dress_at(&s, rate[r], other, &n);
        for (int k = 0; k < INSTANTS; k++)
            for (int v = 0; v < n; v++) {
                double off = vec_dist(best[k][v], other[k][v]);
                worst = max_of(worst, off);
                sum += off / (n * INSTANTS);
            }
        OK(sum < 0.0005 && worst < 0.01, "%s: at %.0f frames a second the same shape as at 120 (%.2f mm, at most %.1f)",
           name, rate[r], 1000 * sum, 1000 * worst);
    }
    arena_free(&s.arena);
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
        Pose pose = scene_reaching(&s, 20 + 22 * (1 - fabs(2.0 * f / FRAMES - 1)));
        Mesh mesh;
        FrameStats stats = scene_frame(&s, d, &pose, 1 / 120.0, f == 0 ? TIE_AFRESH : TIE_GOES_ON, &mesh);
        if (f == 0) trace_open(&trace, &s, mesh.nvertices, FRAMES);
        trace_add(&trace, &mesh);
        touched += stats.displacement > 0.0055;
    }
    OK(touched > 20, "in %d frames the arm presses on the shirt", touched);
    OK(trace.largest < 0.007, "none of its vertices jumps (%.2f mm a frame^2)", 1000 * trace.largest);
    arena_free(&s.arena);
}

/* Frames in another pose, from which the motion is back at once: all others are dressed as if they were not there;
   where the motion has jumped as well, as if they were the first. */
static void astray_is_forgotten(const char *name, Tie back) {
    enum { ASTRAY = 20, BACK = 22, FRAMES = 40 };
    Scene s;
    scene_open(&s, name);
    Dresser *plain = open_dresser(&s, METHOD_PUSH), *other = open_dresser(&s, METHOD_PUSH);
    double most = 0;
    for (int f = 0; f < FRAMES; f++) {
        Pose pose = lifted(&s, 60 + 0.3 * f), astray = lifted(&s, 95 + f);
        double dt = (f == BACK ? 1 + BACK - ASTRAY : 1) / 60.0;
        bool is_astray = f >= ASTRAY && f < BACK;
        Mesh a, b;
        Tie tie = f == BACK ? back : f ? TIE_GOES_ON : TIE_AFRESH;
        scene_frame(&s, other, is_astray ? &astray : &pose, dt, is_astray ? TIE_ASTRAY : tie, &b);
        if (is_astray) continue;
        if (f == BACK && back == TIE_AFRESH) plain = open_dresser(&s, METHOD_PUSH);
        scene_frame(&s, plain, &pose, dt, tie, &a);
        for (int v = 0; v < a.nvertices; v++) most = max_of(most, vec_dist(a.position[v], b.position[v]));
    }
    OK(most == 0, "%s: frames that are astray disturb no other%s", name,
       back == TIE_AFRESH ? ", nor do those in front of them where cloth starts afresh" : "");
    arena_free(&s.arena);
}

/* The farthest that a vertex is from that of another mesh; infinity if the meshes are split differently. */
static double apart(const Mesh *a, const Mesh *b) {
    double most = a->nvertices == b->nvertices ? 0 : INFINITY;
    for (int v = 0; v < a->nvertices && v < b->nvertices; v++)
        most = max_of(most, vec_dist(a->position[v], b->position[v]));
    return most;
}

/* Where patches are split as the body comes near, their new vertices take their time; but not those of a frame that is
   astray, nor do they disturb others. */
static void astray_is_alone(const char *name) {
    static const DressOptions split = {.depth = 2};
    Scene s;
    scene_open(&s, name);
    Dresser *other = scene_dresser(&s, split), *alone = scene_dresser(&s, split), *plain = scene_dresser(&s, split);
    Pose stands = lifted(&s, 5), astray = lifted(&s, 70), next = lifted(&s, 8);
    Mesh a, b;
    scene_frame(&s, other, &stands, 0, TIE_AFRESH, &b);
    int before = b.nvertices;
    scene_frame(&s, other, &astray, 1 / 60.0, TIE_ASTRAY, &b);
    scene_frame(&s, alone, &astray, 0, TIE_AFRESH, &a);
    OK(b.nvertices > before && apart(&a, &b) == 0, "%s: a frame that is astray is dressed as if alone (%.1f mm off)",
       name, 1000 * apart(&a, &b));
    scene_frame(&s, plain, &stands, 0, TIE_AFRESH, &a);
    scene_frame(&s, plain, &next, 1 / 30.0, TIE_GOES_ON, &a);
    scene_frame(&s, other, &next, 1 / 30.0, TIE_GOES_ON, &b);
    OK(apart(&a, &b) == 0, "and the next one as if it had not been");
    arena_free(&s.arena);
}

/* The left arm in front of the trunk, by degrees to the side and forwards. */
static Pose across(const Scene *s, double side, double forwards) {
    Pose pose = scene_reaching(s, side);
    scene_bend(s, &pose, ROLE_LEFT_UPPER_ARM, ROLE_LEFT_HAND, forwards);
    return pose;
}

/* An arm goes through shirt and trunk, so that the shirt is thrown as far as it may go; then it lies on the shirt, and
   then it hangs. Cloth that was never thrown comes back slowly, and so does cloth that was before a jump, or in frames
   that are astray. */
static void thrown_is_forgotten(Tie tie) {
    enum { FRAMES = 3 };
    Scene s;
    scene_open(&s, "tshirt");
    Dresser *plain = open_dresser(&s, METHOD_PUSH), *other = open_dresser(&s, METHOD_PUSH);
    Pose pose[FRAMES] = {across(&s, 60, 40), across(&s, 60, 44), across(&s, 25, 0)}, through = across(&s, 60, 16);
    double most = 0, least = INFINITY;
    int shown = 0;
    Mesh a, b;
    FrameStats thrown = {0};
    if (tie == TIE_AFRESH) {
        scene_frame(&s, other, &pose[2], 0, TIE_AFRESH, &b);
        thrown = scene_frame(&s, other, &through, 1 / 30.0, TIE_GOES_ON, &b);
    }
    for (int f = 0; f < FRAMES; f++) {
        Tie on = f ? TIE_GOES_ON : TIE_AFRESH;
        if (f == 1 && tie == TIE_ASTRAY) thrown = scene_frame(&s, other, &through, 1 / 30.0, tie, &b);
        scene_frame(&s, other, &pose[f], 1 / 30.0, on, &b);
        FrameStats stats = scene_frame(&s, plain, &pose[f], 1 / 30.0, on, &a);
        least = min_of(least, stats.displacement);
        shown += stats.residual_edges + stats.residual_cloth + stats.inside;
        most = max_of(most, apart(&a, &b));
    }
    int torn = thrown.residual_edges + thrown.residual_cloth + thrown.inside;
    OK(torn > 0 && shown == 0 && least > 0.07, "cloth comes back slowly, from %.0f mm to %.0f",
       1000 * thrown.displacement, 1000 * least);
    OK(most == 0, "also if it was thrown %s", tie == TIE_AFRESH ? "before a jump" : "in a frame that is astray");
    arena_free(&s.arena);
}

/* The left leg swings through the right one, as captured legs do: there is no room for two legs of trousers, and the
   best way out is another one in each frame. Cloth takes it slowly all the same, unless it would be much deeper in a
   leg: three levels and an offset may each go 8 mm. */
static void no_room_is_no_haste(void) {
    enum { FRAMES = 40 };
    static const double RATE = 30;
    Scene s;
    scene_open(&s, "trousers");
    Dresser *pushed = open_dresser(&s, METHOD_PUSH), *global = open_dresser(&s, METHOD_GLOBAL);
    Vec3 *last = NULL;
    int shows = 0, fast = 0;
    for (int f = 0; f < FRAMES; f++) {
        Pose pose = figure_rest_pose();
        Mat3 turn = mat_axis_angle(vec(0, 0, -1), (5 + 0.5 * f) * PI / 180);
        scene_turn(&s, &pose, ROLE_LEFT_THIGH, ROLE_LEFT_TOE, turn);
        Mesh cloth, plain;
        Tie tie = f == 0 ? TIE_AFRESH : TIE_GOES_ON;
        FrameStats stats = scene_frame(&s, pushed, &pose, 1 / RATE, tie, &cloth);
        scene_frame(&s, global, &pose, 1 / RATE, tie, &plain);
        if (f == 0) last = ARENA_NEW(&s.arena, Vec3, cloth.nvertices, &s.error);
        need(&s, last != NULL);
        double step = 0;
        for (int v = 0; v < cloth.nvertices; v++) {
            Vec3 by = vec_sub(cloth.position[v], plain.position[v]);
            if (f > 0) step = max_of(step, vec_dist(by, last[v]));
            last[v] = by;
        }
        bool bare = stats.residual_edges + stats.residual_cloth + stats.inside > 0;
        shows += bare;
        fast += bare && step > 0.04;
    }
    OK(shows > FRAMES / 3 && fast <= shows / 4,
       "trousers whose legs pass through each other in %d frames go farther than 4 cm in few (%d)", shows, fast);
    arena_free(&s.arena);
}

int main(void) {
    contact_is_gentle();
    astray_is_forgotten("skirt", TIE_GOES_ON);
    astray_is_forgotten("trousers", TIE_GOES_ON);
    astray_is_forgotten("trousers", TIE_AFRESH);
    astray_is_alone("skirt");
    astray_is_alone("trousers");
    thrown_is_forgotten(TIE_AFRESH);
    thrown_is_forgotten(TIE_ASTRAY);
    rate_does_not_matter("skirt");
    rate_does_not_matter("trousers");
    rate_does_not_matter("tshirt");
    held_is_still("skirt");
    held_is_still("trousers");
    held_is_still("tshirt");
    no_room_is_no_haste();
    return tap_done();
}
