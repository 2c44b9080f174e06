/* Two closed triangles share a point if and only if a side of one meets the other: where they cut
   each other the common segment ends at a side, where they lie in one plane a side crosses the
   other triangle or lies within it. So six exact tests of a segment against a triangle decide a
   pair, and boxes spare most pairs the question. */
#include "dress/verify.h"

#include "dress/border.h"
#include "geometry/predicate.h"

bool solid_make(const Mesh *body, const bool *wanted, Arena *arena, Solid *out, Error *e) {
    bool *take = wanted ? ARENA_NEW(arena, bool, body->ntriangles, e) : NULL;
    out->mesh = body;
    out->group = ARENA_NEW(arena, int, body->ntriangles, e);
    if ((wanted && !take) || !out->group) return false;
    for (int t = 0; t < body->ntriangles; t++) out->group[t] = -1;
    for (int g = 0; g < body->ngroups; g++)
        for (int k = 0; k < body->group[g].count; k++) {
            int t = body->group[g].first + k;
            out->group[t] = g;
            if (take) take[t] = wanted[g];
        }
    return shells_find(body, take, arena, &out->shells, e);
}

typedef struct {
    Vec3 v[3];
} Corners;

static Corners corners(const Mesh *m, int t) {
    const int *v = m->triangle[t].v;
    return (Corners){{m->position[v[0]], m->position[v[1]], m->position[v[2]]}};
}

static bool side_meets(const Corners *a, const Corners *b) {
    for (int k = 0; k < 3; k++)
        if (predicate_segment_triangle(a->v[k], a->v[(k + 1) % 3], b->v[0], b->v[1], b->v[2])) return true;
    return false;
}

typedef struct {
    const Solid *body;
    const Mesh *garment;
    Findings findings;
    int *per_group;
    Verdict *verdict;
} Check;

static void report(Check *c, Finding f) {
    int group = f.other >= 0 ? c->body->group[f.other] : -1;
    if (group >= 0) c->per_group[group]++;
    if (c->findings.found) c->findings.found(c->findings.context, &f);
}

static void find_pairs(Check *c, int t) {
    Corners a = corners(c->garment, t);
    Box box = box_of_triangle(c->garment->position, c->garment->triangle[t]);
    for (int s = 0; s < c->body->shells.count; s++) {
        const BoxTree *surface = &c->body->shells.shell[s].surface;
        if (!box_touches(boxtree_box(surface), box)) continue;
        BoxWalk walk = boxtree_walk(surface, box);
        for (int other; (other = boxtree_next(&walk)) >= 0;) {
            Corners b = corners(c->body->mesh, other);
            if (!side_meets(&a, &b) && !side_meets(&b, &a)) continue;
            c->verdict->pairs++;
            Vec3 middle = vec_scale(vec_add(vec_add(a.v[0], a.v[1]), a.v[2]), 1.0 / 3);
            report(c, (Finding){.kind = FINDING_PAIR, .item = t, .other = other, .at = middle});
        }
    }
}

/* Solids overlap, so the depth is that in the one where it is largest. */
static void find_inside(Check *c, int v) {
    Vec3 p = c->garment->position[v];
    Finding f = {.kind = FINDING_INSIDE, .item = v, .other = -1, .at = p};
    for (int s = 0; s < c->body->shells.count; s++) {
        const Shell *shell = &c->body->shells.shell[s];
        int nearest = -1;
        if (!shell_holds(shell, p)) continue;
        double d = boxtree_nearest(&shell->surface, p, &nearest, NULL);
        if (f.other < 0 || d > f.distance) f.distance = d, f.other = nearest;
    }
    if (f.other < 0) return;
    c->verdict->inside++;
    c->verdict->deepest = fmax(c->verdict->deepest, f.distance);
    report(c, f);
}

static bool find_cracks(Check *c, double width, Arena *arena, Error *e) {
    Border border;
    if (!border_find(c->garment, width, arena, &border, e)) return false;
    c->verdict->borders = border.pieces;
    c->verdict->cracks = border.ncracks;
    for (int k = 0; k < border.ncracks; k++) {
        int v = border.crack[k].vertex;
        report(c, (Finding){FINDING_CRACK, v, -1, border.crack[k].distance, c->garment->position[v]});
    }
    return true;
}

bool verify_meshes(const Solid *body, const Mesh *garment, double crack, Findings findings, Arena *arena, Verdict *out,
                   Error *e) {
    *out = (Verdict){.worst = -1};
    Check c = {body, garment, findings, ARENA_NEW(arena, int, body->mesh->ngroups, e), out};
    bool *used = ARENA_NEW(arena, bool, garment->nvertices, e);
    if (!c.per_group || !used) return false;
    for (int t = 0; t < garment->ntriangles; t++) {
        find_pairs(&c, t);
        for (int k = 0; k < 3; k++) used[garment->triangle[t].v[k]] = true;
    }
    for (int v = 0; v < garment->nvertices; v++)
        if (used[v]) find_inside(&c, v);
    for (int g = 0; g < body->mesh->ngroups; g++)
        if (c.per_group[g] > (out->worst < 0 ? 0 : c.per_group[out->worst])) out->worst = g;
    return find_cracks(&c, crack, arena, e);
}
