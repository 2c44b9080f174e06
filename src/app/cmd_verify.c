/* kitsuke verify: frame by frame, the meshes that are on the disk and nothing else: what made them,
   this program or another, is not asked.

   A frame that cannot be read is an error on stderr, and the others are tested all the same. */
#include <errno.h>
#include <string.h>

#include "app/commands.h"
#include "app/reels.h"
#include "app/stop.h"
#include "dress/cover.h"
#include "dress/sway.h"
#include "dress/verify.h"
#include "files/csv.h"
#include "files/drc.h"
#include "files/obj.h"

/* Gaps in a border up to this are cracks: wider than any rounding, narrower than any slit. Metres. */
static const double CRACK = 0.002;

/* Frames a second, where nobody says. */
static const double USUAL_RATE = 30;

enum { OBJ_LIMIT = 1 << 30 };

/* The meshes of one frame, kept while the next two are looked at. */
typedef struct {
    Arena arena;
    int number;
    Mesh body, *garment;   /* garments as in the reel */
    bool *is_read;         /* of each garment */
    SwayFrame *sway;       /* likewise, where accelerations are asked for */
    Solid solid;
    double unit;           /* metres */
} Frame;

enum { FRAMES_KEPT = 3 };

typedef struct {
    const Settings *settings;
    ErrorKind worst;
    const Reel *reel;
    Frame kept[FRAMES_KEPT], *frame; /* frame: the one that is looked at */
    int nframes, garment;            /* frames of the reel so far; the garment that is looked at */
    long long meshes, bad_meshes, pairs, inside, cracks;
    double deepest;
} Run;

static void complain(Run *r, const Error *e) {
    if (e->kind > r->worst) r->worst = e->kind;
    fflush(stdout);
    error_print(e, stderr);
}

/* Our own files tell their unit in the first line. */
static double unit_of(const Text *text, double fallback) {
    static const char head[] = "# kitsuke: Y up, ";
    double units = 0;
    if (text->size < sizeof head || memcmp(text->data, head, sizeof head - 1) != 0) return fallback;
    text_number(text->data + sizeof head - 1, text->data + text->size, &units);
    return units > 0 && isfinite(units) ? 1 / units : fallback;
}

static bool read_mesh(Run *r, const char *path, Mesh *out, double *unit, Error *e) {
    Arena *arena = &r->frame->arena;
    Text text;
    *unit = 1;
    if (text_ends_in(path, ".drc")) {
        if (!drc_read(path, arena, out, e)) return false;
    } else {
        if (!text_read(path, OBJ_LIMIT, arena, &text, e) || !obj_parse(&text, arena, out, e)) return false;
        *unit = unit_of(&text, 1);
    }
    if (r->settings->unit > 0) *unit = r->settings->unit;
    return out->ntriangles > 0 || error_at(e, ERR_INPUT, (Place){.file = path}, "no triangles");
}

/* --- which parts of the body count --- */

/* Marks the groups called `name` (length bytes). */
static bool mark_part(const Mesh *body, const char *path, const char *name, size_t length, bool *wanted, Error *e) {
    bool found = false;
    for (int g = 0; g < body->ngroups; g++)
        if (strlen(body->group[g].name) == length && memcmp(body->group[g].name, name, length) == 0)
            found = wanted[g] = true;
    if (found) return true;
    char has[160];
    size_t used = 0;
    for (int g = 0; g < body->ngroups && used < sizeof has; g++)
        used += (size_t)snprintf(has + used, sizeof has - used, "%s%s", g ? ", " : "", body->group[g].name);
    return error_set(e, ERR_USAGE, "option '--parts': '%s' has no group '%.*s'; it has %s", path,
                     error_shown((long)length), name, body->ngroups ? has : "none");
}

static bool find_parts(Run *r, const char *path, bool **wanted, Error *e) {
    *wanted = NULL;
    if (!r->settings->parts) return true;
    *wanted = ARENA_NEW(&r->frame->arena, bool, r->frame->body.ngroups, e);
    bool good = *wanted != NULL;
    for (const char *at = r->settings->parts; good; at++) {
        size_t length = strcspn(at, ",");
        good = mark_part(&r->frame->body, path, at, length, *wanted, e);
        at += length;
        if (!*at) break;
    }
    return good;
}

/* --- output --- */

static void print_text(const char *text) {
    csv_text(text, stdout);
    putchar(',');
}

static void print_head(const Settings *s) {
    if (s->list) {
        printf("# units: distance m; at as in the meshes\n"
               "motion,frame,garment,kind,item,part,other,distance,at_x,at_y,at_z\n");
        return;
    }
    printf("# units: deepest m;%s%s all other numbers are counts\n"
           "motion,frame,garment,pairs,inside,deepest,worst_part,cracks,borders",
           s->acceleration ? " acceleration m/s^2; body_acceleration m/s^2;" : "",
           s->landmarks ? " cover from 0 to 1;" : "");
    if (s->acceleration) printf(",acceleration,body_acceleration");
    for (int p = 0; s->landmarks && p < COVER_COUNT; p++) printf(",cover_%s", cover_names[p]);
    putchar('\n');
}

