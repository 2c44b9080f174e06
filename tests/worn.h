/* A shipped garment on the reference figure as the solver holds it, for the unit programs that take its steps one by
   one. */
#ifndef TESTS_WORN_H
#define TESTS_WORN_H

#include "dress/attempt.h"
#include "specimen.h"

typedef struct {
    Specimen of;
    Cloth cloth;
} Worn;

/* In the bind pose, split to the same depth everywhere. */
static inline void worn_open(Worn *w, const char *garment, int detail, int depth) {
    specimen_open(&w->of, garment, detail, depth);
    Scene *s = &w->of.scene;
    need(s, cloth_reserve(&w->cloth, &w->of.fit, &w->of.lattice, &s->arena, &s->error));
    escape_bind(&w->cloth.push.escape, w->of.root);
}

/* At the global shape of a pose; nothing is pushed yet. Level vertices may move down to the level `mobile`. */
static inline void worn_pose(Worn *w, const Pose *pose, int mobile) {
    Cloth *c = &w->cloth;
    const BodyFrame *body = &w->of.scene.posed;
    body_frame_pose(&w->of.scene.posed, pose);
    follow_pose(&w->of.follower, pose, w->of.root);
    c->root = w->of.root;
    leaves_copy(&w->of.leaves, &c->leaves);
    tessellate(&c->sheet, &c->leaves);
    leaves_fill(&c->leaves, mobile);
    c->push.coarser = 1;
    push_start(&c->push, body, c->root, &c->leaves, &c->sheet);
    settle_start(&c->settler);
}

#endif
