/* The body: closed shells, and one surface for skin, patches and distance. */
#include <stdlib.h>
#include <string.h>

#include "bodies.h"
#include "dice.h"

/* --- shells --- */

static double signed_volume(const Mesh *m, int first, int count) {
    double six = 0;
    for (int i = first; i < first + count; i++) {
        const int *v = m->triangle[i].v;
        six += vec_dot(m->position[v[0]], vec_cross(m->position[v[1]], m->position[v[2]]));
    }
    return six / 6;
}

static Vec3 facet_normal(const Mesh *m, int triangle) {
    const int *v = m->triangle[triangle].v;
    Vec3 p = m->position[v[0]];
    return vec_cross(vec_sub(m->position[v[1]], p), vec_sub(m->position[v[2]], p));
}

/* Every directed edge once, its opposite once too, no vertex of another part, no area of zero. */
static bool is_closed_shell(const Body *b, const BodyPart *part) {
    const Mesh *m = &b->skin;
    int n = part->nvertices, bad = 0;
    unsigned char *seen = calloc((size_t)n * (size_t)n, 1);
    for (int i = part->first_triangle; i < part->first_triangle + part->ntriangles; i++) {
        const int *v = m->triangle[i].v;
        for (int k = 0; k < 3; k++) {
            int from = v[k] - part->first_vertex, to = v[(k + 1) % 3] - part->first_vertex;
            if (from < 0 || from >= n || to < 0 || to >= n || seen[from * n + to]++) bad++;
        }
        if (vec_len(facet_normal(m, i)) < 1e-7 * b->scale * b->scale) bad++;
    }
    int edges = 0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            edges += i < j && seen[i * n + j];
            if (seen[i * n + j] != seen[j * n + i]) bad++;
        }
    free(seen);
    for (int i = part->first_edge; i < part->first_edge + part->nedges; i++)
        for (int k = 0; k < 2; k++) {
            int v = m->edge[i].v[k] - part->first_vertex;
            if (v < 0 || v >= n) bad++;
        }
    return bad == 0 && edges == part->nedges && n - edges + part->ntriangles == 2;
}

static void test_shells(int detail) {
    static Body b;
    Figure f = figure_reference();
    if (!OK(fit(&f, detail, &b), "detail %d fits the reference figure", detail)) return;
    int closed = 0, positive = 0, outward = 0, triangles = 0, edges = 0;
    for (int i = 0; i < b.nparts; i++) {
        const BodyPart *part = &b.part[i];
        closed += is_closed_shell(&b, part);
        positive += signed_volume(&b.skin, part->first_triangle, part->ntriangles) > 0;
        triangles += part->ntriangles;
        edges += part->nedges;
        bool good = true;
        for (int k = part->first_triangle; k < part->first_triangle + part->ntriangles; k++)
            for (int c = 0; c < 3; c++)
                good &= vec_dot(facet_normal(&b.skin, k), b.skin.normal[b.skin.triangle[k].v[c]]) > 0;
        outward += good;
    }
    OK(closed == b.nparts, "detail %d: %d of %d parts are closed, no triangle is degenerate", detail, closed,
       b.nparts);
    OK(positive == b.nparts, "detail %d: every shell has its inside inside", detail);
    OK(outward == b.nparts, "detail %d: vertex normals agree with their triangles", detail);
    OK(triangles == b.skin.ntriangles && edges == b.skin.nedges, "detail %d: the parts are the whole skin", detail);
    OK(b.skin.ngroups == b.nparts && strcmp(b.skin.group[0].name, "pelvis") == 0,
       "detail %d: groups carry role names", detail);
}

/* --- one surface --- */

