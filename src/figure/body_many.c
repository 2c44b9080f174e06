/* body_distance for many points. Sixteen points stand side by side, and every step is a loop over them without a
   branch, which the compiler turns into SIMD code. Every sum and root is taken in the order of body_distance, so
   that both give the same bits.

   There are three steps: is the point near at all; the first tangent plane; a second one where the surface leans.
   Fewer points need each next step, so they wait in a queue until sixteen can take it together. */
#include "figure/body.h"

enum { LANES = 16 };

typedef struct { double x[LANES], y[LANES], z[LANES]; } Lanes;

/* What is asked, and where the answers go. */
typedef struct {
    const BodyPart *part;
    const Rigid *to_part;
    const Vec3 *p;
    double far, *out;
    Vec3 *normal; /* or NULL */
} Asked;

/* The points of[0..n-1] in the part's frame; lanes beyond the n-th repeat the last. */
ALWAYS void bring(const Asked *asked, const int *of, int n, Lanes *out) {
    Mat3 m = asked->to_part->r;
    Vec3 t = asked->to_part->t;
    Lanes in;
    for (int i = 0; i < LANES; i++) {
        Vec3 q = asked->p[of[i < n ? i : n - 1]];
        in.x[i] = q.x;
        in.y[i] = q.y;
        in.z[i] = q.z;
    }
    for (int i = 0; i < LANES; i++) {
        out->x[i] = m.r[0].x * in.x[i] + m.r[0].y * in.y[i] + m.r[0].z * in.z[i] + t.x;
        out->y[i] = m.r[1].x * in.x[i] + m.r[1].y * in.y[i] + m.r[1].z * in.z[i] + t.y;
        out->z[i] = m.r[2].x * in.x[i] + m.r[2].y * in.y[i] + m.r[2].z * in.z[i] + t.z;
    }
}

/* near[i]: may lane i be nearer than `far`? Returns whether any lane may. */
ALWAYS int find_near(const BodyPart *part, const Lanes *p, double far, int near[LANES]) {
    double limit = part->reach + far;
    int any = 0;
    for (int i = 0; i < LANES; i++) {
        double over = p->y[i] - part->high, under = part->low - p->y[i], beyond = over > under ? over : under;
        double away = p->x[i] * p->x[i] + p->z[i] * p->z[i];
        near[i] = (beyond < far) & (away < limit * limit);
        any |= near[i];
    }
    return any;
}

/* The five values and their slopes at heights y, in interval s between sections. */
ALWAYS void shapes_in(const BodyPart *part, int s, const double y[LANES], double v[SHAPE_VALUES][LANES],
                      double d[SHAPE_VALUES][LANES]) {
    double at = part->section[s].at;
    for (int k = 0; k < SHAPE_VALUES; k++) {
        double c0 = part->cubic[s][0][k], c1 = part->cubic[s][1][k], c2 = part->cubic[s][2][k];
        double c3 = part->cubic[s][3][k];
        for (int i = 0; i < LANES; i++) {
            double t = y[i] - at;
            v[k][i] = c0 + t * (c1 + t * (c2 + t * c3));
            d[k][i] = c1 + t * (2 * c2 + t * 3 * c3);
        }
    }
}

/* The same, but only for lanes whose y is in this interval or above; the others keep what they have. */
ALWAYS void shapes_from(const BodyPart *part, int s, const double y[LANES], double v[SHAPE_VALUES][LANES],
                        double d[SHAPE_VALUES][LANES]) {
    double at = part->section[s].at;
    for (int k = 0; k < SHAPE_VALUES; k++) {
        double c0 = part->cubic[s][0][k], c1 = part->cubic[s][1][k], c2 = part->cubic[s][2][k];
        double c3 = part->cubic[s][3][k];
        for (int i = 0; i < LANES; i++) {
            double t = y[i] - at, value = c0 + t * (c1 + t * (c2 + t * c3));
            double slope = c1 + t * (2 * c2 + t * 3 * c3), old = v[k][i], old_slope = d[k][i];
            v[k][i] = y[i] >= at ? value : old;
            d[k][i] = y[i] >= at ? slope : old_slope;
        }
    }
}

