/* The meaning of a garment: sides that are sewn must be one curve before the sewing, patches
   have an area, and what is pinned or collides exists. Panels are compared by the stations they
   use, since where those lie depends on the body; raw patches by their points. */
#include "garment/check.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "geometry/bezier.h"

static const double MEET = 1e-6;        /* metres: what "%.6f" can tell apart */
static const double SAME_WEIGHT = 1e-9; /* weights are normalised after reading */
static const double FOLD = 5;           /* degrees across a seam that is no crease */
static const double NO_AREA = 1e-8;     /* square metres: a hundredth of a square millimetre */

bool refuse(Why *why, const char *fmt, ...) {
    va_list args;
    va_start(args, fmt);
    vsnprintf(why->text, sizeof why->text, fmt, args);
    va_end(args);
    return false;
}

bool check_name(const char *name, Why *why) {
    static const char *const taken[] = {"body", "garment", "follow", "fit",   "detail", "ring", "bind",    "move",
                                        "join", "panel",   "row",    "patch", "seam",   "pin",  "collide", "mirror"};
    for (size_t i = 0; i < sizeof taken / sizeof *taken; i++)
        if (strcmp(name, taken[i]) == 0) return refuse(why, "'%s' is a reserved word and cannot be a name", name);
    if (name[0] == '.' || name[0] == '-') return refuse(why, "name '%s' begins with '%c'", name, name[0]);
    for (const char *c = name; *c; c++) {
        if ((unsigned char)*c < 32 || *c == 127) return refuse(why, "control character in the name '%s'", name);
        if (strchr("/\\:*?\"<>|,", *c))
            return refuse(why, "'%c' in the name '%s': not every file name can have it", *c, name);
    }
    return true;
}

static bool neighbours(Station a, Station b) { return (b - a) % 2 != 0; }

bool check_row(const Garment *g, const Panel *panel, const Row *row, Why *why) {
    const char *from = station_name(row->from), *to = station_name(row->to);
    for (int i = 0; i < panel->nrows; i++)
        if (panel->row[i].ring == row->ring)
            return refuse(why, "panel '%s' has a row on the ring '%s' already", panel->name, g->ring[row->ring].name);
    if (row->via == STATION_NONE)
        return neighbours(row->from, row->to) ||
               refuse(why, "'%s' and '%s' are not neighbours: no quarter arc", from, to);
    if (row->from != row->to && neighbours(row->from, row->via) && neighbours(row->via, row->to)) return true;
    return refuse(why, "'%s %s %s' is no half arc: it goes from one station over its neighbour to the opposite one",
                  from, station_name(row->via), to);
}

/* Area of the surface, roughly: the mean of |du x dw| over a grid. Zero for a patch that is
   folded into a point or a curve, however its control points lie. */
bool check_area(const RawPatch *patch, Why *why) {
    enum { GRID = 8 };
    Patch surface;
    double area = 0;
    for (int k = 0; k < 16; k++) surface.p[k / 4][k % 4] = patch->point[k];
    for (int k = 0; k < GRID * GRID; k++) {
        Vec3 du, dw;
        bezier_point(&surface, (k / GRID + 0.5) / GRID, (k % GRID + 0.5) / GRID, &du, &dw);
        area += vec_len(vec_cross(du, dw)) / (GRID * GRID);
    }
    return area > NO_AREA || refuse(why, "patch '%s' is degenerate: its 16 points span no area", patch->name);
}

/* A side of a panel, step by step: a station of each row for start and end, the up to three stations of an arc for top
   and bottom. */
typedef struct {
    int n;
    int ring[GARMENT_ROWS_MAX];
    Station station[GARMENT_ROWS_MAX];
} StationList;

/* The two stations of a join count as one: the first of them stands for both. */
static void add_station(const Garment *g, StationList *list, int ring, Station station) {
    for (int i = 0; i < g->njoins; i++)
        if (g->join[i].ring_b == ring && g->join[i].station_b == station) {
            ring = g->join[i].ring_a;
            station = g->join[i].station_a;
            break;
        }
    list->ring[list->n] = ring;
    list->station[list->n++] = station;
}

static StationList side_of_panel(const Garment *g, const Panel *panel, Side side) {
    StationList list = {0};
    if (side == SIDE_START || side == SIDE_END) {
        for (int i = 0; i < panel->nrows; i++)
            add_station(g, &list, panel->row[i].ring, side == SIDE_START ? panel->row[i].from : panel->row[i].to);
    } else {
        const Row *row = &panel->row[side == SIDE_TOP ? 0 : panel->nrows - 1];
        add_station(g, &list, row->ring, row->from);
        if (row->via != STATION_NONE) add_station(g, &list, row->ring, row->via);
        add_station(g, &list, row->ring, row->to);
    }
    return list;
}

