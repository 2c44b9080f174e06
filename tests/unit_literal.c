/* The paper's method to the letter: a flat patch that a leg sticks through, with motions whose
   outcome can be told beforehand; counts against the classification; and that testing without
   culling finds what testing with it finds. */
#include "dress/literal.h"
#include "scene.h"

static Dresser *dress(Scene *s, Method method, SplitRule split) {
    return scene_dresser(s, (DressOptions){.method = method, .split = split, .detail = 4});
}

/* The left thigh and all below it raised to the front. */
static Pose raised(const Scene *s, double degrees) {
    Pose p = figure_rest_pose();
    scene_leg(s, &p, true, degrees, 0);
    return p;
}

static FrameStats frame(Dresser *d, Scene *s, Pose pose, Tie tie, Mesh *mesh) {
    return scene_frame(s, d, &pose, 1 / 30.0, tie, mesh);
}

static long long collider_edges(const Scene *s) {
    static const Role role[] = {ROLE_PELVIS, ROLE_LEFT_THIGH, ROLE_RIGHT_THIGH, ROLE_LEFT_SHIN, ROLE_RIGHT_SHIN};
    long long n = 0;
    for (int k = 0; k < 5; k++) n += s->body.part[s->body.of_role[role[k]]].nedges;
    return n;
}

static void counts_are_the_papers(Scene *s) {
    Mesh mesh;
    long long facet_pairs = 2 * 4 * 4 * collider_edges(s);
    FrameStats u = frame(dress(s, METHOD_PAPER, SPLIT_UNIFORM), s, raised(s, 60), TIE_AFRESH, &mesh);
    FrameStats a = frame(dress(s, METHOD_PAPER, SPLIT_ADAPTIVE), s, raised(s, 60), TIE_AFRESH, &mesh);
    FrameStats rest = frame(dress(s, METHOD_PAPER, SPLIT_ADAPTIVE), s, figure_rest_pose(), TIE_AFRESH, &mesh);
    OK(u.nodes == 32 && u.leaves == 32 && u.tests == 32 * facet_pairs, "uniform: 32 patches, all pairs of each");
    OK(a.nodes > 2 && a.leaves == 2 + 3 * (a.nodes - 2) / 4, "adaptive: a split makes four of one (%d nodes)", a.nodes);
    OK(a.tests == a.nodes * facet_pairs, "adaptive: all pairs of every patch ever made");
    OK(rest.nodes == 2 && rest.leaves == 2 && rest.tests == 2 * facet_pairs, "no contact: two patches");
    OK(rest.displacement == 0 && rest.active == 0 && !rest.capped, "and nothing moves");
}

static void rules_agree(Scene *s) {
    Mesh mesh;
    Dresser *ours = dress(s, METHOD_PUSH, SPLIT_ADAPTIVE), *paper = dress(s, METHOD_PAPER, SPLIT_ADAPTIVE);
    bool same = true;
    for (int degrees = 0; degrees <= 80; degrees += 5) {
        FrameStats a = frame(ours, s, raised(s, degrees), TIE_AFRESH, &mesh);
        FrameStats b = frame(paper, s, raised(s, degrees), TIE_AFRESH, &mesh);
        same = same && a.hits_before == b.hits_before;
        if (a.nodes == b.nodes) same = same && a.tests == b.tests;
    }
    OK(same, "equations (2) to (4) and the exact test find the same pairs on the root patches");
}

/* A leg on its way up pushes the cloth before it; on its way down it pulls it in. */
static void the_leg_pushes_where_it_goes(Scene *s) {
    Mesh mesh;
    Dresser *d = dress(s, METHOD_PAPER, SPLIT_ADAPTIVE);
    frame(d, s, raised(s, 26), TIE_AFRESH, &mesh);
    FrameStats up = frame(d, s, raised(s, 30), TIE_GOES_ON, &mesh);
    OK(up.hits_before > 0 && !up.capped && up.displacement > 0, "a rising leg pushes the cloth out (%.1f cm, %d steps)",
       100 * up.displacement, up.sweeps);
    FrameStats far = frame(d, s, raised(s, 60), TIE_GOES_ON, &mesh);
    OK(far.capped && far.sweeps == 40, "as far as the cap allows");
    FrameStats still = frame(d, s, raised(s, 60), TIE_GOES_ON, &mesh);
    OK(still.capped && still.displacement == 0, "a leg at rest has no direction: hits stay");
    FrameStats first = frame(d, s, raised(s, 60), TIE_AFRESH, &mesh);
    OK(first.capped && first.displacement == 0 && first.residual_edges > 0, "nor has the first frame; it is told");
    FrameStats down = frame(d, s, raised(s, 55), TIE_GOES_ON, &mesh);
    OK(down.hits_before > 0 && down.residual_edges + down.residual_cloth + down.inside > 0,
       "a falling leg pulls the cloth in: it still shows");
    OK(down.sweeps <= 40 && down.displacement <= 40 * 0.005 + 1e-9, "never beyond the cap");
}

