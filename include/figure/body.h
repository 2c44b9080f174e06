/* The body: generalised cones along the bones, as in the paper. Each part is a stack of sections; a section is two
   half-ellipses (front and back of different depth) that meet at the sides. The skin is made of bicubic Bezier patches:
   four round each part in every row between two sections. Distances are computed from the same cubics, so that what is
   drawn and what is tested is one surface.

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

/* Sections of a part at the most: SECTIONS_MAX with the caps, which are CAP_SECTIONS at each end and do not stand in a
   body file, SPEC_SECTIONS_MAX without. */
enum { SECTIONS_MAX = 24, CAP_SECTIONS = 3, SPEC_SECTIONS_MAX = SECTIONS_MAX - 2 * CAP_SECTIONS, BODY_PARTS_MAX = 24 };

/* A part as the body file gives it, for the reference figure: `at` in bone lengths. */
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
    double pole;            /* private: see BODY_POLE; metres */
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
    double hips, shoulders;   /* breadth of the trunk at hips and shoulders, against the reference's at this girth */
    double hip_y, shoulder_y; /* heights of hips and shoulders in the canonical stance, metres */
} Body;

/* Breadth of the trunk at height y of the canonical stance against the reference's at this
   girth: 1 for usual proportions. */
double body_breadth(const Body *b, double y);

/* Sizes the body to a figure: lengths follow its bones, girths its height and build. detail:
   number of facets round a section, a multiple of 4 (16 gives about 8,000 triangles). Closed
   shells, one for each part, no degenerate triangles. Memory from arena. */
MUST_CHECK bool body_fit(const BodySpec *spec, const Figure *figure, int detail, Arena *arena, Body *out, Error *e);

/* Steps of body_fit. body_part_close takes a part whose nsections sections (in metres) are set, adds the caps, of these
   heights in metres, and fills everything from `section` to `bucket`. */
void body_part_close(BodyPart *part, const double cap[2]);

/* body_skin makes patches and skin of a body whose parts are closed. */
MUST_CHECK bool body_skin(Body *body, int detail, Arena *arena, Error *e);

/* Vertices (skin.nvertices) of the skin in a pose, world frame. normals may be NULL. */
void body_pose(const Body *b, const Pose *pose, Vec3 *positions, Vec3 *normals);

/* Signed distance (metres, negative inside) of point p, in the PART FRAME, from a part's surface. It is measured to
   tangent planes: exact in sign, accurate near the surface. *normal, if not NULL, gets the outward unit normal in the
   part frame. For a point that is more than `far` metres away it may return any value from far to the true distance,
   and sets no normal. */
double body_distance(const BodyPart *part, Vec3 p, double far, Vec3 *normal);

/* The same for a point that is asked about more than once: what was computed is kept. Begin with
   {.p = p}, in the part frame. */
typedef struct {
    Vec3 p;
    /* Private: */
    int looks;       /* tangent planes taken so far, 0 to 2 */
    int interval;    /* of body_interval */
    double first;    /* distance from the first plane */
    double distance; /* from the last plane */
    Vec3 normal;     /* of that plane */
} BodyLook;
double body_look(const BodyPart *part, BodyLook *at, double far, Vec3 *normal);

/* body_distance, or `far` where that is less, of n points that *to_part takes to the part frame: the same bits with any
   vectors. normal may be NULL; for points beyond `far` it is undefined. Fastest for points that are near each other. */
void body_distances(const BodyPart *part, Vectors vectors, const Rigid *to_part, const Vec3 *p, int n, double far,
                    double *out, Vec3 *normal);

/* Private: the number i of the interval from section i to i + 1 that holds y, low <= y <= high: a table look-up and
   rarely a step or two. */
static inline int body_interval(const BodyPart *part, double y) {
    int b = (int)((y - part->low) * part->buckets_per_metre);
    int i = part->bucket[b < BODY_BUCKETS ? b : BODY_BUCKETS - 1];
    while (i + 2 < part->nsections && part->section[i + 1].at <= y) i++;
    while (i > 0 && part->section[i].at > y) i--; /* a rounding beside a bucket's edge */
    return i;
}
/* Private: at the poles (the ends of the caps) sections have no size, so none is taken nearer to them than this share
   of the part's length. Where the unit normal's y is larger than BODY_LEANING, a second tangent plane is taken. */
#define BODY_POLE 4e-6
#define BODY_LEANING 0.2

/* The section at height y of the part frame, clamped to the part's range. */
Section body_section_at(const BodyPart *part, double y);

/* The section of a part at `at` bone lengths from its start, in metres (centre, half sizes),
   clamped to the part's range. */
Section body_section(const BodyPart *part, double at);

#endif