static void test_distance(const Body *b) {
    double worst_vertex = 0, worst_patch = 0, worst_offset = 0, worst_gradient = 0, worst_unit = 0;
    int wrong_sign = 0;
    for (int i = 0; i < b->nparts; i++) {
        const BodyPart *part = &b->part[i];
        for (int k = part->first_vertex; k < part->first_vertex + part->nvertices; k++) {
            double d = distance_in_stance(part, b->skin.position[k]);
            worst_vertex = max_of(worst_vertex, fabs(d) / part->reach);
        }
        for (int k = 0; k < 2000; k++) {
            double y = height_at(part, 0.02 + 0.96 * dice_unit()), phi = 2 * PI * dice_unit();
            Vec3 p = surface_point(part, y, phi, 1), n;
            wrong_sign += distance(part, surface_point(part, y, phi, 1.001)) <= 0;
            wrong_sign += distance(part, surface_point(part, y, phi, 0.999)) >= 0;
            body_distance(part, p, INFINITY, &n);
            worst_unit = max_of(worst_unit, fabs(vec_len(n) - 1));
            double h = 1e-6, offset = 1e-4;
            Vec3 g = vec(distance(part, vec(p.x + h, p.y, p.z)) - distance(part, vec(p.x - h, p.y, p.z)),
                         distance(part, vec(p.x, p.y + h, p.z)) - distance(part, vec(p.x, p.y - h, p.z)),
                         distance(part, vec(p.x, p.y, p.z + h)) - distance(part, vec(p.x, p.y, p.z - h)));
            worst_gradient = max_of(worst_gradient, vec_dist(vec_scale(g, 0.5 / h), n));
            worst_offset = max_of(worst_offset, fabs(distance(part, vec_mad(p, n, offset)) / offset - 1));
        }
    }
    const Patch *patch = b->patch;
    for (int i = 0; i < b->nparts; i++)
        for (int row = 0; row + 1 < b->part[i].nsections; row++)
            for (int quarter = 0; quarter < 4; quarter++, patch++)
                for (int k = 0; k < 20; k++) {
                    double u = dice_unit(), w = dice_unit();
                    Vec3 p = rigid_unapply(b->part[i].frame, bezier_point(patch, u, w, NULL, NULL));
                    worst_patch = max_of(worst_patch, fabs(distance(&b->part[i], p)) / b->part[i].reach);
                }
    OK(worst_vertex < 3e-4, "skin vertices lie on the surface of the distance (%.2g of the radius)", worst_vertex);
    OK(worst_patch < 3e-4, "points of the patches do too (%.2g)", worst_patch);
    OK(wrong_sign == 0, "the sign is right a thousandth of the radius in and out (%d wrong)", wrong_sign);
    OK(worst_unit < 1e-12, "normals are unit vectors (%.2g)", worst_unit);
    OK(worst_gradient < 1e-3, "the normal is the gradient on the surface (%.2g)", worst_gradient);
    OK(worst_offset < 0.05, "0.1 mm out along the normal is 0.1 mm (%.2g)", worst_offset);
}

/* Against the distance to a fine cloud of surface points. */
static void test_bounds(const Body *b) {
    enum { ROUND = 64, ALONG = 96 };
    static Vec3 cloud[ROUND * ALONG];
    const double far = 0.03;
    int too_long = 0, too_near = 0, over = 0, checked = 0;
    for (int i = 0; i < b->nparts; i++) {
        const BodyPart *part = &b->part[i];
        for (int j = 0; j < ALONG; j++)
            for (int k = 0; k < ROUND; k++)
                cloud[j * ROUND + k] = surface_point(part, height_at(part, j / (ALONG - 1.0)), 2 * PI * k / ROUND, 1);
        for (int k = 0; k < 400; k++) {
            Vec3 p = vec((dice_unit() - 0.5) * 3 * part->reach, height_at(part, 1.4 * dice_unit() - 0.2),
                         (dice_unit() - 0.5) * 3 * part->reach);
            double truth = INFINITY, d = body_distance(part, p, far, NULL), whole = distance(part, p);
            for (int j = 0; j < ROUND * ALONG; j++) truth = min_of(truth, vec_dist(p, cloud[j]));
            if (whole <= 0) continue;
            checked++;
            too_long += d > far && d > truth;       /* a bound that is no bound */
            too_near += d < far && fabs(d - whole) > 1e-12;
            over += truth < far && whole > 1.5 * truth;
        }
    }
    OK(too_long == 0, "values beyond far are lower bounds (%d of %d are not)", too_long, checked);
    OK(too_near == 0, "far does not change what is nearer");
    OK(over == 0, "within 3 cm the estimate is never more than half too long (%d of %d are)", over, checked);
    Vec3 n = {0, 0, 0};
    const BodyPart *thigh = part_of(b, ROLE_LEFT_THIGH);
    double above = body_distance(thigh, vec(0, thigh->low - 0.05, thigh->section[0].z), INFINITY, &n);
    NEAR(above, 0.05, 0.002, "5 cm above the pole is 5 cm away");
    OK(n.y < -0.98, "and the way out is up (%.3f)", n.y);
    Vec3 pole = vec(thigh->section[0].x, thigh->low, thigh->section[0].z);
    OK(isfinite(body_distance(thigh, pole, INFINITY, &n)) && vec_finite(n),
       "the pole itself has a distance and a normal");
    Section middle = body_section(thigh, 0.5);
    NEAR(body_distance(thigh, vec(middle.x, 0.5 * thigh->length, middle.z), INFINITY, &n),
         -fmin(middle.side, fmin(middle.front, middle.back)), 0.003, "on the axis the depth is the smaller half size");
}

