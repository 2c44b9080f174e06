/* Two triangle meshes, a garment and a body, and everything that is wrong between them. Decided on
   the triangles alone, whatever program made them, with exact signs. */
#ifndef DRESS_VERIFY_H
#define DRESS_VERIFY_H

#include "dress/shells.h"

typedef enum { FINDING_PAIR, FINDING_INSIDE, FINDING_CRACK } FindingKind;

/* One thing that is wrong. Numbers count from 0. */
typedef struct {
    FindingKind kind;
    int item;        /* PAIR: triangle of the garment; else its vertex */
    int other;       /* triangle of the body: of the pair, or nearest to the vertex inside; CRACK: -1 */
    double distance; /* INSIDE: to the surface of the deepest solid round it; CRACK: its width; PAIR: 0 */
    Vec3 at;         /* PAIR: the middle of the garment's triangle; else the vertex */
} Finding;

/* Called for each finding, in a fixed order. May be NULL. */
typedef struct { void (*found)(void *context, const Finding *finding); void *context; } Findings;

typedef struct {
    int pairs;       /* of triangles that share a point */
    int inside;      /* vertices of the garment inside a solid of the body */
    double deepest;  /* of them; units of the meshes */
    int cracks;      /* vertices of the garment's border that nearly meet it */
    int borders;     /* pieces of that border */
    int worst;       /* group of the body with the most pairs and inside vertices; -1: none */
} Verdict;

/* A body, made ready. wanted (NULL: all): the groups that count. mesh is borrowed. */
typedef struct {
    const Mesh *mesh;
    Shells shells;
    int *group;      /* of each triangle; -1: none */
} Solid;
MUST_CHECK bool solid_make(const Mesh *body, const bool *wanted, Arena *arena, Solid *out, Error *e);

/* Tests the garment. crack: widest gap in its border that counts as a crack. Touching counts: a
   shared corner is a pair; a vertex exactly on the body is not inside. A collapsed triangle is
   the segment or point that is left of it. */
MUST_CHECK bool verify_meshes(const Solid *body, const Mesh *garment, double crack, Findings findings, Arena *arena,
                              Verdict *out, Error *e);

#endif