/* Points that are near each other lie in few intervals. Each of these is evaluated for all lanes, from the lowest
   up, and kept by the lanes that are in it or above. */
ALWAYS void shapes_at(const BodyPart *part, const double y[LANES], double v[SHAPE_VALUES][LANES],
                      double d[SHAPE_VALUES][LANES]) {
    double least = y[0], most = y[0];
    for (int i = 1; i < LANES; i++) {
        least = y[i] < least ? y[i] : least;
        most = y[i] > most ? y[i] : most;
    }
    int first = body_interval(part, least), last = body_interval(part, most);
    shapes_in(part, first, y, v, d);
    for (int s = first + 1; s <= last; s++) shapes_from(part, s, y, v, d);
}

/* before_plane of body.c for every lane. */
ALWAYS void before_planes(const BodyPart *part, const Lanes *at, const Lanes *p, double distance[LANES], Lanes *n) {
    Lanes s;
    double v[SHAPE_VALUES][LANES], d[SHAPE_VALUES][LANES];
    double low = part->low + part->pole, high = part->high - part->pole;
    for (int i = 0; i < LANES; i++) {
        double y = at->y[i] < low ? low : at->y[i];
        s.y[i] = y > high ? high : y;
    }
    shapes_at(part, s.y, v, d);
    for (int i = 0; i < LANES; i++) {
        double dx = at->x[i] - v[0][i], dz = at->z[i] - v[1][i];
        double front = v[3][i], back = v[4][i], front_slope = d[3][i], back_slope = d[4][i];
        double side = v[2][i], depth = dz >= 0 ? front : back, slope = dz >= 0 ? front_slope : back_slope;
        double per_x = 1 / side, per_z = 1 / depth, ux = dx * per_x, uz = dz * per_z, f = sqrt(ux * ux + uz * uz);
        double per_f = 1 / (f > 1e-9 ? f : 1), x = ux * per_f, z = uz * per_f;
        double flat = side <= depth ? 1 : 0; /* on the axis the way out is along the shorter half axis */
        ux = f > 1e-9 ? x : flat;
        uz = f > 1e-9 ? z : 1 - flat;
        double gx = ux * per_x, gz = uz * per_z;
        double gy = -(gx * (d[0][i] + ux * d[2][i]) + gz * (d[1][i] + uz * slope));
        double size = 1 / sqrt(gx * gx + gy * gy + gz * gz);
        n->x[i] = gx * size;
        n->y[i] = gy * size;
        n->z[i] = gz * size;
        s.x[i] = v[0][i] + ux * side;
        s.z[i] = v[1][i] + uz * depth;
        distance[i] = (p->x[i] - s.x[i]) * n->x[i] + (p->y[i] - s.y[i]) * n->y[i] + (p->z[i] - s.z[i]) * n->z[i];
    }
}

/* Points that wait for a step: at most fifteen when the next sixteen come. */
typedef struct { int n, of[2 * LANES]; } Queue;

/* Removes the first sixteen. */
static void advance(Queue *q) {
    for (int i = LANES; i < q->n; i++) q->of[i - LANES] = q->of[i];
    q->n = q->n > LANES ? q->n - LANES : 0;
}

/* Queues the points first..first+n-1 that are near. */
ALWAYS void find(const Asked *asked, int first, int n, Queue *queue) {
    int of[LANES], near[LANES];
    Lanes p;
    for (int i = 0; i < LANES; i++) of[i] = first + i;
    bring(asked, of, n, &p);
    if (!find_near(asked->part, &p, asked->far, near)) return;
    for (int i = 0; i < n; i++) {
        queue->of[queue->n] = first + i;
        queue->n += near[i];
    }
}

/* Points that wait for the second plane, and what the first one told of them. */
typedef struct {
    Queue queue;
    double distance[2 * LANES];
    Vec3 normal[2 * LANES];
} Leaning;

ALWAYS void answer(const Asked *asked, int of, double distance, Vec3 normal) {
    asked->out[of] = distance < asked->far ? distance : asked->far;
    if (asked->normal) asked->normal[of] = normal;
}

