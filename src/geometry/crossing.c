/* Most pairs are far apart, so the work is to not look at them.

   Sixteen boxes that stand side by side in arrays make a tile: one loop tests a box against all
   sixteen, and the compiler turns that loop into a few vector instructions. Items are tiled in
   the order they come, their tiles are tiled again, and these once more; a search goes down
   both stacks at once and enters only pairs of tiles whose boxes overlap. No tree is balanced
   and nothing is sorted, so building is one pass over the items.

   Boxes are floats. Rounding keeps order: if x <= y then (float)x <= (float)y. So the rounded
   boxes of things that touch still touch, and how many overlap is the same on every machine.

   Pairs whose boxes overlap meet one more sieve of sixteen lanes: are both ends of the edge on
   one side of the triangle's plane, further from it than floats can err? The few that are left
   are decided exactly, by predicate_segment_triangle. */
#include "geometry/crossing.h"

#include <float.h>

#include "geometry/predicate.h"

enum { LANES = 16, TOP = CROSSING_LEVELS - 1 };

/* Box k is low[x][k] .. high[x][k] for the axes x = 0, 1, 2. A lane without a box is empty: low
   is larger than high, and it overlaps nothing. */
struct CrossingTile { _Alignas(64) float low[3][LANES], high[3][LANES]; };

/* What the second sieve needs. Segments: v[0..2] is one end, v[3..5] the other. Triangles:
   v[0..2] is the normal n of the plane n x = v[3], so long that |nx| + |ny| + |nz| <= 1; zero
   where the triangle has none. */
struct CrossingSieve { _Alignas(64) float v[6][LANES]; };

static int tiles(int n) { return n / LANES + (n % LANES != 0); }

bool crossing_reserve(CrossingSet *set, int capacity, Arena *arena, Error *e) {
    *set = (CrossingSet){.capacity = capacity};
    for (int l = 0, n = tiles(capacity); l <= TOP; l++, n = tiles(n)) {
        set->level[l] = ARENA_NEW(arena, CrossingTile, n, e);
        if (!set->level[l]) return false;
    }
    set->sieve = ARENA_NEW(arena, CrossingSieve, tiles(capacity), e);
    return set->sieve != NULL;
}

/* --- building --- */

/* Written so that each is one machine instruction. */
static inline float lesser(float a, float b) { return a < b ? a : b; }
static inline float larger(float a, float b) { return a > b ? a : b; }

/* The least and the largest of sixteen, by halves, which vectors can do. */
static float least(const float v[LANES]) {
    float m[8];
    for (int k = 0; k < 8; k++) m[k] = lesser(v[k], v[k + 8]);
    for (int k = 0; k < 4; k++) m[k] = lesser(m[k], m[k + 4]);
    return lesser(lesser(m[0], m[1]), lesser(m[2], m[3]));
}

static float largest(const float v[LANES]) {
    float m[8];
    for (int k = 0; k < 8; k++) m[k] = larger(v[k], v[k + 8]);
    for (int k = 0; k < 4; k++) m[k] = larger(m[k], m[k + 4]);
    return larger(larger(m[0], m[1]), larger(m[2], m[3]));
}

static void empty_lanes(CrossingTile *t, int first) {
    for (int x = 0; x < 3; x++)
        for (int k = first; k < LANES; k++) t->low[x][k] = INFINITY, t->high[x][k] = -INFINITY;
}

/* The boxes of the tiles below, level by level, and how far the whole set reaches. */
static void build_levels(CrossingSet *set) {
    int n = tiles(set->count);
    for (int l = 1; l <= TOP; l++) {
        for (int t = 0; t < n; t++) {
            const CrossingTile *below = &set->level[l - 1][t];
            CrossingTile *above = &set->level[l][t / LANES];
            for (int x = 0; x < 3; x++) {
                above->low[x][t % LANES] = least(below->low[x]);
                above->high[x][t % LANES] = largest(below->high[x]);
            }
        }
        if (n % LANES) empty_lanes(&set->level[l][n / LANES], n % LANES);
        n = tiles(n);
    }
    set->reach = 0;
    for (int t = 0; t < n; t++)
        for (int x = 0; x < 3; x++) {
            const CrossingTile *top = &set->level[TOP][t];
            set->reach = larger(set->reach, larger(-least(top->low[x]), largest(top->high[x])));
        }
}

/* The corners of up to sixteen items, turned into lanes: v[3 c + x][k] is coordinate x of corner c
   of item k. */
static void gather(const CrossingSet *set, int first, int items, int corners, double v[9][LANES]) {
    const int *i = set->index + (size_t)first * (size_t)corners;
    for (int k = 0; k < items; k++)
        for (int c = 0; c < corners; c++) {
            Vec3 p = set->position[*i++];
            v[3 * c][k] = p.x, v[3 * c + 1][k] = p.y, v[3 * c + 2][k] = p.z;
        }
}

