/* The statements of a garment file, one line each. There is one pass and one rule: a statement
   can only name what stands above it. So every mistake is found at the line that makes it, and
   has the place of the word. A table lists the statements with what they expect. */
#include "garment/garment.h"

#include <math.h>
#include <string.h>

#include "garment/check.h"

static const char NO_TITLE[] = "not a garment file: it must begin with 'garment NAME'";
static const double LENGTH_MAX = 100;  /* metres; nothing worn is longer */
static const double SUM_IS_ONE = 1e-9; /* weights with such a sum stay as they are, so writing and reading is stable */

/* What the parser knows beside the garment: the piece that is open and what was said already. */
typedef struct {
    Garment *g;
    Panel *panel;       /* rows belong to it */
    RawPatch *patch;    /* points belong to it */
    int npoints;
    Line opening;       /* the line of the open piece */
    Line title;         /* the line `garment NAME` */
    bool has_title, has_follow, has_fit;
    bool moved[GARMENT_RINGS_MAX][STATION_COUNT];
    int bound[GARMENT_RINGS_MAX][STATION_COUNT]; /* 1: with its ring, 2: by itself */
} Parser;

/* The best of the candidates for a word that is none of them. */
typedef struct { const char *word, *best; int distance; } Nearest;

static void nearest_try(Nearest *n, const char *candidate) {
    int d = text_distance(n->word, candidate), most = (int)strlen(n->word) / 3 + 1;
    if (d <= most && (!n->best || d < n->distance)) {
        n->best = candidate;
        n->distance = d;
    }
}

static bool unknown(const Line *line, int i, Error *e, const char *what, const Nearest *n) {
    if (n->best) return text_error(line, i, e, "unknown %s '%s' (did you mean '%s'?)", what, n->word, n->best);
    return text_error(line, i, e, "unknown %s '%s'", what, n->word);
}

/* One of the words of a list; its number, or -1 with an error. */
static int choose(const Line *line, int i, const char *what, const char *const *words, int n, Error *e) {
    char word[GARMENT_NAME_MAX];
    if (!text_word(line, i, word, sizeof word, e)) return -1;
    Nearest near = {word, NULL, 0};
    for (int k = 0; k < n; k++) {
        if (strcmp(word, words[k]) == 0) return k;
        nearest_try(&near, words[k]);
    }
    unknown(line, i, e, what, &near);
    return -1;
}

static bool read_part(const Line *line, int i, Role *out, Error *e) {
    char word[GARMENT_NAME_MAX];
    if (!text_word(line, i, word, sizeof word, e)) return false;
    *out = role_find(word, (int)strlen(word));
    if (*out < ROLE_COUNT) return true;
    Nearest near = {word, NULL, 0};
    for (Role r = 0; r < ROLE_COUNT; r++) nearest_try(&near, role_name(r));
    return unknown(line, i, e, "body part", &near);
}

static bool find_ring(const Garment *g, const char *name, const Line *line, int i, int *out, Error *e) {
    *out = garment_find_ring(g, name);
    if (*out >= 0) return true;
    Nearest near = {name, NULL, 0};
    for (int k = 0; k < g->nrings; k++) nearest_try(&near, g->ring[k].name);
    return unknown(line, i, e, "ring", &near);
}

static bool find_piece(const Garment *g, const char *name, const Line *line, int i, int *out, Error *e) {
    *out = garment_find_piece(g, name);
    if (*out >= 0) return true;
    Nearest near = {name, NULL, 0};
    for (int k = 0; k < g->npanels + g->npatches; k++) nearest_try(&near, garment_piece_name(g, k));
    return unknown(line, i, e, "panel or patch", &near);
}

static bool read_station(const Line *line, int i, Station *out, Error *e) {
    static const char *const words[] = {"left", "front", "right", "back"};
    int k = choose(line, i, "station", words, STATION_COUNT, e);
    *out = (Station)k;
    return k >= 0;
}