/* The first plane: answers the first sixteen of the queue, and queues those where the surface leans. */
ALWAYS void look(const Asked *asked, Queue *queue, Leaning *leaning) {
    Lanes p, n;
    double distance[LANES];
    int count = queue->n < LANES ? queue->n : LANES;
    bring(asked, queue->of, count, &p);
    before_planes(asked->part, &p, &p, distance, &n);
    for (int i = 0; i < count; i++) {
        int k = leaning->queue.n, leans = (distance[i] < asked->far) & (fabs(n.y[i]) > BODY_LEANING);
        Vec3 normal = vec(n.x[i], n.y[i], n.z[i]);
        answer(asked, queue->of[i], distance[i], normal);
        leaning->queue.of[k] = queue->of[i];
        leaning->distance[k] = distance[i];
        leaning->normal[k] = normal;
        leaning->queue.n += leans;
    }
    advance(queue);
}

/* The second plane, where the perpendicular on the first one ends. */
ALWAYS void look_again(const Asked *asked, Leaning *leaning) {
    Lanes p, foot, n;
    double better[LANES];
    int count = leaning->queue.n < LANES ? leaning->queue.n : LANES;
    bring(asked, leaning->queue.of, count, &p);
    for (int i = 0; i < LANES; i++) {
        int k = i < count ? i : count - 1;
        double distance = leaning->distance[k];
        foot.x[i] = p.x[i] + leaning->normal[k].x * -distance;
        foot.y[i] = p.y[i] + leaning->normal[k].y * -distance;
        foot.z[i] = p.z[i] + leaning->normal[k].z * -distance;
    }
    before_planes(asked->part, &foot, &p, better, &n);
    for (int i = 0; i < count; i++)
        if ((better[i] > 0) == (leaning->distance[i] > 0))
            answer(asked, leaning->queue.of[i], better[i], vec(n.x[i], n.y[i], n.z[i]));
    for (int i = LANES; i < leaning->queue.n; i++) {
        leaning->distance[i - LANES] = leaning->distance[i];
        leaning->normal[i - LANES] = leaning->normal[i];
    }
    advance(&leaning->queue);
}

ALWAYS void all(const BodyPart *part, const Rigid *to_part, const Vec3 *p, int n, double far, double *out,
                Vec3 *normal) {
    Asked asked = {part, to_part, p, far, out, normal};
    Queue queue;
    Leaning leaning;
    queue.n = leaning.queue.n = 0;
    for (int i = 0; i < n; i++) out[i] = far;
    for (int first = 0; first < n || queue.n + leaning.queue.n > 0; first += LANES) {
        bool is_last = first + LANES >= n;
        if (first < n) find(&asked, first, is_last ? n - first : LANES, &queue);
        if (queue.n >= LANES || (is_last && queue.n > 0)) look(&asked, &queue, &leaning);
        if (leaning.queue.n >= LANES || (is_last && queue.n == 0 && leaning.queue.n > 0)) look_again(&asked, &leaning);
    }
}

#ifdef VECTORS_ARE_X86
FOR_AVX2 static void all_avx2(const BodyPart *part, const Rigid *to_part, const Vec3 *p, int n, double far,
                              double *out, Vec3 *normal) {
    all(part, to_part, p, n, far, out, normal);
}

FOR_AVX512 static void all_avx512(const BodyPart *part, const Rigid *to_part, const Vec3 *p, int n, double far,
                                  double *out, Vec3 *normal) {
    all(part, to_part, p, n, far, out, normal);
}
#endif

void body_distances(const BodyPart *part, Vectors vectors, const Rigid *to_part, const Vec3 *p, int n, double far,
                    double *out, Vec3 *normal) {
    vectors = vectors_pick(vectors);
#ifdef VECTORS_ARE_X86
    if (vectors == VECTORS_AVX512) all_avx512(part, to_part, p, n, far, out, normal);
    else if (vectors == VECTORS_AVX2) all_avx2(part, to_part, p, n, far, out, normal);
    else
#endif
        all(part, to_part, p, n, far, out, normal);
}