/* Finds where the sides of two panels part, -1 if nowhere. */
static int panels_part(const StationList *a, const StationList *b, bool backwards) {
    for (int i = 0; i < a->n; i++) {
        int k = backwards ? a->n - 1 - i : i;
        if (a->ring[i] != b->ring[k] || a->station[i] != b->station[k]) return i;
    }
    return -1;
}

static bool panels_meet(const Garment *g, const Seam *s, Why *why) {
    StationList a = side_of_panel(g, &g->panel[s->piece_a], s->side_a);
    StationList b = side_of_panel(g, &g->panel[s->piece_b], s->side_b);
    if (a.n != b.n) return refuse(why, "the seam does not meet: the sides have %d and %d stations", a.n, b.n);
    int i = panels_part(&a, &b, false);
    if (i < 0 || panels_part(&a, &b, true) < 0) return true;
    return refuse(why, "the seam does not meet: '%s.%s' against '%s.%s'", g->ring[a.ring[i]].name,
                  station_name(a.station[i]), g->ring[b.ring[i]].name, station_name(b.station[i]));
}

static double weight_of(const Binding *binding, Role bone) {
    for (int i = 0; i < binding->n; i++)
        if (binding->bone[i] == bone) return binding->weight[i];
    return 0;
}

/* Weights sum to 1, so nothing is left for a bone that only b has. */
static bool same_binding(const Binding *a, const Binding *b) {
    for (int i = 0; i < a->n; i++)
        if (!(fabs(a->weight[i] - weight_of(b, a->bone[i])) <= SAME_WEIGHT)) return false;
    return true;
}

/* Where the surface goes from a side of a patch, at s along it in the direction of growing u or w. */
static Vec3 inwards(const RawPatch *patch, Side side, double s, Vec3 *along) {
    Patch surface;
    Vec3 du, dw;
    for (int k = 0; k < 16; k++) surface.p[k / 4][k % 4] = patch->point[k];
    bool upright = side == SIDE_START || side == SIDE_END, far = side == SIDE_END || side == SIDE_BOTTOM;
    bezier_point(&surface, upright ? far : s, upright ? s : far, &du, &dw);
    *along = upright ? dw : du;
    return vec_scale(upright ? du : dw, far ? -1 : 1);
}

/* The largest angle by which the surface is folded along a seam, degrees. Where a patch has no
   direction (a pole) nothing can be said. */
static double seam_fold(const RawPatch *a, Side side_a, const RawPatch *b, Side side_b, bool reversed) {
    enum { PLACES = 16 };
    double fold = 0;
    for (int k = 0; k <= PLACES; k++) {
        double s = (double)k / PLACES;
        Vec3 along, other, into_a = inwards(a, side_a, s, &along);
        Vec3 into_b = inwards(b, side_b, reversed ? 1 - s : s, &other);
        along = vec_unit_or(along, vec(0, 0, 0));
        into_a = vec_mad(into_a, along, -vec_dot(into_a, along));
        into_b = vec_mad(into_b, along, -vec_dot(into_b, along));
        double sizes = vec_len(into_a) * vec_len(into_b);
        if (sizes > 0) fold = fmax(fold, acos(clamp(-vec_dot(into_a, into_b) / sizes, -1, 1)) * 180 / PI);
    }
    return fold;
}

static bool patches_meet(const Garment *g, const Seam *s, Why *why) {
    const RawPatch *a = &g->patch[s->piece_a - g->npanels], *b = &g->patch[s->piece_b - g->npanels];
    double apart[2] = {0, 0};
    bool same_bones[2] = {true, true};
    for (int i = 0; i < 4; i++) {
        int k = side_point(s->side_a, i);
        for (int way = 0; way < 2; way++) {
            int other = side_point(s->side_b, way ? 3 - i : i);
            double d = vec_dist(a->point[k], b->point[other]);
            if (d > apart[way]) apart[way] = d;
            if (!same_binding(&a->binding[k], &b->binding[other])) same_bones[way] = false;
        }
    }
    int way = apart[1] < apart[0];
    if (apart[way] > MEET) return refuse(why, "the seam does not meet: its sides are up to %.3g m apart", apart[way]);
    if (!same_bones[way]) return refuse(why, "the seam does not meet: its sides follow different bones");
    double fold = s->crease ? 0 : seam_fold(a, s->side_a, b, s->side_b, way);
    return fold <= FOLD ||
           refuse(why, "the seam is folded by up to %.3g degrees: where that is meant, add 'crease'", fold);
}

