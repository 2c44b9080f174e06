/* The same functions three times: in plain C, which says what is meant, and with vectors of 8 and of 16 floats,
   which are used where the processor has them. All give the same bits; the tests compare them.

   Boxes are floats. Rounding keeps order: if x <= y then (float)x <= (float)y. So the rounded boxes of things that
   touch still touch, and which overlap is the same on every machine. */
#include "geometry/tile.h"

/* --- plain C --- */

/* fminf and fmaxf, but each a single machine instruction. */
static inline float lesserf(float a, float b) { return a < b ? a : b; }
static inline float largerf(float a, float b) { return a > b ? a : b; }

/* The least and the largest of sixteen, by halves: the compiler makes SIMD code of that. */
static float least(const float v[TILE_LANES]) {
    float m[8];
    for (int k = 0; k < 8; k++) m[k] = lesserf(v[k], v[k + 8]);
    for (int k = 0; k < 4; k++) m[k] = lesserf(m[k], m[k + 4]);
    return lesserf(lesserf(m[0], m[1]), lesserf(m[2], m[3]));
}

static float largest(const float v[TILE_LANES]) {
    float m[8];
    for (int k = 0; k < 8; k++) m[k] = largerf(v[k], v[k + 8]);
    for (int k = 0; k < 4; k++) m[k] = largerf(m[k], m[k + 4]);
    return largerf(largerf(m[0], m[1]), largerf(m[2], m[3]));
}

void tile_sum(const Tile *below, Tile *above, int lane) {
    for (int x = 0; x < 3; x++) {
        above->low[x][lane] = least(below->low[x]);
        above->high[x][lane] = largest(below->high[x]);
    }
}

void tile_empty(Tile *t, int first) {
    for (int x = 0; x < 3; x++)
        for (int k = first; k < TILE_LANES; k++) t->low[x][k] = INFINITY, t->high[x][k] = -INFINITY;
}

static void plain_boxes(Tile *out, const Vec3 *position, const int *index, int corners, int n) {
    for (int k = 0; k < n; k++, index += corners) {
        Vec3 p = position[index[0]];
        float low[3] = {(float)p.x, (float)p.y, (float)p.z}, high[3] = {low[0], low[1], low[2]};
        for (int c = 1; c < corners; c++) {
            Vec3 q = position[index[c]];
            float v[3] = {(float)q.x, (float)q.y, (float)q.z};
            for (int x = 0; x < 3; x++) low[x] = lesserf(low[x], v[x]), high[x] = largerf(high[x], v[x]);
        }
        for (int x = 0; x < 3; x++) out->low[x][k] = low[x], out->high[x][k] = high[x];
    }
    tile_empty(out, n);
}

/* Lanes beyond the n-th repeat the last item; their boxes overlap nothing. */
ALWAYS const int *item_of(const int *index, int corners, int n, int lane) {
    return index + corners * (lane < n ? lane : n - 1);
}

static void plain_ends(TileShapes *out, const Vec3 *position, const int *index, int n) {
    TileEnds *ends = &out->ends;
    for (int k = 0; k < TILE_LANES; k++) {
        const int *i = item_of(index, 2, n, k);
        Vec3 p = position[i[0]], q = position[i[1]];
        ends->p[0][k] = (float)p.x, ends->p[1][k] = (float)p.y, ends->p[2][k] = (float)p.z;
        ends->q[0][k] = (float)q.x, ends->q[1][k] = (float)q.y, ends->q[2][k] = (float)q.z;
    }
}

/* The normal is divided by the sum of the magnitudes of all products in it, of which it is at most the whole: then its
   error is a few roundings however thin the triangle. The compiler makes SIMD code of the second loop. */
ALWAYS void find_planes(TilePlanes *out, const Vec3 *position, const int *index, int n) {
    double at[3][TILE_LANES], to_b[3][TILE_LANES], to_c[3][TILE_LANES];
    for (int k = 0; k < TILE_LANES; k++) {
        const int *i = item_of(index, 3, n, k);
        Vec3 a = position[i[0]], b = position[i[1]], c = position[i[2]];
        at[0][k] = a.x, at[1][k] = a.y, at[2][k] = a.z;
        to_b[0][k] = b.x - a.x, to_b[1][k] = b.y - a.y, to_b[2][k] = b.z - a.z;
        to_c[0][k] = c.x - a.x, to_c[1][k] = c.y - a.y, to_c[2][k] = c.z - a.z;
    }
    for (int k = 0; k < TILE_LANES; k++) {
        double yz = to_b[1][k] * to_c[2][k], zy = to_b[2][k] * to_c[1][k], zx = to_b[2][k] * to_c[0][k];
        double xz = to_b[0][k] * to_c[2][k], xy = to_b[0][k] * to_c[1][k], yx = to_b[1][k] * to_c[0][k];
        double sum = fabs(yz) + fabs(zy) + fabs(zx) + fabs(xz) + fabs(xy) + fabs(yx), per_sum = 1 / (sum + 1e-300);
        double nx = (yz - zy) * per_sum, ny = (zx - xz) * per_sum, nz = (xy - yx) * per_sum;
        out->n[0][k] = (float)nx, out->n[1][k] = (float)ny, out->n[2][k] = (float)nz;
        out->w[k] = (float)(nx * at[0][k] + ny * at[1][k] + nz * at[2][k]);
    }
}

