/* A garment as text again, every statement under those it names. Numbers get the fewest digits
   that read back as the same double, so that a file made by hand keeps its numbers and a file
   made here is stable. Mirrors were expanded by the parser. */
#include "garment/garment.h"

static void put_number(FILE *out, double x) {
    char text[TEXT_SHORTEST];
    fprintf(out, " %s", text_shortest(x, text));
}

static void put_vector(FILE *out, Vec3 v) {
    put_number(out, v.x);
    put_number(out, v.y);
    put_number(out, v.z);
}

static void put_binding(FILE *out, const Binding *b) {
    for (int i = 0; i < b->n; i++) {
        fprintf(out, " %s", role_name(b->bone[i]));
        put_number(out, b->weight[i]);
    }
    fputc('\n', out);
}

static bool is_equal(const Binding *a, const Binding *b) {
    for (int i = 0; i < a->n; i++)
        if (a->bone[i] != b->bone[i] || a->weight[i] != b->weight[i]) return false;
    return a->n == b->n;
}

static void put_bindings(FILE *out, const Ring *r) {
    bool all = true;
    for (int s = 1; s < STATION_COUNT; s++) all = all && is_equal(&r->binding[0], &r->binding[s]);
    for (int s = 0; s < (all ? 1 : STATION_COUNT); s++) {
        if (!r->binding[s].n) continue;
        if (all) fprintf(out, "bind %s", r->name);
        else fprintf(out, "bind %s.%s", r->name, station_name((Station)s));
        put_binding(out, &r->binding[s]);
    }
}

static void put_ring(FILE *out, const Ring *r) {
    fprintf(out, "ring %s %s", r->name, role_name(r->part));
    put_number(out, r->at);
    if (r->ease != 0) {
        fputs(" ease", out);
        put_number(out, r->ease);
    }
    if (r->has_size) {
        fputs(" size", out);
        put_vector(out, vec(r->side, r->front, r->back));
    }
    if (r->shift.x != 0 || r->shift.y != 0 || r->shift.z != 0) {
        fputs(" shift", out);
        put_vector(out, r->shift);
    }
    if (r->tilt != 0) {
        fputs(" tilt", out);
        put_number(out, r->tilt);
    }
    fputc('\n', out);
    for (int s = 0; s < STATION_COUNT; s++) {
        if (r->move[s].x == 0 && r->move[s].y == 0 && r->move[s].z == 0) continue;
        fprintf(out, "move %s.%s", r->name, station_name((Station)s));
        put_vector(out, r->move[s]);
        fputc('\n', out);
    }
    put_bindings(out, r);
}

static void put_panel(FILE *out, const Garment *g, const Panel *p) {
    fprintf(out, "panel %s\n", p->name);
    for (int i = 0; i < p->nrows; i++) {
        const Row *row = &p->row[i];
        fprintf(out, "  row %s %s", g->ring[row->ring].name, station_name(row->from));
        if (row->via != STATION_NONE) fprintf(out, " %s", station_name(row->via));
        fprintf(out, " %s\n", station_name(row->to));
    }
}

static void put_patch(FILE *out, const RawPatch *p) {
    fprintf(out, "patch %s\n", p->name);
    for (int k = 0; k < 16; k++) {
        fputc(' ', out);
        put_vector(out, p->point[k]);
        fputc(' ', out);
        put_binding(out, &p->binding[k]);
    }
}

static void put_seam(FILE *out, const Garment *g, const Seam *s) {
    fprintf(out, "seam %s.%s %s.%s%s\n", garment_piece_name(g, s->piece_a), side_name(s->side_a),
            garment_piece_name(g, s->piece_b), side_name(s->side_b), s->crease ? " crease" : "");
}

static void put_pin(FILE *out, const Garment *g, const Pin *p) {
    if (p->ring >= 0) fprintf(out, "pin %s\n", g->ring[p->ring].name);
    else fprintf(out, "pin %s.%s\n", garment_piece_name(g, p->piece), side_name(p->side));
}

static void put_collide(FILE *out, const Garment *g, const Collide *c) {
    if (c->from_ring >= 0) fprintf(out, "collide %s..%s", g->ring[c->from_ring].name, g->ring[c->to_ring].name);
    else fprintf(out, "collide %s", garment_piece_name(g, c->piece));
    for (Role r = 0; r < ROLE_COUNT; r++)
        if (c->parts & 1u << r) fprintf(out, " %s", role_name(r));
    fputc('\n', out);
}

bool garment_write(const Garment *g, FILE *out) {
    fprintf(out, "garment %s\nfollow %s\nfit %s\n", g->name, g->follow == FOLLOW_ENVELOPE ? "envelope" : "bones",
            g->loose ? "loose" : "tight");
    if (g->detail) fprintf(out, "detail %d\n", g->detail);
    for (int i = 0; i < g->nrings; i++) put_ring(out, &g->ring[i]);
    for (int i = 0; i < g->njoins; i++) {
        const Join *j = &g->join[i];
        fprintf(out, "join %s.%s %s.%s\n", g->ring[j->ring_a].name, station_name(j->station_a), g->ring[j->ring_b].name,
                station_name(j->station_b));
    }
    for (int i = 0; i < g->npanels; i++) put_panel(out, g, &g->panel[i]);
    for (int i = 0; i < g->npatches; i++) put_patch(out, &g->patch[i]);
    for (int i = 0; i < g->nseams; i++) put_seam(out, g, &g->seam[i]);
    for (int i = 0; i < g->npins; i++) put_pin(out, g, &g->pin[i]);
    for (int i = 0; i < g->ncollides; i++) put_collide(out, g, &g->collide[i]);
    return !ferror(out);
}
