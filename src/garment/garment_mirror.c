/* The other half of a symmetric garment. Everything that has a name with the first prefix is
   copied: the name gets the second prefix, left and right change places among parts and
   stations, x and the tilt change sign. What has no such name (a waist ring that both halves
   use) stays one thing. Also here: adding pieces, whose numbers depend on one another. */
#include "garment/mirror.h"

#include <stdio.h>
#include <string.h>

static void renumber(int *piece, int from) {
    if (*piece >= from) (*piece)++;
}

Panel *garment_add_panel(Garment *g, const char *name) {
    if (g->npanels == GARMENT_PANELS_MAX) return NULL;
    for (int i = 0; i < g->nseams; i++) {
        renumber(&g->seam[i].piece_a, g->npanels);
        renumber(&g->seam[i].piece_b, g->npanels);
    }
    for (int i = 0; i < g->npins; i++) renumber(&g->pin[i].piece, g->npanels);
    for (int i = 0; i < g->ncollides; i++) renumber(&g->collide[i].piece, g->npanels);
    Panel *panel = &g->panel[g->npanels++];
    snprintf(panel->name, sizeof panel->name, "%s", name);
    return panel;
}

RawPatch *garment_add_patch(Garment *g, const char *name) {
    if (g->npatches == GARMENT_PATCHES_MAX) return NULL;
    RawPatch *patch = &g->patch[g->npatches++];
    snprintf(patch->name, sizeof patch->name, "%s", name);
    return patch;
}

/* What was there before the mirror, and the two prefixes. */
typedef struct {
    Garment *g;
    const char *from, *to;
    int nrings, npanels, npatches, copies;
    Why *why;
} Mirror;

static bool has_prefix(const Mirror *m, const char *name) { return strncmp(name, m->from, strlen(m->from)) == 0; }

/* What a name with the first prefix is with the second; returns its length. */
static int image_name(const Mirror *m, const char *name, char *out, size_t size) {
    return snprintf(out, size, "%s%s", m->to, name + strlen(m->from));
}

/* The same, checked to be new. */
static bool other_name(Mirror *m, const char *name, char out[GARMENT_NAME_MAX]) {
    int n = image_name(m, name, out, GARMENT_NAME_MAX);
    if (n >= GARMENT_NAME_MAX)
        return refuse(m->why, "the mirrored name of '%s' is longer than %d bytes", name, GARMENT_NAME_MAX - 1);
    if (garment_find_ring(m->g, out) >= 0 || garment_find_piece(m->g, out) >= 0)
        return refuse(m->why, "the mirror image of '%s' has a name that is taken: '%s'", name, out);
    if (strchr(out, '.')) return refuse(m->why, "'.' in the mirrored name '%s'", out); /* RING.STATION is split there */
    return check_name(out, m->why);
}

static Station other_station(Station s) {
    return s == STATION_LEFT ? STATION_RIGHT : s == STATION_RIGHT ? STATION_LEFT : s;
}

/* 0 - x and not -x: zero stays +0. */
static Vec3 other_vector(Vec3 v) { return vec(0 - v.x, v.y, v.z); }

static Binding other_binding(Binding b) {
    for (int i = 0; i < b.n; i++) b.bone[i] = role_mirror(b.bone[i]);
    return b;
}

/* The number of the ring's image, or its own where it has none. */
static int other_ring(const Mirror *m, int ring) {
    char name[2 * GARMENT_NAME_MAX];
    if (ring < 0 || !has_prefix(m, m->g->ring[ring].name)) return ring;
    image_name(m, m->g->ring[ring].name, name, sizeof name);
    return garment_find_ring(m->g, name);
}

static int other_piece(const Mirror *m, int piece) {
    char name[2 * GARMENT_NAME_MAX];
    if (piece < 0 || !has_prefix(m, garment_piece_name(m->g, piece))) return piece;
    image_name(m, garment_piece_name(m->g, piece), name, sizeof name);
    return garment_find_piece(m->g, name);
}

static bool mirror_rings(Mirror *m) {
    Garment *g = m->g;
    for (int i = 0; i < m->nrings; i++) {
        Ring ring = g->ring[i];
        if (!has_prefix(m, ring.name)) continue;
        if (!other_name(m, g->ring[i].name, ring.name)) return false;
        if (g->nrings == GARMENT_RINGS_MAX) return refuse(m->why, "more than %d rings", GARMENT_RINGS_MAX);
        ring.part = role_mirror(ring.part);
        ring.shift = other_vector(ring.shift);
        ring.tilt = 0 - ring.tilt;
        for (int s = 0; s < STATION_COUNT; s++) {
            ring.move[s] = other_vector(g->ring[i].move[other_station(s)]);
            ring.binding[s] = other_binding(g->ring[i].binding[other_station(s)]);
        }
        g->ring[g->nrings++] = ring;
        m->copies++;
    }
    return true;
}

