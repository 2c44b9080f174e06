/* Rows in any order, files that are long, that change meanwhile or want too much; and places that
   are right however far in. */
#include "motion/motion.h"

#include <string.h>
#include <unistd.h>

#include "folder.h"
#include "session.h"
#include "tap.h"

/* 4 channels. MOTION stands on line 7, the first frame on line 10. */
#define HEAD                                                                                       \
    "HIERARCHY\nROOT hip {\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n"              \
    "JOINT leg { OFFSET 0 -4 0 CHANNELS 1 Xrotation\n"                                             \
    "End Site { OFFSET 0 -3 0 } } }\n"
#define FRAMES(count) HEAD "MOTION\nFrames: " count "\nFrame Time: 0.01\n"

static Session session;

static const char *file_of(const char *text, size_t size) { return folder_put("motion.bvh", text, size); }

/* A long file whose value 4 f + i stands in frame f, channel i. */
static const char *long_file(int frames) {
    const char *path = file_of("", 0);
    FILE *f = fopen(path, "wb");
    if (!f) return path;
    fprintf(f, "%sMOTION\nFrames: %d\nFrame Time: 0.01\n", HEAD, frames);
    for (int i = 0; i < frames; i++) fprintf(f, "%d %d.0 %de0  %d\r\n", 4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3);
    fclose(f);
    return path;
}

static bool right_row(Session *s, int f) {
    if (!session_row(s, f)) return false;
    for (int i = 0; i < 4; i++)
        if (s->row[i] != 4 * f + i) return false;
    return true;
}

static void test_rows(void) {
    enum { MANY = 50000 };
    const char *path = long_file(MANY);
    bool good = session_open(&session, path, (MotionOptions){0});
    OK(good && session.motion.nframes == MANY, "a file of %d frames", MANY);
    OK(session.arena.held < 400 * 1024, "takes %zu kB", session.arena.held / 1024);
    for (int f = 0; f < MANY && good; f++) good = right_row(&session, f);
    OK(good, "all rows forward");
    unsigned state = 1;
    for (int k = 0; k < 500 && good; k++) {
        state = state * 1103515245u + 12345u;
        good = right_row(&session, (int)(state >> 8) % MANY);
    }
    OK(good, "rows in any order");
    good = right_row(&session, MANY - 1) && right_row(&session, 0) && right_row(&session, MANY - 1);
    OK(good, "the last, the first, the last");
    MotionReader *other;
    double row[4];
    good = motion_reader_open(&session.motion, &session.arena, &other, &session.e);
    for (int f = 0; f < 100 && good; f++)
        good = right_row(&session, f) && motion_row(other, MANY - 1 - f, row, &session.e) &&
            row[0] == 4 * (MANY - 1 - f);
    OK(good, "two readers do not disturb each other");
    unlink(path);
    OK(right_row(&session, 40000), "a file that is deleted meanwhile");
    session_close(&session);
}

static void test_changes(void) {
    const char *path = long_file(50000);
    bool good = session_open(&session, path, (MotionOptions){0}) && right_row(&session, 3);
    good = good && truncate(path, 100000) == 0 && !session_row(&session, 49999);
    OK(good && session.e.kind == ERR_INPUT && strstr(session.e.text, "has changed since"),
       "a file that is cut meanwhile: %s", session.e.text);
    session_close(&session);
    path = long_file(50000);
    good = session_open(&session, path, (MotionOptions){0}) && right_row(&session, 3) && truncate(path, 100000) == 0;
    int f = 4;
    while (f < 50000 && right_row(&session, f)) f++;
    OK(good && f < 50000 && session.e.kind == ERR_INPUT, "the same met in reading forward: %s", session.e.text);
    session_close(&session);
}