static void plain_segments(Tile *out, const Vec3 *position, const int *index, int n, Tile *above, int lane) {
    plain_boxes(out, position, index, 2, n);
    tile_sum(out, above, lane);
}

static void plain_triangles(Tile *out, const Vec3 *position, const int *index, int n, Tile *above, int lane) {
    plain_boxes(out, position, index, 3, n);
    tile_sum(out, above, lane);
}

static void plain_planes(TileShapes *out, const Vec3 *position, const int *index, int n) {
    find_planes(&out->planes, position, index, n);
}

static const int bit[TILE_LANES] = {1,   2,   4,    8,    16,   32,   64,    128,
                                    256, 512, 1024, 2048, 4096, 8192, 16384, 32768};

TileLanes tile_overlap(const Tile *a, const Tile *b, int k) {
    float lx = b->low[0][k], ly = b->low[1][k], lz = b->low[2][k];
    float hx = b->high[0][k], hy = b->high[1][k], hz = b->high[2][k];
    int found = 0;
    for (int i = 0; i < TILE_LANES; i++) {
        bool yes = (a->low[0][i] <= hx) & (a->high[0][i] >= lx) & (a->low[1][i] <= hy) & (a->high[1][i] >= ly)
                 & (a->low[2][i] <= hz) & (a->high[2][i] >= lz);
        found += yes ? bit[i] : 0;
    }
    return (TileLanes)found;
}

TileLanes tile_reaching(const TileEnds *ends, const TilePlanes *planes, int k, float slack) {
    const float(*p)[TILE_LANES] = ends->p, (*q)[TILE_LANES] = ends->q;
    float nx = planes->n[0][k], ny = planes->n[1][k], nz = planes->n[2][k], w = planes->w[k];
    int found = 0;
    for (int i = 0; i < TILE_LANES; i++) {
        float a = nx * p[0][i] + ny * p[1][i] + nz * p[2][i] - w;
        float b = nx * q[0][i] + ny * q[1][i] + nz * q[2][i] - w;
        bool above = lesserf(a, b) > slack, below = largerf(a, b) < -slack;
        found += (above | below) ? 0 : bit[i];
    }
    return (TileLanes)found;
}

/* The body of `meet`, the same for each instruction set but for its own `overlap`. */
#define MEET(overlap)                                                                             \
    unsigned any = 0;                                                                             \
    for (unsigned left = lanes; left; left &= left - 1) {                                         \
        int k = __builtin_ctz(left);                                                              \
        row[k] = overlap(a, b, k);                                                                \
        any |= row[k] ? 1u << k : 0;                                                              \
    }                                                                                             \
    return (TileLanes)any

/* That of `reach`, likewise. */
#define REACH(reaching)                                       \
    unsigned any = 0;                                         \
    for (unsigned left = lanes; left; left &= left - 1) {     \
        int k = __builtin_ctz(left);                          \
        *pairs += __builtin_popcount(row[k]);                 \
        row[k] &= reaching(ends, planes, k, slack);           \
        any |= row[k] ? 1u << k : 0;                          \
    }                                                         \
    return (TileLanes)any

static TileLanes plain_meet(const Tile *a, const Tile *b, TileLanes lanes, TileLanes row[TILE_LANES]) {
    MEET(tile_overlap);
}

static TileLanes plain_reach(const TileEnds *ends, const TilePlanes *planes, TileLanes lanes,
                             float slack, TileLanes row[TILE_LANES], long long *pairs) {
    REACH(tile_reaching);
}

static const TileMachine plain = {
    {2, plain_segments, plain_ends}, {3, plain_triangles, plain_planes}, plain_meet, plain_reach,
};

/* --- vectors of x86-64 --- */

#ifdef VECTORS_ARE_X86
#include <immintrin.h>

/* The fourth lane is 0. */
FOR_AVX2 static inline __m128 corner(const Vec3 *p) {
    return _mm256_cvtpd_ps(_mm256_maskload_pd(&p->x, _mm256_setr_epi64x(-1, -1, -1, 0)));
}

