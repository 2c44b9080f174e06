/* From curves to root patches. Control points have names, numbers that are given once for each thing that can be
   shared: a point of a curve, a point of a column between two nodes, a point on the sewn side of a raw patch.
   Neighbouring patches share an edge because they use the same names, never because two positions happen to agree. */
#include "garment/fit.h"

#include "garment/fit_parts.h"

/* A row of a panel and the next one, between which a patch lies. Spans of a group have the same height. */
typedef struct {
    int panel, row, group;
} Span;

static const FitCurve *span_curve(const Fit *f, const Span *s, int which) {
    return &f->curve[f->panel[s->panel].curve[s->row + which]];
}

/* Do two spans have a side in common: the column between the same two nodes? */
static bool spans_touch(const Fit *f, const Span *a, const Span *b) {
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++)
            if (span_curve(f, a, 0)->node[i] == span_curve(f, b, 0)->node[k] &&
                span_curve(f, a, 1)->node[i] == span_curve(f, b, 1)->node[k])
                return true;
    return false;
}

/* Gives all spans that are connected by common sides the same group. */
static void group_spans(const Fit *f, Span *span, int n) {
    for (int i = 0; i < n; i++) span[i].group = i;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < i; k++) {
            int from = span[i].group, to = span[k].group;
            if (from == to || !spans_touch(f, &span[i], &span[k])) continue;
            for (int m = 0; m <= i; m++)
                if (span[m].group == from) span[m].group = to;
        }
}

/* The parameter length between two rows: the mean distance of their control points, over all spans of the group. Panels
   side by side share a column, so their heights must be equal even if, say, the legs differ in length. */
static bool find_heights(Tailor *t, Error *e) {
    Fit *f = t->fit;
    Span *span = ARENA_NEW(t->arena, Span, GARMENT_PANELS_MAX * GARMENT_ROWS_MAX, e);
    int n = 0;
    if (!span) return false;
    for (int p = 0; p < f->npanels; p++)
        for (int k = 0; k + 1 < f->panel[p].nrows; k++) span[n++] = (Span){p, k, 0};
    group_spans(f, span, n);
    for (int i = 0; i < n; i++) {
        double sum = 0;
        int points = 0;
        for (int k = 0; k < n; k++)
            for (int c = 0; c < 4 && span[k].group == span[i].group; c++, points++)
                sum += vec_dist(span_curve(f, &span[k], 0)->rest[c], span_curve(f, &span[k], 1)->rest[c]);
        f->panel[span[i].panel].height[span[i].row] = sum > 0 ? sum / points : 1;
    }
    return true;
}

static bool make_panels(Tailor *t, Error *e) {
    const Garment *g = t->g;
    Fit *f = t->fit;
    f->curve = ARENA_NEW(t->arena, FitCurve, GARMENT_PANELS_MAX * GARMENT_ROWS_MAX, e);
    f->panel = ARENA_NEW(t->arena, FitPanel, g->npanels, e);
    if (!f->curve || !f->panel) return false;
    f->npanels = g->npanels;
    for (int p = 0; p < g->npanels; p++) {
        f->panel[p].name = g->panel[p].name;
        f->panel[p].nrows = g->panel[p].nrows;
        for (int k = 0; k < g->panel[p].nrows; k++) f->panel[p].curve[k] = fit_curve(t, &g->panel[p].row[k]);
    }
    fit_turns(f);
    return find_heights(t, e);
}

/* Names. Point k of curve c is 4 c + k; but its ends are nodes, which other curves share. The inner points of a column
   are named by the two nodes that it connects. */
static int node_name(const Fit *f, int node) { return 4 * f->ncurves + node; }

static int curve_name(const Fit *f, int curve, int k) {
    return k == 0 || k == 3 ? node_name(f, f->curve[curve].node[k == 3]) : 4 * curve + k;
}

static int column_name(const Fit *f, int above, int below, int k) {
    return 4 * f->ncurves + f->nnodes + 2 * (above * f->nnodes + below) + (k == 2);
}

/* The parts (bits 1 << role) that the patch below a row of a panel is worn over, by the garment's `collide` lines. */
static unsigned panel_collide(const Garment *g, int panel, int row) {
    unsigned parts = 0;
    const Panel *p = &g->panel[panel];
    for (int k = 0; k < g->ncollides; k++) {
        const Collide *c = &g->collide[k];
        if (c->from_ring < 0) {
            if (c->piece == panel) parts |= c->parts;
            continue;
        }
        int from = -1, to = -1;
        for (int r = 0; r < p->nrows; r++) {
            if (p->row[r].ring == c->from_ring) from = r;
            if (p->row[r].ring == c->to_ring) to = r;
        }
        bool between = from < to ? row >= from && row < to : row >= to && row < from;
        if (from >= 0 && to >= 0 && between) parts |= c->parts;
    }
    return parts;
}