static void print_start(const Run *r) {
    print_text(r->reel->motion);
    printf("%d,", r->frame->number);
    print_text(r->reel->garment[r->garment].name);
}

static const char *group_name(const Mesh *m, int group) { return group >= 0 ? m->group[group].name : ""; }

static int group_of(const Mesh *m, int triangle) {
    for (int g = 0; g < m->ngroups; g++)
        if (triangle >= m->group[g].first && triangle < m->group[g].first + m->group[g].count) return g;
    return -1;
}

/* Items are counted from 1, as an OBJ file does. */
static void print_finding(void *context, const Finding *f) {
    const Run *r = context;
    static const char *const kinds[] = {"pair", "inside", "crack"};
    print_start(r);
    printf("%s,%d,", kinds[f->kind], f->item + 1);
    print_text(f->other < 0 ? "" : group_name(&r->frame->body, group_of(&r->frame->body, f->other)));
    if (f->other >= 0) printf("%d", f->other + 1);
    printf(",%.6f,%.6f,%.6f,%.6f\n", f->distance * r->frame->unit, f->at.x, f->at.y, f->at.z);
}

/* Numbers that are not there leave their field empty. */
static void print_number(double x) {
    if (isfinite(x)) printf(",%.4f", x);
    else putchar(',');
}

static void print_verdict(const Run *r, const Verdict *v, const double acceleration[2], const double *share) {
    print_start(r);
    printf("%d,%d,%.6f,", v->pairs, v->inside, v->deepest * r->frame->unit);
    print_text(group_name(&r->frame->body, v->worst));
    printf("%d,%d", v->cracks, v->borders);
    for (int k = 0; r->settings->acceleration && k < 2; k++) print_number(acceleration[k]);
    for (int p = 0; r->settings->landmarks && p < COVER_COUNT; p++) print_number(share[p]);
    putchar('\n');
}

static void print_summary(const Run *r) {
    fprintf(stderr, "%lld mesh%s, %lld with findings: %lld pairs, %lld vertices inside, deepest %.2f mm, %lld cracks\n",
            r->meshes, r->meshes == 1 ? "" : "es", r->bad_meshes, r->pairs, r->inside, 1000 * r->deepest, r->cracks);
}

/* --- testing --- */

/* Of the garment and the body over this frame and the two before it, in metres a second squared;
   NAN where these are not there, or not equally far apart. */
static bool measure_sway(Run *r, double acceleration[2], Error *e) {
    Frame *now = r->frame, *first = &r->kept[r->nframes % FRAMES_KEPT];
    Frame *last = &r->kept[(r->nframes + 1) % FRAMES_KEPT];
    int g = r->garment, gap = now->number - last->number;
    acceleration[0] = acceleration[1] = NAN;
    if (!sway_frame(&now->garment[g], &now->body, &now->arena, &now->sway[g], e)) return false;
    if (r->nframes < FRAMES_KEPT || last->number - first->number != gap) return true;
    if (!last->is_read || !first->is_read || !last->is_read[g] || !first->is_read[g]) return true;
    const SwayFrame *before[2] = {&first->sway[g], &last->sway[g]};
    if (!sway_measure(before, &now->sway[g], &now->arena, &acceleration[0], &acceleration[1], e)) return false;
    double rate = r->settings->rate > 0 ? r->settings->rate : r->reel->rate > 0 ? r->reel->rate : USUAL_RATE;
    for (int k = 0; k < 2; k++) acceleration[k] *= now->unit * rate * rate / gap / gap;
    return true;
}

static void add_up(Run *r, const Verdict *v) {
    r->meshes++;
    r->bad_meshes += v->pairs || v->inside || v->cracks;
    r->pairs += v->pairs;
    r->inside += v->inside;
    r->cracks += v->cracks;
    r->deepest = fmax(r->deepest, v->deepest * r->frame->unit);
}

static bool verify_garment(Run *r, const char *path, Error *e) {
    const Settings *s = r->settings;
    Frame *f = r->frame;
    Mesh *mesh = &f->garment[r->garment];
    Verdict v;
    Findings findings = {s->list ? print_finding : NULL, r};
    double unit, acceleration[2], share[COVER_COUNT];
    if (!read_mesh(r, path, mesh, &unit, e)) return false;
    if (unit != f->unit)
        return error_at(e, ERR_INPUT, (Place){.file = path}, "its unit is %.9g m, that of the body %.9g m", unit,
                        f->unit);
    if (!verify_meshes(&f->solid, mesh, CRACK / unit, findings, &f->arena, &v, e)) return false;
    if (s->acceleration && !measure_sway(r, acceleration, e)) return false;
    if (s->landmarks && !cover_measure(&f->body, mesh, &f->arena, share, e)) return false;
    f->is_read[r->garment] = true;
    if (!s->list) print_verdict(r, &v, acceleration, share);
    add_up(r, &v);
    return true;
}

