/* The displacement field: what the body has pushed the cloth aside. See dress/lattice.h for its
   levels and weights. World frame, metres. */
#ifndef DRESS_FIELD_H
#define DRESS_FIELD_H

#include "dress/tessellate.h"

/* Vectors of single places; all others have none. */
typedef struct {
    Vec3 *at;                      /* per lattice place, metres */
    bool *is_listed;               /* per lattice place */
    int *place, n;                 /* those that have, or had, one */
} FieldSpots;

typedef struct {
    const Lattice *lattice;
    double scale;                  /* lengths inside the method, relative to 1.70 m */
    double cap;                    /* no vertex is moved farther, metres */
    int start[LATTICE_LEVELS + 1]; /* level l's vertices are start[l]..start[l + 1) */
    Vec3 *displacement;            /* per level vertex */
    FieldSpots offset;             /* the last millimetres of single vertices */
    FieldSpots dent;               /* how far they are pressed in from outside */
    Mat3 pelvis;                   /* of the frame that the displacement belongs to */
} Field;

/* What happens to a vector that is carried along. */
typedef struct {
    Mat3 turn;
    double fade, most, felt; /* share that is left; metres that it may lose, and below which it is dropped */
} Carry;

MUST_CHECK bool field_reserve(Field *f, const Lattice *lattice, Arena *arena, Error *e);
void field_forget(Field *f);

/* The displacement of one field into another on the same lattice. */
void field_copy(const Field *from, Field *to);

/* What happens in dt seconds, up to the frame of `body`, to vectors of the frame that a field belongs to. */
Carry field_carry_to(const Field *f, const BodyFrame *body, double dt);

/* One carried vector; false once it is no longer felt. */
bool field_carry_one(Vec3 *d, const Carry *c);

/* Takes the displacement of the last frame along: turned with the pelvis, faded with time (dt
   seconds), large ones no faster than cloth sinks. What is still felt keeps its cells split. restart: forget it. */
void field_carry(Field *f, const BodyFrame *body, double dt, bool restart, Leaves *leaves);

/* Holds every vector, but for dents, at most that far from where another field has it; what is displaced then has its
   cells split. */
void field_hold(Field *f, const Field *by, double most, Leaves *leaves);

/* Levels (bit 1 << level) at which anything is displaced. */
unsigned field_levels(const Field *f);

/* The field at a place: the sum over `levels`, without the offset. */
Vec3 field_at(const Field *f, unsigned levels, int place);

/* d, shortened to `cap`; *capped becomes true if it was longer. */
static inline Vec3 field_limit(Vec3 d, double cap, bool *capped) {
    double n2 = vec_dot(d, d);
    if (n2 <= cap * cap) return d;
    *capped = true;
    return vec_scale(d, cap / sqrt(n2));
}

MUST_CHECK bool field_reserve_spots(FieldSpots *s, int nplaces, Arena *arena, Error *e);

/* Gives a place a vector; takes all of them away. */
void field_set_spot(FieldSpots *s, int place, Vec3 d);
void field_drop_spots(FieldSpots *s);

static inline bool field_is_zero(Vec3 d) { return d.x == 0 && d.y == 0 && d.z == 0; }

/* Outward unit normal of the displaced patches at a place (analytic). */
Vec3 field_normal(const Field *f, const Patch *root, unsigned levels, int place);

/* The field of `level` as a patch: over the cell of that level that holds a cell of a deeper one. Returns whether
   anything is displaced there. */
bool field_patch(const Field *f, LatticeCell cell, int deeper, int level, Patch *out);

/* The displaced patch over cell (a, b) of a level, a leaf or finer: the part of the root patch and
   the field over it, which is bicubic there. Offsets are left out. */
Patch field_leaf(const Field *f, const Patch *root, LatticeCell cell, int level);

#endif
