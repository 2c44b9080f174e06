/* Vertices that follow each other lie near each other: one box round sixteen of them leaves out most parts
   at once. A part that is far from where a vertex was stays far while the vertex moves a little, so what has
   been found is good until then. */
#include "dress/near.h"

#include "geometry/boxtree.h"

enum { BLOCK = 16 };

/* Parts whose boxes come nearer than `far` to any of n points: bits 1 << part. */
static unsigned parts_round(const BodyFrame *body, const Vec3 *point, int n, double far) {
    Box box = box_empty();
    for (int v = 0; v < n; v++) box_add(&box, point[v]);
    box = (Box){vec_sub(box.low, vec(far, far, far)), vec_add(box.high, vec(far, far, far))};
    unsigned parts = 0;
    for (int k = 0; k < body->body->nparts; k++)
        if (box_touches(box, body->box[k])) parts |= 1u << k;
    return parts;
}

static Near ask(const BodyFrame *body, unsigned parts, unsigned roles, Vec3 p, double far) {
    Near near = {.seen = p, .distance = far};
    for (int k = 0; parts >> k; k++) {
        if (!(parts >> k & 1) || !(roles & part_bit(body, k))) continue;
        double distance = body_frame_unpressed(body, k, p, far);
        if (distance >= far) continue;
        near.distance = fmin(near.distance, distance);
        near.parts |= 1u << k;
    }
    return near;
}

void near_find(Near *near, const BodyFrame *body, const Sheet *sheet, const Vec3 *point, double far, bool known) {
    const Lattice *l = sheet->lattice;
    for (int first = 0; first < sheet->nvertices; first += BLOCK) {
        int n = sheet->nvertices - first < BLOCK ? sheet->nvertices - first : BLOCK;
        unsigned parts = parts_round(body, point + first, n, far);
        for (int v = first; v < first + n; v++) {
            int place = sheet->place[v];
            if (known && vec_dist(point[v], near[v].seen) == 0) continue;
            near[v] = ask(body, parts, l->collide[place] | l->outside[place], point[v], far);
        }
    }
}

bool near_none(const Near *near, Vec3 p, double clearance) {
    double room = NEAR_LIPSCHITZ * (near->distance - clearance);
    return room > 0 && vec_dist(p, near->seen) < room;
}
