/* The body's proportions: human, for a child as for a tall adult, on narrow hips as on broad ones. */

#include "bodies.h"

static Box box_of(const Body *b) {
    Box box = box_empty();
    for (int i = 0; i < b->skin.nvertices; i++) box_add(&box, b->skin.position[i]);
    return box;
}

static Vec3 centroid(const Mesh *m, int triangle) {
    const int *v = m->triangle[triangle].v;
    return vec_scale(vec_add(vec_add(m->position[v[0]], m->position[v[1]]), m->position[v[2]]), 1.0 / 3);
}

/* How far the nearest triangle of part b is from the mirror image of a triangle. */
static double mirror_gap(const Mesh *m, const BodyPart *b, int triangle) {
    Vec3 p = centroid(m, triangle);
    double nearest = INFINITY;
    for (int i = b->first_triangle; i < b->first_triangle + b->ntriangles; i++) {
        Vec3 q = centroid(m, i);
        nearest = min_of(nearest, vec_dist(p, vec(-q.x, q.y, q.z)));
    }
    return nearest;
}

static void test_symmetry(const Body *b) {
    static const Role left[] = {ROLE_LEFT_UPPER_ARM, ROLE_LEFT_FOREARM, ROLE_LEFT_HAND, ROLE_LEFT_THIGH,
                                ROLE_LEFT_SHIN, ROLE_LEFT_FOOT, ROLE_LEFT_TOE};
    static const Role right[] = {ROLE_RIGHT_UPPER_ARM, ROLE_RIGHT_FOREARM, ROLE_RIGHT_HAND, ROLE_RIGHT_THIGH,
                                 ROLE_RIGHT_SHIN, ROLE_RIGHT_FOOT, ROLE_RIGHT_TOE};
    double worst = 0;
    for (int i = 0; i < 7; i++) {
        const BodyPart *part = part_of(b, left[i]);
        for (int k = part->first_triangle; k < part->first_triangle + part->ntriangles; k++)
            worst = max_of(worst, mirror_gap(&b->skin, part_of(b, right[i]), k));
    }
    OK(worst < 1e-12, "the right side mirrors the left, triangle by triangle (%.2g m)", worst);
}

static void test_adult(const Body *b) {
    Box box = box_of(b);
    NEAR(box.high.y, 1.70, 0.005, "the crown is at the stature");
    NEAR(box.low.y, 0, 0.002, "the soles are on the floor");
    NEAR(b->scale, 1, 1e-12, "the reference has the reference's girth");
    NEAR((double)b->skin.ntriangles, 8000, 400, "triangles at detail 16");
    const BodyPart *pelvis = part_of(b, ROLE_PELVIS), *thigh = part_of(b, ROLE_LEFT_THIGH);
    double hips = 0;
    for (int i = 0; i < pelvis->nsections; i++) hips = max_of(hips, pelvis->section[i].side);
    NEAR(hips, 0.163, 0.002, "half width of the hips");
    NEAR(body_section(thigh, 0.15).side, 0.081, 0.002, "radius of the thigh near its top");
    bool flatter = true;
    for (double at = 0.2; at < 1; at += 0.05) {
        Section s = body_section(part_of(b, ROLE_CHEST), at);
        flatter &= s.front < s.back;
    }
    OK(flatter, "the chest is flatter in front than behind");
    const BodyPart *head = part_of(b, ROLE_HEAD);
    double heads = 1.70 / (head->high - head->low);
    OK(heads > 7 && heads < 8, "7 to 8 heads tall (%.2f)", heads);
}

