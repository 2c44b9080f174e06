/* Posing the body: its parts to the world, each lets the others press on it (dress/yield), and what is then
   its skin goes to the precision of the text and is boxed part by part. */
#include "dress/bodyframe.h"

#include "base/clock.h"
#include "geometry/boxtree.h"

bool body_frame_init(BodyFrame *f, const Body *body, double unit, Arena *arena, Error *e) {
    *f = (BodyFrame){.body = body, .unit = unit};
    f->position = ARENA_NEW(arena, Vec3, body->skin.nvertices, e);
    f->normal = ARENA_NEW(arena, Vec3, 2 * body->skin.nvertices, e);
    if (!f->position || !f->normal) return false;
    for (int p = 0; p < body->nparts; p++)
        if (!crossing_reserve(&f->edges[p], body->part[p].nedges, arena, e) ||
            !crossing_reserve(&f->triangles[p], body->part[p].ntriangles, arena, e))
            return false;
    return true;
}

/* Facets are chords of the skin, which bulges out of their box by less than this share of it. */
static const double BULGE = 0.02;

static void find_box(BodyFrame *f, int part) {
    const BodyPart *p = &f->body->part[part];
    Box b = box_empty();
    for (int v = p->first_vertex; v < p->first_vertex + p->nvertices; v++) box_add(&b, f->position[v]);
    Vec3 room = vec_scale(vec(1, 1, 1), BULGE * vec_dist(b.low, b.high));
    f->box[part] = (Box){vec_sub(b.low, room), vec_add(b.high, room)};
}

static double distance_in_box(const BodyFrame *f, int part, Vec3 p, double far, Vec3 *normal) {
    double d = body_distance(&f->body->part[part], rigid_apply(f->to_part[part], p), far, normal);
    if (normal && d < far) *normal = mat_apply(f->to_world[part], *normal);
    return d;
}

/* Distance from a part as it is without others. Most questions end at the box, so that much is inline. */
static inline double own_distance(const BodyFrame *f, int part, Vec3 p, double far, Vec3 *normal) {
    return body_frame_far(f, part, p, far) ? far : distance_in_box(f, part, p, far, normal);
}

static double scale_of(const BodyFrame *f) { return figure_scale(f->body->height); }

/* How far a part gives way at a point, and its normal there. */
typedef struct {
    double by;
    Vec3 normal;
} Way;

/* Takes account of one contact of a part that is `distance` away from p with normal `mine`, and `other` with normal
   `away` from the other: it gives way to the one that asks for most. */
static void press(const BodyFrame *f, const Contact *contact, Vec3 p, double distance, Vec3 mine, double other,
                  Vec3 away, Way *way) {
    double by = yield_by(contact, scale_of(f), p, distance, other, away, &mine);
    if (by > way->by) *way = (Way){by, mine};
}

/* Farther away than the room that parts leave to each other the other is never asked. */
static Way give_way(const BodyFrame *f, int part, Vec3 p, double distance, Vec3 normal) {
    const Contacts *contacts = &f->contacts[part];
    double far = YIELD_ROOM * scale_of(f) - distance;
    Way way = {0, normal};
    for (int k = 0; k < contacts->n; k++) {
        Vec3 away;
        double other = own_distance(f, contacts->contact[k].other, p, far, &away);
        if (other < far) press(f, &contacts->contact[k], p, distance, normal, other, away, &way);
    }
    return way;
}

double body_frame_distance(const BodyFrame *f, int part, Vec3 p, double far, Vec3 *normal) {
    if (f->contacts[part].n == 0) return own_distance(f, part, p, far, normal);
    Vec3 n;
    double d = own_distance(f, part, p, far, &n);
    if (d >= far) return d;
    Way way = d < YIELD_ROOM * scale_of(f) ? give_way(f, part, p, d, n) : (Way){0, n};
    if (normal) *normal = way.normal;
    return d + way.by;
}

double body_frame_unpressed(const BodyFrame *f, int part, Vec3 p, double far) {
    return own_distance(f, part, p, far, NULL);
}

void body_frame_unpressed_many(const BodyFrame *f, int part, const Vec3 *p, int n, double far, double *distance,
                               Vec3 *normal) {
    body_distances(&f->body->part[part], f->vectors, &f->to_part[part], p, n, far, distance, normal);
    for (int i = 0; normal && i < n; i++)
        if (distance[i] < far) normal[i] = mat_apply(f->to_world[part], normal[i]);
}

