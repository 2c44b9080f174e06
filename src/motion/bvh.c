/* The motion of a BVH file (MOTION): the number of frames, the time of a frame, and a stream of numbers, one for
   each channel and frame. Real files break the rules in many small ways: fewer frames than announced, or more, lines
   that are wrapped, a last line that is cut. What can be understood is read, with a warning where numbers might be
   lost. */
#include <limits.h>

#include "motion/source.h"

/* Takes a key of one or two words, in any case, and a colon with any blanks round them: `Frames:\t174`. False, and
   nothing taken, if something else stands there. */
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

/* How many values stand on each line. Values are read as a stream, whatever the lines. Only if there are more or fewer
   frames than announced, lines tell whether the motion belongs to another skeleton. */
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
             bvh_channels[j->channel[column - j->first_channel]]);
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

/* After the last value that was read: ends its line if that is complete, which a line that the end of the file may have
   cut is not. Returns whether more values follow. */
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

/* After all values: if there are not as many frames as announced, do the lines show that head and motion do not belong
   together? False with an error if so. */
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
    return bvh_head(o, e) && read_counts(o, &frames, e) && scan_frames(o, frames, e);
}

bool bvh_row(Stream *s, const MotionSource *source, double *row, Error *e) {
    for (int i = 0; i < source->skeleton.nchannels; i++)
        if (stream_number(s, &row[i]) > NUMBER_GLUED)
            return stream_sound(s, e) && error_set(e, ERR_INPUT, "'%s' has changed since it was opened", source->name);
    return true;
}
