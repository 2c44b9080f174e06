/* A shaded picture in four layers, all taken from one depth buffer:

     tones     each surface's regions of equal brightness, the brighter on top of the darker, so
               that no seam can show between two
     contours  where one surface ends before another, or before itself
     lines     edges that nothing hides
     dots      likewise; those behind are only hinted at

   Nothing is sorted and nothing painted over that a printer would have to hide, and a surface
   that pokes through another ends on the curve where they meet. */
#include "files/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "files/svg.h"

/* Pixels per point, and pixels that are enough for any picture. What is written is in tenths of a
   point. */
static const double FINE = 4, PIXELS = 4e6;
enum { NO_TONE = 255, RIM = 2 };
static const double SPECK = 14;      /* square pixels: smaller regions of a tone are left out */
/* Parts of the longest extent of what is drawn, so that no unit matters: */
static const double STEP = 0.008;    /* a surface that far before itself has a contour there */
static const double SLACK = 0.0009;  /* lines this little below the surface are seen */

#define LINE "#1a1a1a"

typedef struct { int r, g, b; } Ink;

/* Pixels from (left, top) up to before (right, bottom). */
typedef struct { int left, top, right, bottom; } Part;

/* Darkest and brightest tone: light skin, and cloth that is darker than it, also in grey. */
static const Ink inks[][2] = {{{126, 104, 88}, {250, 241, 228}},
                              {{38, 62, 98}, {186, 208, 232}},
                              {{112, 54, 38}, {232, 190, 166}},
                              {{44, 74, 50}, {186, 214, 182}},
                              {{84, 66, 30}, {224, 206, 160}}};
enum { INKS = sizeof inks / sizeof inks[0] };

bool canvas_reserve(Canvas *c, double width, double height, int ndots, Arena *arena, Error *e) {
    double fine = fmin(FINE, sqrt(PIXELS / (width * height)));
    int w = (int)ceil(width * fine), h = (int)ceil(height * fine);
    *c = (Canvas){.fine = fine, .unit = 10 / fine, .capacity = ndots};
    c->dot = arena_array(arena, (size_t)ndots, sizeof *c->dot, e);
    c->spread = ARENA_NEW(arena, unsigned char, w * h, e);
    c->queue = ARENA_NEW(arena, int, w * h, e);
    return c->dot && c->spread && c->queue && raster_reserve(&c->raster, w, h, arena, e) &&
           outline_reserve(&c->outline, w, h, arena, e);
}

Mat3 scene_view(Vec3 heading, double azimuth, double elevation) {
    Vec3 up = vec(0, 1, 0), ahead = vec_unit_or(vec(heading.x, 0, heading.z), vec(0, 0, 1));
    Vec3 left = vec_cross(up, ahead);
    double a = azimuth * PI / 180, b = elevation * PI / 180;
    Vec3 round = vec_add(vec_scale(ahead, cos(a)), vec_scale(left, sin(a)));
    Vec3 z = vec_add(vec_scale(round, cos(b)), vec_scale(up, sin(b))), x = vec_cross(up, round);
    return (Mat3){{x, vec_cross(z, x), z}};
}

void scene_reach(const Scene *scene, Mat3 turn, int first, Box *box) {
    for (int s = first; s < scene->count; s++) {
        const SceneSurface *surface = &scene->surface[s];
        for (int v = 0; v < surface->mesh.nvertices; v++) box_add(box, mat_apply(turn, surface->mesh.position[v]));
        for (int k = 0; k < surface->ndots; k++) box_add(box, mat_apply(turn, surface->dot[k]));
    }
}

/* Labels of the two sides of a surface. */
static int front_of(int surface) { return 1 + 2 * surface; }
static int back_of(int surface) { return 2 + 2 * surface; }

static Ink ink_of(const SceneSurface *s, bool is_back, int tone) {
    const Ink *two = inks[s->colour == 0 ? 0 : 1 + (s->colour - 1) % (INKS - 1)];
    double t = (double)tone / (RASTER_TONES - 1), dim = is_back ? 0.72 : 1;
    return (Ink){(int)(dim * (two[0].r + t * (two[1].r - two[0].r))),
                 (int)(dim * (two[0].g + t * (two[1].g - two[0].g))),
                 (int)(dim * (two[0].b + t * (two[1].b - two[0].b)))};
}

