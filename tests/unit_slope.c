/* Hollows with anything wanted anywhere in a skirt, on somebody who crouches: no edge is stretched too far, nothing is
   shallower than that takes, and the order of the edges does not matter. */
#include "worn.h"

#include <string.h>

static const double STRETCH = 2.3, SHRINKS = 0.8; /* as in src/dress/slope.c */
enum { MOST = 1 << 14 };

typedef struct {
    Worn worn;
    Slopes slopes;
    double *wanted[LIMBS], *depth[LIMBS];
} Cut;

static void open(Cut *t) {
    worn_open(&t->worn, "skirt", 5, 1);
    Scene *s = &t->worn.of.scene;
    Pose pose = figure_rest_pose();
    need(s, slopes_reserve(&t->slopes, &t->worn.of.lattice, &s->arena, &s->error));
    for (int limb = 0; limb < LIMBS; limb++) {
        t->wanted[limb] = ARENA_NEW(&s->arena, double, t->worn.of.lattice.nplaces, &s->error);
        t->depth[limb] = ARENA_NEW(&s->arena, double, t->worn.of.lattice.nplaces, &s->error);
        need(s, t->wanted[limb] && t->depth[limb]);
    }
    scene_leg(s, &pose, true, 100, 120);
    scene_leg(s, &pose, false, 60, 110);
    worn_pose(&t->worn, &pose, 1);
    push_rest(&t->worn.cloth.push);
}

/* Bumps anywhere, and in every tenth place no room. */
static void want(Cut *t, int limb) {
    const Push *p = &t->worn.cloth.push;
    Vec3 middle[4];
    for (int k = 0; k < 4; k++) middle[k] = p->point[dice_below((unsigned)p->sheet->nvertices)];
    t->worn.cloth.push.field.way[limb] = vec_unit_or(dice_around(), vec(1, 0, 0));
    for (int v = 0; v < p->sheet->nvertices; v++) {
        t->wanted[limb][v] = 0;
        for (int k = 0; k < 4 && dice_below(10) > 0; k++)
            t->wanted[limb][v] = fmax(t->wanted[limb][v], 0.2 - vec_dist(p->point[v], middle[k]));
        t->depth[limb][v] = t->wanted[limb][v];
    }
}

static Vec3 moved(const Cut *t, int v) {
    Vec3 x = t->worn.cloth.push.point[v];
    for (int limb = 0; limb < LIMBS; limb++) x = vec_mad(x, t->worn.cloth.push.field.way[limb], t->depth[limb][v]);
    return x;
}

/* By how many metres an edge between two points is longer than it may be, for vertices that were not pressed in. */
static double too_long(const Cut *t, int a, int b, Vec3 at_a, Vec3 at_b) {
    const Push *p = &t->worn.cloth.push;
    const Vec3 *rest = p->escape.rest;
    double most = STRETCH * vec_dist(rest[p->sheet->place[a]], rest[p->sheet->place[b]]);
    return vec_dist(at_a, at_b) - fmax(most, vec_dist(p->point[a], p->point[b]));
}

static double longest_of_all(const Cut *t) {
    double most = -INFINITY;
    for (int k = 0; k < t->worn.cloth.sheet.nedges; k++) {
        int a = t->worn.cloth.sheet.edge[k].v[0], b = t->worn.cloth.sheet.edge[k].v[1];
        most = max_of(most, too_long(t, a, b, moved(t, a), moved(t, b)));
    }
    return most;
}

/* Does an edge keep the vertex from going in by a hundredth of a millimetre more? */
static bool is_held(Cut *t, int v) {
    const Push *p = &t->worn.cloth.push;
    Vec3 way = p->field.way[0], deeper = vec_mad(moved(t, v), way, 1e-5);
    int n;
    const int *beside = slopes_beside(&t->slopes, p->sheet, v, &n);
    for (int k = 0; k < n; k++) {
        Vec3 to = vec_sub(p->point[beside[k]], p->point[v]);
        double ahead = (t->depth[0][v] + 1e-5 - t->depth[0][beside[k]]) * vec_dot(way, to);
        bool is_past = ahead > SHRINKS * vec_dot(to, to);
        if (is_past || too_long(t, v, beside[k], deeper, moved(t, beside[k])) > 0) return true;
    }
    return false;
}

static void turn_edges_round(Sheet *s) {
    for (int k = 0; k < s->nedges / 2; k++) {
        Edge e = s->edge[k];
        s->edge[k] = s->edge[s->nedges - 1 - k];
        s->edge[s->nedges - 1 - k] = e;
    }
}

