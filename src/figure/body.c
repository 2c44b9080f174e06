/* One part of the body: a generalised cone. Its surface is given by five functions of y alone, piecewise cubics: the
   centre and the half sizes of the section at y. The skin patches are the same cubics in Bezier form, and distances are
   computed from the same cubics, so that what is drawn, tested and pushed against is one surface. */
#include "figure/body.h"

#include <string.h>

/* Caps: a quarter ellipse sampled at 35, 65 and 90 degrees. */
static const double CAP_RISE[CAP_SECTIONS] = {0.57357643635104609, 0.90630778703664996, 1};
static const double CAP_SIZE[CAP_SECTIONS] = {0.81915204428899180, 0.42261826174069944, 0};

/* A round end meets its axis at a right angle, which no finite slope can say. With this many
   times the secant the cubic follows the ellipse's last 25 degrees best; 3 would be the bound
   of monotony. */
static const double TIP_STEEPNESS = 2.2;

static void values_of(const Section *s, double v[SHAPE_VALUES]) {
    v[0] = s->x;
    v[1] = s->z;
    v[2] = s->side;
    v[3] = s->front;
    v[4] = s->back;
}

/* Prepends and appends the caps. Without a height of its own a cap is as high as the end
   section's smaller half size: a round limb then ends in a half ball, and two limbs that share
   a joint bend without a gap. */
static void add_caps(BodyPart *part, const double cap[2]) {
    Section body[SECTIONS_MAX];
    int n = part->nsections;
    memcpy(body, part->section, (size_t)n * sizeof *body);
    memcpy(part->section + CAP_SECTIONS, body, (size_t)n * sizeof *body);
    for (int end = 0; end < 2; end++) {
        Section rim = end ? body[n - 1] : body[0];
        double height = cap[end] > 0 ? cap[end] : fmin(rim.side, 0.5 * (rim.front + rim.back));
        for (int k = 0; k < CAP_SECTIONS; k++) {
            Section *s = &part->section[end ? CAP_SECTIONS + n + k : CAP_SECTIONS - 1 - k];
            *s = rim;
            s->at += (end ? height : -height) * CAP_RISE[k];
            s->side *= CAP_SIZE[k];
            s->front *= CAP_SIZE[k];
            s->back *= CAP_SIZE[k];
        }
    }
    part->nsections = n + 2 * CAP_SECTIONS;
}

/* Fritsch and Carlson's condition in Brodlie's form: the weighted harmonic mean of the two
   secants, 0 where they disagree in sign. The cubic then never overshoots the sections. */
static double monotone_slope(double h0, double secant0, double h1, double secant1) {
    if (secant0 * secant1 <= 0) return 0;
    double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
    return (w0 + w1) / (w0 / secant0 + w1 / secant1);
}

static void fill_cubics(BodyPart *part) {
    int n = part->nsections;
    double value[SECTIONS_MAX][SHAPE_VALUES], slope[SECTIONS_MAX], step[SECTIONS_MAX], secant[SECTIONS_MAX];
    for (int i = 0; i < n; i++) values_of(&part->section[i], value[i]);
    for (int k = 0; k < SHAPE_VALUES; k++) {
        for (int i = 0; i + 1 < n; i++) {
            step[i] = part->section[i + 1].at - part->section[i].at;
            secant[i] = (value[i + 1][k] - value[i][k]) / step[i];
        }
        slope[0] = TIP_STEEPNESS * secant[0];
        slope[n - 1] = TIP_STEEPNESS * secant[n - 2];
        for (int i = 1; i + 1 < n; i++) slope[i] = monotone_slope(step[i - 1], secant[i - 1], step[i], secant[i]);
        part->cubic[n - 1][0][k] = value[n - 1][k];
        for (int i = 0; i + 1 < n; i++) {
            double h = step[i], bend = 3 * secant[i] - 2 * slope[i] - slope[i + 1];
            part->cubic[i][0][k] = value[i][k];
            part->cubic[i][1][k] = slope[i];
            part->cubic[i][2][k] = bend / h;
            part->cubic[i][3][k] = (slope[i] + slope[i + 1] - 2 * secant[i]) / (h * h);
        }
    }
}

static double reach_of(const BodyPart *part) {
    double reach = 0;
    for (int i = 0; i < part->nsections; i++) {
        const Section *s = &part->section[i];
        reach = fmax(reach, hypot(s->x, s->z) + fmax(s->side, fmax(s->front, s->back)));
    }
    return reach;
}

void body_part_close(BodyPart *part, const double cap[2]) {
    add_caps(part, cap);
    fill_cubics(part);
    int last = part->nsections - 1;
    part->low = part->section[0].at;
    part->high = part->section[last].at;
    part->pole = BODY_POLE * (part->high - part->low);
    part->reach = reach_of(part);
    part->buckets_per_metre = BODY_BUCKETS / (part->high - part->low);
    for (int b = 0, i = 0; b < BODY_BUCKETS; b++) {
        double y = part->low + b / part->buckets_per_metre;
        while (i + 1 < last && part->section[i + 1].at <= y) i++;
        part->bucket[b] = (unsigned char)i;
    }
}

