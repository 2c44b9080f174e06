/* From rings to root patches. The one idea: control points have names. A name is given once
   for each thing that can be shared (a curve's points, the points of a column between two
   nodes, the sewn side of a raw patch), so neighbouring patches share an edge because they use
   the same names, never because two positions happen to agree. */
#include "garment/fit.h"

#include <string.h>

#include "garment/fit_parts.h"

/* Handles of arcs: a quarter of an ellipse, and half of one, as a single cubic. The half is the
   one that reaches the full depth in its middle. */
static const double QUARTER = 0.5522847498307936, HALF = 4.0 / 3.0;

/* A ring in space: its centre and its half axes, front and back apart. */
typedef struct {
    Vec3 centre, side, front, back;
} Frame;

typedef struct {
    const Garment *g;
    const Body *body;
    Fit *fit;
    Arena *arena;
    int node_of[GARMENT_RINGS_MAX][STATION_COUNT];
    Frame ring[GARMENT_RINGS_MAX];
    Vec3 measure[GARMENT_RINGS_MAX]; /* what the file's lengths are multiplied with at a ring */
    int private_names;               /* given to points that nobody shares: -1, -2, ... */
} Tailor;

static bool is_leg(Role r) { return r >= ROLE_LEFT_THIGH; }

static const BodyPart *part_of(const Body *body, Role role) {
    return body->of_role[role] < 0 ? NULL : &body->part[body->of_role[role]];
}

/* The envelope's rings on a leg go round both legs: the hull of the two sections. */
static Section round_both_legs(const BodyPart *part, const BodyPart *twin, double at, Vec3 *centre) {
    Section s = body_section(part, at), t = body_section(twin, at);
    Vec3 a = rigid_apply(part->frame, vec(s.x, at * part->length, s.z));
    Vec3 b = rigid_apply(twin->frame, vec(t.x, at * twin->length, t.z));
    *centre = vec_mid(a, b);
    s.side += 0.5 * fabs(a.x - b.x);
    return s;
}

/* What lengths of the file are multiplied with at a ring, axis by axis: the girth, on the trunk
   also its breadth there and, along it, the length of its bone against the reference's. */
static Vec3 measure_at(const Tailor *t, const BodyPart *part, double at) {
    double scale = t->body->scale;
    if (part->role > ROLE_CHEST) return vec(scale, scale, scale);
    Figure reference = figure_reference();
    double usual = reference.end[part->role].y - reference.start[part->role].y;
    return vec(scale * body_breadth(t->body, part->frame.t.y + at * part->length), part->length / usual, scale);
}

static Vec3 by_axis(Vec3 a, Vec3 b) { return vec(a.x * b.x, a.y * b.y, a.z * b.z); }

static bool place_ring(Tailor *t, int r, Error *e) {
    const Ring *ring = &t->g->ring[r];
    const BodyPart *part = part_of(t->body, ring->part);
    if (!part)
        return error_set(e, ERR_INPUT, "garment '%s': ring '%s' is on '%s', which the body does not have", t->g->name,
                         ring->name, role_name(ring->part));
    double scale = t->body->scale, ease = ring->ease * scale;
    Vec3 measure = t->measure[r] = measure_at(t, part, ring->at);
    Section s = body_section(part, ring->at);
    Vec3 centre = rigid_apply(part->frame, vec(s.x, ring->at * part->length, s.z));
    Vec3 x = mat_column(part->frame.r, 0), z = mat_column(part->frame.r, 2);
    if (x.x < 0) x = vec_scale(x, -1);
    if (z.z < 0) z = vec_scale(z, -1);
    double least = 0;
    const BodyPart *twin = is_leg(ring->part) ? part_of(t->body, role_mirror(ring->part)) : NULL;
    if (t->g->follow == FOLLOW_ENVELOPE && twin) {
        s = round_both_legs(part, twin, ring->at, &centre);
        least = s.side + 0.015 * scale; /* wide hips widen a skirt of fixed size */
        x = vec(1, 0, 0);
        z = vec(0, 0, 1);
    }
    if (ring->has_size) {
        s.side = fmax(ring->side * measure.x, least);
        s.front = ring->front * measure.z;
        s.back = ring->back * measure.z;
    }
    Mat3 tilt = mat_axis_angle(vec(0, 0, 1), ring->tilt * PI / 180);
    Frame *f = &t->ring[r];
    f->centre = vec_add(centre, by_axis(ring->shift, measure));
    f->side = vec_scale(mat_apply(tilt, x), s.side + ease);
    f->side.y *= measure.y / measure.x; /* what is given in breadths stands in lengths there */
    f->front = vec_scale(mat_apply(tilt, z), s.front + ease);
    f->back = vec_scale(mat_apply(tilt, z), s.back + ease);
    t->fit->ring[r] = (FitRing){f->centre.y, s.side + ease, s.front + ease, s.back + ease, f->centre.z};
    return true;
}

