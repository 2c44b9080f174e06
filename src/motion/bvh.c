/* BVH: a head (HIERARCHY) that lists joints by nested braces, and MOTION, a stream of
   numbers, one per channel and frame. The head is read without recursion: the open joint
   and its parents are the stack. Real files break the rules in many small ways; what can be
   understood is read, with a warning where numbers might be lost or guessed. */
#include <limits.h>
#include <string.h>

#include "motion/source.h"

enum { NESTING_MAX = 1000, NAME_MAX_BYTES = 1000, FIRST_JOINTS = 128 };

static const char *const channel_names[] = {"Xposition", "Yposition", "Zposition",
                                            "Xrotation", "Yrotation", "Zrotation"};

/* The head while it is read. */
typedef struct {
    Opening *o;
    Joint *joint;
    int njoints, capacity;
    int open, depth;      /* the joint whose brace is open, -1 for none; braces open */
    bool *offset, *ended; /* per joint: OFFSET seen, CHANNELS seen */
    bool await_brace;     /* a joint was named and its '{' must follow */
} Head;

static const char *joint_name(const Head *h, int i) { return h->joint[i].name; }

static bool grow(Head *h, Error *e) {
    if (h->njoints < h->capacity) return true;
    int capacity = h->capacity ? 2 * h->capacity : FIRST_JOINTS;
    Joint *joint = ARENA_NEW(h->o->scratch, Joint, capacity, e);
    bool *offset = ARENA_NEW(h->o->scratch, bool, capacity, e), *ended = ARENA_NEW(h->o->scratch, bool, capacity, e);
    if (!joint || !offset || !ended) return false;
    if (h->njoints) {
        memcpy(joint, h->joint, (size_t)h->njoints * sizeof *joint);
        memcpy(offset, h->offset, (size_t)h->njoints * sizeof *offset);
        memcpy(ended, h->ended, (size_t)h->njoints * sizeof *ended);
    }
    h->joint = joint, h->offset = offset, h->ended = ended, h->capacity = capacity;
    return true;
}

/* Opens a joint below the open one. */
static bool add_joint(Head *h, const char *name, bool is_end, Error *e) {
    Stream *s = &h->o->in;
    if (h->njoints == h->o->max_joints) return stream_error(s, e, "more than %d joints", h->o->max_joints);
    if (h->depth == NESTING_MAX) return stream_error(s, e, "joints nested more than %d deep", NESTING_MAX);
    if (!grow(h, e)) return false;
    h->joint[h->njoints] = (Joint){.name = name, .parent = h->open, .axis = mat_identity(), .is_end = is_end};
    h->open = h->njoints++;
    h->await_brace = true;
    return true;
}

/* The rest of the line up to a '{', trimmed, without quotes round it. */
static Word rest_of_line(Stream *s) {
    const char *p = s->at;
    if (*p == '"')
        for (p++; p < s->end && *p != '"' && *p != '\n' && *p != '\r';) p++;
    while (p < s->end && *p != '\n' && *p != '\r' && *p != '{') p++;
    Word w = {s->at, 0, false};
    const char *end = p;
    while (end > s->at && (end[-1] == ' ' || end[-1] == '\t')) end--;
    w.length = (int)(end - s->at);
    s->at = p;
    if (w.length >= 2 && *w.start == '"' && end[-1] == '"') w.start++, w.length -= 2;
    return w;
}

/* A name is whatever stands behind the keyword, blanks and all; or in the next line. */
static bool read_name(Head *h, const char **out, Error *e) {
    Stream *s = &h->o->in;
    stream_space(s);
    Word w = rest_of_line(s);
    if (w.length > NAME_MAX_BYTES) return stream_error(s, e, "joint name of more than %d bytes", NAME_MAX_BYTES);
    if (w.length == 0) return stream_error(s, e, "joint without a name");
    return (*out = arena_text(h->o->arena, w.start, (size_t)w.length, e)) != NULL;
}

static bool read_root(Head *h, Error *e) {
    const char *name = NULL;
    if (h->njoints) return stream_error(&h->o->in, e, "a second ROOT: a file may hold one figure");
    return read_name(h, &name, e) && add_joint(h, name, false, e);
}

static bool read_joint(Head *h, Error *e) {
    const char *name = NULL;
    if (h->open < 0) return stream_error(&h->o->in, e, "JOINT outside of a ROOT");
    return read_name(h, &name, e) && add_joint(h, name, false, e);
}

