/* The statements of a garment file, one line each. There is one pass and one rule: a statement
   can only name what stands above it. So every mistake is found at the line that makes it, and
   has the place of the word. A table lists the statements with what they expect. */
#include "garment/garment.h"

#include <string.h>

#include "garment/mirror.h"
#include "garment/words.h"

static const char NO_TITLE[] = "not a garment file: it must begin with 'garment NAME'";

/* What the parser knows beside the garment: the piece that is open and what was said already. */
typedef struct {
    Garment *g;
    Panel *panel;    /* rows belong to it */
    RawPatch *patch; /* points belong to it */
    int npoints;
    Line opening; /* the line of the open piece */
    Line title;   /* the line `garment NAME` */
    Place ring[GARMENT_RINGS_MAX]; /* where its name stands; a mirror image has no place */
    bool has_title, has_follow, has_fit;
    bool moved[GARMENT_RINGS_MAX][STATION_COUNT];
    int bound[GARMENT_RINGS_MAX][STATION_COUNT]; /* 1: with its ring, 2: by itself */
} Parser;

/* A new name: of a ring, panel or patch. All share one name space, so `pin hem` has one meaning. */
static bool read_new_name(const Garment *g, const Line *line, char name[GARMENT_NAME_MAX], Error *e) {
    Why why;
    if (!text_word(line, 1, name, GARMENT_NAME_MAX, e)) return false;
    if (strchr(name, '.')) return text_error(line, 1, e, "'.' in the name '%s'", name);
    if (!check_name(name, &why)) return text_error(line, 1, e, "%s", why.text);
    if (garment_find_ring(g, name) >= 0) return text_error(line, 1, e, "there is a ring '%s' already", name);
    int piece = garment_find_piece(g, name);
    if (piece >= 0)
        return text_error(line, 1, e, "there is a %s '%s' already", piece < g->npanels ? "panel" : "patch", name);
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
    if (p->g->npanels + p->g->npatches)
        return text_error(line, 0, e, "'follow' must stand above the first panel or patch");
    int k = words_choose(line, 1, "way to follow", words, 2, e);
    p->g->follow = (Follow)k;
    p->has_follow = true;
    return k >= 0;
}

static bool read_fit(Parser *p, const Line *line, Error *e) {
    static const char *const words[] = {"tight", "loose"};
    if (p->has_fit) return text_error(line, 0, e, "'fit' is given twice");
    int k = words_choose(line, 1, "fit", words, 2, e);
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
    case OPTION_EASE: return words_length(line, i, &ring->ease, e);
    case OPTION_SHIFT: return words_vector(line, i, &ring->shift, e);
    case OPTION_TILT: return words_number(line, i, -180, 180, &ring->tilt, e);
    default:
        ring->has_size = true;
        return words_size(line, i, &ring->side, e) && words_size(line, i + 1, &ring->front, e) &&
               words_size(line, i + 2, &ring->back, e);
    }
}

static bool read_ring(Parser *p, const Line *line, Error *e) {
    static const char *const words[OPTION_COUNT] = {"ease", "size", "shift", "tilt"};
    static const int numbers[OPTION_COUNT] = {1, 3, 3, 1};
    Garment *g = p->g;
    bool given[OPTION_COUNT] = {false};
    if (g->nrings == GARMENT_RINGS_MAX) return text_error(line, 0, e, "more than %d rings", GARMENT_RINGS_MAX);
    if (g->follow == FOLLOW_ENVELOPE && g->npanels)
        return text_error(line, 0, e, "the rings of an envelope must stand above its panels");
    Ring *ring = &g->ring[g->nrings];
    memset(ring, 0, sizeof *ring);
    if (!read_new_name(g, line, ring->name, e) || !words_part(line, 2, &ring->part, e) ||
        !words_number(line, 3, -PLACE_MAX, PLACE_MAX, &ring->at, e))
        return false;
    for (int i = 4, k; i < line->count; i += 1 + numbers[k]) {
        k = words_choose(line, i, "property of a ring", words, OPTION_COUNT, e);
        if (k < 0) return false;
        if (given[k]) return text_error(line, i, e, "'%s' is given twice", words[k]);
        given[k] = true;
        if (!read_ring_option(ring, k, line, i + 1, e)) return false;
    }
    if (ring->has_size &&
        (ring->side + ring->ease <= 0 || ring->front + ring->ease <= 0 || ring->back + ring->ease <= 0))
        return text_error(line, 1, e, "the ring '%s' has no size left: sizes and ease must sum to more than 0",
                          ring->name);
    p->ring[g->nrings++] = text_place(&line->at, line->word[1]);
    return true;
}

