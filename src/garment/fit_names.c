/* Names of control points, once they are given: they are numbered, and a side with names that no other side has is a
   border. */
#include "garment/fit_parts.h"

void fit_side(const FitPatch *patch, Side side, int out[4]) {
    for (int k = 0; k < 4; k++) out[k] = patch->point[side_point(side, k)];
}

static bool is_border(const Fit *f, int patch, Side side) {
    int mine[4], other[4];
    fit_side(&f->patch[patch], side, mine);
    for (int p = 0; p < f->npatches; p++)
        for (int s = 0; s < 4; s++) {
            if (p == patch && s == (int)side) continue;
            fit_side(&f->patch[p], (Side)s, other);
            bool same = other[1] == mine[1] && other[2] == mine[2], back = other[1] == mine[2] && other[2] == mine[1];
            if (same || back) return false;
        }
    return true;
}

/* Border sides are connected at corners; each loop of them is an opening. label: room for npoints values. */
static int count_openings(const Fit *f, int *label) {
    int loops = 0;
    for (int k = 0; k < f->npoints; k++) label[k] = -1;
    for (int p = 0; p < f->npatches; p++)
        for (int s = 0; s < 4; s++) {
            if (!is_border(f, p, (Side)s)) continue;
            int side[4];
            fit_side(&f->patch[p], (Side)s, side);
            int a = label[side[0]], b = label[side[3]];
            if (a < 0 && b < 0) loops++;
            else if (a >= 0 && b >= 0 && a != b) loops--;
            int mine = a >= 0 ? a : b >= 0 ? b : side[0];
            for (int k = 0; k < f->npoints && b >= 0 && b != mine; k++)
                if (label[k] == b) label[k] = mine;
            label[side[0]] = label[side[3]] = mine;
        }
    return loops;
}

bool fit_number_points(Fit *f, Arena *arena, Error *e) {
    int *seen = ARENA_NEW(arena, int, 16 * f->npatches, e);
    if (!seen) return false;
    for (int p = 0; p < f->npatches; p++)
        for (int c = 0; c < 16; c++) {
            int id = 0;
            while (id < f->npoints && seen[id] != f->patch[p].point[c]) id++;
            if (id == f->npoints) seen[f->npoints++] = f->patch[p].point[c];
            f->patch[p].point[c] = id;
        }
    f->nopenings = count_openings(f, seen);
    return true;
}