bool body_frame_inside(const BodyFrame *f, unsigned parts, Vec3 p) {
    for (int k = 0; k < f->body->nparts; k++)
        if (parts & part_bit(f, k) && body_frame_distance(f, k, p, 0, NULL) < 0) return true;
    return false;
}

/* Those of n <= 16 points that are inside of a part where nothing presses on it are asked again one by one. */
static bool any_inside_part(const BodyFrame *f, int part, const Vec3 *p, int n) {
    Vec3 at[16];
    double distance[16];
    int count = 0;
    for (int i = 0; i < n; i++)
        if (!body_frame_far(f, part, p[i], 0)) at[count++] = p[i];
    if (count > 0) body_frame_unpressed_many(f, part, at, count, 0, distance, NULL);
    for (int i = 0; i < count; i++)
        if (distance[i] < 0 && body_frame_distance(f, part, at[i], 0, NULL) < 0) return true;
    return false;
}

bool body_frame_any_inside(const BodyFrame *f, unsigned parts, const Vec3 *p, int n) {
    Box box = box_empty();
    for (int i = 0; i < n; i++) box_add(&box, p[i]);
    for (int k = 0; k < f->body->nparts; k++) {
        if (!(parts & part_bit(f, k)) || !box_touches(box, f->box[k])) continue;
        for (int i = 0; i < n; i += 16)
            if (any_inside_part(f, k, p + i, n - i < 16 ? n - i : 16)) return true;
    }
    return false;
}

/* Do the two come nearer than the room for cloth? Asked of the vertices of the first. */
static bool is_near(const BodyFrame *f, int a, int b) {
    const BodyPart *part = &f->body->part[a];
    double room = YIELD_ROOM * scale_of(f);
    for (int v = part->first_vertex; v < part->first_vertex + part->nvertices; v++)
        if (own_distance(f, b, f->position[v], room, NULL) < room) return true;
    return false;
}

static bool boxes_near(Box a, Box b, double room) {
    Vec3 grown = vec(room, room, room);
    return box_touches((Box){vec_sub(a.low, grown), vec_add(a.high, grown)}, b);
}

/* The fold between two bones of a limb. */
static void find_fold(const BodyFrame *f, int upper, int lower, Contact *of_upper, Contact *of_lower) {
    const BodyPart *part = &f->body->part[lower];
    Vec3 joint = rigid_apply(f->pose.bone[part->role], part->frame.t);
    Vec3 up = vec_scale(mat_column(f->to_world[upper], 1), -1), down = mat_column(f->to_world[lower], 1);
    Section s = body_section_at(part, 0, NULL);
    yield_fold(joint, up, down, fmax(s.front, s.back), of_upper, of_lower);
}

static void find_contacts(BodyFrame *f) {
    const Body *body = f->body;
    for (int p = 0; p < body->nparts; p++) f->contacts[p].n = 0;
    for (int a = 0; a < body->nparts; a++)
        for (int b = a + 1; b < body->nparts; b++) {
            Role of_a = body->part[a].role, of_b = body->part[b].role;
            Contacts *ca = &f->contacts[a], *cb = &f->contacts[b];
            if (!yield_concerns(of_a, of_b) || ca->n == CONTACTS_MAX || cb->n == CONTACTS_MAX ||
                !boxes_near(f->box[a], f->box[b], YIELD_ROOM * scale_of(f)) || !(is_near(f, a, b) || is_near(f, b, a)))
                continue;
            yield_contact(of_a, of_b, scale_of(f), &ca->contact[ca->n], &cb->contact[cb->n]);
            if (yield_hinges(of_a, of_b)) find_fold(f, a, b, &ca->contact[ca->n], &cb->contact[cb->n]);
            ca->contact[ca->n++].other = b;
            cb->contact[cb->n++].other = a;
        }
}

/* How far a point of a part's skin, `level` away from it, goes inwards along its normal until what the part gives
   way there is made up for, `left` at the skin itself: the first such place. *n becomes the normal there.
   Distances change no faster than the point moves, so a step as long as what is left to make up for does not pass
   it; where that shrinks more slowly, steps are longer. Where that is slight and grows, inside a joint, there is
   nothing to be gained. What has been passed is found by chords, a point that stays their end twice counting half
   (Illinois). */