bool check_seam(const Garment *g, const Seam *s, Why *why) {
    if (s->piece_a == s->piece_b && s->side_a == s->side_b) return refuse(why, "a side cannot be sewn to itself");
    for (int i = 0; i < g->nseams; i++) {
        const Seam *t = &g->seam[i];
        const struct {
            int piece;
            Side side;
        } old[2] = {{t->piece_a, t->side_a}, {t->piece_b, t->side_b}};
        for (int k = 0; k < 2; k++)
            if ((old[k].piece == s->piece_a && old[k].side == s->side_a) ||
                (old[k].piece == s->piece_b && old[k].side == s->side_b))
                return refuse(why, "'%s.%s' has a seam already", garment_piece_name(g, old[k].piece),
                              side_name(old[k].side));
    }
    bool raw_a = s->piece_a >= g->npanels, raw_b = s->piece_b >= g->npanels;
    if (raw_a != raw_b)
        return refuse(why, "a panel cannot be sewn to a raw patch: only the body decides where the panel lies");
    return raw_a ? patches_meet(g, s, why) : panels_meet(g, s, why);
}

bool check_join(const Garment *g, const Join *join, Why *why) {
    if (join->ring_a == join->ring_b) return refuse(why, "two stations of one ring cannot be joined");
    for (int i = 0; i < 2 * g->njoins; i++) {
        const Join *old = &g->join[i / 2];
        int ring = i % 2 ? old->ring_b : old->ring_a;
        Station station = i % 2 ? old->station_b : old->station_a;
        if ((ring == join->ring_a && station == join->station_a) ||
            (ring == join->ring_b && station == join->station_b))
            return refuse(why, "'%s.%s' is joined already", g->ring[ring].name, station_name(station));
    }
    return true;
}

static int find_row(const Panel *panel, int ring) {
    for (int i = 0; i < panel->nrows; i++)
        if (panel->row[i].ring == ring) return i;
    return -1;
}

bool check_collide(const Garment *g, const Collide *c, Why *why) {
    if (c->from_ring < 0) return true;
    for (int i = 0; i < g->npanels; i++) {
        int from = find_row(&g->panel[i], c->from_ring), to = find_row(&g->panel[i], c->to_ring);
        if (from >= 0 && to >= 0 && from != to) return true;
    }
    return refuse(why, "no panel above has patches from the ring '%s' to '%s'", g->ring[c->from_ring].name,
                  g->ring[c->to_ring].name);
}

bool check_pin(const Garment *g, const Pin *pin, Why *why) {
    if (pin->ring < 0) return true;
    for (int i = 0; i < g->npanels; i++)
        if (find_row(&g->panel[i], pin->ring) >= 0) return true;
    return refuse(why, "no panel above uses the ring '%s'", g->ring[pin->ring].name);
}

static bool torso_or_leg(Role part) {
    return part == ROLE_PELVIS || part == ROLE_SPINE || part == ROLE_CHEST || part == ROLE_LEFT_THIGH ||
           part == ROLE_LEFT_SHIN || part == ROLE_RIGHT_THIGH || part == ROLE_RIGHT_SHIN;
}

static double height_of(const Figure *figure, const Ring *ring) {
    double low = figure->start[ring->part].y, high = figure->end[ring->part].y;
    return low + (high - low) * ring->at + ring->shift.y;
}

bool check_envelope(const Garment *g, const Panel *panel, int *wrong, Why *why) {
    Figure figure = figure_reference();
    *wrong = -1;
    for (int i = 0; i < g->nrings; i++)
        if (i >= panel->nrows || panel->row[i].ring != i)
            return refuse(why, "row %d of the panel '%s' must be on the ring '%s': each panel of an envelope has all "
                          "rings, in their order", i + 1, panel->name, g->ring[i].name);
    for (int i = 0; i < panel->nrows; i++) {
        const Ring *ring = &g->ring[*wrong = panel->row[i].ring];
        if (!torso_or_leg(ring->part))
            return refuse(why, "the envelope holds torso and legs, not the ring '%s' on '%s'", ring->name,
                          role_name(ring->part));
        if (i > 0 && height_of(&figure, ring) >= height_of(&figure, &g->ring[panel->row[i - 1].ring]))
            return refuse(why, "ring '%s' must lie below '%s' in an envelope", ring->name,
                          g->ring[panel->row[i - 1].ring].name);
    }
    return true;
}
