/* The predicates against an oracle that shares no thought with them: whole numbers of any
   length, and Fourier-Motzkin elimination on the definition itself. A segment p-q and a
   triangle a, b, c share a point if and only if

       p + s (q - p) = a + u (b - a) + v (c - a),  0 <= s <= 1,  u >= 0,  v >= 0,  u + v <= 1

   has a solution; collapsed and coplanar ones are no special case of that. */
#include "geometry/predicate.h"

#include <stdlib.h>
#include <string.h>

#include "dice.h"
#include "tap.h"

/* --- whole numbers: sign and 32-bit digits, lowest first --- */

enum { DIGITS = 24 };
typedef struct {
    int sign, n;
    uint32_t digit[DIGITS];
} Big;

static void big_trim(Big *a) {
    while (a->n && a->digit[a->n - 1] == 0) a->n--;
    if (a->n == 0) a->sign = 0;
}

static Big big_multiply(const Big *a, const Big *b) {
    Big r;
    r.sign = a->sign * b->sign;
    r.n = r.sign ? a->n + b->n : 0;
    if (r.n > DIGITS) abort();
    memset(r.digit, 0, (size_t)r.n * sizeof r.digit[0]);
    for (int i = 0; r.sign && i < a->n; i++) {
        uint64_t carry = 0;
        for (int j = 0; j < b->n; j++, carry >>= 32) {
            carry += (uint64_t)a->digit[i] * b->digit[j] + r.digit[i + j];
            r.digit[i + j] = (uint32_t)carry;
        }
        r.digit[i + b->n] = (uint32_t)carry;
    }
    big_trim(&r);
    return r;
}

static int big_compare_size(const Big *a, const Big *b) {
    if (a->n != b->n) return a->n < b->n ? -1 : 1;
    for (int i = a->n - 1; i >= 0; i--)
        if (a->digit[i] != b->digit[i]) return a->digit[i] < b->digit[i] ? -1 : 1;
    return 0;
}

/* a - b */
static Big big_subtract(const Big *a, const Big *b) {
    if (!b->sign) return *a;
    if (big_compare_size(a, b) < 0) {
        Big r = big_subtract(b, a);
        r.sign = -r.sign;
        return r;
    }
    Big r;
    int64_t carry = 0, s = a->sign == b->sign ? -1 : 1;
    r.sign = a->sign;
    r.n = a->n < DIGITS ? a->n + 1 : DIGITS;
    for (int i = 0; i < r.n; i++) {
        carry += (i < a->n ? (int64_t)a->digit[i] : 0) + s * (i < b->n ? (int64_t)b->digit[i] : 0);
        r.digit[i] = (uint32_t)(carry & 0xFFFFFFFF);
        carry = (carry - (int64_t)r.digit[i]) / ((int64_t)1 << 32);
    }
    if (carry) abort();
    big_trim(&r);
    return r;
}

/* x times 2^shift, which must be whole. */
static Big big_from(double x, int shift) {
    int e = 0;
    uint64_t m = (uint64_t)ldexp(fabs(frexp(x, &e)), 53);
    Big r = {.sign = (x > 0) - (x < 0)};
    if (!m) return r;
    for (e += shift - 53; e < 0; e++, m >>= 1)
        if (m & 1) abort();
    if (e / 32 + 3 > DIGITS) abort();
    uint64_t low = (m & 0xFFFFFFFF) << e % 32, high = (m >> 32) << e % 32;
    uint64_t middle = (low >> 32) + (high & 0xFFFFFFFF);
    r.n = e / 32 + 3;
    r.digit[e / 32] = (uint32_t)low;
    r.digit[e / 32 + 1] = (uint32_t)middle;
    r.digit[e / 32 + 2] = (uint32_t)((middle >> 32) + (high >> 32));
    big_trim(&r);
    return r;
}

/* --- the oracle --- */

typedef struct { Big x[4]; } Row; /* x0 s + x1 u + x2 v + x3, to be = 0 or >= 0 */

/* m (>= 0) times a minus f times b: removes an unknown from a. */
static Row row_combine(const Row *a, Big m, const Row *b, Big f) {
    Row r;
    for (int i = 0; i < 4; i++) {
        Big left = big_multiply(&a->x[i], &m), right = big_multiply(&b->x[i], &f);
        r.x[i] = big_subtract(&left, &right);
    }
    return r;
}

