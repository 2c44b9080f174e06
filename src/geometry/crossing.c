/* Most pairs are far apart; the art is not to look at them.

   Items are boxed in tiles of sixteen (geometry/tile) in the order in which they come, their tiles are tiled again,
   and these once more. A search goes down both hierarchies at once and enters only pairs of tiles whose boxes
   overlap. Nothing is sorted or balanced, so building is one pass over the items.

   Of the pairs whose own boxes overlap, most still have both ends of the edge on one side of the triangle's plane,
   farther from it than doubles can err. The few that are left are decided exactly, by predicate_segment_triangle. */
#include "geometry/crossing.h"

#include <float.h>

#include "geometry/predicate.h"

enum { LANES = TILE_LANES, TOP = CROSSING_LEVELS - 1 };

static int lowest(unsigned lanes) { return __builtin_ctz(lanes); }
static int tiles(int n) { return n / LANES + (n % LANES != 0); }

bool crossing_reserve(CrossingSet *set, int capacity, Arena *arena, Error *e) {
    *set = (CrossingSet){.capacity = capacity};
    for (int l = 0, n = tiles(capacity); l <= TOP; l++, n = tiles(n)) {
        set->level[l] = ARENA_NEW(arena, Tile, n, e);
        if (!set->level[l]) return false;
    }
    return true;
}

/* --- building --- */

static int top_tiles(const CrossingSet *set) {
    int n = set->count;
    for (int l = 0; l <= TOP; l++) n = tiles(n);
    return n;
}

static float reach_of(const CrossingSet *set) {
    float reach = 0;
    for (int t = 0; t < top_tiles(set); t++)
        for (int x = 0; x < 3; x++)
            for (int k = 0; k < LANES; k++) {
                float low = set->level[TOP][t].low[x][k], high = set->level[TOP][t].high[x][k];
                if (low <= high) reach = fmaxf(reach, fmaxf(-low, high));
            }
    return reach;
}

Box crossing_box(const CrossingSet *set) {
    Box box = box_empty();
    for (int t = 0; t < top_tiles(set); t++)
        for (int k = 0; k < LANES; k++) {
            const Tile *top = &set->level[TOP][t];
            if (top->low[0][k] > top->high[0][k]) continue;
            box_add(&box, vec(top->low[0][k], top->low[1][k], top->low[2][k]));
            box_add(&box, vec(top->high[0][k], top->high[1][k], top->high[2][k]));
        }
    return box;
}

static void build(CrossingSet *set, const Vec3 *position, const int *index, int n, int corners, TileBoxes *boxes) {
    set->position = position;
    set->index = index;
    set->count = n;
    for (int t = 0, left = n; left > 0; t++, left -= LANES) {
        const int *first = index + (size_t)t * LANES * (size_t)corners;
        boxes(&set->level[0][t], position, first, left < LANES ? left : LANES, &set->level[1][t / LANES], t % LANES);
    }
    for (int l = 1; l <= TOP; l++) {
        n = tiles(n);
        if (n % LANES) tile_empty(&set->level[l][n / LANES], n % LANES);
        for (int t = 0; l < TOP && t < tiles(n); t++)
            tile_sum(&set->level[l][t], &set->level[l + 1][t / LANES], t % LANES);
    }
    set->reach = reach_of(set);
}

void crossing_build_edges(CrossingSet *set, const Vec3 *position, const Edge *edge, int n) {
    build(set, position, (const int *)edge, n, 2, tile_machine(set->vectors)->segments);
}

void crossing_build_triangles(CrossingSet *set, const Vec3 *position, const Triangle *triangle, int n) {
    build(set, position, (const int *)triangle, n, 3, tile_machine(set->vectors)->triangles);
}

/* --- the plane --- */

/* n (x - origin) is the volume under x. Its error is at most 54 u size^2 |x - origin|, u = 2^-53
   (see predicate.c: nine roundings of six products); `slack` is more than that for any x in reach. */
typedef struct { Vec3 origin, n; double slack; } Plane;

static Plane plane_of(const CrossingSet *triangles, int triangle, double reach) {
    const int *i = triangles->index + 3 * (size_t)triangle;
    Vec3 a = triangles->position[i[0]];
    Vec3 u = vec_sub(triangles->position[i[1]], a), v = vec_sub(triangles->position[i[2]], a);
    double size = larger(vec_extent(u), vec_extent(v));
    return (Plane){a, vec_cross(u, v), 0x1p-47 * size * size * 2 * reach + DBL_MIN};
}

