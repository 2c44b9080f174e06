/* Global deformation. Rings move with the body, and panels are lofted through them anew in every frame. That keeps a
   panel smooth across its rows; control points that follow their bones one by one would not.

   Garments that follow bones: each node of a ring moves with a blend of its bones, and the handles of the arcs turn
   with their node. Garments that follow the envelope: the rings are those of dress/envelope. Raw patches: every
   control point follows its bones, as in the paper. */
#include "dress/follow.h"

#include <string.h>

#include "dress/armpit.h"
#include "dress/blend.h"
#include "dress/crease.h"
#include "dress/envelope.h"
#include "dress/ride.h"

static int column_end(const Fit *fit, int panel, int row, int end) {
    return fit->curve[fit->panel[panel].curve[row]].node[end];
}

/* The number of the column that leads from a row of a panel to the next one: that of a panel before which
   joins the same two nodes, or a new one. */
static int find_column(const Follower *f, int panel, int row, int end) {
    int above = column_end(f->fit, panel, row, end), below = column_end(f->fit, panel, row + 1, end);
    for (int p = 0; p <= panel; p++)
        for (int r = 0; r + 1 < f->fit->panel[p].nrows; r++)
            for (int k = 0; k < 2; k++) {
                if (p == panel && (r > row || (r == row && k >= end))) return f->ncolumns;
                if (column_end(f->fit, p, r, k) == above && column_end(f->fit, p, r + 1, k) == below)
                    return f->column[p][r][k];
            }
    return f->ncolumns;
}

static void number_columns(Follower *f) {
    for (int p = 0; p < f->fit->npanels; p++)
        for (int r = 0; r + 1 < f->fit->panel[p].nrows; r++)
            for (int end = 0; end < 2; end++) {
                int column = f->column[p][r][end] = find_column(f, p, r, end);
                if (column == f->ncolumns) f->ncolumns++;
                f->column_uses[column]++;
            }
}

bool follow_reserve(Follower *f, const Fit *fit, const Figure *figure, const Body *body, Arena *arena, Error *e) {
    *f = (Follower){.fit = fit, .figure = figure, .body = body};
    size_t columns = 2 * GARMENT_ROWS_MAX * (size_t)fit->npanels;
    f->curve = arena_array(arena, (size_t)fit->ncurves, sizeof *f->curve, e);
    f->up = ARENA_NEW(arena, double, fit->nnodes, e);
    f->slope = arena_array(arena, (size_t)fit->npanels, sizeof *f->slope, e);
    f->column = arena_array(arena, (size_t)fit->npanels, sizeof *f->column, e);
    f->column_slope = arena_array(arena, columns, sizeof *f->column_slope, e);
    f->column_length = arena_array(arena, columns, sizeof *f->column_length, e);
    f->column_uses = ARENA_NEW(arena, int, columns, e);
    if (!f->curve || !f->up || !f->slope || !f->column || !f->column_slope || !f->column_length || !f->column_uses)
        return false;
    number_columns(f);
    return true;
}

/* The inner control point at an end of a half arc that its middle station shapes (see FitCurve). node: where that
   end is. The handle keeps at least LEAST of its rest length, or a leg that is bent far would turn it over. */
static Vec3 shaped_handle(const Blender *b, const FitCurve *curve, int end, Vec3 node) {
    static const double LEAST = 0.3;
    Vec3 rest = curve->rest[1 + end], arm = vec_sub(rest, curve->rest[3 * end]);
    Vec3 wanted = rigid_apply(blend_at(b, &curve->middle, rest), rest);
    Vec3 direction = vec_unit_or(mat_apply(blend_at(b, &curve->turn[end], curve->rest[3 * end]).r, arm), arm);
    return vec_mad(node, direction, fmax(vec_dot(vec_sub(wanted, node), direction), LEAST * vec_len(arm)));
}