/* a without unknown j by the help of the equation b, in which j has a factor. */
static Row row_substitute(const Row *a, const Row *b, int j) {
    Big m = b->x[j], f = a->x[j];
    f.sign *= m.sign;
    m.sign = 1;
    return row_combine(a, m, b, f);
}

enum { ROWS = 64 };

static int remove_unknown(Row row[ROWS], int n, int j) {
    Row out[ROWS];
    int count = 0;
    for (int a = 0; a < n; a++) {
        if (row[a].x[j].sign == 0) out[count++] = row[a];
        for (int b = 0; b < n && row[a].x[j].sign > 0; b++) {
            if (row[b].x[j].sign >= 0) continue;
            if (count == ROWS) abort();
            Big m = row[b].x[j];
            m.sign = 1;
            Big f = row[a].x[j];
            f.sign = -1;
            out[count++] = row_combine(&row[a], m, &row[b], f);
        }
    }
    memcpy(row, out, (size_t)count * sizeof out[0]);
    return count;
}

static bool feasible(Row equation[3], Row row[ROWS], int n) {
    for (int i = 0; i < 3; i++) {
        int j = 0;
        while (j < 3 && equation[i].x[j].sign == 0) j++;
        if (j == 3 && equation[i].x[3].sign != 0) return false;
        if (j == 3) continue;
        for (int k = i + 1; k < 3; k++)
            if (equation[k].x[j].sign) equation[k] = row_substitute(&equation[k], &equation[i], j);
        for (int k = 0; k < n; k++)
            if (row[k].x[j].sign) row[k] = row_substitute(&row[k], &equation[i], j);
    }
    for (int j = 0; j < 3; j++) n = remove_unknown(row, n, j);
    for (int k = 0; k < n; k++)
        if (row[k].x[3].sign < 0) return false;
    return true;
}

static double coordinate(Vec3 v, int i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; }

/* Coordinates must be whole multiples of 2^-shift. */
static bool oracle(const Vec3 v[5], int shift) {
    static const double limit[5][4] = {{1, 0, 0, 0}, {-1, 0, 0, 1}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, -1, -1, 1}};
    Row equation[3], row[ROWS];
    for (int i = 0; i < 3; i++) {
        Big x[5];
        for (int k = 0; k < 5; k++) x[k] = big_from(coordinate(v[k], i), shift);
        equation[i].x[0] = big_subtract(&x[1], &x[0]);
        equation[i].x[1] = big_subtract(&x[2], &x[3]);
        equation[i].x[2] = big_subtract(&x[2], &x[4]);
        equation[i].x[3] = big_subtract(&x[0], &x[2]);
    }
    for (int k = 0; k < 5; k++)
        for (int i = 0; i < 4; i++) row[k].x[i] = big_from(limit[k][i], 0);
    return feasible(equation, row, 5);
}

static int oracle_orient(const Vec3 v[4], int shift) {
    Big m[3][3], sum = {0};
    for (int i = 0; i < 3; i++) {
        Big origin = big_from(coordinate(v[0], i), shift);
        for (int k = 0; k < 3; k++) {
            Big x = big_from(coordinate(v[k + 1], i), shift);
            m[k][i] = big_subtract(&x, &origin);
        }
    }
    for (int i = 0; i < 3; i++)
        for (int s = 1; s <= 2; s++) {
            Big ab = big_multiply(&m[0][i], &m[1][(i + s) % 3]), abc = big_multiply(&ab, &m[2][(i + 2 * s) % 3]);
            if (s == 1) abc.sign = -abc.sign;
            sum = big_subtract(&sum, &abc);
        }
    return sum.sign;
}

/* --- cases --- */

static Vec3 grid(int r) {
    unsigned n = 2 * (unsigned)r + 1;
    return vec((int)dice_below(n) - r, (int)dice_below(n) - r, (int)dice_below(n) - r);
}
/* A coordinate as meshes are written: the double nearest to a whole number of millionths. */
static double written(double x) { return round(x * 1e6) / 1e6; }
static Vec3 written_point(Vec3 p) { return vec(written(p.x), written(p.y), written(p.z)); }
static double resized(double x) { return ldexp(x, (int)dice_below(60) - 30); }

