/* Splitting and merging as a viewer sees it: the surface of the mesh, facets and all, never jumps, and the mesh ends up
   where it belongs. */
#include <string.h>

#include "specimen.h"
#include "dress/morph.h"
#include "dress/surface.h"
#include "geometry/boxtree.h"

enum { DETAIL = 4, DEPTH = 2, MOST = 1 << 14 };

typedef struct {
    Specimen cloth;
    Surface surface;
    Morph morph;
    Leaves fresh;
    Vec3 point[2][MOST]; /* of this frame and the last, with their facets */
    Triangle triangle[2][MOST];
    int npoints[2], ntriangles[2], frame;
} Show;

static Show show;

static void show_open(Show *w, const char *name) {
    *w = (Show){.frame = 0};
    specimen_open(&w->cloth, name, DETAIL, DEPTH);
    Scene *s = &w->cloth.scene;
    need(s, surface_reserve(&w->surface, &w->cloth.lattice, &s->arena, &s->error) &&
                morph_reserve(&w->morph, &w->cloth.lattice, &s->arena, &s->error) &&
                leaves_reserve(&w->fresh, &w->cloth.lattice, &s->arena, &s->error));
}

/* A frame in which leaves of these levels are wanted: the same shape, another mesh. */
static void show_frame(Show *w, const Leaves *wanted, double dt, bool restart) {
    int now = w->frame++ % 2;
    leaves_copy(wanted, &w->cloth.leaves);
    leaves_copy(wanted, &w->fresh);
    morph_carry(&w->morph, dt, restart, &w->cloth.leaves, &w->fresh);
    tessellate(&w->cloth.sheet, &w->cloth.leaves);
    w->npoints[now] = w->cloth.sheet.nvertices;
    w->ntriangles[now] = w->cloth.sheet.ntriangles;
    surface_points(&w->surface, &w->cloth.sheet, w->cloth.root, w->point[now]);
    morph_points(&w->morph, &w->cloth.sheet, w->point[now]);
    memcpy(w->triangle[now], w->cloth.sheet.triangle, (size_t)w->ntriangles[now] * sizeof(Triangle));
}

/* The largest distance of a vertex of one of the last two frames from the facets of the other, metres. */
static double show_jump(Show *w) {
    double worst = 0;
    for (int k = 0; k < 2; k++) {
        Scene *s = &w->cloth.scene;
        BoxTree tree;
        need(s, boxtree_build(&tree, w->point[k], w->triangle[k], NULL, w->ntriangles[k], &s->arena, &s->error));
        for (int v = 0; v < w->npoints[!k]; v++) {
            Vec3 at;
            boxtree_nearest(&tree, w->point[!k][v], NULL, &at);
            worst = max_of(worst, vec_dist(at, w->point[!k][v]));
        }
    }
    return worst;
}

/* How far the last frame's vertices are off the surface. */
static double show_off(Show *w) {
    const Sheet *sheet = &w->cloth.sheet;
    double worst = 0;
    for (int v = 0; v < sheet->nvertices; v++) {
        Vec3 on = lattice_point(&w->cloth.lattice, w->cloth.root, sheet->place[v]);
        worst = max_of(worst, vec_dist(on, w->point[!(w->frame % 2)][v]));
    }
    return worst;
}

static void splits_and_merges(const char *name) {
    enum { FRAMES = 60 };
    Show *w = &show;
    Leaves plain, split;
    show_open(w, name);
    Scene *s = &w->cloth.scene;
    int npatches = w->cloth.fit.npatches;
    need(s, leaves_reserve(&plain, &w->cloth.lattice, &s->arena, &s->error) &&
                leaves_reserve(&split, &w->cloth.lattice, &s->arena, &s->error));
    leaves_fill(&plain, 0);
    leaves_fill(&split, 0);
    for (int p = 0; p < npatches; p += 2) leaves_split(&split, p, 1 + p / 2 % DEPTH, 0, 1);

    show_frame(w, &plain, 0, true);
    show_frame(w, &split, 0, true);
    double at_once = show_jump(w), opening = 0, closing = 0;
    int coarse = 0;

    show_frame(w, &plain, 0, true);
    for (int f = 0; f < FRAMES; f++) {
        show_frame(w, &split, 1 / 120.0, false);
        opening = max_of(opening, show_jump(w));
    }
    double open_end = show_off(w);
    bool has_opened = leaves_count(&w->cloth.leaves) == leaves_count(&split);
    for (int f = 0; f < FRAMES; f++) {
        show_frame(w, &plain, 1 / 120.0, false);
        closing = max_of(closing, show_jump(w));
        coarse += leaves_count(&w->cloth.leaves) == npatches;
    }
    OK(at_once > 1e-3, "%s: split or merged at once, its facets jump by %.1f mm", name, 1000 * at_once);
    OK(opening < 0.2 * at_once && closing < 0.2 * at_once, "%s: not so with time: %.2f mm a frame, %.2f", name,
       1000 * opening, 1000 * closing);
    OK(has_opened && open_end < 1e-3 * at_once, "%s: what is split ends up on the surface (%.1e)", name, open_end);
    OK(coarse > FRAMES / 4 && coarse < FRAMES, "%s: what is no longer wanted is merged once it is flat", name);
    arena_free(&s->arena);
}

int main(void) {
    splits_and_merges("skirt");
    splits_and_merges("tshirt");
    return tap_done();
}
