/* kitsuke dress: what the whole run shares is read and checked before the first motion, so that a
   mistake in a garment is one message and not ten thousand. */
#include <string.h>

#include "app/batch.h"
#include "app/commands.h"
#include "app/listfile.h"
#include "app/stop.h"
#include "app/summary.h"

static bool check_needed(const Settings *s, Error *e) {
    if (s->merge && s->inputs.count > 0) return true;
    if (s->merge) return error_set(e, ERR_USAGE, "nothing to merge: name folders with summaries");
    if (s->inputs.count == 0 && !s->files_from)
        return error_set(e, ERR_USAGE, "nothing to dress: name a motion or a folder of motions");
    if (s->garments.count == 0) return error_set(e, ERR_USAGE, "nothing to put on: name a garment with -g FILE");
    if (!s->output) return error_set(e, ERR_USAGE, "no place to write to: name a folder with -o DIR");
    return true;
}

/* Motions of the command line first, then those of the list. */
static bool collect(const Settings *s, Arena *arena, Input **input, int *count, Error *e) {
    TextList all = {0};
    for (int i = 0; i < s->inputs.count; i++)
        if (!settings_append(&all, s->inputs.item[i], arena, e)) return false;
    if (s->files_from && !listfile_read(s->files_from, arena, &all, e)) return false;
    bool from_stdin = s->files_from && strcmp(s->files_from, "-") == 0;
    for (int i = 0; from_stdin && i < all.count; i++)
        if (strcmp(all.item[i], "-") == 0)
            return error_set(e, ERR_USAGE, "standard input cannot be both a motion and the list of motions");
    if (all.count == 0)
        return error_set(e, ERR_INPUT, "the list '%s' names no motion", from_stdin ? "<stdin>" : s->files_from);
    return inputs_collect(&all, arena, input, count, e);
}

/* Every n-th, so that neighbours, which are often alike, go to different machines. Names were given
   before: a motion's folder is the same in every shard. */
static int take_shard(Shard shard, Input *input, int count) {
    int kept = 0;
    if (!shard.n) return count;
    for (int i = shard.k - 1; i < count; i += shard.n) input[kept++] = input[i];
    return kept;
}

ErrorKind cmd_dress(const Settings *s, Error *e) {
    Arena arena = {0};
    Input *input = NULL;
    int total = 0;
    ErrorKind code = ERR_USAGE;
    Wardrobe w;
    bool good = check_needed(s, e);
    if (good && s->merge) {
        code = summary_merge(s, &arena, e) ? ERR_NONE : e->kind;
    } else {
        good = good && wardrobe_read(s, &arena, &w, e) && collect(s, &arena, &input, &total, e);
        stop_outlive_readers();
        stop_listen(); /* not before all that may wait for standard input is read */
        code = good ? batch_run(&w, input, take_shard(s->shard, input, total), total, &arena, e) : e->kind;
    }
    arena_free(&arena);
    return code;
}