static bool meets(const Vec3 v[5]) { return predicate_segment_triangle(v[0], v[1], v[2], v[3], v[4]); }

/* The same answer whichever way round. */
static bool symmetric(const Vec3 v[5], bool answer) {
    unsigned r = dice_below(12), i = 2 + r % 3, j = 2 + (r % 3 + 1 + r / 3 % 2) % 3, k = 9 - i - j, p = r / 6;
    return meets((Vec3[5]){v[p], v[1 - p], v[i], v[j], v[k]}) == answer;
}

/* Small whole numbers make every degenerate case there is, over and over. The same figure
   moved and scaled by powers of two must not answer differently. */
static void test_grid(int cases) {
    int wrong = 0, unsymmetric = 0, moved = 0, hits = 0, flat = 0;
    for (int n = 0; n < cases; n++) {
        Vec3 v[5], w[5];
        int range = 1 + (int)dice_below(3);
        double scale = ldexp(1, (int)dice_below(380) - 190), shift = n % 2 ? 0 : ldexp(scale, 40);
        for (int k = 0; k < 5; k++) {
            v[k] = k && dice_below(8) == 0 ? v[dice_below((unsigned)k)] : grid(range);
            w[k] = vec(v[k].x * scale + shift, v[k].y * scale - shift, v[k].z * scale + 2 * shift);
        }
        bool answer = meets(v);
        hits += answer;
        flat += predicate_orient(v[2], v[3], v[4], v[0]) == 0 && predicate_orient(v[2], v[3], v[4], v[1]) == 0;
        wrong += answer != oracle(v, 0);
        unsymmetric += !symmetric(v, answer);
        moved += meets(w) != answer;
    }
    OK(wrong == 0, "%d small whole-number pairs as the oracle says (%d meet, %d flat)", cases, hits, flat);
    OK(unsymmetric == 0, "the same whichever way round");
    OK(moved == 0, "the same when scaled by 1e-57 to 1e57 and moved a trillion units away");
}

/* Points of the triangle's plane, of its sides and corners, as far as doubles can express it;
   the segment goes through or ends there, so that each sign hangs on the last bit. */
static void nearly_degenerate(Vec3 v[5]) {
    for (int k = 0; k < 5; k++) v[k] = dice_around();
    if (dice_below(2)) v[4] = vec_mad(v[2], vec_sub(v[3], v[2]), dice_unit() * 2); /* nearly collapsed */
    if (dice_below(2)) v[4] = written_point(v[4]), v[3] = written_point(v[3]), v[2] = written_point(v[2]);
    double s = dice_below(3) ? dice_unit() : 0, t = dice_below(3) ? dice_unit() : 0;
    Vec3 x = vec_add(vec_add(vec_scale(v[2], 1 - s - t), vec_scale(v[3], s)), vec_scale(v[4], t));
    if (dice_below(2)) x = written_point(x);
    if (dice_below(2)) v[0] = written_point(v[0]);
    unsigned how = dice_below(4);
    if (how == 0) v[1] = x;                                                      /* ends in the plane */
    if (how == 1) v[1] = vec_sub(vec_scale(x, 2), v[0]);                         /* x is the middle */
    if (how == 2) v[0] = x, v[1] = vec_mad(x, vec_sub(v[3], v[4]), dice_unit()); /* in the plane */
    if (how == 3) v[0] = x, v[1] = dice_below(2) ? x : v[2 + dice_below(3)];     /* a point, or to a corner */
}

static void test_nearly_degenerate(int cases) {
    int wrong = 0, unsymmetric = 0, paper = 0, signs = 0;
    for (int n = 0; n < cases; n++) {
        Vec3 v[5];
        nearly_degenerate(v);
        bool right = oracle(v, 90), answer = meets(v);
        wrong += answer != right;
        unsymmetric += !symmetric(v, answer);
        paper += predicate_paper(v[0], v[1], v[2], v[3], v[4]) != right;
        signs += predicate_orient(v[0], v[2], v[3], v[4]) != oracle_orient((Vec3[4]){v[0], v[2], v[3], v[4]}, 90);
    }
    OK(wrong == 0, "%d nearly degenerate pairs as the oracle says", cases);
    OK(unsymmetric == 0, "the same whichever way round");
    OK(signs == 0, "their signs as the oracle says");
    OK(paper > cases / 100, "they are hard: the bare formulas fail on %d", paper);
}