static CreaseSide side_of_node(const Follower *f, const Fold *fold, int curve, int end) {
    return crease_side(fold, &f->fit->node[f->fit->curve[curve].node[end]].binding);
}

/* Of the envelope, the rings that stand above the hip joints belong to the trunk. The others go round both legs. */
static CreaseSide side_of_ring(const Follower *f, const Fold *fold, int curve) {
    bool is_above = f->fit->ring[f->fit->curve[curve].ring].y > f->figure->start[ROLE_LEFT_THIGH].y;
    return is_above && fold_has_above(fold, ROLE_PELVIS) ? CREASE_ABOVE : CREASE_APART;
}

/* A curve of the cloth stays on its side of all folds. above, below: the curves of rings between which it lies, or
   twice the one that it is. */
static void keep_curve(const Follower *f, const Pose *pose, int above, int below, Vec3 curve[4]) {
    for (const Fold *fold = f->folds.fold; fold < f->folds.fold + FOLDS; fold++) {
        if (fold->closed <= 0) continue;
        CreaseSide side[2];
        if (f->fit->garment->follow == FOLLOW_ENVELOPE) {
            side[0] = crease_side_of_both(side_of_ring(f, fold, above), side_of_ring(f, fold, below));
            crease_keep_between(f->body, pose, fold, side[0], curve);
            continue;
        }
        for (int end = 0; end < 2; end++)
            side[end] = crease_side_of_both(side_of_node(f, fold, above, end), side_of_node(f, fold, below, end));
        crease_keep(f->body, pose, fold, side[0], side[1], curve);
    }
}

static void curves_by_bones(Follower *f, const Pose *pose) {
    Blender b = blender_of(f->figure, pose);
    Armpits armpits = armpits_find(f->figure, f->body, pose);
    for (int c = 0; c < f->fit->ncurves; c++) {
        const FitCurve *curve = &f->fit->curve[c];
        for (int end = 0; end < 2; end++) {
            const FitNode *node = &f->fit->node[curve->node[end]];
            Vec3 rest = curve->rest[3 * end], handle = vec_sub(curve->rest[1 + end], rest);
            Rigid g = blend_at(&b, &node->binding, rest);
            Vec3 at = armpits_span(&armpits, pose, &node->binding, rest, rigid_apply(g, rest));
            at = f->curve[c][3 * end] = crease_mitre(f->figure, pose, &node->binding, at);
            f->curve[c][1 + end] =
                curve->middle.n ? shaped_handle(&b, curve, end, at) : vec_add(at, mat_apply(g.r, handle));
        }
    }
    ride_up(f->fit, f->figure, pose, f->curve, f->up);
}

/* Derivatives across the rows at row r by the parabola through three rows (Bessel), at the first
   and last row by the parabola's end. */
static Vec3 row_slope(const Follower *f, const FitPanel *panel, int r, int k) {
    int n = panel->nrows;
    const double *h = panel->height;
    Vec3 here = f->curve[panel->curve[r]][k];
    if (n == 2) return vec_scale(vec_sub(f->curve[panel->curve[1]][k], f->curve[panel->curve[0]][k]), 1 / h[0]);
    if (r > 0 && r < n - 1) {
        Vec3 d0 = vec_scale(vec_sub(here, f->curve[panel->curve[r - 1]][k]), 1 / h[r - 1]);
        Vec3 d1 = vec_scale(vec_sub(f->curve[panel->curve[r + 1]][k], here), 1 / h[r]);
        return vec_scale(vec_add(vec_scale(d0, h[r]), vec_scale(d1, h[r - 1])), 1 / (h[r - 1] + h[r]));
    }
    int inner = r == 0 ? 1 : n - 2, span = r == 0 ? 0 : n - 2;
    Vec3 chord = vec_scale(vec_sub(f->curve[panel->curve[span + 1]][k], f->curve[panel->curve[span]][k]), 1 / h[span]);
    return vec_sub(vec_scale(chord, 2), row_slope(f, panel, inner, k));
}

