/* A triangle's height is that above its longest side; the corner opposite is the one to move. */
#include "geometry/flat.h"

#include <stdbool.h>

static const double HIGHER = 4;   /* times the least height */
static const double NOISE = 1e-3; /* of that: a corner less far from its side stands on it */

/* The corner opposite the longest side, which runs from corner + 1 to corner + 2; -1 if the triangle is high enough. */
static int top_of_flat(const Vec3 *p, const int v[3], double least) {
    Vec3 a = vec_sub(p[v[1]], p[v[0]]), b = vec_sub(p[v[2]], p[v[0]]), n = vec_cross(a, b);
    double a2 = vec_dot(a, a), b2 = vec_dot(b, b), area = vec_dot(n, n) / (least * least);
    if (area >= 2 * (a2 + b2) && area > 0) return -1; /* no side is longer than that */
    Vec3 c = vec_sub(b, a);
    double c2 = vec_dot(c, c), longest2 = fmax(a2, fmax(b2, c2));
    if (area >= longest2 && area > 0) return -1;
    return c2 == longest2 ? 0 : b2 == longest2 ? 1 : 2;
}

/* Any unit vector square to a. */
static Vec3 square_to(Vec3 a) {
    Vec3 x = fabs(a.x) < 0.5 ? vec(1, 0, 0) : vec(0, 1, 0);
    return vec_unit_or(vec_cross(a, x), x);
}

/* The corner p opposite the side from a to b, `high` above it. */
static Vec3 raised(Vec3 a, Vec3 b, Vec3 p, double high, bool out_of_plane) {
    Vec3 along = vec_unit_or(vec_sub(b, a), vec(1, 0, 0));
    Vec3 foot = vec_mad(a, along, vec_dot(vec_sub(p, a), along)), up = vec_sub(p, foot);
    up = vec_len(up) > NOISE * high ? vec_unit_or(up, along) : square_to(along);
    return vec_mad(foot, out_of_plane ? vec_cross(along, up) : up, high);
}

static bool is_listed(const int *vertex, int n, int v) {
    for (int k = 0; k < n; k++)
        if (vertex[k] == v) return true;
    return false;
}

int flat_find(const Vec3 *position, const Triangle *triangle, int ntriangles, double least, int round, int *vertex,
              Vec3 *to, int capacity) {
    int n = 0;
    for (int t = 0; t < ntriangles && n < capacity; t++) {
        const int *v = triangle[t].v;
        int top = top_of_flat(position, v, least);
        if (top < 0 || is_listed(vertex, n, v[top])) continue;
        vertex[n] = v[top];
        to[n++] = raised(position[v[(top + 1) % 3]], position[v[(top + 2) % 3]], position[v[top]], HIGHER * least,
                         round % 2 == 1);
    }
    return n;
}