/* Cuts word i at its dot: NAME.REST, both not empty. */
static bool split_word(const Line *line, int i, const char *expected, char name[GARMENT_NAME_MAX], Line *rest, Error *e) {
    const char *word = line->word[i], *dot = i < line->count ? memchr(word, '.', (size_t)line->length[i]) : NULL;
    if (!dot || dot == word || dot + 1 == word + line->length[i]) {
        int n = i < line->count ? line->length[i] : 0;
        return text_error(line, i, e, "expected %s, found '%.*s'", expected, n > 40 ? 40 : n, n ? word : "");
    }
    Line whole = *line;
    whole.length[i] = (int)(dot - word);
    *rest = *line;
    rest->word[i] = dot + 1;
    rest->length[i] = (int)(word + line->length[i] - (dot + 1));
    return text_word(&whole, i, name, GARMENT_NAME_MAX, e);
}

static bool read_ring_station(const Garment *g, const Line *line, int i, int *ring, Station *station, Error *e) {
    char name[GARMENT_NAME_MAX];
    Line rest;
    return split_word(line, i, "RING.STATION", name, &rest, e) && find_ring(g, name, line, i, ring, e) &&
           read_station(&rest, i, station, e);
}

static bool read_piece_side(const Garment *g, const Line *line, int i, int *piece, Side *side, Error *e) {
    static const char *const words[] = {"start", "end", "top", "bottom"};
    char name[GARMENT_NAME_MAX];
    Line rest;
    if (!split_word(line, i, "PIECE.SIDE", name, &rest, e) || !find_piece(g, name, line, i, piece, e)) return false;
    int k = choose(&rest, i, "side", words, 4, e);
    *side = (Side)k;
    return k >= 0;
}

/* A finite number in [low, high]; never -0. */
static bool read_number(const Line *line, int i, double low, double high, double *out, Error *e) {
    if (!text_real(line, i, out, e)) return false;
    *out += 0.0;
    return (*out >= low && *out <= high) || text_error(line, i, e, "expected a number from %g to %g", low, high);
}

static bool read_length(const Line *line, int i, double *out, Error *e) { return read_number(line, i, -LENGTH_MAX, LENGTH_MAX, out, e); }

static bool read_vector(const Line *line, int i, Vec3 *out, Error *e) {
    return read_length(line, i, &out->x, e) && read_length(line, i + 1, &out->y, e) && read_length(line, i + 2, &out->z, e);
}

/* PART WEIGHT pairs from word i to the end of the line, made to sum to 1. */
static bool read_binding(const Line *line, int i, Binding *out, Error *e) {
    *out = (Binding){0};
    double sum = 0;
    if (i >= line->count) return text_error(line, i, e, "expected a body part and its weight, found the end of the line");
    for (; i < line->count; i += 2) {
        if (out->n == BINDING_MAX) return text_error(line, i, e, "more than %d body parts for one point", BINDING_MAX);
        Role *bone = &out->bone[out->n];
        double *weight = &out->weight[out->n];
        if (!read_part(line, i, bone, e) || !text_real(line, i + 1, weight, e)) return false;
        for (int k = 0; k < out->n; k++)
            if (out->bone[k] == *bone) return text_error(line, i, e, "'%s' is named twice", role_name(*bone));
        if (!(*weight >= 1e-6 && *weight <= 1e6)) return text_error(line, i + 1, e, "a weight must be positive, from 1e-6 to 1e6");
        sum += *weight;
        out->n++;
    }
    for (int k = 0; fabs(sum - 1) > SUM_IS_ONE && k < out->n; k++) out->weight[k] /= sum;
    return true;
}

/* A new name: of a ring, panel or patch. All share one name space, so `pin hem` has one meaning. */
static bool read_new_name(const Garment *g, const Line *line, char name[GARMENT_NAME_MAX], Error *e) {
    Why why;
    if (!text_word(line, 1, name, GARMENT_NAME_MAX, e)) return false;
    if (strchr(name, '.')) return text_error(line, 1, e, "'.' in the name '%s'", name);
    if (!check_name(name, &why)) return text_error(line, 1, e, "%s", why.text);
    if (garment_find_ring(g, name) >= 0) return text_error(line, 1, e, "there is a ring '%s' already", name);
    int piece = garment_find_piece(g, name);
    if (piece >= 0) return text_error(line, 1, e, "there is a %s '%s' already", piece < g->npanels ? "panel" : "patch", name);
    return true;
}

