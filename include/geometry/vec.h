/* Vectors, rotations and boxes, by value. Column vectors; Mat3 stores rows. */
#ifndef GEOMETRY_VEC_H
#define GEOMETRY_VEC_H

#include <math.h>
#include <stdbool.h>

#define PI 3.14159265358979323846

typedef struct { double x, y, z; } Vec3;
typedef struct { Vec3 r[3]; } Mat3;            /* rows */
typedef struct { Mat3 r; Vec3 t; } Rigid;      /* p' = r p + t */
typedef struct { double w, x, y, z; } Quat;    /* unit quaternion, w real */
typedef struct { Vec3 low, high; } Box;

/* As fmax, which compilers do not inline; b where one of them is no number. */
static inline double larger(double a, double b) { return a > b ? a : b; }

static inline Vec3 vec(double x, double y, double z) { return (Vec3){x, y, z}; }
static inline Vec3 vec_add(Vec3 a, Vec3 b) { return vec(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline Vec3 vec_sub(Vec3 a, Vec3 b) { return vec(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline Vec3 vec_scale(Vec3 a, double s) { return vec(a.x * s, a.y * s, a.z * s); }
/* a + s b */
static inline Vec3 vec_mad(Vec3 a, Vec3 b, double s) { return vec(a.x + b.x * s, a.y + b.y * s, a.z + b.z * s); }
static inline Vec3 vec_lerp(Vec3 a, Vec3 b, double t) { return vec_mad(a, vec_sub(b, a), t); }
static inline Vec3 vec_mid(Vec3 a, Vec3 b) { return vec(0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.5 * (a.z + b.z)); }
static inline double vec_dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline Vec3 vec_cross(Vec3 a, Vec3 b) {
    return vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
static inline double vec_len(Vec3 a) { return sqrt(vec_dot(a, a)); }
static inline double vec_dist(Vec3 a, Vec3 b) { return vec_len(vec_sub(a, b)); }
/* Unit vector; `fallback` where a has no direction. */
static inline Vec3 vec_unit_or(Vec3 a, Vec3 fallback) {
    double n = vec_len(a);
    return n > 1e-300 ? vec_scale(a, 1.0 / n) : fallback;
}
/* The largest coordinate, without its sign. */
static inline double vec_extent(Vec3 a) { return larger(fabs(a.x), larger(fabs(a.y), fabs(a.z))); }
static inline bool vec_finite(Vec3 a) { return isfinite(a.x) && isfinite(a.y) && isfinite(a.z); }

static inline Mat3 mat_identity(void) { return (Mat3){{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; }
static inline Vec3 mat_apply(Mat3 m, Vec3 v) { return vec(vec_dot(m.r[0], v), vec_dot(m.r[1], v), vec_dot(m.r[2], v)); }
static inline Mat3 mat_transpose(Mat3 m) {
    return (Mat3){{{m.r[0].x, m.r[1].x, m.r[2].x}, {m.r[0].y, m.r[1].y, m.r[2].y}, {m.r[0].z, m.r[1].z, m.r[2].z}}};
}
static inline Mat3 mat_mul(Mat3 a, Mat3 b) {
    Mat3 t = mat_transpose(b), m;
    for (int i = 0; i < 3; i++) m.r[i] = vec(vec_dot(a.r[i], t.r[0]), vec_dot(a.r[i], t.r[1]), vec_dot(a.r[i], t.r[2]));
    return m;
}
/* The matrix whose columns are x, y and z. */
static inline Mat3 mat_columns(Vec3 x, Vec3 y, Vec3 z) { return mat_transpose((Mat3){{x, y, z}}); }
static inline Vec3 mat_column(Mat3 m, int i) {
    if (i == 0) return vec(m.r[0].x, m.r[1].x, m.r[2].x);
    if (i == 1) return vec(m.r[0].y, m.r[1].y, m.r[2].y);
    return vec(m.r[0].z, m.r[1].z, m.r[2].z);
}
/* Rotation by `angle` radians about the unit vector `axis`. */
static inline Mat3 mat_axis_angle(Vec3 axis, double angle) {
    double c = cos(angle), s = sin(angle), k = 1 - c, x = axis.x, y = axis.y, z = axis.z;
    return (Mat3){{{c + x * x * k, x * y * k - z * s, x * z * k + y * s},
                   {y * x * k + z * s, c + y * y * k, y * z * k - x * s},
                   {z * x * k - y * s, z * y * k + x * s, c + z * z * k}}};
}
/* Smallest rotation that takes unit vector a to unit vector b. For opposite vectors it turns
   about the axis perpendicular to a that lies nearest to +x. */
static inline Mat3 mat_between(Vec3 a, Vec3 b) {
    double c = vec_dot(a, b);
    if (c < -0.999999) {
        Vec3 axis = vec_unit_or(vec_mad(vec(1, 0, 0), a, -a.x), vec(0, 0, 1));
        return mat_axis_angle(axis, PI);
    }
    Vec3 v = vec_cross(a, b);
    double k = 1.0 / (1.0 + c);
    return (Mat3){{{v.x * v.x * k + c, v.x * v.y * k - v.z, v.x * v.z * k + v.y},
                   {v.y * v.x * k + v.z, v.y * v.y * k + c, v.y * v.z * k - v.x},
                   {v.z * v.x * k - v.y, v.z * v.y * k + v.x, v.z * v.z * k + c}}};
}

static inline Rigid rigid_identity(void) { return (Rigid){mat_identity(), {0, 0, 0}}; }
static inline Vec3 rigid_apply(Rigid g, Vec3 p) { return vec_add(mat_apply(g.r, p), g.t); }
static inline Vec3 rigid_unapply(Rigid g, Vec3 p) { return mat_apply(mat_transpose(g.r), vec_sub(p, g.t)); }
/* a after b */
static inline Rigid rigid_mul(Rigid a, Rigid b) { return (Rigid){mat_mul(a.r, b.r), rigid_apply(a, b.t)}; }
static inline Rigid rigid_inverse(Rigid g) {
    Mat3 t = mat_transpose(g.r);
    return (Rigid){t, vec_scale(mat_apply(t, g.t), -1)};
}

static inline Quat quat_from_mat(Mat3 m) {
    double xx = m.r[0].x, yy = m.r[1].y, zz = m.r[2].z, trace = xx + yy + zz;
    double yz = m.r[2].y - m.r[1].z, zx = m.r[0].z - m.r[2].x, xy = m.r[1].x - m.r[0].y; /* differences */
    double sxy = m.r[0].y + m.r[1].x, sxz = m.r[0].z + m.r[2].x, syz = m.r[1].z + m.r[2].y; /* sums */
    Quat q;
    if (trace > 0) q = (Quat){1 + trace, yz, zx, xy};
    else if (xx > yy && xx > zz) q = (Quat){yz, 1 + xx - yy - zz, sxy, sxz};
    else if (yy > zz) q = (Quat){zx, sxy, 1 + yy - xx - zz, syz};
    else q = (Quat){xy, sxz, syz, 1 + zz - xx - yy};
    double n = 1.0 / sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return (Quat){q.w * n, q.x * n, q.y * n, q.z * n};
}
static inline Mat3 mat_from_quat(Quat q) {
    double w = q.w, x = q.x, y = q.y, z = q.z;
    return (Mat3){{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                   {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                   {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}
static inline double lerp(double a, double b, double t) { return a + t * (b - a); }

/* Of the two that are the same rotation as q, the one on the side of `like`. */
static inline Quat quat_like(Quat q, Quat like) {
    double dot = q.w * like.w + q.x * like.x + q.y * like.y + q.z * like.z;
    return dot < 0 ? (Quat){-q.w, -q.x, -q.y, -q.z} : q;
}
/* Shortest-arc normalised interpolation. */
static inline Quat quat_nlerp(Quat a, Quat b, double t) {
    b = quat_like(b, a);
    Quat q = {lerp(a.w, b.w, t), lerp(a.x, b.x, t), lerp(a.y, b.y, t), lerp(a.z, b.z, t)};
    double n = 1.0 / sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return (Quat){q.w * n, q.x * n, q.y * n, q.z * n};
}
static inline Mat3 mat_nlerp(Mat3 a, Mat3 b, double t) {
    return mat_from_quat(quat_nlerp(quat_from_mat(a), quat_from_mat(b), t));
}

static inline Box box_empty(void) { return (Box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}}; }
static inline Box box_all(void) { return (Box){box_empty().high, box_empty().low}; }
static inline void box_add(Box *b, Vec3 p) {
    Vec3 low = b->low, high = b->high;
    b->low = vec(p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y, p.z < low.z ? p.z : low.z);
    b->high = vec(p.x > high.x ? p.x : high.x, p.y > high.y ? p.y : high.y, p.z > high.z ? p.z : high.z);
}

static inline double square(double x) { return x * x; }
static inline double clamp(double x, double low, double high) { return x < low ? low : x > high ? high : x; }
/* 0 below a, 1 above b, 3t^2 - 2t^3 between. */
static inline double smoothstep(double a, double b, double x) {
    double t = clamp((x - a) / (b - a), 0, 1);
    return t * t * (3 - 2 * t);
}

#endif
