/* Motion files, whatever their format. A file is read once when it is opened, to know that
   every number in it is one, how many frames there are and where some of them start. Rows
   are read again when they are asked for: memory does not grow with the number of frames. */
#include "motion/motion.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "motion/source.h"

enum { JOINTS_DEFAULT = 10000, FRAMES_DEFAULT = 100000000, STRIDE_FIRST = 16 };

/* Frame times outside are none: --fps takes 0.001 to 100000 frames a second too. */
static const double frame_time_least = 1e-5, frame_time_most = 1000;

/* Frame times outside are suspected to be a mistake: 480 and 5 frames per second. */
static const double frame_time_low = 1.0 / 480, frame_time_high = 1.0 / 5;

static bool refuse_binary(const char *name, Error *e) {
    return error_set(e, ERR_INPUT, "'%s' is a binary file or UTF-16, not plain text", name);
}

/* Copies what cannot be read by position (standard input, a pipe) to a file without a name. */
static bool spool(int from, const char *name, int *fd, Error *e) {
    FILE *f = tmpfile();
    if (!f) return error_set(e, ERR_OUTPUT, "cannot make a temporary file for '%s': %s", name, strerror(errno));
    char block[1 << 14];
    ssize_t n;
    while ((n = read(from, block, sizeof block)) != 0) {
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) error_set(e, ERR_INPUT, "cannot read '%s': %s", name, strerror(errno));
        else if (memchr(block, 0, (size_t)n)) refuse_binary(name, e);
        else if (fwrite(block, 1, (size_t)n, f) != (size_t)n)
            error_set(e, ERR_OUTPUT, "cannot keep '%s' in a temporary file: %s", name, strerror(errno));
        else continue;
        break;
    }
    if (e->kind == ERR_NONE && fflush(f) != 0)
        error_set(e, ERR_OUTPUT, "cannot keep '%s' in a temporary file: %s", name, strerror(errno));
    if (e->kind == ERR_NONE && (*fd = dup(fileno(f))) < 0)
        error_set(e, ERR_OUTPUT, "cannot keep '%s' open: %s", name, strerror(errno));
    fclose(f);
    return e->kind == ERR_NONE;
}

static bool check_text(int fd, const char *name, Error *e) {
    char start[512];
    ssize_t n = pread(fd, start, sizeof start, 0);
    if (n < 0) return error_set(e, ERR_INPUT, "cannot read '%s': %s", name, strerror(errno));
    if (n == 0) return error_set(e, ERR_INPUT, "'%s' is empty", name);
    if (memchr(start, 0, (size_t)n)) return refuse_binary(name, e);
    return true;
}

bool source_file(const char *path, int *fd, Error *e) {
    bool standard = strcmp(path, "-") == 0;
    const char *name = standard ? "<stdin>" : path;
    int from = standard ? STDIN_FILENO : open(path, O_RDONLY | O_CLOEXEC);
    struct stat info;
    if (from < 0 || fstat(from, &info) != 0) {
        error_set(e, ERR_INPUT, "cannot open '%s': %s", name, strerror(errno));
        if (from >= 0 && !standard) close(from);
        return false;
    }
    if (S_ISREG(info.st_mode) && !standard) {
        *fd = from;
        return check_text(*fd, name, e);
    }
    bool good = S_ISDIR(info.st_mode) ? error_set(e, ERR_INPUT, "cannot read '%s': it is a directory", name)
                                      : spool(from, name, fd, e);
    if (!standard) close(from);
    return good && check_text(*fd, name, e);
}

static bool file_state(MotionSource *s, Error *e) {
    struct stat info;
    if (fstat(s->fd, &info) != 0) return error_set(e, ERR_INPUT, "cannot read '%s': %s", s->name, strerror(errno));
    s->size = (long long)info.st_size;
    s->changed_s = (long long)info.st_mtim.tv_sec;
    s->changed_ns = (long long)info.st_mtim.tv_nsec;
    return true;
}

typedef struct {
    const char *name;
    int index;
} Named;

