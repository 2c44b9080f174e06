/* kitsuke dress: what the whole run shares is read and checked before the first motion, so that a
   mistake in a garment is one message and not ten thousand. */
#include "app/batch.h"
#include "app/commands.h"
#include "app/stop.h"

static bool check_needed(const Settings *s, Error *e) {
    if (s->inputs.count == 0) return error_set(e, ERR_USAGE, "nothing to dress: name a motion or a folder of motions");
    if (s->garments.count == 0) return error_set(e, ERR_USAGE, "nothing to put on: name a garment with -g FILE");
    if (s->method == METHOD_PAPER && s->fixed)
        return error_set(e, ERR_USAGE, "'--method paper' has no fixed topology: its patches share nothing");
    if (!s->output) return error_set(e, ERR_USAGE, "no place to write to: name a folder with -o DIR");
    return true;
}

ErrorKind cmd_dress(const Settings *s, Error *e) {
    Arena arena = {0};
    Input *input = NULL;
    int count = 0;
    ErrorKind code = ERR_USAGE;
    Wardrobe w;
    stop_listen();
    bool good = check_needed(s, e) && wardrobe_read(s, &arena, &w, e) &&
                inputs_collect(&s->inputs, &arena, &input, &count, e);
    code = good ? batch_run(&w, input, count, &arena, e) : e->kind;
    arena_free(&arena);
    return code;
}
