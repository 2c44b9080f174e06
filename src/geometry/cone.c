/* On the unit sphere the cone is the smallest circle round the vectors' ends, and two or three of these are on it.
   It is found as in the plane (Welzl 1991): a point outside the circle found so far must be on the new one. */
#include "geometry/cone.h"

#include <stdbool.h>

static const double EPSILON = 1e-12; /* a point whose cosine is less by this is outside */

/* The unit vector at equal angles to a, b and c, on their side. */
static Vec3 centre(Vec3 a, Vec3 b, Vec3 c) {
    Vec3 axis = vec_unit_or(vec_cross(vec_sub(b, a), vec_sub(c, a)), a);
    return vec_dot(axis, a) < 0 ? vec_scale(axis, -1) : axis;
}

static bool is_outside(Vec3 axis, Vec3 on, Vec3 p) { return vec_dot(axis, p) < vec_dot(axis, on) - EPSILON; }

double cone_axis(const Vec3 *p, int n, Vec3 *axis) {
    Vec3 a = p[0];
    for (int i = 1, on = 0; i < n; i++) {
        if (!is_outside(a, p[on], p[i])) continue;
        a = p[on = i];
        for (int j = 0; j < i; j++) {
            if (!is_outside(a, p[i], p[j])) continue;
            a = vec_unit_or(vec_add(p[i], p[j]), p[i]);
            for (int k = 0; k < j; k++)
                if (is_outside(a, p[i], p[k])) a = centre(p[i], p[j], p[k]);
        }
    }
    double least = 1;
    for (int i = 0; i < n; i++) least = fmin(least, vec_dot(a, p[i]));
    *axis = a;
    return least;
}