/* Four items at a time have their corners in rows, x y z 0; turned, they are lanes of a tile. */
FOR_AVX2 static inline void store_lanes(float out[3][TILE_LANES], int first, const __m128 item[4]) {
    __m128 a = item[0], b = item[1], c = item[2], d = item[3];
    _MM_TRANSPOSE4_PS(a, b, c, d);
    _mm_store_ps(out[0] + first, a);
    _mm_store_ps(out[1] + first, b);
    _mm_store_ps(out[2] + first, c);
}

FOR_AVX2 static inline __m128 least_of(const __m128 v[4]) {
    return _mm_min_ps(_mm_min_ps(v[0], v[1]), _mm_min_ps(v[2], v[3]));
}

FOR_AVX2 static inline __m128 largest_of(const __m128 v[4]) {
    return _mm_max_ps(_mm_max_ps(v[0], v[1]), _mm_max_ps(v[2], v[3]));
}

/* `corners` is known where this is inlined. */
FOR_AVX2 static inline void avx2_boxes(Tile *out, const Vec3 *position, const int *index, int corners, int n,
                                       Tile *above, int lane) {
    if (n < TILE_LANES) {
        plain_boxes(out, position, index, corners, n);
        tile_sum(out, above, lane);
        return;
    }
    __m128 part_low[4], part_high[4];
    for (int part = 0; part < 4; part++) {
        __m128 low[4], high[4];
        for (int k = 0; k < 4; k++, index += corners) {
            low[k] = high[k] = corner(&position[index[0]]);
            for (int c = 1; c < corners; c++) {
                __m128 other = corner(&position[index[c]]);
                low[k] = _mm_min_ps(low[k], other);
                high[k] = _mm_max_ps(high[k], other);
            }
        }
        part_low[part] = least_of(low);
        part_high[part] = largest_of(high);
        store_lanes(out->low, 4 * part, low);
        store_lanes(out->high, 4 * part, high);
    }
    float low[4], high[4];
    _mm_storeu_ps(low, least_of(part_low));
    _mm_storeu_ps(high, largest_of(part_high));
    for (int x = 0; x < 3; x++) above->low[x][lane] = low[x], above->high[x][lane] = high[x];
}

FOR_AVX2 static void avx2_segments(Tile *out, const Vec3 *position, const int *index, int n, Tile *above, int lane) {
    avx2_boxes(out, position, index, 2, n, above, lane);
}

FOR_AVX2 static void avx2_triangles(Tile *out, const Vec3 *position, const int *index, int n, Tile *above, int lane) {
    avx2_boxes(out, position, index, 3, n, above, lane);
}

FOR_AVX2 static void avx2_ends(TileShapes *out, const Vec3 *position, const int *index, int n) {
    for (int first = 0; first < TILE_LANES; first += 4) {
        __m128 p[4], q[4];
        for (int k = 0; k < 4; k++) {
            const int *i = item_of(index, 2, n, first + k);
            p[k] = corner(&position[i[0]]);
            q[k] = corner(&position[i[1]]);
        }
        store_lanes(out->ends.p, first, p);
        store_lanes(out->ends.q, first, q);
    }
}

FOR_AVX2 static void avx2_planes(TileShapes *out, const Vec3 *position, const int *index, int n) {
    find_planes(&out->planes, position, index, n);
}

/* Eight boxes of tile a, from `first` on. */
FOR_AVX2 static inline unsigned half_overlap(const Tile *a, int first, const Tile *b, int k) {
    __m256 all = _mm256_castsi256_ps(_mm256_set1_epi32(-1));
    for (int x = 0; x < 3; x++) {
        __m256 low = _mm256_load_ps(a->low[x] + first), high = _mm256_load_ps(a->high[x] + first);
        all = _mm256_and_ps(all, _mm256_cmp_ps(low, _mm256_broadcast_ss(&b->high[x][k]), _CMP_LE_OQ));
        all = _mm256_and_ps(all, _mm256_cmp_ps(high, _mm256_broadcast_ss(&b->low[x][k]), _CMP_GE_OQ));
    }
    return (unsigned)_mm256_movemask_ps(all);
}

FOR_AVX2 static inline TileLanes avx2_overlap(const Tile *a, const Tile *b, int k) {
    return (TileLanes)(half_overlap(a, 0, b, k) | half_overlap(a, 8, b, k) << 8);
}

FOR_AVX2 static inline __m256 above_plane(const float p[3][TILE_LANES], int first, const TilePlanes *planes, int k) {
    __m256 x = _mm256_mul_ps(_mm256_broadcast_ss(&planes->n[0][k]), _mm256_load_ps(p[0] + first));
    __m256 y = _mm256_mul_ps(_mm256_broadcast_ss(&planes->n[1][k]), _mm256_load_ps(p[1] + first));
    __m256 z = _mm256_mul_ps(_mm256_broadcast_ss(&planes->n[2][k]), _mm256_load_ps(p[2] + first));
    return _mm256_sub_ps(_mm256_add_ps(_mm256_add_ps(x, y), z), _mm256_broadcast_ss(&planes->w[k]));
}

