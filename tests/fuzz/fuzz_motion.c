/* Whatever the bytes: a motion whose every row can be read, forward and again, or one error with
   a reason. A line of '%%%' parts a skeleton (ASF) from its motion (AMC). */
#include "motion/motion.h"

#include "parts.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

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
    if (part_find(data, size)) part_take(&data, &size, &skeleton);
    else sheet_write(&skeleton, "", 0);
    sheet_write(&motion, data, size);
    options.asf = skeleton.path;
    notes.count = 0;
    if (motion_open(motion.path, &options, &arena, &notes, &m, &e)) read_rows(&m, &arena);
    else if (e.kind != ERR_INPUT || !e.text[0]) abort();
    motion_close(&m);
    arena_free(&arena);
    return 0;
}
