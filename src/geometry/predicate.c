/* A sign is a decision, and a decision must not depend on rounding.

   Each sign is first taken in doubles: subtract first, multiply after, so that the error is
   relative to the size of the triangle and not to its distance from the origin. Beside the
   determinant stands its "permanent", the same sum with every term made positive; the error
   of the determinant is at most a few roundings of it. Where the determinant is larger, its
   sign is right. Where it is not, the same polynomial is computed without any rounding, as
   an expansion: a sum of doubles that do not overlap, smallest first, whose last term has
   the sign of the whole (Shewchuk 1997). That is slow, and rare outside degenerate input.

   With exact signs the geometry needs no tolerance. A segment and a triangle in general
   position meet by five signs, as in the paper. What is left is flat, and flat things meet
   exactly if their shadows on all three coordinate planes meet: see flat_overlap. */
#include "geometry/predicate.h"

#include <float.h>

#if FLT_EVAL_METHOD != 0
#error "numbers must be rounded after each operation, or no sign is exact; on 32-bit x86: CFLAGS='-msse2 -mfpmath=sse'"
#endif

static const double UNIT = DBL_EPSILON / 2; /* largest relative error of one rounding, 2^-53 */

static int sign(double x) { return (x > 0) - (x < 0); }

/* a + b = *sum + *error without error (Knuth). */
static void two_sum(double a, double b, double *sum, double *error) {
    double s = a + b, part_b = s - a, part_a = s - part_b;
    *error = (a - part_a) + (b - part_b);
    *sum = s;
}

/* a = *high + *low, each of at most 26 bits, so that products of such halves are exact (Dekker). */
static void split(double a, double *high, double *low) {
    double c = 134217729.0 * a; /* 2^27 + 1 */
    *high = c - (c - a);
    *low = a - *high;
}

/* a b = *product + *error without error. */
static void two_product(double a, double b, double *product, double *error) {
    double a1, a0, b1, b0, p = a * b;
    split(a, &a1, &a0);
    split(b, &b1, &b0);
    *error = a0 * b0 - (((p - a1 * b1) - a0 * b1) - a1 * b0);
    *product = p;
}

/* An exact sum: terms do not overlap, smallest first, none is zero. The largest polynomial
   here, three by three with every entry in two parts, adds 6 x 8 x 4 terms. */
typedef struct {
    int n;
    double term[192];
} Expansion;

static void add(Expansion *sum, double x) {
    int kept = 0;
    for (int i = 0; i < sum->n; i++) {
        double error;
        two_sum(x, sum->term[i], &x, &error);
        if (error != 0) sum->term[kept++] = error;
    }
    if (x != 0) sum->term[kept++] = x;
    sum->n = kept;
}

static void add_product(Expansion *sum, double a, double b) {
    double product, error;
    two_product(a, b, &product, &error);
    add(sum, error);
    add(sum, product);
}

static int expansion_sign(const Expansion *sum) { return sum->n ? sign(sum->term[sum->n - 1]) : 0; }

/* b - a in two parts, the rounded difference and what rounding lost. */
typedef struct { double part[2]; } Difference;

static Difference difference(double b, double a) {
    Difference d;
    two_sum(b, -a, &d.part[0], &d.part[1]);
    return d;
}

/* Adds s x y z for each choice of parts; most differences have no second part. */
static void add_triple(Expansion *sum, double s, Difference x, Difference y, Difference z) {
    for (int i = 0; i < 8; i++) {
        double f = s * x.part[i & 1], g = y.part[i >> 1 & 1], h = z.part[i >> 2], product, error;
        if (f == 0 || g == 0 || h == 0) continue;
        two_product(f, g, &product, &error);
        add_product(sum, error, h);
        add_product(sum, product, h);
    }
}

