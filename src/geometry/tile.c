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

static void plain_segments(Tile *out, const Vec3 *position, const int *index, int n, Tile *above, int lane) {
    plain_boxes(out, position, index, 2, n);
    tile_sum(out, above, lane);
}

static void plain_triangles(Tile *out, const Vec3 *position, const int *index, int n, Tile *above, int lane) {
    plain_boxes(out, position, index, 3, n);
    tile_sum(out, above, lane);
}

static TileLanes plain_overlap(const Tile *a, const Tile *b, int k) {
    static const int bit[TILE_LANES] = {1,   2,   4,    8,    16,   32,   64,    128,
                                        256, 512, 1024, 2048, 4096, 8192, 16384, 32768};
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

/* The body of `meet`, the same for each instruction set but for its own `overlap`. */
#define MEET(overlap)                                                                           \
    unsigned any = 0;                                                                           \
    for (unsigned left = lanes; left; left &= left - 1) {                                       \
        int k = __builtin_ctz(left);                                                            \
        row[k] = overlap(a, b, k);                                                              \
        any |= row[k] ? 1u << k : 0;                                                            \
    }                                                                                           \
    return (TileLanes)any

static TileLanes plain_meet(const Tile *a, const Tile *b, TileLanes lanes, TileLanes row[TILE_LANES]) {
    MEET(plain_overlap);
}

static const TileMachine plain = {plain_segments, plain_triangles, plain_overlap, plain_meet};

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

/* A whole tile; `corners` is known where this is inlined. */
FOR_AVX2 static inline void avx2_boxes(Tile *out, const Vec3 *position, const int *index, int corners, Tile *above,
                                   int lane) {
    __m128 part_low[4], part_high[4];
    for (int part = 0; part < 4; part++) {
        __m128 low[4], high[4];
        for (int k = 0; k < 4; k++, index += corners) {
            low[k] = high[k] = corner(&position[index[0]]);
            for (int c = 1; c < corners; c++) {
                __m128 v = corner(&position[index[c]]);
                low[k] = _mm_min_ps(low[k], v);
                high[k] = _mm_max_ps(high[k], v);
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
    if (n < TILE_LANES) plain_segments(out, position, index, n, above, lane);
    else avx2_boxes(out, position, index, 2, above, lane);
}

FOR_AVX2 static void avx2_triangles(Tile *out, const Vec3 *position, const int *index, int n, Tile *above, int lane) {
    if (n < TILE_LANES) plain_triangles(out, position, index, n, above, lane);
    else avx2_boxes(out, position, index, 3, above, lane);
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

FOR_AVX2 static TileLanes avx2_meet(const Tile *a, const Tile *b, TileLanes lanes, TileLanes row[TILE_LANES]) {
    MEET(avx2_overlap);
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

FOR_AVX512 static TileLanes avx512_meet(const Tile *a, const Tile *b, TileLanes lanes, TileLanes row[TILE_LANES]) {
    MEET(avx512_overlap);
}

static const TileMachine avx2 = {avx2_segments, avx2_triangles, avx2_overlap, avx2_meet};
static const TileMachine avx512 = {avx2_segments, avx2_triangles, avx512_overlap, avx512_meet};

const TileMachine *tile_machine(Vectors vectors) {
    vectors = vectors_pick(vectors);
    return vectors == VECTORS_AVX512 ? &avx512 : vectors == VECTORS_AVX2 ? &avx2 : &plain;
}
#else
const TileMachine *tile_machine(Vectors vectors) { return (void)vectors, &plain; }
#endif
