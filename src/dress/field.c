/* The displacement field: evaluated, and carried from frame to frame. Most frames displace little and on few levels, so
   levels without a displacement are found once and left out. */
#include "dress/field.h"

#include <string.h>

static const double FADE = 0.8;    /* share of a displacement that is left after 1/30 s, */
static const double SINK = 0.12;   /* but cloth goes back no faster than that, metres a second on 1.70 m */
static const double FELT = 0.0002; /* metres on 1.70 m: a displacement below this is dropped */
static const double CAP_LOOSE = 7, CAP_TIGHT = 20; /* the cap is the height divided by this */

static bool reserve_spots(FieldSpots *s, int nplaces, Arena *arena, Error *e) {
    s->at = ARENA_NEW(arena, Vec3, nplaces, e);
    s->is_listed = ARENA_NEW(arena, bool, nplaces, e);
    s->place = ARENA_NEW(arena, int, nplaces, e);
    return s->at && s->is_listed && s->place;
}

void field_set_spot(FieldSpots *s, int place, Vec3 d) {
    if (!s->is_listed[place]) s->place[s->n++] = place;
    s->is_listed[place] = true;
    s->at[place] = d;
}

static void drop_spot(FieldSpots *s, int place) {
    s->is_listed[place] = false;
    s->at[place] = vec(0, 0, 0);
}

static void drop_spots(FieldSpots *s) {
    for (int k = 0; k < s->n; k++) drop_spot(s, s->place[k]);
    s->n = 0;
}

static void copy_spots(const FieldSpots *from, FieldSpots *to) {
    for (int k = 0; k < from->n; k++) field_set_spot(to, from->place[k], from->at[from->place[k]]);
}

bool field_reserve(Field *f, const Lattice *lattice, Arena *arena, Error *e) {
    *f = (Field){.lattice = lattice, .scale = figure_scale(lattice->fit->height), .pelvis = mat_identity()};
    f->cap = lattice->fit->height / (lattice->fit->garment->loose ? CAP_LOOSE : CAP_TIGHT);
    for (int l = 0; l < LATTICE_LEVELS; l++)
        f->start[l + 1] = f->start[l] + (l <= lattice->depth ? lattice->level[l].count : 0);
    f->displacement = ARENA_NEW(arena, Vec3, f->start[LATTICE_LEVELS], e);
    for (int limb = 0; limb < LIMBS; limb++)
        if (!reserve_spots(&f->dent[limb], lattice->nplaces, arena, e)) return false;
    return f->displacement && reserve_spots(&f->offset, lattice->nplaces, arena, e);
}

void field_set_dents(Field *f, int place, Dents dents) {
    for (int limb = 0; limb < LIMBS; limb++) field_set_spot(&f->dent[limb], place, dents.by[limb]);
}

void field_drop_dents(Field *f) {
    for (int limb = 0; limb < LIMBS; limb++) drop_spots(&f->dent[limb]);
}

void field_forget(Field *f) {
    memset(f->displacement, 0, (size_t)f->start[LATTICE_LEVELS] * sizeof *f->displacement);
    drop_spots(&f->offset);
    field_drop_dents(f);
}

void field_copy(const Field *from, Field *to) {
    drop_spots(&to->offset);
    field_drop_dents(to);
    to->pelvis = from->pelvis;
    memcpy(to->displacement, from->displacement, (size_t)from->start[LATTICE_LEVELS] * sizeof *to->displacement);
    copy_spots(&from->offset, &to->offset);
    for (int limb = 0; limb < LIMBS; limb++) {
        copy_spots(&from->dent[limb], &to->dent[limb]);
        to->way[limb] = from->way[limb];
    }
}

Carry field_carry_to(const Field *f, const BodyFrame *body, double dt) {
    return (Carry){.turn = mat_mul(body->pose.bone[ROLE_PELVIS].r, mat_transpose(f->pelvis)),
                   .fade = pow(FADE, dt * 30),
                   .most = SINK * f->scale * dt,
                   .felt = FELT * f->scale};
}

bool field_carry_one(Vec3 *d, const Carry *c) {
    if (field_is_zero(*d)) return false;
    double length = vec_len(*d), left = fmax(c->fade * length, length - c->most);
    *d = left > c->felt ? vec_scale(mat_apply(c->turn, *d), left / length) : vec(0, 0, 0);
    return left > c->felt;
}

static void carry_spots(FieldSpots *s, const Carry *c) {
    int before = s->n;
    s->n = 0;
    for (int k = 0; k < before; k++) {
        int place = s->place[k];
        if (field_carry_one(&s->at[place], c)) s->place[s->n++] = place;
        else drop_spot(s, place);
    }
}

/* The displacement at a lattice point, by some levels. */
static Vec3 sum_of(const Field *f, unsigned levels, LatticeIndex at) {
    Vec3 d = {0, 0, 0};
    for (int level = 0; levels >> level; level++) {
        if (!(levels >> level & 1)) continue;
        LatticeWeights of = lattice_weights(f->lattice, level, at);
        for (int k = 0; k < 4; k++) d = vec_mad(d, f->displacement[f->start[level] + of.vertex[k]], of.weight[k]);
    }
    return d;
}

/* Shortens the vector of a level at a corner of its cells, so that with those of coarser levels it is no longer than
   the cap. */