/* Panels that share a column between two nodes must have the same curve there. They take the mean of their slopes at
   its ends, shortened by how much these disagree. Different columns that leave a node, as at a crotch or at the
   bottom of a neckline, keep their own slopes: with one slope for all, a crotch would be a spike, and the borders of
   a neckline would run side by side for a facet. */
static void share_slopes(Follower *f) {
    const Fit *fit = f->fit;
    memset(f->column_slope, 0, (size_t)f->ncolumns * sizeof *f->column_slope);
    memset(f->column_length, 0, (size_t)f->ncolumns * sizeof *f->column_length);
    for (int pass = 0; pass < 2; pass++)
        for (int p = 0; p < fit->npanels; p++)
            for (int r = 0; r + 1 < fit->panel[p].nrows; r++)
                for (int end = 0; end < 4; end++) {
                    int column = f->column[p][r][end % 2], below = end / 2;
                    Vec3 *slope = &f->slope[p][r + below][!below][3 * (end % 2)];
                    Vec3 *sum = &f->column_slope[column][below];
                    double *length = &f->column_length[column][below];
                    if (pass == 0) {
                        *sum = vec_add(*sum, *slope);
                        *length += vec_len(*slope);
                    } else {
                        double agreement = *length > 0 ? vec_len(*sum) / *length : 1;
                        *slope = vec_scale(*sum, agreement / f->column_uses[column]);
                    }
                }
}

static void slopes_by_rows(Follower *f) {
    for (int p = 0; p < f->fit->npanels; p++)
        for (int r = 0; r < f->fit->panel[p].nrows; r++)
            for (int k = 0; k < 4; k++)
                f->slope[p][r][0][k] = f->slope[p][r][1][k] = row_slope(f, &f->fit->panel[p], r, k);
}

/* Arcs of one ring that meet at a node from opposite sides get handles on one line, so that the ring is smooth
   there. */
static void straighten_handles(Follower *f) {
    const Fit *fit = f->fit;
    for (int a = 0; a < fit->ncurves; a++)
        for (int b = a + 1; b < fit->ncurves; b++) {
            if (fit->curve[a].ring != fit->curve[b].ring) continue;
            for (int i = 0; i < 4; i++) {
                int ea = i / 2, eb = i % 2;
                if (fit->curve[a].node[ea] != fit->curve[b].node[eb]) continue;
                Vec3 node = f->curve[a][3 * ea], *ha = &f->curve[a][1 + ea], *hb = &f->curve[b][1 + eb];
                Vec3 va = vec_sub(*ha, node), vb = vec_sub(*hb, node);
                double la = vec_len(va), lb = vec_len(vb);
                if (vec_dot(va, vb) >= 0) continue; /* the same side: not neighbours */
                Vec3 line = vec_unit_or(vec_sub(vec_scale(va, lb), vec_scale(vb, la)), va);
                *ha = vec_mad(node, line, la);
                *hb = vec_mad(node, line, -lb);
            }
        }
}

/* The derivative down the body of the envelope at s, at a control point of the unit circle. Where rings turn fast, as
   before a bent knee, it is longer than the cloth that leads there, which would swing out with it; so it is held. */
static Vec3 envelope_slope(const Envelope *env, double s, const double unit[2]) {
    static const double STEEPEST = 1.8;
    double step = env->cm;
    Vec3 above = envelope_point(env, s - step, unit[0], unit[1]);
    Vec3 below = envelope_point(env, s + step, unit[0], unit[1]);
    Vec3 slope = vec_scale(vec_sub(below, above), 0.5 / step);
    return vec_scale(slope, STEEPEST / fmax(vec_len(slope), STEEPEST));
}

