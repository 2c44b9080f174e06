/* A hand that hangs into the lap of a skirt: in which direction it presses, on which side of the cloth, and what is
   drawn along when a vertex is taken back. */
#include "turns.h"
#include "worn.h"

/* A hand in the lap, which presses nothing yet. */
static void lay_hand(Worn *w) {
    worn_open(w, "skirt", 5, 2);
    Scene *s = &w->of.scene;
    Pose pose = scene_hand_in_lap(s, 34);
    worn_pose(w, &pose, 2);
    push_rest(&w->cloth.push);
    near_find(w->cloth.push.near, &s->posed, &w->cloth.sheet, w->cloth.push.point, 0.05, false);
}

static void press_hand(Worn *w) {
    bool capped = false;
    lay_hand(w);
    dent_all(&w->cloth.settler.denter, &w->cloth.push, &capped);
}

/* As if in the frame before the arm had pressed in another direction. */
static void directions_turn_slowly(void) {
    static const double dt = 1.0 / 60, TURNS = 15; /* radians a second, as in src/dress/dent.c */
    static Worn w;
    bool capped = false;
    press_hand(&w);
    Push *p = &w.cloth.push;
    Denter *d = &w.cloth.settler.denter;
    Vec3 now = p->field.way[LIMB_LEFT_ARM], aside = vec_unit_or(vec_cross(now, vec(1, 0, 0)), vec(0, 0, 1));
    Vec3 before = vec_unit_or(vec_add(now, aside), now);
    for (int v = 0; v < p->sheet->nvertices; v++)
        field_set_spot(&p->field.dent[LIMB_LEFT_ARM], p->sheet->place[v], vec_scale(before, 0.05));
    p->field.way[LIMB_LEFT_ARM] = before;
    p->field.pelvis = w.of.scene.posed.pose.bone[ROLE_PELVIS].r;
    dent_carry(d, &p->field, &w.of.scene.posed, dt, true);
    field_drop_dents(&p->field);
    push_rest(p);
    dent_all(d, p, &capped);
    Vec3 way = p->field.way[LIMB_LEFT_ARM];
    NEAR(angle(before, way), TURNS * dt / DEGREE, 1e-9, "a limb's direction turns by no more than it may");
    NEAR(angle(before, way) + angle(way, now), angle(before, now), 1e-9,
         "on the shortest way to where it presses now");
    arena_free(&w.of.scene.arena);
}

/* The limb is behind all of the cloth, also behind the far side, whose inward normal is against its direction. */
static void presses_its_own_side(void) {
    static Worn w;
    lay_hand(&w);
    Push *p = &w.cloth.push;
    Hollow *h = &w.cloth.settler.denter.hollow;
    Touch t = touch_find(p);
    hollow_find(h, p, &t, LIMB_LEFT_ARM);
    for (int v = 0; v < p->sheet->nvertices; v++) p->point[v] = vec_mad(p->point[v], h->way, -0.15);
    int pressed = 0, behind = 0;
    double most = 0, least = 0;
    for (int v = 0; v < p->sheet->nvertices; v++) {
        Vec3 inwards = vec_scale(lattice_normal(p->field.lattice, p->escape.root, p->sheet->place[v]), -1);
        double depth = hollow_depth(h, p, v), facing = vec_dot(inwards, h->way);
        pressed += depth > 0.01;
        behind += facing < 0;
        if (facing < 0) most = max_of(most, depth);
        if (facing > 0.5) least = max_of(least, depth);
    }
    OK(pressed > 20 && least > 0.05, "%d vertices are pressed in, by up to %.0f mm", pressed, 1000 * least);
    OK(behind > 100 && most == 0, "none of the %d on the far side (%g)", behind, most);
    arena_free(&w.of.scene.arena);
}

static int deepest_of(const Denter *d, const Push *p) {
    int deepest = 0;
    for (int v = 0; v < p->sheet->nvertices; v++)
        if (d->depth[LIMB_LEFT_ARM][v] > d->depth[LIMB_LEFT_ARM][deepest]) deepest = v;
    return deepest;
}

/* The deepest vertex is taken back as far as that goes. */
static void cloth_is_drawn_along(void) {
    static const double LEAST = 0.999; /* as in src/dress/dent.c */
    static Worn w;
    press_hand(&w);
    Push *p = &w.cloth.push;
    Denter *d = &w.cloth.settler.denter;
    int deepest = deepest_of(d, p), torn = 0, most = 0;
    bool capped = false;
    double before = vec_len(field_dent(&p->field, p->sheet->place[deepest]));
    for (int round = 0; round < 3; round++) {
        dent_round(d);
        dent_back(d, p, deepest, &capped);
        most = d->nloose > most ? d->nloose : most;
        for (int k = 0; k < d->nloose; k++) {
            int n;
            const int *beside = slopes_beside(&d->slopes, p->sheet, d->loose[k], &n);
            for (int i = 0; i < n; i++) torn += slopes_keeps(p, beside[i], d->loose[k]) < LEAST;
        }
    }
    double after = vec_len(field_dent(&p->field, p->sheet->place[deepest]));
    OK(before > 0.05 && after < before - 0.02, "a vertex is taken back by %.0f of %.0f mm", 1000 * (before - after),
       1000 * before);
    OK(most > 10 && torn == 0 && !capped, "up to %d with it, and no edge is left too long (%d)", most, torn);
    arena_free(&w.of.scene.arena);
}

/* As if there were room for as few as that. */
static void a_cap_is_told(void) {
    enum { PLACES = 2, FOLLOW = 4 * PLACES };
    static Worn w;
    bool capped = false;
    press_hand(&w);
    Push *p = &w.cloth.push;
    Denter *d = &w.cloth.settler.denter;
    int deepest = deepest_of(d, p);
    d->nplaces = PLACES;
    for (int round = 0; round < 3 && !capped; round++) {
        dent_round(d);
        dent_back(d, p, deepest, &capped);
    }
    OK(capped && d->nloose == FOLLOW, "where more would have to follow than can be listed, that is told");
    arena_free(&w.of.scene.arena);
}

/* All of a fine body presses in no direction, so that none of its skin is turned away. */
static void room_for_all_blocks(void) {
    static Worn w;
    Scene *s = &w.of.scene;
    Arena own = {0};
    Hollow h;
    Pose rest = figure_rest_pose();
    Touch t = {.parts = {[LIMB_OTHER] = 0}};
    worn_open(&w, "skirt", 5, 1);
    need(s, body_fit(body_default(), &s->figure, 52, &s->arena, &s->body, &s->error));
    need(s, body_frame_init(&s->posed, &s->body, 1, &s->arena, &s->error));
    worn_pose(&w, &rest, 1);
    need(s, hollow_reserve(&h, &own, &s->error));
    char *behind = ARENA_NEW(&own, char, 64, &s->error);
    need(s, behind != NULL);
    t.parts[LIMB_OTHER] = (1u << s->body.nparts) - 1;
    hollow_find(&h, &w.cloth.push, &t, LIMB_OTHER);
    int written = 0;
    for (int k = 0; k < 64; k++) written += behind[k] != 0;
    OK(h.npoints > 4096 - HOLLOW_BLOCK && h.nblocks == (h.npoints + HOLLOW_BLOCK - 1) / HOLLOW_BLOCK && written == 0,
       "%d vertices press, and there is room for their %d blocks", h.npoints, h.nblocks);
    arena_free(&own);
    arena_free(&s->arena);
}

int main(void) {
    directions_turn_slowly();
    presses_its_own_side();
    cloth_is_drawn_along();
    a_cap_is_told();
    room_for_all_blocks();
    return tap_done();
}
