/* From the reference adult to any figure: lengths follow the bones, girths follow the whole figure. A long shin is
   not a thick one; only a small share of a limb's own proportion goes into its girth. Everything is bounded, so that
   a skeleton with odd joints still carries a human body. */
#include "figure/body.h"

#include <string.h>

/* Bones whose girths go together, or joints would show a step. */
typedef enum { BUILD_TORSO, BUILD_NECK, BUILD_HEAD, BUILD_ARM, BUILD_LEG, BUILD_FOOT, BUILD_COUNT } Build;

static Build build_of(Role role) {
    switch (role) {
    case ROLE_PELVIS: case ROLE_SPINE: case ROLE_CHEST: return BUILD_TORSO;
    case ROLE_NECK: return BUILD_NECK;
    case ROLE_HEAD: return BUILD_HEAD;
    case ROLE_LEFT_THIGH: case ROLE_LEFT_SHIN: case ROLE_RIGHT_THIGH: case ROLE_RIGHT_SHIN: return BUILD_LEG;
    case ROLE_LEFT_FOOT: case ROLE_LEFT_TOE: case ROLE_RIGHT_FOOT: case ROLE_RIGHT_TOE: return BUILD_FOOT;
    default: return BUILD_ARM;
    }
}

/* What the whole fit shares. */
typedef struct {
    const Figure *figure;
    Figure reference;
    double size;              /* height against the reference */
    double girth[BUILD_COUNT];
    double hips, shoulders;   /* factors for the torso's width at these heights */
} Sizes;

static bool is_foot(Role role) { return build_of(role) == BUILD_FOOT; }

static Rigid part_frame(const Figure *f, Role role) {
    Vec3 x = vec(1, 0, 0), y = vec(0, 1, 0), z = vec(0, 0, 1);
    Build build = build_of(role);
    if (build == BUILD_FOOT) {
        y = vec(0, 0, 1);
        z = vec(0, 1, 0);
    } else if (build == BUILD_ARM || build == BUILD_LEG) {
        y = vec_unit_or(vec_sub(f->end[role], f->start[role]), vec(0, -1, 0));
        z = vec_unit_or(vec_mad(z, y, -y.z), vec(0, 1, 0));
    }
    x = vec_cross(y, z);
    return (Rigid){mat_columns(x, y, z), f->start[role]};
}

/* The bone's extent along its part's y axis. */
static double extent(const Figure *f, Role role) {
    Rigid frame = part_frame(f, role);
    return vec_dot(vec_sub(f->end[role], f->start[role]), mat_column(frame.r, 1));
}

/* The factor for the girths of some bones: that of the height, and a share of the bones' own proportion. */
static double girth_of(const Sizes *s, Build build) {
    double own = 0, reference = 0;
    for (int r = 0; r < ROLE_COUNT; r++) {
        if (build_of((Role)r) != build) continue;
        own += fmax(extent(s->figure, (Role)r), 0);
        reference += extent(&s->reference, (Role)r);
    }
    return s->size * clamp(pow(own / (reference * s->size), 0.3), 0.75, 1.3);
}

static double spacing(const Figure *f, Role left, Role right) { return f->start[left].x - f->start[right].x; }

static Sizes sizes_of(const Figure *figure) {
    Sizes s = {.figure = figure, .reference = figure_reference()};
    const Figure *ref = &s.reference;
    s.size = figure->height / ref->height;
    for (int b = 0; b < BUILD_COUNT; b++) s.girth[b] = girth_of(&s, (Build)b);
    /* Heads grow less than bodies: at 1.10 m the head is 1/5.7 of the height, at 1.70 m 1/7.5. */
    s.girth[BUILD_HEAD] = s.size * clamp(pow(s.size, -0.6), 0.8, 1.5);
    s.girth[BUILD_NECK] = sqrt(s.girth[BUILD_HEAD] * s.girth[BUILD_TORSO]);
    /* Capture systems place the joints of one body differently: hips 12 to 24 cm apart, shoulders
       20 to 42. Wide joints widen the torso, or limbs would come off; narrow ones hardly do. */
    double hips = spacing(figure, ROLE_LEFT_THIGH, ROLE_RIGHT_THIGH) / spacing(ref, ROLE_LEFT_THIGH, ROLE_RIGHT_THIGH);
    double shoulders = spacing(figure, ROLE_LEFT_UPPER_ARM, ROLE_RIGHT_UPPER_ARM) /
                       spacing(ref, ROLE_LEFT_UPPER_ARM, ROLE_RIGHT_UPPER_ARM);
    s.hips = clamp(1 + 0.65 * (hips / s.girth[BUILD_TORSO] - 1), 0.95, 1.4);
    s.shoulders = shoulders / s.girth[BUILD_TORSO];
    s.shoulders = s.shoulders > 1 ? fmin(s.shoulders, 1.5) : fmax(0.5 + 0.5 * s.shoulders, 0.85);
    return s;
}

/* The length that a part is made for. Bones between two joints are taken as they are, or parts
   would not meet; ends and the short bones of the trunk are kept human. */