static bool is_body(const char *name) { /* BODY.0001.obj is body.0001.obj on some systems */
    static const char body[] = "body";
    if (strlen(name) != sizeof body - 1) return false;
    for (int i = 0; body[i]; i++)
        if ((name[i] | 0x20) != body[i]) return false;
    return true;
}

static bool read_title(Parser *p, const Line *line, Error *e) {
    char *name = p->g->name;
    Why why;
    if (!text_word(line, 1, name, GARMENT_NAME_MAX, e)) return false;
    if (!check_name(name, &why)) return text_error(line, 1, e, "%s", why.text);
    if (is_body(name)) return text_error(line, 1, e, "a garment cannot be called '%s': the body's files are", name);
    p->has_title = true;
    p->title = *line;
    return true;
}

static bool read_follow(Parser *p, const Line *line, Error *e) {
    static const char *const words[] = {"bones", "envelope"};
    if (p->has_follow) return text_error(line, 0, e, "'follow' is given twice");
    if (p->g->npanels + p->g->npatches) return text_error(line, 0, e, "'follow' must stand above the first panel or patch");
    int k = choose(line, 1, "way to follow", words, 2, e);
    p->g->follow = (Follow)k;
    p->has_follow = true;
    return k >= 0;
}

static bool read_fit(Parser *p, const Line *line, Error *e) {
    static const char *const words[] = {"tight", "loose"};
    if (p->has_fit) return text_error(line, 0, e, "'fit' is given twice");
    int k = choose(line, 1, "fit", words, 2, e);
    p->g->loose = k == 1;
    p->has_fit = true;
    return k >= 0;
}

static bool read_detail(Parser *p, const Line *line, Error *e) {
    if (p->g->detail) return text_error(line, 0, e, "'detail' is given twice");
    return text_int(line, 1, 1, GARMENT_DETAIL_MAX, &p->g->detail, e);
}

enum { OPTION_EASE, OPTION_SIZE, OPTION_SHIFT, OPTION_TILT, OPTION_COUNT };

static bool read_ring_option(Ring *ring, int option, const Line *line, int i, Error *e) {
    switch (option) {
    case OPTION_EASE: return read_length(line, i, &ring->ease, e);
    case OPTION_SHIFT: return read_vector(line, i, &ring->shift, e);
    case OPTION_TILT: return read_number(line, i, -180, 180, &ring->tilt, e);
    default:
        ring->has_size = true;
        return read_number(line, i, 0, LENGTH_MAX, &ring->side, e) && read_number(line, i + 1, 0, LENGTH_MAX, &ring->front, e) &&
               read_number(line, i + 2, 0, LENGTH_MAX, &ring->back, e);
    }
}

static bool read_ring(Parser *p, const Line *line, Error *e) {
    static const char *const words[OPTION_COUNT] = {"ease", "size", "shift", "tilt"};
    static const int numbers[OPTION_COUNT] = {1, 3, 3, 1};
    Garment *g = p->g;
    bool given[OPTION_COUNT] = {false};
    if (g->nrings == GARMENT_RINGS_MAX) return text_error(line, 0, e, "more than %d rings", GARMENT_RINGS_MAX);
    if (g->follow == FOLLOW_ENVELOPE && g->npanels) return text_error(line, 0, e, "the rings of an envelope must stand above its panels");
    Ring *ring = &g->ring[g->nrings];
    memset(ring, 0, sizeof *ring);
    if (!read_new_name(g, line, ring->name, e) || !read_part(line, 2, &ring->part, e) ||
        !read_number(line, 3, -LENGTH_MAX, LENGTH_MAX, &ring->at, e))
        return false;
    for (int i = 4, k; i < line->count; i += 1 + numbers[k]) {
        k = choose(line, i, "property of a ring", words, OPTION_COUNT, e);
        if (k < 0) return false;
        if (given[k]) return text_error(line, i, e, "'%s' is given twice", words[k]);
        given[k] = true;
        if (!read_ring_option(ring, k, line, i + 1, e)) return false;
    }
    if (ring->has_size && (ring->side + ring->ease <= 0 || ring->front + ring->ease <= 0 || ring->back + ring->ease <= 0))
        return text_error(line, 1, e, "the ring '%s' has no size left: sizes and ease must sum to more than 0", ring->name);
    g->nrings++;
    return true;
}

