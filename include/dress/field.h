/* The displacement field: by how much the body has pushed the cloth aside. Its levels and weights are explained in
   dress/lattice.h. World frame, metres. */
#ifndef DRESS_FIELD_H
#define DRESS_FIELD_H

#include "dress/tessellate.h"

/* What presses a garment in from outside, each in one direction: either arm, and all else. */
typedef enum { LIMB_LEFT_ARM, LIMB_RIGHT_ARM, LIMB_OTHER, LIMBS } Limb;

/* By how much each of them does at one place, metres. */
typedef struct { Vec3 by[LIMBS]; } Dents;
static inline Vec3 dents_sum(Dents d) {
    return vec_add(vec_add(d.by[LIMB_LEFT_ARM], d.by[LIMB_RIGHT_ARM]), d.by[LIMB_OTHER]);
}

/* Vectors of single places. */
typedef struct {
    Vec3 *at;                      /* per lattice place, metres; zero for most */
    bool *is_listed;               /* per lattice place: is it in the list? */
    int *place, n;                 /* the list of those that have, or had, a vector */
} FieldSpots;

typedef struct {
    const Lattice *lattice;
    double scale;                  /* lengths inside the method, relative to 1.70 m */
    double cap;                    /* no vertex is moved farther, metres */
    int start[LATTICE_LEVELS + 1]; /* level l has the level vertices start[l] to start[l + 1] - 1 */
    Vec3 *displacement;            /* per level vertex */
    FieldSpots offset;             /* of single vertices, out of own parts (dress/settle) */
    FieldSpots dent[LIMBS];        /* of single vertices, pressed in by each limb (dress/dent), */
    Vec3 way[LIMBS];               /* which presses in this direction: unit, or 0 if it never did */
    Mat3 pelvis;                   /* of the frame that the displacement belongs to */
} Field;

/* What happens to displacement vectors from one frame to the next. */
typedef struct {
    Mat3 turn;   /* they turn with the pelvis */
    double fade; /* share of the length that is left, */
    double most; /* but no more than so many metres are lost */
    double felt; /* metres below which a vector is dropped */
} Carry;

MUST_CHECK bool field_reserve(Field *f, const Lattice *lattice, Arena *arena, Error *e);
void field_forget(Field *f);

void field_set_dents(Field *f, int place, Dents dents);
void field_drop_dents(Field *f);

/* The displacement of one field into another on the same lattice. */
void field_copy(const Field *from, Field *to);

/* What happens to vectors of the field's frame in the dt seconds up to the frame of `body`. */
Carry field_carry_to(const Field *f, const BodyFrame *body, double dt);

/* Applies that to one vector; false if it is dropped. */
bool field_carry_one(Vec3 *d, const Carry *c);

/* Applies it to the whole field, but drops all dents. What is left keeps its cells split. restart: forgets all. */
void field_carry(Field *f, const BodyFrame *body, double dt, bool restart, Leaves *leaves);

/* Changes every vector, except dents, to be at most `most` metres from that of another field. What is displaced then
   has its cells split. */
void field_hold(Field *f, const Field *by, double most, Leaves *leaves);

/* Levels (bit 1 << level) at which anything is displaced. */
unsigned field_levels(const Field *f);

/* The displacement at a place: the sum over `levels`, without offset and dent. */
Vec3 field_at(const Field *f, unsigned levels, int place);

/* d, shortened to `cap`; *capped becomes true if it was longer. */
static inline Vec3 field_limit(Vec3 d, double cap, bool *capped) {
    double n2 = vec_dot(d, d);
    if (n2 <= cap * cap) return d;
    *capped = true;
    return vec_scale(d, cap / sqrt(n2));
}

/* Gives a place a vector. */
void field_set_spot(FieldSpots *s, int place, Vec3 d);

static inline bool field_is_zero(Vec3 d) { return d.x == 0 && d.y == 0 && d.z == 0; }

/* What a place is moved beside that: its dents, their sum, and that with its offset. */
static inline Dents field_dents(const Field *f, int place) {
    return (Dents){{f->dent[0].at[place], f->dent[1].at[place], f->dent[2].at[place]}};
}
static inline Vec3 field_dent(const Field *f, int place) { return dents_sum(field_dents(f, place)); }
static inline Vec3 field_alone(const Field *f, int place) {
    Vec3 dent = f->dent[0].is_listed[place] ? field_dent(f, place) : vec(0, 0, 0); /* most places have none */
    return f->offset.is_listed[place] ? vec_add(f->offset.at[place], dent) : dent;
}

/* The outward unit normal of the displaced patches at a place, by their derivatives. */
Vec3 field_normal(const Field *f, const Patch *root, unsigned levels, int place);

/* The field of `level` as a patch over that level's cell which holds `cell`, a cell of the level `deeper`. Returns
   whether anything is displaced there. */
bool field_patch(const Field *f, LatticeCell cell, int deeper, int level, Patch *out);

/* The displaced patch over a cell of a level, which is a leaf or a part of one: the part of the root patch plus the
   field over it, which is bicubic there. Without offsets and dents. */
Patch field_leaf(const Field *f, const Patch *root, LatticeCell cell, int level);

#endif