static void station_unit(Station s, double out[2]) {
    out[0] = s == STATION_LEFT ? 1 : s == STATION_RIGHT ? -1 : 0;
    out[1] = s == STATION_FRONT ? 1 : s == STATION_BACK ? -1 : 0;
}

/* A point of the unit circle as a vector of the ring: front and back have their own depths. */
static Vec3 ring_vector(const Frame *f, double x, double z) {
    return vec_mad(vec_scale(f->side, x), z > 0 ? f->front : f->back, z);
}

static Vec3 station_rest(const Tailor *t, int r, Station s) {
    double unit[2];
    station_unit(s, unit);
    Vec3 p = vec_add(t->ring[r].centre, ring_vector(&t->ring[r], unit[0], unit[1]));
    return vec_add(p, by_axis(t->g->ring[r].move[s], t->measure[r]));
}

static Binding binding_or_own(const Ring *ring, Station s) {
    if (ring->binding[s].n > 0) return ring->binding[s];
    return (Binding){.n = 1, .bone = {ring->part}, .weight = {1}};
}

/* Mean of two bindings; where that names more bones than fit, the heaviest stay. */
static Binding mean_binding(Binding a, Binding b) {
    double weight[ROLE_COUNT] = {0}, total = 0;
    for (int i = 0; i < a.n; i++) weight[a.bone[i]] += 0.5 * a.weight[i];
    for (int i = 0; i < b.n; i++) weight[b.bone[i]] += 0.5 * b.weight[i];
    Binding out = {0};
    while (out.n < BINDING_MAX) {
        int best = 0;
        for (int r = 1; r < ROLE_COUNT; r++)
            if (weight[r] > weight[best]) best = r;
        if (weight[best] <= 0) break;
        out.bone[out.n] = (Role)best;
        out.weight[out.n++] = weight[best];
        total += weight[best];
        weight[best] = 0;
    }
    for (int i = 0; i < out.n; i++) out.weight[i] /= total;
    return out;
}

static void join_nodes(Tailor *t, int a, int b) {
    FitNode *node = t->fit->node;
    node[a] = (FitNode){vec_mid(node[a].rest, node[b].rest), mean_binding(node[a].binding, node[b].binding)};
    for (int r = 0; r < t->g->nrings; r++)
        for (int s = 0; s < STATION_COUNT; s++)
            if (t->node_of[r][s] == b) t->node_of[r][s] = a;
}

static bool make_nodes(Tailor *t, Error *e) {
    const Garment *g = t->g;
    Fit *f = t->fit;
    f->node = ARENA_NEW(t->arena, FitNode, g->nrings * STATION_COUNT, e);
    if (!f->node) return false;
    for (int r = 0; r < g->nrings; r++)
        for (int s = 0; s < STATION_COUNT; s++) {
            t->node_of[r][s] = f->nnodes;
            f->node[f->nnodes++] = (FitNode){station_rest(t, r, (Station)s), binding_or_own(&g->ring[r], (Station)s)};
        }
    for (int k = 0; k < g->njoins; k++) {
        const Join *j = &g->join[k];
        int a = t->node_of[j->ring_a][j->station_a], b = t->node_of[j->ring_b][j->station_b];
        if (a != b) join_nodes(t, a, b);
    }
    return true;
}

/* The arc leaves `from` towards its via (or, a quarter, towards `to`) and reaches `to` coming
   from that via (or from where `from` lies). */
static void make_curve(const Tailor *t, const Row *row, FitCurve *c) {
    int r = row->ring;
    double a[2], b[2], leave[2], arrive[2];
    bool quarter = row->via == STATION_NONE;
    station_unit(row->from, a);
    station_unit(row->to, b);
    station_unit(quarter ? row->to : row->via, leave);
    station_unit(quarter ? row->from : row->via, arrive);
    double k = quarter ? QUARTER : HALF;
    *c = (FitCurve){.ring = r, .node = {t->node_of[r][row->from], t->node_of[r][row->to]}};
    if (!quarter) c->middle = t->g->ring[r].binding[row->via];
    for (int i = 0; i < 2; i++) {
        c->unit[0][i] = a[i];
        c->unit[1][i] = a[i] + k * leave[i];
        c->unit[2][i] = b[i] + k * arrive[i];
        c->unit[3][i] = b[i];
    }
    c->rest[0] = t->fit->node[c->node[0]].rest;
    c->rest[1] = vec_add(c->rest[0], ring_vector(&t->ring[r], k * leave[0], k * leave[1]));
    c->rest[3] = t->fit->node[c->node[1]].rest;
    c->rest[2] = vec_add(c->rest[3], ring_vector(&t->ring[r], k * arrive[0], k * arrive[1]));
}

