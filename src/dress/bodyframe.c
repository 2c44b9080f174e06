/* Posing the body: vertices to the world and to the precision of the text, one box tree a part. */
#include "dress/bodyframe.h"

#include "base/clock.h"

bool body_frame_init(BodyFrame *f, const Body *body, double unit, Arena *arena, Error *e) {
    *f = (BodyFrame){.body = body, .unit = unit};
    f->position = ARENA_NEW(arena, Vec3, body->skin.nvertices, e);
    f->normal = ARENA_NEW(arena, Vec3, body->skin.nvertices, e);
    if (!f->position || !f->normal) return false;
    for (int p = 0; p < body->nparts; p++)
        if (!crossing_reserve(&f->edges[p], body->part[p].nedges, arena, e) ||
            !crossing_reserve(&f->triangles[p], body->part[p].ntriangles, arena, e))
            return false;
    return true;
}

/* Facets are chords of the skin, which bulges out of their box by less than this share of it. */
static const double BULGE = 0.02;

static void find_box(BodyFrame *f, int part) {
    const BodyPart *p = &f->body->part[part];
    Box b = box_empty();
    for (int v = p->first_vertex; v < p->first_vertex + p->nvertices; v++) box_add(&b, f->position[v]);
    Vec3 room = vec_scale(vec(1, 1, 1), BULGE * vec_dist(b.low, b.high));
    f->box[part] = (Box){vec_scale(vec_sub(b.low, room), 1 / f->unit), vec_scale(vec_add(b.high, room), 1 / f->unit)};
}

void body_frame_pose(BodyFrame *f, const Pose *pose) {
    double start = clock_seconds();
    const Body *b = f->body;
    f->pose = *pose;
    body_pose(b, pose, f->position, f->normal);
    for (int v = 0; v < b->skin.nvertices; v++) {
        Vec3 p = vec_scale(f->position[v], f->unit);
        f->position[v] = mesh_snap_point(p);
    }
    for (int p = 0; p < b->nparts; p++) {
        const BodyPart *part = &b->part[p];
        Rigid to_world = rigid_mul(pose->bone[part->role], part->frame);
        f->to_world[p] = to_world.r;
        f->to_part[p] = rigid_inverse(to_world);
        find_box(f, p);
        crossing_build_edges(&f->edges[p], f->position, b->skin.edge + part->first_edge, part->nedges);
        crossing_build_triangles(&f->triangles[p], f->position, b->skin.triangle + part->first_triangle,
                                 part->ntriangles);
    }
    f->seconds = clock_seconds() - start;
}

double body_frame_distance(const BodyFrame *f, int part, Vec3 p, double far, Vec3 *normal) {
    if (body_frame_far(f, part, p, far)) return far;
    double d = body_distance(&f->body->part[part], rigid_apply(f->to_part[part], p), far, normal);
    if (normal && d < far) *normal = mat_apply(f->to_world[part], *normal);
    return d;
}
