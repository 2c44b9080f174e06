/* A hand comes to lie on a skirt and then sinks into the hip: cloth gives way as a hollow and not as a spike, while
   there is room; where there is none the hip wins, and the frame says so. */
#include "scene.h"

static int shows(const FrameStats *s) { return s->limb_edges + s->limb_cloth + s->limb_inside; }
static int own_shows(const FrameStats *s) { return s->residual_edges + s->residual_cloth + s->inside; }

static double longest_edge(const Mesh *m) {
    double longest = 0;
    for (int k = 0; k < m->nedges; k++)
        longest = fmax(longest, vec_dist(m->position[m->edge[k].v[0]], m->position[m->edge[k].v[1]]));
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

int main(void) {
    hand_on_cloth("skirt", 40, 42.5, 47.5);
    hand_on_cloth("trousers", 42.5, 45, 47.5);
    return tap_done();
}
