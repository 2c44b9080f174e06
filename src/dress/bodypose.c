/* Posing the body: its parts are moved to the world, their skin gives way to other parts that press on it
   (dress/flesh), and is rounded to the precision of the text. */
#include "dress/bodypose.h"

#include "dress/flesh.h"

/* Facets are chords of the surface, which bulges out of their box by less than this share of its diagonal. */
static const double BULGE = 0.02;

static void find_box(BodyFrame *f, int part) {
    const BodyPart *p = &f->body->part[part];
    Box b = box_empty(), *blocks = body_frame_blocks(f, part);
    for (int first = 0; first < p->nvertices; first += BODY_BLOCK) {
        Box *block = &blocks[first / BODY_BLOCK];
        *block = box_empty();
        for (int v = first; v < p->nvertices && v < first + BODY_BLOCK; v++)
            box_add(block, f->position[p->first_vertex + v]);
        box_add(&b, block->low);
        box_add(&b, block->high);
    }
    Vec3 room = vec_scale(vec(1, 1, 1), BULGE * vec_dist(b.low, b.high));
    f->box[part] = f->skin[part] = (Box){vec_sub(b.low, room), vec_add(b.high, room)};
}

void body_frame_pose(BodyFrame *f, const Pose *pose) {
    const Body *b = f->body;
    f->pose = *pose;
    body_pose(b, pose, f->position, NULL);
    for (int p = 0; p < b->nparts; p++) {
        const BodyPart *part = &b->part[p];
        Rigid to_world = rigid_mul(pose->bone[part->role], part->frame);
        f->to_world[p] = to_world.r;
        f->to_part[p] = rigid_inverse(to_world);
        find_box(f, p);
    }
    f->folds = folds_find(b, pose);
    flesh_press(f);
    mesh_snap_points(f->vectors, f->position, f->unit, b->skin.nvertices, f->position);
    f->boxes->made = 0;
}

void body_frame_normals(const BodyFrame *f) {
    for (int p = 0; p < f->body->nparts; p++) {
        const BodyPart *part = &f->body->part[p];
        for (int v = part->first_vertex; v < part->first_vertex + part->nvertices; v++)
            if (f->give[v].by <= 0) f->normal[v] = body_frame_rest_normal(f, part, v);
    }
}