/* Does the surface go on for some pixels to all sides? At its very end tones change so fast that
   pixels cannot follow. */
static bool is_inner(const Raster *r, int x, int y, int label) {
    int k = y * r->width + x;
    if (x < RIM || y < RIM || x >= r->width - RIM || y >= r->height - RIM) return false;
    return r->label[k - RIM] == label && r->label[k + RIM] == label && r->label[k - RIM * r->width] == label &&
           r->label[k + RIM * r->width] == label;
}

/* The part of the picture where the surface is seen. */
static Part find_part(const Raster *r, int label) {
    Part p = {r->width, r->height, 0, 0};
    for (int k = 0; k < r->width * r->height; k++) {
        if (r->label[k] != label) continue;
        int x = k % r->width, y = k / r->width;
        if (x < p.left) p.left = x;
        if (y < p.top) p.top = y;
        if (x >= p.right) p.right = x + 1;
        if (y >= p.bottom) p.bottom = y + 1;
    }
    return p;
}

/* Gives every pixel of the part the tone of a pixel of `label` near it: curves between two tones then
   leave the surface where they meet its end, instead of going along with it. False: too little is seen. */
static bool spread_tones(Canvas *c, Part part, int label) {
    const Raster *r = &c->raster;
    int w = r->width, n = 0;
    for (int y = part.top; y < part.bottom; y++)
        for (int x = part.left; x < part.right; x++) {
            int k = y * w + x;
            bool is_seed = r->label[k] == label && is_inner(r, x, y, label);
            c->spread[k] = is_seed ? r->tone[k] : NO_TONE;
            if (is_seed) c->queue[n++] = k;
        }
    for (int done = 0; done < n; done++) {
        int k = c->queue[done], x = k % w, y = k / w;
        int next[4] = {x > part.left ? k - 1 : k, x + 1 < part.right ? k + 1 : k, y > part.top ? k - w : k,
                       y + 1 < part.bottom ? k + w : k};
        for (int i = 0; i < 4; i++) {
            if (c->spread[next[i]] != NO_TONE) continue;
            c->spread[next[i]] = c->spread[k];
            c->queue[n++] = next[i];
        }
    }
    return n > 0;
}

/* Marks the border of the region where a map is at least `least`, and at most `most`. */
static void mark_region(Canvas *c, Part part, const unsigned char *map, int least, int most) {
    int w = c->raster.width;
    outline_clear(&c->outline, part.left, part.top, part.right, part.bottom);
    for (int y = part.top; y <= part.bottom; y++)
        for (int x = part.left; x <= part.right; x++) {
            int k = y * w + x;
            bool across = x < part.right, down = y < part.bottom;
            bool here = across && down && map[k] >= least && map[k] <= most;
            bool above = across && y > part.top && map[k - w] >= least && map[k - w] <= most;
            bool before = x > part.left && down && map[k - 1] >= least && map[k - 1] <= most;
            if (across && here != above) outline_above(&c->outline, x, y);
            if (down && here != before) outline_left(&c->outline, x, y);
        }
}

static void put_region(Canvas *c, FILE *out) {
    while (outline_next(&c->outline))
        if (c->outline.count >= 3 && outline_area(&c->outline) >= SPECK) outline_write(&c->outline, c->unit, out);
    fputs("\"/>", out);
}

