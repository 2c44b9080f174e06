/* kitsuke draw: frames as pictures, side by side on one sheet. Every frame that is drawn is dressed
   first, once for each cell, and kept; only then is it known how large the view must be, so that
   one camera serves the whole sheet. */
#include <string.h>

#include "app/commands.h"
#include "app/drawing.h"
#include "app/take.h"
#include "app/wearer.h"
#include "files/output.h"
#include "files/scene.h"
#include "files/svg.h"

/* Points. A picture is as wide as it must be, but for this. */
enum { SIZE_DEFAULT = 320, WIDTH_MAX = 1200, MARGIN = 6, GAP = 12, TITLE = 12, TITLE_ROOM = 24, ROW_MAX = 6 };

typedef struct { Scene scene; char title[128]; } Picture;

typedef struct {
    const Settings *settings;
    Arena *arena;
    Drawing drawing;
    Wardrobe wardrobe;
    Wearer wearer;
    Take *take;
    Dresser **dresser[DRAWING_CELLS_MAX];
    int nframes, *frame;      /* that are drawn */
    int npictures;
    Picture *picture;         /* frame by frame, cell by cell */
    Vec3 heading;             /* of the figure in the first of them */
    Vec3 stand;               /* where it stands there */
} Sheet;

static bool check_needed(const Settings *s, Error *e) {
    if (s->inputs.count == 0) return error_set(e, ERR_USAGE, "nothing to draw: name a motion");
    if (s->inputs.count > 1)
        return error_set(e, ERR_USAGE, "'draw' takes one motion: '%s' is a second one", s->inputs.item[1]);
    if (s->garments.count == 0) return error_set(e, ERR_USAGE, "nothing to put on: name a garment with -g FILE");
    if (s->garments.count >= SCENE_SURFACES_MAX)
        return error_set(e, ERR_USAGE, "%d garments are too many for a picture", s->garments.count);
    if (!s->output) return error_set(e, ERR_USAGE, "no place to write to: name a file with -o FILE");
    return true;
}

static bool open_sheet(Sheet *sh, Notes *notes, Error *e) {
    const Settings *s = sh->settings;
    const char *path = s->inputs.item[0];
    const Drawing *d = &sh->drawing;
    if (!wearer_open(&sh->wardrobe, path, 1, sh->arena, notes, &sh->wearer, e) ||
        !drawing_frames(d, path, sh->wearer.motion.nframes, sh->arena, &sh->frame, &sh->nframes, e))
        return false;
    for (int c = 0; c < d->ncells; c++) {
        DressOptions options = {.method = d->cell[c].method, .split = d->cell[c].split};
        options.detail = s->detail;
        options.depth = s->depth;
        if (!wearer_put_on(&sh->wearer, &sh->wardrobe, &options, sh->arena, &sh->dresser[c], e)) return false;
    }
    sh->npictures = sh->nframes * d->ncells;
    sh->picture = ARENA_NEW(sh->arena, Picture, sh->npictures, e);
    FrameSpan span = {sh->frame[0], sh->frame[sh->nframes - 1], 1};
    return sh->picture && take_open(&sh->wearer.motion, &sh->wearer.figure, &span, 0, sh->arena, &sh->take, e);
}

/* A copy of what the next frame overwrites, moved by `shift`. */
static bool keep_mesh(const Mesh *mesh, Vec3 shift, Arena *arena, Mesh *out, Error *e) {
    size_t n = (size_t)mesh->nvertices, t = (size_t)mesh->ntriangles;
    *out = (Mesh){.nvertices = mesh->nvertices, .ntriangles = mesh->ntriangles};
    out->position = ARENA_NEW(arena, Vec3, n, e);
    out->normal = ARENA_NEW(arena, Vec3, n, e);
    out->triangle = ARENA_NEW(arena, Triangle, t, e);
    if (!out->position || !out->normal || !out->triangle) return false;
    for (size_t v = 0; v < n; v++) out->position[v] = vec_add(mesh->position[v], shift);
    memcpy(out->normal, mesh->normal, n * sizeof *out->normal);
    memcpy(out->triangle, mesh->triangle, t * sizeof *out->triangle);
    return true;
}

static bool keep_borders(const Dresser *d, LeafKind kind, int nedges, Arena *arena, SceneSurface *out, Error *e) {
    Edge *line = ARENA_NEW(arena, Edge, 2 * nedges, e);
    if (!line) return false;
    out->nlines = dresser_borders(d, kind, line);
    out->line = line;
    return true;
}

