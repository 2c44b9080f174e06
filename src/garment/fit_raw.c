/* Raw patches: sixteen control points each, sized to the figure bone by bone, and sewn. */
#include "garment/fit_parts.h"

#include <string.h>

double fit_outwardness(const Vec3 q[4], Vec3 centre) {
    Vec3 du = vec_sub(vec_add(q[2], q[3]), vec_add(q[0], q[1]));
    Vec3 dw = vec_sub(vec_add(q[1], q[3]), vec_add(q[0], q[2]));
    Vec3 middle = vec_mid(vec_mid(q[0], q[1]), vec_mid(q[2], q[3]));
    return vec_dot(vec_cross(du, dw), vec_sub(middle, centre));
}

/* Where a bone's point of the reference figure lies on this one: along the bone by its length,
   across by the girth. */
static Vec3 warp_by_bone(const Fit *f, const Figure *figure, const Figure *reference, Role bone, Vec3 p) {
    Vec3 axis = vec_sub(reference->end[bone], reference->start[bone]);
    Vec3 mine = vec_sub(figure->end[bone], figure->start[bone]);
    double length = vec_len(axis), ratio = length > 1e-9 ? vec_len(mine) / length : 1;
    Vec3 unit = vec_unit_or(axis, vec(0, 1, 0)), off = vec_sub(p, reference->start[bone]);
    double along = vec_dot(off, unit);
    Vec3 across = vec_mad(off, unit, -along);
    return vec_mad(vec_mad(figure->start[bone], vec_unit_or(mine, unit), along * ratio), across, f->scale);
}

/* Sizes a raw patch to the figure; returns a point inside the body behind it. */
static Vec3 warp_raw(const Fit *f, const Figure *figure, const Figure *reference, const RawPatch *raw, Vec3 out[16]) {
    Vec3 inside = {0, 0, 0};
    for (int c = 0; c < 16; c++) {
        out[c] = vec(0, 0, 0);
        for (int b = 0; b < raw->binding[c].n; b++) {
            Role bone = raw->binding[c].bone[b];
            double weight = raw->binding[c].weight[b];
            out[c] = vec_mad(out[c], warp_by_bone(f, figure, reference, bone, raw->point[c]), weight);
            Vec3 middle = vec_mid(figure->start[bone], figure->end[bone]);
            if (bone >= ROLE_LEFT_THIGH && f->garment->loose) middle.x = 0; /* a skirt goes round both legs */
            inside = vec_mad(inside, middle, weight / 16);
        }
    }
    return inside;
}

static bool make_patches(Fit *f, const Figure *figure, int *private_names, Arena *arena, Error *e) {
    const Garment *g = f->garment;
    f->raw = arena_array(arena, (size_t)g->npatches, sizeof *f->raw, e);
    if (!f->raw) return false;
    Figure reference = figure_reference();
    for (int k = 0; k < g->npatches; k++) {
        FitPatch *patch = &f->patch[f->npatches++];
        *patch = (FitPatch){.panel = -1, .row = k};
        Vec3 inside = warp_raw(f, figure, &reference, &g->patch[k], f->raw[k]);
        for (int c = 0; c < 16; c++) patch->point[c] = --*private_names;
        Patch shape;
        memcpy(shape.p, f->raw[k], sizeof shape.p);
        Vec3 q[4];
        for (int c = 0; c < 4; c++) q[c] = bezier_point(&shape, c < 2 ? 0.25 : 0.75, c % 2 ? 0.75 : 0.25, NULL, NULL);
        inside.y = vec_mid(q[0], q[3]).y;
        patch->flip = fit_outwardness(q, inside) < 0;
        for (int i = 0; i < g->ncollides; i++)
            if (g->collide[i].from_ring < 0 && g->collide[i].piece == g->npanels + k)
                patch->collide |= g->collide[i].parts;
        for (int i = 0; i < g->npins; i++)
            if (g->pin[i].ring < 0 && g->pin[i].piece == g->npanels + k) patch->pinned |= 1u << g->pin[i].side;
    }
    return true;
}

static void rename_point(Fit *f, int from, int to) {
    for (int p = 0; p < f->npatches; p++)
        for (int c = 0; c < 16; c++)
            if (f->patch[p].point[c] == from) f->patch[p].point[c] = to;
}

/* Seams between raw patches give both sides the same names. The sides may run either way. */
static bool sew(Fit *f, Error *e) {
    const Garment *g = f->garment;
    int first_raw = f->npatches - g->npatches;
    for (int k = 0; k < g->nseams; k++) {
        const Seam *s = &g->seam[k];
        int a = s->piece_a - g->npanels, b = s->piece_b - g->npanels;
        if (a < 0 || b < 0) continue; /* panels share by their stations */
        const Vec3 *pa = f->raw[a], *pb = f->raw[b];
        Vec3 corner = pa[side_point(s->side_a, 0)];
        bool reversed = vec_dist(corner, pb[side_point(s->side_b, 3)]) < vec_dist(corner, pb[side_point(s->side_b, 0)]);
        for (int i = 0; i < 4; i++) {
            int x = side_point(s->side_a, i), y = side_point(s->side_b, reversed ? 3 - i : i);
            if (vec_dist(pa[x], pb[y]) > 1e-5)
                return error_set(e, ERR_INPUT, "garment '%s': the sides of seam %d do not meet", g->name, k + 1);
            rename_point(f, f->patch[first_raw + b].point[y], f->patch[first_raw + a].point[x]);
            f->raw[b][y] = f->raw[a][x];
        }
    }
    return true;
}

bool fit_raw_patches(Fit *f, const Figure *figure, int *private_names, Arena *arena, Error *e) {
    return make_patches(f, figure, private_names, arena, e) && sew(f, e);
}
