/* ASF, the skeleton of an Acclaim pair. It describes bones, where BVH describes joints: each bone has a direction
   and a length in the rest pose and begins where its parent ends. So a bone becomes the joint at its beginning, the
   OFFSET of a joint is its parent's bone, and a leaf gets an end site. The rotations D of a bone are given in its
   own frame, which is turned by C, its `axis`: R = C D C^-1. An order XYZ says that x is turned first, as a product
   of matrices Rz Ry Rx. What a bone turns first its `axis` says; the root has an `order` of its own for that
   (M. Schafer, Acclaim Skeleton File Definition V1.10, 1995). */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "motion/source.h"

enum { NAME_MAX_BYTES = 1000, AXES = 3 };

/* A bone as the file has it, and its place in the tree. */
typedef struct {
    Bone bone;
    Vec3 direction, angles;
    double length;
    char order[AXES + 1];
    int parent, first_child, last_child, next; /* -1: none */
    int joint;                                 /* its index in the skeleton; -1: not there yet */
    Mark place;                                /* of its name, or of its beginning */
} Part;

typedef struct {
    Opening *o;
    Stream in;
    Acclaim *acclaim;
    Part *part; /* part[0] is the root */
    int nparts, capacity;
    double degrees; /* per unit of angle in this file */
    bool linked;    /* the hierarchy has begun */
} Asf;

static bool refuse_word(Asf *a, Word w, const char *wanted, Error *e) {
    if (!w.length) return stream_error(&a->in, e, "the file ends where %s is expected", wanted);
    return stream_error(&a->in, e, "expected %s, found '%.*s'", wanted, error_shown(w.length), w.start);
}

static bool read_vector(Asf *a, const char *what, Vec3 *out, Error *e) {
    double v[3];
    for (int i = 0; i < 3; i++) {
        NumberResult r = stream_number(&a->in, &v[i]);
        if (r > NUMBER_GLUED) return stream_refuse(&a->in, r, what, e);
    }
    *out = vec(v[0], v[1], v[2]);
    return true;
}

static bool read_scalar(Asf *a, const char *what, double *out, Error *e) {
    NumberResult r = stream_number(&a->in, out);
    return r <= NUMBER_GLUED || stream_refuse(&a->in, r, what, e);
}

/* XYZ in any order. */
static bool read_order(Asf *a, char order[AXES + 1], Error *e) {
    Word w = stream_peek(&a->in);
    bool good = w.length == 3;
    for (int i = 0; i < 3 && good; i++) {
        order[i] = (char)(w.start[i] & ~32);
        good = order[i] >= 'X' && order[i] <= 'Z' && !memchr(order, order[i], (size_t)i);
    }
    if (!good) return refuse_word(a, w, "an order such as XYZ", e);
    stream_word(&a->in);
    return true;
}

/* The rest of the line: tx ty tz rx ry rz or l, each at most once. */
static bool read_dof(Asf *a, Bone *b, Error *e) {
    static const char *const names[DOF_MAX] = {"tx", "ty", "tz", "rx", "ry", "rz", [DOF_LENGTH] = "l"};
    while (stream_blanks(&a->in) && *a->in.at != '#') {
        Word w = stream_peek(&a->in);
        int kind = 0;
        while (kind < DOF_MAX && !word_is(w, names[kind])) kind++;
        if (kind == DOF_MAX) return refuse_word(a, w, "tx ty tz rx ry rz or l", e);
        for (int i = 0; i < b->ndof; i++)
            if (b->dof[i] == kind) return refuse_word(a, w, "another degree of freedom", e);
        b->dof[b->ndof++] = kind;
        stream_word(&a->in);
    }
    return true;
}

static Part *add_part(Asf *a, Error *e) {
    if (a->nparts > a->o->max_joints) {
        stream_error(&a->in, e, "more than %d bones", a->o->max_joints);
        return NULL;
    }
    Part *part = ARENA_GROW(a->o->scratch, Part, a->part, a->nparts, &a->capacity, e);
    if (!part) return NULL;
    a->part = part;
    Part *p = &a->part[a->nparts++];
    *p = (Part){.order = "XYZ", .parent = -1, .first_child = -1, .last_child = -1, .next = -1, .joint = -1};
    p->place = stream_mark(&a->in);
    return p;
}