/* Half balls of equal size at elbow and knee: a bent joint has no gap and no step. */
static void test_joints(const Body *b) {
    static const Role upper[] = {ROLE_LEFT_UPPER_ARM, ROLE_LEFT_THIGH, ROLE_RIGHT_FOREARM};
    static const Role lower[] = {ROLE_LEFT_FOREARM, ROLE_LEFT_SHIN, ROLE_RIGHT_HAND};
    for (int i = 0; i < 3; i++) {
        Section end = body_section(part_of(b, upper[i]), 1), start = body_section(part_of(b, lower[i]), 0);
        NEAR(end.side, start.side, 1e-12, "both sides of a joint are equally wide");
        NEAR(end.front + end.back, start.front + start.back, 1e-12, "and equally deep");
    }
    const BodyPart *pelvis = part_of(b, ROLE_PELVIS), *chest = part_of(b, ROLE_CHEST);
    Vec3 hip = part_of(b, ROLE_LEFT_THIGH)->frame.t, shoulder = part_of(b, ROLE_LEFT_UPPER_ARM)->frame.t;
    OK(distance_in_stance(pelvis, hip) < -0.03, "hip joints are well inside the pelvis");
    OK(distance_in_stance(chest, shoulder) < 0.01, "shoulder joints are in the chest's side");
}

/* A waistband is pinned to the pelvis: the abdomen must not come out under it. */
static void test_waist(const Body *b) {
    const BodyPart *pelvis = part_of(b, ROLE_PELVIS), *spine = part_of(b, ROLE_SPINE);
    static const struct { Vec3 axis; double most; } bend[] = {
        {{1, 0, 0}, 25}, {{0, 0, 1}, 12.5}, {{0, 0, -1}, 12.5}, {{-1, 0, 0}, 12.5}};
    double worst = -INFINITY;
    for (int i = 0; i < 4; i++)
        for (double degrees = 0; degrees <= bend[i].most; degrees += 2.5) {
            Mat3 turn = mat_axis_angle(bend[i].axis, degrees * PI / 180);
            for (int j = 0; j < 60 * 48; j++) {
                Vec3 p = surface_point(spine, height_at(spine, (j / 48) / 59.0), 2 * PI * (j % 48) / 48, 1);
                p = vec_add(mat_apply(turn, p), spine->frame.t);
                if (p.y < 1.01) worst = max_of(worst, distance_in_stance(pelvis, p));
            }
        }
    OK(worst < -0.005, "below the waist a bending abdomen stays inside the pelvis (%.1f mm)", 1e3 * worst);
}

static double lowest(const Body *b, const BodyPart *part) {
    double y = INFINITY;
    for (int i = 0; i < part->nvertices; i++) y = min_of(y, b->skin.position[part->first_vertex + i].y);
    return y;
}

static void test_sizes(void) {
    static Body child, tall;
    Figure small = figure_of_height(1.10), large = figure_of_height(2.00);
    if (!OK(fit(&small, 16, &child) && fit(&large, 16, &tall), "a child and a tall adult fit")) return;
    const BodyPart *ch = part_of(&child, ROLE_HEAD), *th = part_of(&tall, ROLE_HEAD);
    double child_heads = 1.10 / (ch->high - ch->low), tall_heads = 2.00 / (th->high - th->low);
    OK(child_heads > 5 && child_heads < 6.2, "a child of 1.10 m is %.1f heads tall", child_heads);
    OK(tall_heads > 7.4 && tall_heads < 8.7, "a man of 2.00 m is %.1f heads tall", tall_heads);
    Section small_thigh = body_section(part_of(&child, ROLE_LEFT_THIGH), 0.5);
    Section large_thigh = body_section(part_of(&tall, ROLE_LEFT_THIGH), 0.5);
    NEAR(small_thigh.side / large_thigh.side, 0.55, 0.01, "thighs are as the heights");
    NEAR(box_of(&child).low.y, 0, 0.002, "the child stands on the floor");
    NEAR(box_of(&tall).low.y, 0, 0.003, "so does the tall adult");
    Figure high = figure_reference();
    for (int r = ROLE_LEFT_FOOT; r <= ROLE_RIGHT_FOOT; r += ROLE_RIGHT_FOOT - ROLE_LEFT_FOOT)
        high.start[r].y = high.end[r - 1].y = 0.105;
    static Body stilts;
    if (OK(fit(&high, 16, &stilts), "high ankles fit"))
        NEAR(lowest(&stilts, part_of(&stilts, ROLE_LEFT_FOOT)), 0, 0.004, "and their feet stand on the floor");
    Figure lanky = figure_reference();
    for (int r = ROLE_LEFT_FOREARM; r <= ROLE_RIGHT_FOREARM; r += ROLE_RIGHT_FOREARM - ROLE_LEFT_FOREARM)
        lanky.end[r] = vec_mad(lanky.end[r], vec_sub(lanky.end[r], lanky.start[r]), 0.5);
    static Body b;
    if (!OK(fit(&lanky, 16, &b), "long forearms fit")) return;
    double girth = body_section(part_of(&b, ROLE_LEFT_FOREARM), 0).side / 0.035;
    OK(girth > 1 && girth < 1.08, "a forearm half as long again is hardly thicker (%.3f)", girth);
    NEAR(part_of(&b, ROLE_LEFT_FOREARM)->length, 0.375, 1e-9, "but as long as its bone");
}