static bool read_bind(Parser *p, const Line *line, Error *e) {
    Garment *g = p->g;
    Binding binding;
    int ring, first = 0, last = STATION_COUNT - 1, level = 1;
    if (memchr(line->word[1], '.', (size_t)line->length[1])) {
        Station station;
        if (!read_ring_station(g, line, 1, &ring, &station, e)) return false;
        first = last = station;
        level = 2;
    } else {
        char name[GARMENT_NAME_MAX];
        if (!text_word(line, 1, name, sizeof name, e) || !find_ring(g, name, line, 1, &ring, e)) return false;
    }
    if (!read_binding(line, 2, &binding, e)) return false;
    for (int s = first; s <= last; s++) {
        if (p->bound[ring][s] >= level) return text_error(line, 1, e, "'%s.%s' is bound already", g->ring[ring].name, station_name((Station)s));
        p->bound[ring][s] = level;
        g->ring[ring].binding[s] = binding;
    }
    return true;
}

static bool read_move(Parser *p, const Line *line, Error *e) {
    int ring;
    Station station;
    if (!read_ring_station(p->g, line, 1, &ring, &station, e)) return false;
    if (p->moved[ring][station]) return text_error(line, 1, e, "'%s.%s' is moved already", p->g->ring[ring].name, station_name(station));
    p->moved[ring][station] = true;
    return read_vector(line, 2, &p->g->ring[ring].move[station], e);
}

static bool read_join(Parser *p, const Line *line, Error *e) {
    Garment *g = p->g;
    Join j;
    Why why;
    if (g->njoins == GARMENT_JOINS_MAX) return text_error(line, 0, e, "more than %d joins", GARMENT_JOINS_MAX);
    if (!read_ring_station(g, line, 1, &j.ring_a, &j.station_a, e) || !read_ring_station(g, line, 2, &j.ring_b, &j.station_b, e))
        return false;
    if (!check_join(g, &j, &why)) return text_error(line, 1, e, "%s", why.text);
    g->join[g->njoins++] = j;
    return true;
}

static bool read_panel(Parser *p, const Line *line, Error *e) {
    char name[GARMENT_NAME_MAX];
    if (!read_new_name(p->g, line, name, e)) return false;
    p->panel = garment_add_panel(p->g, name);
    p->opening = *line;
    return p->panel || text_error(line, 0, e, "more than %d panels", GARMENT_PANELS_MAX);
}

static bool read_row(Parser *p, const Line *line, Error *e) {
    char name[GARMENT_NAME_MAX];
    Why why;
    if (!p->panel) return text_error(line, 0, e, "'row' outside a panel: rows follow their 'panel NAME'");
    if (p->panel->nrows == GARMENT_ROWS_MAX) return text_error(line, 0, e, "more than %d rows in the panel '%s'", GARMENT_ROWS_MAX, p->panel->name);
    Row *row = &p->panel->row[p->panel->nrows];
    if (!text_word(line, 1, name, sizeof name, e) || !find_ring(p->g, name, line, 1, &row->ring, e)) return false;
    row->via = STATION_NONE;
    if (!read_station(line, 2, &row->from, e) || !read_station(line, line->count - 1, &row->to, e)) return false;
    if (line->count == 5 && !read_station(line, 3, &row->via, e)) return false;
    if (!check_row(p->g, p->panel, row, &why)) return text_error(line, 1, e, "%s", why.text);
    p->panel->nrows++;
    return true;
}

static bool read_patch(Parser *p, const Line *line, Error *e) {
    char name[GARMENT_NAME_MAX];
    if (!read_new_name(p->g, line, name, e)) return false;
    if (p->g->follow == FOLLOW_ENVELOPE) return text_error(line, 0, e, "a raw patch has no rings to follow the envelope: use 'follow bones'");
    p->patch = garment_add_patch(p->g, name);
    p->npoints = 0;
    p->opening = *line;
    return p->patch || text_error(line, 0, e, "more than %d raw patches", GARMENT_PATCHES_MAX);
}

static bool is_number(const Line *line) { return line->word[0][0] && strchr("0123456789.+-", line->word[0][0]); }