/* Coordinates of very different size, and their planes: errors of differences count here. */
static void test_orient(int cases) {
    int wrong = 0, odd = 0, zero = 0;
    for (int n = 0; n < cases; n++) {
        Vec3 v[4];
        for (int k = 0; k < 4; k++) {
            v[k] = n % 2 ? grid(100) : dice_around();
            v[k] = vec(resized(v[k].x), resized(v[k].y), resized(v[k].z));
        }
        Vec3 in_plane = vec_mad(vec_scale(vec_sub(v[1], v[0]), 1 + dice_below(3)), vec_sub(v[2], v[0]), dice_unit());
        if (n % 3) v[3] = vec_add(v[0], in_plane);
        int s = predicate_orient(v[0], v[1], v[2], v[3]);
        wrong += s != oracle_orient(v, 120);
        odd += s != -predicate_orient(v[1], v[0], v[2], v[3]) || s != predicate_orient(v[1], v[2], v[0], v[3])
            || s != -predicate_orient(v[3], v[1], v[2], v[0]);
        zero += s == 0;
    }
    OK(wrong == 0, "%d orientations at sizes of 1e-9 to 1e9 as the oracle says (%d are zero)", cases, zero);
    OK(odd == 0, "swapping two points turns the sign round");
    Vec3 o = {0, 0, 0}, x = {1e60, 0, 0}, y = {0, 1e60, 0};
    OK(predicate_orient(o, x, y, vec(1e60, 1e60, 1e-60)) == 1, "1e-60 above a plane of 1e60");
    OK(predicate_orient(vec(1e-60, 0, 0), vec(0, 1e-60, 0), vec(0, 0, 1e-60), o) == -1, "a tetrahedron of 1e-60");
    OK(predicate_orient2(0, 0, 1, 1, 1 + 0x1p-52, 1 + 0x1p-52) == 0, "a point on a line in the plane");
    OK(predicate_orient2(-1, -1, 1, 1, 1e60, nextafter(1e60, 2e60)) == 1, "a point beside it by one bit");
}

/* Three points of a plane as near to one line as doubles can be; a fourth above makes it a
   question for the same oracle. */
static void test_orient2(int cases) {
    int wrong = 0, odd = 0, zero = 0;
    for (int n = 0; n < cases; n++) {
        Vec3 v[4] = {dice_around(), dice_around()};
        v[0].z = v[1].z = 0;
        v[2] = vec_lerp(v[0], v[1], n % 2 ? 0.5 : dice_unit() * 3 - 1);
        v[3] = vec(0, 0, 1);
        int s = predicate_orient2(v[0].x, v[0].y, v[1].x, v[1].y, v[2].x, v[2].y);
        wrong += s != oracle_orient(v, 90);
        odd += s != predicate_orient2(v[1].x, v[1].y, v[2].x, v[2].y, v[0].x, v[0].y)
            || s != -predicate_orient2(v[1].x, v[1].y, v[0].x, v[0].y, v[2].x, v[2].y);
        zero += s == 0;
    }
    OK(wrong == 0, "%d turns in the plane as the oracle says (%d are straight)", cases, zero);
    OK(odd == 0, "swapping two points turns the sign round there, too");
}

/* A segment from inside a closed surface to the outside must hit it, also through a corner or
   along a side: sides are shared, and each triangle must see the same sign. */
static void test_watertight(int cases) {
    int slipped = 0;
    for (int n = 0; n < cases; n++) {
        Vec3 axis[6];
        for (int k = 0; k < 6; k++) {
            double s = k < 3 ? 1 : -1, tilt = n % 2 ? 0.2 : 0;
            Vec3 along = vec(s * (k % 3 == 0), s * (k % 3 == 1), s * (k % 3 == 2));
            axis[k] = vec_mad(along, dice_point(), tilt);
        }
        Vec3 inside = vec_scale(dice_point(), 0.1);
        unsigned from = dice_below(3), to = 3 + (from + 1 + dice_below(2)) % 3;
        Vec3 on = vec_lerp(axis[from], axis[to], dice_below(2) ? dice_unit() : 0);
        Vec3 outside = vec_mad(inside, vec_sub(on, inside), 40);
        bool hit = false;
        for (int k = 0; k < 8; k++) {
            Vec3 x = axis[k & 1 ? 0 : 3], y = axis[k & 2 ? 1 : 4], z = axis[k & 4 ? 2 : 5];
            hit |= predicate_segment_triangle(inside, outside, x, y, z);
        }
        slipped += !hit;
    }
    OK(slipped == 0, "%d segments leave an octahedron near its sides and corners, none unseen", cases);
}

