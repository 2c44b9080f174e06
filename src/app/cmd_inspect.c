/* kitsuke inspect: what is in a file, as it was understood. The same readers as `dress` look
   at it, so what is printed here is what will be dressed. What a file is follows from its
   first word, not from its name. */
#include <stdlib.h>
#include <string.h>

#include "app/commands.h"
#include "app/take.h"
#include "app/wearer.h"
#include "files/csv.h"

enum { MODEL_FILE_MAX = 1 << 20 };

/* Nine digits give every position to a billionth of the largest one. */
static bool print_joints(const Motion *m, const FrameSpan *span, Arena *arena, Error *e) {
    const Skeleton *s = &m->skeleton;
    FrameSpan all;
    if (!take_span(m, span, 0, &all, e)) return false;
    double *row = ARENA_NEW(arena, double, s->nchannels, e);
    Rigid *world = ARENA_NEW(arena, Rigid, s->njoints, e);
    MotionReader *reader = NULL;
    bool good = row && world && motion_reader_open(m, arena, &reader, e);
    printf("frame,joint,x,y,z\n");
    for (long f = all.first; good && f <= all.last && !ferror(stdout); f += all.step) {
        good = motion_row(reader, (int)f - 1, row, e);
        if (!good) break;
        skeleton_pose(s, row, world);
        for (int j = 0; j < s->njoints; j++) {
            printf("%ld,", f);
            csv_text(s->joint[j].name, stdout);
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

/* Which program names joints like this, told by a part of a name that only it uses. Only printed; roles are found
   without it. */
static const char *naming(const Skeleton *s) {
    static const struct { const char *sign, *family; } families[] = {
        {"mixamorig", "Mixamo"},
        {"Bip0", "3ds Max Biped"},
        {"lfemur", "CMU Acclaim"},
        {"lShldr", "Poser and Daz"},
        {"LHipJoint", "CMU"},
        {"joint_Root", "Bandai-Namco"},
        {"upperleg01", "MakeHuman"},
        {"LeftInHand", "Rokoko and Neuron"},
        {"J_Bip", "VRM"},
        {"CC_Base", "Character Creator"},
        {"DEF-", "Rigify"},
        {"L_Hip", "SMPL"},
        {"left_hip", "SMPL"},
        {"LeftUpperLeg", "Unity"},
        {"ShoulderLeft", "Kinect"},
        {"\xe5\xb7\xa6\xe8\xb6\xb3", "MikuMikuDance"}, /* the left leg */
        {"_jnt", "Maya rig"},
        {"LeftUpLeg", "MotionBuilder"},
        {"thigh_l", "Unreal"},
        {"LeftCollar", "collar, shoulder, elbow, wrist"},
        {"LeftKnee", "hip, knee, ankle"}};
    for (size_t i = 0; i < sizeof families / sizeof families[0]; i++)
        for (int j = 0; j < s->njoints; j++)
            if (strstr(s->joint[j].name, families[i].sign)) return families[i].family;
    return "of no known family";
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
    printf("  names       %s\n", naming(s));
    printf("  positions   channels of %d joint%s %s the OFFSET%s\n", moved, moved == 1 ? "" : "s",
           s->position_adds ? "add to" : "replace", s->points ? ", and tell how joints turn" : "");
    printf("  frames      %d\n", m->nframes);
    printf("  rate        %.6g a second%s, %.6g s in all\n", 1 / m->frame_time, m->has_frame_time ? "" : " (assumed)",
           (m->nframes - 1) * m->frame_time);
}

static void print_figure(const Motion *m, const Settings *s, const Figure *f) {
    const char *source = f->unit_is_guess ? ", found from the size" : s->unit > 0 ? "" : ", by the file";
    const char *sign = f->up >= 'a' ? "" : "-";
    printf("  unit        %s (%.6g m)%s\n", f->unit_name, f->unit, source);
    printf("  up          %s%c\n", sign, f->up >= 'a' ? f->up : f->up - 'A' + 'a');
    printf("  height      %.3f m\n", f->height);
    printf("  rest        %s\n", f->rest);
    printf("  roles\n");
    for (int r = 0; r < ROLE_COUNT; r++) {
        int j = f->roles.joint[r];
        printf("    %-18s %s\n", role_name((Role)r), j < 0 ? "(none)" : m->skeleton.joint[j].name);
    }
}

/* Goes through all frames, for the jumps between them. */
static bool look_for_jumps(const Motion *m, const Figure *f, Arena *arena, Notes *notes, Error *e) {
    Take *take = NULL;
    TakeFrame frame;
    FrameSpan all = {0};
    bool good = take_open(m, f, &all, 0, arena, &take, e);
    while (good && take_next(take, &frame, e)) continue;
    if (good) take_notes(take, notes);
    take_close(take);
    return good && e->kind == ERR_NONE;
}

static bool inspect_figure(const Motion *m, const Settings *s, const RoleFile *file, Arena *arena, Notes *notes,
                           Error *e) {
    Roles roles;
    Figure figure;
    Error why = {0};
    FigureOptions options = wearer_figure_options(s);
    if (!roles_read(m, file, arena, notes, &roles, &why)) {
        if (s->roles || why.kind != ERR_INPUT) return *e = why, false;
        printf("  %s\n", why.text); /* no human skeleton, and what it lacks */
        return true;
    }
    if (!figure_build(m, &roles, &options, arena, notes, &figure, e)) return false;
    print_figure(m, s, &figure);
    return look_for_jumps(m, &figure, arena, notes, e);
}

static bool inspect_motion(const char *path, const Settings *s, const RoleFile *roles, Arena *arena, Error *e) {
    MotionOptions options = wearer_motion_options(s);
    Notes notes = {0};
    Motion motion = {0};
    bool good = motion_open(path, &options, arena, &notes, &motion, e);
    if (good && s->joints) {
        notes_print(&notes, path, stderr);
        good = print_joints(&motion, &s->frames, arena, e);
    } else if (good) {
        print_motion(&motion);
        good = inspect_figure(&motion, s, roles, arena, &notes, e);
        print_warnings(&notes);
    }
    motion_close(&motion);
    return good;
}

typedef bool WriteModel(const void *model, FILE *out);
typedef bool ParseModel(const Text *text, void *out, Error *e);

static bool write_garment(const void *model, FILE *out) { return garment_write(model, out); }
static bool write_body(const void *model, FILE *out) { return body_write(model, out); }

/* Writes a model to memory; NULL where memory is exhausted. The caller frees it. */
static char *text_of(const void *model, WriteModel *write, size_t *size) {
    char *text = NULL;
    FILE *out = open_memstream(&text, size);
    if (!out) return NULL;
    bool good = write(model, out) && !ferror(out);
    if (fclose(out) == 0 && good) return text;
    free(text);
    return NULL;
}

/* Reads what was written from `model` into `again` and compares what that writes. */
static bool print_round_trip(const Text *source, const void *model, ParseModel *parse, void *again, WriteModel *write,
                             Error *e) {
    Error wrong = {0};
    size_t size = 0, size_again = 0;
    char *text = text_of(model, write, &size), *text_again = NULL;
    Text written = {source->name, text, size};
    bool is_read = text && parse(&written, again, &wrong);
    if (is_read) text_again = text_of(again, write, &size_again);
    bool good = text && (!is_read || text_again), same = text_again && strcmp(text, text_again) == 0;
    printf("  bytes       %zu in the file\n", source->size);
    if (same) printf("  round trip  same, %zu bytes when written\n", size);
    else if (good) printf("  round trip  differs%s%s\n", wrong.kind ? ": " : "", wrong.text);
    free(text);
    free(text_again);
    return good || error_set(e, ERR_INTERNAL, "out of memory for the text of '%s'", source->name);
}

static bool parse_garment(const Text *text, void *out, Error *e) { return garment_parse(text, out, e); }
static bool parse_body(const Text *text, void *out, Error *e) { return body_parse(text, out, e); }

static void print_garment(const char *path, const Garment *g, const DresserInfo *info) {
    printf("%s: garment %s\n", path, g->name);
    printf("  follows     %s, %s\n", g->follow == FOLLOW_BONES ? "bones" : "envelope", g->loose ? "loose" : "tight");
    printf("  size        %.3f m wide, %.3f m high, %.3f m deep, where the figure is 1.70 m tall\n", info->size.x,
           info->size.y, info->size.z);
    printf("  patches     %d\n", info->patches);
    printf("  panels      %d and %d raw patch%s\n", g->npanels, g->npatches, g->npatches == 1 ? "" : "es");
    for (int i = 0; i < g->npanels; i++) printf("    %-18s %d rows\n", g->panel[i].name, g->panel[i].nrows);
    for (int i = 0; i < g->npatches; i++) printf("    %-18s raw\n", g->patch[i].name);
    printf("  rings       %d\n  seams       %d\n  openings    %d\n  collides   ", g->nrings, g->nseams, info->openings);
    for (int r = 0; r < ROLE_COUNT; r++)
        if (info->own_parts >> r & 1) printf(" %s", role_name((Role)r));
    printf("%s\n", info->own_parts ? "" : " nothing");
}

/* Fits the garment to the reference figure, which proves its seams and openings. */
static bool inspect_garment(const Text *text, Arena *arena, Error *e) {
    Garment *g = ARENA_NEW(arena, Garment, 2, e);
    Body *body = ARENA_NEW(arena, Body, 1, e);
    Figure *figure = ARENA_NEW(arena, Figure, 1, e);
    DressOptions options = {0};
    Dresser *dresser;
    if (!g || !body || !figure || !garment_parse(text, g, e)) return false;
    *figure = figure_reference();
    if (!body_fit(body_default(), figure, 16, arena, body, e)) return false;
    if (!dresser_open(g, figure, body, &options, arena, &dresser, e)) return false;
    DresserInfo info = dresser_info(dresser);
    print_garment(text->name, g, &info);
    return print_round_trip(text, g, parse_garment, g + 1, write_garment, e);
}

static bool inspect_body(const Text *text, Arena *arena, Error *e) {
    BodySpec *spec = ARENA_NEW(arena, BodySpec, 2, e);
    Body *body = ARENA_NEW(arena, Body, 1, e);
    Figure *figure = ARENA_NEW(arena, Figure, 1, e);
    if (!spec || !body || !figure || !body_parse(text, spec, e)) return false;
    *figure = figure_reference();
    if (!body_fit(spec, figure, 16, arena, body, e)) return false;
    printf("%s: body %s\n  parts       %d\n", text->name, spec->name, spec->nparts);
    for (int i = 0; i < spec->nparts; i++)
        printf("    %-18s %d sections\n", role_name(spec->part[i].role), spec->part[i].nsections);
    printf("  skin        %d patches, as a mesh %d vertices and %d triangles\n", body->npatches, body->skin.nvertices,
           body->skin.ntriangles);
    return print_round_trip(text, spec, parse_body, spec + 1, write_body, e);
}

/* A file is what its first word says, or its name where the word is wrong. */
static bool inspect(const char *path, const Settings *s, const RoleFile *roles, Arena *arena, Error *e) {
    char word[TEXT_FIRST];
    Text text;
    if (!text_first_word(path, word, e)) return false;
    bool is_garment = strcmp(word, "garment") == 0, is_body = strcmp(word, "body") == 0;
    if (!is_garment && !is_body) {
        is_garment = text_ends_in(path, ".garment");
        is_body = text_ends_in(path, ".body");
    }
    if (s->joints || (!is_garment && !is_body)) return inspect_motion(path, s, roles, arena, e);
    if (!text_read(path, MODEL_FILE_MAX, arena, &text, e)) return false;
    return is_garment ? inspect_garment(&text, arena, e) : inspect_body(&text, arena, e);
}

static bool check_needed(const Settings *s, Error *e) {
    if (s->inputs.count == 0) return error_set(e, ERR_USAGE, "nothing to inspect: name a motion, garment or body file");
    if (s->joints && s->inputs.count > 1) return error_set(e, ERR_USAGE, "'--joints' takes one motion at a time");
    return true;
}

ErrorKind cmd_inspect(const Settings *s, Error *e) {
    ErrorKind worst = ERR_NONE;
    RoleFile roles = {0};
    Arena shared = {0};
    if (!check_needed(s, e)) return e->kind;
    if (s->roles && !role_file_read(s->roles, &shared, &roles, e)) worst = e->kind;
    for (int i = 0; e->kind == ERR_NONE && i < s->inputs.count; i++) {
        Arena arena = {0};
        Error wrong = {0};
        if (!inspect(s->inputs.item[i], s, &roles, &arena, &wrong)) {
            fflush(stdout);
            error_print(&wrong, stderr);
            if (wrong.kind > worst) worst = wrong.kind;
        } else if (i + 1 < s->inputs.count) {
            putchar('\n');
        }
        arena_free(&arena);
    }
    arena_free(&shared);
    return worst;
}