static int by_name(const void *a, const void *b) {
    const Named *x = a, *y = b;
    int order = strcmp(x->name, y->name);
    return order ? order : (x->index > y->index) - (x->index < y->index);
}

static bool note_twins(Opening *o, Error *e) {
    const Skeleton *s = &o->motion->skeleton;
    Named *named = ARENA_NEW(o->scratch, Named, s->njoints, e);
    if (!named) return false;
    int n = 0;
    for (int i = 0; i < s->njoints; i++)
        if (!s->joint[i].is_end) named[n++] = (Named){s->joint[i].name, i};
    qsort(named, (size_t)n, sizeof *named, by_name);
    for (int i = 1; i < n; i++)
        if (strcmp(named[i - 1].name, named[i].name) == 0 && (i < 2 || strcmp(named[i - 2].name, named[i].name) != 0))
            notes_add(o->notes, (Place){.file = o->in.name}, "joint name '%s' occurs more than once", named[i].name);
    return true;
}

const char *source_end_name(Opening *o, const char *parent, Error *e) {
    size_t n = strlen(parent) + sizeof "_End";
    char *name = ARENA_NEW(o->arena, char, n, e);
    if (name) snprintf(name, n, "%s_End", parent);
    return name;
}

bool source_skeleton(Opening *o, const Joint *joint, int njoints, Error *e) {
    Skeleton *s = &o->motion->skeleton;
    if (!(s->joint = ARENA_NEW(o->arena, Joint, njoints, e))) return false;
    memcpy(s->joint, joint, (size_t)njoints * sizeof *joint);
    s->njoints = njoints;
    for (int i = 0; i < njoints; i++) {
        s->joint[i].first_channel = s->nchannels;
        s->nchannels += joint[i].nchannels;
    }
    if (s->nchannels == 0) return error_set(e, ERR_INPUT, "no joint of '%s' has a channel", o->in.name);
    return note_twins(o, e) && positions_start(s, o->scratch, &o->positions, e);
}

void source_mark(MotionSource *s, int frame, Mark mark) {
    if (frame % s->stride != 0) return;
    if (s->nmarks == MARKS_MAX) {
        for (int i = 0; i < MARKS_MAX / 2; i++) s->mark[i] = s->mark[2 * i];
        s->nmarks /= 2;
        s->stride *= 2;
        if (frame % s->stride != 0) return;
    }
    s->mark[s->nmarks++] = mark;
}

void source_sample(Opening *o, int frame, const double *row) { positions_add(o->positions, frame, row); }

bool source_rate(Opening *o, double frame_time, Error *e) {
    Motion *m = o->motion;
    m->has_frame_time = true;
    if (o->options->fps > 0) {
        m->frame_time = 1 / o->options->fps;
        return true;
    }
    if (!(frame_time > 0)) return stream_error(&o->in, e, "frame time is not positive; give the rate with --fps");
    if (!(frame_time >= frame_time_least && frame_time <= frame_time_most))
        return stream_error(&o->in, e, "frame time of %g seconds is not between %g and %g; give the rate with --fps",
                            frame_time, frame_time_least, frame_time_most);
    if (frame_time < frame_time_low * 0.999 || frame_time > frame_time_high * 1.001)
        stream_note(&o->in, o->notes, "unlikely frame time of %g seconds (%g frames per second); --fps overrides it",
                    frame_time, 1 / frame_time);
    m->frame_time = frame_time;
    return true;
}

/* A BVH file starts with HIERARCHY. An AMC file starts with comments (#), keywords (:) or
   its first frame number; an ASF file looks the same up to its keywords. */
static bool read_format(Opening *o, Error *e) {
    Stream *s = &o->in;
    stream_space(s);
    if (stream_ended(s)) return error_set(e, ERR_INPUT, "'%s' is empty", s->name);
    Word w = stream_peek(s);
    if (word_is(w, "HIERARCHY")) return bvh_open(o, e);
    if (*w.start == '#' || *w.start == ':' || (*w.start >= '0' && *w.start <= '9')) return acclaim_open(o, e);
    int n = error_shown(w.length);
    return stream_error(s, e, "neither BVH nor Acclaim AMC: starts with '%.*s'", n, w.start);
}