static double length_of(const Sizes *s, Role role) {
    double own = extent(s->figure, role);
    double usual = extent(&s->reference, role) * (role == ROLE_HEAD ? s->girth[BUILD_HEAD] : s->size);
    switch (role) {
    case ROLE_LEFT_UPPER_ARM: case ROLE_LEFT_FOREARM: case ROLE_LEFT_THIGH: case ROLE_LEFT_SHIN:
    case ROLE_RIGHT_UPPER_ARM: case ROLE_RIGHT_FOREARM: case ROLE_RIGHT_THIGH: case ROLE_RIGHT_SHIN:
        return fmax(own, 0.3 * usual);
    case ROLE_HEAD: return clamp(own, 0.9 * usual, 1.15 * usual);
    default: return clamp(own, 0.6 * usual, 1.6 * usual);
    }
}

/* The hips' factor at the hip joints, the shoulders' at theirs, a waist of the usual width. */
double body_breadth(const Body *b, double y) {
    double t = b->shoulder_y > b->hip_y ? clamp((y - b->hip_y) / (b->shoulder_y - b->hip_y), 0, 1) : 0;
    return 1 + (1 - t) * (1 - t) * (b->hips - 1) + t * t * (b->shoulders - 1);
}

/* Thighs of narrow hips make room for each other; towards the knee they come back to the bone. */
static double thigh_shift(const Sizes *s, double side, double at) {
    double room = s->figure->start[ROLE_LEFT_THIGH].x;
    return clamp(side - room, 0, 0.03 * s->size) * clamp(2.5 * (1 - at), 0, 1);
}

/* And narrow shoulders carry their arms outside of the joint. */
static double arm_shift(const Sizes *s, double at) {
    double usual = s->reference.start[ROLE_LEFT_UPPER_ARM].x * s->girth[BUILD_TORSO];
    double missing = usual - s->figure->start[ROLE_LEFT_UPPER_ARM].x;
    return clamp(0.5 * missing, 0, 0.03 * s->size) * clamp(1 - 1.2 * at, 0, 1);
}

/* Feet: how far the sole of the scaled part would stand above (or under) the floor. */
static double sole_gap(const Sizes *s, Role role, double girth) {
    double own = s->figure->start[role].y, usual = s->reference.start[role].y * girth;
    return clamp(own - usual, -0.5 * usual, 0.03 * s->size);
}

/* Inside the bone places follow its length; what reaches past its ends follows the girth. */
static double place_along(double at, double length, double reference) {
    return at < 0 ? at * reference : at > 1 ? length + (at - 1) * reference : at * length;
}

static void size_section(const Sizes *s, const Body *body, const BodyPart *part, const Section *spec, Section *out) {
    double girth = s->girth[build_of(part->role)], at = spec->at;
    double y = place_along(at, part->length, extent(&s->reference, part->role) * girth);
    *out = (Section){y, spec->x * girth, spec->z * girth, spec->side * girth, spec->front * girth, spec->back * girth};
    switch (part->role) {
    case ROLE_PELVIS: case ROLE_SPINE: case ROLE_CHEST: out->side *= body_breadth(body, part->frame.t.y + y); break;
    case ROLE_LEFT_UPPER_ARM: out->x -= arm_shift(s, at); break;
    case ROLE_RIGHT_UPPER_ARM: out->x += arm_shift(s, at); break;
    case ROLE_LEFT_THIGH: out->x -= thigh_shift(s, out->side, at); break;
    case ROLE_RIGHT_THIGH: out->x += thigh_shift(s, out->side, at); break;
    default: break;
    }
    if (is_foot(part->role)) out->z -= sole_gap(s, part->role, girth);
}

bool body_fit(const BodySpec *spec, const Figure *figure, int detail, Arena *arena, Body *out, Error *e) {
    if (!(figure->height > 0) || !isfinite(figure->height))
        return error_set(e, ERR_INTERNAL, "figure without a height");
    Sizes s = sizes_of(figure);
    memset(out, 0, sizeof *out);
    for (int r = 0; r < ROLE_COUNT; r++) out->of_role[r] = -1;
    out->nparts = spec->nparts;
    out->height = figure->height;
    out->scale = s.girth[BUILD_TORSO];
    out->hips = s.hips;
    out->shoulders = s.shoulders;
    out->hip_y = figure->start[ROLE_LEFT_THIGH].y;
    out->shoulder_y = figure->start[ROLE_LEFT_UPPER_ARM].y;
    for (int i = 0; i < spec->nparts; i++) {
        const BodyPartSpec *from = &spec->part[i];
        BodyPart *part = &out->part[i];
        out->of_role[from->role] = i;
        part->role = from->role;
        part->frame = part_frame(figure, from->role);
        part->length = length_of(&s, from->role);
        part->nsections = from->nsections;
        for (int k = 0; k < from->nsections; k++) size_section(&s, out, part, &from->section[k], &part->section[k]);
        double girth = s.girth[build_of(part->role)], cap[2] = {from->cap[0] * girth, from->cap[1] * girth};
        body_part_close(part, cap);
    }
    return body_skin(out, detail, arena, e);
}
