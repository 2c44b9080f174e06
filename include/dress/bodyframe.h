/* The body of one frame, posed once (dress/bodypose) and shared by all garments. */
#ifndef DRESS_BODYFRAME_H
#define DRESS_BODYFRAME_H

#include "dress/yield.h"
#include "geometry/crossing.h"

#include <pthread.h>

/* Private. How far a vertex of the skin gives way, its measured distance from its part where nothing presses (about 0),
   and how far it goes in beyond that for the sake of its edges; metres. */
typedef struct { double by, level, sunk; } Give;

/* Private. Boxes over the edges and triangles of each part's skin. They are made on demand, since many parts are far
   from any garment; by one thread at a time, since several may dress garments on this body. */
typedef struct {
    pthread_mutex_t making;
    unsigned made;                 /* those of which parts: bits 1 << part */
    CrossingSet edges[BODY_PARTS_MAX], triangles[BODY_PARTS_MAX];
} BodyBoxes;

typedef struct {
    const Body *body;
    Vectors vectors;               /* to measure many distances with */
    double unit;                   /* output units per metre */
    Pose pose;
    Vec3 *position, *normal;       /* of the skin's vertices; room for as many normals of creases. Positions in output
                                      units, rounded to the precision of the text, so that what a reader of the file
                                      gets is what was tested */
    Rigid to_part[BODY_PARTS_MAX]; /* world (metres) -> part frame */
    Mat3 to_world[BODY_PARTS_MAX]; /* part frame -> world, directions */
    Box box[BODY_PARTS_MAX];       /* round each part, a little larger; world, metres */
    Box *block;                    /* round every sixteen vertices of a part's skin, before it gave way; see
                                      body_frame_blocks */
    Folds folds;                   /* of this pose */
    Contacts contacts[BODY_PARTS_MAX]; /* what each part gives way to in this pose */
    double room;                   /* YIELD_ROOM of this body, metres */
    Give *give;                    /* per vertex of the skin */
    Box skin[BODY_PARTS_MAX];      /* round each part's skin, with what has given way; world, metres */
    BodyBoxes *boxes;              /* private */
} BodyFrame;

/* Takes the memory for all poses of a body, which must outlive it. unit: output units per metre. */
MUST_CHECK bool body_frame_init(BodyFrame *f, const Body *body, double unit, Arena *arena, Error *e);

/* The normal at a vertex of a part's skin, where nothing presses on it. */
static inline Vec3 body_frame_rest_normal(const BodyFrame *f, const BodyPart *part, int vertex) {
    return mat_apply(f->pose.bone[part->role].r, f->body->skin.normal[vertex]);
}

/* Signed distance (metres) of a world point from a part that has given way; *normal, if not NULL, in the world. See
   body_distance for `far`. */
double body_frame_distance(const BodyFrame *f, int part, Vec3 p, double far, Vec3 *normal);

/* The same, or `far` where that is less, of n points. */
void body_frame_distances(const BodyFrame *f, int part, const Vec3 *p, int n, double far, double *distance);

/* A world point that several parts are asked about, or one part several times, as happens where they press on each
   other. What was computed is kept. Set it by body_point_move. */
typedef struct {
    Vec3 at;
    unsigned known;                /* private: parts that were asked, bits 1 << part */
    BodyLook look[BODY_PARTS_MAX];
} BodyPoint;
static inline void body_point_move(BodyPoint *p, Vec3 to) {
    p->at = to;
    p->known = 0;
}

/* body_frame_distance of such a point. */
double body_point_distance(const BodyFrame *f, int part, BodyPoint *p, double far, Vec3 *normal);

/* Its distance from a part as if nothing pressed on it: at most the other one, and cheaper. Also for n points;
   normal may be NULL. */
double body_point_unpressed(const BodyFrame *f, int part, BodyPoint *p, double far);
void body_frame_unpressed_many(const BodyFrame *f, int part, const Vec3 *p, int n, double far, double *distance,
                               Vec3 *normal);

/* Is any of n world points inside any of `parts` (bits 1 << role)? */
bool body_frame_any_inside(const BodyFrame *f, unsigned parts, const Vec3 *p, int n);

/* The boxes over the edges or triangles of a part's skin; NULL if the skin does not touch the box `cloth`, output
   units. */
const CrossingSet *body_frame_edges(const BodyFrame *f, int part, Box cloth);
const CrossingSet *body_frame_triangles(const BodyFrame *f, int part, Box cloth);

/* Is p farther than `far` from a part for certain? By its box: a cheap test before a distance is measured. */
static inline bool body_frame_far(const BodyFrame *f, int part, Vec3 p, double far) {
    const Box *b = &f->box[part];
    return p.x < b->low.x - far || p.x > b->high.x + far || p.y < b->low.y - far || p.y > b->high.y + far ||
           p.z < b->low.z - far || p.z > b->high.z + far;
}

/* The boxes round each BODY_BLOCK vertices of a part's skin. */
enum { BODY_BLOCK = 16 };
static inline Box *body_frame_blocks(const BodyFrame *f, int part) {
    return f->block + f->body->part[part].first_vertex / BODY_BLOCK + part;
}

/* Bit 1 << role of a part. */
static inline unsigned part_bit(const BodyFrame *f, int part) { return 1u << f->body->part[part].role; }

#endif