static double way_in(const BodyFrame *f, int p, Vec3 skin, double level, double left, double most, Vec3 *n) {
    enum { STEPS = 16 };
    static const double CLOSE = 1e-6, SLIGHT = 1e-3, LONGEST = 2; /* metres; metres; times what is left */
    Vec3 inwards = vec_scale(*n, -1);
    double out = 0, in = INFINITY, over = 0, way = fmin(left, most);
    for (int k = 0, side = 0; k < STEPS && left > 0; k++) {
        double gap = body_frame_distance(f, p, vec_mad(skin, inwards, way), INFINITY, n) - level;
        if (fabs(gap) <= CLOSE || (gap > 0 && way >= most)) break;
        if (left < SLIGHT && gap > left && in == INFINITY) return out;
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

/* The most that a part may give way at p: 0 where none of those that press on it can be near. */
static double most_at(const BodyFrame *f, int part, Vec3 p) {
    const Contacts *contacts = &f->contacts[part];
    double room = YIELD_ROOM * scale_of(f), most = 0;
    for (int k = 0; k < contacts->n; k++)
        if (!body_frame_far(f, contacts->contact[k].other, p, room)) most = fmax(most, contacts->contact[k].most);
    return most;
}

/* Vertices of a part's skin that may be pressed, how far it may give way at most, and how far it does. */
enum { BLOCK = 16 };
typedef struct {
    int n, vertex[BLOCK];
    Vec3 skin[BLOCK];
    double most[BLOCK], level[BLOCK];
    Way way[BLOCK];
} Pressed;

/* give_way for all of them. */
static void press_all(const BodyFrame *f, int part, Pressed *s) {
    const Contacts *contacts = &f->contacts[part];
    double room = YIELD_ROOM * scale_of(f), other[BLOCK];
    Vec3 mine[BLOCK], away[BLOCK];
    body_frame_unpressed_many(f, part, s->skin, s->n, INFINITY, s->level, mine);
    for (int i = 0; i < s->n; i++) s->way[i] = (Way){0, mine[i]};
    for (int k = 0; k < contacts->n; k++) {
        const Contact *contact = &contacts->contact[k];
        body_frame_unpressed_many(f, contact->other, s->skin, s->n, room, other, away);
        for (int i = 0; i < s->n; i++)
            if (other[i] < room) press(f, contact, s->skin[i], s->level[i], mine[i], other[i], away[i], &s->way[i]);
    }
}

/* Moves the skin of a part to where it has given way; never farther than the most that it gives. */
static void yield_skin(BodyFrame *f, int p) {
    const BodyPart *part = &f->body->part[p];
    int end = part->first_vertex + part->nvertices;
    for (int v = part->first_vertex; v < end;) {
        Pressed s = {.n = 0};
        for (; v < end && s.n < BLOCK; v++) {
            double most = most_at(f, p, f->position[v]);
            if (most == 0) continue;
            s.vertex[s.n] = v;
            s.most[s.n] = most;
            s.skin[s.n++] = f->position[v];
        }
        if (s.n > 0) press_all(f, p, &s);
        for (int i = 0; i < s.n; i++) {
            if (s.way[i].by <= 0) continue;
            Vec3 n = f->normal[s.vertex[i]];
            double way = way_in(f, p, s.skin[i], s.level[i], s.way[i].by, s.most[i], &n);
            f->position[s.vertex[i]] = vec_mad(s.skin[i], f->normal[s.vertex[i]], -way);
            f->normal[s.vertex[i]] = n;
        }
    }
}

void body_frame_pose(BodyFrame *f, const Pose *pose) {
    double start = clock_seconds();
    const Body *b = f->body;
    f->pose = *pose;
    body_pose(b, pose, f->position, f->normal);
    for (int p = 0; p < b->nparts; p++) {
        const BodyPart *part = &b->part[p];
        Rigid to_world = rigid_mul(pose->bone[part->role], part->frame);
        f->to_world[p] = to_world.r;
        f->to_part[p] = rigid_inverse(to_world);
        find_box(f, p);
    }
    find_contacts(f);
    for (int p = 0; p < b->nparts; p++)
        if (f->contacts[p].n > 0) yield_skin(f, p);
    for (int v = 0; v < b->skin.nvertices; v++) {
        Vec3 p = vec_scale(f->position[v], f->unit);
        f->position[v] = mesh_snap_point(p);
    }
    for (int p = 0; p < b->nparts; p++) {
        const BodyPart *part = &b->part[p];
        crossing_build_edges(&f->edges[p], f->position, b->skin.edge + part->first_edge, part->nedges);
        crossing_build_triangles(&f->triangles[p], f->position, b->skin.triangle + part->first_triangle,
                                 part->ntriangles);
    }
    f->seconds = clock_seconds() - start;
}
