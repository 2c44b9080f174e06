/* Flesh that gives way: parts that press on each other leave room for cloth, and nothing else
   changes. */
#include <string.h>

#include "dice.h"
#include "scene.h"

/* The reference figure with both arms hanging so close that they press into the trunk. */
static Pose arms_down(const Scene *s, double degrees) {
    Pose p = figure_rest_pose();
    for (int side = 0; side < 2; side++) {
        Role arm = side ? ROLE_RIGHT_UPPER_ARM : ROLE_LEFT_UPPER_ARM;
        Mat3 turn = mat_axis_angle(vec(0, 0, 1), (side ? degrees : -degrees) * PI / 180);
        scene_turn(s, &p, arm, (Role)(arm + 2), turn);
    }
    return p;
}

static int part_of(const Scene *s, Role role) { return s->body.of_role[role]; }

static int contacts(const Scene *s) {
    int n = 0;
    for (int p = 0; p < s->body.nparts; p++) n += s->posed.contacts[p].n;
    return n;
}

/* Skin that nothing comes near stays where the body file has it. */
static void free_skin_stays(Scene *s) {
    Pose pose = arms_down(s, 45);
    body_frame_pose(&s->posed, &pose);
    double worst = 0;
    int stays = 0;
    for (int p = 0; p < s->body.nparts; p++)
        for (int k = 0; k < s->body.part[p].nvertices; k++) {
            int v = s->body.part[p].first_vertex + k;
            Vec3 rigid = rigid_apply(pose.bone[s->body.part[p].role], s->body.skin.position[v]);
            bool near = false;
            for (int q = 0; q < s->body.nparts; q++)
                near |= q != p &&
                        body_distance(&s->body.part[q], rigid_apply(s->posed.to_part[q], rigid), 1, NULL) < YIELD_ROOM;
            if (near) continue;
            stays++;
            worst = max_of(worst, vec_dist(s->posed.position[v], rigid));
        }
    OK(stays > 1000 && worst < 2e-6, "%d vertices that nothing is near to stay (%.2g m off)", stays, worst);
}

/* On the surface of a part that has given way the other one is a room away; points at random. */
static void room_is_made(Scene *s) {
    Pose pose = arms_down(s, 45);
    body_frame_pose(&s->posed, &pose);
    OK(contacts(s) > 0, "hanging arms press on the trunk");
    int arm = part_of(s, ROLE_LEFT_FOREARM), trunk = part_of(s, ROLE_PELVIS), asked = 0;
    double least = INFINITY;
    Box b = s->posed.box[arm];
    for (int k = 0; k < 200000; k++) {
        Vec3 r = dice_point();
        Vec3 p = vec(b.low.x + r.x * (b.high.x - b.low.x), b.low.y + r.y * (b.high.y - b.low.y),
                     b.low.z + r.z * (b.high.z - b.low.z));
        double x = body_frame_distance(&s->posed, arm, p, 1, NULL),
               y = body_frame_distance(&s->posed, trunk, p, 1, NULL);
        if (fabs(x) > 0.0005 || y > 0.03 || y < -0.02) continue;
        asked++;
        least = min_of(least, x + y);
    }
    OK(asked > 100 && least > YIELD_ROOM - 6e-4, "forearm and hip keep %.3f mm apart at %d points", 1e3 * least,
       asked);
}

/* How many edges with an end that gave way stand out of the surface by more than a millimetre in the middle. */
static int edges_stand_out(const Scene *s, int p, int *nedges) {
    const BodyPart *part = &s->body.part[p];
    int n = 0;
    for (int k = part->first_edge; k < part->first_edge + part->nedges; k++) {
        const int *v = s->body.skin.edge[k].v;
        if (s->posed.give[v[0]].by <= 0 && s->posed.give[v[1]].by <= 0) continue;
        Vec3 middle = vec_lerp(s->posed.position[v[0]], s->posed.position[v[1]], 0.5);
        n += body_frame_distance(&s->posed, p, middle, 1, NULL) > 1e-3;
        ++*nedges;
    }
    return n;
}