static bool read_units(Asf *a, Error *e) {
    Word w = stream_word(&a->in);
    double value = 0;
    if (word_is(w, "length")) {
        if (!read_scalar(a, "the unit of length", &value, e)) return false;
        /* 0.45 means: one unit is 1/0.45 inch. 1 is what exporters write that do not know. */
        if (value > 0 && value != 1) a->o->motion->file_unit = 0.0254 / value;
    } else if (word_is(w, "angle")) {
        w = stream_peek(&a->in);
        if (word_is(w, "rad")) a->degrees = 180 / PI;
        else if (!word_is(w, "deg")) return refuse_word(a, w, "deg or rad", e);
    }
    stream_skip_line(&a->in);
    return true;
}

static bool read_root(Asf *a, Error *e) {
    Part *p = &a->part[0];
    Word w = stream_word(&a->in);
    if (word_is(w, "order")) return read_dof(a, &p->bone, e);
    if (word_is(w, "axis")) return read_order(a, p->order, e);
    if (word_is(w, "position")) return read_vector(a, "the root's position", &p->direction, e);
    if (word_is(w, "orientation")) return read_vector(a, "the root's orientation", &p->angles, e);
    stream_skip_line(&a->in);
    return true;
}

static bool take_name(Asf *a, Part *p, Error *e) {
    Bone *b = &p->bone;
    Word w = stream_peek(&a->in);
    p->place = stream_mark(&a->in);
    if (!w.length || w.first) return refuse_word(a, w, "a bone's name", e);
    if (w.length > NAME_MAX_BYTES) return stream_error(&a->in, e, "bone name of more than %d bytes", NAME_MAX_BYTES);
    b->name = arena_text(a->o->arena, w.start, (size_t)w.length, e);
    stream_word(&a->in);
    return b->name != NULL;
}

/* A line within bonedata: of the last bone, or `begin` for another. */
static bool read_bone(Asf *a, Error *e) {
    Word w = stream_peek(&a->in);
    if (word_is(w, "begin")) {
        if (!add_part(a, e)) return false;
        stream_word(&a->in);
        return true;
    }
    if (a->nparts < 2) return refuse_word(a, w, "'begin'", e);
    Part *p = &a->part[a->nparts - 1];
    if (word_is(w, "end") && !p->bone.name) return stream_error(&a->in, e, "a bone without a name");
    w = stream_word(&a->in);
    if (word_is(w, "name")) return take_name(a, p, e);
    if (word_is(w, "direction")) return read_vector(a, "the bone's direction", &p->direction, e);
    if (word_is(w, "length")) return read_scalar(a, "the bone's length", &p->length, e);
    if (word_is(w, "axis")) return read_vector(a, "the bone's axis", &p->angles, e) && read_order(a, p->order, e);
    if (word_is(w, "dof")) return read_dof(a, &p->bone, e);
    stream_skip_line(&a->in); /* id, limits and their further lines, masses, end */
    return true;
}

static int by_name(const void *x, const void *y) {
    const Bone *a = x, *b = y;
    return strcmp(a->name, b->name);
}

int asf_bone(const Acclaim *a, Word name) {
    int low = 0, high = a->nbones;
    while (low < high) {
        int mid = (low + high) / 2, order = strncmp(a->bone[mid].name, name.start, (size_t)name.length);
        if (order == 0 && a->bone[mid].name[name.length]) order = 1;
        if (order == 0) return mid;
        if (order < 0) low = mid + 1;
        else high = mid;
    }
    return -1;
}

/* Goes back to where part i is named, for an error there. */
static Stream *at_part(Asf *a, int i) {
    stream_seek(&a->in, a->part[i].place);
    return &a->in;
}

static bool is_named(Asf *a, int i, Error *e) {
    return a->part[i].bone.name || stream_error(at_part(a, i), e, "a bone without a name");
}

