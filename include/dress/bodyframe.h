/* The body of one frame, posed once (dress/bodypose) and shared by all garments. */
#ifndef DRESS_BODYFRAME_H
#define DRESS_BODYFRAME_H

#include "dress/yield.h"
#include "geometry/crossing.h"

#include <pthread.h>

/* How far a vertex of the skin has to give way, and its distance from the part where nothing presses: next to
   nothing. Private. */
typedef struct { double by, level; } Give;

/* Boxes over the edges and triangles of every part's skin. Many parts are far from any garment: theirs are made when
   somebody asks, and garments may be dressed by several threads. */
typedef struct {
    pthread_mutex_t making;
    unsigned made;                 /* bits 1 << part */
    CrossingSet edges[BODY_PARTS_MAX], triangles[BODY_PARTS_MAX];
} BodyBoxes;

typedef struct {
    const Body *body;
    Vectors vectors;               /* to measure many distances with */
    double unit;                   /* output units per metre */
    Pose pose;
    Vec3 *position, *normal;       /* skin.nvertices, and room for as many normals of creases;
                                      positions in output units, snapped to the precision of the
                                      text, so that what a reader of the file sees is what was
                                      tested */
    Rigid to_part[BODY_PARTS_MAX]; /* world (metres) -> part frame */
    Mat3 to_world[BODY_PARTS_MAX]; /* part frame -> world, directions */
    Box box[BODY_PARTS_MAX];       /* of each part; world, metres; a little larger than it */
    Box *block;                    /* of every sixteen vertices of a part's skin before anything pressed on it */
    Contacts contacts[BODY_PARTS_MAX]; /* what each part gives way to in this pose */
    double room;                   /* that parts leave between them, metres */
    Give *give;                    /* per vertex of the skin */
    Box skin[BODY_PARTS_MAX];      /* of its skin, where it has given way */
    BodyBoxes *boxes;              /* private */
    double seconds;                /* that posing took */
} BodyFrame;

MUST_CHECK bool body_frame_init(BodyFrame *f, const Body *body, double unit, Arena *arena, Error *e);

/* The normal at a vertex of a part's skin, where nothing presses on it. */
static inline Vec3 body_frame_rest_normal(const BodyFrame *f, const BodyPart *part, int vertex) {
    return mat_apply(f->pose.bone[part->role].r, f->body->skin.normal[vertex]);
}

/* Signed distance (metres) of a world point from a part, which has given way; *normal, if not NULL, in the world.
   See body_distance for `far`. */
double body_frame_distance(const BodyFrame *f, int part, Vec3 p, double far, Vec3 *normal);

/* Of n points, `far` where that is less. */
void body_frame_distances(const BodyFrame *f, int part, const Vec3 *p, int n, double far, double *distance);

/* A world point that several parts are asked about, or one more than once, as happens where they press on each other:
   what a part says of it without the others is found once. */
typedef struct {
    Vec3 at;
    unsigned known;                /* parts (bits 1 << part) that have been asked; private */
    BodyLook look[BODY_PARTS_MAX];
} BodyPoint;
static inline void body_point_move(BodyPoint *p, Vec3 to) {
    p->at = to;
    p->known = 0;
}

/* body_frame_distance of it, */
double body_point_distance(const BodyFrame *f, int part, BodyPoint *p, double far, Vec3 *normal);

/* and from a part as it is where nothing presses on it: never more than that, and cheaper. For many points too;
   normal may be NULL. */
double body_point_unpressed(const BodyFrame *f, int part, BodyPoint *p, double far);
void body_frame_unpressed_many(const BodyFrame *f, int part, const Vec3 *p, int n, double far, double *distance,
                               Vec3 *normal);

/* Is a world point, or any of n, inside any of `parts` (bits 1 << role)? */
bool body_frame_inside(const BodyFrame *f, unsigned parts, Vec3 p);
bool body_frame_any_inside(const BodyFrame *f, unsigned parts, const Vec3 *p, int n);

/* The boxes over a part's skin, if its own comes near to `cloth`; both in output units. Else NULL. */
const CrossingSet *body_frame_edges(const BodyFrame *f, int part, Box cloth);
const CrossingSet *body_frame_triangles(const BodyFrame *f, int part, Box cloth);

/* Is p farther than `far` from a part for certain? A cheap question before the exact one. */
static inline bool body_frame_far(const BodyFrame *f, int part, Vec3 p, double far) {
    const Box *b = &f->box[part];
    return p.x < b->low.x - far || p.x > b->high.x + far || p.y < b->low.y - far || p.y > b->high.y + far ||
           p.z < b->low.z - far || p.z > b->high.z + far;
}

/* Where the boxes round a part's vertices begin. */
enum { BODY_BLOCK = 16 };
static inline Box *body_frame_blocks(const BodyFrame *f, int part) {
    return f->block + f->body->part[part].first_vertex / BODY_BLOCK + part;
}

/* Bit 1 << role of a part. */
static inline unsigned part_bit(const BodyFrame *f, int part) { return 1u << f->body->part[part].role; }

#endif
