/* Most pairs are far apart, so the work is to not look at them.

   Sixteen boxes that stand side by side in arrays make a tile: one loop tests a box against all
   sixteen, and the compiler turns that loop into a few vector instructions. Items are tiled in
   the order they come, tiles are tiled again, and so once more; a search goes down both stacks
   at once and enters only pairs of tiles whose boxes overlap. No tree is balanced and nothing
   is sorted, so building is one pass over the vertices.

   Boxes are floats. Rounding keeps order: if x <= y then (float)x <= (float)y, so rounded boxes
   of things that touch still touch, and the count of overlapping boxes is the same everywhere.

   Pairs whose boxes overlap meet one more sieve of sixteen lanes: both ends of the edge on one
   side of the triangle's plane, further from it than floats can err. The few that are left are
   decided exactly, by predicate_segment_triangle. */
#include "geometry/crossing.h"

#include <float.h>
#include <stdint.h>

#include "geometry/predicate.h"

enum { LANES = 16, LEVELS = CROSSING_LEVELS };

struct CrossingTile { float low[3][LANES], high[3][LANES]; };

/* Of segments the two ends. Of triangles the plane n x = w, scaled so that no part of n is
   larger than 1; zero if there is none. */
struct CrossingItem {
    float v[6][LANES];
};

static int tiles(int n) { return n / LANES + (n % LANES != 0); }

bool crossing_reserve(CrossingSet *set, int capacity, Arena *arena, Error *e) {
    *set = (CrossingSet){.capacity = capacity};
    int n = capacity;
    for (int l = 0; l < LEVELS; l++) {
        n = tiles(n);
        set->level[l] = ARENA_NEW(arena, CrossingTile, n, e);
        if (!set->level[l]) return false;
    }
    set->item = ARENA_NEW(arena, CrossingItem, tiles(capacity), e);
    return set->item != NULL;
}

static void tile_clear(CrossingTile *t, int from) {
    for (int x = 0; x < 3; x++)
        for (int k = from; k < LANES; k++) t->low[x][k] = INFINITY, t->high[x][k] = -INFINITY;
}

static float least(const float v[LANES]) {
    float m = v[0];
    for (int k = 1; k < LANES; k++) m = v[k] < m ? v[k] : m;
    return m;
}
static float most(const float v[LANES]) {
    float m = v[0];
    for (int k = 1; k < LANES; k++) m = v[k] > m ? v[k] : m;
    return m;
}

static void build_levels(CrossingSet *set) {
    int n = tiles(set->count);
    for (int l = 1; l < LEVELS; l++) {
        for (int t = 0; t < n; t++) {
            CrossingTile *up = &set->level[l][t / LANES];
            const CrossingTile *down = &set->level[l - 1][t];
            for (int x = 0; x < 3; x++) {
                up->low[x][t % LANES] = least(down->low[x]);
                up->high[x][t % LANES] = most(down->high[x]);
            }
        }
        if (n % LANES) tile_clear(&set->level[l][n / LANES], n % LANES);
        n = tiles(n);
    }
    set->reach = 0;
    for (int t = 0; t < n; t++)
        for (int x = 0; x < 3; x++) {
            float a = -least(set->level[LEVELS - 1][t].low[x]), b = most(set->level[LEVELS - 1][t].high[x]);
            if (a > set->reach) set->reach = a;
            if (b > set->reach) set->reach = b;
        }
}

void crossing_build_edges(CrossingSet *set, const Vec3 *position, const Edge *edge, int n) {
    set->count = n;
    set->position = position;
    set->index = n ? edge[0].v : NULL;
    set->corners = 2;
    for (int t = 0; t < tiles(n); t++) {
        CrossingTile *box = &set->level[0][t];
        CrossingItem *item = &set->item[t];
        int here = n - t * LANES < LANES ? n - t * LANES : LANES;
        for (int k = 0; k < here; k++) {
            Vec3 a = position[edge[t * LANES + k].v[0]], b = position[edge[t * LANES + k].v[1]];
            item->v[0][k] = (float)a.x, item->v[1][k] = (float)a.y, item->v[2][k] = (float)a.z;
            item->v[3][k] = (float)b.x, item->v[4][k] = (float)b.y, item->v[5][k] = (float)b.z;
        }
        for (int x = 0; x < 3; x++)
            for (int k = 0; k < LANES; k++) {
                float a = item->v[x][k], b = item->v[x + 3][k];
                box->low[x][k] = a < b ? a : b;
                box->high[x][k] = a > b ? a : b;
            }
        tile_clear(box, here);
    }
    build_levels(set);
}

static float least3(double a, double b, double c) { double m = a < b ? a : b; return (float)(m < c ? m : c); }
static float most3(double a, double b, double c) { double m = a > b ? a : b; return (float)(m > c ? m : c); }

/* normal and w */
static void plane_of(Vec3 a, Vec3 b, Vec3 c, CrossingItem *item, int k) {
    Vec3 p = vec_sub(b, a), q = vec_sub(c, a);
    double yz = p.y * q.z, zy = p.z * q.y, zx = p.z * q.x, xz = p.x * q.z, xy = p.x * q.y, yx = p.y * q.x;
    double size = fabs(yz) + fabs(zy) + fabs(zx) + fabs(xz) + fabs(xy) + fabs(yx);
    double scale = size > 0 ? 1 / size : 0;
    Vec3 n = vec((yz - zy) * scale, (zx - xz) * scale, (xy - yx) * scale);
    item->v[0][k] = (float)n.x, item->v[1][k] = (float)n.y, item->v[2][k] = (float)n.z;
    item->v[3][k] = (float)vec_dot(n, a);
}

