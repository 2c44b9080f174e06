/* Most pairs are far apart; the art is not to look at them.

   Items are boxed in tiles of sixteen (geometry/tile) in the order in which they come, their tiles are tiled again,
   and these once more. A search goes down both hierarchies at once and enters only pairs of tiles whose boxes
   overlap. Nothing is sorted or balanced, so building is one pass over the items.

   Of the pairs whose own boxes overlap, most still have both ends of the edge on one side of the triangle's plane,
   farther from it than floats can err. The few that are left are decided exactly, by predicate_segment_triangle. */
#include "geometry/crossing.h"

#include <float.h>

#include "geometry/predicate.h"

enum { LANES = TILE_LANES, TOP = CROSSING_LEVELS - 1 };
enum { SHAPES_UNKNOWN, SHAPES_BEGUN, SHAPES_KNOWN }; /* of a tile */

static int lowest(unsigned lanes) { return __builtin_ctz(lanes); }
static int tiles(int n) { return n / LANES + (n % LANES != 0); }

bool crossing_reserve(CrossingSet *set, int capacity, Arena *arena, Error *e) {
    *set = (CrossingSet){0};
    for (int l = 0, n = tiles(capacity); l <= TOP; l++, n = tiles(n)) {
        set->level[l] = ARENA_NEW(arena, Tile, n, e);
        if (!set->level[l]) return false;
    }
    set->shapes = ARENA_NEW(arena, TileShapes, tiles(capacity), e);
    set->state = ARENA_NEW(arena, atomic_uchar, tiles(capacity), e);
    return set->shapes && set->state;
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

/* Where the corners of a tile's items begin, and how many items it has. */
static const int *items_of(const CrossingSet *set, int tile, int *n) {
    int left = set->count - tile * LANES;
    *n = left < LANES ? left : LANES;
    return set->index + (size_t)tile * LANES * (size_t)set->items->corners;
}

static void build(CrossingSet *set, const TileItems *items, const Vec3 *position, const int *index, int n) {
    set->items = items;
    set->position = position;
    set->index = index;
    set->count = n;
    n = tiles(n);
    for (int t = 0; t < n; t++) {
        int here;
        const int *first = items_of(set, t, &here);
        items->boxes(&set->level[0][t], position, first, here, &set->level[1][t / LANES], t % LANES);
        atomic_init(&set->state[t], SHAPES_UNKNOWN);
    }
    for (int l = 1; l <= TOP; l++, n = tiles(n)) {
        if (n % LANES) tile_empty(&set->level[l][n / LANES], n % LANES);
        for (int t = 0; l < TOP && t < tiles(n); t++)
            tile_sum(&set->level[l][t], &set->level[l + 1][t / LANES], t % LANES);
    }
    set->reach = reach_of(set);
}

void crossing_build_edges(CrossingSet *set, const Vec3 *position, const Edge *edge, int n) {
    build(set, &tile_machine(set->vectors)->segments, position, (const int *)edge, n);
}

void crossing_build_triangles(CrossingSet *set, const Vec3 *position, const Triangle *triangle, int n) {
    build(set, &tile_machine(set->vectors)->triangles, position, (const int *)triangle, n);
}

/* --- searching --- */

typedef struct {
    const CrossingSet *edges, *triangles;
    const TileMachine *machine;
    float slack;
    Crossing *out;
    int capacity, written;
    CrossingCount *count;
} Search;

/* The slack: with u = 2^-24 and M the reach of both sets, |n|1 <= 1 makes n x of rounded n and rounded x, in three
   products and two sums, err by at most 6 u M, and w and the difference by 2 u M more; 16 u M is ample. FLT_MIN covers
   what underflows. */
static Search search_of(const CrossingSet *edges, const CrossingSet *triangles, Crossing *out, int capacity,
                        CrossingCount *count) {
    float slack = 8 * FLT_EPSILON * fmaxf(edges->reach, triangles->reach) + FLT_MIN;
    return (Search){edges, triangles, tile_machine(edges->vectors), slack,
                    .out = out, .capacity = capacity, .count = count};
}

static void decide(Search *s, int edge, int triangle) {
    const int *i = s->edges->index + 2 * (size_t)edge, *j = s->triangles->index + 3 * (size_t)triangle;
    const Vec3 *v = s->edges->position, *w = s->triangles->position;
    if (!predicate_segment_triangle(v[i[0]], v[i[1]], w[j[0]], w[j[1]], w[j[2]])) return;
    s->count->hits++;
    if (s->written < s->capacity) s->out[s->written++] = (Crossing){edge, triangle};
}

static void make_shapes(const CrossingSet *set, int tile, TileShapes *out) {
    int n;
    const int *index = items_of(set, tile, &n);
    set->items->shapes(out, set->position, index, n);
}

/* The shapes of a tile, made when they are first asked for: of most tiles never. While another thread is making them,
   they are made once more, in `room`. */
static const TileShapes *shapes_of(const CrossingSet *set, int tile, TileShapes *room) {
    unsigned char state = atomic_load_explicit(&set->state[tile], memory_order_acquire);
    if (state == SHAPES_KNOWN) return &set->shapes[tile];
    bool is_first = state == SHAPES_UNKNOWN && atomic_compare_exchange_strong(&set->state[tile], &state, SHAPES_BEGUN);
    TileShapes *out = is_first ? &set->shapes[tile] : room;
    make_shapes(set, tile, out);
    if (is_first) atomic_store_explicit(&set->state[tile], SHAPES_KNOWN, memory_order_release);
    return out;
}

/* Tile i of the edges against the lanes `triangles` of tile j of the triangles. */
static void search_items(Search *s, int i, int j, TileLanes triangles) {
    TileLanes row[LANES];
    TileShapes a, b;
    triangles = s->machine->meet(&s->edges->level[0][i], &s->triangles->level[0][j], triangles, row);
    if (!triangles) return;
    const TileEnds *ends = &shapes_of(s->edges, i, &a)->ends;
    const TilePlanes *planes = &shapes_of(s->triangles, j, &b)->planes;
    unsigned left = s->machine->reach(ends, planes, triangles, s->slack, row, &s->count->pairs_tested);
    for (; left; left &= left - 1) {
        int k = lowest(left);
        for (unsigned edges = row[k]; edges; edges &= edges - 1) decide(s, i * LANES + lowest(edges), j * LANES + k);
    }
}

/* The same for the tiles at a level. */
static void search_tiles(Search *s, int level, int i, int j, TileLanes triangles) {
    if (level == 0) {
        search_items(s, i, j, triangles);
        return;
    }
    const Tile *e = &s->edges->level[level][i], *t = &s->triangles->level[level][j];
    TileLanes row[LANES], inner[LANES];
    for (unsigned left = s->machine->meet(e, t, triangles, row); left; left &= left - 1) {
        int k = lowest(left), below = j * LANES + k;
        unsigned edges = s->machine->meet(&s->triangles->level[level - 1][below], e, row[k], inner);
        for (; edges; edges &= edges - 1)
            search_tiles(s, level - 1, i * LANES + lowest(edges), below, inner[lowest(edges)]);
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

enum { BLOCK = 64 };

/* Tiles first..end-1 of the edges, at most BLOCK, against every triangle. */
static void search_block(Search *s, int first, int end) {
    TileShapes of_edges[BLOCK], of_triangles;
    for (int i = first; i < end; i++) make_shapes(s->edges, i, &of_edges[i - first]);
    for (int triangle = 0; triangle < s->triangles->count; triangle++) {
        int tile = triangle / LANES, lane = triangle % LANES;
        const Tile *box = &s->triangles->level[0][tile];
        if (lane == 0) make_shapes(s->triangles, tile, &of_triangles);
        for (int i = first; i < end; i++) {
            unsigned found = tile_reaching(&of_edges[i - first].ends, &of_triangles.planes, lane, s->slack);
            if (found) found &= tile_overlap(&s->edges->level[0][i], box, lane);
            for (; found; found &= found - 1) decide(s, i * LANES + lowest(found), triangle);
        }
    }
}

/* Each triangle's plane meets sixteen segments at a time, all of them. The few that reach the plane have their boxes
   compared before they are decided, so that a pair costs about the same wherever the triangle is, and time measures the
   number of pairs. Segments come in blocks that fit into the first-level cache. */
int crossing_find_plainly(const CrossingSet *edges, const CrossingSet *triangles, Crossing *out, int capacity,
                          CrossingCount *count) {
    Search s = search_of(edges, triangles, out, capacity, count);
    long long pairs = (long long)edges->count * triangles->count;
    count->pairs_all += pairs;
    count->pairs_tested += pairs;
    for (int first = 0, n = tiles(edges->count); first < n; first += BLOCK)
        search_block(&s, first, first + BLOCK < n ? first + BLOCK : n);
    return s.written;
}
