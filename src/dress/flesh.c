/* Of two parts whose boxes are near each other, the distances of each one's skin from the other are measured, for
   many vertices at a time. If any is smaller than the room that cloth needs, the two are a contact, and the same
   distances say how far the skin has to give way. */
#include "dress/flesh.h"

#include "geometry/boxtree.h"

enum { BLOCK = 256 };

/* Vertices of a part's skin. */
typedef struct {
    int n, vertex[BLOCK];
    Vec3 skin[BLOCK];
} Block;

static void add(Block *block, int vertex, Vec3 skin) {
    block->vertex[block->n] = vertex;
    block->skin[block->n++] = skin;
}

static bool boxes_near(Box a, Box b, double room) {
    Vec3 grown = vec(room, room, room);
    return box_touches((Box){vec_sub(a.low, grown), vec_add(a.high, grown)}, b);
}

/* The next vertices of a part, from its *v-th on, that are near the box of another; moves *v on. False if none are
   left. */
static bool gather(const BodyFrame *f, int part, const Contact *contact, int *v, Block *out) {
    int other = contact->other;
    const BodyPart *p = &f->body->part[part];
    const Box *blocks = body_frame_blocks(f, part);
    out->n = 0;
    while (*v < p->nvertices && out->n <= BLOCK - BODY_BLOCK) {
        int end = *v + BODY_BLOCK < p->nvertices ? *v + BODY_BLOCK : p->nvertices;
        bool is_near = boxes_near(blocks[*v / BODY_BLOCK], f->box[other], contact->reach);
        for (int k = *v; is_near && k < end; k++) {
            Vec3 skin = f->position[p->first_vertex + k];
            if (!body_frame_far(f, other, skin, contact->reach)) add(out, p->first_vertex + k, skin);
        }
        *v = end;
    }
    return out->n > 0;
}

/* A part gives way to another: f->give of every vertex becomes the most that any contact asks for. Returns whether the
   other is near at all. */
static bool press(BodyFrame *f, int part, const Contact *contact) {
    double distance[BLOCK], level[BLOCK];
    Vec3 away[BLOCK], normal[BLOCK];
    bool any = false;
    Block all, near;
    for (int v = 0; gather(f, part, contact, &v, &all);) {
        body_frame_unpressed_many(f, contact->other, all.skin, all.n, contact->reach, distance, away);
        near.n = 0;
        for (int i = 0; i < all.n; i++) {
            if (distance[i] >= contact->reach) continue;
            any = true;
            if (!yield_may(contact, body_frame_rest_normal(f, &f->body->part[part], all.vertex[i]), away[i])) continue;
            distance[near.n] = distance[i];
            away[near.n] = away[i];
            add(&near, all.vertex[i], all.skin[i]);
        }
        if (near.n == 0) continue;
        body_frame_unpressed_many(f, part, near.skin, near.n, INFINITY, level, normal);
        for (int i = 0; i < near.n; i++) {
            Give *give = &f->give[near.vertex[i]];
            Meeting m = {near.skin[i], level[i], distance[i], normal[i], away[i]};
            give->level = level[i];
            give->by = fmax(give->by, yield_by(contact, f->room, &m));
        }
    }
    return any;
}

static void meet(BodyFrame *f, int a, int b) {
    Role of_a = f->body->part[a].role, of_b = f->body->part[b].role;
    Contacts *ca = &f->contacts[a], *cb = &f->contacts[b];
    if (!yield_concerns(of_a, of_b) || !boxes_near(f->box[a], f->box[b], f->room)) return;
    Contact *to_b = &ca->contact[ca->n], *to_a = &cb->contact[cb->n];
    yield_contact(of_a, of_b, figure_scale(f->body->height), to_b, to_a);
    const Fold *fold = folds_between(&f->folds, of_a, of_b);
    if (fold) yield_fold(fold, fold->lower == of_b ? to_b : to_a, fold->lower == of_b ? to_a : to_b);
    to_b->other = b;
    to_a->other = a;
    bool b_is_near = press(f, a, to_b), a_is_near = press(f, b, to_a);
    ca->n += a_is_near || b_is_near;
    cb->n += a_is_near || b_is_near;
}

/* The most that a part may give way at p: that of the contacts that may be near there. */
static double most_at(const BodyFrame *f, int part, Vec3 p) {
    const Contacts *contacts = &f->contacts[part];
    double most = 0;
    for (int k = 0; k < contacts->n; k++) {
        const Contact *c = &contacts->contact[k];
        if (!body_frame_far(f, c->other, p, c->reach)) most = fmax(most, c->most);
    }
    return most;
}

