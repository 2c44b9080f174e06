/* `kitsuke walk`: checks what was asked for, fills in what was not, and writes the motion. */
#include "motion/gait.h"

#include <string.h>

#include "motion/gait_body.h"
#include "motion/gait_paper.h"

/* A natural step is 0.41 statures long (Winter 1991: stride 0.83), and 110 steps a minute
   are a natural cadence. */
#define NATURAL_STEP 0.41
#define NATURAL_STEP_TIME (60.0 / 110.0)

void gait_defaults(Gait *g) {
    *g = (Gait){.preset = "normal", .frames_per_step = 36, .height = 1.70, .arm_swing = -1};
}

static bool write_paper(const Gait *g, const GaitBody *body, double frame_time, FILE *out) {
    int frames = g->steps * g->frames_per_step;
    gait_write_head(body, frames, frame_time, out);
    for (int i = 0; i < frames; i++) {
        GaitPose pose = gait_paper_pose(g, body, i);
        gait_write_pose(&pose, out);
    }
    return true;
}

bool gait_write(const Gait *g, FILE *out, Error *e) {
    Gait full = *g;
    if (strcmp(g->preset, "paper") != 0) return error_set(e, ERR_USAGE, "unknown preset '%s'", g->preset);
    if (full.steps == 0) full.steps = 2;
    if (full.step_length == 0) full.step_length = NATURAL_STEP * full.height;
    if (full.speed == 0) full.speed = full.step_length / NATURAL_STEP_TIME;
    GaitBody body = gait_body(100 * full.height);
    double frame_time = full.step_length / full.speed / full.frames_per_step;
    write_paper(&full, &body, frame_time, out);
    if (ferror(out)) return error_set(e, ERR_OUTPUT, "cannot write the motion");
    return true;
}
