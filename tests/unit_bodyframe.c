/* A posed body answers the same however it is asked: point by point or many at once, once or again, with a limit or
   without, inside or how far. */
#include "dress/bodyframe.h"

#include "dice.h"
#include "scene.h"

enum { N = 400 };
static const double FAR = 0.03;

/* Standing, walking, a knee at the chest, a squat. */
static const double legs[][4] = {{0, 0, 0, 0}, {30, 40, -20, 10}, {120, 140, 0, 0}, {110, 130, 110, 130}};
enum { POSES = sizeof legs / sizeof *legs };

static void take_pose(Scene *s, const double leg[4]) {
    Pose pose = figure_rest_pose();
    scene_leg(s, &pose, true, leg[0], leg[1]);
    scene_leg(s, &pose, false, leg[2], leg[3]);
    body_frame_pose(&s->posed, &pose);
}

/* Points in a box twice as large as a part's. */
static void scatter(const BodyFrame *f, int part, Vec3 *p) {
    Box b = f->box[part];
    Vec3 half = vec_scale(vec_sub(b.high, b.low), 0.5), middle = vec_mid(b.low, b.high);
    for (int i = 0; i < N; i++) {
        Vec3 d = dice_around();
        p[i] = vec(middle.x + 2 * half.x * d.x, middle.y + 2 * half.y * d.y, middle.z + 2 * half.z * d.z);
    }
}

typedef struct { int asked, limit, many, again, unpressed, far, inside, any, normal; } Wrong;

static void ask(const BodyFrame *f, int part, const Vec3 *p, Wrong *w) {
    double limited[N], free[N];
    unsigned all = ~0u, one = part_bit(f, part);
    bool any = false;
    body_frame_distances(f, part, p, N, FAR, limited);
    body_frame_unpressed_many(f, part, p, N, FAR, free, NULL);
    for (int i = 0; i < N; i++) {
        Vec3 n, m;
        double d = body_frame_distance(f, part, p[i], INFINITY, &n), near = body_frame_distance(f, part, p[i], FAR, &m);
        BodyPoint x;
        body_point_move(&x, p[i]);
        w->again += body_point_distance(f, part, &x, FAR, NULL) != near;
        w->again += body_point_distance(f, part, &x, FAR, NULL) != near;
        w->again += !body_frame_far(f, part, p[i], FAR) && fmin(body_point_unpressed(f, part, &x, FAR), FAR) != free[i];
        w->many += near < FAR && limited[i] != near;
        w->limit += near < FAR && fabs(d - near) > 1e-12;
        w->unpressed += free[i] > near;
        w->far += body_frame_far(f, part, p[i], 0) && d <= 0;
        w->normal += fabs(vec_len(n) - 1) > 1e-9 || (near < FAR && vec_dist(n, m) > 1e-9);
        w->inside += body_frame_any_inside(f, one, &p[i], 1) != (near < 0);
        any |= near < 0;
        w->asked += near < FAR;
    }
    w->any += body_frame_any_inside(f, one, p, N) != any;
    any = false;
    for (int i = 0; i < 7; i++) any |= body_frame_any_inside(f, all, &p[i], 1);
    w->any += body_frame_any_inside(f, all, p, 7) != any;
}

int main(void) {
    Scene s;
    Wrong w = {0};
    int contacts = 0;
    scene_open(&s, "skirt");
    for (int k = 0; k < POSES; k++) {
        take_pose(&s, legs[k]);
        for (int part = 0; part < s.body.nparts; part++) {
            Vec3 p[N];
            scatter(&s.posed, part, p);
            ask(&s.posed, part, p, &w);
            contacts += s.posed.contacts[part].n;
        }
    }
    OK(w.asked > 4000 && contacts > 50, "%d points near parts, in %d contacts", w.asked, contacts);
    OK(w.many == 0, "many at once have the distances of each (%d have not)", w.many);
    OK(w.again == 0, "a point that is asked again says the same (%d times not)", w.again);
    OK(w.limit == 0, "a limit hides what is farther, and changes nothing nearer (%d)", w.limit);
    OK(w.unpressed == 0, "where nothing presses parts are no farther (%d are)", w.unpressed);
    OK(w.far == 0, "what is out of a part's box is not in the part (%d are)", w.far);
    OK(w.normal == 0, "normals are unit vectors, with a limit or without (%d)", w.normal);
    OK(w.inside == 0 && w.any == 0, "inside is a distance below 0, also of any (%d, %d)", w.inside, w.any);
    arena_free(&s.arena);
    return tap_done();
}