/* Forgets the oldest frame for a new one. */
static bool start_frame(Run *r, int number, Error *e) {
    Frame *f = r->frame = &r->kept[r->nframes++ % FRAMES_KEPT];
    Arena arena = f->arena;
    arena_reset(&arena);
    *f = (Frame){.arena = arena, .number = number};
    f->garment = ARENA_NEW(&f->arena, Mesh, r->reel->ngarments, e);
    f->sway = ARENA_NEW(&f->arena, SwayFrame, r->reel->ngarments, e);
    f->is_read = ARENA_NEW(&f->arena, bool, r->reel->ngarments, e);
    return f->garment && f->sway && f->is_read;
}

/* False ends the run: a mistake in the command line, or no memory. */
static bool verify_frame(Run *r, int number, Error *e) {
    Error trouble = {0};
    bool *wanted;
    const char *path = sequence_path(&r->reel->body, number);
    if (!start_frame(r, number, e)) return false;
    Frame *f = r->frame;
    if (!path) return true;
    if (!read_mesh(r, path, &f->body, &f->unit, &trouble)) {
        complain(r, &trouble);
        return true;
    }
    if (!find_parts(r, path, &wanted, e) || !solid_make(&f->body, wanted, &f->arena, &f->solid, e)) return false;
    for (r->garment = 0; r->garment < r->reel->ngarments; r->garment++) {
        path = sequence_path(&r->reel->garment[r->garment], number);
        trouble = (Error){0};
        if (path && !verify_garment(r, path, &trouble)) complain(r, &trouble);
    }
    return true;
}

static void say_missing(Run *r, const Sequence *s, int first, int last) {
    Error e = {0};
    Place place = {.file = s->pattern};
    if (first == last) error_at(&e, ERR_INPUT, place, "frame %d is missing", first);
    else error_at(&e, ERR_INPUT, place, "frames %d to %d are missing", first, last);
    complain(r, &e);
}

/* Frames that another sequence has, and gaps in the row of numbers. */
static void report_missing(Run *r, const Sequence *s, const int *frame, int n, int step) {
    int first = 0, last = 0;
    for (int i = 0; !s->still && i < n; i++) {
        bool there = sequence_path(s, frame[i]) != NULL, gap = i > 0 && frame[i] - frame[i - 1] > step;
        if (gap) {
            if (!first) first = frame[i - 1] + step;
            last = frame[i] - step;
        }
        if (!there) {
            if (!first) first = frame[i];
            last = frame[i];
        } else if (first) {
            say_missing(r, s, first, last);
            first = 0;
        }
    }
    if (first) say_missing(r, s, first, last);
}

static bool verify_reel(Run *r, Arena *arena, Error *e) {
    int *frame = NULL, n = 0, step = 0;
    if (r->reel->error.kind) {
        complain(r, &r->reel->error);
        return true;
    }
    if (!reel_frames(r->reel, &r->settings->frames, arena, &frame, &n, &step, e)) return false;
    if (n == 0) {
        Error none = {0};
        error_set(&none, ERR_USAGE, "option '--frames': '%s' has none of them", r->reel->body.pattern);
        complain(r, &none);
        return true;
    }
    report_missing(r, &r->reel->body, frame, n, step);
    for (int g = 0; g < r->reel->ngarments; g++) report_missing(r, &r->reel->garment[g], frame, n, step);
    r->nframes = 0;
    for (int i = 0; i < n && !ferror(stdout); i++) {
        if (stop_requested()) return error_set(e, ERR_INTERRUPTED, "interrupted");
        if (!verify_frame(r, frame[i], e)) return false;
    }
    return true;
}

ErrorKind cmd_verify(const Settings *s, Error *e) {
    Arena arena = {0};
    Run run = {.settings = s};
    Reel *reel = NULL;
    int count = 0;
    stop_listen();
    bool good = reels_find(s, &arena, &reel, &count, e);
    if (good) print_head(s);
    for (int i = 0; good && i < count; i++) {
        run.reel = &reel[i];
        good = verify_reel(&run, &arena, e);
    }
    if (good && fflush(stdout) != 0)
        good = error_set(e, ERR_OUTPUT, "cannot write to standard output: %s", strerror(errno));
    if (good && !s->quiet) print_summary(&run);
    if (!run.worst && run.bad_meshes) run.worst = ERR_CHECK;
    for (int k = 0; k < FRAMES_KEPT; k++) arena_free(&run.kept[k].arena);
    arena_free(&arena);
    return good ? run.worst : e->kind;
}