FOR_AVX2 static inline unsigned half_beside(const TileEnds *ends, int first, const TilePlanes *planes, int k,
                                            float slack) {
    __m256 a = above_plane(ends->p, first, planes, k), b = above_plane(ends->q, first, planes, k);
    __m256 above = _mm256_cmp_ps(_mm256_min_ps(a, b), _mm256_set1_ps(slack), _CMP_GT_OQ);
    __m256 below = _mm256_cmp_ps(_mm256_max_ps(a, b), _mm256_set1_ps(-slack), _CMP_LT_OQ);
    return (unsigned)_mm256_movemask_ps(_mm256_or_ps(above, below));
}

FOR_AVX2 static inline TileLanes avx2_reaching(const TileEnds *ends, const TilePlanes *planes, int k, float slack) {
    return (TileLanes)~(half_beside(ends, 0, planes, k, slack) | half_beside(ends, 8, planes, k, slack) << 8);
}

FOR_AVX2 static TileLanes avx2_meet(const Tile *a, const Tile *b, TileLanes lanes, TileLanes row[TILE_LANES]) {
    MEET(avx2_overlap);
}

FOR_AVX2 static TileLanes avx2_reach(const TileEnds *ends, const TilePlanes *planes, TileLanes lanes,
                                     float slack, TileLanes row[TILE_LANES], long long *pairs) {
    REACH(avx2_reaching);
}

FOR_AVX512 static void avx512_planes(TileShapes *out, const Vec3 *position, const int *index, int n) {
    find_planes(&out->planes, position, index, n);
}

FOR_AVX512 static inline TileLanes avx512_overlap(const Tile *a, const Tile *b, int k) {
    __mmask16 all = 0xFFFF;
    for (int x = 0; x < 3; x++) {
        __m512 low = _mm512_load_ps(a->low[x]), high = _mm512_load_ps(a->high[x]);
        all = _mm512_mask_cmp_ps_mask(all, low, _mm512_set1_ps(b->high[x][k]), _CMP_LE_OQ);
        all = _mm512_mask_cmp_ps_mask(all, high, _mm512_set1_ps(b->low[x][k]), _CMP_GE_OQ);
    }
    return all;
}

FOR_AVX512 static inline __m512 sixteen_above(const float p[3][TILE_LANES], const TilePlanes *planes, int k) {
    __m512 x = _mm512_mul_ps(_mm512_set1_ps(planes->n[0][k]), _mm512_load_ps(p[0]));
    __m512 y = _mm512_mul_ps(_mm512_set1_ps(planes->n[1][k]), _mm512_load_ps(p[1]));
    __m512 z = _mm512_mul_ps(_mm512_set1_ps(planes->n[2][k]), _mm512_load_ps(p[2]));
    return _mm512_sub_ps(_mm512_add_ps(_mm512_add_ps(x, y), z), _mm512_set1_ps(planes->w[k]));
}

FOR_AVX512 static inline TileLanes avx512_reaching(const TileEnds *ends, const TilePlanes *planes, int k,
                                                   float slack) {
    __m512 a = sixteen_above(ends->p, planes, k), b = sixteen_above(ends->q, planes, k);
    __mmask16 above = _mm512_cmp_ps_mask(_mm512_min_ps(a, b), _mm512_set1_ps(slack), _CMP_GT_OQ);
    __mmask16 below = _mm512_cmp_ps_mask(_mm512_max_ps(a, b), _mm512_set1_ps(-slack), _CMP_LT_OQ);
    return (TileLanes)~(above | below);
}

FOR_AVX512 static TileLanes avx512_meet(const Tile *a, const Tile *b, TileLanes lanes, TileLanes row[TILE_LANES]) {
    MEET(avx512_overlap);
}

FOR_AVX512 static TileLanes avx512_reach(const TileEnds *ends, const TilePlanes *planes, TileLanes lanes,
                                         float slack, TileLanes row[TILE_LANES], long long *pairs) {
    REACH(avx512_reaching);
}

static const TileMachine avx2 = {
    {2, avx2_segments, avx2_ends}, {3, avx2_triangles, avx2_planes}, avx2_meet, avx2_reach,
};
static const TileMachine avx512 = {
    {2, avx2_segments, avx2_ends}, {3, avx2_triangles, avx512_planes}, avx512_meet, avx512_reach,
};

const TileMachine *tile_machine(Vectors vectors) {
    vectors = vectors_pick(vectors);
    return vectors == VECTORS_AVX512 ? &avx512 : vectors == VECTORS_AVX2 ? &avx2 : &plain;
}
#else
const TileMachine *tile_machine(Vectors vectors) { return (void)vectors, &plain; }
#endif