static bool keep_points(const Dresser *d, LeafKind kind, int nleaves, Vec3 shift, Arena *arena, SceneSurface *out,
                        Error *e) {
    LeafPatch *leaf = ARENA_NEW(arena, LeafPatch, nleaves, e);
    Vec3 *dot = ARENA_NEW(arena, Vec3, 16 * nleaves, e);
    if (!leaf || !dot) return false;
    dresser_leaves(d, kind, leaf, nleaves);
    for (int k = 0; k < 16 * nleaves; k++) dot[k] = vec_add(leaf[k / 16].patch.p[k / 4 % 4][k % 4], shift);
    out->ndots = 16 * nleaves;
    out->dot = dot;
    return true;
}

/* One garment of a picture; adds its leaves to *nleaves. */
static bool dress(Sheet *sh, int cell, int g, const TakeFrame *frame, Vec3 shift, SceneSurface *out, int *nleaves,
                  Error *e) {
    Dresser *d = sh->dresser[cell][g];
    unsigned show = sh->drawing.cell[cell].show;
    Mesh mesh;
    FrameStats stats;
    dresser_frame(d, &sh->wearer.posed, frame->dt, frame->tie, &mesh, &stats);
    LeafKind kind = show & SHOW_CELLS ? LEAVES_CELLS : LEAVES_BY_RULE;
    int n = dresser_leaves(d, kind, NULL, 0);
    *nleaves += n;
    out->colour = 1 + g;
    return keep_mesh(&mesh, shift, sh->arena, &out->mesh, e) &&
           (!(show & SHOW_PATCHES) || keep_borders(d, kind, mesh.nedges, sh->arena, out, e)) &&
           (!(show & SHOW_POINTS) || keep_points(d, kind, n, shift, sh->arena, out, e));
}

/* "(b) frame 12, uniform: 32 patches", as far as there is anything to tell apart. */
static void name_picture(const Sheet *sh, int number, int frame, int nleaves, Picture *out) {
    const DrawingCell *cell = &sh->drawing.cell[number % sh->drawing.ncells];
    char *text = out->title;
    size_t size = sizeof out->title, n = 0;
    if (sh->npictures > 1 && number < 26) n += (size_t)snprintf(text, size, "(%c) ", 'a' + number);
    if (sh->nframes > 1) n += (size_t)snprintf(text + n, size - n, "frame %d%s", frame, cell->title[0] ? ", " : "");
    n += (size_t)snprintf(text + n, size - n, "%s", cell->title);
    if (cell->show && cell->title[0])
        snprintf(text + n, size - n, ": %d %s", nleaves, cell->show & SHOW_CELLS ? "cells" : "patches");
}

/* Where the figure stands, on the ground. */
static Vec3 stand_of(const Wearer *w) {
    Vec3 p = rigid_apply(w->posed.pose.bone[ROLE_PELVIS], w->figure.start[ROLE_PELVIS]);
    return vec(p.x, 0, p.z);
}

static bool keep_frame(Sheet *sh, int number, const TakeFrame *frame, Error *e) {
    const Wearer *w = &sh->wearer;
    body_frame_pose(&sh->wearer.posed, &frame->pose);
    if (number == 0) {
        sh->heading = mat_column(frame->pose.bone[ROLE_PELVIS].r, 2);
        sh->stand = stand_of(w);
    }
    Vec3 shift = sh->settings->draw.follow ? vec_sub(sh->stand, stand_of(w)) : vec(0, 0, 0);
    Mesh skin = wearer_skin(w);
    for (int c = 0; c < sh->drawing.ncells; c++) {
        int k = number * sh->drawing.ncells + c, nleaves = 0;
        Scene *scene = &sh->picture[k].scene;
        scene->surface[0].is_closed = true;
        if (!keep_mesh(&skin, shift, sh->arena, &scene->surface[0].mesh, e)) return false;
        for (int g = 0; g < sh->wardrobe.ngarments; g++)
            if (!dress(sh, c, g, frame, shift, &scene->surface[1 + g], &nleaves, e)) return false;
        scene->count = 1 + sh->wardrobe.ngarments;
        name_picture(sh, k, frame->number, nleaves, &sh->picture[k]);
    }
    return true;
}

/* Frames that are not drawn are not dressed either, as with `dress --frames`. */
static bool keep_frames(Sheet *sh, Error *e) {
    TakeFrame frame;
    double last_time = 0;
    bool afresh = false;
    for (int number = 0; number < sh->nframes && take_next(sh->take, &frame, e);) {
        afresh = afresh || frame.tie == TIE_AFRESH;
        if (frame.number != sh->frame[number]) continue;
        frame.dt = number ? frame.time - last_time : 0;
        if (afresh && frame.tie == TIE_GOES_ON) frame.tie = TIE_AFRESH;
        last_time = frame.time;
        afresh = false;
        if (!keep_frame(sh, number++, &frame, e)) return false;
    }
    return e->kind == ERR_NONE;
}