/* A surface: its tones from dark to bright, one on top of the other, cut out where it is seen. */
static void draw_tones(Canvas *c, const SceneSurface *s, int label, FILE *out) {
    const Raster *r = &c->raster;
    int pixels[RASTER_TONES] = {0};
    Part part = find_part(r, label);
    if (!spread_tones(c, part, label)) return;
    fprintf(out, "<clipPath id=\"c%d\"><path clip-rule=\"evenodd\" d=\"", ++c->nclips);
    mark_region(c, part, r->label, label, label);
    put_region(c, out);
    fprintf(out, "</clipPath>\n<g clip-path=\"url(#c%d)\">\n", c->nclips);
    for (int y = part.top; y < part.bottom; y++)
        for (int x = part.left; x < part.right; x++) pixels[c->spread[y * r->width + x]]++;
    for (int tone = 0; tone < RASTER_TONES; tone++) {
        if (!pixels[tone]) continue;
        Ink ink = ink_of(s, label % 2 == 0, tone);
        fprintf(out, "<path fill=\"#%02x%02x%02x\" d=\"", ink.r, ink.g, ink.b);
        mark_region(c, part, c->spread, tone, RASTER_TONES);
        put_region(c, out);
        fputc('\n', out);
    }
    fputs("</g>\n", out);
}

/* Does a surface end between two neighbouring pixels? `before` and `behind` them are the next ones
   in that line: a slope is no end, only a step that is much larger than those beside it. */
static bool is_step(const float *depth, double least, int before, int a, int b, int behind) {
    double step = fabs((double)depth[a] - depth[b]);
    return step > least + 2 * fmin(fabs((double)depth[before] - depth[a]), fabs((double)depth[b] - depth[behind]));
}

/* What ends between two neighbouring pixels: nothing, a surface before itself, before another one, or
   against the paper. */
typedef enum { NOTHING, ITSELF, ANOTHER, PAPER } Contour;

static Contour contour(const Canvas *c, int before, int a, int b, int behind) {
    const Raster *r = &c->raster;
    int p = r->label[a], q = r->label[b];
    if (p != q) return p == RASTER_PAPER || q == RASTER_PAPER ? PAPER : ANOTHER;
    return p != RASTER_PAPER && is_step(r->depth, STEP * c->extent, before, a, b, behind) ? ITSELF : NOTHING;
}

static void mark_contours(Canvas *c, Contour kind) {
    const Raster *r = &c->raster;
    int w = r->width, h = r->height;
    outline_clear(&c->outline, 0, 0, w, h);
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++) {
            int k = y * w + x, below = y + 1 < h ? k + w : k, right = x + 1 < w ? k + 1 : k;
            int above = y > 1 ? k - 2 * w : k - w, before = x > 1 ? k - 2 : k - 1;
            if (y > 0 && contour(c, above, k - w, k, below) == kind) outline_above(&c->outline, x, y);
            if (x > 0 && contour(c, before, k - 1, k, right) == kind) outline_left(&c->outline, x, y);
        }
}

/* Lines shorter than `least` points are left out. */
static void draw_contours(Canvas *c, Contour kind, int width, double least, FILE *out) {
    mark_contours(c, kind);
    fprintf(out, "<path stroke=\"" LINE "\" stroke-width=\"%d\" stroke-linecap=\"round\" d=\"", width);
    while (outline_next(&c->outline))
        if (outline_length(&c->outline) > least * c->fine) outline_write(&c->outline, c->unit, out);
    fputs("\"/>\n", out);
}

/* A ground in the colour of contours: where the curves round two regions leave a sliver open, it is
   a piece of contour and no hole. */
static void draw_ground(Canvas *c, FILE *out) {
    fputs("<path fill=\"" LINE "\" d=\"", out);
    mark_region(c, (Part){0, 0, c->raster.width, c->raster.height}, c->raster.label, RASTER_PAPER + 1, 255);
    put_region(c, out);
    fputc('\n', out);
}

/* The visible pieces of a straight edge, each as long as it can be. */
static void draw_edge(const Canvas *c, Vec3 a, Vec3 b, FILE *out) {
    int steps = 1 + (int)(sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y)) / 2), from = -1;
    if (steps > 10000) return;
    for (int k = 0; k <= steps + 1; k++) {
        bool seen = k <= steps && raster_visible(&c->raster, vec_lerp(a, b, (double)k / steps), SLACK * c->extent);
        if (seen && from < 0) from = k;
        if (seen || from < 0) continue;
        Vec3 p = vec_lerp(a, b, (double)from / steps), q = vec_lerp(a, b, (double)(k - 1) / steps);
        fprintf(out, "M%.0f %.0fL%.0f %.0f", p.x * c->unit, p.y * c->unit, q.x * c->unit, q.y * c->unit);
        from = -1;
    }
}

