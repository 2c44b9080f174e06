/* From the crotch to the middle of a thigh that is bent far or spread, the way is up to twice as long as at rest, and
   the next row, along the thigh, is as long as ever. If the nodes between them stayed where they are on the thigh, one
   row alone would be stretched. So they share it. */
#include "dress/ride.h"

static const double STRETCHED = 1.5; /* times its length at rest: a row that is longer draws the next one up, */
static const double SHARE = 0.5;     /* by this share of what it is longer */

static bool slides(const FitNode *node) {
    Role bone = node->binding.bone[0];
    return node->binding.n == 1 && (bone == ROLE_LEFT_THIGH || bone == ROLE_RIGHT_THIGH);
}

/* How far each node slides, metres. Of several columns that lead to it the longest decides. */
static void find(const Fit *fit, Vec3 (*curve)[4], double *up) {
    for (int n = 0; n < fit->nnodes; n++) up[n] = 0;
    for (const FitPanel *p = fit->panel; p < fit->panel + fit->npanels; p++)
        for (int k = 2; k < 2 * p->nrows; k++) {
            int above = p->curve[k / 2 - 1], here = p->curve[k / 2], end = 3 * (k % 2);
            double rest = vec_dist(fit->curve[above].rest[end], fit->curve[here].rest[end]);
            double longer = vec_dist(curve[above][end], curve[here][end]) - STRETCHED * rest;
            int node = fit->curve[here].node[k % 2];
            up[node] = fmax(up[node], SHARE * longer);
        }
}

void ride_up(const Fit *fit, const Figure *figure, const Pose *pose, Vec3 (*curve)[4], double *up) {
    find(fit, curve, up);
    for (int k = 0; k < 2 * fit->ncurves; k++) {
        const FitNode *node = &fit->node[fit->curve[k / 2].node[k % 2]];
        if (!slides(node)) continue;
        Role thigh = node->binding.bone[0];
        Vec3 along = vec_unit_or(vec_sub(figure->start[thigh], figure->end[thigh]), vec(0, 1, 0));
        Vec3 by = vec_scale(mat_apply(pose->bone[thigh].r, along), up[fit->curve[k / 2].node[k % 2]]);
        for (int c = 0; c < 2; c++) {
            Vec3 *point = &curve[k / 2][2 * (k % 2) + c];
            *point = vec_add(*point, by);
        }
    }
}