/* Called when all bones are known: sorts them by name. Until the tree is built, Bone.joint is the index of the part. */
static bool sort_bones(Asf *a, Error *e) {
    Acclaim *k = a->acclaim;
    if (!(k->bone = ARENA_NEW(a->o->arena, Bone, a->nparts, e))) return false;
    for (k->nbones = 0; k->nbones < a->nparts; k->nbones++) {
        Bone *b = &a->part[k->nbones].bone;
        if (!is_named(a, k->nbones, e)) return false;
        b->joint = k->nbones;
        k->bone[k->nbones] = *b;
    }
    qsort(k->bone, (size_t)k->nbones, sizeof *k->bone, by_name);
    for (int i = 1; i < k->nbones; i++)
        if (by_name(&k->bone[i - 1], &k->bone[i]) == 0) {
            int one = k->bone[i - 1].joint, other = k->bone[i].joint;
            return stream_error(at_part(a, one > other ? one : other), e, "two bones are named '%.60s'",
                                k->bone[i].name);
        }
    a->linked = true;
    return true;
}

static bool find_part(Asf *a, int *out, Error *e) {
    Word w = stream_peek(&a->in);
    int i = asf_bone(a->acclaim, w);
    if (i < 0) return refuse_word(a, w, "the name of a bone", e);
    *out = a->acclaim->bone[i].joint;
    stream_word(&a->in);
    return true;
}

/* `parent child child ...` */
static bool read_children(Asf *a, Error *e) {
    Word w = stream_peek(&a->in);
    int parent = 0, child = 0;
    if (!a->linked && !sort_bones(a, e)) return false;
    if (word_is(w, "begin") || word_is(w, "end")) {
        stream_skip_line(&a->in);
        return true;
    }
    if (!find_part(a, &parent, e)) return false;
    Part *p = &a->part[parent];
    while (stream_blanks(&a->in) && *a->in.at != '#') {
        Mark here = stream_mark(&a->in);
        if (!find_part(a, &child, e)) return false;
        Part *c = &a->part[child];
        if (child == 0 || c->parent >= 0) {
            stream_seek(&a->in, here);
            return stream_error(&a->in, e, "bone '%.60s' cannot have a parent%s", c->bone.name, child ? " twice" : "");
        }
        c->parent = parent;
        if (p->last_child >= 0) a->part[p->last_child].next = child;
        else p->first_child = child;
        p->last_child = child;
    }
    return true;
}

static bool read_documentation(Asf *a, Error *e) {
    stream_skip_line(&a->in);
    return stream_sound(&a->in, e);
}

/* The sections, and what reads a line of each. Others are skipped. */
static const struct {
    const char *keyword;
    bool (*read)(Asf *a, Error *e);
} sections[] = {
    {":units", read_units}, {":root", read_root}, {":bonedata", read_bone}, {":hierarchy", read_children},
};

static bool read_sections(Asf *a, Error *e) {
    bool (*read)(Asf *, Error *) = NULL;
    for (;;) {
        Word w = stream_peek(&a->in);
        if (w.length == 0) return stream_sound(&a->in, e);
        if (*w.start == '#') {
            stream_skip_line(&a->in);
        } else if (*w.start == ':') {
            read = read_documentation;
            for (size_t i = 0; i < sizeof sections / sizeof *sections; i++)
                if (word_is(w, sections[i].keyword)) read = sections[i].read;
            if (read == read_documentation) stream_skip_line(&a->in);
            else stream_word(&a->in);
        } else if (!read) {
            return refuse_word(a, w, "a keyword such as :version", e);
        } else if (!read(a, e)) {
            return false;
        }
    }
}

/* The axes about which a part turns, the first one first. */
static void find_turns(const Part *p, bool is_root, char turns[AXES]) {
    int n = 0;
    for (int i = 0; is_root && i < p->bone.ndof; i++) {
        int kind = p->bone.dof[i];
        if (kind >= CHANNEL_RX && kind <= CHANNEL_RZ) turns[n++] = (char)('X' + (kind - CHANNEL_RX));
    }
    for (int i = 0; i < AXES; i++)
        if (!memchr(turns, p->order[i], (size_t)n)) turns[n++] = p->order[i];
}

