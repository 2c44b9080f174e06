/* The nearest way out of a part, along its normal, is right for cloth that has just sunk in. It is wrong where a
   limb lies across the cloth or two parts meet: there it may lead to the other side of the limb, into the other
   part, or out of the garment. So the normal is turned by what is known of the place: on which side of the body it
   was in the bind pose, and which parts it is worn over. Of two parts that face each other, each asks for half of
   the room between them. */
#include "dress/escape.h"

enum { STEPS_OUT = 6, STEPS_FREE = 8 };
static const double CLOSE_ENOUGH = 0.1; /* share of the distance wanted that may be missing along a turned normal */
static const double OPPOSITE = -0.2;    /* cosine between normals below which two parts face each other */
static const double SUNK = 0.01;        /* metres on 1.70 m: how far into flesh that gives way cloth may go in a hollow:
                                           its facets would not follow farther */
static const double WRONG_SIDE = 0.5;   /* cosine between a normal and the place's side, below which it is turned */
static const double OUTWARDS = 0.3;     /* cosine between the normal of a part from outside and the garment's outward
                                           normal, from which on the part pushes straight inwards */

bool escape_reserve(Escape *s, const Lattice *lattice, Arena *arena, Error *e) {
    *s = (Escape){.lattice = lattice};
    s->rest = ARENA_NEW(arena, Vec3, lattice->nplaces, e);
    return s->rest != NULL;
}

void escape_bind(Escape *s, const Patch *root) {
    for (int place = 0; place < s->lattice->nplaces; place++) s->rest[place] = lattice_point(s->lattice, root, place);
}

/* The distance to ask for from a part at p. distance: what it is now, n: the part's outward normal. It is the
   clearance; but if another part is opposite, no more than half the room between the two; and if these overlap, a
   part from outside asks for nothing, so that an own part wins. */
static double room_for(const Escape *s, const BodyFrame *body, EscapePoint *p, int part, double distance,
                       Vec3 n) {
    double far = 2 * p->clearance - distance;
    int opposite = -1;
    for (int other = 0; p->near >> other; other++) {
        Vec3 m;
        if (other == part || !(p->near >> other & 1)) continue;
        double d = body_point_distance(body, other, &p->point, far, &m);
        if (d >= far || vec_dot(n, m) >= OPPOSITE) continue;
        far = d;
        opposite = other;
    }
    if (distance + far > 0) return 0.5 * (distance + far);
    bool yields =
        opposite >= 0 && escape_is_own(s, body, p->place, opposite) && !escape_is_own(s, body, p->place, part);
    return yields ? distance : p->clearance;
}

/* Feet stand across the leg, so a place of trousers is on no side of their axis. */
static bool has_side(Role role) {
    return role != ROLE_LEFT_FOOT && role != ROLE_RIGHT_FOOT && role != ROLE_LEFT_TOE && role != ROLE_RIGHT_TOE;
}

/* *side: the direction from a part's axis to where p belongs, unit, world: that of its place in the bind pose. False if
   the place is beyond the ends of the part: past a bent joint that direction means nothing. */
static bool side_of(const Escape *s, const BodyFrame *body, const EscapePoint *p, int part, Vec3 *side) {
    const BodyPart *b = &body->body->part[part];
    if (!has_side(b->role)) return false;
    Vec3 q = rigid_unapply(b->frame, s->rest[p->place]);
    if (q.y < 0 || q.y > b->length) return false;
    Section c = body_section_at(b, q.y);
    *side = mat_apply(body->to_world[part], vec_unit_or(vec(q.x - c.x, 0, q.z - c.z), vec(1, 0, 0)));
    return true;
}

/* Turns *n, the normal of a part at p, if it leads to the wrong side. Returns whether it does.

   Of a part that the cloth is worn over: towards the side where the place belongs. Parts from outside never push
   cloth out of the garment. Of those that the garment is worn over elsewhere (the other leg of trousers) only a
   normal that leads out is turned. Of others (arms) every normal is turned inwards, the more the less it leads
   there, so that an arm that sweeps through does not throw cloth first to one side and then to the other. */
static bool turn_inside(const Escape *s, const BodyFrame *body, const EscapePoint *p, int part, Vec3 *n) {
    if (escape_is_own(s, body, p->place, part)) {
        Vec3 side;
        if (!side_of(s, body, p, part, &side)) return false;
        double turn = 2 * (1 - smoothstep(-WRONG_SIDE, WRONG_SIDE, vec_dot(*n, side)));
        if (turn > 0) *n = vec_unit_or(vec_mad(*n, side, turn), side);
        return turn > 0;
    }
    Vec3 outwards = lattice_normal(s->lattice, s->root, p->place);
    if (s->lattice->fit->collide & part_bit(body, part)) {
        if (vec_dot(*n, outwards) <= OUTWARDS) return false;
        *n = vec_scale(outwards, -1);
        return true;
    }
    double turn = smoothstep(-1, OUTWARDS, vec_dot(*n, outwards));
    *n = vec_unit_or(vec_mad(vec_scale(*n, 1 - turn), outwards, -turn), vec_scale(outwards, -1));
    return turn > 0;
}

/* Along a turned normal the distance grows more slowly than the way, which is therefore found in steps. */
double escape_way(const Escape *s, const BodyFrame *body, EscapePoint *p, int part, double wanted,
                  double distance, Vec3 *n) {
    double way = wanted - distance;
    if (!turn_inside(s, body, p, part, n)) return way;
    for (int k = 0; k < STEPS_OUT; k++) {
        double d = body_frame_distance(body, part, vec_mad(p->point.at, *n, way), wanted, NULL);
        if (d >= wanted - CLOSE_ENOUGH * wanted) break;
        way += wanted - d;
    }
    return way;
}

double escape_asked(const Escape *s, const BodyFrame *body, EscapePoint *p, int part, double distance, Vec3 *n) {
    double least = p->slack * p->clearance; /* less than that is no violation */
    if (p->clearance - distance <= least) return 0;
    double wanted = room_for(s, body, p, part, distance, *n);
    return wanted - distance <= least ? 0 : escape_way(s, body, p, part, wanted, distance, n);
}

/* Distances change no faster than the point moves, so a step by the least of them is safe. Parts from which the step
   leads away do not count. */
double escape_free(const Escape *s, const BodyFrame *body, int place, Vec3 at, double clearance, Vec3 n, double most) {
    double way = 0, sunk = SUNK * figure_scale(body->body->height);
    for (int step = 0; step < STEPS_FREE && way < most; step++) {
        double room = most - way;
        BodyPoint x;
        body_point_move(&x, vec_mad(at, n, way));
        for (int k = 0; k < body->body->nparts; k++) {
            double far = room + clearance;
            Vec3 m;
            if (!(s->lattice->collide[place] & part_bit(body, k)) || body_frame_far(body, k, x.at, far)) continue;
            double distance = body_point_distance(body, k, &x, far, &m);
            if (distance >= far || vec_dot(m, n) >= 0) continue;
            room = fmin(room, fmin(distance, body_point_unpressed(body, k, &x, far) + sunk) - clearance);
        }
        if (room <= CLOSE_ENOUGH * clearance) break;
        way += room;
    }
    return way;
}