static void levels_one(Cut *t) {
    static double first[MOST];
    Sheet *sheet = &t->worn.cloth.sheet;
    int n = sheet->nvertices, lower = 0, free_ones = 0;
    bool good = true;
    double longest = -INFINITY, off = 0;
    for (int round = 0; round < 10; round++) {
        want(t, 0);
        good = good && slopes_level(&t->slopes, &t->worn.cloth.push, (Limb)0, t->wanted, t->depth[0]);
        longest = max_of(longest, longest_of_all(t));
        for (int v = 0; v < n; v++) {
            bool is_lower = t->depth[0][v] < t->wanted[0][v];
            lower += is_lower;
            free_ones += t->depth[0][v] > t->wanted[0][v] || t->depth[0][v] < 0 || (is_lower && !is_held(t, v));
        }
        memcpy(first, t->depth[0], (size_t)n * sizeof *first);
        memcpy(t->depth[0], t->wanted[0], (size_t)n * sizeof *first);
        turn_edges_round(sheet);
        good = good && slopes_level(&t->slopes, &t->worn.cloth.push, (Limb)0, t->wanted, t->depth[0]);
        turn_edges_round(sheet);
        for (int v = 0; v < n; v++) off = max_of(off, fabs(t->depth[0][v] - first[v]));
    }
    OK(good && longest < 1e-9, "no edge is longer than it may be (%.2g mm)", 1000 * longest);
    OK(lower > 0 && free_ones == 0, "of %d vertices made shallower none could be deeper (%d)", lower, free_ones);
    OK(off < 1e-9, "the order of the edges does not matter (%.2g mm)", 1000 * off);
    memset(t->depth[0], 0, (size_t)n * sizeof *first);
}

static void levels_several(Cut *t) {
    double longest = -INFINITY;
    bool good = true;
    for (int round = 0; round < 10; round++) {
        for (int limb = 0; limb < LIMBS; limb++) want(t, limb);
        for (int limb = 0; limb < LIMBS; limb++)
            good = slopes_level(&t->slopes, &t->worn.cloth.push, (Limb)limb, t->wanted, t->depth[limb]) && good;
        longest = max_of(longest, longest_of_all(t));
    }
    OK(good && longest < 1e-9, "nor is one in the hollows of three limbs (%.2g mm)", 1000 * longest);
}

/* How much too long the worst edge of a vertex is if the vertex is at x. */
static double worst_beside(Cut *t, int v, Vec3 x) {
    const Push *p = &t->worn.cloth.push;
    double worst = -INFINITY;
    int n;
    const int *beside = slopes_beside(&t->slopes, p->sheet, v, &n);
    for (int k = 0; k < n; k++) worst = max_of(worst, too_long(t, v, beside[k], x, p->point[beside[k]]));
    return worst;
}

static void moves_one(Cut *t) {
    Push *p = &t->worn.cloth.push;
    double longest = -INFINITY, shortest = 0, kept = 0;
    int nshort = 0;
    for (int round = 0; round < 1000; round++) {
        int v = (int)dice_below((unsigned)p->sheet->nvertices), n;
        Vec3 x = p->point[v], by = vec_scale(dice_around(), 0.1);
        double share = slopes_share(&t->slopes, p, v, by), over = worst_beside(t, v, vec_mad(x, by, share));
        longest = max_of(longest, over);
        nshort += share < 1;
        if (share < 1) shortest = min_of(shortest, over);
        if (share == 1) continue;
        int beside = slopes_beside(&t->slopes, p->sheet, v, &n)[0];
        p->field.dent[0].at[p->sheet->place[v]] = by;
        p->point[v] = vec_add(x, by);
        double keeps = slopes_keeps(p, v, beside);
        p->field.dent[0].at[p->sheet->place[v]] = vec(0, 0, 0);
        p->point[v] = x;
        kept = max_of(kept, too_long(t, v, beside, vec_mad(x, by, keeps), p->point[beside]));
    }
    OK(longest < 1e-9 && nshort > 100, "a single vertex stretches none too far (%.2g mm)", 1000 * longest);
    OK(shortest > -1e-9, "and goes as far as they let it (%.2g mm)", 1000 * shortest);
    OK(kept < 1e-9, "nor does what it keeps of a dent (%.2g mm)", 1000 * kept);
}

int main(void) {
    static Cut t;
    open(&t);
    OK(t.worn.cloth.sheet.nvertices < MOST, "a skirt of %d vertices", t.worn.cloth.sheet.nvertices);
    levels_one(&t);
    levels_several(&t);
    moves_one(&t);
    arena_free(&t.worn.of.scene.arena);
    return tap_done();
}