static void test_limits(void) {
    static const char two[] = FRAMES("2") "1 2 3 4\n5 6 7 8\n";
    OK(!session_open(&session, file_of(two, sizeof two - 1), (MotionOptions){.max_frames = 1}) &&
       strstr(session.e.text, "limit of 1"),
       "max_frames: %s", session.e.text);
    session_close(&session);
    OK(!session_open(&session, file_of(two, sizeof two - 1), (MotionOptions){.max_joints = 2}) &&
       strstr(session.e.text, "more than 2 joints") && session.e.line == 6,
       "max_joints: %s", session.e.text);
    session_close(&session);
    enum { DEEP = 10000 };
    static char text[DEEP * 24];
    size_t n = 0;
    n += (size_t)sprintf(text, "HIERARCHY\nROOT a\n{OFFSET 0 0 0\n");
    for (int i = 1; i < DEEP; i++) n += (size_t)sprintf(text + n, "JOINT a\n{OFFSET 0 0 0\n");
    OK(!session_open(&session, file_of(text, n), (MotionOptions){0}) && session.e.kind == ERR_INPUT &&
       strstr(session.e.text, "1000 deep"),
       "nested %d deep: %s", DEEP, session.e.text);
    session_close(&session);
    memset(text, 'x', sizeof text);
    memcpy(text, "HIERARCHY\nROOT ", 15);
    OK(!session_open(&session, file_of(text, sizeof text), (MotionOptions){0}) && strstr(session.e.text, "1000 bytes"),
       "an endless name: %s", session.e.text);
    session_close(&session);
    OK(!session_open(&session, "/", (MotionOptions){0}) && strstr(session.e.text, "directory"), "a folder: %s",
       session.e.text);
    session_close(&session);
    OK(!session_open(&session, "/nowhere/x.bvh", (MotionOptions){0}) && session.e.kind == ERR_INPUT, "no file: %s",
       session.e.text);
    session_close(&session);
    OK(!session_open(&session, file_of("HIER\0ARCHY", 10), (MotionOptions){0}) && strstr(session.e.text, "binary"),
       "binary: %s", session.e.text);
    session_close(&session);
}

/* Memory that runs out at any point is an error of that kind, and nothing else; a limit is told as such. */
static void test_memory(void) {
    static const char text[] = FRAMES("2") "1 2 3 4\n5 6 7 8\n";
    const char *path = file_of(text, sizeof text - 1);
    int failed = 0;
    bool good = true, opened = false;
    for (long n = 1; n < 100 && good && !opened; n++) {
        Arena arena = {.fail_after = n};
        Motion m;
        Error e = {0};
        opened = motion_open(path, &(MotionOptions){0}, &arena, NULL, &m, &e);
        good = opened || e.kind == ERR_INTERNAL;
        failed += !opened;
        motion_close(&m);
        arena_free(&arena);
    }
    OK(good && opened && failed > 3, "each of %d allocations may fail", failed);
    opened = false;
    for (size_t limit = 1000; limit < 1 << 20 && good && !opened; limit += 1000) {
        Arena arena = {.limit = limit};
        Motion m;
        Error e = {0};
        opened = motion_open(path, &(MotionOptions){0}, &arena, NULL, &m, &e);
        good = opened || (e.kind == ERR_INPUT && strstr(e.text, "more memory than the limit"));
        if (!good) printf("# %d %s\n", (int)e.kind, e.text);
        motion_close(&m);
        arena_free(&arena);
    }
    OK(good && opened, "any limit of memory");
}

/* The place and the line are right wherever the window stands. */
static void test_far_place(void) {
    static char text[400000];
    size_t n = (size_t)sprintf(text, "%sMOTION\nFrames: 30000\nFrame Time: 0.01\n", HEAD);
    for (int i = 0; i < 30000; i++) n += (size_t)sprintf(text + n, i == 20000 ? "1 2 x3 4\n" : "1 2 3 4\n");
    bool refused = !session_open(&session, file_of(text, n), (MotionOptions){0});
    OK(refused && session.e.line == 20010 && session.e.column == 5 && strcmp(session.e.source, "1 2 x3 4") == 0 &&
       session.e.caret == 4,
       "an error far in the file: %d:%d '%s'", session.e.line, session.e.column, session.e.source);
    session_close(&session);
    for (size_t i = strlen(HEAD) + 40; i < n; i++)
        if (text[i] == '\n') text[i] = ' '; /* one line, longer than the window */
    refused = !session_open(&session, file_of(text, n), (MotionOptions){0});
    OK(refused && session.e.line == 10 && session.e.column == 160005 && strstr(session.e.text, "frame 20001"),
       "an error far in a line: %d:%d", session.e.line, session.e.column);
    session_close(&session);
}

int main(void) {
    if (!folder_make()) return 1;
    test_rows();
    test_changes();
    test_limits();
    test_memory();
    test_far_place();
    folder_remove();
    return tap_done();
}