static void curves_by_envelope(Follower *f, const Pose *pose) {
    const Fit *fit = f->fit;
    Envelope env;
    envelope_pose(&env, fit, f->figure, f->body, pose);
    for (int c = 0; c < fit->ncurves; c++) {
        const FitCurve *curve = &fit->curve[c];
        double s = envelope_place(&env, curve->ring);
        for (int k = 0; k < 4; k++) f->curve[c][k] = envelope_point(&env, s, curve->unit[k][0], curve->unit[k][1]);
    }
    for (int p = 0; p < fit->npanels; p++)
        for (int r = 0; r < fit->panel[p].nrows; r++) {
            const FitCurve *curve = &fit->curve[fit->panel[p].curve[r]];
            double s = envelope_place(&env, curve->ring);
            for (int k = 0; k < 4; k++)
                f->slope[p][r][0][k] = f->slope[p][r][1][k] = envelope_slope(&env, s, curve->unit[k]);
        }
    straighten_handles(f);
}

/* Parameter length from row r to the next: of an envelope the arc length down the body, by which its slopes are
   derivatives. */
static double span(const Follower *f, const FitPanel *panel, int r) {
    const Fit *fit = f->fit;
    if (fit->garment->follow != FOLLOW_ENVELOPE) return panel->height[r];
    return fit->ring[fit->curve[panel->curve[r]].ring].y - fit->ring[fit->curve[panel->curve[r + 1]].ring].y;
}

static void loft(const Follower *f, const FitPatch *patch, Patch *out) {
    const FitPanel *panel = &f->fit->panel[patch->panel];
    int r = patch->row;
    const Vec3 *above = f->curve[panel->curve[r]], *below = f->curve[panel->curve[r + 1]];
    const Vec3 *leave = f->slope[patch->panel][r][1], *arrive = f->slope[patch->panel][r + 1][0];
    double h = span(f, panel, r);
    for (int k = 0; k < 4; k++) bezier_from_hermite(above[k], leave[k], below[k], arrive[k], h, out->p[k]);
}

/* What a panel has between two rings stays on its side of all folds, as the rings do. */
static void keep_patch(const Follower *f, const Pose *pose, const FitPatch *patch, Patch *p) {
    const int *row = &f->fit->panel[patch->panel].curve[patch->row];
    for (int between = 1; between < 3; between++) {
        Vec3 curve[4];
        for (int k = 0; k < 4; k++) curve[k] = p->p[k][between];
        keep_curve(f, pose, row[0], row[1], curve);
        for (int k = 0; k < 4; k++) p->p[k][between] = curve[k];
    }
}

static void follow_raw(const Follower *f, const FitPatch *patch, const Pose *pose, Patch *out) {
    const RawPatch *raw = &f->fit->garment->patch[patch->row];
    const Vec3 *rest = f->fit->raw[patch->row];
    for (int c = 0; c < 16; c++) {
        Vec3 p = {0, 0, 0};
        for (int b = 0; b < raw->binding[c].n; b++)
            p = vec_mad(p, rigid_apply(pose->bone[raw->binding[c].bone[b]], rest[c]), raw->binding[c].weight[b]);
        out->p[c / 4][c % 4] = p;
    }
}

void follow_pose(Follower *f, const Pose *pose, Patch *out) {
    const Fit *fit = f->fit;
    bool by_envelope = fit->garment->follow == FOLLOW_ENVELOPE && fit->npanels > 0;
    if (by_envelope) curves_by_envelope(f, pose);
    else curves_by_bones(f, pose);
    f->folds = folds_find(f->body, pose);
    for (int c = 0; c < fit->ncurves; c++) keep_curve(f, pose, c, c, f->curve[c]);
    if (!by_envelope) slopes_by_rows(f);
    share_slopes(f);
    for (int p = 0; p < fit->npatches; p++) {
        if (fit->patch[p].panel < 0) {
            follow_raw(f, &fit->patch[p], pose, &out[p]);
            continue;
        }
        loft(f, &fit->patch[p], &out[p]);
        keep_patch(f, pose, &fit->patch[p], &out[p]);
    }
}