/* The pinned sides of that patch, bits 1 << Side. */
static unsigned panel_pins(const Garment *g, int panel, int row) {
    unsigned sides = 0;
    const Panel *p = &g->panel[panel];
    for (int k = 0; k < g->npins; k++) {
        const Pin *pin = &g->pin[k];
        if (pin->ring >= 0) {
            if (p->row[row].ring == pin->ring) sides |= 1u << SIDE_TOP;
            if (p->row[row + 1].ring == pin->ring) sides |= 1u << SIDE_BOTTOM;
        } else if (pin->piece == panel) {
            bool first = row == 0, last = row + 2 == p->nrows;
            if ((pin->side != SIDE_TOP || first) && (pin->side != SIDE_BOTTOM || last)) sides |= 1u << pin->side;
        }
    }
    return sides;
}

static Vec3 arc_at(const FitCurve *c, double s) {
    double b[4];
    bezier_basis(s, b, NULL);
    return bezier_cubic(c->rest, b);
}

static void make_panel_patch(Tailor *t, int p, int k) {
    Fit *f = t->fit;
    int above = f->panel[p].curve[k], below = f->panel[p].curve[k + 1];
    const FitCurve *a = &f->curve[above], *b = &f->curve[below];
    FitPatch *patch = &f->patch[f->npatches++];
    *patch = (FitPatch){.panel = p, .row = k, .collide = panel_collide(t->g, p, k), .pinned = panel_pins(t->g, p, k)};
    for (int i = 0; i < 4; i++) {
        patch->point[4 * i] = curve_name(f, above, i);
        patch->point[4 * i + 3] = curve_name(f, below, i);
        for (int j = 1; j < 3; j++)
            patch->point[4 * i + j] =
                i == 0 || i == 3 ? column_name(f, a->node[i == 3], b->node[i == 3], j) : --t->private_names;
    }
}

/* All patches of a panel face the same way: outwards by most of their area. */
static void face_outwards(Tailor *t, int p) {
    Fit *f = t->fit;
    const FitPanel *panel = &f->panel[p];
    double outward = 0;
    for (int k = 0; k + 1 < panel->nrows; k++) {
        const FitCurve *a = &f->curve[panel->curve[k]], *b = &f->curve[panel->curve[k + 1]];
        Vec3 q[4] = {arc_at(a, 0.25), arc_at(b, 0.25), arc_at(a, 0.75), arc_at(b, 0.75)};
        outward += fit_outwardness(q, vec_mid(t->ring[a->ring].centre, t->ring[b->ring].centre));
    }
    for (int k = 0; k < f->npatches; k++)
        if (f->patch[k].panel == p) f->patch[k].flip = outward < 0;
}

/* A patch without a `collide` of its own is worn over all parts that the garment names. */
static void complete_colliders(Fit *f) {
    for (int p = 0; p < f->npatches; p++) f->collide |= f->patch[p].collide;
    for (int p = 0; p < f->npatches; p++)
        if (!f->patch[p].collide) f->patch[p].collide = f->collide;
}

Box fit_box(const Fit *f) {
    enum { PLACES = 16 };
    Box box = box_empty();
    for (int c = 0; c < f->ncurves; c++)
        for (int k = 0; k <= PLACES; k++) box_add(&box, arc_at(&f->curve[c], (double)k / PLACES));
    for (int p = 0; p < f->garment->npatches; p++) {
        Patch patch;
        for (int k = 0; k < 16; k++) patch.p[k / 4][k % 4] = f->raw[p][k];
        for (int k = 0; k < (PLACES + 1) * (PLACES + 1); k++) {
            double u = (double)(k / (PLACES + 1)) / PLACES, w = (double)(k % (PLACES + 1)) / PLACES;
            box_add(&box, bezier_point(&patch, u, w, NULL, NULL));
        }
    }
    return box;
}

bool fit_garment(const Garment *garment, const Figure *figure, const Body *body, Arena *arena, Fit *out, Error *e) {
    *out = (Fit){.garment = garment, .scale = body->scale, .height = figure->height};
    Tailor t = {.g = garment, .body = body, .fit = out, .arena = arena};
    int npatches = garment->npatches;
    for (int p = 0; p < garment->npanels; p++) npatches += garment->panel[p].nrows - 1;
    out->patch = ARENA_NEW(arena, FitPatch, npatches, e);
    if (!out->patch) return false;
    if (!fit_rings(&t, e) || !make_panels(&t, e)) return false;
    for (int p = 0; p < out->npanels; p++)
        for (int k = 0; k + 1 < out->panel[p].nrows; k++) make_panel_patch(&t, p, k);
    for (int p = 0; p < out->npanels; p++) face_outwards(&t, p);
    if (!fit_raw_patches(out, figure, &t.private_names, arena, e)) return false;
    if (!fit_number_points(out, arena, e)) return false;
    complete_colliders(out);
    return true;
}