/* Rigs place hip joints 12 to 24 cm apart in bodies of the same width. */
static void test_hips(void) {
    for (int wide = 0; wide < 2; wide++) {
        static Body b;
        Figure f = figure_reference();
        double shift = (wide ? 0.12 : 0.06) - f.start[ROLE_LEFT_THIGH].x;
        for (int r = ROLE_LEFT_THIGH; r < ROLE_COUNT; r++) {
            double x = r < ROLE_RIGHT_THIGH ? shift : -shift;
            f.start[r].x += x;
            f.end[r].x += x;
        }
        const char *name = wide ? "wide" : "narrow";
        if (!OK(fit(&f, 16, &b), "%s hips fit", name)) continue;
        const BodyPart *thigh = part_of(&b, ROLE_LEFT_THIGH), *pelvis = part_of(&b, ROLE_PELVIS);
        double crossing = 0;
        for (double at = 0; at < 0.8; at += 0.05) {
            Section s = body_section(thigh, at);
            crossing = max_of(crossing, s.side - rigid_apply(thigh->frame, vec(s.x, 0, 0)).x);
        }
        OK(crossing < 0.002, "%s hips: the thighs do not run into each other (%.1f mm)", name, 1e3 * crossing);
        double most = 0;
        for (int k = 0; k < pelvis->nsections; k++) most = max_of(most, pelvis->section[k].side);
        OK(wide ? most > 0.185 && most < 0.21 : most > 0.15 && most < 0.165, "%s hips: the pelvis is %.3f m wide", name,
           2 * most);
        OK(distance_in_stance(pelvis, thigh->frame.t) < -0.02,
           "%s hips: the thigh begins inside the pelvis", name);
    }
}

/* And shoulders 20 to 42 cm apart: the arm's ball stays in touch with the chest. */
static void test_shoulders(void) {
    static const double half[] = {0.10, 0.17, 0.21};
    for (int i = 0; i < 3; i++) {
        static Body b;
        Figure f = figure_reference();
        double shift = half[i] - f.start[ROLE_LEFT_UPPER_ARM].x;
        for (int r = ROLE_LEFT_UPPER_ARM; r <= ROLE_RIGHT_HAND; r++) {
            if (r == ROLE_RIGHT_CLAVICLE) continue;
            double x = r < ROLE_RIGHT_CLAVICLE ? shift : -shift;
            f.start[r].x += x;
            f.end[r].x += x;
        }
        if (!OK(fit(&f, 16, &b), "shoulders %.0f cm apart fit", 200 * half[i])) continue;
        const BodyPart *chest = part_of(&b, ROLE_CHEST), *arm = part_of(&b, ROLE_LEFT_UPPER_ARM);
        Section top = body_section(arm, 0);
        Vec3 centre = rigid_apply(arm->frame, vec(top.x, 0, top.z));
        double gap = distance_in_stance(chest, centre);
        OK(gap < 0.5 * top.side, "shoulders %.0f cm apart: the arm begins in the chest (%.1f mm)", 200 * half[i],
           1e3 * gap);
    }
}

int main(void) {
    static Body reference;
    Figure f = figure_reference();
    if (OK(fit(&f, 16, &reference), "the reference fits")) {
        test_symmetry(&reference);
        test_adult(&reference);
        test_joints(&reference);
        test_waist(&reference);
    }
    test_sizes();
    test_hips();
    test_shoulders();
    arena_free(&arena);
    return tap_done();
}
