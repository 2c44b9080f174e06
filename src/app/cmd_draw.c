/* kitsuke draw: frames as pictures, side by side on one page. Every frame that is drawn is dressed
   first, once for each cell, and kept; only then is it known how large the view must be, so that
   one camera serves the whole page. */
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
} Page;

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

static bool open_page(Page *p, Notes *notes, Error *e) {
    const Settings *s = p->settings;
    const char *path = s->inputs.item[0];
    const Drawing *d = &p->drawing;
    if (!wearer_open(&p->wardrobe, path, 1, p->arena, notes, &p->wearer, e) ||
        !drawing_frames(d, path, p->wearer.motion.nframes, p->arena, &p->frame, &p->nframes, e))
        return false;
    for (int c = 0; c < d->ncells; c++) {
        DressOptions options = {.method = d->cell[c].method, .split = d->cell[c].split};
        options.detail = s->detail;
        options.depth = s->depth;
        if (!wearer_put_on(&p->wearer, &p->wardrobe, &options, p->arena, &p->dresser[c], e)) return false;
    }
    p->npictures = p->nframes * d->ncells;
    p->picture = ARENA_NEW(p->arena, Picture, p->npictures, e);
    FrameSpan span = {p->frame[0], p->frame[p->nframes - 1], 1};
    return p->picture && take_open(&p->wearer.motion, &p->wearer.figure, &span, 0, p->arena, &p->take, e);
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
    Patch *leaf = ARENA_NEW(arena, Patch, nleaves, e);
    Vec3 *dot = ARENA_NEW(arena, Vec3, 16 * nleaves, e);
    if (!leaf || !dot) return false;
    dresser_leaves(d, kind, leaf, nleaves);
    for (int k = 0; k < 16 * nleaves; k++) dot[k] = vec_add(leaf[k / 16].p[k / 4 % 4][k % 4], shift);
    out->ndots = 16 * nleaves;
    out->dot = dot;
    return true;
}

/* One garment of a picture; adds its leaves to *nleaves. */
static bool dress(Page *p, int cell, int g, const TakeFrame *frame, Vec3 shift, SceneSurface *out, int *nleaves,
                  Error *e) {
    Dresser *d = p->dresser[cell][g];
    unsigned show = p->drawing.cell[cell].show;
    Mesh mesh;
    FrameStats stats;
    dresser_frame(d, &p->wearer.posed, frame->dt, frame->tie, &mesh, &stats);
    LeafKind kind = show & SHOW_CELLS ? LEAVES_CELLS : LEAVES_BY_RULE;
    int n = dresser_leaves(d, kind, NULL, 0);
    *nleaves += n;
    out->colour = 1 + g;
    return keep_mesh(&mesh, shift, p->arena, &out->mesh, e) &&
           (!(show & SHOW_PATCHES) || keep_borders(d, kind, mesh.nedges, p->arena, out, e)) &&
           (!(show & SHOW_POINTS) || keep_points(d, kind, n, shift, p->arena, out, e));
}

/* "(b) frame 12, uniform: 32 patches", as far as there is anything to tell apart. */
static void name_picture(const Page *p, int number, int frame, int nleaves, Picture *out) {
    const DrawingCell *cell = &p->drawing.cell[number % p->drawing.ncells];
    char *text = out->title;
    size_t size = sizeof out->title, n = 0;
    if (p->npictures > 1 && number < 26) n += (size_t)snprintf(text, size, "(%c) ", 'a' + number);
    if (p->nframes > 1) n += (size_t)snprintf(text + n, size - n, "frame %d%s", frame, cell->title[0] ? ", " : "");
    n += (size_t)snprintf(text + n, size - n, "%s", cell->title);
    if (cell->show && cell->title[0])
        snprintf(text + n, size - n, ": %d %s", nleaves, cell->show & SHOW_CELLS ? "cells" : "patches");
}

/* Where the figure stands, on the ground. */
static Vec3 stand_of(const Wearer *w) {
    Vec3 p = rigid_apply(w->posed.pose.bone[ROLE_PELVIS], w->figure.start[ROLE_PELVIS]);
    return vec(p.x, 0, p.z);
}

