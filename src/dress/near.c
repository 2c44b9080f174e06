/* Vertices that follow each other in the sheet are near each other in space. So one box round sixteen of them rules out
   most parts at once, and each part that is left is asked about many vertices in one call. */
#include "dress/near.h"

#include "geometry/boxtree.h"

enum { BLOCK = 16, LOT = 16 * BLOCK };

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

/* Vertices that are asked about in one call, block by block: where each block begins and ends, and the parts near its
   box. */
typedef struct {
    int nblocks, first[LOT / BLOCK + 1], vertex[LOT];
    unsigned parts[LOT / BLOCK], any;
} Lot;

/* Asks one part about the vertices of a lot that it may be near to. */
static void ask(Near *near, const BodyFrame *body, int part, const Vec3 *point, const Lot *lot, double far) {
    int vertex[LOT], n = 0;
    Vec3 at[LOT];
    double distance[LOT];
    for (int block = 0; block < lot->nblocks; block++) {
        if (!(lot->parts[block] >> part & 1)) continue;
        for (int k = lot->first[block]; k < lot->first[block + 1]; k++) {
            int v = lot->vertex[k];
            if (body_frame_far(body, part, point[v], far)) continue;
            at[n] = point[v];
            vertex[n++] = v;
        }
    }
    if (n == 0) return;
    body_frame_unpressed_many(body, part, at, n, far, distance, NULL);
    for (int k = 0; k < n; k++) {
        Near *of = &near[vertex[k]];
        if (distance[k] >= far) continue;
        of->parts |= 1u << part;
        of->distance[part] = (float)distance[k];
        of->least = fminf(of->least, of->distance[part]);
    }
}

/* Puts the vertices first..end-1 into the lot, all or (known) those that have moved since they were seen, and forgets
   what is known of them. */
static void add_block(Lot *lot, Near *near, const BodyFrame *body, const Vec3 *point, int first, int end, double far,
                      bool known) {
    int start = lot->first[lot->nblocks], n = start;
    for (int v = first; v < end; v++) {
        if (known && vec_dist(point[v], near[v].seen) == 0) continue;
        near[v].seen = point[v];
        near[v].parts = 0;
        near[v].least = (float)far;
        lot->vertex[n++] = v;
    }
    if (n == start) return;
    unsigned parts = parts_round(body, point + first, end - first, far);
    lot->parts[lot->nblocks++] = parts;
    lot->first[lot->nblocks] = n;
    lot->any |= parts;
}

void near_find(Near *near, const BodyFrame *body, const Sheet *sheet, const Vec3 *point, double far, bool known) {
    for (int first = 0; first < sheet->nvertices;) {
        Lot lot;
        lot.nblocks = lot.first[0] = 0;
        lot.any = 0;
        for (; first < sheet->nvertices && lot.nblocks < LOT / BLOCK; first += BLOCK) {
            int end = first + BLOCK < sheet->nvertices ? first + BLOCK : sheet->nvertices;
            add_block(&lot, near, body, point, first, end, far, known);
        }
        for (int part = 0; lot.any >> part; part++)
            if (lot.any >> part & 1) ask(near, body, part, point, &lot, far);
    }
}

void near_sum(Near *near, double far) {
    near->least = (float)far;
    for (unsigned left = near->parts; left; left &= left - 1)
        near->least = fminf(near->least, near->distance[near_first(left)]);
}

unsigned near_parts(const Near *near, const BodyFrame *body, unsigned roles) {
    unsigned parts = 0;
    for (unsigned left = near->parts; left; left &= left - 1)
        if (roles & part_bit(body, near_first(left))) parts |= 1u << near_first(left);
    return parts;
}

bool near_clear(const Near *near, Vec3 p) { return vec_dist(p, near->seen) < 0.5 * near->least; }

void near_move(Near *near, Vec3 p) {
    float gone = (float)(vec_dist(p, near->seen) / NEAR_LIPSCHITZ);
    for (unsigned left = near->parts; left; left &= left - 1) near->distance[near_first(left)] -= gone;
    near->least -= gone;
    near->seen = p;
}