/* Many points at a time, with any vectors, get the very numbers that each gets alone: round a part, on its axis, far
   above its end, and whatever stands beside them. */
static void test_many(const Body *b) {
    enum { N = 500 };
    static const double reaches[] = {0, 0.04, INFINITY};
    Vec3 p[N], normal[N], up;
    double distance[N];
    for (Vectors v = VECTORS_BEST; v < VECTORS_COUNT; v++) {
        int wrong = 0;
        if (!vectors_usable(v)) continue;
        for (int i = 0; i < b->nparts; i++) {
            const BodyPart *part = &b->part[i];
            Rigid to_part = rigid_inverse(part->frame);
            for (int k = 0; k < N; k++) {
                double width = k % 10 == 0 ? 0 : 2 * part->reach * dice_unit();
                double phi = 2 * PI * dice_unit(), at = 1.4 * dice_unit() - 0.2;
                Vec3 in_part = vec(width * sin(phi), height_at(part, k % 3 ? at : 0.1 * at), width * cos(phi));
                p[k] = rigid_apply(part->frame, in_part);
            }
            for (int r = 0; r < 3; r++) {
                body_distances(part, v, &to_part, p, N, reaches[r], distance, normal);
                for (int k = 0; k < N; k++) {
                    double alone = body_distance(part, rigid_apply(to_part, p[k]), reaches[r], &up);
                    wrong += distance[k] != fmin(alone, reaches[r]);
                    wrong += alone < reaches[r] && vec_dist(up, normal[k]) != 0;
                }
            }
        }
        OK(wrong == 0, "many points are measured as each alone, vectors %d (%d differ)", v, wrong);
    }
}

/* A point that is asked again, nearer and farther, answers as one that is asked for the first time. */
static void test_looks(const Body *b) {
    static const double reaches[] = {0.01, 0, INFINITY, 0.04, 0.01};
    int wrong = 0;
    for (int k = 0; k < 20000; k++) {
        const BodyPart *part = &b->part[k % b->nparts];
        double width = 1.5 * part->reach * dice_unit(), phi = 2 * PI * dice_unit();
        BodyLook look = {.p = vec(width * sin(phi), height_at(part, 1.2 * dice_unit() - 0.1), width * cos(phi))};
        for (int r = 0; r < 5; r++) {
            Vec3 n = {0, 0, 0}, again = {0, 0, 0};
            wrong += body_distance(part, look.p, reaches[r], &n) != body_look(part, &look, reaches[r], &again);
            wrong += vec_dist(n, again) != 0;
        }
    }
    OK(wrong == 0, "a point that is asked again answers the same (%d differ)", wrong);
}

static void test_patches(const Body *b) {
    const Patch *patch = b->patch;
    int open_rows = 0, open_sides = 0, inward = 0;
    for (int i = 0; i < b->nparts; i++)
        for (int row = 0; row + 1 < b->part[i].nsections; row++, patch += 4)
            for (int q = 0; q < 4; q++) {
                const Patch *here = &patch[q], *beside = &patch[(q + 1) % 4], *above = here + 4;
                for (int k = 0; k < 4; k++) {
                    open_sides += memcmp(&here->p[3][k], &beside->p[0][k], sizeof(Vec3)) != 0;
                    if (row + 2 < b->part[i].nsections)
                        open_rows += memcmp(&here->p[k][3], &above->p[k][0], sizeof(Vec3)) != 0;
                }
                Vec3 p = bezier_point(here, 0.5, 0.5, NULL, NULL), n;
                body_distance(&b->part[i], rigid_unapply(b->part[i].frame, p), INFINITY, &n);
                inward += vec_dot(bezier_normal(here, 0.5, 0.5), mat_apply(b->part[i].frame.r, n)) < 0.999;
            }
    OK(patch == b->patch + b->npatches, "four patches between two sections");
    OK(open_rows == 0, "rows of patches share their control points to the bit");
    OK(open_sides == 0, "quarters share their control points to the bit");
    OK(inward == 0, "du x dw is the outward normal");
}