static void test_traps(void) {
    Vec3 a = {0, 0, 0}, b = {1, 0, 0}, c = {0, 1, 0}, far = {5, 5, 0}, further = {6, 7, 0}, inner = {0.25, 0.25, 0};
    Vec3 above = {0.25, 0.25, 1}, below_plane = {0.25, 0.25, -1};
    OK(!predicate_segment_triangle(far, further, a, b, c), "a coplanar segment far away is no hit");
    OK(predicate_paper(far, further, a, b, c), "(equations 3 and 4 to the letter call it one)");
    OK(predicate_segment_triangle(far, inner, a, b, c), "a coplanar segment that ends inside is a hit");
    OK(predicate_segment_triangle(vec(-1, 0.5, 0), vec(2, 0.5, 0), a, b, c), "a coplanar segment right across");
    OK(predicate_segment_triangle(inner, vec(0.3, 0.3, 0), a, b, c), "a coplanar segment wholly inside");
    OK(predicate_segment_triangle(vec(1, 1, 0), vec(0, 2, 0), a, vec(2, 0, 0), vec(0, 2, 0)), "along a side");
    OK(!predicate_segment_triangle(far, far, a, b, c), "a point of the plane far away is no hit");
    OK(predicate_segment_triangle(inner, inner, a, b, c), "a point inside the triangle is a hit");
    OK(predicate_segment_triangle(b, b, a, b, c), "a point at a corner");
    OK(!predicate_segment_triangle(above, above, a, b, c), "a point above is no hit");
    OK(!predicate_segment_triangle(far, above, b, b, b), "a triangle collapsed to a point is far");
    OK(predicate_paper(far, above, b, b, b), "(to the letter it is hit by everything)");
    OK(predicate_segment_triangle(above, below_plane, inner, inner, inner), "a segment through a collapsed triangle");
    OK(!predicate_segment_triangle(above, below_plane, a, b, vec(3, 0, 0)), "past a triangle collapsed to a line");
    OK(predicate_segment_triangle(vec(0.5, 0, 1), vec(0.5, 0, -1), a, vec(3, 0, 0), b), "through the middle of one");
    OK(predicate_segment_triangle(above, inner, a, b, c), "an end that touches from above");
    OK(predicate_segment_triangle(vec(0, 0, 1), vec(0, 0, -1), a, b, c), "through a corner");
    OK(predicate_segment_triangle(vec(0.5, 0.5, 1), vec(0.5, 0.5, -1), a, b, c), "through a side");
    Vec3 beside = {0.5, 0.5 + 0x1p-53, 1};
    OK(!predicate_segment_triangle(beside, vec(0.5, beside.y, -1), a, b, c), "past a side by one bit");
}

/* Where nothing is degenerate the paper is right. */
static void test_paper(int cases) {
    int differ = 0, hits = 0;
    for (int n = 0; n < cases; n++) {
        Vec3 v[5];
        for (int k = 0; k < 5; k++) v[k] = dice_around();
        bool hit = predicate_paper(v[0], v[1], v[2], v[3], v[4]);
        differ += hit != meets(v);
        hits += hit;
    }
    OK(differ == 0 && hits > cases / 50, "%d random pairs: the paper's equations agree (%d meet)", cases, hits);
}

/* The slow builds do a tenth: they look for undefined behaviour, not for rare cases. */
#ifdef VALIDATE
enum { SHARE = 10 };
#else
enum { SHARE = 1 };
#endif

int main(void) {
    test_traps();
    test_paper(200000 / SHARE);
    test_orient(100000 / SHARE);
    test_orient2(100000 / SHARE);
    test_watertight(50000 / SHARE);
    test_nearly_degenerate(100000 / SHARE);
    test_grid(1000000 / SHARE);
    return tap_done();
}
