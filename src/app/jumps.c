/* A T-pose in front of a take, a root that teleports, a knee that flips: reported, a few of them one
   by one, the rest as a number. */
#include "app/jumps.h"

static double larger(double a, double b) { return a > b ? a : b; }

/* The last one, if `next` only goes on with it. */
static Jump *continued(Jumps *j, const Jump *next) {
    Jump *last = j->count && j->count <= JUMPS_KEPT ? &j->jump[j->count - 1] : NULL;
    return last && last->last == next->first - 1 && last->kind == next->kind ? last : NULL;
}

static void append(Jumps *j, Jump next) {
    Jump *last = continued(j, &next);
    if (last) {
        last->last = next.last;
        last->width = larger(last->width, next.width);
    } else if (j->count++ < JUMPS_KEPT) {
        j->jump[j->count - 1] = next;
    }
}

void jumps_add(Jumps *j, int frame, double width, Step kind) { append(j, (Jump){frame, frame, width, kind}); }

void jumps_append(Jumps *j, const Jumps *later) {
    for (int i = 0; i < later->count && i < JUMPS_KEPT; i++) append(j, later->jump[i]);
    if (later->count > JUMPS_KEPT) j->count += later->count - JUMPS_KEPT;
}

static void note(const Jump *j, Place place, Notes *notes) {
    char frames[48];
    if (j->first == j->last) snprintf(frames, sizeof frames, "frame %d", j->first);
    else snprintf(frames, sizeof frames, "frames %d to %d", j->first, j->last);
    if (j->kind == STEP_FLIP)
        notes_add(notes, place, "a limb flips by up to %.2f heights a frame at %s", j->width, frames);
    else if (j->first == 2 && j->last == 2)
        notes_add(notes, place, "frame 1 stands apart from the rest; cloth starts afresh at frame 2");
    else if (j->first == 2)
        notes_add(notes, place, "the first %d frames stand apart from the rest; cloth starts afresh up to frame %d",
                  j->last - 1, j->last);
    else
        notes_add(notes, place, "the figure jumps by up to %.2f heights a frame at %s; cloth starts afresh", j->width,
                  frames);
}

void jumps_notes(const Jumps *j, const char *path, Notes *notes) {
    Place place = {.file = path};
    for (int i = 0; i < j->count && i < JUMPS_KEPT; i++) note(&j->jump[i], place, notes);
    if (j->count > JUMPS_KEPT) notes_add(notes, place, "it flips or jumps in %d more places", j->count - JUMPS_KEPT);
}
