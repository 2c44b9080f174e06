/* The way out of a part: far enough, to the side where the cloth belongs, never out of the garment, and no farther
   than the middle between two parts that face each other. */
#include "dress/escape.h"

#include "specimen.h"

static const double CLEARANCE = 0.003;

typedef struct {
    Specimen specimen;
    Escape escape;
    const BodyFrame *body;
} Worn;

/* A garment in the bind pose, and the body in it. */
static void wear(Worn *w, const char *name) {
    Scene *s = &w->specimen.scene;
    Pose rest = figure_rest_pose();
    specimen_open(&w->specimen, name, 5, 1);
    need(s, escape_reserve(&w->escape, &w->specimen.lattice, &s->arena, &s->error));
    escape_bind(&w->escape, w->specimen.root);
    w->escape.root = w->specimen.root;
    w->body = &s->posed;
    body_frame_pose(&s->posed, &rest);
}

static int part_of(const Worn *w, Role role) { return w->specimen.scene.body.of_role[role]; }

/* The left forearm goes so far, the world's axes, metres; the garment does not follow. */
static void carry_forearm(Worn *w, Vec3 by) {
    Pose pose = figure_rest_pose();
    pose.bone[ROLE_LEFT_FOREARM].t = vec_add(pose.bone[ROLE_LEFT_FOREARM].t, by);
    body_frame_pose(&w->specimen.scene.posed, &pose);
}

static bool is_own(const Worn *w, int place, int part) {
    return w->specimen.lattice.collide[place] & part_bit(w->body, part);
}

static double distance(const Worn *w, int part, Vec3 at, Vec3 *n) {
    return body_frame_distance(w->body, part, at, 1, n);
}

/* What cloth of a place is asked for that stands at `at`, `from` away from a part with normal *n there. */
static double asked_for(const Worn *w, int place, Vec3 at, int part, double from, double slack, Vec3 *n) {
    EscapePoint p;
    escape_at(&p, place, at, CLEARANCE);
    p.slack = slack;
    return escape_asked(&w->escape, w->body, &p, part, from, n);
}

/* Cloth of every place that has sunk a little into what it is worn over finds the way out. */
static void comes_out(const char *name) {
    Worn w;
    wear(&w, name);
    int asked = 0, unasked = 0, inside = 0, short_of = 0;
    for (int place = 0; place < w.specimen.lattice.nplaces; place++)
        for (int part = 0; part < w.specimen.scene.body.nparts; part++) {
            if (!is_own(&w, place, part)) continue;
            Vec3 n, at = w.escape.rest[place];
            double d = distance(&w, part, at, &n);
            if (d > 0.05) continue;
            at = vec_mad(at, n, -0.01 - d);
            d = distance(&w, part, at, &n);
            double way = asked_for(&w, place, at, part, d, 0, &n);
            if (d < CLEARANCE) asked++, unasked += way <= 0;
            double left = distance(&w, part, vec_mad(at, n, way), NULL);
            inside += left <= 0;
            short_of += left < 0.89 * CLEARANCE;
        }
    OK(asked > 100 && unasked == 0, "%s: sunk in, all of %d are asked to leave (%d are not)", name, asked, unasked);
    OK(inside == 0, "%s: and leave (%d do not)", name, inside);
    OK(short_of * 100 < asked, "%s: all but %d for as far as they were asked", name, short_of);
    arena_free(&w.specimen.scene.arena);
}

/* What keeps its distance, or misses no more of it than it may, is left alone. */
static void asks_no_more(void) {
    Worn w;
    wear(&w, "skirt");
    int part = 0, place = 0;
    while (!is_own(&w, place, part)) part++;
    Vec3 n, skin = w.escape.rest[place];
    double d = distance(&w, part, skin, &n);
    skin = vec_mad(skin, n, -d);
    double near = 1.01 * CLEARANCE, nearer = 0.8 * CLEARANCE;
    Vec3 at = vec_mad(skin, n, near), closer = vec_mad(skin, n, nearer);
    OK(asked_for(&w, place, at, part, near, 0, &n) == 0, "far enough: nothing is asked");
    OK(asked_for(&w, place, closer, part, nearer, 0.25, &n) == 0, "a fifth is missing, as a quarter may be: nothing");
    OK(asked_for(&w, place, closer, part, nearer, 0, &n) > 0, "as nothing may be: it is asked for");
    arena_free(&w.specimen.scene.arena);
}

/* An arm that sweeps through a skirt takes no cloth out of it, wherever it is. */
static void stays_in_the_garment(void) {
    Worn w;
    wear(&w, "skirt");
    const Figure *figure = &w.specimen.scene.figure;
    Vec3 elbow = figure->start[ROLE_LEFT_FOREARM], hip = figure->start[ROLE_LEFT_THIGH];
    double most = -1;
    int met = 0, part = part_of(&w, ROLE_LEFT_FOREARM);
    for (int step = 0; step < 20; step++) {
        Vec3 to = vec_add(hip, vec(0.2 - 0.02 * step, 0, 0.1));
        carry_forearm(&w, vec_sub(to, elbow));
        for (int place = 0; place < w.specimen.lattice.nplaces; place++) {
            Vec3 n, at = lattice_point(&w.specimen.lattice, w.specimen.root, place);
            if (body_frame_far(w.body, part, at, CLEARANCE)) continue;
            double d = distance(&w, part, at, &n);
            if (asked_for(&w, place, at, part, d, 0, &n) <= 0) continue;
            most = max_of(most, vec_dot(n, lattice_normal(&w.specimen.lattice, w.specimen.root, place)));
            met++;
        }
    }
    OK(met > 50 && most < 0, "an arm through a skirt: %d places are met, none is led outwards (%.2f)", met, most);
    arena_free(&w.specimen.scene.arena);
}

/* Between two thighs cloth is asked to leave either for the middle. */
static void halves_the_room(void) {
    Worn w;
    wear(&w, "skirt");
    int left = part_of(&w, ROLE_LEFT_THIGH), right = part_of(&w, ROLE_RIGHT_THIGH), asked = 0;
    Vec3 hip = w.specimen.scene.figure.start[ROLE_LEFT_THIGH];
    double worst = 0;
    for (double down = 0.15; down < 0.3; down += 0.01) {
        Vec3 n, m, at = vec(0.004, hip.y - down, hip.z);
        double d = distance(&w, left, at, &n), room = d + distance(&w, right, at, &m);
        EscapePoint p;
        escape_at(&p, 0, at, room);
        p.near = 1u << left | 1u << right;
        double way = escape_asked(&w.escape, w.body, &p, left, d, &n);
        if (way <= 0) continue;
        worst = max_of(worst, fabs(d + way - room / 2));
        asked++;
    }
    OK(asked > 0 && worst < 1e-3, "between the thighs, %d times: the middle, to %.2f mm", asked, 1e3 * worst);
    arena_free(&w.specimen.scene.arena);
}

int main(void) {
    static const char *const names[] = {"skirt", "trousers", "tshirt"};
    for (int k = 0; k < 3; k++) comes_out(names[k]);
    asks_no_more();
    stays_in_the_garment();
    halves_the_room();
    return tap_done();
}