/* `End Site`, in any case and with or without a name of its own, which nobody uses. */
static bool read_end(Head *h, Error *e) {
    Stream *s = &h->o->in;
    if (h->open < 0) return stream_error(s, e, "End Site outside of a ROOT");
    rest_of_line(s);
    const char *parent = joint_name(h, h->open);
    size_t n = strlen(parent);
    char *name = ARENA_NEW(h->o->arena, char, n + sizeof "_End", e);
    if (!name) return false;
    memcpy(name, parent, n);
    memcpy(name + n, "_End", sizeof "_End");
    return add_joint(h, name, true, e);
}

static bool read_offset(Head *h, Error *e) {
    Stream *s = &h->o->in;
    Joint *j = &h->joint[h->open];
    double v[3] = {0};
    char what[128];
    if (h->offset[h->open]) return stream_error(s, e, "joint '%.60s' has a second OFFSET", j->name);
    h->offset[h->open] = true;
    for (int i = 0; i < 3; i++) {
        NumberResult r = stream_number(s, &v[i]);
        if (r <= NUMBER_GLUED) continue;
        snprintf(what, sizeof what, "OFFSET %c of joint '%.60s'", "XYZ"[i], j->name);
        return stream_refuse(s, r, what, e);
    }
    j->offset = vec(v[0], v[1], v[2]);
    return true;
}

static bool read_channels(Head *h, Error *e) {
    Stream *s = &h->o->in;
    Joint *j = &h->joint[h->open];
    double count = 0;
    if (h->ended[h->open]) return stream_error(s, e, "joint '%.60s' has CHANNELS twice", j->name);
    h->ended[h->open] = true;
    NumberResult r = stream_number(s, &count);
    if (r > NUMBER_GLUED) return stream_refuse(s, r, "the number of CHANNELS", e);
    int most = j->is_end ? 0 : 6;
    if (!(count >= 0 && count <= most) || count != (int)count)
        return stream_error(s, e, "%g CHANNELS: %s", count, j->is_end ? "an End Site has none" : "a joint has 0 to 6");
    for (; j->nchannels < (int)count; j->nchannels++) {
        Word w = stream_peek(s);
        int kind = 0;
        while (kind < 6 && !word_is(w, channel_names[kind])) kind++;
        if (kind == 6)
            return stream_error(s, e, "expected Xposition .. Zposition or Xrotation .. Zrotation, found '%.*s'",
                                w.length < 40 ? w.length : 40, w.start);
        j->channel[j->nchannels] = (ChannelKind)kind;
        s->at += w.length;
    }
    return true;
}

static bool open_brace(Head *h, Error *e) {
    Stream *s = &h->o->in;
    if (!h->await_brace) return stream_error(s, e, "'{' without a joint");
    s->at++;
    h->await_brace = false;
    h->depth++;
    return true;
}

static bool close_brace(Head *h, Error *e) {
    Stream *s = &h->o->in;
    if (h->open < 0) return stream_error(s, e, "'}' without '{'");
    if (!h->offset[h->open]) return stream_error(s, e, "joint '%.60s' has no OFFSET", joint_name(h, h->open));
    s->at++;
    h->open = h->joint[h->open].parent;
    h->depth--;
    return true;
}

typedef bool ReadItem(Head *h, Error *e);

/* What a keyword of the head calls; `inside`: only within a joint's braces. */
static const struct {
    const char *word;
    ReadItem *read;
    bool inside, in_end;
} items[] = {
    {"ROOT", read_root, false, false},  {"JOINT", read_joint, true, false},      {"End", read_end, true, false},
    {"OFFSET", read_offset, true, true}, {"CHANNELS", read_channels, true, true},
};

static bool read_item(Head *h, Error *e) {
    Stream *s = &h->o->in;
    Word w = stream_peek(s);
    if (w.length == 0) return stream_sound(s, e) && stream_error(s, e, "the file ends before MOTION");
    if (*w.start == '{') return open_brace(h, e);
    if (h->await_brace) return stream_error(s, e, "expected '{', found '%.*s'", w.length < 40 ? w.length : 40, w.start);
    if (*w.start == '}') return close_brace(h, e);
    for (size_t i = 0; i < sizeof items / sizeof *items; i++) {
        if (!word_is(w, items[i].word)) continue;
        bool at_end = h->open >= 0 && h->joint[h->open].is_end;
        if ((items[i].inside && h->open < 0) || (at_end && !items[i].in_end))
            return stream_error(s, e, "%s cannot stand %s", items[i].word, at_end ? "in an End Site" : "outside of a ROOT");
        if (items[i].read == read_root && h->njoints) return read_root(h, e);
        s->at += w.length;
        return items[i].read(h, e);
    }
    return stream_error(s, e, "expected JOINT, End Site, OFFSET, CHANNELS, MOTION or a brace, found '%.*s'",
                        w.length < 40 ? w.length : 40, w.start);
}

