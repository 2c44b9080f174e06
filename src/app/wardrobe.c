/* Everything that motions are dressed in, read and checked once. */
#include "app/wardrobe.h"

#include <string.h>

#include "garment/fit.h"

enum { COARSE = 8 }; /* facets round a section of a body that nobody sees */

static bool read_garments(const Settings *s, Wardrobe *w, Arena *arena, Error *e) {
    Arena scratch = {0};
    bool good = true;
    w->ngarments = s->garments.count;
    w->garment = ARENA_NEW(arena, Garment *, w->ngarments, e);
    for (int g = 0; w->garment && good && g < w->ngarments; g++) {
        w->garment[g] = ARENA_NEW(arena, Garment, 1, e);
        good = w->garment[g] && garment_read(s->garments.item[g], &scratch, w->garment[g], e);
        for (int k = 0; good && k < g; k++)
            if (strcmp(w->garment[k]->name, w->garment[g]->name) == 0)
                good = error_set(e, ERR_USAGE, "'%s' and '%s' are both called '%s'", s->garments.item[k],
                                 s->garments.item[g], w->garment[g]->name);
    }
    arena_free(&scratch);
    return good && w->garment;
}

static bool read_body(const Settings *s, Wardrobe *w, Error *e) {
    Arena scratch = {0};
    bool good = true;
    if (s->body) good = body_read(s->body, &scratch, &w->body, e);
    else w->body = *body_default();
    arena_free(&scratch);
    return good;
}

/* Each garment must fit the body on the reference figure. On another figure it then fits as well, or the motion is
   to blame. */
static bool try_on(const Wardrobe *w, Error *e) {
    Arena scratch = {0};
    Figure *figure = ARENA_NEW(&scratch, Figure, 1, e);
    Body *body = ARENA_NEW(&scratch, Body, 1, e);
    Fit *fit = ARENA_NEW(&scratch, Fit, 1, e);
    bool good = figure && body && fit;
    if (good) *figure = figure_reference();
    good = good && body_fit(&w->body, figure, COARSE, &scratch, body, e);
    for (int g = 0; good && g < w->ngarments; g++)
        good = fit_garment(w->garment[g], figure, body, &scratch, fit, e);
    arena_free(&scratch);
    return good;
}

bool wardrobe_read(const Settings *s, Arena *arena, Wardrobe *out, Error *e) {
    *out = (Wardrobe){.settings = s};
    bool good = read_body(s, out, e) && read_garments(s, out, arena, e) && try_on(out, e);
    return good && (!s->roles || role_file_read(s->roles, arena, &out->roles, e));
}
