/* A frame's cloth follows from that of the frame before, so one motion is dressed by one thread at a
   time; but its files can be written by anyone, in any order. As long as a thread is idle, meshes
   are copied to a ring, and it takes them from there. Where all have a motion of their own the ring
   stays empty and nothing is copied. Where the ring is full the dressing thread writes as well. */
#include "app/press.h"

#include <stdlib.h>
#include <string.h>

#include "base/clock.h"

enum { PLACES = 4 }; /* for each thread that may be idle: enough to even out quick and slow frames */

struct PressSheet {
    PressOrder order;
    Mesh mesh;      /* its arrays are in `memory` */
    char *memory;   /* malloc */
    size_t capacity;
    bool is_taken;
};

void pen_free(Pen *pen) {
    obj_writer_free(&pen->obj);
    drc_writer_free(&pen->drc);
}

bool press_open(Press *p, int threads, pthread_mutex_t *lock, pthread_cond_t *change, Arena *arena, Error *e) {
    *p = (Press){.lock = lock, .change = change, .nsheets = threads > 1 ? PLACES * threads : 0};
    p->sheet = ARENA_NEW(arena, PressSheet, p->nsheets, e);
    return p->sheet != NULL;
}

void press_close(Press *p) {
    for (int i = 0; i < p->nsheets && p->sheet; i++) free(p->sheet[i].memory);
}

/* --- writing --- */

/* The mesh is in output units already: what was tested is what is written. */
static bool write_mesh(Pen *pen, const PressOrder *o, const Mesh *mesh, long long *bytes, Error *e) {
    char path[OUTPUT_PATH_MAX + 128];
    unsigned formats = o->settings->formats ? o->settings->formats : FORMAT_OBJ | FORMAT_DRC;
    long long n = 0;
    *bytes = 0;
    if (formats & FORMAT_OBJ) {
        snprintf(path, sizeof path, "%s/%s.%04d.obj", o->folder, o->name, o->frame);
        pen->obj.metre = o->metre;
        if (!obj_write(&pen->obj, path, mesh, 1, &n, e)) return false;
        *bytes += n;
    }
    if (formats & FORMAT_DRC) {
        snprintf(path, sizeof path, "%s/%s.%04d.drc", o->folder, o->name, o->frame);
        if (!drc_write(&pen->drc, path, mesh, 1, &o->settings->drc, &n, e)) return false;
        *bytes += n;
    }
    return true;
}

/* A mesh is written, or has failed. */
static void settle(const PressOrder *o, long long bytes, double seconds, const Error *e) {
    *o->bytes += bytes;
    for (int i = 0; i < o->nrows; i++) o->row[i].write_s += seconds / o->nrows;
    if (o->tally->error.kind == ERR_NONE) o->tally->error = *e;
}

/* With the lock held: the place of a mesh is free again. Places are used again in order. */
static void vacate(Press *p, PressSheet *s) {
    s->order.tally->waiting--;
    s->order.tally = NULL;
    for (; p->count > 0 && !p->sheet[p->first].order.tally; p->count--) p->first = (p->first + 1) % p->nsheets;
}

/* Writes a mesh that is in the ring. Called and left with the lock held. */
static void write_sheet(Press *p, Pen *pen, PressSheet *s, bool as_helper) {
    long long bytes;
    Error error = {0};
    s->is_taken = true;
    pthread_mutex_unlock(p->lock);
    double start = clock_seconds();
    bool good = write_mesh(pen, &s->order, &s->mesh, &bytes, &error);
    double seconds = clock_seconds() - start;
    pthread_mutex_lock(p->lock);
    PressTally *tally = s->order.tally;
    settle(&s->order, good ? bytes : 0, seconds, &error);
    if (as_helper) tally->helped += seconds;
    vacate(p, s);
    pthread_cond_broadcast(p->change);
}

/* The first mesh in the ring that nobody has taken, of a tally if it is not NULL. */
static PressSheet *next_sheet(Press *p, const PressTally *tally) {
    for (int i = 0; i < p->count; i++) {
        PressSheet *s = &p->sheet[(p->first + i) % p->nsheets];
        if (s->order.tally && !s->is_taken && (!tally || s->order.tally == tally)) return s;
    }
    return NULL;
}

bool press_help(Press *p, Pen *pen) {
    PressSheet *s = next_sheet(p, NULL);
    if (s) write_sheet(p, pen, s, true);
    return s != NULL;
}

bool press_write_own(Press *p, Pen *pen, const PressTally *tally) {
    PressSheet *s = next_sheet(p, tally);
    if (s) write_sheet(p, pen, s, false);
    return s != NULL;
}