static void edge_lanes(double v[9][LANES], CrossingTile *box, CrossingSieve *sieve) {
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < LANES; k++) sieve->v[i][k] = (float)v[i][k];
    for (int x = 0; x < 3; x++)
        for (int k = 0; k < LANES; k++) {
            box->low[x][k] = lesser(sieve->v[x][k], sieve->v[x + 3][k]);
            box->high[x][k] = larger(sieve->v[x][k], sieve->v[x + 3][k]);
        }
}

/* The normal is divided by the sum of the magnitudes of all products in it, of which it is at
   most the whole: then its error is a few roundings however thin the triangle. */
static void triangle_lanes(double v[9][LANES], CrossingTile *box, CrossingSieve *sieve) {
    for (int x = 0; x < 3; x++)
        for (int k = 0; k < LANES; k++) {
            float a = (float)v[x][k], b = (float)v[x + 3][k], c = (float)v[x + 6][k];
            box->low[x][k] = lesser(lesser(a, b), c);
            box->high[x][k] = larger(larger(a, b), c);
        }
    for (int k = 0; k < LANES; k++) {
        double px = v[3][k] - v[0][k], py = v[4][k] - v[1][k], pz = v[5][k] - v[2][k];
        double qx = v[6][k] - v[0][k], qy = v[7][k] - v[1][k], qz = v[8][k] - v[2][k];
        double yz = py * qz, zy = pz * qy, zx = pz * qx, xz = px * qz, xy = px * qy, yx = py * qx;
        double sum = fabs(yz) + fabs(zy) + fabs(zx) + fabs(xz) + fabs(xy) + fabs(yx), scale = 1 / (sum + 1e-300);
        double nx = (yz - zy) * scale, ny = (zx - xz) * scale, nz = (xy - yx) * scale;
        sieve->v[0][k] = (float)nx, sieve->v[1][k] = (float)ny, sieve->v[2][k] = (float)nz;
        sieve->v[3][k] = (float)(nx * v[0][k] + ny * v[1][k] + nz * v[2][k]);
    }
}

static void build(CrossingSet *set, const Vec3 *position, const int *index, int n, int corners,
                  void (*lanes)(double v[9][LANES], CrossingTile *box, CrossingSieve *sieve)) {
    double v[9][LANES] = {{0}}; /* lanes beyond the last item keep what was there: finite, and emptied below */
    set->position = position;
    set->index = index;
    set->count = n;
    for (int t = 0; t < tiles(n); t++) {
        int items = n - t * LANES < LANES ? n - t * LANES : LANES;
        gather(set, t * LANES, items, corners, v);
        lanes(v, &set->level[0][t], &set->sieve[t]);
        empty_lanes(&set->level[0][t], items);
    }
    build_levels(set);
}

void crossing_build_edges(CrossingSet *set, const Vec3 *position, const Edge *edge, int n) {
    build(set, position, (const int *)edge, n, 2, edge_lanes);
}

void crossing_build_triangles(CrossingSet *set, const Vec3 *position, const Triangle *triangle, int n) {
    build(set, position, (const int *)triangle, n, 3, triangle_lanes);
}

/* --- the two sieves --- */

/* A set of lanes: the low half has a bit for each, the high half their number, so that one sum
   over sixteen lanes tells both. */
typedef unsigned Lanes;
#define LANE(k) ((1u << (k)) + 0x10000u)
static const Lanes lane[LANES] = {LANE(0), LANE(1), LANE(2), LANE(3), LANE(4), LANE(5), LANE(6), LANE(7),
                                  LANE(8), LANE(9), LANE(10), LANE(11), LANE(12), LANE(13), LANE(14), LANE(15)};
static unsigned lane_bits(Lanes found) { return found & 0xFFFF; }
static int lane_count(Lanes found) { return (int)(found >> 16); }
static int lowest_lane(unsigned bits) { return __builtin_ctz(bits); }

/* The boxes of tile a that overlap box k of tile b. */
static Lanes overlapping(const CrossingTile *a, const CrossingTile *b, int k) {
    float lx = b->low[0][k], ly = b->low[1][k], lz = b->low[2][k];
    float hx = b->high[0][k], hy = b->high[1][k], hz = b->high[2][k];
    Lanes found = 0;
    for (int i = 0; i < LANES; i++) {
        bool yes = (a->low[0][i] <= hx) & (a->high[0][i] >= lx) & (a->low[1][i] <= hy) & (a->high[1][i] >= ly)
                 & (a->low[2][i] <= hz) & (a->high[2][i] >= lz);
        found += yes ? lane[i] : 0;
    }
    return found;
}

/* The segments that may reach the plane of triangle k. */
static Lanes reaching(const CrossingSieve *segments, const CrossingSieve *triangles, int k, float slack) {
    const float(*p)[LANES] = segments->v, (*q)[LANES] = segments->v + 3;
    float nx = triangles->v[0][k], ny = triangles->v[1][k], nz = triangles->v[2][k], w = triangles->v[3][k];
    Lanes found = 0;
    for (int i = 0; i < LANES; i++) {
        float a = nx * p[0][i] + ny * p[1][i] + nz * p[2][i] - w;
        float b = nx * q[0][i] + ny * q[1][i] + nz * q[2][i] - w;
        bool above = lesser(a, b) > slack, below = larger(a, b) < -slack;
        found += (above | below) ? 0 : lane[i];
    }
    return found;
}