/* A line of the open raw patch: x y z PART WEIGHT ... */
static bool read_point(Parser *p, const Line *line, Error *e) {
    if (!is_number(line))
        return text_error(line, 0, e, "expected point %d of the 16 of the patch '%s': x y z PART WEIGHT ...", p->npoints + 1, p->patch->name);
    if (!read_vector(line, 0, &p->patch->point[p->npoints], e) || !read_binding(line, 3, &p->patch->binding[p->npoints], e)) return false;
    p->npoints++;
    return true;
}

static bool read_seam(Parser *p, const Line *line, Error *e) {
    Garment *g = p->g;
    Seam s = {0};
    Why why;
    if (g->nseams == GARMENT_SEAMS_MAX) return text_error(line, 0, e, "more than %d seams", GARMENT_SEAMS_MAX);
    if (!read_piece_side(g, line, 1, &s.piece_a, &s.side_a, e) || !read_piece_side(g, line, 2, &s.piece_b, &s.side_b, e)) return false;
    s.crease = line->count == 4;
    if (s.crease && !text_is(line, 3, "crease")) return text_error(line, 3, e, "expected 'crease' or the end of the line");
    if (!check_seam(g, &s, &why)) return text_error(line, 1, e, "%s", why.text);
    g->seam[g->nseams++] = s;
    return true;
}

static bool read_pin(Parser *p, const Line *line, Error *e) {
    Garment *g = p->g;
    Pin pin = {-1, -1, SIDE_START};
    Why why;
    if (g->npins == GARMENT_PINS_MAX) return text_error(line, 0, e, "more than %d pins", GARMENT_PINS_MAX);
    if (memchr(line->word[1], '.', (size_t)line->length[1])) {
        if (!read_piece_side(g, line, 1, &pin.piece, &pin.side, e)) return false;
    } else {
        char name[GARMENT_NAME_MAX];
        if (!text_word(line, 1, name, sizeof name, e)) return false;
        if (garment_find_piece(g, name) >= 0)
            return text_error(line, 1, e, "'%s' is a panel or patch: pin a ring or one side, as in '%.40s.top'", name, name);
        if (!find_ring(g, name, line, 1, &pin.ring, e)) return false;
    }
    if (!check_pin(g, &pin, &why)) return text_error(line, 1, e, "%s", why.text);
    g->pin[g->npins++] = pin;
    return true;
}

/* RING..RING or PIECE. */
static bool read_extent(const Garment *g, const Line *line, Collide *c, Error *e) {
    char word[2 * GARMENT_NAME_MAX + 2];
    if (!text_word(line, 1, word, sizeof word, e)) return false;
    char *dots = strstr(word, "..");
    if (dots) {
        *dots = 0;
        return find_ring(g, word, line, 1, &c->from_ring, e) && find_ring(g, dots + 2, line, 1, &c->to_ring, e);
    }
    if (garment_find_ring(g, word) >= 0)
        return text_error(line, 1, e, "'%s' is one ring: patches lie between two, as in '%.40s..hem'", word, word);
    return find_piece(g, word, line, 1, &c->piece, e);
}

static bool read_collide(Parser *p, const Line *line, Error *e) {
    Garment *g = p->g;
    Collide c = {-1, -1, -1, 0};
    Why why;
    if (g->ncollides == GARMENT_COLLIDES_MAX) return text_error(line, 0, e, "more than %d collides", GARMENT_COLLIDES_MAX);
    if (!read_extent(g, line, &c, e)) return false;
    for (int i = 2; i < line->count; i++) {
        Role part;
        if (!read_part(line, i, &part, e)) return false;
        if (c.parts & 1u << part) return text_error(line, i, e, "'%s' is named twice", role_name(part));
        c.parts |= 1u << part;
    }
    if (!check_collide(g, &c, &why)) return text_error(line, 1, e, "%s", why.text);
    g->collide[g->ncollides++] = c;
    return true;
}

static bool read_mirror(Parser *p, const Line *line, Error *e) {
    char from[GARMENT_NAME_MAX], to[GARMENT_NAME_MAX];
    Why why;
    return text_word(line, 1, from, sizeof from, e) && text_word(line, 2, to, sizeof to, e) &&
           (garment_mirror(p->g, from, to, &why) || text_error(line, 1, e, "%s", why.text));
}

typedef struct {
    const char *word, *usage;
    int fewest, most; /* words of the line */
    bool (*read)(Parser *p, const Line *line, Error *e);
} Statement;