/* Are both on one side of the plane, for certain? */
static bool are_beside(const Plane *plane, Vec3 p, Vec3 q) {
    double a = vec_dot(plane->n, vec_sub(p, plane->origin)), b = vec_dot(plane->n, vec_sub(q, plane->origin));
    return (a > plane->slack && b > plane->slack) || (a < -plane->slack && b < -plane->slack);
}

/* --- searching --- */

typedef struct {
    const CrossingSet *edges, *triangles;
    const TileMachine *machine;
    double reach;
    Crossing *out;
    int capacity, written;
    CrossingCount *count;
} Search;

static Search search_of(const CrossingSet *edges, const CrossingSet *triangles, Crossing *out, int capacity,
                        CrossingCount *count) {
    return (Search){edges, triangles, tile_machine(edges->vectors), fmaxf(edges->reach, triangles->reach),
                    .out = out, .capacity = capacity, .count = count};
}

static void decide(Search *s, int edge, int triangle, const Plane *plane) {
    const int *i = s->edges->index + 2 * (size_t)edge, *j = s->triangles->index + 3 * (size_t)triangle;
    const Vec3 *v = s->edges->position, *w = s->triangles->position;
    Vec3 p = v[i[0]], q = v[i[1]];
    if (are_beside(plane, p, q)) return;
    if (!predicate_segment_triangle(p, q, w[j[0]], w[j[1]], w[j[2]])) return;
    s->count->hits++;
    if (s->written < s->capacity) s->out[s->written++] = (Crossing){edge, triangle};
}

/* The lanes `edges` of edge tile i against one triangle: all their boxes overlap. */
static void search_triangle(Search *s, int i, unsigned edges, int triangle) {
    Plane plane = plane_of(s->triangles, triangle, s->reach);
    s->count->pairs_tested += __builtin_popcount(edges);
    for (; edges; edges &= edges - 1) decide(s, i * LANES + lowest(edges), triangle, &plane);
}

/* Tile i of the edges at this level against the lanes `triangles` of tile j of the triangles. */
static void search_tiles(Search *s, int level, int i, int j, TileLanes triangles) {
    const Tile *e = &s->edges->level[level][i], *t = &s->triangles->level[level][j];
    TileLanes row[LANES];
    for (unsigned left = s->machine->meet(e, t, triangles, row); left; left &= left - 1) {
        int k = lowest(left), below = j * LANES + k;
        if (level == 0) {
            search_triangle(s, i, row[k], below);
            continue;
        }
        for (unsigned edges = row[k]; edges; edges &= edges - 1) {
            int m = lowest(edges);
            TileLanes inner = s->machine->overlap(&s->triangles->level[level - 1][below], e, m);
            if (inner) search_tiles(s, level - 1, i * LANES + m, below, inner);
        }
    }
}

int crossing_find(const CrossingSet *edges, const CrossingSet *triangles, Crossing *out, int capacity,
                  CrossingCount *count) {
    Search s = search_of(edges, triangles, out, capacity, count);
    count->pairs_all += (long long)edges->count * triangles->count;
    for (int i = 0; i < top_tiles(edges); i++)
        for (int j = 0; j < top_tiles(triangles); j++) search_tiles(&s, TOP, i, j, 0xFFFF);
    return s.written;
}

/* --- without culling --- */

/* Both ends of sixteen segments, and a plane n x = w so long that |nx| + |ny| + |nz| <= 1; n is
   zero where the triangle has none. */
typedef struct { _Alignas(64) float p[3][LANES], q[3][LANES]; } Ends;
typedef struct { float n[3], w; } FloatPlane;

/* Lanes beyond the last item repeat it; their boxes overlap nothing. */
static void gather_ends(const CrossingSet *edges, int tile, Ends *out) {
    for (int k = 0; k < LANES; k++) {
        int item = tile * LANES + k < edges->count ? tile * LANES + k : edges->count - 1;
        const int *i = edges->index + 2 * (size_t)item;
        Vec3 p = edges->position[i[0]], q = edges->position[i[1]];
        out->p[0][k] = (float)p.x, out->p[1][k] = (float)p.y, out->p[2][k] = (float)p.z;
        out->q[0][k] = (float)q.x, out->q[1][k] = (float)q.y, out->q[2][k] = (float)q.z;
    }
}