static bool mirror_panels(Mirror *m) {
    for (int i = 0; i < m->npanels; i++) {
        Panel image = m->g->panel[i];
        if (!has_prefix(m, image.name)) continue;
        if (!other_name(m, m->g->panel[i].name, image.name)) return false;
        for (int k = 0; k < image.nrows; k++) {
            Row *row = &image.row[k];
            *row = (Row){other_ring(m, row->ring), other_station(row->from), other_station(row->via),
                         other_station(row->to)};
        }
        Panel *panel = garment_add_panel(m->g, image.name);
        if (!panel) return refuse(m->why, "more than %d panels", GARMENT_PANELS_MAX);
        *panel = image;
        int ring;
        if (m->g->follow == FOLLOW_ENVELOPE && !check_envelope(m->g, panel, &ring, m->why)) return false;
        m->copies++;
    }
    return true;
}

static bool mirror_patches(Mirror *m) {
    for (int i = 0; i < m->npatches; i++) {
        RawPatch image = m->g->patch[i];
        if (!has_prefix(m, image.name)) continue;
        if (!other_name(m, m->g->patch[i].name, image.name)) return false;
        for (int k = 0; k < 16; k++) {
            image.point[k] = other_vector(image.point[k]);
            image.binding[k] = other_binding(image.binding[k]);
        }
        RawPatch *patch = garment_add_patch(m->g, image.name);
        if (!patch) return refuse(m->why, "more than %d raw patches", GARMENT_PATCHES_MAX);
        *patch = image;
        m->copies++;
    }
    return true;
}

static bool mirror_joins_and_seams(Mirror *m) {
    Garment *g = m->g;
    for (int i = 0, n = g->njoins; i < n; i++) {
        Join j = g->join[i];
        j.ring_a = other_ring(m, j.ring_a);
        j.ring_b = other_ring(m, j.ring_b);
        if (j.ring_a == g->join[i].ring_a && j.ring_b == g->join[i].ring_b) continue;
        if (g->njoins == GARMENT_JOINS_MAX) return refuse(m->why, "more than %d joins", GARMENT_JOINS_MAX);
        j.station_a = other_station(j.station_a);
        j.station_b = other_station(j.station_b);
        if (!check_join(g, &j, m->why)) return false;
        g->join[g->njoins++] = j;
    }
    for (int i = 0, n = g->nseams; i < n; i++) {
        Seam s = g->seam[i];
        s.piece_a = other_piece(m, s.piece_a);
        s.piece_b = other_piece(m, s.piece_b);
        if (s.piece_a == g->seam[i].piece_a && s.piece_b == g->seam[i].piece_b) continue;
        if (g->nseams == GARMENT_SEAMS_MAX) return refuse(m->why, "more than %d seams", GARMENT_SEAMS_MAX);
        if (!check_seam(g, &s, m->why)) return false;
        g->seam[g->nseams++] = s;
    }
    return true;
}

static unsigned other_parts(unsigned parts) {
    unsigned image = 0;
    for (Role r = 0; r < ROLE_COUNT; r++)
        if (parts & 1u << r) image |= 1u << role_mirror(r);
    return image;
}

static bool mirror_collides_and_pins(Mirror *m) {
    Garment *g = m->g;
    for (int i = 0, n = g->ncollides; i < n; i++) {
        const Collide *old = &g->collide[i];
        Collide c = {other_ring(m, old->from_ring), other_ring(m, old->to_ring), other_piece(m, old->piece),
                     other_parts(old->parts)};
        if (c.from_ring == old->from_ring && c.to_ring == old->to_ring && c.piece == old->piece) continue;
        if (g->ncollides == GARMENT_COLLIDES_MAX) return refuse(m->why, "more than %d collides", GARMENT_COLLIDES_MAX);
        if (!check_collide(g, &c, m->why)) return false;
        g->collide[g->ncollides++] = c;
    }
    for (int i = 0, n = g->npins; i < n; i++) {
        const Pin *old = &g->pin[i];
        Pin pin = {other_ring(m, old->ring), other_piece(m, old->piece), old->side};
        if (pin.ring == old->ring && pin.piece == old->piece) continue;
        if (g->npins == GARMENT_PINS_MAX) return refuse(m->why, "more than %d pins", GARMENT_PINS_MAX);
        if (!check_pin(g, &pin, m->why)) return false;
        g->pin[g->npins++] = pin;
    }
    return true;
}

bool garment_mirror(Garment *g, const char *from, const char *to, Why *why) {
    Mirror m = {g, from, to, g->nrings, g->npanels, g->npatches, 0, why};
    if (!mirror_rings(&m) || !mirror_panels(&m) || !mirror_patches(&m)) return false;
    if (!m.copies) return refuse(why, "nothing above has a name that begins with '%s'", from);
    return mirror_joins_and_seams(&m) && mirror_collides_and_pins(&m);
}
