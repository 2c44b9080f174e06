/* The body as text: one line for a section, so that a figure can be edited with any editor and
   compared line by line. garments/BODY.md is the manual of the format. */
#include "figure/body.h"

#include <string.h>

enum { BODY_FILE_MAX = 1 << 20 };

/* A section farther from its bone than this, or larger, is a slip of the pen (of metres and
   centimetres, most often). In bone lengths and metres. */
static const double AT_LIMIT = 10, CENTRE_LIMIT = 1, SIZE_LIMIT = 1, SIZE_LEAST = 0.001;

/* Sections closer than this (in bone lengths) make a step, not a surface. */
static const double AT_STEP = 1e-3;

static const char *const COLUMNS[] = {"at", "x", "z", "side", "front", "back"};
enum { COLUMN_COUNT = 6, COLUMN_WIDTH = 6 };

static double *column_of(Section *s, int i) {
    double *column[COLUMN_COUNT] = {&s->at, &s->x, &s->z, &s->side, &s->front, &s->back};
    return column[i];
}

static BodyPartSpec mirrored(const BodyPartSpec *part) {
    BodyPartSpec other = *part;
    other.role = role_mirror(part->role);
    for (int i = 0; i < other.nsections; i++)
        if (other.section[i].x != 0) other.section[i].x = -other.section[i].x;
    return other;
}

static const BodyPartSpec *find_part(const BodySpec *body, Role role) {
    for (int i = 0; i < body->nparts; i++)
        if (body->part[i].role == role) return &body->part[i];
    return NULL;
}

static bool no_more_words(const Line *line, int count, Error *e) {
    if (line->count <= count) return true;
    return text_error(line, count, e, "unexpected '%.*s' at the end of the line",
                      error_shown(line->length[count]), line->word[count]);
}

/* The role that a `part` or `mirror` line names; each body part is given once. */
static bool read_role(const Line *line, const BodySpec *body, Role *role, Error *e) {
    char name[32];
    if (!text_word(line, 1, name, sizeof name, e) || !no_more_words(line, 2, e)) return false;
    *role = role_find(name, (int)strlen(name));
    if (*role == ROLE_COUNT) return role_unknown(name, "body part", text_place(&line->at, line->word[1]), e);
    if (find_part(body, *role)) return text_error(line, 1, e, "part '%s' is given twice", name);
    if (body->nparts == BODY_PARTS_MAX) return text_error(line, 0, e, "more than %d parts", BODY_PARTS_MAX);
    return true;
}

static bool read_mirror(const Line *line, BodySpec *body, Error *e) {
    Role role = ROLE_COUNT;
    if (!read_role(line, body, &role, e)) return false;
    if (role_mirror(role) == role) return text_error(line, 1, e, "'%s' has no other side", role_name(role));
    const BodyPartSpec *other = find_part(body, role_mirror(role));
    if (!other) return text_error(line, 1, e, "'%s' must be given before its mirror", role_name(role_mirror(role)));
    body->part[body->nparts++] = mirrored(other);
    return true;
}

static bool read_section(const Line *line, BodyPartSpec *part, Error *e) {
    if (part->nsections == SPEC_SECTIONS_MAX)
        return text_error(line, 0, e, "more than %d sections in '%s'", SPEC_SECTIONS_MAX, role_name(part->role));
    Section *s = &part->section[part->nsections];
    for (int i = 0; i < COLUMN_COUNT; i++) {
        double *x = column_of(s, i), limit = i == 0 ? AT_LIMIT : i < 3 ? CENTRE_LIMIT : SIZE_LIMIT;
        if (i + 1 >= line->count)
            return text_error(line, i + 1, e, "a section needs at, x, z, side, front, back; '%s' is missing",
                              COLUMNS[i]);
        if (!text_real(line, i + 1, x, e)) return false;
        if (fabs(*x) > limit)
            return text_error(line, i + 1, e, "%s must be from %g to %g", COLUMNS[i], i < 3 ? -limit : 0.0, limit);
        if (i >= 3 && *x < SIZE_LEAST)
            return text_error(line, i + 1, e, "%s must be at least %g", COLUMNS[i], SIZE_LEAST);
    }
    if (!no_more_words(line, COLUMN_COUNT + 1, e)) return false;
    if (part->nsections && s->at < s[-1].at + AT_STEP)
        return text_error(line, 1, e, "at must grow from section to section by %g or more", AT_STEP);
    part->nsections++;
    return true;
}

static bool read_caps(const Line *line, BodyPartSpec *part, Error *e) {
    for (int i = 0; i < 2; i++) {
        if (!text_real(line, i + 1, &part->cap[i], e)) return false;
        if (part->cap[i] < 0 || part->cap[i] > SIZE_LIMIT || (part->cap[i] > 0 && part->cap[i] < SIZE_LEAST))
            return text_error(line, i + 1, e, "a cap must be 0 (a half ball) or from %g to %g", SIZE_LEAST, SIZE_LIMIT);
    }
    return no_more_words(line, 3, e);
}

