/* kitsuke inspect: what is in a file, as it was understood. The same readers as `dress` look
   at it, so what is printed here is what will be dressed. What a file is follows from its
   first word, not from its name. */
#include <string.h>

#include "app/commands.h"
#include "figure/figure.h"

/* Names with commas or quotes are quoted as CSV asks for. */
static void print_field(const char *text) {
    if (!text[strcspn(text, ",\"\r\n")]) {
        fputs(text, stdout);
        return;
    }
    putchar('"');
    for (; *text; text++) {
        if (*text == '"') putchar('"');
        putchar(*text);
    }
    putchar('"');
}

/* Nine digits give every position to a billionth of the largest one. */
static bool print_joints(const Motion *m, const FrameSpan *span, Arena *arena, Error *e) {
    const Skeleton *s = &m->skeleton;
    double *row = ARENA_NEW(arena, double, s->nchannels, e);
    Rigid *world = ARENA_NEW(arena, Rigid, s->njoints, e);
    MotionReader *reader = NULL;
    bool good = row && world && motion_reader_open(m, arena, &reader, e);
    int first = span->first ? span->first : 1, step = span->step ? span->step : 1;
    int last = span->last && span->last < m->nframes ? span->last : m->nframes;
    printf("frame,joint,x,y,z\n");
    for (long f = first; good && f <= last && !ferror(stdout); f += step) {
        good = motion_row(reader, (int)f - 1, row, e);
        if (!good) break;
        skeleton_pose(s, row, world);
        for (int j = 0; j < s->njoints; j++) {
            printf("%ld,", f);
            print_field(s->joint[j].name);
            printf(",%.9g,%.9g,%.9g\n", world[j].t.x, world[j].t.y, world[j].t.z);
        }
    }
    if (reader) motion_reader_close(reader);
    return good;
}

static void print_warnings(const Notes *notes) {
    for (int i = 0; i < notes->count && i < NOTES_MAX; i++) {
        const Error *n = &notes->note[i];
        printf("  warning     ");
        if (n->line) printf("line %d: ", n->line);
        printf("%s\n", n->text);
    }
    if (notes->count > NOTES_MAX) printf("  warning     %d more warnings\n", notes->count - NOTES_MAX);
}

static void print_motion(const Motion *m) {
    const Skeleton *s = &m->skeleton;
    int ends = 0, moved = 0;
    for (int j = 0; j < s->njoints; j++) {
        ends += s->joint[j].is_end;
        for (int c = 0; c < s->joint[j].nchannels; c++)
            if (s->joint[j].channel[c] <= CHANNEL_TZ) {
                moved++;
                break;
            }
    }
    printf("%s: %s motion\n", m->path, m->format);
    printf("  joints      %d and %d end sites, %d channels\n", s->njoints - ends, ends, s->nchannels);
    printf("  positions   channels of %d joint%s %s the OFFSET\n", moved, moved == 1 ? "" : "s", s->position_adds ? "add to" : "replace");
    printf("  frames      %d\n", m->nframes);
    printf("  rate        %.6g a second%s, %.6g s in all\n", 1 / m->frame_time, m->has_frame_time ? "" : " (assumed)",
           (m->nframes - 1) * m->frame_time);
}

static void print_figure(const Motion *m, const Figure *f) {
    const char *sign = f->up >= 'a' ? "" : "-";
    printf("  unit        %s (%.6g m)\n", f->unit_name, f->unit);
    printf("  up          %s%c\n", sign, f->up >= 'a' ? f->up : f->up - 'A' + 'a');
    printf("  height      %.3f m\n", f->height);
    printf("  rest        %s\n", f->rest);
    printf("  roles\n");
    for (int r = 0; r < ROLE_COUNT; r++) {
        int j = f->roles.joint[r];
        printf("    %-18s %s\n", role_name((Role)r), j < 0 ? "(none)" : m->skeleton.joint[j].name);
    }
}

static bool inspect_figure(const Motion *m, const Settings *s, Arena *arena, Notes *notes, Error *e) {
    Roles roles;
    Figure figure;
    Error why = {0};
    FigureOptions options = {s->unit, s->scale, (char)s->up};
    if (!roles_read(m, s->roles, arena, notes, &roles, &why)) {
        if (s->roles || why.kind != ERR_INPUT) return *e = why, false;
        printf("  human       no: %s\n", why.text);
        return true;
    }
    if (!figure_build(m, &roles, &options, arena, notes, &figure, e)) return false;
    print_figure(m, &figure);
    return true;
}

static bool inspect_motion(const char *path, const Settings *s, Arena *arena, Error *e) {
    MotionOptions options = {.asf = s->asf, .fps = s->fps, .position = (PositionRule)s->position};
    Notes notes = {0};
    Motion motion = {0};
    bool good = motion_open(path, &options, arena, &notes, &motion, e);
    if (good && s->joints) {
        notes_print(&notes, path, stderr);
        good = print_joints(&motion, &s->frames, arena, e);
    } else if (good) {
        print_motion(&motion);
        good = inspect_figure(&motion, s, arena, &notes, e);
        print_warnings(&notes);
    }
    motion_close(&motion);
    return good;
}

ErrorKind cmd_inspect(const Settings *s, Error *e) {
    ErrorKind worst = ERR_NONE;
    if (s->inputs.count == 0) return error_set(e, ERR_USAGE, "nothing to inspect: name a motion, garment or body file"), ERR_USAGE;
    if (s->joints && s->inputs.count > 1) return error_set(e, ERR_USAGE, "'--joints' takes one motion at a time"), ERR_USAGE;
    for (int i = 0; i < s->inputs.count; i++) {
        Arena arena = {0};
        Error wrong = {0};
        if (i) putchar('\n');
        if (!inspect_motion(s->inputs.item[i], s, &arena, &wrong)) {
            fflush(stdout);
            error_print(&wrong, stderr);
            if (wrong.kind > worst) worst = wrong.kind;
        }
        arena_free(&arena);
    }
    return worst;
}