static int exact_orient(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    Difference bx = difference(b.x, a.x), by = difference(b.y, a.y), bz = difference(b.z, a.z);
    Difference cx = difference(c.x, a.x), cy = difference(c.y, a.y), cz = difference(c.z, a.z);
    Difference dx = difference(d.x, a.x), dy = difference(d.y, a.y), dz = difference(d.z, a.z);
    Expansion sum = {0};
    add_triple(&sum, 1, bx, cy, dz);
    add_triple(&sum, -1, bx, cz, dy);
    add_triple(&sum, 1, by, cz, dx);
    add_triple(&sum, -1, by, cx, dz);
    add_triple(&sum, 1, bz, cx, dy);
    add_triple(&sum, -1, bz, cy, dx);
    return expansion_sign(&sum);
}

/* Error bound. With u = 2^-53 a difference carries a factor (1 + e), |e| <= u; a product of
   two differences three such factors, the difference of two products four; times the third
   difference six, summed eight at most. So |computed - true| <= ((1 + u)^8 - 1) P, with P the
   true permanent, and P <= computed permanent / (1 - u)^8. Both together stay below 9 u times
   the computed permanent. */
int predicate_orient(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    Vec3 p = vec_sub(b, a), q = vec_sub(c, a), r = vec_sub(d, a);
    double yz = p.y * q.z, zy = p.z * q.y, zx = p.z * q.x, xz = p.x * q.z, xy = p.x * q.y, yx = p.y * q.x;
    double det = (yz - zy) * r.x + (zx - xz) * r.y + (xy - yx) * r.z;
    double permanent = (fabs(yz) + fabs(zy)) * fabs(r.x) + (fabs(zx) + fabs(xz)) * fabs(r.y)
                     + (fabs(xy) + fabs(yx)) * fabs(r.z);
    double bound = 9 * UNIT * permanent;
    if (det > bound || det < -bound) return sign(det);
    return permanent == 0 ? 0 : exact_orient(a, b, c, d);
}

/* As above, with four factors: differences, product, sum. */
int predicate_orient2(double ax, double ay, double bx, double by, double cx, double cy) {
    double left = (bx - ax) * (cy - ay), right = (by - ay) * (cx - ax), det = left - right;
    double bound = 5 * UNIT * (fabs(left) + fabs(right));
    if (det > bound || det < -bound) return sign(det);
    if (left == 0 && right == 0) return 0;
    Difference ux = difference(bx, ax), uy = difference(by, ay), vx = difference(cx, ax), vy = difference(cy, ay);
    Expansion sum = {0};
    for (int i = 0; i < 4; i++) {
        add_product(&sum, ux.part[i & 1], vy.part[i >> 1]);
        add_product(&sum, -uy.part[i & 1], vx.part[i >> 1]);
    }
    return expansion_sign(&sum);
}

typedef struct { double x, y; } Point;

static int turn(Point a, Point b, Point c) { return predicate_orient2(a.x, a.y, b.x, b.y, c.x, c.y); }