static bool between(double x, double a, double b) { return x >= fmin(a, b) - 1e-12 && x <= fmax(a, b) + 1e-12; }

/* Between two sections every value stays between theirs. */
static void test_monotone(const Body *b) {
    int outside = 0;
    for (int i = 0; i < b->nparts; i++)
        for (int k = 0; k + 1 < b->part[i].nsections; k++)
            for (int j = 0; j <= 20; j++) {
                Section low = b->part[i].section[k], high = b->part[i].section[k + 1];
                Section s = body_section_at(&b->part[i], low.at + (high.at - low.at) * j / 20);
                outside += !between(s.x, low.x, high.x) || !between(s.z, low.z, high.z) ||
                           !between(s.side, low.side, high.side) || !between(s.front, low.front, high.front) ||
                           !between(s.back, low.back, high.back);
            }
    OK(outside == 0, "sections are joined without overshoot");
}

static void test_pose(const Body *b) {
    Pose pose;
    for (int r = 0; r < ROLE_COUNT; r++) pose.bone[r] = rigid_identity();
    pose.bone[ROLE_HEAD] = (Rigid){mat_axis_angle(vec(0, 1, 0), PI / 2), {0, 0, 1}};
    Error e = {0};
    Vec3 *p = ARENA_NEW(&arena, Vec3, b->skin.nvertices, &e), *n = ARENA_NEW(&arena, Vec3, b->skin.nvertices, &e);
    if (!OK(p && n, "room for a pose")) return;
    body_pose(b, &pose, p, n);
    const BodyPart *head = part_of(b, ROLE_HEAD);
    int moved = 0, wrong = 0;
    for (int i = 0; i < b->skin.nvertices; i++) {
        bool in_head = i >= head->first_vertex && i < head->first_vertex + head->nvertices;
        Vec3 at = b->skin.position[i], was = b->skin.normal[i];
        if (in_head) at = vec(at.z, at.y, 1 - at.x), was = vec(was.z, was.y, -was.x);
        moved += in_head;
        wrong += vec_dist(p[i], at) > 1e-12 || vec_dist(n[i], was) > 1e-12;
    }
    OK(moved > 100 && wrong == 0, "each part moves with its own bone");
    body_pose(b, &pose, p, NULL);
    OK(vec_finite(p[0]), "normals are optional");
}

static void test_failures(void) {
    static Body b;
    Figure f = figure_reference();
    Error e = {0};
    OK(!body_fit(body_default(), &f, 10, &arena, &b, &e) && e.kind == ERR_USAGE, "detail 10 is refused: %s", e.text);
    int survived = 0;
    for (int n = 1; n < 100; n++) {
        Arena small = {.fail_after = n};
        Error failed = {0};
        bool good = body_fit(body_default(), &f, 8, &small, &b, &failed);
        arena_free(&small);
        if (good) {
            OK(n > 4, "after %d allocations body_fit has all it needs", n - 1);
            break;
        }
        survived += failed.kind == ERR_INTERNAL;
    }
    OK(survived > 4, "each failing allocation is an internal error (%d tried)", survived);
}

int main(void) {
    static Body reference;
    Figure f = figure_reference();
    test_shells(8);
    test_shells(16);
    test_shells(32);
    if (OK(fit(&f, 16, &reference), "the reference fits")) {
        test_distance(&reference);
        test_bounds(&reference);
        test_many(&reference);
        test_looks(&reference);
        test_patches(&reference);
        test_monotone(&reference);
        test_pose(&reference);
    }
    test_failures();
    arena_free(&arena);
    return tap_done();
}