static bool read_head(Opening *o, Error *e) {
    Head h = {.o = o, .open = -1};
    stream_word(&o->in); /* HIERARCHY */
    while (!word_is(stream_peek(&o->in), "MOTION") || h.await_brace)
        if (!read_item(&h, e)) return false;
    if (h.depth) return stream_error(&o->in, e, "MOTION before the '}' of joint '%.60s'", joint_name(&h, h.open));
    if (!h.njoints) return stream_error(&o->in, e, "no ROOT before MOTION");
    stream_word(&o->in);
    return source_skeleton(o, h.joint, h.njoints, e);
}

/* Takes `word` in any case and a colon with any blanks round it: `Frames:\t174`. */
static bool take_key(Stream *s, const char *first, const char *second) {
    Mark start = stream_mark(s);
    const char *part[2] = {first, second};
    stream_space(s);
    for (int i = 0; i < 2; i++) {
        for (const char *p = part[i]; *p; p++, s->at++) {
            if ((*s->at | 32) != (*p | 32)) {
                stream_seek(s, start);
                return false;
            }
        }
        stream_blanks(s);
    }
    if (*s->at == ':') s->at++;
    return true;
}

static bool read_frame_count(Opening *o, int *frames, Error *e) {
    Stream *s = &o->in;
    double count = 0;
    stream_space(s);
    Mark start = stream_mark(s);
    NumberResult r = stream_number(s, &count);
    if (r > NUMBER_GLUED) return stream_refuse(s, r, "the number of frames", e);
    stream_seek(s, start);
    if (count > o->max_frames) return stream_error(s, e, "%.0f frames are more than the limit of %d", count, o->max_frames);
    if (count < 1) return stream_error(s, e, "the motion has no frames");
    if (count != (int)count) return stream_error(s, e, "%g is no whole number of frames", count);
    *frames = (int)count;
    return stream_number(s, &count) <= NUMBER_GLUED;
}

static bool read_frame_time(Opening *o, Error *e) {
    Stream *s = &o->in;
    double t = 0;
    stream_space(s);
    Mark start = stream_mark(s);
    NumberResult r = stream_number(s, &t);
    if (r > NUMBER_GLUED) return stream_refuse(s, r, "the frame time", e);
    Mark behind = stream_mark(s);
    stream_seek(s, start);
    bool good = source_rate(o, t, e);
    stream_seek(s, behind);
    return good;
}

/* `Frames:` and `Frame Time:`, in either order. */
static bool read_counts(Opening *o, int *frames, Error *e) {
    bool timed = false;
    for (int i = 0; i < 2; i++) {
        if (!timed && take_key(&o->in, "Frame", "Time")) {
            if (!read_frame_time(o, e)) return false;
            timed = true;
        } else if (!*frames && take_key(&o->in, "Frames", "")) {
            if (!read_frame_count(o, frames, e)) return false;
        }
    }
    stream_space(&o->in);
    if (!*frames) return stream_error(&o->in, e, "expected 'Frames:' and their number");
    if (timed) return true;
    if (o->options->fps > 0) return source_rate(o, 0, e);
    return stream_error(&o->in, e, "expected 'Frame Time:' in seconds; or give the rate with --fps");
}

/* How the numbers lie on lines. It decides nothing while it fits: numbers are a stream. It
   tells a motion of another skeleton from a file with some frames more or less. */
typedef struct {
    int first;        /* values in the first line */
    int current;      /* in this line so far */
    int lines;        /* complete ones */
    Mark start, odd;  /* of this line; of the first line that differs from the first */
    int odd_values;
    bool uneven;      /* there is such a line */
} Lines;

static void end_line(Lines *l) {
    if (l->lines == 0) l->first = l->current;
    else if (l->current != l->first && !l->uneven) l->uneven = true, l->odd = l->start, l->odd_values = l->current;
    if (l->lines < INT_MAX) l->lines++;
    l->current = 0;
}

/* All values of the motion have been read (or the file has ended): if the number of frames
   is not the one announced, do the lines show that head and motion do not belong together? */