void crossing_build_triangles(CrossingSet *set, const Vec3 *position, const Triangle *triangle, int n) {
    set->count = n;
    set->position = position;
    set->index = n ? triangle[0].v : NULL;
    set->corners = 3;
    for (int t = 0; t < tiles(n); t++) {
        CrossingTile *box = &set->level[0][t];
        int here = n - t * LANES < LANES ? n - t * LANES : LANES;
        for (int k = 0; k < here; k++) {
            const int *v = triangle[t * LANES + k].v;
            Vec3 a = position[v[0]], b = position[v[1]], c = position[v[2]];
            box->low[0][k] = least3(a.x, b.x, c.x), box->high[0][k] = most3(a.x, b.x, c.x);
            box->low[1][k] = least3(a.y, b.y, c.y), box->high[1][k] = most3(a.y, b.y, c.y);
            box->low[2][k] = least3(a.z, b.z, c.z), box->high[2][k] = most3(a.z, b.z, c.z);
            plane_of(a, b, c, &set->item[t], k);
        }
        tile_clear(box, here);
    }
    build_levels(set);
}

static const unsigned LANE[LANES] = {1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768};

/* One bit per lane of `t` whose box overlaps the box of lane k of `u`. */
static unsigned overlaps(const CrossingTile *t, const CrossingTile *u, int k) {
    float lx = u->low[0][k], ly = u->low[1][k], lz = u->low[2][k];
    float hx = u->high[0][k], hy = u->high[1][k], hz = u->high[2][k];
    unsigned mask = 0;
    for (int i = 0; i < LANES; i++) {
        bool over = (t->low[0][i] <= hx) & (t->high[0][i] >= lx) & (t->low[1][i] <= hy) & (t->high[1][i] >= ly)
                  & (t->low[2][i] <= hz) & (t->high[2][i] >= lz);
        mask |= over ? LANE[i] : 0;
    }
    return mask;
}

/* One bit per segment that may reach the plane of triangle k. */
static unsigned straddles(const CrossingItem *s, const CrossingItem *t, int k, float slack) {
    float nx = t->v[0][k], ny = t->v[1][k], nz = t->v[2][k], w = t->v[3][k];
    unsigned mask = 0;
    for (int i = 0; i < LANES; i++) {
        float a = nx * s->v[0][i] + ny * s->v[1][i] + nz * s->v[2][i] - w;
        float b = nx * s->v[3][i] + ny * s->v[4][i] + nz * s->v[5][i] - w;
        bool apart = ((a > slack) & (b > slack)) | ((a < -slack) & (b < -slack));
        mask |= apart ? 0 : LANE[i];
    }
    return mask;
}

typedef struct {
    const CrossingSet *edges, *triangles;
    Crossing *out;
    int capacity, written;
    float slack;
    bool any;
    CrossingCount *count;
} Search;

static int first_lane(unsigned mask) { return __builtin_ctz(mask); }

static bool decide(Search *s, int e, int t) {
    const int *i = s->edges->index + 2 * e, *j = s->triangles->index + 3 * t;
    const Vec3 *p = s->edges->position, *q = s->triangles->position;
    if (!predicate_segment_triangle(p[i[0]], p[i[1]], q[j[0]], q[j[1]], q[j[2]])) return false;
    s->count->hits++;
    if (s->written < s->capacity) s->out[s->written++] = (Crossing){e, t};
    return s->any;
}

static bool search_items(Search *s, int i, int j, unsigned triangles) {
    const CrossingTile *e = &s->edges->level[0][i], *t = &s->triangles->level[0][j];
    for (; triangles; triangles &= triangles - 1) {
        int k = first_lane(triangles);
        unsigned mask = overlaps(e, t, k);
        if (!mask) continue;
        s->count->pairs_tested += __builtin_popcount(mask);
        mask &= straddles(&s->edges->item[i], &s->triangles->item[j], k, s->slack);
        for (; mask; mask &= mask - 1)
            if (decide(s, i * LANES + first_lane(mask), j * LANES + k)) return true;
    }
    return false;
}

static bool search(Search *s, int level, int i, int j, unsigned triangles) {
    if (level == 0) return search_items(s, i, j, triangles);
    const CrossingTile *e = &s->edges->level[level][i], *t = &s->triangles->level[level][j];
    for (; triangles; triangles &= triangles - 1) {
        int k = first_lane(triangles);
        for (unsigned mask = overlaps(e, t, k); mask; mask &= mask - 1) {
            int m = first_lane(mask), down = j * LANES + k;
            unsigned inner = overlaps(&s->triangles->level[level - 1][down], e, m);
            if (search(s, level - 1, i * LANES + m, down, inner)) return true;
        }
    }
    return false;
}

static int top_tiles(const CrossingSet *set) { return tiles(tiles(tiles(set->count))); }

static bool run(Search *s) {
    CrossingCount *c = s->count;
    c->pairs_all += (long long)s->edges->count * s->triangles->count;
    float reach = s->edges->reach > s->triangles->reach ? s->edges->reach : s->triangles->reach;
    s->slack = 32 * FLT_EPSILON * reach + FLT_MIN;
    for (int i = 0; i < top_tiles(s->edges); i++)
        for (int j = 0; j < top_tiles(s->triangles); j++)
            if (search(s, LEVELS - 1, i, j, 0xFFFF)) return true;
    return false;
}

int crossing_find(const CrossingSet *edges, const CrossingSet *triangles, Crossing *out, int capacity,
                  CrossingCount *count) {
    Search s = {.edges = edges, .triangles = triangles, .out = out, .capacity = capacity, .count = count};
    run(&s);
    return s.written;
}

bool crossing_any(const CrossingSet *edges, const CrossingSet *triangles, CrossingCount *count) {
    Search s = {.edges = edges, .triangles = triangles, .any = true, .count = count};
    return run(&s);
}
