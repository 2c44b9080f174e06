/* The press: with helpers or without, every mesh is written once, as it was when it was handed over, and
   whoever handed it over learns what went wrong. */
#include "app/press.h"

#include "folder.h"
#include "hall.h"
#include "wave.h"
#include "tap.h"

enum { FRAMES = 60 };

typedef struct { long long bytes; StatsRow row[2]; PressTally tally; Error error; bool all_put; } Outcome;

/* Hands over meshes that differ, each destroyed at once, and waits. */
static void put_all(Press *press, const char *where, int first, Outcome *out) {
    static Wave wave;
    Settings settings = {.formats = FORMAT_OBJ | FORMAT_DRC};
    Pen pen = {0};
    *out = (Outcome){.all_put = true};
    PressOrder order = {&settings, where, "sheet", 0, 1, &out->bytes, out->row, 2, &out->tally};
    make_wave(&wave);
    for (int i = 0; i < FRAMES && out->all_put; i++) {
        order.frame = first + i;
        for (int v = 0; v < VERTICES; v++) wave.position[v].y = 0.001 * order.frame;
        wave.crease[0].normal = VERTICES;
        out->all_put = press_put(press, &pen, &order, &wave.mesh, &out->error);
        for (int v = 0; v < VERTICES; v++) wave.position[v].y = 1e6;
        wave.crease[0].normal = 1;
    }
    press_finish(press, &pen, &out->tally, &out->error);
    pen_free(&pen);
}

/* The y of the first vertex of a file that was written; -1 without the crease there. */
static double height_in(int frame) {
    char name[40];
    Arena arena = {0};
    Error e = {0};
    Text text;
    Mesh m;
    snprintf(name, sizeof name, "sheet.%04d.obj", frame);
    bool good = text_read(in_folder(name), 1 << 20, &arena, &text, &e) && obj_parse(&text, &arena, &m, &e) &&
                m.nvertices == VERTICES && m.normal[0].z == -1;
    double y = good ? m.position[0].y : -1;
    arena_free(&arena);
    return y;
}

static int wrong_files(int first) {
    int wrong = 0;
    for (int i = 0; i < FRAMES; i++) wrong += fabs(height_in(first + i) - 0.001 * (first + i)) > 1e-9;
    return wrong;
}

int main(void) {
    Arena arena = {0};
    Error e = {0};
    Hall hall;
    Outcome alone, helped, failed;
    if (!folder_make()) return 1;
    hall_open(&hall);

    OK(press_open(&hall.press, 1, &hall.lock, &hall.change, &arena, &e), "a press for one thread");
    put_all(&hall.press, folder, 1, &alone);
    OK(alone.all_put && wrong_files(1) == 0, "alone: each mesh is in its file");
    put_all(&hall.press, in_folder("none"), 1, &failed);
    OK(!failed.all_put && failed.error.kind == ERR_OUTPUT, "alone: a missing folder is told: %s", failed.error.text);
    press_close(&hall.press);

    OK(press_open(&hall.press, HELPERS + 1, &hall.lock, &hall.change, &arena, &e), "a press for four threads");
    hall_fill(&hall);
    put_all(&hall.press, folder, 1001, &helped);
    OK(helped.all_put && helped.tally.waiting == 0 && wrong_files(1001) == 0, "helped: each mesh is in its file");
    OK(helped.bytes > 0 && helped.row[0].write_s > 0 && helped.row[0].write_s == helped.row[1].write_s,
       "bytes are counted, rows share the seconds");
    put_all(&hall.press, in_folder("none"), 1, &failed);
    OK(failed.error.kind == ERR_OUTPUT && failed.tally.waiting == 0, "helped: a missing folder is told: %s",
       failed.error.text);
    hall_empty(&hall);
    press_close(&hall.press);
    arena_free(&arena);
    folder_remove();
    return tap_done();
}
