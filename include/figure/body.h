/* The body: generalised cones along the bones, as in the paper. Each part is a stack of
   sections; a section is two half-ellipses (front and back of different depth) that meet at
   the sides. Skin: bicubic Bezier patches, four quarters round, one row between sections.
   The analytic inside test uses the same interpolation as the patches.

   Part frame: origin at the bone's start, y along the bone from start (at = 0) to end
   (at = 1); for torso, neck and head y is canonical up, x left, z forward. For limbs y points
   down the limb, z forward as far as perpendicular to y allows, x = y cross z. For feet y
   points from heel to toe and z is up. */
#ifndef FIGURE_BODY_H
#define FIGURE_BODY_H

#include "base/text.h"
#include "figure/figure.h"
#include "geometry/bezier.h"
#include "geometry/mesh.h"
#include "geometry/vectors.h"

/* Lengths in metres. at: place along the bone, 0 = start, 1 = end; may lie outside. */
typedef struct {
    double at;
    double x, z;         /* centre of the section in the part frame */
    double side;         /* half width along x */
    double front, back;  /* half depths towards +z and -z */
} Section;

/* SECTIONS_MAX counts the caps, three sections at each end, which a body file does not give. */
enum { SECTIONS_MAX = 24, CAP_SECTIONS = 3, SPEC_SECTIONS_MAX = SECTIONS_MAX - 2 * CAP_SECTIONS, BODY_PARTS_MAX = 24 };

/* A part as the body file gives it, for the reference figure. */
typedef struct {
    Role role;
    double cap[2]; /* how far the end caps reach past the first and last section; 0: a half ball */
    int nsections; /* 2..SPEC_SECTIONS_MAX */
    Section section[SPEC_SECTIONS_MAX];
} BodyPartSpec;
typedef struct {
    char name[64];
    int nparts;
    BodyPartSpec part[BODY_PARTS_MAX];
} BodySpec;

/* The compiled-in adult. */
const BodySpec *body_default(void);

/* Text format, documented in garments/BODY.md. Reading what was written gives the same. */
MUST_CHECK bool body_read(const char *path, Arena *scratch, BodySpec *out, Error *e);
MUST_CHECK bool body_parse(const Text *text, BodySpec *out, Error *e);
bool body_write(const BodySpec *body, FILE *out);

/* A part sized to a figure. Its surface is a function of y alone: five values (centre x and z,
   side, front, back), each a piecewise cubic, C1, monotone between sections. */
enum { SHAPE_VALUES = 5, BODY_BUCKETS = 64 };
typedef struct {
    Role role;
    Rigid frame;            /* part frame -> canonical stance */
    double length;          /* of the bone along y, metres */
    int nsections;
    Section section[SECTIONS_MAX];       /* metres; `at` in metres along y, caps included */
    double cubic[SECTIONS_MAX][4][SHAPE_VALUES]; /* from section i on: sum of cubic[i][k] (y - at)^k */
    double low, high;       /* y range, with the end caps */
    double reach;           /* no point of the surface is farther from the y axis */
    double buckets_per_metre;            /* private: finds the section of a y without a search */
    unsigned char bucket[BODY_BUCKETS];
    int first_vertex, nvertices, first_triangle, ntriangles, first_edge, nedges;
} BodyPart;

typedef struct {
    int nparts;
    BodyPart part[BODY_PARTS_MAX];
    int of_role[ROLE_COUNT];  /* part index or -1 */
    Mesh skin;                /* canonical stance; groups are parts, named by role */
    int npatches;
    Patch *patch;             /* skin patches, canonical stance */
    double scale;             /* girth of this figure against the reference */
    double height;            /* of the figure */
    double hips, shoulders;   /* breadths of the trunk against the reference's at this girth */
    double hip_y, shoulder_y; /* where these hold, canonical stance */
} Body;

/* Breadth of the trunk at height y of the canonical stance against the reference's at this
   girth: 1 for usual proportions. */
double body_breadth(const Body *b, double y);

/* Sizes the body to a figure: lengths follow its bones, girths its height and build. detail:
   number of facets round a section, a multiple of 4 (16 gives about 8,000 triangles). Closed
   shells, one for each part, no degenerate triangles. Memory from arena. */
MUST_CHECK bool body_fit(const BodySpec *spec, const Figure *figure, int detail, Arena *arena, Body *out, Error *e);

/* The steps of body_fit. Closes a part whose nsections sections (in metres) are set: adds caps
   of these heights and fills everything from `section` to `bucket`. */
void body_part_close(BodyPart *part, const double cap[2]);

/* Patches and skin of a body whose parts are closed. */
MUST_CHECK bool body_skin(Body *body, int detail, Arena *arena, Error *e);

/* Vertices (skin.nvertices) of the skin in a pose, world frame. normals may be NULL. */
void body_pose(const Body *b, const Pose *pose, Vec3 *positions, Vec3 *normals);

/* Signed distance (metres, negative inside) of point p, in the PART FRAME, from a part's
   surface, of first order: exact in sign, good near the surface. *normal, if
   not NULL, gets the outward unit normal in the part frame. Beyond `far` metres it may
   return any value >= far that is not larger than the true distance, without a normal. */
double body_distance(const BodyPart *part, Vec3 p, double far, Vec3 *normal);

/* What a part says of a point of its frame, for one that is asked more than once: what it takes to answer is found
   when it is first needed. Start with {.p = p}; the answers of body_look are those of body_distance. */
typedef struct {
    Vec3 p;
    int looks, interval;        /* 0, 1 or 2; private, as is the rest */
    double first, distance;
    Vec3 normal;
} BodyLook;
double body_look(const BodyPart *part, BodyLook *at, double far, Vec3 *normal);

/* body_distance for n points that *to_part takes to the part frame, `far` where that is less: to the bit, with any
   vectors. normal may be NULL; beyond `far` it is undefined. Points that stand together are the cheapest. */
void body_distances(const BodyPart *part, Vectors vectors, const Rigid *to_part, const Vec3 *p, int n, double far,
                    double *out, Vec3 *normal);

/* Private: the interval between sections that holds y, low <= y <= high: a table look-up and rarely a step or
   two. The poles have no size, so distances are taken BODY_POLE (metres) inside of them; where a normal leans
   along y by more than BODY_LEANING, they are taken twice. */
static inline int body_interval(const BodyPart *part, double y) {
    int b = (int)((y - part->low) * part->buckets_per_metre);
    int i = part->bucket[b < BODY_BUCKETS ? b : BODY_BUCKETS - 1];
    while (i + 2 < part->nsections && part->section[i + 1].at <= y) i++;
    while (i > 0 && part->section[i].at > y) i--; /* a rounding beside a bucket's edge */
    return i;
}
#define BODY_POLE 1e-6
#define BODY_LEANING 0.2

/* The section at height y of the part frame, clamped to the part's range. */
Section body_section_at(const BodyPart *part, double y);

/* The section of a part at `at` bone lengths from its start, in metres (centre, half sizes),
   clamped to the part's range. */
Section body_section(const BodyPart *part, double at);

#endif