/* Rotations and translations in the order of the product, and which value goes where. */
static void set_channels(Part *p, bool is_root, Joint *j) {
    Bone *b = &p->bone;
    char turns[AXES];
    int product[6] = {CHANNEL_TX, CHANNEL_TY, CHANNEL_TZ};
    find_turns(p, is_root, turns);
    for (int i = 0; i < 3; i++) product[3 + i] = CHANNEL_RX + (turns[2 - i] - 'X');
    for (int i = 0; i < b->ndof; i++) b->slot[i] = -1;
    for (int k = 0; k < 6; k++) {
        for (int i = 0; i < b->ndof; i++) {
            if (b->dof[i] != product[k]) continue;
            b->slot[i] = j->nchannels;
            j->channel[j->nchannels++] = (ChannelKind)product[k];
        }
    }
}

static void set_axis(const Asf *a, const Part *p, Joint *j) {
    static const Vec3 unit[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const double angle[3] = {p->angles.x, p->angles.y, p->angles.z};
    j->axis = mat_identity();
    for (int i = 2; i >= 0; i--) {
        int k = p->order[i] - 'X';
        j->axis = mat_mul(j->axis, mat_axis_angle(unit[k], angle[k] * a->degrees * (PI / 180)));
        j->has_axis |= angle[k] != 0;
    }
}

static bool add_end(Asf *a, const Part *p, Joint *out, Error *e) {
    const char *name = source_end_name(a->o, p->bone.name, e);
    if (!name) return false;
    *out = (Joint){.name = name, .parent = p->joint, .axis = mat_identity(), .is_end = true};
    out->offset = vec_scale(p->direction, p->length);
    return true;
}

/* Appends the joint of part i, and the end site of a leaf. */
static bool add_joint(Asf *a, int i, Joint *joint, int *njoints, Error *e) {
    Part *p = &a->part[i];
    Joint *j = &joint[*njoints];
    *j = (Joint){.name = p->bone.name, .parent = i ? a->part[p->parent].joint : -1};
    if (i == 0) j->offset = p->direction; /* the root's position; it has no length */
    else if (p->parent) j->offset = vec_scale(a->part[p->parent].direction, a->part[p->parent].length);
    set_channels(p, i == 0, j);
    set_axis(a, p, j);
    p->joint = (*njoints)++;
    return i == 0 || p->first_child >= 0 || add_end(a, p, &joint[(*njoints)++], e);
}

/* The part after i in a depth-first walk of the tree, children in the order of the file; -1 after the last. */
static int walk(const Asf *a, int i) {
    if (a->part[i].first_child >= 0) return a->part[i].first_child;
    while (i >= 0 && a->part[i].next < 0) i = a->part[i].parent;
    return i < 0 ? -1 : a->part[i].next;
}

static bool build_joints(Asf *a, Error *e) {
    Joint *joint = ARENA_NEW(a->o->scratch, Joint, 2 * a->nparts, e);
    int njoints = 0;
    if (!joint) return false;
    for (int i = 0; i >= 0; i = walk(a, i))
        if (!add_joint(a, i, joint, &njoints, e)) return false;
    for (int i = 0; i < a->nparts; i++)
        if (a->part[i].joint < 0) /* it may stand behind the hierarchy, and be told nothing of but `begin` */
            return is_named(a, i, e) && stream_error(at_part(a, i), e, "bone '%.60s' has no place in the hierarchy",
                                                     a->part[i].bone.name);
    for (int i = 0; i < a->acclaim->nbones; i++) {
        Bone *b = &a->acclaim->bone[i];
        const Part *p = &a->part[b->joint];
        *b = p->bone;
        b->joint = p->joint;
    }
    return source_skeleton(a->o, joint, njoints, e);
}

bool asf_read(Opening *o, const char *path, Acclaim *out, Error *e) {
    Asf a = {.o = o, .acclaim = out, .degrees = 1};
    int fd = -1;
    *out = (Acclaim){.asf = path};
    bool good = source_file(path, &fd, e) && stream_open(&a.in, fd, path, o->scratch, e) && add_part(&a, e);
    if (good) {
        a.part[0].bone.name = "root";
        good = read_sections(&a, e);
    }
    if (good && !a.linked) good = stream_error(&a.in, e, "no ':hierarchy' of bones: is this an ASF skeleton?");
    if (good) good = build_joints(&a, e);
    if (fd >= 0) close(fd);
    out->degrees = a.degrees;
    return good;
}