static bool read_bind(Parser *p, const Line *line, Error *e) {
    Garment *g = p->g;
    Binding binding;
    int ring, first = 0, last = STATION_COUNT - 1, level = 1;
    if (memchr(line->word[1], '.', (size_t)line->length[1])) {
        Station station;
        if (!words_ring_station(g, line, 1, &ring, &station, e)) return false;
        first = last = station;
        level = 2;
    } else if (!words_ring(g, line, 1, &ring, e)) {
        return false;
    }
    if (!words_binding(line, 2, &binding, e)) return false;
    for (int s = first; s <= last; s++) {
        if (p->bound[ring][s] >= level)
            return text_error(line, 1, e, "'%s.%s' is bound already", g->ring[ring].name, station_name((Station)s));
        p->bound[ring][s] = level;
        g->ring[ring].binding[s] = binding;
    }
    return true;
}

static bool read_move(Parser *p, const Line *line, Error *e) {
    int ring;
    Station station;
    if (!words_ring_station(p->g, line, 1, &ring, &station, e)) return false;
    if (p->moved[ring][station])
        return text_error(line, 1, e, "'%s.%s' is moved already", p->g->ring[ring].name, station_name(station));
    p->moved[ring][station] = true;
    return words_vector(line, 2, &p->g->ring[ring].move[station], e);
}

static bool read_join(Parser *p, const Line *line, Error *e) {
    Garment *g = p->g;
    Join j;
    Why why;
    if (g->njoins == GARMENT_JOINS_MAX) return text_error(line, 0, e, "more than %d joins", GARMENT_JOINS_MAX);
    if (!words_ring_station(g, line, 1, &j.ring_a, &j.station_a, e) ||
        !words_ring_station(g, line, 2, &j.ring_b, &j.station_b, e))
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
    Why why;
    if (!p->panel) return text_error(line, 0, e, "'row' outside a panel: rows follow their 'panel NAME'");
    if (p->panel->nrows == GARMENT_ROWS_MAX)
        return text_error(line, 0, e, "more than %d rows in the panel '%s'", GARMENT_ROWS_MAX, p->panel->name);
    Row *row = &p->panel->row[p->panel->nrows];
    row->via = STATION_NONE;
    if (!words_ring(p->g, line, 1, &row->ring, e)) return false;
    if (!words_station(line, 2, &row->from, e) || !words_station(line, line->count - 1, &row->to, e)) return false;
    if (line->count == 5 && !words_station(line, 3, &row->via, e)) return false;
    if (!check_row(p->g, p->panel, row, &why)) return text_error(line, 1, e, "%s", why.text);
    p->panel->nrows++;
    return true;
}

static bool read_patch(Parser *p, const Line *line, Error *e) {
    char name[GARMENT_NAME_MAX];
    if (!read_new_name(p->g, line, name, e)) return false;
    if (p->g->follow == FOLLOW_ENVELOPE)
        return text_error(line, 0, e, "a raw patch has no rings to follow the envelope: use 'follow bones'");
    p->patch = garment_add_patch(p->g, name);
    p->npoints = 0;
    p->opening = *line;
    return p->patch || text_error(line, 0, e, "more than %d raw patches", GARMENT_PATCHES_MAX);
}

static bool is_number(const Line *line) { return line->word[0][0] && strchr("0123456789.+-", line->word[0][0]); }