/* Nothing has a direction in a frame that is astray; behind it the direction is that of the motion without it. */
static void astray_has_no_direction(Scene *s) {
    Mesh mesh;
    Dresser *plain = dress(s, METHOD_PAPER, SPLIT_ADAPTIVE), *other = dress(s, METHOD_PAPER, SPLIT_ADAPTIVE);
    frame(plain, s, raised(s, 26), TIE_AFRESH, &mesh);
    frame(other, s, raised(s, 26), TIE_AFRESH, &mesh);
    FrameStats astray = frame(other, s, raised(s, 60), TIE_ASTRAY, &mesh);
    FrameStats back = frame(other, s, raised(s, 30), TIE_GOES_ON, &mesh);
    FrameStats up = frame(plain, s, raised(s, 30), TIE_GOES_ON, &mesh);
    OK(astray.capped && astray.displacement == 0, "a frame that is astray has no direction");
    OK(up.displacement > 0 && back.sweeps == up.sweeps && back.displacement == up.displacement &&
           back.residual_edges == up.residual_edges && back.capped == up.capped,
       "the next one has that from the last frame in front of it");
}

/* Every leaf is a piece of its own, on the surface where it did not move. */
static void the_mesh_is_in_pieces(Scene *s) {
    Mesh mesh;
    FrameStats stats = frame(dress(s, METHOD_PAPER, SPLIT_ADAPTIVE), s, raised(s, 60), TIE_AFRESH, &mesh);
    int n = stats.leaves;
    OK(mesh.nvertices == n * 25 && mesh.ntriangles == n * 32 && mesh.nedges == n * 56,
       "a piece of 25 vertices, 32 triangles and 56 edges for each of %d leaves", n);
    Mesh again = mesh;
    need(s, mesh_find_edges(&again, &s->arena, &s->error));
    OK(again.nedges == mesh.nedges, "its edges are those of its triangles");
    bool in_order = true, outward = true;
    for (int k = 0; k < mesh.nedges; k++) in_order = in_order && mesh.edge[k].v[0] < mesh.edge[k].v[1];
    for (int t = 0; t < mesh.ntriangles; t++) {
        const int *v = mesh.triangle[t].v;
        Vec3 a = mesh.position[v[0]], b = mesh.position[v[1]], c = mesh.position[v[2]];
        Vec3 normal = vec_cross(vec_sub(b, a), vec_sub(c, a));
        for (int k = 0; k < 3; k++) outward = outward && vec_dot(normal, mesh.normal[v[k]]) > 0;
    }
    OK(in_order && outward, "normals and triangles look the same way");
    int sum = 0;
    for (int g = 0; g < mesh.ngroups; g++) sum += mesh.group[g].count;
    OK(mesh.ngroups == 2 && sum == mesh.ntriangles, "its triangles are in the garment's groups");
}

static void the_global_shape_stays(Scene *s) {
    Mesh mesh;
    Dresser *d = dress(s, METHOD_GLOBAL, SPLIT_ADAPTIVE);
    FrameStats a = frame(d, s, raised(s, 60), TIE_AFRESH, &mesh);
    FrameStats b = frame(d, s, raised(s, 60), TIE_GOES_ON, &mesh);
    OK(a.displacement == 0 && a.residual_edges > 0 && a.sweeps == 0, "without local deformation the leg shows");
    OK(a.residual_edges == b.residual_edges && a.cells == b.cells, "nothing is carried");
}

static void plain_tests_find_the_same(Scene *s) {
    Pose pose = raised(s, 60);
    body_frame_pose(&s->posed, &pose);
    enum { MOST = 1 << 16 };
    Crossing *one = ARENA_NEW(&s->arena, Crossing, MOST, &s->error),
             *other = ARENA_NEW(&s->arena, Crossing, MOST, &s->error);
    need(s, one && other);
    CrossingCount culled = {0}, plain = {0};
    int pairs = 0, found = 0, extra = 0;
    for (int p = 0; p < s->body.nparts; p++)
        for (int q = 0; q < s->body.nparts; q++) {
            const CrossingSet *edges = body_frame_edges(&s->posed, p, box_all());
            const CrossingSet *triangles = body_frame_triangles(&s->posed, q, box_all());
            int n = crossing_find(edges, triangles, one, MOST, &culled);
            int m = crossing_find_plainly(edges, triangles, other, MOST, &plain);
            pairs += n;
            extra += m - n;
            for (int k = 0; k < n && p != q; k++)
                for (int i = 0; i < m; i++)
                    found += one[k].edge == other[i].edge && one[k].triangle == other[i].triangle;
            if (p == q) found += n; /* a part's own edges all touch: the count will do */
        }
    OK(pairs > 1000 && extra == 0 && found == pairs, "with and without culling: the same %d pairs", pairs);
    OK(culled.hits == plain.hits, "all of them counted");
    OK(plain.pairs_tested == plain.pairs_all && plain.pairs_all == culled.pairs_all, "without culling all are tested");
    OK(culled.pairs_tested < culled.pairs_all, "with it not");
}

int main(void) {
    Scene scene, *s = &scene;
    scene_open(s, "paper-skirt");
    counts_are_the_papers(s);
    rules_agree(s);
    the_leg_pushes_where_it_goes(s);
    astray_has_no_direction(s);
    the_mesh_is_in_pieces(s);
    the_global_shape_stays(s);
    plain_tests_find_the_same(s);
    arena_free(&s->arena);
    return tap_done();
}
