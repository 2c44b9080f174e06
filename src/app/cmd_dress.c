/* kitsuke dress: what the whole run shares is read and checked before the first motion, so that a
   mistake in a garment is one message and not ten thousand. */
#include <string.h>

#include "app/batch.h"
#include "app/commands.h"
#include "app/stop.h"

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

static bool check_needed(const Settings *s, Error *e) {
    if (s->inputs.count == 0) return error_set(e, ERR_USAGE, "nothing to dress: name a motion or a folder of motions");
    if (s->garments.count == 0) return error_set(e, ERR_USAGE, "nothing to put on: name a garment with -g FILE");
    if (!s->output) return error_set(e, ERR_USAGE, "no place to write to: name a folder with -o DIR");
    return true;
}

ErrorKind cmd_dress(const Settings *s, Error *e) {
    Arena arena = {0};
    Input *input = NULL;
    int count = 0;
    ErrorKind code = ERR_USAGE;
    Wardrobe *w = ARENA_NEW(&arena, Wardrobe, 1, e);
    stop_listen();
    if (w) {
        w->settings = s;
        bool good = check_needed(s, e) && read_body(s, w, e) && read_garments(s, w, &arena, e) &&
                    inputs_collect(&s->inputs, &arena, &input, &count, e);
        code = good ? batch_run(w, input, count, &arena, e) : e->kind;
    }
    arena_free(&arena);
    return code;
}
