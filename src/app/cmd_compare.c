/* kitsuke compare: the experiment over every pair of motion and garment, one after the other,
   since times that are taken side by side on one machine tell nothing. */
#include <string.h>

#include "app/commands.h"
#include "app/compare.h"
#include "app/progress.h"
#include "app/stop.h"
#include "files/output.h"

static bool check_needed(const Settings *s, Error *e) {
    if (s->inputs.count == 0) return error_set(e, ERR_USAGE, "nothing to compare: name a motion or a folder");
    if (s->garments.count == 0) return error_set(e, ERR_USAGE, "nothing to put on: name a garment with -g FILE");
    if (!s->output) return error_set(e, ERR_USAGE, "no place to write to: name a folder with -o DIR");
    for (int k = 0; k < s->inputs.count; k++)
        if (strcmp(s->inputs.item[k], "-") == 0 && s->garments.count > 1)
            return error_set(e, ERR_USAGE, "standard input can be read once: compare one garment at a time");
    return true;
}

/* One pair: DIR itself; several: DIR/MOTION/GARMENT. */
static bool folder_of(const Settings *s, const ComparePair *pair, int count, char out[OUTPUT_PATH_MAX], Error *e) {
    int n = count == 1 ? snprintf(out, OUTPUT_PATH_MAX, "%s", s->output)
                       : snprintf(out, OUTPUT_PATH_MAX, "%s/%s/%s", s->output, pair->motion, pair->garment);
    return n < OUTPUT_PATH_MAX || error_set(e, ERR_OUTPUT, "the name of the folder for '%s' is too long", pair->motion);
}

/* Has this been said of the motion with its garment before? */
static bool is_said(const ComparePair *pair, int k, int ngarments) {
    return k % ngarments > 0 && pair[k - 1].error.kind && strcmp(pair[k - 1].error.text, pair[k].error.text) == 0;
}

static void compare_pairs(const Wardrobe *w, const Input *input, ComparePair *pair, int count) {
    const Settings *s = w->settings;
    Arena arena = {0};
    ObjWriter obj = {0};
    Progress progress;
    char folder[OUTPUT_PATH_MAX];
    progress_start(&progress, s, count, count);
    for (int k = 0; k < count; k++) {
        ComparePair *p = &pair[k];
        Notes notes = {0};
        p->motion = input[k / w->ngarments].name;
        p->garment = w->garment[k % w->ngarments]->name;
        progress_draw(&progress, 0);
        if (stop_requested()) error_set(&p->error, ERR_INTERRUPTED, "interrupted");
        else if (folder_of(s, p, count, folder, &p->error))
            compare_run(w, k % w->ngarments, &input[k / w->ngarments], folder, &arena, &obj, &notes, p);
        progress_hide(&progress);
        if (!s->quiet && k % w->ngarments == 0) notes_print(&notes, input[k / w->ngarments].path, stderr);
        if (p->error.kind && p->error.kind != ERR_INTERRUPTED && !is_said(pair, k, w->ngarments))
            error_print(&p->error, stderr);
        progress.done++;
        progress.failed += p->error.kind != ERR_NONE;
        progress.finished++;
        arena_reset(&arena);
    }
    progress_end(&progress);
    arena_free(&arena);
    obj_writer_free(&obj);
}

/* The worst that happened. A run in which nothing touches anything has nothing to compare. */
static ErrorKind judge(const ComparePair *pair, int count, Error *e) {
    ErrorKind worst = ERR_NONE;
    int contact = 0;
    for (int k = 0; k < count; k++) {
        if (pair[k].error.kind > worst) worst = pair[k].error.kind;
        contact += pair[k].sum[COMPARE_ADAPTIVE].contact_frames;
    }
    if (worst == ERR_INTERRUPTED) error_set(e, ERR_INTERRUPTED, "interrupted");
    else if (!worst && !contact && count == 1)
        error_set(e, ERR_INPUT, "'%s' never touches the body in '%s': nothing to compare, no picture drawn",
                  pair->garment, pair->motion);
    else if (!worst && !contact)
        error_set(e, ERR_INPUT, "no garment touches the body in any motion: nothing to compare, no picture drawn");
    return e->kind > worst ? e->kind : worst;
}

ErrorKind cmd_compare(const Settings *s, Error *e) {
    Arena arena = {0};
    Input *input = NULL;
    int motions = 0;
    Wardrobe w;
    ErrorKind code = ERR_USAGE;
    stop_outlive_readers();
    stop_listen();
    if (check_needed(s, e) && wardrobe_read(s, &arena, &w, e) &&
        inputs_collect(&s->inputs, &arena, &input, &motions, e)) {
        int count = motions * w.ngarments, compared = 0;
        ComparePair *pair = ARENA_NEW(&arena, ComparePair, count, e);
        if (pair) {
            compare_pairs(&w, input, pair, count);
            for (int k = 0; k < count; k++) compared += pair[k].error.kind == ERR_NONE;
            if (compared) compare_print(pair, count, s, stdout);
            code = judge(pair, count, e);
        }
    }
    arena_free(&arena);
    return e->kind > code ? e->kind : code;
}
