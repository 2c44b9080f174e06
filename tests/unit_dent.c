/* A hand comes to lie on a skirt and then sinks into the hip: cloth gives way as a hollow and not as a spike, while
   there is room; where there is none the hip wins, and the frame says so. */
#include <string.h>

#include "scene.h"

static int shows(const FrameStats *s) { return s->limb_edges + s->limb_cloth + s->limb_inside; }
static int own_shows(const FrameStats *s) { return s->residual_edges + s->residual_cloth + s->inside; }

static double longest_edge(const Mesh *m) {
    double longest = 0;
    for (int k = 0; k < m->nedges; k++)
        longest = max_of(longest, vec_dist(m->position[m->edge[k].v[0]], m->position[m->edge[k].v[1]]));
    return longest;
}

static void hand_on_cloth(const char *garment, double touches, double presses, double sinks) {
    Scene s;
    scene_open(&s, garment);
    DressOptions fixed = {.fixed_topology = true};
    Dresser *push = scene_dresser(&s, fixed);
    fixed.method = METHOD_GLOBAL;
    Dresser *global = scene_dresser(&s, fixed);
    for (int k = 0; k < 2; k++) {
        double degrees = k ? presses : touches;
        Pose pose = scene_reaching(&s, degrees);
        Mesh mesh;
        FrameStats without = scene_frame(&s, global, &pose, 0, TIE_AFRESH, &mesh);
        double plain = longest_edge(&mesh);
        FrameStats with = scene_frame(&s, push, &pose, 0, TIE_AFRESH, &mesh);
        OK(shows(&without) > 0, "%s: the hand is in the cloth at %g degrees", garment, degrees);
        OK(shows(&with) == 0 && own_shows(&with) == 0, "which gives way (%.0f mm)", 1000 * with.displacement);
        OK(longest_edge(&mesh) < 2 * plain, "and has no spike (%.1f mm, else %.1f)", 1000 * longest_edge(&mesh),
           1000 * plain);
        OK(with.pinched == 0, "there is room");
    }
    Pose pose = scene_reaching(&s, sinks);
    Mesh mesh;
    FrameStats with = scene_frame(&s, push, &pose, 0, TIE_AFRESH, &mesh);
    OK(shows(&with) > 0 && with.pinched > 0, "%s: at %g there is none, and %d vertices tell", garment, sinks,
       with.pinched);
    OK(own_shows(&with) == 0, "the hip wins");
    arena_free(&s.arena);
}

/* The most by which an edge is longer than without the hollow, as a factor. */
static double longest_stretch(const Mesh *m, const Vec3 *flat) {
    double most = 0;
    for (int k = 0; k < m->nedges; k++) {
        const int *v = m->edge[k].v;
        most = max_of(most, vec_dist(m->position[v[0]], m->position[v[1]]) / vec_dist(flat[v[0]], flat[v[1]]));
    }
    return most;
}