/* The skin that is drawn is the surface that is pushed against, or where that is hollow a little below it, so that the
   edges are not above it. */
static void skin_is_the_surface(Scene *s) {
    Pose pose = arms_down(s, 45);
    scene_leg(s, &pose, true, 100, 140);
    body_frame_pose(&s->posed, &pose);
    double worst = 0, below = 0, deepest = 0;
    int moved = 0, nedges = 0, out = 0;
    for (int p = 0; p < s->body.nparts; p++) {
        const BodyPart *part = &s->body.part[p];
        double most = 0;
        for (int k = 0; k < s->posed.contacts[p].n; k++) most = max_of(most, s->posed.contacts[p].contact[k].most);
        for (int v = part->first_vertex; v < part->first_vertex + part->nvertices; v++) {
            Vec3 rigid = rigid_apply(pose.bone[part->role], s->body.skin.position[v]);
            double by = vec_dist(rigid, s->posed.position[v]), sunk = s->posed.give[v].sunk;
            deepest = max_of(deepest, by - sunk - most);
            if (by < 1e-5) continue;
            moved++;
            double above = body_frame_distance(&s->posed, p, s->posed.position[v], 1, NULL);
            worst = max_of(worst, sunk > 0 ? above : fabs(above));
            below = max_of(below, -above);
        }
        out += edges_stand_out(s, p, &nedges);
    }
    OK(moved > 100, "%d vertices of the skin gave way", moved);
    OK(worst < 1e-3 && below < 0.017, "they lie on the surface, or below it for their edges (%.2g m off, %.2g below)",
       worst, below);
    OK(nedges > 300 && 20 * out < nedges, "of %d edges %d stand out", nedges, out);
    OK(deepest < 1e-5, "none gave way farther than its part may");
}

/* A contact is felt by both parts, in shares that add up to the whole. */
static void shares(void) {
    for (int a = 0; a < ROLE_COUNT; a++)
        for (int b = 0; b < ROLE_COUNT; b++) {
            if (a == b || !yield_concerns((Role)a, (Role)b)) continue;
            Contact x, y;
            yield_contact((Role)a, (Role)b, 1, &x, &y);
            if (fabs(x.share + y.share - 1) > 1e-15 || x.joined != y.joined || !yield_concerns((Role)b, (Role)a)) {
                OK(false, "%s and %s do not agree", role_name((Role)a), role_name((Role)b));
                return;
            }
        }
    OK(true, "both sides of every contact agree");
    OK(!yield_concerns(ROLE_SPINE, ROLE_CHEST) && !yield_concerns(ROLE_LEFT_SHIN, ROLE_LEFT_FOOT),
       "the trunk is one, so is an ankle");
    OK(yield_concerns(ROLE_HEAD, ROLE_CHEST) && !yield_concerns(ROLE_HEAD, ROLE_NECK) &&
           !yield_concerns(ROLE_PELVIS, ROLE_CHEST),
       "of the trunk only a bowed head and the chest do");
    OK(yield_concerns(ROLE_LEFT_THIGH, ROLE_LEFT_SHIN) && yield_concerns(ROLE_LEFT_THIGH, ROLE_RIGHT_THIGH),
       "calf and thigh press on each other, so do both thighs");
}

static Vec3 direction(void) {
    return vec_unit_or(vec(dice_unit() - 0.5, dice_unit() - 0.5, dice_unit() - 0.5), vec(1, 0, 0));
}

/* The cheap question is answered with no only where nothing is given way, though the normal is known roughly. */
static void no_means_no(void) {
    int asked = 0, no = 0, wrong = 0;
    for (int a = 0; a < ROLE_COUNT; a++)
        for (int b = 0; b < ROLE_COUNT; b++) {
            Contact x, y;
            if (a == b || !yield_concerns((Role)a, (Role)b)) continue;
            yield_contact((Role)a, (Role)b, 1, &x, &y);
            for (int k = 0; k < 300; k++, asked++) {
                Vec3 n = direction(), away = direction(), rough = vec_unit_or(vec_mad(n, direction(), 0.1), n);
                if (yield_may(&x, rough, away)) continue;
                no++;
                Meeting m = {vec(0, 0, 0), -0.05 * dice_unit(), -0.05 * dice_unit(), n, away};
                wrong += yield_by(&x, YIELD_ROOM, &m) > 0;
            }
        }
    OK(no > 1000 && no < asked && wrong == 0, "parts give way nowhere that they may not (%d of %d)", no, asked);
}

