/* What is known of the parts near a vertex: as exact as asking one by one, and never too much where it has moved. */
#include "dress/near.h"

#include "specimen.h"
#include "dice.h"

static const double FAR = 0.03;

typedef struct {
    Specimen specimen;
    Vec3 *point; /* of its vertices, in the bind pose */
    Near *near;
} Worn;

/* Trousers in the bind pose, and the body with a knee up: limbs in, on, and far from the cloth. */
static void worn_open(Worn *w) {
    Scene *s = &w->specimen.scene;
    const Sheet *sheet = &w->specimen.sheet;
    Pose pose = figure_rest_pose();
    specimen_open(&w->specimen, "trousers", 5, 1);
    w->point = ARENA_NEW(&s->arena, Vec3, sheet->nvertices, &s->error);
    w->near = ARENA_NEW(&s->arena, Near, sheet->nvertices, &s->error);
    need(s, w->point && w->near);
    for (int v = 0; v < sheet->nvertices; v++)
        w->point[v] = lattice_point(&w->specimen.lattice, w->specimen.root, sheet->place[v]);
    scene_leg(s, &pose, true, 30, 60);
    body_frame_pose(&s->posed, &pose);
}

static double unpressed(const Worn *w, int part, Vec3 at) {
    BodyPoint p;
    body_point_move(&p, at);
    return body_point_unpressed(&w->specimen.scene.posed, part, &p, FAR);
}

/* Every part that is near is known with its distance, and no other. */
static void as_one_by_one(const Worn *w) {
    int wrong = 0, parts = 0;
    double worst = 0;
    for (int v = 0; v < w->specimen.sheet.nvertices; v++) {
        const Near *near = &w->near[v];
        double least = FAR;
        for (int part = 0; part < w->specimen.scene.body.nparts; part++) {
            double d = unpressed(w, part, w->point[v]);
            bool is_near = near->parts >> part & 1;
            wrong += is_near != (d < FAR);
            if (!is_near) continue;
            worst = max_of(worst, fabs(d - near->distance[part]));
            least = min_of(least, d);
            parts++;
        }
        worst = max_of(worst, fabs(least - near->least));
    }
    OK(parts > 500 && wrong == 0, "%d parts are near vertices, and known (%d are not)", parts, wrong);
    NEAR(worst, 0, 1e-7, "their distances are those of single questions");
}

/* Vertices go somewhere: what is known of them is never more than there is. */
static void after_a_move(Worn *w) {
    int beyond = 0, unclear = 0, clear = 0;
    for (int v = 0; v < w->specimen.sheet.nvertices; v++) {
        Near near = w->near[v];
        Vec3 to = vec_add(w->point[v], vec_scale(dice_around(), 0.02));
        if (near_clear(&near, to)) {
            clear++;
            unclear += body_frame_any_inside(&w->specimen.scene.posed, ~0u, &to, 1);
        }
        near_move(&near, to);
        for (int part = 0; part < w->specimen.scene.body.nparts; part++)
            if (near.parts >> part & 1) beyond += near.distance[part] > unpressed(w, part, to) + 1e-7;
    }
    OK(beyond == 0, "after a move no part is nearer than it is known to be (%d are)", beyond);
    OK(clear > 100 && unclear == 0, "%d vertices are clear of all parts (%d are not)", clear, unclear);
}

/* What stands where it was seen is not looked at again, what has moved is. */
static void known_stays(Worn *w) {
    const Sheet *sheet = &w->specimen.sheet;
    int n = sheet->nvertices, mark = 12345, kept = 0;
    for (int v = 0; v < n; v += 2) w->point[v] = vec_add(w->point[v], vec(0.001, 0, 0));
    for (int v = 0; v < n; v++) w->near[v].least = (float)mark;
    near_find(w->near, &w->specimen.scene.posed, sheet, w->point, FAR, true);
    for (int v = 0; v < n; v++) kept += (w->near[v].least > FAR + 1) == (v % 2 == 1);
    OK(kept == n, "what has not moved stays known, what has is asked for anew (%d of %d)", kept, n);
    near_find(w->near, &w->specimen.scene.posed, sheet, w->point, FAR, false);
    as_one_by_one(w);
}

/* The least distance is found anew from the others. */
static void sums(const Worn *w) {
    double worst = 0;
    for (int v = 0; v < w->specimen.sheet.nvertices; v++) {
        Near near = w->near[v];
        near.least = -1;
        near_sum(&near, FAR);
        worst = max_of(worst, fabs(near.least - w->near[v].least));
    }
    NEAR(worst, 0, 0, "the least distance is the least of all");
}

int main(void) {
    static Worn w;
    worn_open(&w);
    near_find(w.near, &w.specimen.scene.posed, &w.specimen.sheet, w.point, FAR, false);
    as_one_by_one(&w);
    sums(&w);
    after_a_move(&w);
    known_stays(&w);
    arena_free(&w.specimen.scene.arena);
    return tap_done();
}
