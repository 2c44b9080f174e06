/* The last millimetres: what single vertices are asked for, how far they go for it, and the way back. */
#include "worn.h"

#include <string.h>

/* A garment on a deep crouch, pushed as a whole, but only by its coarsest level and not as far as it should be: there
   is something left to be settled. */
typedef struct {
    Worn worn;
    PushResult result;
    double margin, longest; /* metres: what vertices keep, and the longest offset of one */
} Pushed;

/* Pushes to a share of the cap. */
static void push_short(Pushed *p, double share) {
    Cloth *c = &p->worn.cloth;
    double cap = c->push.field.cap;
    c->push.field.cap = share * cap;
    push_solve(&c->push, &p->result);
    c->push.field.cap = cap;
}

static void push(Pushed *p, const char *name, double share) {
    worn_open(&p->worn, name, 5, 2);
    Scene *s = &p->worn.of.scene;
    Cloth *c = &p->worn.cloth;
    Pose pose = figure_rest_pose();
    scene_leg(s, &pose, true, 120, 120);
    scene_leg(s, &pose, false, 60, 110);
    worn_pose(&p->worn, &pose, 0);
    p->result = (PushResult){0};
    push_short(p, share);
    p->margin = PUSH_MARGIN * c->push.field.scale;
    p->longest = 0.03 * c->push.field.scale;
}

/* How much of its clearance a vertex is missing from the parts that it is worn over. */
static double missing(Pushed *p, int v) {
    const BodyFrame *body = &p->worn.of.scene.posed;
    const Push *push = &p->worn.cloth.push;
    double clearance = push->clearance[v], least = clearance;
    for (int k = 0; k < body->body->nparts; k++)
        if (escape_is_own(&push->escape, body, p->worn.cloth.sheet.place[v], k))
            least = min_of(least, body_frame_distance(body, k, push->point[v], clearance, NULL));
    return clearance - least;
}

static int count_missing(Pushed *p, double more) {
    int n = 0;
    for (int v = 0; v < p->worn.cloth.sheet.nvertices; v++) n += missing(p, v) > more;
    return n;
}

static double longest_offset(const Pushed *p) {
    const FieldSpots *offset = &p->worn.cloth.push.field.offset;
    double longest = 0;
    for (int k = 0; k < offset->n; k++) longest = max_of(longest, vec_len(offset->at[offset->place[k]]));
    return longest;
}

static void gives_the_rest(const char *name, double share) {
    static Pushed p;
    push(&p, name, share);
    Cloth *c = &p.worn.cloth;
    int before = count_missing(&p, 0.2 * p.margin), inside = count_missing(&p, p.margin);
    settle_all(&c->settler, &c->push, &p.result.capped);
    int after = count_missing(&p, 0.2 * p.margin), still = count_missing(&p, p.margin);
    OK(before > 0 && after <= before / 4, "%s: %d vertices miss some of their distance, %d are inside; then %d and %d",
       name, before, inside, after, still);
    OK(longest_offset(&p) > 0 && longest_offset(&p) <= p.longest * (1 + 1e-12), "no offset is a spike (%.1f mm)",
       1000 * longest_offset(&p));
    const Field *field = &c->push.field;
    int elsewhere = 0;
    for (int v = 0; v < c->sheet.nvertices; v++) {
        int place = c->sheet.place[v];
        Vec3 x = vec_add(c->push.global[v], field_at(field, field_levels(field), place));
        x = vec_add(x, field_alone(field, place));
        elsewhere += vec_dist(c->push.global[v], x) < field->cap && vec_dist(x, c->push.point[v]) > 1e-9;
    }
    OK(elsewhere == 0, "a vertex is where field, offset and dent say (%d are not)", elsewhere);
    arena_free(&p.worn.of.scene.arena);
}