/* Two parts with plane surfaces: what is left of the one's distance at a point. */
typedef struct { Contact contact; Vec3 normal, away; double distance, other; } Planes;

static double left_at(const Planes *p, Vec3 at, Meeting *m) {
    *m = (Meeting){at, p->distance + vec_dot(p->normal, at), p->other + vec_dot(p->away, at), p->normal, p->away};
    return m->distance + yield_by(&p->contact, YIELD_ROOM, m);
}

static Vec3 slope_at(const Planes *p, Vec3 at, double step) {
    Meeting m;
    double x = left_at(p, vec_add(at, vec(step, 0, 0)), &m), y = left_at(p, vec_add(at, vec(0, step, 0)), &m);
    double z = left_at(p, vec_add(at, vec(0, 0, step)), &m), here = left_at(p, at, &m);
    return vec_scale(vec(x - here, y - here, z - here), 1 / step);
}

/* Where a part gives way its normal is the way in which what is left of its distance grows. */
static void normals_are_slopes(void) {
    int tried = 0, capped = 0, folded = 0;
    double worst = 0;
    for (int k = 0; k < 40000; k++) {
        Planes p = {.normal = direction(), .away = direction(), .distance = 0.02 * (dice_unit() - 0.8),
                    .other = 0.02 * (dice_unit() - 0.8)};
        Contact other;
        bool bends = k % 2;
        Role a = bends ? ROLE_LEFT_THIGH : ROLE_LEFT_HAND, b = bends ? ROLE_LEFT_SHIN : ROLE_PELVIS;
        yield_contact(a, b, 1, &p.contact, &other);
        Fold fold = {ROLE_LEFT_SHIN, dice_unit(), vec_scale(direction(), 0.05), direction(), direction(), 0.05, 0.07};
        fold.inwards = vec_unit_or(vec_cross(fold.inwards, fold.across), vec(1, 0, 0));
        if (bends) yield_fold(&fold, &p.contact, &other);
        Vec3 at = vec_scale(direction(), 0.01), there = slope_at(&p, at, 1e-8), back = slope_at(&p, at, -1e-8);
        Meeting m;
        double by = left_at(&p, at, &m) - m.distance;
        if (by <= 0 || vec_dist(there, back) > 1e-5 || vec_len(there) < 0.01) continue; /* an edge, or no way out */
        tried++;
        capped += by >= p.contact.soft * (1 - 1e-12);
        folded += p.contact.fold != NULL;
        worst = max_of(worst, vec_dist(vec_unit_or(there, at), yield_normal(&p.contact, YIELD_ROOM, &m)));
    }
    OK(worst < 1e-4 && capped > 100 && folded > 100 && tried - capped - folded > 100,
       "normals are slopes (off by %.2g in %d places, %d of them at the most, %d in a fold)", worst, tried, capped,
       folded);
}

/* It is a function of the pose that has no jumps: a degree more never moves the skin by a centimetre. */
static void no_jumps(Scene *s) {
    Arena arena = {0};
    Error e = {0};
    int n = s->body.skin.nvertices;
    Vec3 *last = ARENA_NEW(&arena, Vec3, n, &e);
    int jumps = 0;
    for (int k = 0; last && k <= 90; k++) {
        Pose pose = arms_down(s, 20 + 0.25 * k);
        body_frame_pose(&s->posed, &pose);
        for (int v = 0; v < n; v++) {
            double by = k > 0 ? vec_dist(last[v], s->posed.position[v]) : 0;
            last[v] = s->posed.position[v];
            jumps += by > 0.008;
        }
    }
    OK(jumps <= 90, "a quarter of a degree moves hardly any vertex by 8 mm (%d times in 90 steps)", jumps);
    arena_free(&arena);
}