/* The five values and their slopes in interval i. */
static inline void shape_in(const BodyPart *part, int i, double y, double v[SHAPE_VALUES], double d[SHAPE_VALUES]) {
    double t = y - part->section[i].at;
    const double (*c)[SHAPE_VALUES] = part->cubic[i];
    for (int k = 0; k < SHAPE_VALUES; k++) {
        v[k] = c[0][k] + t * (c[1][k] + t * (c[2][k] + t * c[3][k]));
        d[k] = c[1][k] + t * (2 * c[2][k] + t * 3 * c[3][k]);
    }
}

Section body_section_at(const BodyPart *part, double y) {
    double v[SHAPE_VALUES], d[SHAPE_VALUES];
    y = clamp(y, part->low, part->high);
    shape_in(part, body_interval(part, y), y, v, d);
    return (Section){y, v[0], v[1], v[2], v[3], v[4]};
}

Section body_section(const BodyPart *part, double at) {
    Section s = body_section_at(part, at * part->length);
    s.at /= part->length;
    return s;
}

/* body_interval(y), where the answer is likely to be `last`: then the processor need not wait for the table. */
static inline int interval_again(const BodyPart *part, double y, int last) {
    bool is_in = part->section[last].at <= y && y < part->section[last + 1].at;
    return is_in ? last : body_interval(part, y);
}

/* The surface is where f = 1, f being the distance from the section's centre in units of the half axes. Takes the point
   of the surface at the height of `at`, in the direction of `at` from the centre; returns the signed distance of p from
   the tangent plane there, and the plane's unit normal. For p == at the sign is that of f - 1, so it is exact.
   *interval: the interval to try first (-1: none); becomes the one of `at`. */
static inline double before_plane(const BodyPart *part, Vec3 at, Vec3 p, int *interval, Vec3 *normal) {
    double v[SHAPE_VALUES], d[SHAPE_VALUES], y = clamp(at.y, part->low + part->pole, part->high - part->pole);
    *interval = *interval < 0 ? body_interval(part, y) : interval_again(part, y, *interval);
    shape_in(part, *interval, y, v, d);
    double dx = at.x - v[0], dz = at.z - v[1];
    bool is_front = dz >= 0;
    double depth = is_front ? v[3] : v[4], slope = is_front ? d[3] : d[4], per_x = 1 / v[2], per_z = 1 / depth;
    double ux = dx * per_x, uz = dz * per_z, f = sqrt(ux * ux + uz * uz);
    if (f > 1e-9) {
        f = 1 / f;
        ux *= f;
        uz *= f;
    } else { /* on the axis: the way out is along the shorter half axis */
        ux = v[2] <= depth;
        uz = 1 - ux;
    }
    Vec3 g = vec(ux * per_x, 0, uz * per_z); /* half the gradient of f^2 on the surface */
    g.y = -(g.x * (d[0] + ux * d[2]) + g.z * (d[1] + uz * slope));
    Vec3 surface = vec(v[0] + ux * v[2], y, v[1] + uz * depth);
    double size = 1 / vec_len(g);
    *normal = vec_scale(g, size);
    return vec_dot(vec_sub(p, surface), *normal);
}

/* Where the surface leans (caps, calf, seat) the nearest point is not at the same height as p. So a second tangent
   plane is taken where the perpendicular on the first one ends. For a convex part both planes bound the distance
   from below. */
static void look_again(const BodyPart *part, BodyLook *at) {
    Vec3 other;
    at->distance = at->first;
    at->looks = 2;
    if (fabs(at->normal.y) <= BODY_LEANING) return;
    double better = before_plane(part, vec_mad(at->p, at->normal, -at->first), at->p, &at->interval, &other);
    if ((better > 0) != (at->first > 0)) return;
    at->distance = better;
    at->normal = other;
}

double body_look(const BodyPart *part, BodyLook *at, double far, Vec3 *normal) {
    Vec3 p = at->p;
    double over = p.y - part->high, under = part->low - p.y, beyond = over > under ? over : under;
    if (beyond >= far) return beyond;
    double away = p.x * p.x + p.z * p.z, limit = part->reach + far;
    if (away >= limit * limit) return fmax(far, sqrt(away) - part->reach);

    if (at->looks == 0) {
        at->interval = -1;
        at->first = before_plane(part, p, p, &at->interval, &at->normal);
        at->looks = 1;
    }
    if (at->first >= far) return far;
    if (at->looks == 1) look_again(part, at);
    if (at->distance >= far) return far;
    if (normal) *normal = at->normal;
    return at->distance;
}

double body_distance(const BodyPart *part, Vec3 p, double far, Vec3 *normal) {
    BodyLook at;
    at.p = p;
    at.looks = 0;
    return body_look(part, &at, far, normal);
}

void body_pose(const Body *b, const Pose *pose, Vec3 *positions, Vec3 *normals) {
    for (int i = 0; i < b->nparts; i++) {
        const BodyPart *part = &b->part[i];
        Rigid bone = pose->bone[part->role];
        for (int k = part->first_vertex; k < part->first_vertex + part->nvertices; k++) {
            positions[k] = rigid_apply(bone, b->skin.position[k]);
            if (normals) normals[k] = mat_apply(bone.r, b->skin.normal[k]);
        }
    }
}