static void gives_no_more(void) {
    static Pushed p;
    bool capped = false;
    push(&p, "trousers", 0.3);
    Cloth *c = &p.worn.cloth;
    for (int v = 0; v < c->sheet.nvertices; v++) c->push.global[v].x += 0.05; /* into both legs */
    c->push.near_known = false;
    push_short(&p, 0.01);
    settle_all(&c->settler, &c->push, &capped);
    OK(capped && fabs(longest_offset(&p) - p.longest) < 1e-9 && count_missing(&p, p.margin) > 0,
       "what lies deeper is left there, and the cap told (%d vertices inside)", count_missing(&p, p.margin));
    arena_free(&p.worn.of.scene.arena);
}

static void raises(void) {
    static Pushed p;
    push(&p, "trousers", 0.3);
    Cloth *c = &p.worn.cloth;
    double *asked = &c->push.clearance[7], scale = c->push.field.scale;
    OK(settle_raise(&c->settler, &c->push, 7, 0.002, 0.003), "a vertex is asked for 2 mm more");
    NEAR(*asked, p.margin + 0.002 * scale, 1e-12, "and for no more");
    OK(settle_raise(&c->settler, &c->push, 7, 0.002, 0.003), "then up to the most there is,");
    NEAR(*asked, p.margin + 0.003 * scale, 1e-12, "which is 3 mm");
    OK(!settle_raise(&c->settler, &c->push, 7, 0.002, 0.003), "and then not any more");
    for (int k = 0; k < 20; k++) (void)settle_raise(&c->settler, &c->push, 7, 0.002, 1);
    NEAR(*asked, p.margin + 0.015 * scale, 1e-12, "never for more than 15 mm");
    OK(c->settler.nraised == 1 && c->settler.raised[0] == 7, "it is one raised vertex");
    arena_free(&p.worn.of.scene.arena);
}

/* Everything that settling has moved since a mark. */
static void goes_back(void) {
    static Pushed p;
    static Vec3 point[1 << 14], offset[1 << 14], dent[LIMBS][1 << 14];
    push(&p, "trousers", 0.3);
    Cloth *c = &p.worn.cloth;
    FieldSpots *spots = &c->push.field.offset;
    for (int v = 0; v < c->sheet.nvertices && c->settler.nraised < MARKED_MOST; v++)
        if (missing(&p, v) > 0) (void)settle_raise(&c->settler, &c->push, v, 0.005, 1);
    memcpy(point, c->push.point, (size_t)c->sheet.nvertices * sizeof *point);
    memcpy(offset, spots->at, (size_t)c->push.lattice->nplaces * sizeof *offset);
    for (int limb = 0; limb < LIMBS; limb++)
        memcpy(dent[limb], c->push.field.dent[limb].at, (size_t)c->push.lattice->nplaces * sizeof *dent[limb]);
    settle_mark(&c->settler, &c->push);
    settle_raised(&c->settler, &c->push, &p.result.capped);
    int moved = 0, others = 0;
    for (int v = 0; v < c->sheet.nvertices; v++) {
        bool raised = c->push.clearance[v] > p.margin, gone = vec_dist(c->push.point[v], point[v]) > 0;
        moved += gone;
        others += gone && !raised;
    }
    OK(moved > 0 && others == 0, "%d of %d raised vertices move, and no others", moved, c->settler.nraised);
    OK(settle_restore(&c->settler, &c->push), "what was marked can be taken back");
    OK(memcmp(point, c->push.point, (size_t)c->sheet.nvertices * sizeof *point) == 0, "every vertex, to the bit");
    bool same = memcmp(offset, spots->at, (size_t)c->push.lattice->nplaces * sizeof *offset) == 0;
    for (int limb = 0; limb < LIMBS; limb++)
        same = same && memcmp(dent[limb], c->push.field.dent[limb].at,
                              (size_t)c->push.lattice->nplaces * sizeof *dent[limb]) == 0;
    OK(same, "every offset and every dent");
    for (int v = 0; v < c->sheet.nvertices; v++) (void)settle_raise(&c->settler, &c->push, v, 0.005, 1);
    settle_mark(&c->settler, &c->push);
    OK(c->settler.nraised > MARKED_MOST && !settle_restore(&c->settler, &c->push),
       "too many to remember (%d) are not taken back", c->settler.nraised);
    arena_free(&p.worn.of.scene.arena);
}