static bool finish(Opening *o, Error *e) {
    Motion *m = o->motion;
    m->nframes = o->source->nframes;
    if (m->nframes < 1) return error_set(e, ERR_INPUT, "no complete frame in '%s'", o->in.name);
    PositionRule rule = o->options->position;
    m->skeleton.position_adds = rule == POSITION_ADD || (rule == POSITION_GUESS && positions_are_deltas(o->positions));
    m->skeleton.points = positions_are_all(o->positions);
    if (m->skeleton.points && !m->skeleton.position_adds) positions_fill_offsets(o->positions, &m->skeleton);
    o->source->skeleton = m->skeleton;
    return stream_sound(&o->in, e) && file_state(o->source, e);
}

bool motion_open(const char *path, const MotionOptions *options, Arena *arena, Notes *notes, Motion *out, Error *e) {
    *out = (Motion){.path = path, .frame_time = 1.0 / 120};
    MotionSource *source = ARENA_NEW(arena, MotionSource, 1, e);
    if (!source) return false;
    *source = (MotionSource){.fd = -1, .name = strcmp(path, "-") == 0 ? "<stdin>" : path, .stride = STRIDE_FIRST};
    out->source = source;
    if (!(source->mark = ARENA_NEW(arena, Mark, MARKS_MAX, e))) return false;
    Arena scratch = {.limit = arena->limit};
    Opening o = {.options = options, .arena = arena, .scratch = &scratch, .notes = notes, .motion = out,
                 .source = source};
    o.max_joints = options->max_joints > 0 ? options->max_joints : JOINTS_DEFAULT;
    o.max_frames = options->max_frames > 0 ? options->max_frames : FRAMES_DEFAULT;
    out->max_frames = o.max_frames;
    bool good = source_file(path, &source->fd, e) && stream_open(&o.in, source->fd, source->name, &scratch, e) &&
                read_format(&o, e) && finish(&o, e);
    arena_free(&scratch);
    return good;
}

void motion_close(Motion *m) {
    if (m->source && m->source->fd >= 0) close(m->source->fd);
    m->source = NULL;
}

struct MotionReader {
    Stream in;
    const MotionSource *source;
    int next; /* the frame at which the stream stands */
};

/* The descriptor is the motion's: it is read by position only, so readers do not disturb
   each other, and the file may be renamed or deleted meanwhile. */
bool motion_reader_open(const Motion *m, Arena *arena, MotionReader **out, Error *e) {
    MotionReader *r = *out = ARENA_NEW(arena, MotionReader, 1, e);
    if (!r) return false;
    r->source = m->source;
    r->next = m->nframes;
    return stream_open(&r->in, m->source->fd, m->source->name, arena, e);
}

void motion_reader_close(MotionReader *r) {
    if (r) r->source = NULL;
}

static bool unchanged(const MotionSource *s, Error *e) {
    MotionSource now = *s;
    if (!file_state(&now, e)) return false;
    if (now.size == s->size && now.changed_s == s->changed_s && now.changed_ns == s->changed_ns) return true;
    return error_set(e, ERR_INPUT, "'%s' has changed since it was opened", s->name);
}

static bool read_row(MotionReader *r, double *row, Error *e) {
    const MotionSource *s = r->source;
    bool good = s->acclaim ? acclaim_row(&r->in, s, row, e) : bvh_row(&r->in, s, row, e);
    r->next = good ? r->next + 1 : s->nframes;
    return good;
}

bool motion_row(MotionReader *r, int frame, double *row, Error *e) {
    const MotionSource *s = r->source;
    if (frame < 0 || frame >= s->nframes) return error_set(e, ERR_INTERNAL, "frame %d of %d", frame, s->nframes);
    int from = frame / s->stride;
    if (r->next > frame || r->next < from * s->stride) {
        if (!unchanged(s, e)) return false;
        stream_seek(&r->in, s->mark[from]);
        r->next = from * s->stride;
    }
    while (r->next <= frame)
        if (!read_row(r, row, e)) return false;
    return true;
}
