/* The head of a BVH file (HIERARCHY): joints in nested braces, each with its OFFSET and CHANNELS. It is read without
   recursion: the open joint and its parents are the stack. Names, cases and orders vary a lot in real files; what
   can be understood is read. */
#include <string.h>

#include "motion/source.h"

enum { NESTING_MAX = 1000, NAME_MAX_BYTES = 1000 };

const char *const bvh_channels[CHANNEL_KINDS] = {"Xposition", "Yposition", "Zposition", "Xrotation", "Yrotation",
                                                 "Zrotation", "Xscale",    "Yscale",    "Zscale"};

typedef struct {
    bool offset, channels;
} Seen;

/* The head while it is read. */
typedef struct {
    Opening *o;
    Joint *joint;
    int njoints, joint_capacity, seen_capacity;
    int open, depth;      /* the joint whose brace is open, -1 for none; braces open */
    Seen *seen;           /* per joint */
    bool await_brace;     /* a joint was named, and its '{' must follow */
    bool scaled, turned;  /* seen: a scale channel; an OFFSET of more than three numbers */
} Head;

static const char *joint_name(const Head *h, int i) { return h->joint[i].name; }

static bool grow(Head *h, Error *e) {
    Joint *joint = ARENA_GROW(h->o->scratch, Joint, h->joint, h->njoints, &h->joint_capacity, e);
    Seen *seen = ARENA_GROW(h->o->scratch, Seen, h->seen, h->njoints, &h->seen_capacity, e);
    if (!joint || !seen) return false;
    h->joint = joint;
    h->seen = seen;
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

/* `End Site`, in any case, with or without a name of its own, which is not used. */
static bool read_end(Head *h, Error *e) {
    Stream *s = &h->o->in;
    if (h->open < 0) return stream_error(s, e, "End Site outside of a ROOT");
    rest_of_line(s);
    const char *name = source_end_name(h->o, joint_name(h, h->open), e);
    return name && add_joint(h, name, true, e);
}

/* Some exporters write the joint's rotation at rest behind its place. The channels tell the whole rotation all the
   same, so it is left out. */
static void skip_rotation(Head *h) {
    Stream *s = &h->o->in;
    double v;
    while (stream_blanks(s)) {
        Mark fourth = stream_mark(s);
        if (stream_number(s, &v) > NUMBER_GLUED) return;
        if (h->turned) continue;
        h->turned = true;
        stream_seek(s, fourth);
        stream_note(s, h->o->notes, "OFFSETs of more than three numbers: the first three are read");
    }
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
    skip_rotation(h);
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
    int most = j->is_end ? 0 : CHANNEL_KINDS;
    if (!(count >= 0 && count <= most) || count != (int)count)
        return stream_error(s, e, "%.0f CHANNELS: %s", count,
                            j->is_end ? "an End Site has none" : "a joint has 0 to 9");
    for (; j->nchannels < (int)count; j->nchannels++) {
        Word w = stream_peek(s);
        int kind = 0;
        while (kind < CHANNEL_KINDS && !word_is(w, bvh_channels[kind])) kind++;
        if (kind == CHANNEL_KINDS)
            return stream_error(s, e, "expected Xposition .. Zposition or Xrotation .. Zrotation, found '%.*s'",
                                error_shown(w.length), w.start);
        if (kind >= CHANNEL_SX && !h->scaled) {
            h->scaled = true;
            stream_note(s, h->o->notes, "scale channels, left out");
        }
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

/* The keywords of the head. inside: may stand only within a joint's braces; in_end: also in those of an end site. */
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

bool bvh_head(Opening *o, Error *e) {
    Head h = {.o = o, .open = -1};
    stream_word(&o->in); /* HIERARCHY */
    while (!word_is(stream_peek(&o->in), "MOTION") || h.await_brace)
        if (!read_item(&h, e)) return false;
    if (h.depth) return stream_error(&o->in, e, "MOTION before the '}' of joint '%.60s'", joint_name(&h, h.open));
    if (!h.njoints) return stream_error(&o->in, e, "no ROOT before MOTION");
    stream_word(&o->in);
    return source_skeleton(o, h.joint, h.njoints, e);
}