/* A part is complete when something else begins; `where` is the line that began it. */
static bool end_part(const BodyPartSpec *open, const Line *where, Error *e) {
    if (!open || open->nsections >= 2) return true;
    return text_error(where, 1, e, "part '%s' has %d section%s, it needs at least 2", role_name(open->role),
                      open->nsections, open->nsections == 1 ? "" : "s");
}

static bool read_header(Cursor *c, Line *line, BodySpec *out, Error *e) {
    if (!text_line(c, line, e)) {
        if (e->kind != ERR_NONE) return false;
        return error_at(e, ERR_INPUT, text_place(c, c->at), "empty body file: expected 'body NAME'");
    }
    if (!text_is(line, 0, "body")) return text_error(line, 0, e, "expected 'body NAME' in the first line");
    return text_word(line, 1, out->name, sizeof out->name, e) && no_more_words(line, 2, e);
}

bool body_parse(const Text *text, BodySpec *out, Error *e) {
    memset(out, 0, sizeof *out);
    Cursor c = text_start(text);
    Line line = {0}, opening = {0};
    if (!read_header(&c, &line, out, e)) return false;
    BodyPartSpec *open = NULL;
    while (text_line(&c, &line, e)) {
        bool section = text_is(&line, 0, "section"), caps = text_is(&line, 0, "caps");
        if (section || caps) {
            if (!open) return text_error(&line, 0, e, "'%s' outside of a part", section ? "section" : "caps");
            if (!(section ? read_section : read_caps)(&line, open, e)) return false;
            continue;
        }
        bool part = text_is(&line, 0, "part");
        /* Before a part is blamed that lacks sections: by a slip of the pen in one of them, maybe. */
        if (!part && !text_is(&line, 0, "mirror"))
            return text_error(&line, 0, e, "expected 'part', 'section', 'caps' or 'mirror', found '%.*s'",
                              error_shown(line.length[0]), line.word[0]);
        if (!end_part(open, &opening, e)) return false;
        open = NULL;
        if (part) {
            Role role = ROLE_COUNT;
            if (!read_role(&line, out, &role, e)) return false;
            open = &out->part[out->nparts++];
            open->role = role;
            opening = line;
        } else if (!read_mirror(&line, out, e)) {
            return false;
        }
    }
    if (e->kind != ERR_NONE || !end_part(open, &opening, e)) return false;
    return out->nparts > 0 || text_error(&line, line.count, e, "a body needs at least one part");
}

bool body_read(const char *path, Arena *scratch, BodySpec *out, Error *e) {
    Text text;
    return text_read(path, BODY_FILE_MAX, scratch, &text, e) && body_parse(&text, out, e);
}

/* At least `width` bytes, so that columns stand under each other. */
static void write_number(double x, int width, FILE *out) {
    char text[TEXT_SHORTEST];
    fprintf(out, " %*s", width, text_shortest(x, text));
}

static bool same_part(const BodyPartSpec *a, const BodyPartSpec *b) {
    if (a->role != b->role || a->nsections != b->nsections) return false;
    if (a->cap[0] != b->cap[0] || a->cap[1] != b->cap[1]) return false;
    for (int i = 0; i < a->nsections; i++) {
        Section s = a->section[i], t = b->section[i];
        for (int k = 0; k < COLUMN_COUNT; k++)
            if (*column_of(&s, k) != *column_of(&t, k)) return false;
    }
    return true;
}

/* Is part i the mirror of one that stands before it? */
static bool is_mirror(const BodySpec *body, int i) {
    for (int k = 0; k < i; k++) {
        if (role_mirror(body->part[k].role) != body->part[i].role) continue;
        BodyPartSpec other = mirrored(&body->part[k]);
        return same_part(&other, &body->part[i]);
    }
    return false;
}

static void write_part(const BodyPartSpec *part, FILE *out) {
    fprintf(out, "\npart %s\n#      ", role_name(part->role));
    for (int j = 0; j < COLUMN_COUNT; j++) fprintf(out, " %*s", COLUMN_WIDTH, COLUMNS[j]);
    for (int k = 0; k < part->nsections; k++) {
        Section s = part->section[k];
        fprintf(out, "\nsection");
        for (int j = 0; j < COLUMN_COUNT; j++) write_number(*column_of(&s, j), COLUMN_WIDTH, out);
    }
    if (part->cap[0] > 0 || part->cap[1] > 0) {
        fprintf(out, "\ncaps");
        write_number(part->cap[0], 0, out);
        write_number(part->cap[1], 0, out);
    }
    fprintf(out, "\n");
}

bool body_write(const BodySpec *body, FILE *out) {
    fprintf(out, "body %s\n", body->name);
    for (int i = 0; i < body->nparts; i++) {
        if (is_mirror(body, i)) fprintf(out, "\nmirror %s\n", role_name(body->part[i].role));
        else write_part(&body->part[i], out);
    }
    return !ferror(out);
}