/* The lap of a skirt gives way by more than a hand is thick: a hollow with flanks, and as still as the arm. */
static void hand_between_knees(int facets) {
    enum { STEPS = 40 };
    static const double FROM = 33, BY = 0.05; /* degrees */
    Scene s;
    scene_open(&s, "skirt");
    DressOptions fixed = {.fixed_topology = true, .detail = facets};
    Dresser *push = scene_dresser(&s, fixed);
    fixed.method = METHOD_GLOBAL;
    Dresser *global = scene_dresser(&s, fixed);
    Vec3 *before = NULL, *flat = NULL;
    int shown = 0, own_shown = 0;
    double shallowest = INFINITY, jump = 0, stretch = 0;
    for (int k = 0; k < STEPS; k++) {
        Pose pose = scene_hand_in_lap(&s, FROM + k * BY);
        Mesh mesh;
        FrameStats without = scene_frame(&s, global, &pose, 0, TIE_AFRESH, &mesh);
        if (k == 0) {
            before = ARENA_NEW(&s.arena, Vec3, mesh.nvertices, &s.error);
            flat = ARENA_NEW(&s.arena, Vec3, mesh.nvertices, &s.error);
            need(&s, before && flat);
            OK(shows(&without) > 0, "a hand hangs into the lap of a skirt of %d x %d facets a patch", facets, facets);
        }
        memcpy(flat, mesh.position, (size_t)mesh.nvertices * sizeof *flat);
        FrameStats with = scene_frame(&s, push, &pose, 0, TIE_AFRESH, &mesh);
        shown += shows(&with) > 0;
        own_shown += own_shows(&with) > 0;
        shallowest = min_of(shallowest, with.displacement);
        stretch = max_of(stretch, longest_stretch(&mesh, flat));
        for (int v = 0; v < mesh.nvertices && k > 0; v++) jump = max_of(jump, vec_dist(mesh.position[v], before[v]));
        memcpy(before, mesh.position, (size_t)mesh.nvertices * sizeof *before);
    }
    OK(shown == 0 && own_shown == 0, "which gives way in all of %d poses (%d, %d)", STEPS, shown, own_shown);
    OK(shallowest > 0.1, "deeply (%.0f mm)", 1000 * shallowest);
    OK(stretch < 2, "its edges grow to no more than twice their length (%.2f)", stretch);
    OK(jump < 0.002, "and the arm's %.2f degrees move no place by two millimetres (%.1f mm)", BY, 1000 * jump);
    arena_free(&s.arena);
}

/* Wherever the arm is: if it shows, the frame says so, and legs and hips never show for it. */
static void hand_anywhere(void) {
    enum { STEPS = 35 };
    Scene s;
    scene_open(&s, "skirt");
    Dresser *push = scene_dresser(&s, (DressOptions){.fixed_topology = true});
    int shown = 0, told = 0, own_shown = 0;
    for (int k = 0; k < STEPS; k++) {
        Pose pose = scene_hand_in_lap(&s, 2 * k - 10);
        Mesh mesh;
        FrameStats with = scene_frame(&s, push, &pose, 0, TIE_AFRESH, &mesh);
        shown += shows(&with) > 0;
        told += shows(&with) > 0 && with.pinched > 0;
        own_shown += own_shows(&with) > 0;
    }
    OK(shown > 0 && shown < STEPS && told == shown, "an arm shows in %d of %d poses, %d of which say so", shown, STEPS,
       told);
    OK(own_shown == 0, "own parts in none (%d)", own_shown);
    arena_free(&s.arena);
}

/* All lengths of the method are measured by the height: half the figure has the same cloth, half as large. */
static void half_the_size(const char *garment) {
    static const double sizes[2] = {1, 0.5};
    static Scene scene[2];
    Dresser *dresser[2];
    Mesh mesh[2];
    double off = 0, moved = 0;
    for (int i = 0; i < 2; i++) {
        scene_open_sized(&scene[i], garment, sizes[i]);
        dresser[i] = scene_dresser(&scene[i], (DressOptions){.fixed_topology = true});
    }
    for (int k = 0; k < 5; k++) {
        FrameStats stats[2];
        for (int i = 0; i < 2; i++) {
            Pose pose = k < 2 ? scene_hand_in_lap(&scene[i], 33 + k) : scene_reaching(&scene[i], 37.5 + 2.5 * k);
            stats[i] = scene_frame(&scene[i], dresser[i], &pose, 1 / 30.0, k ? TIE_GOES_ON : TIE_AFRESH, &mesh[i]);
        }
        for (int v = 0; v < mesh[0].nvertices; v++)
            off = max_of(off, vec_dist(mesh[0].position[v], mesh[1].position[v]));
        moved = max_of(moved, stats[0].displacement);
    }
    OK(moved > 0.03 && off < 1e-9, "%s, half as large: moved by up to %.0f mm, %.2g m off", garment, 1000 * moved, off);
    for (int i = 0; i < 2; i++) arena_free(&scene[i].arena);
}

int main(void) {
    hand_on_cloth("skirt", 40, 42.5, 47.5);
    hand_on_cloth("trousers", 42.5, 45, 47.5);
    hand_between_knees(8);
    hand_between_knees(9);
    hand_anywhere();
    half_the_size("skirt");
    half_the_size("trousers");
    half_the_size("tshirt");
    return tap_done();
}