void press_wait(Press *p, PressTally *tally) {
    double start = clock_seconds();
    pthread_cond_wait(p->change, p->lock);
    tally->helped -= clock_seconds() - start;
}

/* --- the ring --- */

/* Copies n items to *at, which moves on. NULL stays NULL. */
static void *copy(char **at, const void *items, size_t n, size_t size) {
    char *to = *at;
    if (!items) return NULL;
    memcpy(to, items, n * size);
    *at += (n * size + 15) / 16 * 16;
    return to;
}

/* False where there is no memory: then the mesh is written at once, without a copy. */
static bool copy_mesh(PressSheet *s, const Mesh *m) {
    size_t v = (size_t)m->nvertices, t = (size_t)m->ntriangles, g = (size_t)m->ngroups;
    size_t normals = v + (size_t)m->nextra, creases = (size_t)m->ncreases;
    size_t need = (v + normals) * sizeof(Vec3) + 2 * v * sizeof(double) + t * sizeof(Triangle) + g * sizeof(MeshGroup) +
                  creases * sizeof(Crease) + 7 * 16;
    if (need > s->capacity) {
        free(s->memory);
        s->memory = malloc(need + need / 4);
        s->capacity = s->memory ? need + need / 4 : 0;
        if (!s->memory) return false;
    }
    char *at = s->memory;
    s->mesh = *m;
    s->mesh.position = copy(&at, m->position, v, sizeof(Vec3));
    s->mesh.normal = copy(&at, m->normal, normals, sizeof(Vec3));
    s->mesh.u = copy(&at, m->u, v, sizeof(double));
    s->mesh.w = copy(&at, m->w, v, sizeof(double));
    s->mesh.triangle = copy(&at, m->triangle, t, sizeof(Triangle));
    s->mesh.group = copy(&at, m->group, g, sizeof(MeshGroup));
    s->mesh.crease = copy(&at, m->crease, creases, sizeof(Crease));
    s->mesh.edge = NULL;
    return true;
}

/* With the lock held: a place for a mesh, if somebody is free to write it. Nobody takes it before it is filled. */
static PressSheet *reserve(Press *p, const PressOrder *order) {
    if (p->count >= PLACES * p->helpers) return NULL;
    PressSheet *s = &p->sheet[(p->first + p->count) % p->nsheets];
    s->order = *order;
    s->is_taken = true;
    p->count++;
    order->tally->waiting++;
    return s;
}

/* Copies the mesh to its place; nobody waits meanwhile. False where there is no memory: the place is free again. */
static bool fill(Press *p, PressSheet *s, const Mesh *mesh) {
    bool good = copy_mesh(s, mesh);
    pthread_mutex_lock(p->lock);
    if (good) s->is_taken = false;
    else vacate(p, s);
    pthread_cond_broadcast(p->change);
    pthread_mutex_unlock(p->lock);
    return good;
}

static bool take_error(const PressTally *tally, Error *e) {
    if (tally->error.kind == ERR_NONE) return true;
    if (e->kind == ERR_NONE) *e = tally->error;
    return false;
}

bool press_put(Press *p, Pen *pen, const PressOrder *order, const Mesh *mesh, Error *e) {
    if (p->nsheets) {
        pthread_mutex_lock(p->lock);
        bool good = take_error(order->tally, e);
        PressSheet *s = good ? reserve(p, order) : NULL;
        pthread_mutex_unlock(p->lock);
        if (!good) return false;
        if (s && fill(p, s, mesh)) return true;
    }
    long long bytes;
    double start = clock_seconds();
    bool good = write_mesh(pen, order, mesh, &bytes, e);
    double seconds = clock_seconds() - start;
    if (p->nsheets) pthread_mutex_lock(p->lock);
    settle(order, good ? bytes : 0, seconds, e);
    if (p->nsheets) pthread_mutex_unlock(p->lock);
    return good;
}

bool press_good(Press *p, const PressTally *tally, Error *e) {
    if (p->nsheets) pthread_mutex_lock(p->lock);
    bool good = take_error(tally, e);
    if (p->nsheets) pthread_mutex_unlock(p->lock);
    return good;
}

void press_finish(Press *p, Pen *pen, PressTally *tally, Error *e) {
    if (p->nsheets) pthread_mutex_lock(p->lock);
    while (tally->waiting > 0)
        if (!press_write_own(p, pen, tally)) press_wait(p, tally);
    take_error(tally, e);
    if (p->nsheets) pthread_mutex_unlock(p->lock);
}