static void draw_lines(const Canvas *c, const Scene *scene, FILE *out) {
    for (int s = 0; s < scene->count; s++) {
        const SceneSurface *surface = &scene->surface[s];
        if (!surface->nlines) continue;
        fputs("<path stroke=\"#101820\" stroke-width=\"4\" stroke-linecap=\"round\" d=\"", out);
        for (int k = 0; k < surface->nlines; k++) {
            const Vec3 *p = surface->mesh.position;
            const int *v = surface->line[k].v;
            draw_edge(c, raster_place(&c->raster, p[v[0]]), raster_place(&c->raster, p[v[1]]), out);
        }
        fputs("\"/>\n", out);
    }
}

static int by_place(const void *a, const void *b) {
    const int *p = a, *q = b;
    int c = p[1] == q[1] ? 0 : 1;
    return (p[c] > q[c]) - (p[c] < q[c]);
}

/* Lists the dots that are seen, or those that are not, each place once. */
static void find_dots(Canvas *c, const Scene *scene, bool seen) {
    int n = 0;
    for (int s = 0; s < scene->count; s++)
        for (int k = 0; k < scene->surface[s].ndots && n < c->capacity; k++) {
            Vec3 p = raster_place(&c->raster, scene->surface[s].dot[k]);
            if (p.x < 0 || p.y < 0 || p.x > c->raster.width || p.y > c->raster.height) continue;
            if (raster_visible(&c->raster, p, SLACK * c->extent) != seen) continue;
            c->dot[n][0] = (int)floor(p.x * c->unit + 0.5);
            c->dot[n++][1] = (int)floor(p.y * c->unit + 0.5);
        }
    qsort(c->dot, (size_t)n, sizeof *c->dot, by_place);
    c->ndots = 0;
    for (int k = 0; k < n; k++)
        if (k == 0 || by_place(c->dot[k], c->dot[k - 1]) != 0) memmove(c->dot[c->ndots++], c->dot[k], sizeof *c->dot);
}

/* Dots are lines without length and with round ends. */
static void put_dots(const Canvas *c, const char *stroke, int width, FILE *out) {
    if (!c->ndots) return;
    fprintf(out, "<path stroke=\"%s\" stroke-width=\"%d\" stroke-linecap=\"round\" d=\"", stroke, width);
    for (int k = 0; k < c->ndots; k++) fprintf(out, "M%d %dh0", c->dot[k][0], c->dot[k][1]);
    fputs("\"/>\n", out);
}

void scene_draw(Canvas *c, const Scene *scene, const Camera *camera, double left, double top, FILE *out) {
    Camera fine = {camera->turn, camera->centre, camera->scale * c->fine};
    Box box = box_empty();
    scene_reach(scene, camera->turn, 0, &box);
    Vec3 size = vec_sub(box.high, box.low);
    c->extent = fmax(size.x, fmax(size.y, size.z));
    raster_clear(&c->raster, &fine);
    for (int s = 0; s < scene->count; s++) {
        const SceneSurface *surface = &scene->surface[s];
        raster_mesh(&c->raster, &surface->mesh, front_of(s), surface->is_closed ? RASTER_PAPER : back_of(s));
    }
    fputs("<g transform=\"translate(", out);
    svg_point(out, left, top);
    fputs(")scale(.1)\" fill-rule=\"evenodd\">\n", out);
    draw_ground(c, out);
    for (int label = 1; label <= 2 * scene->count; label++)
        draw_tones(c, &scene->surface[(label - 1) / 2], label, out);
    draw_contours(c, ITSELF, 6, 6, out);
    draw_contours(c, ANOTHER, 6, 2, out);
    draw_contours(c, PAPER, 9, 2, out);
    draw_lines(c, scene, out);
    find_dots(c, scene, false);
    put_dots(c, "#8a8a8a", 14, out);
    find_dots(c, scene, true);
    put_dots(c, "#fff", 32, out);
    put_dots(c, "#9c1c12", 24, out);
    fputs("</g>\n", out);
}