/* How far the point of a hit is from its part. */
static double hit_distance(const Pushed *p, const TesterHit *hit, Vec3 *normal) {
    Vec3 x = tester_hit_point(hit, p->worn.cloth.push.point);
    return body_frame_distance(&p->worn.of.scene.posed, hit->part, x, 1, normal);
}

static bool is_own(const Pushed *p, const TesterHit *hit) {
    const Cloth *c = &p->worn.cloth;
    return escape_is_own(&c->push.escape, &p->worn.of.scene.posed, c->sheet.place[tester_hit_vertex(hit)], hit->part);
}

static void moves_hits_off(void) {
    static Pushed p;
    FrameStats stats = {0};
    push(&p, "trousers", 0.1);
    Cloth *c = &p.worn.cloth;
    Wrong w = attempt_test(c, &p.worn.of.scene.posed, &stats);
    int early = 0, off = 0, own = 0;
    double least = INFINITY;
    bool capped = false;
    for (int k = 0; k < c->tester.nhits; k++) {
        const TesterHit *hit = &c->tester.hit[k];
        if (!is_own(&p, hit)) continue;
        double before = hit_distance(&p, hit, NULL);
        settle_hit(&c->settler, &c->push, hit, &capped);
        early += hit_distance(&p, hit, NULL) != before && c->settler.nraised == 0;
        for (int i = 0; i < hit->n; i++) (void)settle_raise(&c->settler, &c->push, hit->v[i], 0.002, 0.002);
        settle_hit(&c->settler, &c->push, hit, &capped);
        double after = hit_distance(&p, hit, NULL);
        own++;
        off += after > 0.4 * p.margin;
        least = min_of(least, after);
    }
    OK(own > 0 && early == 0, "%d hits (%d edges): nothing moves that was not raised", own, w.own.edges);
    OK(off >= own - own / 20, "%d of %d are then off their part by half the distance (least %.1f mm)", off, own,
       1000 * least);
    arena_free(&p.worn.of.scene.arena);
}

/* Vertices of hits that have the longest offset already. */
static void tells_where_hits_stay(void) {
    static Pushed p;
    FrameStats stats = {0};
    push(&p, "trousers", 0.1);
    Cloth *c = &p.worn.cloth;
    (void)attempt_test(c, &p.worn.of.scene.posed, &stats);
    int hits = 0, told = 0;
    for (int k = 0; k < c->tester.nhits; k++) {
        const TesterHit *hit = &c->tester.hit[k];
        Vec3 n;
        bool capped = false, again = false;
        double distance = hit_distance(&p, hit, &n);
        if (!is_own(&p, hit)) continue;
        for (int i = 0; i < hit->n; i++) {
            again |= c->push.clearance[hit->v[i]] > p.margin;
            (void)settle_raise(&c->settler, &c->push, hit->v[i], 0.002, 0.002);
            field_set_spot(&c->push.field.offset, c->sheet.place[hit->v[i]], vec_scale(n, p.longest));
        }
        if (again || distance > 0) continue;
        settle_hit(&c->settler, &c->push, hit, &capped);
        hits++;
        told += capped;
    }
    OK(hits > 5 && told == hits, "hits whose vertices may go no farther are told as capped (%d of %d)", told, hits);
    arena_free(&p.worn.of.scene.arena);
}

int main(void) {
    gives_the_rest("skirt", 0.1);
    gives_the_rest("trousers", 0.3);
    gives_the_rest("tshirt", 0.03);
    gives_no_more();
    raises();
    goes_back();
    moves_hits_off();
    tells_where_hits_stay();
    return tap_done();
}