/* Order along any line: by x, then by y. */
static bool before(Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

/* Closed segments, of any length, also none. If all four points are on one line, the two
   intervals must overlap; else each segment must reach or cross the line of the other. */
static bool segments_meet(Point p, Point q, Point a, Point b) {
    int pa = turn(a, b, p), qa = turn(a, b, q), ap = turn(p, q, a), bp = turn(p, q, b);
    if (pa || qa || ap || bp) return pa * qa <= 0 && ap * bp <= 0;
    Point low1 = before(p, q) ? p : q, high1 = before(p, q) ? q : p;
    Point low2 = before(a, b) ? a : b, high2 = before(a, b) ? b : a;
    return !before(high1, low2) && !before(high2, low1);
}

/* A closed segment and a closed triangle of the plane, either of them perhaps collapsed: the
   segment meets a side, or it lies inside altogether. */
static bool shadows_meet(Point p, Point q, Point a, Point b, Point c) {
    if (segments_meet(p, q, a, b) || segments_meet(p, q, b, c) || segments_meet(p, q, c, a)) return true;
    int s = turn(a, b, p);
    return s != 0 && s == turn(b, c, p) && s == turn(c, a, p);
}

/* Five points of one plane (or line, or one point). Sets that meet have shadows that meet. And
   on at least one coordinate plane the shadow is one to one, since no plane is upright on all
   three; shadows that meet there come from sets that meet. */
static bool flat_overlap(Vec3 p, Vec3 q, Vec3 a, Vec3 b, Vec3 c) {
#define ON(v, i, j) (Point){v.i, v.j}
#define SHADOWS_MEET(i, j) shadows_meet(ON(p, i, j), ON(q, i, j), ON(a, i, j), ON(b, i, j), ON(c, i, j))
    return SHADOWS_MEET(x, y) && SHADOWS_MEET(y, z) && SHADOWS_MEET(z, x);
#undef SHADOWS_MEET
#undef ON
}

/* All five signs, exactly. */
static bool meet_exactly(Vec3 p, Vec3 q, Vec3 a, Vec3 b, Vec3 c) {
    int side_p = predicate_orient(a, b, c, p), side_q = predicate_orient(a, b, c, q);
    if (side_p * side_q > 0) return false;
    /* The line p-q passes each side of the triangle on its left or on its right. */
    int ab = predicate_orient(p, q, a, b), bc = predicate_orient(p, q, b, c), ca = predicate_orient(p, q, c, a);
    if (side_p || side_q) return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
    /* Here the points share a plane, or the triangle has collapsed; if then the line still
       passes a side, it is skew to what is left of the triangle. */
    return !ab && !bc && !ca && flat_overlap(p, q, a, b, c);
}

/* The same five signs in doubles, with p as the origin: three cross products serve them all,
   and the volume under q is the volume under p less the three beside the line. With m the
   largest difference, one volume errs by at most 9 u x 6 m^3, the volume under q by less than
   four times that and its own roundings, 300 u m^3 in all. 2^-44 is 512 u. */
bool predicate_segment_triangle(Vec3 p, Vec3 q, Vec3 a, Vec3 b, Vec3 c) {
    Vec3 d = vec_sub(q, p), u = vec_sub(a, p), v = vec_sub(b, p), w = vec_sub(c, p);
    double m = larger(larger(vec_extent(d), vec_extent(u)), larger(vec_extent(v), vec_extent(w)));
    double bound = 0x1p-44 * m * m * m;
    Vec3 vw = vec_cross(v, w);
    double ab = vec_dot(d, vec_cross(u, v)), bc = vec_dot(d, vw), ca = vec_dot(d, vec_cross(w, u));
    double under_p = vec_dot(u, vw), under_q = under_p - (ab + bc + ca);
    if ((under_p > bound && under_q > bound) || (under_p < -bound && under_q < -bound)) return false;
    bool left = ab > bound || bc > bound || ca > bound, right = ab < -bound || bc < -bound || ca < -bound;
    if (left && right) return false;
    bool crosses = (under_p > bound && under_q < -bound) || (under_p < -bound && under_q > bound);
    bool inside = (ab > bound && bc > bound && ca > bound) || (ab < -bound && bc < -bound && ca < -bound);
    return (crosses && inside) || meet_exactly(p, q, a, b, c);
}

/* [a, b, c, d] of equation (2): the second index is the base point. */
static double paper_product(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    return vec_dot(vec_sub(a, b), vec_cross(vec_sub(c, b), vec_sub(d, b)));
}

bool predicate_paper(Vec3 a, Vec3 b, Vec3 v0, Vec3 v1, Vec3 v2) {
    double sa = paper_product(a, v0, v1, v2), sb = paper_product(b, v0, v1, v2);
    if (sa * sb > 0) return false;
    double s01 = paper_product(a, b, v0, v1), s12 = paper_product(a, b, v1, v2), s20 = paper_product(a, b, v2, v0);
    return (sa >= 0 && sb <= 0 && s01 >= 0 && s12 >= 0 && s20 >= 0)
        || (sa <= 0 && sb >= 0 && s01 <= 0 && s12 <= 0 && s20 <= 0);
}
