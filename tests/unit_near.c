/* What is known of the parts near a vertex: as exact as asking one by one, and never too much where it has moved. */
#include "dress/near.h"

#include "dress/follow.h"
#include "dice.h"
#include "scene.h"

static const double FAR = 0.03;

typedef struct {
    Scene s;
    Sheet sheet;
    Vec3 *point; /* of its vertices, in the bind pose */
    Near *near;
} Worn;

/* Trousers in the bind pose, and the body on a stool: limbs in, on, and far from the cloth. */
static void worn_open(Worn *c) {
    Scene *s = &c->s;
    Fit fit;
    static Lattice lattice;
    Leaves leaves;
    Follower follower;
    Pose pose = figure_rest_pose();
    scene_open(s, "trousers");
    need(s, fit_garment(s->garment, &s->figure, &s->body, &s->arena, &fit, &s->error));
    need(s, follow_reserve(&follower, &fit, &s->figure, &s->body, &s->arena, &s->error));
    need(s, lattice_build(&fit, 5, 1, &s->arena, &lattice, &s->error));
    need(s, leaves_reserve(&leaves, &lattice, &s->arena, &s->error));
    need(s, sheet_reserve(&c->sheet, &lattice, &s->arena, &s->error));
    Patch *root = ARENA_NEW(&s->arena, Patch, fit.npatches, &s->error);
    need(s, root != NULL);
    follow_pose(&follower, &pose, root);
    leaves_fill(&leaves, lattice.depth);
    tessellate(&c->sheet, &leaves);
    c->point = ARENA_NEW(&s->arena, Vec3, c->sheet.nvertices, &s->error);
    c->near = ARENA_NEW(&s->arena, Near, c->sheet.nvertices, &s->error);
    need(s, c->point && c->near);
    for (int v = 0; v < c->sheet.nvertices; v++) c->point[v] = lattice_point(&lattice, root, c->sheet.place[v]);
    scene_leg(s, &pose, true, 30, 60);
    body_frame_pose(&s->posed, &pose);
}

static double unpressed(const Worn *c, int part, Vec3 at) {
    BodyPoint p;
    body_point_move(&p, at);
    return body_point_unpressed(&c->s.posed, part, &p, FAR);
}

/* Every part that is near is known with its distance, and no other. */
static void as_one_by_one(const Worn *c) {
    int wrong = 0, parts = 0;
    double worst = 0;
    for (int v = 0; v < c->sheet.nvertices; v++) {
        const Near *near = &c->near[v];
        double least = FAR;
        for (int part = 0; part < c->s.body.nparts; part++) {
            double d = unpressed(c, part, c->point[v]);
            bool is_near = near->parts >> part & 1;
            wrong += is_near != (d < FAR);
            if (!is_near) continue;
            worst = fmax(worst, fabs(d - near->distance[part]));
            least = fmin(least, d);
            parts++;
        }
        worst = fmax(worst, fabs(least - near->least));
    }
    OK(parts > 500 && wrong == 0, "%d parts are near vertices, and known (%d are not)", parts, wrong);
    NEAR(worst, 0, 1e-7, "their distances are those of single questions");
}

/* Vertices go somewhere: what is known of them is never more than there is. */
static void after_a_move(Worn *c) {
    int beyond = 0, unclear = 0, clear = 0;
    for (int v = 0; v < c->sheet.nvertices; v++) {
        Near near = c->near[v];
        Vec3 to = vec_add(c->point[v], vec_scale(dice_around(), 0.02));
        if (near_clear(&near, to)) {
            clear++;
            unclear += body_frame_inside(&c->s.posed, ~0u, to);
        }
        near_move(&near, to);
        for (int part = 0; part < c->s.body.nparts; part++)
            if (near.parts >> part & 1) beyond += near.distance[part] > unpressed(c, part, to) + 1e-7;
    }
    OK(beyond == 0, "after a move no part is nearer than it is known to be (%d are)", beyond);
    OK(clear > 100 && unclear == 0, "%d vertices are clear of all parts (%d are not)", clear, unclear);
}

/* What stands where it was seen is not looked at again, what has moved is. */
static void known_stays(Worn *c) {
    const Sheet *sheet = &c->sheet;
    int n = sheet->nvertices, mark = 12345, kept = 0;
    for (int v = 0; v < n; v += 2) c->point[v] = vec_add(c->point[v], vec(0.001, 0, 0));
    for (int v = 0; v < n; v++) c->near[v].least = (float)mark;
    near_find(c->near, &c->s.posed, sheet, c->point, FAR, true);
    for (int v = 0; v < n; v++) kept += (c->near[v].least > FAR + 1) == (v % 2 == 1);
    OK(kept == n, "what has not moved stays known, what has is asked for anew (%d of %d)", kept, n);
    near_find(c->near, &c->s.posed, sheet, c->point, FAR, false);
    as_one_by_one(c);
}

/* The least distance is found anew from the others. */
static void sums(const Worn *c) {
    double worst = 0;
    for (int v = 0; v < c->sheet.nvertices; v++) {
        Near near = c->near[v];
        near.least = -1;
        near_sum(&near, FAR);
        worst = fmax(worst, fabs(near.least - c->near[v].least));
    }
    NEAR(worst, 0, 0, "the least distance is the least of all");
}

int main(void) {
    Worn c;
    worn_open(&c);
    near_find(c.near, &c.s.posed, &c.sheet, c.point, FAR, false);
    as_one_by_one(&c);
    sums(&c);
    after_a_move(&c);
    known_stays(&c);
    arena_free(&c.s.arena);
    return tap_done();
}