/* One view for all pictures: what they reach, or round the garments as much as the zoom leaves. */
typedef struct { Camera camera; double width, height; /* points */ } View;

static double centre_of(double low, double high, double wish, double size) {
    return size >= high - low ? 0.5 * (low + high) : clamp(wish, low + 0.5 * size, high - 0.5 * size);
}

static View fit_view(const Sheet *sh) {
    const DrawSettings *s = &sh->settings->draw;
    Mat3 turn = scene_view(sh->heading, sh->drawing.azimuth, sh->drawing.elevation);
    Box all = box_empty(), cloth = box_empty();
    for (int k = 0; k < sh->npictures; k++) {
        scene_reach(&sh->picture[k].scene, turn, 0, &all);
        scene_reach(&sh->picture[k].scene, turn, 1, &cloth);
    }
    double zoom = s->zoom > 0 ? s->zoom : 1, size = s->size ? s->size : SIZE_DEFAULT;
    double width = (all.high.x - all.low.x) / zoom, height = (all.high.y - all.low.y) / zoom;
    Vec3 middle = vec_mid(cloth.low, cloth.high);
    middle.x = centre_of(all.low.x, all.high.x, middle.x, width);
    middle.y = centre_of(all.low.y, all.high.y, middle.y, height);
    double scale = fmin((size - 2 * MARGIN) / height, (WIDTH_MAX - 2 * MARGIN) / width);
    return (View){.camera = {turn, mat_apply(mat_transpose(turn), middle), scale},
                  .width = ceil(width * scale) + 2 * MARGIN, .height = ceil(height * scale) + 2 * MARGIN};
}

static int count_columns(const Sheet *sh) {
    int asked = sh->settings->draw.columns, n = sh->drawing.ncells > 1 ? sh->drawing.ncells : sh->npictures;
    if (asked) return asked < sh->npictures ? asked : sh->npictures;
    int rows = (n + ROW_MAX - 1) / ROW_MAX;
    return (n + rows - 1) / rows;
}

static const char *file_name(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static bool write_sheet(const Sheet *sh, Error *e) {
    View view = fit_view(sh);
    Canvas canvas;
    Output out;
    int columns = count_columns(sh), rows = (sh->npictures + columns - 1) / columns, most = 0;
    double below = sh->picture[0].title[0] ? TITLE_ROOM : 0;
    for (int k = 0; k < sh->npictures; k++)
        for (int s = 0, n = 0; s < sh->picture[k].scene.count; s++) {
            n += sh->picture[k].scene.surface[s].ndots;
            if (n > most) most = n;
        }
    if (!canvas_reserve(&canvas, view.width, view.height, most, sh->arena, e)) return false;
    if (!output_open(&out, sh->settings->output, e)) return false;
    svg_open(out.file, columns * (view.width + GAP) - GAP, rows * (view.height + below),
             file_name(sh->settings->inputs.item[0]));
    for (int k = 0; k < sh->npictures; k++) {
        double left = k % columns * (view.width + GAP), top = k / columns * (view.height + below);
        scene_draw(&canvas, &sh->picture[k].scene, &view.camera, left, top, out.file);
        if (sh->picture[k].title[0])
            svg_text(out.file, left + view.width / 2, top + view.height + 14, TITLE, SVG_MIDDLE, sh->picture[k].title);
    }
    svg_close(out.file);
    return output_close(&out, e);
}

static bool draw(Sheet *sh, Notes *notes, Error *e) {
    return drawing_read(sh->settings, sh->arena, &sh->drawing, e) && check_needed(sh->settings, e) &&
           wardrobe_read(sh->settings, sh->arena, &sh->wardrobe, e) && open_sheet(sh, notes, e) &&
           keep_frames(sh, e) && write_sheet(sh, e);
}

ErrorKind cmd_draw(const Settings *s, Error *e) {
    Arena arena = {0};
    Notes notes = {0};
    Sheet *sh = ARENA_NEW(&arena, Sheet, 1, e);
    if (sh) {
        *sh = (Sheet){.settings = s, .arena = &arena};
        bool good = draw(sh, &notes, e);
        if (sh->take) take_notes(sh->take, &notes);
        if (good && !s->quiet) notes_print(&notes, s->inputs.item[0], stderr);
        take_close(sh->take);
        wearer_close(&sh->wearer);
    }
    arena_free(&arena);
    return e->kind;
}
