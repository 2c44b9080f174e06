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

typedef struct {
    bool offset, channels;
} Seen;

/* The head while it is read. */
typedef struct {
    Opening *o;
    Joint *joint;
    int njoints, capacity;
    int open, depth;      /* the joint whose brace is open, -1 for none; braces open */
    Seen *seen;           /* per joint */
    bool await_brace;     /* a joint was named and its '{' must follow */
} Head;

static const char *joint_name(const Head *h, int i) { return h->joint[i].name; }

static bool grow(Head *h, Error *e) {
    if (h->njoints < h->capacity) return true;
    int capacity = h->capacity ? 2 * h->capacity : FIRST_JOINTS;
    Joint *joint = ARENA_NEW(h->o->scratch, Joint, capacity, e);
    Seen *seen = ARENA_NEW(h->o->scratch, Seen, capacity, e);
    if (!joint || !seen) return false;
    if (h->njoints) {
        memcpy(joint, h->joint, (size_t)h->njoints * sizeof *joint);
        memcpy(seen, h->seen, (size_t)h->njoints * sizeof *seen);
    }
    h->joint = joint;
    h->seen = seen;
    h->capacity = capacity;
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
        for (p++; *p && !strchr("\"\n\r", *p);) p++;
    while (*p && !strchr("\n\r{", *p)) p++;
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

/* A camera or a second performer may stand beside the first: the figure is found among all. */
static bool read_root(Head *h, Error *e) {
    const char *name = NULL;
    if (h->open >= 0) return stream_error(&h->o->in, e, "ROOT within joint '%.60s'", joint_name(h, h->open));
    if (h->njoints) stream_note(&h->o->in, h->o->notes, "another ROOT: one figure is read, --roles can name it");
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
    const char *name = source_end_name(h->o, joint_name(h, h->open), e);
    return name && add_joint(h, name, true, e);
}

static bool read_offset(Head *h, Error *e) {
    Stream *s = &h->o->in;
    Joint *j = &h->joint[h->open];
    double v[3] = {0};
    char what[128];
    if (h->seen[h->open].offset) return stream_error(s, e, "joint '%.60s' has a second OFFSET", j->name);
    h->seen[h->open].offset = true;
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
    if (h->seen[h->open].channels) return stream_error(s, e, "joint '%.60s' has CHANNELS twice", j->name);
    h->seen[h->open].channels = true;
    NumberResult r = stream_number(s, &count);
    if (r > NUMBER_GLUED) return stream_refuse(s, r, "the number of CHANNELS", e);
    int most = j->is_end ? 0 : 6;
    if (!(count >= 0 && count <= most) || count != (int)count)
        return stream_error(s, e, "%.0f CHANNELS: %s", count,
                            j->is_end ? "an End Site has none" : "a joint has 0 to 6");
    for (; j->nchannels < (int)count; j->nchannels++) {
        Word w = stream_peek(s);
        int kind = 0;
        while (kind < 6 && !word_is(w, channel_names[kind])) kind++;
        if (kind == 6)
            return stream_error(s, e, "expected Xposition .. Zposition or Xrotation .. Zrotation, found '%.*s'",
                                error_shown(w.length), w.start);
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
    if (!h->seen[h->open].offset) return stream_error(s, e, "joint '%.60s' has no OFFSET", joint_name(h, h->open));
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
    {"EndSite", read_end, true, false}, {"OFFSET", read_offset, true, true}, {"CHANNELS", read_channels, true, true},
};

static bool read_item(Head *h, Error *e) {
    Stream *s = &h->o->in;
    Word w = stream_peek(s);
    if (w.length == 0) return stream_sound(s, e) && stream_error(s, e, "the file ends before MOTION");
    if (*w.start == '{') return open_brace(h, e);
    if (h->await_brace) return stream_error(s, e, "expected '{', found '%.*s'", error_shown(w.length), w.start);
    if (*w.start == '}') return close_brace(h, e);
    for (size_t i = 0; i < sizeof items / sizeof *items; i++) {
        if (!word_is(w, items[i].word)) continue;
        bool at_end = h->open >= 0 && h->joint[h->open].is_end;
        if ((items[i].inside && h->open < 0) || (at_end && !items[i].in_end))
            return stream_error(s, e, "%s cannot stand %s", items[i].word,
                                at_end ? "in an End Site" : "outside of a ROOT");
        s->at += w.length;
        return items[i].read(h, e);
    }
    return stream_error(s, e, "expected JOINT, End Site, OFFSET, CHANNELS, MOTION or a brace, found '%.*s'",
                        error_shown(w.length), w.start);
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
    if (count > o->max_frames)
        return stream_error(s, e, "%.0f frames are more than the limit of %d", count, o->max_frames);
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
    if (r > NUMBER_GLUED && !(o->options->fps > 0)) return stream_refuse(s, r, "the frame time", e);
    if (r > NUMBER_GLUED) stream_word(s);
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
    int first;       /* values in the first line; 0: it is not complete */
    int current;     /* in this line so far */
    int lines;       /* complete ones */
    Mark start, odd; /* of this line; of the first line that differs from the first */
    int odd_values;  /* in that line; 0: there is none */
} Lines;

static void end_line(Lines *l) {
    if (l->lines == 0) l->first = l->current;
    else if (l->current != l->first && !l->odd_values) l->odd = l->start, l->odd_values = l->current;
    if (l->lines < INT_MAX) l->lines++;
    l->current = 0;
}

/* All frames of a motion while they are read for the first time. */
typedef struct {
    Opening *o;
    int announced, frame; /* frames that the head promises; complete ones so far */
    double *row;
    Lines lines;
    Mark first;       /* the first value */
    bool glued, cut;  /* seen: numbers without a blank between them; the end within a frame */
} Scan;

static bool refuse_value(Scan *c, NumberResult r, int column, Error *e) {
    const Skeleton *k = &c->o->motion->skeleton;
    int i = k->njoints - 1;
    while (i > 0 && (k->joint[i].nchannels == 0 || k->joint[i].first_channel > column)) i--;
    const Joint *j = &k->joint[i];
    char what[160];
    snprintf(what, sizeof what, "frame %d, joint '%.60s', %s", c->frame + 1, j->name,
             channel_names[j->channel[column - j->first_channel]]);
    return stream_refuse(&c->o->in, r, what, e);
}

/* Reads one frame, checking and counting. False at the end of the text or with an error. */
static bool scan_frame(Scan *c, Error *e) {
    Stream *s = &c->o->in;
    for (int i = 0; i < c->o->motion->skeleton.nchannels; i++) {
        if (stream_space(s) && !stream_ended(s)) {
            if (c->lines.current) end_line(&c->lines);
            c->lines.start = stream_mark(s);
        }
        if (i == 0) source_mark(c->o->source, c->frame, stream_mark(s));
        NumberResult r = stream_number(s, &c->row[i]);
        if (r == NUMBER_END || r == NUMBER_CUT) {
            c->cut = i > 0 || r == NUMBER_CUT;
            return false;
        }
        if (r > NUMBER_GLUED) return refuse_value(c, r, i, e);
        if (r == NUMBER_GLUED && !c->glued) {
            c->glued = true;
            stream_note(s, c->o->notes, "no blank between two numbers, split at the sign");
        }
        c->lines.current++;
    }
    return true;
}

/* Behind the last value that was read. Ends its line where that is complete: a line that the
   end of the file may have cut tells nothing. True if more values follow. */
static bool end_last_line(Scan *c) {
    Stream *s = &c->o->in;
    Lines *l = &c->lines;
    double x;
    bool more = false;
    while (l->lines == 0 && stream_blanks(s) && stream_number(s, &x) <= NUMBER_GLUED) more = true, l->current++;
    bool whole = stream_space(s) || c->frame == c->announced;
    if (l->current && (l->lines ? l->current == l->first : whole)) end_line(l);
    Mark here = stream_mark(s);
    more = stream_number(s, &x) <= NUMBER_GLUED || more;
    stream_seek(s, here);
    return more;
}

/* All values have been read, or the file has ended. If there are not as many frames as
   announced: do the lines show that head and motion do not belong together? */
static bool check_lines(Scan *c, bool more, Error *e) {
    Stream *s = &c->o->in;
    const Lines *l = &c->lines;
    int n = c->o->motion->skeleton.nchannels, k = l->first;
    if (k == 0 || (c->frame == c->announced && !more)) return true;
    if (k == n && l->odd_values) {
        stream_seek(s, l->odd);
        return stream_error(s, e, "a line of %d values for %d channels: head and motion differ", l->odd_values, n);
    }
    if (k == n || l->odd_values) return true;
    bool wrapped = k < n && n % k == 0 && l->lines > c->announced;
    bool several = k > n && k % n == 0 && !more;
    if (wrapped || several) return true;
    stream_seek(s, c->first);
    return stream_error(s, e, "lines of %d values for %d channels: head and motion are of different skeletons", k, n);
}

static void note_rest(Scan *c, bool more) {
    Stream *s = &c->o->in;
    Notes *notes = c->o->notes;
    int found = c->frame, announced = c->announced;
    if (c->cut) stream_note(s, notes, "the file ends within frame %d of %d, which is left out", found + 1, announced);
    else if (found < announced) stream_note(s, notes, "%d frames announced, but %d found", announced, found);
    else if (more) stream_note(s, notes, "values behind the %d announced frames, left out", announced);
    else if (!stream_ended(s)) stream_note(s, notes, "text behind the frames, left out");
}

static bool scan_frames(Opening *o, int announced, Error *e) {
    Stream *s = &o->in;
    Scan c = {.o = o, .announced = announced};
    if (!(c.row = ARENA_NEW(o->scratch, double, o->motion->skeleton.nchannels, e))) return false;
    stream_space(s);
    c.first = c.lines.start = stream_mark(s);
    for (; c.frame < announced && scan_frame(&c, e); c.frame++) source_sample(o, c.frame, c.row);
    if (e->kind != ERR_NONE || !stream_sound(s, e)) return false;
    bool more = end_last_line(&c);
    if (!check_lines(&c, more, e)) return false;
    if (c.frame == 0) return stream_error(s, e, "the file ends before the first frame is complete");
    note_rest(&c, more);
    o->source->nframes = c.frame;
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