/* The normal is divided by the sum of the magnitudes of all products in it, of which it is at
   most the whole: then its error is a few roundings however thin the triangle. */
static FloatPlane float_plane(const CrossingSet *triangles, int triangle) {
    const int *i = triangles->index + 3 * (size_t)triangle;
    Vec3 a = triangles->position[i[0]];
    Vec3 p = vec_sub(triangles->position[i[1]], a), q = vec_sub(triangles->position[i[2]], a);
    double yz = p.y * q.z, zy = p.z * q.y, zx = p.z * q.x, xz = p.x * q.z, xy = p.x * q.y, yx = p.y * q.x;
    double sum = fabs(yz) + fabs(zy) + fabs(zx) + fabs(xz) + fabs(xy) + fabs(yx);
    Vec3 n = vec_scale(vec(yz - zy, zx - xz, xy - yx), 1 / (sum + 1e-300));
    return (FloatPlane){{(float)n.x, (float)n.y, (float)n.z}, (float)vec_dot(n, a)};
}

/* The segments that may reach the plane: not both ends on one side, farther from it than slack. */
static unsigned reaching(const Ends *ends, const FloatPlane *plane, float slack) {
    static const int bit[LANES] = {1,   2,   4,    8,    16,   32,   64,    128,
                                   256, 512, 1024, 2048, 4096, 8192, 16384, 32768};
    const float(*p)[LANES] = ends->p, (*q)[LANES] = ends->q;
    float nx = plane->n[0], ny = plane->n[1], nz = plane->n[2], w = plane->w;
    int found = 0;
    for (int i = 0; i < LANES; i++) {
        float a = nx * p[0][i] + ny * p[1][i] + nz * p[2][i] - w;
        float b = nx * q[0][i] + ny * q[1][i] + nz * q[2][i] - w;
        bool above = (a < b ? a : b) > slack, below = (a > b ? a : b) < -slack;
        found += (above | below) ? 0 : bit[i];
    }
    return (unsigned)found;
}

/* Tiles first..first+n-1 of the edges, in `ends`, against every triangle. */
static void search_block(Search *s, const Ends *ends, int first, int n, float slack) {
    for (int triangle = 0; triangle < s->triangles->count; triangle++) {
        FloatPlane plane = float_plane(s->triangles, triangle);
        const Tile *box = &s->triangles->level[0][triangle / LANES];
        for (int i = 0; i < n; i++) {
            unsigned found = reaching(&ends[i], &plane, slack);
            if (found) found &= s->machine->overlap(&s->edges->level[0][first + i], box, triangle % LANES);
            if (!found) continue;
            Plane exact = plane_of(s->triangles, triangle, s->reach);
            for (; found; found &= found - 1) decide(s, (first + i) * LANES + lowest(found), triangle, &exact);
        }
    }
}

/* The slack: with u = 2^-24 and M the reach of both sets, |n|1 <= 1 makes n x of rounded n and
   rounded x, in three products and two sums, err by at most 6 u M, and w and the difference
   by 2 u M more; 16 u M is ample. FLT_MIN covers what underflows.

   Each triangle's plane meets sixteen segments at a time, all of them. The few that reach the plane
   have their boxes compared before they are decided, so that a pair costs about the same wherever the triangle is, and
   time measures the number of pairs. Segments come in blocks that fit into the first-level cache. */
int crossing_find_plainly(const CrossingSet *edges, const CrossingSet *triangles, Crossing *out, int capacity,
                          CrossingCount *count) {
    enum { BLOCK = 64 };
    Ends ends[BLOCK];
    Search s = search_of(edges, triangles, out, capacity, count);
    long long pairs = (long long)edges->count * triangles->count;
    float slack = 8 * FLT_EPSILON * (float)s.reach + FLT_MIN;
    count->pairs_all += pairs;
    count->pairs_tested += pairs;
    for (int first = 0, n = 0; first < tiles(edges->count); first += n) {
        for (n = 0; n < BLOCK && first + n < tiles(edges->count); n++) gather_ends(edges, first + n, &ends[n]);
        search_block(&s, ends, first, n, slack);
    }
    return s.written;
}
