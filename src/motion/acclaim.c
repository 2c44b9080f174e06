/* AMC, the motion of an Acclaim pair: a frame is its number on a line, then a line for each
   bone with its name and values. Their meaning stands in the ASF file. */
#include <math.h>
#include <string.h>

#include "motion/source.h"

typedef enum {
    FRAME_READ,
    FRAME_NONE, /* the file ends in front of it */
    FRAME_CUT,  /* the file ends within it */
    FRAME_WRONG,
} FrameResult;

static Word peek(Stream *s) {
    Word w = stream_peek(s);
    while (w.length && *w.start == '#') {
        stream_skip_line(s);
        w = stream_peek(s);
    }
    return w;
}

/* A word of digits only, where a bone's name could stand. Whether it begins its line tells nothing more: a bone takes
   all the values of its own. */
static bool is_frame_number(Word w) {
    if (w.length == 0 || w.length > 9) return false;
    for (int i = 0; i < w.length; i++)
        if (w.start[i] < '0' || w.start[i] > '9') return false;
    return true;
}

static bool reaches_end(const Stream *s, Word w) { return s->last && w.start + w.length == s->end; }

/* The values of one bone go to its joint's channels. */
static FrameResult read_bone(Stream *s, const MotionSource *source, int frame, double *row, Error *e) {
    const Acclaim *a = source->acclaim;
    Word w = peek(s);
    int index = asf_bone(a, w), n = error_shown(w.length);
    if (index < 0) {
        if (reaches_end(s, w)) return FRAME_CUT;
        stream_error(s, e, "frame %d: the skeleton '%.120s' has no bone '%.*s'", frame, a->asf, n, w.start);
        return FRAME_WRONG;
    }
    const Bone *b = &a->bone[index];
    const Joint *j = &source->skeleton.joint[b->joint];
    if (j->nchannels && !isnan(row[j->first_channel])) {
        stream_error(s, e, "frame %d has bone '%.60s' twice", frame, b->name);
        return FRAME_WRONG;
    }
    stream_word(s);
    for (int i = 0; i < b->ndof; i++) {
        double v;
        bool there = stream_blanks(s) && *s->at != '#';
        if (stream_ended(s)) return FRAME_CUT;
        if (!there) {
            stream_error(s, e, "frame %d: %d values for the %d of bone '%.60s'", frame, i, b->ndof, b->name);
            return FRAME_WRONG;
        }
        NumberResult r = stream_number(s, &v);
        if (r == NUMBER_CUT) return FRAME_CUT;
        if (r > NUMBER_GLUED) {
            char what[128];
            snprintf(what, sizeof what, "frame %d, bone '%.60s', value %d", frame, b->name, i + 1);
            stream_refuse(s, r, what, e);
            return FRAME_WRONG;
        }
        bool angle = b->dof[i] >= CHANNEL_RX && b->dof[i] <= CHANNEL_RZ;
        if (b->slot[i] >= 0) row[j->first_channel + b->slot[i]] = angle ? v * a->degrees : v;
    }
    if (!stream_blanks(s) || *s->at == '#') return FRAME_READ;
    stream_error(s, e, "frame %d: more than the %d values of bone '%.60s'", frame, b->ndof, b->name);
    return FRAME_WRONG;
}

/* A bone without values rests if it had none in the first frame either: some files leave out fingers and toes. */
static FrameResult check_complete(Stream *s, const MotionSource *source, int frame, double *row, Error *e) {
    const Skeleton *k = &source->skeleton;
    for (int i = 0; i < k->njoints; i++) {
        const Joint *j = &k->joint[i];
        if (j->nchannels == 0 || !isnan(row[j->first_channel])) continue;
        if (!source->acclaim->rests[i]) {
            if (stream_ended(s)) return FRAME_CUT;
            stream_error(s, e, "frame %d has no values for bone '%.60s'", frame, j->name);
            return FRAME_WRONG;
        }
        for (int c = 0; c < j->nchannels; c++) row[j->first_channel + c] = 0;
    }
    return FRAME_READ;
}

/* Which bones but the root does the first frame leave out? */
static void find_resting(Opening *o, const double *row) {
    const Skeleton *k = &o->source->skeleton;
    const char *first = NULL;
    int others = -1;
    for (int i = 1; i < k->njoints; i++) {
        const Joint *j = &k->joint[i];
        if (j->nchannels == 0 || !isnan(row[j->first_channel])) continue;
        o->source->acclaim->rests[i] = true;
        if (!first) first = j->name;
        others++;
    }
    if (others == 0) stream_note(&o->in, o->notes, "no values for bone '%.60s', which rests", first);
    if (others > 0) stream_note(&o->in, o->notes, "no values for bone '%.60s' and %d more, which rest", first, others);
}