static const Statement statements[] = {
    {"garment", "garment NAME", 2, 2, read_title},
    {"follow", "follow bones|envelope", 2, 2, read_follow},
    {"fit", "fit tight|loose", 2, 2, read_fit},
    {"detail", "detail N", 2, 2, read_detail},
    {"ring", "ring NAME PART AT [ease E] [size SIDE FRONT BACK] [shift X Y Z] [tilt DEGREES]", 4, 16, read_ring},
    {"bind", "bind RING[.STATION] PART WEIGHT [PART WEIGHT ...]", 4, TEXT_WORDS_MAX, read_bind},
    {"move", "move RING.STATION X Y Z", 5, 5, read_move},
    {"join", "join RING.STATION RING.STATION", 3, 3, read_join},
    {"panel", "panel NAME", 2, 2, read_panel},
    {"row", "row RING FROM [VIA] TO", 4, 5, read_row},
    {"patch", "patch NAME", 2, 2, read_patch},
    {"seam", "seam PIECE.SIDE PIECE.SIDE [crease]", 3, 4, read_seam},
    {"pin", "pin RING|PIECE.SIDE", 2, 2, read_pin},
    {"collide", "collide RING..RING|PIECE PART [PART ...]", 3, TEXT_WORDS_MAX, read_collide},
    {"mirror", "mirror FROM_PREFIX TO_PREFIX", 3, 3, read_mirror},
};
enum { STATEMENTS = sizeof statements / sizeof *statements };

/* The open piece is complete: another statement, or the end of the file, came. */
static bool close_piece(Parser *p, Error *e) {
    Why why;
    if (p->panel && p->panel->nrows < 2)
        return text_error(&p->opening, 1, e, "panel '%s' has %d of at least 2 rows", p->panel->name, p->panel->nrows);
    if (p->panel && p->g->follow == FOLLOW_ENVELOPE && !check_envelope(p->g, p->panel, &why)) return text_error(&p->opening, 1, e, "%s", why.text);
    if (p->patch && p->npoints < 16)
        return text_error(&p->opening, 1, e, "patch '%s' has %d of its 16 points", p->patch->name, p->npoints);
    if (p->patch && !check_area(p->patch, &why)) return text_error(&p->opening, 1, e, "%s", why.text);
    p->panel = NULL;
    p->patch = NULL;
    return true;
}

static bool read_statement(Parser *p, const Line *line, Error *e) {
    char word[GARMENT_NAME_MAX];
    if (p->patch && p->npoints < 16) return read_point(p, line, e);
    if (!text_word(line, 0, word, sizeof word, e)) return false;
    if (p->patch && is_number(line)) return text_error(line, 0, e, "more than 16 points in the patch '%s'", p->patch->name);
    const Statement *s = statements;
    Nearest near = {word, NULL, 0};
    for (; s < statements + STATEMENTS && strcmp(word, s->word) != 0; s++) nearest_try(&near, s->word);
    bool is_title = s == statements;
    if (!p->has_title && !is_title) return text_error(line, 0, e, "%s", NO_TITLE);
    if (p->has_title && is_title) return text_error(line, 0, e, "a second 'garment' in one file");
    if (s == statements + STATEMENTS) return unknown(line, 0, e, "statement", &near);
    if (line->count < s->fewest || line->count > s->most)
        return text_error(line, line->count < s->fewest ? line->count : s->most, e, "expected '%s'", s->usage);
    if (s->read != read_row && !close_piece(p, e)) return false;
    return s->read(p, line, e);
}

bool garment_parse(const Text *text, Garment *out, Error *e) {
    memset(out, 0, sizeof *out);
    Parser p = {.g = out};
    Cursor cursor = text_start(text);
    Line line;
    while (text_line(&cursor, &line, e))
        if (!read_statement(&p, &line, e)) return false;
    if (e->kind) return false;
    if (!p.has_title) return error_at(e, ERR_INPUT, text_place(&cursor, cursor.at), "%s", NO_TITLE);
    if (!close_piece(&p, e)) return false;
    if (out->npanels + out->npatches == 0) return text_error(&p.title, 1, e, "garment '%s' has no panel and no patch", out->name);
    return true;
}