/* --- searching --- */

typedef struct {
    const CrossingSet *edges, *triangles;
    float slack;      /* floats err less in the distance to a plane */
    bool first_only;
    Crossing *out;
    int capacity, written;
    CrossingCount *count;
} Search;

/* All below return true to end the search. */
static bool decide(Search *s, int edge, int triangle) {
    const int *i = s->edges->index + 2 * (size_t)edge, *j = s->triangles->index + 3 * (size_t)triangle;
    const Vec3 *v = s->edges->position, *w = s->triangles->position;
    if (!predicate_segment_triangle(v[i[0]], v[i[1]], w[j[0]], w[j[1]], w[j[2]])) return false;
    s->count->hits++;
    if (s->written < s->capacity) s->out[s->written++] = (Crossing){edge, triangle};
    return s->first_only;
}

/* The items of edge tile i against some triangles of triangle tile j. */
static bool search_items(Search *s, int i, int j, unsigned triangles) {
    const CrossingSet *e = s->edges, *t = s->triangles;
    for (; triangles; triangles &= triangles - 1) {
        int k = lowest_lane(triangles);
        Lanes found = overlapping(&e->level[0][i], &t->level[0][j], k);
        if (!found) continue;
        s->count->pairs_tested += lane_count(found);
        unsigned edges = lane_bits(found & reaching(&e->sieve[i], &t->sieve[j], k, s->slack));
        for (; edges; edges &= edges - 1)
            if (decide(s, i * LANES + lowest_lane(edges), j * LANES + k)) return true;
    }
    return false;
}

/* Tile i of the edges at this level against the lanes `triangles` of tile j of the triangles. */
static bool search_tiles(Search *s, int level, int i, int j, unsigned triangles) {
    if (level == 0) return search_items(s, i, j, triangles);
    const CrossingTile *e = &s->edges->level[level][i], *t = &s->triangles->level[level][j];
    for (; triangles; triangles &= triangles - 1) {
        int k = lowest_lane(triangles), below = j * LANES + k;
        for (unsigned edges = lane_bits(overlapping(e, t, k)); edges; edges &= edges - 1) {
            int m = lowest_lane(edges);
            Lanes inner = overlapping(&s->triangles->level[level - 1][below], e, m);
            if (search_tiles(s, level - 1, i * LANES + m, below, lane_bits(inner))) return true;
        }
    }
    return false;
}

static int top_tiles(const CrossingSet *set) {
    int n = set->count;
    for (int l = 0; l <= TOP; l++) n = tiles(n);
    return n;
}

/* The slack: with u = 2^-24 and M the reach of both sets, |n|1 <= 1 makes n x of rounded n and
   rounded x, in three products and two sums, err by at most 6 u M, and w and the difference
   by 2 u M more; 16 u M is ample. FLT_MIN covers what underflows. */
static float slack_of(const Search *s) {
    return 8 * FLT_EPSILON * larger(s->edges->reach, s->triangles->reach) + FLT_MIN;
}

static int search(Search *s) {
    s->slack = slack_of(s);
    s->count->pairs_all += (long long)s->edges->count * s->triangles->count;
    for (int i = 0; i < top_tiles(s->edges); i++)
        for (int j = 0; j < top_tiles(s->triangles); j++)
            if (search_tiles(s, TOP, i, j, 0xFFFF)) return s->written;
    return s->written;
}

int crossing_find(const CrossingSet *edges, const CrossingSet *triangles, Crossing *out, int capacity,
                  CrossingCount *count) {
    Search s = {edges, triangles, .out = out, .capacity = capacity, .count = count};
    return search(&s);
}

/* Each triangle's plane against sixteen segments at a time, all of them. The few that reach the plane
   have their boxes looked at before they are decided, so that a pair costs about the same wherever
   the triangle stands: time then tells the number of pairs. */
int crossing_find_plainly(const CrossingSet *edges, const CrossingSet *triangles, Crossing *out, int capacity,
                          CrossingCount *count) {
    Search s = {edges, triangles, .out = out, .capacity = capacity, .count = count};
    long long pairs = (long long)edges->count * triangles->count;
    s.slack = slack_of(&s);
    count->pairs_all += pairs;
    count->pairs_tested += pairs;
    for (int triangle = 0; triangle < triangles->count; triangle++)
        for (int i = 0; i < tiles(edges->count); i++) {
            int tile = triangle / LANES, k = triangle % LANES;
            unsigned found = lane_bits(reaching(&edges->sieve[i], &triangles->sieve[tile], k, s.slack));
            if (found) found &= lane_bits(overlapping(&edges->level[0][i], &triangles->level[0][tile], k));
            for (; found; found &= found - 1) decide(&s, i * LANES + lowest_lane(found), triangle);
        }
    return s.written;
}

bool crossing_any(const CrossingSet *edges, const CrossingSet *triangles, CrossingCount *count) {
    Crossing hit;
    Search s = {edges, triangles, .first_only = true, .out = &hit, .capacity = 1, .count = count};
    return search(&s) > 0;
}