/* A knee that folds: thigh and calf end at the plane that halves the bend, with the room for cloth between. */
static void folds_flat(Scene *s) {
    for (double bend = 130; bend <= 140; bend += 10) {
        Pose pose = figure_rest_pose();
        scene_leg(s, &pose, true, 100, bend);
        body_frame_pose(&s->posed, &pose);
        Vec3 knee = rigid_apply(pose.bone[ROLE_LEFT_SHIN], s->figure.start[ROLE_LEFT_SHIN]);
        int flat = 0;
        double least = INFINITY;
        for (int side = 0; side < 2; side++) {
            Role role = side ? ROLE_LEFT_SHIN : ROLE_LEFT_THIGH;
            Vec3 along = mat_column(pose.bone[role].r, 1), up = mat_column(pose.bone[ROLE_LEFT_THIGH].r, 1);
            Vec3 down = vec_scale(mat_column(pose.bone[ROLE_LEFT_SHIN].r, 1), -1);
            Vec3 across = vec_unit_or(side ? vec_sub(down, up) : vec_sub(up, down), along);
            Vec3 inwards = vec_unit_or(vec_add(up, down), along);
            const BodyPart *part = &s->body.part[part_of(s, role)];
            for (int v = part->first_vertex; v < part->first_vertex + part->nvertices; v++) {
                Vec3 skin = rigid_apply(pose.bone[role], s->body.skin.position[v]), now = s->posed.position[v];
                Vec3 r = vec_sub(now, knee);
                double in = vec_dot(r, inwards);
                if (in < 0.075 || in > 0.12 || vec_dist(skin, now) < 0.002) continue;
                flat++;
                least = min_of(least, vec_dot(r, across));
            }
        }
        OK(flat > 10 && least > 0.5 * YIELD_ROOM - 1e-3, "a knee bent by %.0f: %d vertices %.2f mm before the plane",
           bend, flat, 1e3 * least);
    }
}

/* The skin stays in the box that tells whether a garment is near, and far from it nobody gets boxes. */
static void boxes_hold_the_skin(Scene *s) {
    Pose pose = arms_down(s, 45);
    int out = 0, boxes = 0;
    scene_leg(s, &pose, true, 100, 140);
    body_frame_pose(&s->posed, &pose);
    for (int p = 0; p < s->body.nparts; p++) {
        const BodyPart *part = &s->body.part[p];
        Box b = s->posed.skin[p], above = {vec(-1, 9, -1), vec(1, 10, 1)};
        for (int v = part->first_vertex; v < part->first_vertex + part->nvertices; v++) {
            Box grown = b;
            box_add(&grown, s->posed.position[v]);
            out += memcmp(&grown, &b, sizeof b) != 0;
        }
        boxes += body_frame_edges(&s->posed, p, above) != NULL;
    }
    OK(out == 0 && boxes == 0, "skin is where its boxes say (%d vertices are not)", out);
}

/* The middles of all bones in one place. */
static void none_is_left_out(Scene *s) {
    Pose heap = figure_rest_pose();
    int missing = 0, most = 0;
    for (int r = 0; r < ROLE_COUNT; r++)
        heap.bone[r].t = vec_scale(vec_mid(s->figure.start[r], s->figure.end[r]), -1);
    body_frame_pose(&s->posed, &heap);
    for (int p = 0; p < s->body.nparts; p++) {
        int others = 0, n = s->posed.contacts[p].n;
        for (int q = 0; q < s->body.nparts; q++) others += yield_concerns(s->body.part[p].role, s->body.part[q].role);
        missing += others - n;
        most = n > most ? n : most;
    }
    OK(most > 12 && missing == 0, "in a heap each part meets all that it may, up to %d (%d are missing)", most,
       missing);
}

int main(void) {
    Scene s;
    scene_open(&s, "skirt");
    shares();
    no_means_no();
    normals_are_slopes();
    free_skin_stays(&s);
    room_is_made(&s);
    skin_is_the_surface(&s);
    no_jumps(&s);
    folds_flat(&s);
    boxes_hold_the_skin(&s);
    none_is_left_out(&s);
    arena_free(&s.arena);
    return tap_done();
}
