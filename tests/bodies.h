/* Bodies of the reference figure and of others, for the unit programs that look at them. */
#ifndef TESTS_BODIES_H
#define TESTS_BODIES_H

#include "figure/body.h"
#include "tap.h"

static Arena arena;

/* A figure of the given height, its joints those of the reference, scaled. */
static inline Figure figure_of_height(double height) {
    Figure f = figure_reference();
    double s = height / f.height;
    f.height = height;
    for (int r = 0; r < ROLE_COUNT; r++) {
        f.start[r] = vec_scale(f.start[r], s);
        f.end[r] = vec_scale(f.end[r], s);
    }
    return f;
}

static inline bool fit(const Figure *figure, int detail, Body *body) {
    Error e = {0};
    bool good = body_fit(body_default(), figure, detail, &arena, body, &e);
    if (!good) printf("# %s\n", e.text);
    return good;
}

static inline const BodyPart *part_of(const Body *b, Role role) { return &b->part[b->of_role[role]]; }

static inline double height_at(const BodyPart *part, double t) { return part->low + t * (part->high - part->low); }

/* The point of the surface at height y in direction phi (0 = front, to the part's +x). */
static inline Vec3 surface_point(const BodyPart *part, double y, double phi, double swell) {
    Section s = body_section_at(part, y);
    double x = sin(phi), z = cos(phi);
    return vec(s.x + swell * s.side * x, y, s.z + swell * (z > 0 ? s.front : s.back) * z);
}

static inline double distance(const BodyPart *part, Vec3 p) { return body_distance(part, p, INFINITY, NULL); }

/* Of a point of the canonical stance. */
static inline double distance_in_stance(const BodyPart *part, Vec3 p) {
    return distance(part, rigid_unapply(part->frame, p));
}

#endif