/* The curve of a row, made when it is first used; rows through the same stations share it. */
static int curve_of(Tailor *t, const Row *row) {
    FitCurve made;
    make_curve(t, row, &made);
    Fit *f = t->fit;
    for (int i = 0; i < f->ncurves; i++)
        if (f->curve[i].ring == made.ring && memcmp(f->curve[i].unit, made.unit, sizeof made.unit) == 0) return i;
    f->curve[f->ncurves] = made;
    return f->ncurves++;
}

/* What turns the handles of half arcs at their ends: the mean of the middle stations of all arcs
   of the ring that meet there. */
static void find_turns(Fit *f) {
    for (int c = 0; c < f->ncurves; c++)
        for (int end = 0; end < 2 && f->curve[c].middle.n; end++) {
            Binding turn = f->curve[c].middle;
            for (int k = 0; k < f->ncurves; k++) {
                const FitCurve *other = &f->curve[k];
                bool meets = other->node[0] == f->curve[c].node[end] || other->node[1] == f->curve[c].node[end];
                if (k != c && meets && other->ring == f->curve[c].ring && other->middle.n)
                    turn = mean_binding(turn, other->middle);
            }
            f->curve[c].turn[end] = mean_binding(turn, f->node[f->curve[c].node[end]].binding);
        }
}

/* The rows between which patches lie: row k of a panel and the next. */
typedef struct {
    int panel, row, group;
} Span;

static const FitCurve *span_curve(const Fit *f, const Span *s, int which) {
    return &f->curve[f->panel[s->panel].curve[s->row + which]];
}

/* Have the two a column in common, as a side of each? */
static bool spans_touch(const Fit *f, const Span *a, const Span *b) {
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++)
            if (span_curve(f, a, 0)->node[i] == span_curve(f, b, 0)->node[k] &&
                span_curve(f, a, 1)->node[i] == span_curve(f, b, 1)->node[k])
                return true;
    return false;
}

/* The same number for all spans that hang together by common columns. */
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

/* Parameter length between two rows: the mean distance of their control points, over all spans
   of the group, since panels side by side draw one column, also where legs differ in length. */
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
        for (int k = 0; k < g->panel[p].nrows; k++) f->panel[p].curve[k] = curve_of(t, &g->panel[p].row[k]);
    }
    find_turns(f);
    return find_heights(t, e);
}

/* Names. Point k of curve c is 4 c + k, but its ends are nodes, which other curves share; the
   inner points of a column are named by the two nodes that it joins. */
static int node_name(const Fit *f, int node) { return 4 * f->ncurves + node; }

static int curve_name(const Fit *f, int curve, int k) {
    return k == 0 || k == 3 ? node_name(f, f->curve[curve].node[k == 3]) : 4 * curve + k;
}

static int column_name(const Fit *f, int above, int below, int k) {
    return 4 * f->ncurves + f->nnodes + 2 * (above * f->nnodes + below) + (k == 2);
}

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
    Vec3 p = vec_scale(c->rest[0], b[0]);
    for (int i = 1; i < 4; i++) p = vec_mad(p, c->rest[i], b[i]);
    return p;
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

/* A panel's patches face one way: the way that most of their area says is outwards. */
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

/* A patch for which nothing is said meets every part that the garment names at all. */
static void complete_colliders(Fit *f) {
    for (int p = 0; p < f->npatches; p++) f->collide |= f->patch[p].collide;
    for (int p = 0; p < f->npatches; p++)
        if (!f->patch[p].collide) f->patch[p].collide = f->collide;
}

bool fit_garment(const Garment *garment, const Figure *figure, const Body *body, Arena *arena, Fit *out, Error *e) {
    *out = (Fit){.garment = garment, .scale = body->scale, .height = figure->height};
    Tailor t = {.g = garment, .body = body, .fit = out, .arena = arena};
    int npatches = garment->npatches;
    for (int p = 0; p < garment->npanels; p++) npatches += garment->panel[p].nrows - 1;
    out->patch = ARENA_NEW(arena, FitPatch, npatches, e);
    if (!out->patch) return false;
    for (int r = 0; r < garment->nrings; r++)
        if (!place_ring(&t, r, e)) return false;
    if (!make_nodes(&t, e) || !make_panels(&t, e)) return false;
    for (int p = 0; p < out->npanels; p++)
        for (int k = 0; k + 1 < out->panel[p].nrows; k++) make_panel_patch(&t, p, k);
    for (int p = 0; p < out->npanels; p++) face_outwards(&t, p);
    if (!fit_raw_patches(out, figure, body, &t.private_names, arena, e)) return false;
    if (!fit_number_points(out, arena, e)) return false;
    complete_colliders(out);
    return true;
}
