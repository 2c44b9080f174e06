/* A shipped garment on the reference figure, and what it is made of, for the unit programs that look inside. */
#ifndef TESTS_SPECIMEN_H
#define TESTS_SPECIMEN_H

#include "dice.h"
#include "dress/follow.h"
#include "dress/tessellate.h"
#include "scene.h"

/* Its members point at each other: it is not to be copied. */
typedef struct {
    Scene scene;
    Fit fit;
    Follower follower;
    Lattice lattice;
    Leaves leaves;
    Sheet sheet;
    Patch *root;
} Specimen;

/* Lies on the garment's root patches in the bind pose, split to the same depth everywhere. */
static inline void specimen_open(Specimen *c, const char *garment, int detail, int depth) {
    Scene *s = &c->scene;
    Pose rest = figure_rest_pose();
    scene_open(s, garment);
    need(s, fit_garment(s->garment, &s->figure, &s->body, &s->arena, &c->fit, &s->error));
    need(s, follow_reserve(&c->follower, &c->fit, &s->figure, &s->body, &s->arena, &s->error));
    need(s, lattice_build(&c->fit, detail, depth, &s->arena, &c->lattice, &s->error));
    need(s, leaves_reserve(&c->leaves, &c->lattice, &s->arena, &s->error));
    need(s, sheet_reserve(&c->sheet, &c->lattice, &s->arena, &s->error));
    c->root = ARENA_NEW(&s->arena, Patch, c->fit.npatches, &s->error);
    need(s, c->root != NULL);
    follow_pose(&c->follower, &rest, c->root);
    leaves_fill(&c->leaves, depth);
    tessellate(&c->sheet, &c->leaves);
}

/* Splits about as many cells as there are patches, anywhere and to any level. */
static inline void specimen_split_at_random(Specimen *c) {
    leaves_fill(&c->leaves, 0);
    for (int k = 0; k < c->fit.npatches; k++) {
        int level = (int)(dice_unit() * (c->lattice.depth + 1)), cells = 1 << level;
        int a = (int)(dice_unit() * cells), b = (int)(dice_unit() * cells);
        leaves_split(&c->leaves, (int)(dice_unit() * c->fit.npatches), level, a, b);
    }
}

#endif