/* How far a point of a part's skin must go inwards along its normal to be on the surface that the part has after
   giving way: the first such place; metres. level: the point's distance from the part where nothing presses (about
   0); left: the gap at the skin itself, how far the part gives way there. *n becomes the normal at the place.

   Distances change no faster than the point moves, so a step as long as the gap does not pass the place. Where the
   gap shrinks more slowly than that, steps are longer. If it is small and grows, as inside a joint, the search ends.
   Once a step has passed the place, the Illinois rule finds it: the secant between the two ends, where an end that
   stays twice counts half. */
static double way_in(const BodyFrame *f, int p, Vec3 skin, double level, double left, double most, Vec3 *n) {
    enum { STEPS = 16 };
    static const double CLOSE = 1e-6, SLIGHT = 1e-3, LONGEST = 2; /* metres on 1.70 m, twice; times what is left */
    Vec3 inwards = vec_scale(*n, -1);
    double out = 0, in = INFINITY, over = 0, way = fmin(left, most), scale = figure_scale(f->body->height);
    for (int k = 0, side = 0; k < STEPS && left > 0; k++) {
        double gap = body_frame_distance(f, p, vec_mad(skin, inwards, way), INFINITY, n) - level;
        if (fabs(gap) <= CLOSE * scale || (gap > 0 && way >= most)) break;
        if (left < SLIGHT * scale && gap > left && in == INFINITY) return out;
        double shrinks = (left - gap) / (way - out);
        if (gap > 0) {
            over *= side > 0 ? 0.5 : 1;
            out = way;
            left = gap;
        } else {
            left *= side < 0 ? 0.5 : 1;
            in = way;
            over = -gap;
        }
        side = gap > 0 ? 1 : -1;
        if (in < INFINITY) way = out + (in - out) * left / (left + over);
        else way = fmin(most, out + gap * (LONGEST * shrinks > 1 ? fmax(1, 1 / shrinks) : LONGEST));
    }
    return way;
}

/* Moves the skin of a part to where it has given way. */
static void give_way(BodyFrame *f, int p) {
    const BodyPart *part = &f->body->part[p];
    for (int v = part->first_vertex; v < part->first_vertex + part->nvertices; v++) {
        const Give *give = &f->give[v];
        if (give->by <= 0) continue;
        Vec3 skin = f->position[v], outwards = body_frame_rest_normal(f, part, v), n = outwards;
        double way = way_in(f, p, skin, give->level, give->by, most_at(f, p, skin), &n);
        f->position[v] = vec_mad(skin, outwards, -way);
        box_add(&f->skin[p], f->position[v]);
        f->normal[v] = n;
    }
}

/* Where a part has given way its surface is hollow. There the straight edges between the skin's vertices stand out of
   it, by some millimetres, which is as much as the cloth has for itself. So the vertices go in by as much, each in
   proportion to how far it has given way and at most that far again: nothing jumps when parts begin to touch. */
static void sink_edges(BodyFrame *f, int p) {
    static const double MOST = 0.008; /* metres on 1.70 m: over a narrow dent an edge stands out far */
    const BodyPart *part = &f->body->part[p];
    double most = MOST * figure_scale(f->body->height);
    for (int k = part->first_edge; k < part->first_edge + part->nedges; k++) {
        const int *v = f->body->skin.edge[k].v;
        double both = f->give[v[0]].by + f->give[v[1]].by;
        if (both <= 0) continue;
        Vec3 middle = vec_lerp(f->position[v[0]], f->position[v[1]], 0.5);
        double out = fmin(body_frame_distance(f, p, middle, INFINITY, NULL), most);
        for (int end = 0; end < 2; end++) {
            Give *give = &f->give[v[end]];
            give->sunk = fmax(give->sunk, fmin(2 * out / both, 1) * give->by);
        }
    }
    for (int v = part->first_vertex; v < part->first_vertex + part->nvertices; v++) {
        if (f->give[v].sunk <= 0) continue;
        f->position[v] = vec_mad(f->position[v], body_frame_rest_normal(f, part, v), -f->give[v].sunk);
        box_add(&f->skin[p], f->position[v]);
    }
}

void flesh_press(BodyFrame *f) {
    int n = f->body->nparts;
    for (int p = 0; p < n; p++) f->contacts[p].n = 0;
    for (int v = 0; v < f->body->skin.nvertices; v++) f->give[v].by = f->give[v].sunk = 0;
    for (int a = 0; a < n; a++)
        for (int b = a + 1; b < n; b++) meet(f, a, b);
    for (int p = 0; p < n; p++) {
        if (f->contacts[p].n == 0) continue;
        give_way(f, p);
        sink_edges(f, p);
    }
}