static bool keep_frame(Page *p, int number, const TakeFrame *frame, Error *e) {
    const Wearer *w = &p->wearer;
    body_frame_pose(&p->wearer.posed, &frame->pose);
    if (number == 0) {
        p->heading = mat_column(frame->pose.bone[ROLE_PELVIS].r, 2);
        p->stand = stand_of(w);
    }
    Vec3 shift = p->settings->draw.follow ? vec_sub(p->stand, stand_of(w)) : vec(0, 0, 0);
    Mesh skin = wearer_skin(w);
    for (int c = 0; c < p->drawing.ncells; c++) {
        int k = number * p->drawing.ncells + c, nleaves = 0;
        Scene *scene = &p->picture[k].scene;
        scene->surface[0].is_closed = true;
        if (!keep_mesh(&skin, shift, p->arena, &scene->surface[0].mesh, e)) return false;
        for (int g = 0; g < p->wardrobe.ngarments; g++)
            if (!dress(p, c, g, frame, shift, &scene->surface[1 + g], &nleaves, e)) return false;
        scene->count = 1 + p->wardrobe.ngarments;
        name_picture(p, k, frame->number, nleaves, &p->picture[k]);
    }
    return true;
}

/* Frames that are not drawn are not dressed either, as with `dress --frames`. */
static bool keep_frames(Page *p, Error *e) {
    TakeFrame frame;
    for (int number = 0; number < p->nframes; number++) {
        take_leap(p->take, p->frame[number]);
        if (!take_next(p->take, &frame, e) || !keep_frame(p, number, &frame, e)) return false;
    }
    return true;
}

/* One view for all pictures: what they reach, or round the garments as much as the zoom leaves. */
typedef struct { Camera camera; double width, height; /* points */ } View;

static double centre_of(double low, double high, double wish, double size) {
    return size >= high - low ? 0.5 * (low + high) : clamp(wish, low + 0.5 * size, high - 0.5 * size);
}

static View fit_view(const Page *p) {
    const DrawSettings *s = &p->settings->draw;
    Mat3 turn = scene_view(p->heading, p->drawing.azimuth, p->drawing.elevation);
    Box all = box_empty(), cloth = box_empty();
    for (int k = 0; k < p->npictures; k++) {
        scene_reach(&p->picture[k].scene, turn, 0, &all);
        scene_reach(&p->picture[k].scene, turn, 1, &cloth);
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

static int count_columns(const Page *p) {
    int asked = p->settings->draw.columns, n = p->drawing.ncells > 1 ? p->drawing.ncells : p->npictures;
    if (asked) return asked < p->npictures ? asked : p->npictures;
    int rows = (n + ROW_MAX - 1) / ROW_MAX;
    return (n + rows - 1) / rows;
}

static const char *file_name(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* Of the scene that has the most. */
static int count_dots(const Page *p) {
    int most = 0;
    for (int k = 0; k < p->npictures; k++) {
        const Scene *scene = &p->picture[k].scene;
        int n = 0;
        for (int s = 0; s < scene->count; s++) n += scene->surface[s].ndots;
        if (n > most) most = n;
    }
    return most;
}

static bool write_page(const Page *p, Error *e) {
    View view = fit_view(p);
    Canvas canvas;
    Output out;
    int columns = count_columns(p), rows = (p->npictures + columns - 1) / columns;
    double below = p->picture[0].title[0] ? TITLE_ROOM : 0;
    if (!canvas_reserve(&canvas, view.width, view.height, count_dots(p), p->arena, e)) return false;
    if (!output_open(&out, p->settings->output, e)) return false;
    svg_open(out.file, columns * (view.width + GAP) - GAP, rows * (view.height + below),
             file_name(p->settings->inputs.item[0]));
    for (int k = 0; k < p->npictures; k++) {
        double left = k % columns * (view.width + GAP), top = k / columns * (view.height + below);
        scene_draw(&canvas, &p->picture[k].scene, &view.camera, left, top, out.file);
        if (p->picture[k].title[0])
            svg_text(out.file, left + view.width / 2, top + view.height + 14, TITLE, SVG_MIDDLE, p->picture[k].title);
    }
    svg_close(out.file);
    return output_close(&out, e);
}

static bool draw(Page *p, Notes *notes, Error *e) {
    return drawing_read(p->settings, p->arena, &p->drawing, e) && check_needed(p->settings, e) &&
           wardrobe_read(p->settings, p->arena, &p->wardrobe, e) && open_page(p, notes, e) &&
           keep_frames(p, e) && write_page(p, e);
}

ErrorKind cmd_draw(const Settings *s, Error *e) {
    Arena arena = {0};
    Notes notes = {0};
    Page *p = ARENA_NEW(&arena, Page, 1, e);
    if (p) {
        *p = (Page){.settings = s, .arena = &arena};
        bool good = draw(p, &notes, e);
        if (p->take) take_notes(p->take, &notes);
        if (good && !s->quiet) notes_print(&notes, s->inputs.item[0], stderr);
        take_close(p->take);
        wearer_close(&p->wearer);
    }
    arena_free(&arena);
    return e->kind;
}