/* A line of the open raw patch: x y z PART WEIGHT ... */
static bool read_point(Parser *p, const Line *line, Error *e) {
    if (!is_number(line))
        return text_error(line, 0, e, "expected point %d of the 16 of the patch '%s': x y z PART WEIGHT ...",
                          p->npoints + 1, p->patch->name);
    if (!words_vector(line, 0, &p->patch->point[p->npoints], e) ||
        !words_binding(line, 3, &p->patch->binding[p->npoints], e))
        return false;
    p->npoints++;
    return true;
}

static bool read_seam(Parser *p, const Line *line, Error *e) {
    Garment *g = p->g;
    Seam s = {0};
    Why why;
    if (g->nseams == GARMENT_SEAMS_MAX) return text_error(line, 0, e, "more than %d seams", GARMENT_SEAMS_MAX);
    if (!words_piece_side(g, line, 1, &s.piece_a, &s.side_a, e) ||
        !words_piece_side(g, line, 2, &s.piece_b, &s.side_b, e))
        return false;
    s.crease = line->count == 4;
    if (s.crease && !text_is(line, 3, "crease"))
        return text_error(line, 3, e, "expected 'crease' or the end of the line");
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
        if (!words_piece_side(g, line, 1, &pin.piece, &pin.side, e)) return false;
    } else {
        char name[GARMENT_NAME_MAX];
        if (!text_word(line, 1, name, sizeof name, e)) return false;
        if (garment_find_piece(g, name) >= 0)
            return text_error(line, 1, e, "'%s' is a panel or patch: pin a ring or one side, as in '%.40s.top'", name,
                              name);
        if (!words_ring_named(g, name, line, 1, &pin.ring, e)) return false;
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
        return words_ring_named(g, word, line, 1, &c->from_ring, e) &&
               words_ring_named(g, dots + 2, line, 1, &c->to_ring, e);
    }
    if (garment_find_ring(g, word) >= 0)
        return text_error(line, 1, e, "'%s' is one ring: patches lie between two, as in '%.40s..hem'", word, word);
    return words_piece_named(g, word, line, 1, &c->piece, e);
}

static bool read_collide(Parser *p, const Line *line, Error *e) {
    Garment *g = p->g;
    Collide c = {-1, -1, -1, 0};
    Why why;
    if (g->ncollides == GARMENT_COLLIDES_MAX)
        return text_error(line, 0, e, "more than %d collides", GARMENT_COLLIDES_MAX);
    if (!read_extent(g, line, &c, e)) return false;
    for (int i = 2; i < line->count; i++) {
        Role part;
        if (!words_part(line, i, &part, e)) return false;
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
    int ring;
    if (p->panel && p->panel->nrows < 2)
        return text_error(&p->opening, 1, e, "panel '%s' has %d of at least 2 rows", p->panel->name, p->panel->nrows);
    if (p->panel && p->g->follow == FOLLOW_ENVELOPE && !check_envelope(p->g, p->panel, &ring, &why)) {
        Place place = ring >= 0 ? p->ring[ring] : (Place){0};
        return place.file ? error_at(e, ERR_INPUT, place, "%s", why.text)
                          : text_error(&p->opening, 1, e, "%s", why.text);
    }
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
    if (p->patch && is_number(line))
        return text_error(line, 0, e, "more than 16 points in the patch '%s'", p->patch->name);
    const Statement *s = statements;
    Nearest near = {.word = word};
    for (; s < statements + STATEMENTS && strcmp(word, s->word) != 0; s++) nearest_try(&near, s->word);
    bool is_title = s == statements;
    if (!p->has_title && !is_title) return text_error(line, 0, e, "%s", NO_TITLE);
    if (p->has_title && is_title) return text_error(line, 0, e, "a second 'garment' in one file");
    if (s == statements + STATEMENTS) return words_unknown(line, 0, e, "statement", &near);
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
    if (out->npanels + out->npatches == 0)
        return text_error(&p.title, 1, e, "garment '%s' has no panel and no patch", out->name);
    return true;
}
