/* A depth buffer with smooth shading. It never reaches a file: the curves between its regions
   do (see outline.c), so its pixels need only be finer than the print. */
#include "files/raster.h"

#include <math.h>

/* Light from the upper left and from before the picture, in view coordinates. */
static const Vec3 LIGHT = {-0.48, 0.62, 0.62};

bool raster_reserve(Raster *r, int width, int height, Arena *arena, Error *e) {
    size_t n = (size_t)width * (size_t)height;
    *r = (Raster){.width = width, .height = height};
    r->depth = ARENA_NEW(arena, float, n, e);
    r->label = ARENA_NEW(arena, unsigned char, n, e);
    r->tone = ARENA_NEW(arena, unsigned char, n, e);
    return r->depth && r->label && r->tone;
}

void raster_clear(Raster *r, const Camera *camera) {
    r->camera = *camera;
    for (int k = 0; k < r->width * r->height; k++) {
        r->depth[k] = -INFINITY;
        r->label[k] = RASTER_PAPER;
    }
}

Vec3 raster_place(const Raster *r, Vec3 world) {
    Vec3 v = mat_apply(r->camera.turn, vec_sub(world, r->camera.centre));
    return vec(0.5 * r->width + v.x * r->camera.scale, 0.5 * r->height - v.y * r->camera.scale, v.z);
}

/* Brightness of a surface with unit normal n, in view coordinates: light that wraps a little round
   the form, and a darker rim, as draughtsmen do it. */
static unsigned char tone_of(Vec3 n) {
    double lit = clamp((vec_dot(n, LIGHT) + 0.5) / 1.5, 0, 1), rim = clamp(n.z, 0, 1);
    double tone = 0.12 + 0.68 * lit * (0.55 + 0.45 * lit) + 0.20 * sqrt(rim);
    return (unsigned char)clamp(tone * RASTER_TONES, 0, RASTER_TONES - 1);
}

typedef struct { Vec3 place[3], normal[3]; int label; } Face;

/* Twice the signed area of a, b and the pixel's middle. */
static double side_of(Vec3 a, Vec3 b, double x, double y) { return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x); }

static void fill_row(Raster *r, const Face *f, int y, int low, int high, double area) {
    for (int x = low; x <= high; x++) {
        double px = x + 0.5, py = y + 0.5;
        double w0 = side_of(f->place[1], f->place[2], px, py) / area;
        double w1 = side_of(f->place[2], f->place[0], px, py) / area, w2 = 1 - w0 - w1;
        if (w0 < 0 || w1 < 0 || w2 < 0) continue;
        float depth = (float)(w0 * f->place[0].z + w1 * f->place[1].z + w2 * f->place[2].z);
        int k = y * r->width + x;
        if (depth <= r->depth[k]) continue;
        Vec3 n = vec_mad(vec_mad(vec_scale(f->normal[0], w0), f->normal[1], w1), f->normal[2], w2);
        r->depth[k] = depth;
        r->label[k] = (unsigned char)f->label;
        r->tone[k] = tone_of(vec_unit_or(n, vec(0, 0, 1)));
    }
}

static double least(double a, double b, double c) { return fmin(a, fmin(b, c)); }
static double most(double a, double b, double c) { return fmax(a, fmax(b, c)); }

static void fill_face(Raster *r, const Face *f, double area) {
    const Vec3 *p = f->place;
    int low = (int)clamp(floor(least(p[0].x, p[1].x, p[2].x) - 0.5), 0, r->width);
    int high = (int)clamp(ceil(most(p[0].x, p[1].x, p[2].x) - 0.5), -1, r->width - 1);
    int top = (int)clamp(floor(least(p[0].y, p[1].y, p[2].y) - 0.5), 0, r->height);
    int bottom = (int)clamp(ceil(most(p[0].y, p[1].y, p[2].y) - 0.5), -1, r->height - 1);
    for (int y = top; y <= bottom; y++) fill_row(r, f, y, low, high, area);
}

void raster_mesh(Raster *r, const Mesh *mesh, int front, int back) {
    for (int t = 0; t < mesh->ntriangles; t++) {
        Face f = {.label = front};
        for (int c = 0; c < 3; c++) {
            int v = mesh->triangle[t].v[c];
            f.place[c] = raster_place(r, mesh->position[v]);
            f.normal[c] = mat_apply(r->camera.turn, mesh->normal[v]);
        }
        double area = side_of(f.place[0], f.place[1], f.place[2].x, f.place[2].y);
        if (area > 0) { /* clockwise on the page, whose y points down: its back side */
            if (back == RASTER_PAPER) continue;
            f.label = back;
            for (int c = 0; c < 3; c++) f.normal[c] = vec_scale(f.normal[c], -1);
        }
        if (area != 0) fill_face(r, &f, area);
    }
}

bool raster_visible(const Raster *r, Vec3 place, double slack) {
    int x = (int)floor(place.x), y = (int)floor(place.y);
    if (x < 0 || y < 0 || x >= r->width || y >= r->height) return false;
    for (int j = y - 1; j <= y + 1; j++)
        for (int i = x - 1; i <= x + 1; i++) {
            if (i < 0 || j < 0 || i >= r->width || j >= r->height) continue;
            if (place.z + slack >= r->depth[j * r->width + i]) return true;
        }
    return false;
}