static bool check_lines(Opening *o, const Lines *l, Mark first, int announced, bool more, Error *e) {
    Stream *s = &o->in;
    int n = o->motion->skeleton.nchannels, k = l->first;
    if (o->source->nframes == announced && !more) return true;
    if (k == n && l->uneven) {
        stream_seek(s, l->odd);
        return stream_error(s, e, "a line of %d values where %d channels ask for %d: head and motion differ",
                            l->odd_values, n, n);
    }
    if (k == n || l->uneven) return true;
    bool wrapped = k < n && n % k == 0 && l->lines > announced;
    bool several = k > n && k % n == 0 && l->lines < announced && !more;
    if (wrapped || several) return true;
    stream_seek(s, first);
    return stream_error(s, e, "lines of %d values where %d channels ask for %d: head and motion are of different skeletons",
                        k, n, n);
}

static bool refuse_value(Opening *o, NumberResult r, int frame, int column, Error *e) {
    const Skeleton *k = &o->motion->skeleton;
    int i = k->njoints - 1;
    while (i > 0 && (k->joint[i].nchannels == 0 || k->joint[i].first_channel > column)) i--;
    const Joint *j = &k->joint[i];
    char what[160];
    snprintf(what, sizeof what, "frame %d, joint '%.60s', %s", frame + 1, j->name,
             channel_names[j->channel[column - j->first_channel]]);
    return stream_refuse(&o->in, r, what, e);
}

typedef struct {
    Lines lines;
    Mark first;
    bool glued; /* told about numbers without a blank between them */
    double *row;
    int announced;
} Scan;

/* Reads one frame, checking and counting. False at the end of the text or with an error. */
static bool scan_frame(Opening *o, Scan *c, int frame, Error *e) {
    Stream *s = &o->in;
    Lines *l = &c->lines;
    int n = o->motion->skeleton.nchannels;
    for (int i = 0; i < n; i++) {
        int line = s->line;
        if (stream_space(s) || s->line != line) {
            if (l->current) end_line(l);
            l->start = stream_mark(s);
        }
        if (i == 0) source_mark(o->source, frame, stream_mark(s));
        NumberResult r = stream_number(s, &c->row[i]);
        if (r == NUMBER_END || r == NUMBER_CUT) {
            if (i || r == NUMBER_CUT)
                stream_note(s, o->notes, "the file ends within frame %d, which is left out", frame + 1);
            return false;
        }
        if (r == NUMBER_GLUED && !c->glued) {
            c->glued = true;
            stream_note(s, o->notes, "no blank between two numbers, split at the sign");
        }
        if (r > NUMBER_GLUED) return refuse_value(o, r, frame, i, e);
        l->current++;
    }
    return true;
}

static void note_rest(Opening *o, int announced) {
    Stream *s = &o->in;
    double x;
    Mark here = stream_mark(s);
    bool number = stream_number(s, &x) <= NUMBER_GLUED;
    stream_seek(s, here);
    if (number) stream_note(s, o->notes, "more values than the %d frames announced, left out", announced);
    else stream_note(s, o->notes, "text behind the frames, left out");
}

static bool scan_frames(Opening *o, int announced, Error *e) {
    Stream *s = &o->in;
    Scan c = {.row = ARENA_NEW(o->scratch, double, o->motion->skeleton.nchannels, e), .announced = announced};
    if (!c.row) return false;
    stream_space(s);
    c.first = c.lines.start = stream_mark(s);
    int frame = 0;
    while (frame < announced && scan_frame(o, &c, frame, e)) source_sample(o, frame++, c.row);
    if (e->kind != ERR_NONE || !stream_sound(s, e)) return false;
    o->source->nframes = frame;
    bool broken = stream_space(s);
    if ((broken || stream_ended(s)) && c.lines.current) end_line(&c.lines);
    bool more = !stream_ended(s) && ((*s->at >= '0' && *s->at <= '9') || *s->at == '-' || *s->at == '.');
    if (!check_lines(o, &c.lines, c.first, announced, more, e)) return false;
    if (frame < announced && frame > 0)
        stream_note(s, o->notes, "%d frames announced, %d complete ones found", announced, frame);
    if (!stream_ended(s)) note_rest(o, announced);
    return true;
}

bool bvh_open(Opening *o, Error *e) {
    int frames = 0;
    o->motion->format = "BVH";
    return read_head(o, e) && read_counts(o, &frames, e) && scan_frames(o, frames, e);
}

bool bvh_row(Stream *s, const MotionSource *source, double *row, Error *e) {
    for (int i = 0; i < source->skeleton.nchannels; i++)
        if (stream_number(s, &row[i]) > NUMBER_GLUED)
            return stream_sound(s, e) && error_set(e, ERR_INPUT, "'%s' has changed since it was opened", source->name);
    return true;
}
