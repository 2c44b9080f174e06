/* The list of jumps: neighbours are one place, also where there are too many places to tell each, and also across the
   chunks of a motion. */
#include "app/jumps.h"

#include <string.h>

#include "tap.h"

/* Three flips each from frames 10, 20 ... on. */
static void add_places(Jumps *j, int first, int last) {
    for (int frame = first; frame <= last; frame++)
        if (frame % 10 < 3) jumps_add(j, frame, 0.1 * frame, STEP_FLIP);
}

static bool tells(const Jumps *j) {
    Notes notes = {0};
    jumps_notes(j, "some.bvh", &notes);
    return notes.count == 5 && strstr(notes.note[3].text, "4.20 heights") &&
           strstr(notes.note[3].text, "frames 40 to 42") && strstr(notes.note[4].text, "in 2 more places");
}

int main(void) {
    Jumps whole = {0};
    add_places(&whole, 10, 69);
    OK(tells(&whole), "four places are told one by one, the others as a number");
    int wrong = 0;
    for (int cut = 10; cut < 69; cut++) {
        Jumps first = {0}, rest = {0};
        add_places(&first, 10, cut);
        add_places(&rest, cut + 1, 69);
        jumps_append(&first, &rest);
        wrong += !tells(&first) || first.jump[JUMPS_KEPT].first != 60 || first.jump[JUMPS_KEPT].last != 62;
    }
    OK(wrong == 0, "wherever the motion is cut (wrong at %d cuts)", wrong);
    Jumps kinds = {0};
    for (int frame = 1; frame <= 8; frame++) jumps_add(&kinds, frame, 1, frame % 2 ? STEP_FLIP : STEP_JUMP);
    OK(kinds.count == 8, "a flip and a jump are two places");
    return tap_done();
}
