/* What a posed body is asked: distances from its parts, which give way to each other (dress/yield), and boxes over its
   skin. Most questions are answered by a part's bounding box alone. */
#include "dress/bodyframe.h"

#include "geometry/boxtree.h"

enum { LOT = 64 }; /* points that are asked about at a time */

bool body_frame_init(BodyFrame *f, const Body *body, double unit, Arena *arena, Error *e) {
    *f = (BodyFrame){.body = body, .unit = unit, .room = YIELD_ROOM * figure_scale(body->height)};
    f->position = ARENA_NEW(arena, Vec3, body->skin.nvertices, e);
    f->normal = ARENA_NEW(arena, Vec3, 2 * body->skin.nvertices, e);
    f->give = ARENA_NEW(arena, Give, body->skin.nvertices, e);
    f->block = ARENA_NEW(arena, Box, body->skin.nvertices / BODY_BLOCK + body->nparts, e);
    if (!f->position || !f->normal || !f->give || !f->block) return false;
    f->boxes = ARENA_NEW(arena, BodyBoxes, 1, e);
    if (!f->boxes) return false;
    pthread_mutex_init(&f->boxes->making, NULL);
    for (int p = 0; p < body->nparts; p++)
        if (!crossing_reserve(&f->boxes->edges[p], body->part[p].nedges, arena, e) ||
            !crossing_reserve(&f->boxes->triangles[p], body->part[p].ntriangles, arena, e))
            return false;
    return true;
}

static double distance_in_box(const BodyFrame *f, int part, BodyPoint *p, double far, Vec3 *normal) {
    BodyLook *look = &p->look[part];
    if (!(p->known >> part & 1)) {
        look->p = rigid_apply(f->to_part[part], p->at);
        look->looks = 0;
        p->known |= 1u << part;
    }
    double d = body_look(&f->body->part[part], look, far, normal);
    if (normal && d < far) *normal = mat_apply(f->to_world[part], *normal);
    return d;
}

/* Distance from a part as if nothing pressed on it. The test against its box is inline, since it answers most calls. */
static inline double own_distance(const BodyFrame *f, int part, BodyPoint *p, double far, Vec3 *normal) {
    return body_frame_far(f, part, p->at, far) ? far : distance_in_box(f, part, p, far, normal);
}

/* How far a part gives way at a point that is m->distance away from it: to the contact that asks for most. *normal,
   if not NULL, becomes the part's normal after that. */
static double give_way(const BodyFrame *f, int part, BodyPoint *p, Meeting *m, Vec3 *normal) {
    const Contacts *contacts = &f->contacts[part];
    double most = 0;
    Meeting with_most;
    const Contact *to = NULL;
    for (int k = 0; k < contacts->n; k++) {
        const Contact *contact = &contacts->contact[k];
        if (contact->most <= most) continue;
        double far = yield_within(contact, f->room, m->at, m->distance);
        m->other = own_distance(f, contact->other, p, far, &m->away);
        double by = m->other < far ? yield_by(contact, f->room, m) : 0;
        if (by <= most) continue;
        most = by;
        to = contact;
        with_most = *m;
    }
    if (normal) *normal = to ? yield_normal(to, f->room, &with_most) : m->normal;
    return most;
}

double body_point_distance(const BodyFrame *f, int part, BodyPoint *p, double far, Vec3 *normal) {
    if (f->contacts[part].n == 0) return own_distance(f, part, p, far, normal);
    Meeting m;
    m.at = p->at;
    m.distance = own_distance(f, part, p, far, &m.normal);
    if (m.distance >= far) return m.distance;
    if (m.distance < f->room) return m.distance + give_way(f, part, p, &m, normal);
    if (normal) *normal = m.normal;
    return m.distance;
}

double body_point_unpressed(const BodyFrame *f, int part, BodyPoint *p, double far) {
    return own_distance(f, part, p, far, NULL);
}

double body_frame_distance(const BodyFrame *f, int part, Vec3 p, double far, Vec3 *normal) {
    if (body_frame_far(f, part, p, far)) return far;
    BodyPoint point;
    body_point_move(&point, p);
    return body_point_distance(f, part, &point, far, normal);
}

void body_frame_unpressed_many(const BodyFrame *f, int part, const Vec3 *p, int n, double far, double *distance,
                               Vec3 *normal) {
    body_distances(&f->body->part[part], f->vectors, &f->to_part[part], p, n, far, distance, normal);
    for (int i = 0; normal && i < n; i++)
        if (distance[i] < far) normal[i] = mat_apply(f->to_world[part], normal[i]);
}

/* Most points are beyond `far` even if nothing pressed on the part; the others are measured again one by one. */
void body_frame_distances(const BodyFrame *f, int part, const Vec3 *p, int n, double far, double *distance) {
    body_frame_unpressed_many(f, part, p, n, far, distance, NULL);
    for (int i = 0; i < n && f->contacts[part].n > 0; i++)
        if (distance[i] < far) distance[i] = body_frame_distance(f, part, p[i], far, NULL);
}

static bool any_inside_part(const BodyFrame *f, int part, const Vec3 *p, int n) {
    Vec3 at[LOT];
    double distance[LOT];
    int count = 0;
    for (int i = 0; i < n; i++)
        if (!body_frame_far(f, part, p[i], 0)) at[count++] = p[i];
    if (count > 0) body_frame_distances(f, part, at, count, 0, distance);
    for (int i = 0; i < count; i++)
        if (distance[i] < 0) return true;
    return false;
}

bool body_frame_any_inside(const BodyFrame *f, unsigned parts, const Vec3 *p, int n) {
    Box box = box_empty();
    for (int i = 0; i < n; i++) box_add(&box, p[i]);
    for (int k = 0; k < f->body->nparts; k++) {
        if (!(parts & part_bit(f, k)) || !box_touches(box, f->box[k])) continue;
        for (int i = 0; i < n; i += LOT)
            if (any_inside_part(f, k, p + i, n - i < LOT ? n - i : LOT)) return true;
    }
    return false;
}

/* The boxes of a part, made if they are not yet; NULL if its skin does not touch `cloth`. */
static const BodyBoxes *boxes_near(const BodyFrame *f, int part, Box cloth) {
    const BodyPart *p = &f->body->part[part];
    const Mesh *skin = &f->body->skin;
    BodyBoxes *b = f->boxes;
    Box own = {vec_scale(f->skin[part].low, f->unit), vec_scale(f->skin[part].high, f->unit)};
    if (!box_touches(own, cloth)) return NULL;
    pthread_mutex_lock(&b->making);
    if (!(b->made >> part & 1)) {
        crossing_build_edges(&b->edges[part], f->position, skin->edge + p->first_edge, p->nedges);
        crossing_build_triangles(&b->triangles[part], f->position, skin->triangle + p->first_triangle, p->ntriangles);
        b->made |= 1u << part;
    }
    pthread_mutex_unlock(&b->making);
    return b;
}

const CrossingSet *body_frame_edges(const BodyFrame *f, int part, Box cloth) {
    const BodyBoxes *b = boxes_near(f, part, cloth);
    return b ? &b->edges[part] : NULL;
}

const CrossingSet *body_frame_triangles(const BodyFrame *f, int part, Box cloth) {
    const BodyBoxes *b = boxes_near(f, part, cloth);
    return b ? &b->triangles[part] : NULL;
}
