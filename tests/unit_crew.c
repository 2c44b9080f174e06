/* The crew: with helpers or without, every piece is done once and before the round is over, and meshes that
   pieces hand over reach the disk. */
#include "app/crew.h"

#include <stdatomic.h>
#include <string.h>

#include "folder.h"
#include "hall.h"
#include "wave.h"
#include "tap.h"

enum { ROUNDS = 200, PIECES = 5 };

typedef struct {
    Press *press;
    PressOrder order;
    PressTally tally;
    int round;
    int times[ROUNDS][PIECES];
    long long bytes[PIECES];
    atomic_int under_way, most;
} Work;

/* Some arithmetic, and a mesh in every tenth round. */
static void piece(void *context, int index, Pen *pen) {
    Work *w = context;
    Wave wave;
    Error e = {0};
    double sum = 0;
    int now = atomic_fetch_add(&w->under_way, 1) + 1;
    for (int most = w->most; now > most && !atomic_compare_exchange_weak(&w->most, &most, now);) continue;
    for (int k = 0; k < 20000 * (index + 1); k++) sum += sqrt(k);
    w->times[w->round][index] += sum > 0;
    if (w->round % 10 == 0) {
        static const char *const names[PIECES] = {"a", "b", "c", "d", "e"};
        PressOrder order = w->order;
        order.name = names[index];
        order.frame = w->round;
        order.bytes = &w->bytes[index];
        make_wave(&wave);
        if (!press_put(w->press, pen, &order, &wave.mesh, &e)) w->times[w->round][index] = -1;
    }
    atomic_fetch_sub(&w->under_way, 1);
}

/* How many pieces were not done once by the end of their round. */
static int run_all(Press *press, const char *where, Work *w, Error *e) {
    static const Settings settings = {.formats = FORMAT_OBJ};
    static StatsRow row;
    Pen pen = {0};
    int wrong = 0;
    memset(w, 0, sizeof *w);
    w->press = press;
    w->order = (PressOrder){&settings, where, NULL, 0, 1, NULL, &row, 1, &w->tally};
    for (w->round = 0; w->round < ROUNDS; w->round++) {
        crew_do(press, &pen, &w->tally, piece, w, PIECES);
        for (int i = 0; i < PIECES; i++) wrong += w->times[w->round][i] != 1;
        wrong += w->under_way != 0;
    }
    press_finish(press, &pen, &w->tally, e);
    pen_free(&pen);
    return wrong;
}

int main(void) {
    static Work alone, helped;
    Arena arena = {0};
    Error e = {0};
    Hall hall;
    if (!folder_make()) return 1;
    hall_open(&hall);

    OK(press_open(&hall.press, 1, &hall.lock, &hall.change, &arena, &e), "a press for one thread");
    OK(run_all(&hall.press, folder, &alone, &e) == 0 && e.kind == ERR_NONE && alone.most == 1,
       "alone: each piece is done once, one after the other");
    press_close(&hall.press);

    OK(press_open(&hall.press, HELPERS + 1, &hall.lock, &hall.change, &arena, &e), "a press for four threads");
    hall_fill(&hall);
    OK(run_all(&hall.press, folder, &helped, &e) == 0 && e.kind == ERR_NONE, "helped: each piece is done once");
    OK(hall.by_helpers > 0 && helped.most > 1, "helpers did %d of %d pieces, up to %d at a time", hall.by_helpers,
       ROUNDS * PIECES, helped.most);
    bool same = true;
    for (int i = 0; i < PIECES; i++) same = same && helped.bytes[i] == alone.bytes[i] && helped.bytes[i] > 0;
    OK(same && helped.tally.waiting == 0, "and what they wrote is as much as what one wrote alone");
    run_all(&hall.press, in_folder("none"), &helped, &e);
    OK(e.kind == ERR_OUTPUT, "a piece that cannot write is told: %s", e.text);

    hall_empty(&hall);
    press_close(&hall.press);
    arena_free(&arena);
    folder_remove();
    return tap_done();
}
