/* From rings to curves. A ring of the file becomes an ellipse round the fitted body; its four stations become nodes,
   which joins and neighbouring panels share; and the row of a panel, an arc from station to station, becomes a cubic
   curve. */
#include <string.h>

#include "garment/fit_parts.h"

/* Lengths of the handles of an arc, in half axes: for a quarter of an ellipse, and for half of one as a single
   cubic, which then reaches the full depth in its middle. */
static const double QUARTER = 0.5522847498307936, HALF = 4.0 / 3.0;

/* A skirt of fixed size is at least so much wider than both legs (half width, metres on the reference). */
static const double LEG_ROOM = 0.015;

static bool is_leg(Role r) { return r >= ROLE_LEFT_THIGH; }

static const BodyPart *part_of(const Body *body, Role role) {
    return body->of_role[role] < 0 ? NULL : &body->part[body->of_role[role]];
}

/* The section that holds those of both legs, for rings of an envelope, and its centre. */
static Section round_both_legs(const BodyPart *part, const BodyPart *twin, double at, Vec3 *centre) {
    Section s = body_section(part, at), t = body_section(twin, at);
    Vec3 a = rigid_apply(part->frame, vec(s.x, at * part->length, s.z));
    Vec3 b = rigid_apply(twin->frame, vec(t.x, at * twin->length, t.z));
    *centre = vec_mid(a, b);
    s.side += 0.5 * fabs(a.x - b.x);
    return s;
}

/* The factors for lengths of the file at a ring, along the canonical axes: the body's girth; on the trunk also its
   breadth there (x) and the length of its bone against the reference's (y). */
static Vec3 measure_at(const Tailor *t, const BodyPart *part, double at) {
    double scale = t->body->scale;
    if (part->role > ROLE_CHEST) return vec(scale, scale, scale);
    Figure reference = figure_reference();
    double usual = reference.end[part->role].y - reference.start[part->role].y;
    return vec(scale * body_breadth(t->body, part->frame.t.y + at * part->length), part->length / usual, scale);
}

static Vec3 by_axis(Vec3 a, Vec3 b) { return vec(a.x * b.x, a.y * b.y, a.z * b.z); }

/* Sizes a ring to the body: t->measure, t->ring, and fit->ring for the envelope. */
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
        least = s.side + LEG_ROOM * scale;
        x = vec(1, 0, 0);
        z = vec(0, 0, 1);
    }
    if (ring->has_size) {
        s.side = fmax(ring->side * measure.x, least);
        s.front = ring->front * measure.z;
        s.back = ring->back * measure.z;
    }
    if (s.side + ease <= 0 || s.front + ease <= 0 || s.back + ease <= 0)
        return error_set(e, ERR_INPUT, "garment '%s': ring '%s' has no size left: 'ease %g' is more than its '%s' has",
                         t->g->name, ring->name, ring->ease, role_name(ring->part));
    Mat3 tilt = mat_axis_angle(vec(0, 0, 1), ring->tilt * PI / 180);
    RingFrame *f = &t->ring[r];
    f->centre = vec_add(centre, by_axis(ring->shift, measure));
    f->side = vec_scale(mat_apply(tilt, x), s.side + ease);
    f->side.y *= measure.y / measure.x; /* side was scaled as a breadth; what a tilt makes of it upwards is a length */
    f->front = vec_scale(mat_apply(tilt, z), s.front + ease);
    f->back = vec_scale(mat_apply(tilt, z), s.back + ease);
    t->fit->ring[r] = (FitRing){f->centre.y, s.side + ease, s.front + ease, s.back + ease, f->centre.z};
    return true;
}

/* A station on the unit circle: x to the left, z to the front. */
static void station_unit(Station s, double out[2]) {
    out[0] = s == STATION_LEFT ? 1 : s == STATION_RIGHT ? -1 : 0;
    out[1] = s == STATION_FRONT ? 1 : s == STATION_BACK ? -1 : 0;
}

/* A point of the unit circle as a vector of the ring: front and back have their own depths. */
static Vec3 ring_vector(const RingFrame *f, double x, double z) {
    return vec_mad(vec_scale(f->side, x), z > 0 ? f->front : f->back, z);
}

/* Where a station is in the canonical stance. */
static Vec3 station_rest(const Tailor *t, int r, Station s) {
    double unit[2];
    station_unit(s, unit);
    Vec3 p = vec_add(t->ring[r].centre, ring_vector(&t->ring[r], unit[0], unit[1]));
    return vec_add(p, by_axis(t->g->ring[r].move[s], t->measure[r]));
}

/* The bones that a station follows without a `bind`: the part that the ring is on. But cloth on the pelvis lies in the
   fold of a hip only if it goes partly with the thigh, the more the lower it is. */
static Binding own_binding(const Ring *ring, Station s) {
    static const double WITH_THIGHS = 0.6; /* share at the pelvis's lower end; none at its upper end */
    double share = ring->part == ROLE_PELVIS ? WITH_THIGHS * clamp(1 - ring->at, 0, 1) : 0;
    if (share <= 0) return (Binding){.n = 1, .bone = {ring->part}, .weight = {1}};
    if (s == STATION_LEFT) return (Binding){2, {ROLE_PELVIS, ROLE_LEFT_THIGH}, {1 - share, share}};
    if (s == STATION_RIGHT) return (Binding){2, {ROLE_PELVIS, ROLE_RIGHT_THIGH}, {1 - share, share}};
    return (Binding){3, {ROLE_PELVIS, ROLE_LEFT_THIGH, ROLE_RIGHT_THIGH}, {1 - share, share / 2, share / 2}};
}

static Binding binding_or_own(const Ring *ring, Station s) {
    return ring->binding[s].n > 0 ? ring->binding[s] : own_binding(ring, s);
}

/* Mean of two bindings. If it names more than BINDING_MAX bones, those with the largest weights stay. */
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

/* Makes one node of two, in their middle. */
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

bool fit_rings(Tailor *t, Error *e) {
    for (int r = 0; r < t->g->nrings; r++)
        if (!place_ring(t, r, e)) return false;
    return make_nodes(t, e);
}

/* The curve of a row. At `from` its tangent points to the direction of the station `via`, at `to` it comes from
   there; a quarter, which has no via, leaves in the direction of `to` and arrives from that of `from`. */
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

int fit_curve(Tailor *t, const Row *row) {
    FitCurve made;
    make_curve(t, row, &made);
    Fit *f = t->fit;
    for (int i = 0; i < f->ncurves; i++)
        if (f->curve[i].ring == made.ring && memcmp(f->curve[i].unit, made.unit, sizeof made.unit) == 0) return i;
    f->curve[f->ncurves] = made;
    return f->ncurves++;
}

/* What turns the handles of half arcs at their ends: the mean of the middle stations of all arcs of the ring that meet
   there. */
void fit_turns(Fit *f) {
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
