/* A motion that a unit program has opened, with one reader and room for a row and a pose. */
#ifndef TESTS_SESSION_H
#define TESTS_SESSION_H

#include <string.h>

#include "motion/motion.h"

typedef struct {
    Arena arena;
    Notes notes;
    Motion motion;
    MotionReader *reader;
    Error e;
    double *row;
    Rigid *world;
} Session;

/* A Session is large, since it holds notes. Close it also if this fails. */
static inline bool session_open(Session *s, const char *path, MotionOptions options) {
    memset(s, 0, sizeof *s);
    if (!motion_open(path, &options, &s->arena, &s->notes, &s->motion, &s->e)) return false;
    s->row = ARENA_NEW(&s->arena, double, s->motion.skeleton.nchannels, &s->e);
    s->world = ARENA_NEW(&s->arena, Rigid, s->motion.skeleton.njoints, &s->e);
    return s->row && s->world && motion_reader_open(&s->motion, &s->arena, &s->reader, &s->e);
}

static inline bool session_row(Session *s, int frame) { return motion_row(s->reader, frame, s->row, &s->e); }

static inline bool session_pose(Session *s, int frame) {
    if (!session_row(s, frame)) return false;
    skeleton_pose(&s->motion.skeleton, s->row, s->world);
    return true;
}

static inline void session_close(Session *s) {
    motion_reader_close(s->reader);
    motion_close(&s->motion);
    arena_free(&s->arena);
}

/* Was this said, there? message is a part of the text; line and column 0 are anywhere. */
static inline bool session_told(const Error *e, const char *message, int line, int column) {
    if (strstr(e->text, message) && (!line || e->line == line) && (!column || e->column == column)) return true;
    printf("# told '%s' at %d:%d, wanted '%s' at %d:%d\n", e->text, e->line, e->column, message, line, column);
    return false;
}

#endif
