/* A binary tree: the triangles of a node are parted at the mean of their centres, along the axis
   in which the centres spread most. A search looks into a node only if its box touches.

   Where all centres coincide the node is halved by count, and at the largest depth a leaf takes
   whatever is left: bad input makes a slow tree, never a wrong one. */
#include "geometry/boxtree.h"

enum { LEAF = 6 };

typedef struct {
    BoxTree *tree;
    Box *box;   /* of each triangle, by place in item */
    int nnodes;
} Builder;

static double along(Vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/* Twice the centre; what matters is the order. */
static Vec3 centre(Box b) { return vec_add(b.low, b.high); }

static void swap_items(Builder *b, int i, int k) {
    int item = b->tree->item[i];
    Box box = b->box[i];
    b->tree->item[i] = b->tree->item[k];
    b->box[i] = b->box[k];
    b->tree->item[k] = item;
    b->box[k] = box;
}

/* Parts the items first..first+count-1; returns how many come to the left. */
static int part_items(Builder *b, int first, int count) {
    Box spread = box_empty();
    Vec3 sum = {0, 0, 0};
    for (int i = first; i < first + count; i++) {
        box_add(&spread, centre(b->box[i]));
        sum = vec_add(sum, centre(b->box[i]));
    }
    Vec3 size = vec_sub(spread.high, spread.low);
    int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    double middle = along(sum, axis) / count;
    int left = 0;
    for (int i = first; i < first + count; i++)
        if (along(centre(b->box[i]), axis) < middle) swap_items(b, i, first + left++);
    return left == 0 || left == count ? count / 2 : left;
}

static void build(Builder *b, int at, int first, int count, int depth) {
    BoxNode *node = &b->tree->node[at];
    node->box = box_empty();
    for (int i = first; i < first + count; i++) {
        box_add(&node->box, b->box[i].low);
        box_add(&node->box, b->box[i].high);
    }
    node->first = first;
    node->count = count;
    if (count <= LEAF || depth == BOXTREE_DEPTH) return;
    int left = part_items(b, first, count), child = b->nnodes;
    b->nnodes += 2;
    node->first = child;
    node->count = 0;
    build(b, child, first, left, depth + 1);
    build(b, child + 1, first + left, count - left, depth + 1);
}

bool boxtree_build(BoxTree *tree, const Vec3 *position, const Triangle *triangle, const int *item, int n,
                   Arena *arena, Error *e) {
    Builder b = {.tree = tree, .nnodes = 1};
    *tree = (BoxTree){.position = position, .triangle = triangle, .count = n};
    tree->item = ARENA_NEW(arena, int, n, e);
    tree->node = ARENA_NEW(arena, BoxNode, 2 * (size_t)n + 1, e);
    b.box = ARENA_NEW(arena, Box, n, e);
    if (!tree->item || !tree->node || !b.box) return false;
    for (int i = 0; i < n; i++) {
        tree->item[i] = item ? item[i] : i;
        b.box[i] = box_of_triangle(position, triangle[tree->item[i]]);
    }
    build(&b, 0, 0, n, 0);
    return true;
}

Box boxtree_box(const BoxTree *tree) { return tree->node[0].box; }

BoxWalk boxtree_walk(const BoxTree *tree, Box box) {
    BoxWalk w; /* its stack is left as it is: walks are many and short */
    w.tree = tree;
    w.box = box;
    w.at = w.end = 0;
    w.depth = 1;
    w.stack[0] = 0;
    return w;
}

int boxtree_next(BoxWalk *w) {
    const BoxTree *tree = w->tree;
    for (;;) {
        for (; w->at < w->end; w->at++) {
            int t = tree->item[w->at];
            if (box_touches(box_of_triangle(tree->position, tree->triangle[t]), w->box)) return w->at++, t;
        }
        if (w->depth == 0) return -1;
        const BoxNode *node = &tree->node[w->stack[--w->depth]];
        if (!box_touches(node->box, w->box)) continue;
        w->at = node->first;
        w->end = node->first + node->count;
        if (node->count > 0 || tree->count == 0) continue;
        w->at = w->end = 0;
        w->stack[w->depth++] = node->first + 1;
        w->stack[w->depth++] = node->first;
    }
}

/* --- nearest --- */

static Vec3 segment_point(Vec3 p, Vec3 a, Vec3 b) {
    Vec3 d = vec_sub(b, a);
    double dd = vec_dot(d, d);
    return dd > 0 ? vec_mad(a, d, clamp(vec_dot(vec_sub(p, a), d) / dd, 0, 1)) : a;
}

static double distance2(Vec3 a, Vec3 b) { return vec_dot(vec_sub(a, b), vec_sub(a, b)); }

/* Squared; 0 inside the box. */
static double box_distance2(Box b, Vec3 p) {
    Vec3 inside = vec(clamp(p.x, b.low.x, b.high.x), clamp(p.y, b.low.y, b.high.y), clamp(p.z, b.low.z, b.high.z));
    return distance2(p, inside);
}

/* The foot of the perpendicular, if it stands on the triangle; else a point of a side. */
Vec3 boxtree_triangle_point(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
    Vec3 ab = vec_sub(b, a), bc = vec_sub(c, b), ca = vec_sub(a, c), n = vec_cross(ab, vec_sub(c, a));
    double nn = vec_dot(n, n);
    if (nn > 0 && vec_dot(vec_cross(n, ab), vec_sub(p, a)) >= 0 && vec_dot(vec_cross(n, bc), vec_sub(p, b)) >= 0 &&
        vec_dot(vec_cross(n, ca), vec_sub(p, c)) >= 0)
        return vec_mad(p, n, vec_dot(vec_sub(a, p), n) / nn);
    Vec3 best = segment_point(p, a, b), other = segment_point(p, b, c);
    if (distance2(p, other) < distance2(p, best)) best = other;
    other = segment_point(p, c, a);
    return distance2(p, other) < distance2(p, best) ? other : best;
}

typedef struct { const BoxTree *tree; Vec3 p, point; double least; int triangle; } Nearest;

static void look_into(Nearest *s, int at) {
    const BoxTree *tree = s->tree;
    const BoxNode *node = &tree->node[at];
    for (int i = node->first; i < node->first + node->count; i++) {
        Triangle t = tree->triangle[tree->item[i]];
        const Vec3 *v = tree->position;
        Vec3 q = boxtree_triangle_point(s->p, v[t.v[0]], v[t.v[1]], v[t.v[2]]);
        double d = distance2(s->p, q);
        if (d < s->least) s->least = d, s->point = q, s->triangle = tree->item[i];
    }
    if (node->count > 0 || tree->count == 0) return;
    double d[2];
    for (int k = 0; k < 2; k++) d[k] = box_distance2(tree->node[node->first + k].box, s->p);
    int near = d[1] < d[0];
    if (d[near] < s->least) look_into(s, node->first + near);
    if (d[!near] < s->least) look_into(s, node->first + !near);
}

double boxtree_nearest(const BoxTree *tree, Vec3 p, int *triangle, Vec3 *point) {
    Nearest s = {.tree = tree, .p = p, .least = INFINITY, .triangle = -1};
    look_into(&s, 0);
    if (s.triangle < 0) return INFINITY;
    if (triangle) *triangle = s.triangle;
    if (point) *point = s.point;
    return sqrt(s.least);
}