/* Reads the frame whose number stands at s. Values that it does not have are marked by NaN, which no file can hold. */
static FrameResult read_frame(Stream *s, const MotionSource *source, int *number, double *row, Error *e) {
    Word w = peek(s);
    if (w.length == 0) return FRAME_NONE;
    if (!is_frame_number(w)) {
        stream_error(s, e, "expected the number of a frame, found '%.*s'", error_shown(w.length), w.start);
        return FRAME_WRONG;
    }
    *number = 0;
    for (int i = 0; i < w.length; i++) *number = *number * 10 + (w.start[i] - '0');
    stream_word(s);
    for (int i = 0; i < source->skeleton.nchannels; i++) row[i] = NAN;
    for (;;) {
        w = peek(s);
        if (w.length == 0 || is_frame_number(w)) break;
        FrameResult r = read_bone(s, source, *number, row, e);
        if (r != FRAME_READ) return r;
    }
    return FRAME_READ;
}

/* Any text that begins with '#' is taken for an AMC file at first. So before its skeleton is looked for, it must look
   like one. */
static bool no_motion(Stream *s, Word w, Error *e) {
    int n = error_shown(w.length);
    return stream_error(s, e, "neither BVH nor Acclaim AMC: found '%.*s'", n, w.start);
}

/* The value of :SAMPLES-PER-SECOND, which few files have. */
static bool read_rate(Opening *o, Error *e) {
    Stream *s = &o->in;
    double rate = 0;
    if (!stream_blanks(s)) return true;
    Mark start = stream_mark(s);
    NumberResult r = stream_number(s, &rate);
    if (r > NUMBER_GLUED && !(o->options->fps > 0)) return stream_refuse(s, r, "the samples a second", e);
    stream_seek(s, start);
    return source_rate(o, rate > 0 ? 1 / rate : 0, e);
}

/* Comments and keywords in front of the frames. */
static bool read_head(Opening *o, double *degrees, Error *e) {
    static const char *const asf_words[] = {":version", ":name", ":units", ":root", ":bonedata", ":hierarchy"};
    Stream *s = &o->in;
    for (bool keyword = false;;) {
        Word w = peek(s);
        if (w.length == 0 || is_frame_number(w)) return true;
        if (*w.start != ':') return keyword || no_motion(s, w, e);
        keyword = true;
        for (size_t i = 0; i < sizeof asf_words / sizeof *asf_words; i++)
            if (word_is(w, asf_words[i]))
                return stream_error(s, e, "this is an ASF skeleton without a motion; name the AMC file");
        if (word_is(w, ":RADIANS")) *degrees = 180 / PI;
        if (word_is(w, ":DEGREES")) *degrees = 1;
        if (word_is(w, ":SAMPLES-PER-SECOND")) {
            stream_word(s);
            if (!read_rate(o, e)) return false;
        }
        stream_skip_line(s);
    }
}

static bool scan_frames(Opening *o, Error *e) {
    Stream *s = &o->in;
    MotionSource *source = o->source;
    double *row = ARENA_NEW(o->scratch, double, source->skeleton.nchannels, e);
    if (!row) return false;
    bool gap_told = false;
    for (int previous = 0, number = 0;; previous = number, source->nframes++) {
        peek(s);
        Mark start = stream_mark(s);
        source_mark(source, source->nframes, start);
        FrameResult r = read_frame(s, source, &number, row, e);
        if (r == FRAME_READ && source->nframes == 0 && !stream_ended(s)) find_resting(o, row);
        if (r == FRAME_READ) r = check_complete(s, source, number, row, e);
        if (r == FRAME_WRONG || !stream_sound(s, e)) return false;
        if (r == FRAME_NONE) return true;
        if (r == FRAME_CUT) {
            stream_note(s, o->notes, "the file ends within frame %d, which is left out", number);
            return true;
        }
        if (source->nframes == o->max_frames)
            return stream_error(s, e, "more than the limit of %d frames", o->max_frames);
        if (source->nframes && number != previous + 1 && !gap_told) {
            gap_told = true;
            Mark here = stream_mark(s);
            stream_seek(s, start);
            stream_note(s, o->notes, "frame %d follows frame %d", number, previous);
            stream_seek(s, here);
        }
        source_sample(o, source->nframes, row);
    }
}

bool acclaim_open(Opening *o, Error *e) {
    const char *asf = o->options->asf;
    double degrees = 0;
    o->motion->format = "ASF/AMC";
    Acclaim *a = ARENA_NEW(o->arena, Acclaim, 1, e);
    if (!a || !read_head(o, &degrees, e) || (!asf && !asf_find(o, &asf, e)) || !asf_read(o, asf, a, e)) return false;
    if (degrees > 0) a->degrees = degrees;
    if (!(a->rests = ARENA_NEW(o->arena, bool, o->motion->skeleton.njoints, e))) return false;
    o->source->acclaim = a;
    o->source->skeleton = o->motion->skeleton;
    if (o->options->fps > 0 && !source_rate(o, 0, e)) return false;
    return scan_frames(o, e);
}

bool acclaim_row(Stream *s, const MotionSource *source, double *row, Error *e) {
    int number;
    FrameResult r = read_frame(s, source, &number, row, e);
    if (r == FRAME_READ && check_complete(s, source, number, row, e) == FRAME_READ) return true;
    return stream_sound(s, e) && error_set(e, ERR_INPUT, "'%s' has changed since it was opened", source->name);
}