static void keep_to_cap(Field *f, int level, int patch, int a, int b) {
    int n = (1 << level) + 1, size = f->lattice->side >> level;
    Vec3 *d = &f->displacement[f->start[level] + f->lattice->level[level].vertex[(patch * n + a) * n + b]];
    if (field_is_zero(*d)) return;
    bool is_beyond = false;
    Vec3 coarser = sum_of(f, (1u << level) - 1, (LatticeIndex){patch, a * size, b * size});
    Vec3 sum = field_limit(vec_add(coarser, *d), f->cap, &is_beyond);
    if (is_beyond) *d = vec_sub(sum, coarser);
}

/* Where the body leaves no room, pushes pile up on all levels: each keeps to the cap, and so does the cloth, but not
   their sum. Carried on, it would hold the cloth where it is for long after the body has gone. */
static void drop_beyond_cap(Field *f) {
    for (int level = 0; level <= f->lattice->depth; level++)
        for (int patch = 0; patch < f->lattice->fit->npatches; patch++)
            for (int a = 0; a <= 1 << level; a++)
                for (int b = 0; b <= 1 << level; b++) keep_to_cap(f, level, patch, a, b);
}

/* Fading lets the cloth sink into the part that holds it, and the solver pushes it out again. If it sank by
   centimetres, it would be pushed out on whichever side is nearest, on one side in one frame and on another in the
   next. */
void field_carry(Field *f, const BodyFrame *body, double dt, bool restart, Leaves *leaves) {
    const Lattice *l = f->lattice;
    Carry c = field_carry_to(f, body, dt);
    if (restart) field_forget(f);
    else drop_beyond_cap(f);
    for (int level = 0; level <= l->depth; level++)
        for (int v = 0; v < l->level[level].count; v++)
            if (field_carry_one(&f->displacement[f->start[level] + v], &c)) leaves_open(leaves, level, v);
    carry_spots(&f->offset, &c);
    field_drop_dents(f);
    f->pelvis = body->pose.bone[ROLE_PELVIS].r;
}

/* d, or the point on the way from `by` to it that is `most` from `by`. */
static Vec3 held(Vec3 d, Vec3 by, double most) {
    bool far;
    return vec_add(by, field_limit(vec_sub(d, by), most, &far));
}

static void hold_spots(FieldSpots *s, const FieldSpots *by, double most) {
    for (int k = 0; k < by->n; k++)
        if (!s->is_listed[by->place[k]]) field_set_spot(s, by->place[k], vec(0, 0, 0));
    for (int k = 0; k < s->n; k++) s->at[s->place[k]] = held(s->at[s->place[k]], by->at[s->place[k]], most);
}

void field_hold(Field *f, const Field *by, double most, Leaves *leaves) {
    const Lattice *l = f->lattice;
    for (int level = 0; level <= l->depth; level++)
        for (int v = 0; v < l->level[level].count; v++) {
            Vec3 *d = &f->displacement[f->start[level] + v];
            *d = held(*d, by->displacement[f->start[level] + v], most);
            if (!field_is_zero(*d)) leaves_open(leaves, level, v);
        }
    hold_spots(&f->offset, &by->offset, most);
}

unsigned field_levels(const Field *f) {
    unsigned used = 0;
    for (int level = 0; level <= f->lattice->depth; level++)
        for (int k = f->start[level]; k < f->start[level + 1] && !(used >> level & 1); k++)
            if (!field_is_zero(f->displacement[k])) used |= 1u << level;
    return used;
}

Vec3 field_at(const Field *f, unsigned levels, int place) { return sum_of(f, levels, f->lattice->owner[place]); }

Vec3 field_normal(const Field *f, const Patch *root, unsigned levels, int place) {
    const Lattice *l = f->lattice;
    LatticeIndex at = l->owner[place];
    Vec3 du = bezier_weighted(&root[at.patch], l->basis_slope[at.i], l->basis[at.j]);
    Vec3 dw = bezier_weighted(&root[at.patch], l->basis[at.i], l->basis_slope[at.j]);
    for (int level = 0; levels >> level; level++) {
        if (!(levels >> level & 1)) continue;
        LatticeWeights of = lattice_weights(l, level, at);
        for (int k = 0; k < 4; k++) {
            Vec3 d = f->displacement[f->start[level] + of.vertex[k]];
            du = vec_mad(du, d, of.du[k]);
            dw = vec_mad(dw, d, of.dw[k]);
        }
    }
    return lattice_outwards(l, at.patch, du, dw);
}

/* The four corners' vectors, each to its quarter of the control points. */
bool field_patch(const Field *f, LatticeCell cell, int deeper, int level, Patch *out) {
    int shift = deeper - level, n = (1 << level) + 1, a = cell.a >> shift, b = cell.b >> shift;
    const int *vertex = f->lattice->level[level].vertex;
    bool any = false;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            int v = vertex[(cell.patch * n + a + i / 2) * n + b + j / 2];
            out->p[i][j] = f->displacement[f->start[level] + v];
            any |= !field_is_zero(out->p[i][j]);
        }
    return any;
}

Patch field_leaf(const Field *f, const Patch *root, LatticeCell cell, int level) {
    double size = 1.0 / (1 << level), u = cell.a * size, w = cell.b * size;
    Patch leaf = bezier_part(&root[cell.patch], u, u + size, w, w + size);
    for (int l = 0; l <= level; l++) {
        Patch whole, part;
        if (!field_patch(f, cell, level, l, &whole)) continue;
        int shift = level - l, mask = (1 << shift) - 1;
        double share = 1.0 / (1 << shift), left = (cell.a & mask) * share, top = (cell.b & mask) * share;
        part = bezier_part(&whole, left, left + share, top, top + share);
        for (int k = 0; k < 16; k++) leaf.p[k / 4][k % 4] = vec_add(leaf.p[k / 4][k % 4], part.p[k / 4][k % 4]);
    }
    return leaf;
}
