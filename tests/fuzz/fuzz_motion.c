/* Whatever the bytes: a motion whose every row can be read, forward and again, or one error with
   a reason. A line of '%%%' parts a skeleton (ASF) from its motion (AMC). */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "motion/motion.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static const char part_mark[] = "%%%\n";

/* A file without a name that holds the bytes, under the path that Linux gives it. */
typedef struct {
    FILE *file;
    char path[32];
} Sheet;

static void write_sheet(Sheet *s, const uint8_t *data, size_t size) {
    if (!s->file && !(s->file = tmpfile())) abort();
    snprintf(s->path, sizeof s->path, "/dev/fd/%d", fileno(s->file));
    if (ftruncate(fileno(s->file), 0) != 0 || pwrite(fileno(s->file), data, size, 0) != (ssize_t)size) abort();
}

static const uint8_t *find_mark(const uint8_t *data, size_t size) {
    size_t n = sizeof part_mark - 1;
    for (size_t i = 0; i + n <= size; i++)
        if (memcmp(data + i, part_mark, n) == 0) return data + i;
    return NULL;
}

static void read_rows(const Motion *m, Arena *arena) {
    Error e = {0};
    MotionReader *r;
    const Skeleton *s = &m->skeleton;
    double *row = ARENA_NEW(arena, double, s->nchannels, &e), *again = ARENA_NEW(arena, double, s->nchannels, &e);
    Rigid *world = ARENA_NEW(arena, Rigid, s->njoints, &e);
    if (!row || !again || !world || !motion_reader_open(m, arena, &r, &e)) abort();
    for (int f = 0; f < m->nframes; f++) {
        if (!motion_row(r, f, row, &e)) abort();
        for (int i = 0; i < s->nchannels; i++)
            if (!(row[i] >= -1e14 && row[i] <= 1e14)) abort(); /* NaN too */
        skeleton_pose(s, row, world);
    }
    if (!motion_row(r, 0, again, &e)) abort();
    if (m->nframes == 1 && memcmp(row, again, (size_t)s->nchannels * sizeof *row) != 0) abort();
    motion_reader_close(r);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static Sheet motion, skeleton;
    static Notes notes;
    Arena arena = {0};
    Error e = {0};
    Motion m;
    MotionOptions options = {.max_frames = 10000, .max_joints = 1000};
    const uint8_t *mark = find_mark(data, size), *rest = mark ? mark + sizeof part_mark - 1 : data;
    write_sheet(&skeleton, data, mark ? (size_t)(mark - data) : 0);
    write_sheet(&motion, rest, size - (size_t)(rest - data));
    options.asf = skeleton.path;
    notes.count = 0;
    if (motion_open(motion.path, &options, &arena, &notes, &m, &e)) read_rows(&m, &arena);
    else if (e.kind != ERR_INPUT || !e.text[0]) abort();
    motion_close(&m);
    arena_free(&arena);
    return 0;
}
