/* Garment files: what is read, that writing it back loses nothing, and that every mistake is
   found where it stands. */
#include "garment/garment.h"

#include <stdlib.h>
#include <string.h>

#include "tap.h"

static Garment first, second; /* large; two for the round trip */

static bool parse(const char *source, Garment *g, Error *e) {
    Text text = {"x.garment", source, strlen(source)};
    *e = (Error){0};
    return garment_parse(&text, g, e);
}

static const Garment *parse_good(const char *source) {
    Error e;
    if (!parse(source, &first, &e)) printf("# %d:%d: %s\n", e.line, e.column, e.text);
    return e.kind ? NULL : &first;
}

/* --- equality, field by field, since structs have padding --- */

static bool same_vec(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

static bool same_binding(const Binding *a, const Binding *b) {
    bool same = a->n == b->n;
    for (int i = 0; i < a->n; i++) same = same && a->bone[i] == b->bone[i] && a->weight[i] == b->weight[i];
    return same;
}

static bool same_ring(const Ring *a, const Ring *b) {
    bool same = strcmp(a->name, b->name) == 0 && a->part == b->part && a->at == b->at && a->ease == b->ease &&
                a->has_size == b->has_size && a->side == b->side && a->front == b->front && a->back == b->back &&
                same_vec(a->shift, b->shift) && a->tilt == b->tilt;
    for (int s = 0; s < STATION_COUNT; s++)
        same = same && same_vec(a->move[s], b->move[s]) && same_binding(&a->binding[s], &b->binding[s]);
    return same;
}

static bool same_panel(const Panel *a, const Panel *b) {
    bool same = strcmp(a->name, b->name) == 0 && a->nrows == b->nrows;
    for (int i = 0; same && i < a->nrows; i++)
        same = a->row[i].ring == b->row[i].ring && a->row[i].from == b->row[i].from && a->row[i].via == b->row[i].via &&
               a->row[i].to == b->row[i].to;
    return same;
}

static bool same_patch(const RawPatch *a, const RawPatch *b) {
    bool same = strcmp(a->name, b->name) == 0;
    for (int k = 0; k < 16; k++)
        same = same && same_vec(a->point[k], b->point[k]) && same_binding(&a->binding[k], &b->binding[k]);
    return same;
}

static bool same_seam(const Seam *a, const Seam *b) {
    return a->piece_a == b->piece_a && a->side_a == b->side_a && a->piece_b == b->piece_b && a->side_b == b->side_b &&
           a->crease == b->crease;
}

static bool same_collide(const Collide *a, const Collide *b) {
    return a->from_ring == b->from_ring && a->to_ring == b->to_ring && a->piece == b->piece && a->parts == b->parts;
}

static bool same_garment(const Garment *a, const Garment *b) {
    bool same = strcmp(a->name, b->name) == 0 && a->follow == b->follow && a->loose == b->loose &&
                a->detail == b->detail && a->nrings == b->nrings && a->npanels == b->npanels &&
                a->npatches == b->npatches && a->nseams == b->nseams && a->njoins == b->njoins &&
                a->ncollides == b->ncollides && a->npins == b->npins;
    for (int i = 0; same && i < a->nrings; i++) same = same_ring(&a->ring[i], &b->ring[i]);
    for (int i = 0; same && i < a->npanels; i++) same = same_panel(&a->panel[i], &b->panel[i]);
    for (int i = 0; same && i < a->npatches; i++) same = same_patch(&a->patch[i], &b->patch[i]);
    for (int i = 0; same && i < a->nseams; i++) same = same_seam(&a->seam[i], &b->seam[i]);
    for (int i = 0; same && i < a->ncollides; i++) same = same_collide(&a->collide[i], &b->collide[i]);
    for (int i = 0; same && i < a->njoins; i++) same = memcmp(&a->join[i], &b->join[i], sizeof a->join[i]) == 0;
    for (int i = 0; same && i < a->npins; i++) same = memcmp(&a->pin[i], &b->pin[i], sizeof a->pin[i]) == 0;
    return same;
}

/* --- texts that the cases are made of --- */

#define RINGS "garment g\nring a pelvis 1 ease 0.01\nring b pelvis 0.2\nring c left_thigh 0.5 size 0.2 0.15 0.15\n"
#define PANEL RINGS "panel p\nrow a left front right\nrow b left front right\nrow c left front right\n"
#define TWO PANEL "panel q\nrow a right back left\nrow b right back left\nrow c right back left\n"
/* Points of a raw patch in the plane z = 0, x from X to X + 0.3. */
#define COLUMN(x, part) #x " 1 0 " part " 1\n" #x " .9 0 " part " 1\n" #x " .8 0 " part " 1\n" #x " .7 0 " part " 1\n"
#define FLAT COLUMN(0, "pelvis") COLUMN(.1, "pelvis") COLUMN(.2, "pelvis") COLUMN(.3, "pelvis")
#define NEXT COLUMN(.3, "pelvis") COLUMN(.4, "pelvis") COLUMN(.5, "pelvis") COLUMN(.6, "pelvis")
/* Back over the first, as the outside of a hem. */
#define BACK COLUMN(.3, "pelvis") COLUMN(.2, "pelvis") COLUMN(.1, "pelvis") COLUMN(0, "pelvis")
#define POINT ".1 .2 .3 pelvis 1\n"
#define POINTS16 POINT POINT POINT POINT POINT POINT POINT POINT POINT POINT POINT POINT POINT POINT POINT POINT

/* --- what is read --- */

static void reads_rings(void) {
    const Garment *g = parse_good("garment g\nring a left_thigh -.25 tilt -30 shift 0.1 -0.2 0.3 ease 1e-2 size 1 2 3\n"
                                  "move a.back 0 0 -0.05\nbind a pelvis 3 left_thigh 1\nbind a.left left_thigh 7\n"
                                  "ring b left_shin 1 shift 0 1 -0\npanel p\nrow a left back\nrow b left back\n");
    if (!OK(g, "a ring with every property is read")) return;
    const Ring *r = &g->ring[0];
    OK(r->part == ROLE_LEFT_THIGH && r->at == -0.25 && r->ease == 0.01 && r->tilt == -30, "part, place, ease and tilt");
    OK(r->has_size && r->side == 1 && r->front == 2 && r->back == 3, "size");
    OK(same_vec(r->shift, vec(0.1, -0.2, 0.3)) && same_vec(r->move[STATION_BACK], vec(0, 0, -0.05)), "shift and move");
    const Binding *own = &r->binding[STATION_LEFT], *all = &r->binding[STATION_RIGHT];
    OK(all->n == 2 && all->weight[0] == 0.75 && all->weight[1] == 0.25, "weights are made to sum to 1");
    OK(own->n == 1 && own->bone[0] == ROLE_LEFT_THIGH && own->weight[0] == 1,
       "a station's own binding wins over its ring's");
    OK(!signbit(g->ring[1].shift.z), "-0 is read as 0");
    OK(g->ring[1].binding[0].n == 0, "a ring without bind has no binding");
    OK(g->follow == FOLLOW_BONES && !g->loose && g->detail == 0, "defaults: bones, tight, no detail");
}

static void reads_pieces(void) {
    const Garment *g =
        parse_good("garment g\r\nfollow bones\r\nfit loose\r\ndetail 9\r\npatch s\r\n" FLAT "patch t\n" NEXT
                   "seam s.end t.start crease\npin s.top\ncollide t pelvis head\n"
                   "ring a pelvis 1\nring b pelvis 0\npanel p\nrow a left front\nrow b left front # end\npin a\n"
                   "collide b..a chest");
    if (!OK(g, "patches before panels, CRLF, comment, no last newline")) return;
    OK(g->loose && g->detail == 9 && g->npanels == 1 && g->npatches == 2, "fit, detail and pieces");
    OK(g->seam[0].piece_a == 1 && g->seam[0].piece_b == 2 && g->seam[0].crease, "pieces are numbered panels first");
    OK(g->pin[0].ring == -1 && g->pin[0].piece == 1 && g->pin[0].side == SIDE_TOP && g->pin[1].ring == 0,
       "pins of a side and of a ring");
    OK(g->collide[0].piece == 2 && g->collide[0].parts == (1u << ROLE_PELVIS | 1u << ROLE_HEAD),
       "colliders of a piece");
    OK(g->collide[1].from_ring == 1 && g->collide[1].to_ring == 0 && g->collide[1].piece == -1,
       "colliders between two rings");
    OK(g->panel[0].row[0].via == STATION_NONE && g->panel[0].row[0].from == STATION_LEFT &&
           g->panel[0].row[0].to == STATION_FRONT,
       "a quarter arc");
    OK(garment_find_piece(g, "t") == 2 && garment_find_piece(g, "a") == -1 && garment_find_ring(g, "b") == 1,
       "things are found by name");
}

static void mirrors(void) {
    const Garment *g =
        parse_good("garment g\nring waist pelvis 1\nring left_leg left_thigh .5 size .1 .2 .3 shift .01 0 .02 tilt 5\n"
                   "move left_leg.right .03 .04 .05\nbind left_leg.left left_thigh .75 pelvis .25\n"
                   "panel left_p\nrow waist left front\nrow left_leg left front right\npatch left_s\n" FLAT
                   "panel left_q\nrow waist left back\nrow left_leg left back right\nseam left_p.start left_q.start\n"
                   "pin left_p.start\npin waist\ncollide waist..left_leg pelvis left_thigh\ncollide left_s "
                   "left_hand\nmirror left_ right_\n"
                   "join left_leg.right right_leg.left\n");
    if (!OK(g, "a half garment is mirrored")) return;
    const Ring *r = &g->ring[2];
    OK(g->nrings == 3 && strcmp(r->name, "right_leg") == 0 && r->part == ROLE_RIGHT_THIGH,
       "ring: name and part change sides");
    OK(same_vec(r->shift, vec(-.01, 0, .02)) && r->tilt == -5 && r->side == .1, "ring: x and tilt change sign");
    OK(same_vec(r->move[STATION_LEFT], vec(-.03, .04, .05)) && same_vec(r->move[STATION_RIGHT], vec(0, 0, 0)),
       "moves change stations");
    OK(r->binding[STATION_RIGHT].bone[0] == ROLE_RIGHT_THIGH && r->binding[STATION_RIGHT].bone[1] == ROLE_PELVIS &&
           r->binding[STATION_LEFT].n == 0,
       "bindings change stations and bones");
    OK(g->npanels == 4 && g->npatches == 2, "panels and patches have an image");
    const Panel *p = &g->panel[garment_find_piece(g, "right_p")];
    OK(p->row[0].ring == 0 && p->row[0].from == STATION_RIGHT && p->row[0].to == STATION_FRONT && p->row[1].ring == 2 &&
           p->row[1].to == STATION_LEFT,
       "rows: a shared ring stays, its stations change sides");
    const RawPatch *s = &g->patch[1];
    OK(strcmp(s->name, "right_s") == 0 && s->point[15].x == -.3 && s->point[15].y == .7, "raw patch: x changes sign");
    OK(!signbit(s->point[0].x), "zero stays +0");
    OK(g->npins == 3 && g->pin[2].piece == garment_find_piece(g, "right_p") &&
           g->pin[0].piece == garment_find_piece(g, "left_p"),
       "pins of the half have an image, pins of shared rings none");
    OK(g->ncollides == 4 && g->collide[2].to_ring == 2 &&
           g->collide[2].parts == (1u << ROLE_PELVIS | 1u << ROLE_RIGHT_THIGH),
       "colliders change sides");
    OK(g->nseams == 2 && g->seam[1].piece_a == garment_find_piece(g, "right_p"), "seams have an image");
}

/* Columns of a patch below FLAT, and of one beside it that stands on its head. */
#define LOW(x) #x " .7 0 pelvis 1\n" #x " .6 0 pelvis 1\n" #x " .5 0 pelvis 1\n" #x " .4 0 pelvis 1\n"
#define UP(x) #x " .7 0 pelvis 1\n" #x " .8 0 pelvis 1\n" #x " .9 0 pelvis 1\n" #x " 1 0 pelvis 1\n"

static void seams_meet(void) {
    static const struct {
        const char *says, *text;
    } cases[] = {
        {"sides of panels that use the same stations", TWO "seam p.end q.start\nseam q.end p.start\n"},
        {"the same in the opposite order",
         PANEL "panel q\nrow c left back\nrow b left back\nrow a left back\nseam q.start p.start\n"},
        {"bottom and top on one ring", RINGS "panel p\nrow a left front right\nrow b left front right\npanel q\n"
                                             "row b right front left\nrow c right front left\nseam p.bottom q.top\n"},
        {"stations that are joined",
         RINGS "ring d pelvis 1\nring e pelvis 0\njoin a.right d.left\njoin e.left b.right\n"
               "panel p\nrow a front right\nrow b front right\npanel q\nrow d left front\n"
               "row e left front\nseam p.end q.start\n"},
        {"end and start of raw patches", "garment g\npatch s\n" FLAT "patch t\n" NEXT "seam t.start s.end\n"},
        {"bottom and top of raw patches",
         "garment g\npatch s\n" FLAT "patch t\n" LOW(0) LOW(.1) LOW(.2) LOW(.3) "seam s.bottom t.top\n"},
        {"a patch on its head",
         "garment g\npatch s\n" FLAT "patch t\n" UP(.3) UP(.4) UP(.5) UP(.6) "seam s.end t.start\n"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) OK(parse_good(cases[i].text), "seam: %s", cases[i].says);
}

/* --- writing and reading again --- */

static char *written(const Garment *g) {
    char *bytes = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&bytes, &size);
    bool good = out && garment_write(g, out);
    if (out) fclose(out);
    return good ? bytes : NULL;
}

static void round_trip(const char *name, const Garment *g) {
    Error e;
    char *once = written(g);
    bool read = once && parse(once, &second, &e);
    OK(read, "%s: what was written is read", name);
    if (once && !read) printf("# %d:%d: %s\n", e.line, e.column, e.text);
    OK(read && same_garment(g, &second), "%s: it is the same garment", name);
    char *twice = read ? written(&second) : NULL;
    OK(twice && strcmp(once, twice) == 0, "%s: it is written with the same bytes", name);
    free(once);
    free(twice);
}

static void round_trips(void) {
    static const struct {
        const char *name, *text;
    } cases[] = {
        {"smallest", "garment g\nring a pelvis 1\nring b pelvis 0\npanel p\nrow a left front\nrow b left front\n"},
        {"odd numbers", "garment g\nring a pelvis 0.1000000000000000055 ease -1e-300 tilt 179.99999999999997\n"
                        "ring b pelvis -0 shift -0 0 1e-7\npanel p\nrow a left front\nrow b left front\n"},
        {"thirds",
         "garment g\nring a pelvis 1\nbind a pelvis 1 chest 1 spine 1\nbind a.back head .1 neck .2 chest .3 spine .1\n"
         "ring b pelvis 0\npanel p\nrow a left front\nrow b left front\n"},
        {"a fold that is meant", "garment g\npatch s\n" FLAT "patch t\n" BACK "seam s.end t.start crease\n"},
        {"every statement",
         "garment g.v2\nfollow bones\nfit loose\ndetail 5\nring left_a left_thigh .1 size 1 2 3\nmove left_a.front 0 "
         ".1 0\n"
         "ring left_b left_shin .5\nbind left_b left_shin 1 left_thigh 2\npanel left_p\nrow left_a left front right\n"
         "row left_b left front right\npanel left_q\nrow left_a left back right\nrow left_b left back right\n"
         "seam left_p.start left_q.start\nseam left_p.end left_q.end crease\npatch left_s\n" FLAT "patch left_t\n" NEXT
         "seam left_s.end left_t.start\npin left_a\npin left_s.top\ncollide left_a..left_b left_thigh left_shin\n"
         "collide left_t pelvis\nmirror left_ right_\njoin left_a.right right_a.left\n"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const Garment *g = parse_good(cases[i].text);
        if (OK(g, "%s: read", cases[i].name)) round_trip(cases[i].name, g);
    }
}

static void shipped(void) {
    static const struct {
        const char *path;
        int patches;
    } files[] = {{"garments/skirt.garment", 6},
                 {"garments/paper-skirt.garment", 2},
                 {"garments/trousers.garment", 24},
                 {"garments/tshirt.garment", 20}};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        Arena arena = {0};
        Error e = {0};
        bool read = garment_read(files[i].path, &arena, &first, &e);
        if (!OK(read, "%s is read", files[i].path)) error_print(&e, stdout);
        arena_free(&arena);
        if (!read) continue;
        int patches = first.npatches;
        for (int p = 0; p < first.npanels; p++) patches += first.panel[p].nrows - 1;
        OK(patches == files[i].patches, "%s has %d patches", files[i].path, patches);
        round_trip(files[i].path, &first);
    }
}

/* The example of the specification, between its first two fences. */
static void documented(void) {
    Arena arena = {0};
    Error e = {0};
    Text text;
    bool read = text_read("garments/README.md", 1 << 20, &arena, &text, &e);
    const char *from = read ? strstr(text.data, "```\n") : NULL, *to = from ? strstr(from + 4, "```") : NULL;
    char *example = to ? arena_text(&arena, from + 4, (size_t)(to - from - 4), &e) : NULL;
    if (OK(example, "garments/README.md begins with an example")) {
        const Garment *g = parse_good(example);
        if (OK(g, "the example is a garment")) round_trip("the example", g);
    }
    arena_free(&arena);
}

/* --- mistakes --- */

typedef struct {
    const char *text;
    int line, column;
    const char *says;
} Mistake;

static const Mistake mistakes[] = {
    {"", 1, 1, "must begin with 'garment NAME'"},
    {"# nothing\n", 2, 1, "must begin with 'garment NAME'"},
    {"ring a pelvis 1\n", 1, 1, "must begin with 'garment NAME'"},
    {"solid cube\n", 1, 1, "must begin with 'garment NAME'"},
    {"garment\n", 1, 8, "expected 'garment NAME'"},
    {"garment a b\n", 1, 11, "expected 'garment NAME'"},
    {"garment g\n", 1, 9, "no panel and no patch"},
    {"garment g\ngarment h\n", 2, 1, "second 'garment'"},
    /* names */
    {"garment body\n", 1, 9, "reserved"},
    {"garment BODY\n", 1, 9, "cannot be called 'BODY'"},
    {"garment ../etc\n", 1, 9, "begins with '.'"},
    {"garment -f\n", 1, 9, "begins with '-'"},
    {"garment a/b\n", 1, 9, "'/' in the name"},
    {"garment a,b\n", 1, 9, "',' in the name"},
    {"garment a\033[2J\n", 1, 9, "control character"},
    {"garment a23456789012345678901234567890123456789012345678\n", 1, 9, "longer than 47 bytes"},
    {"garment seam\n", 1, 9, "'seam' is a reserved word"},
    {"garment g\nring row pelvis 1\n", 2, 6, "'row' is a reserved word"},
    {"garment g\nring a.b pelvis 1\n", 2, 6, "'.' in the name"},
    {RINGS "ring a chest 1\n", 5, 6, "there is a ring 'a' already"},
    {RINGS "panel a\n", 5, 7, "there is a ring 'a' already"},
    {PANEL "panel p\n", 9, 7, "there is a panel 'p' already"},
    {"garment g\npatch s\n" FLAT "patch s\n", 19, 7, "there is a patch 's' already"},
    /* words */
    {"garment g\npannel p\n", 2, 1, "unknown statement 'pannel'; did you mean 'panel'?"},
    {"garment g\nxyzzy 1\n", 2, 1, "unknown statement 'xyzzy'"},
    {"garment g\nfollow bone\n", 2, 8, "did you mean 'bones'?"},
    {"garment g\nfit snug\n", 2, 5, "unknown fit 'snug': expected tight or loose"},
    {"garment g\nfit tight\nfit tight\n", 3, 1, "given twice"},
    {"garment g\nfollow bones\nfollow bones\n", 3, 1, "given twice"},
    {PANEL "follow envelope\n", 9, 1, "must stand above"},
    {"garment g\ndetail 0\n", 2, 8, "whole number from 1 to 64"},
    {"garment g\ndetail 2.5\n", 2, 8, "whole number"},
    {"garment g\ndetail 4\ndetail 4\n", 3, 1, "given twice"},
    /* rings */
    {"garment g\nring a pelvis\n", 2, 14, "expected 'ring NAME PART AT"},
    {"garment g\nring a left_tigh 1\n", 2, 8, "unknown body part 'left_tigh'; did you mean 'left_thigh'?"},
    {"garment g\nring a thigh 1\n", 2, 8, "unknown body part 'thigh': expected left_thigh or right_thigh"},
    {"garment g\nring a hips 1\n", 2, 8, "unknown body part 'hips': expected pelvis, spine, chest, neck, head, or "
     "with left_ or right_: clavicle, upper_arm, forearm, hand, thigh, shin, foot, toe"},
    {"garment g\nring a pelvis nan\n", 2, 15, "expected a number, found 'nan'"},
    {"garment g\nring a pelvis 1e99\n", 2, 15, "out of range"},
    {"garment g\nring a pelvis 12\n", 2, 15, "from -10 to 10"},
    {"garment g\nring a pelvis 1 easy 2\n", 2, 17, "unknown property of a ring 'easy'; did you mean 'ease'?"},
    {"garment g\nring a pelvis 1 ease\n", 2, 21, "expected a number"},
    {"garment g\nring a pelvis 1 ease 1 ease 1\n", 2, 24, "'ease' is given twice"},
    {"garment g\nring a pelvis 1 size 1 1\n", 2, 25, "expected a number"},
    {"garment g\nring a pelvis 1 size -1 1 1\n", 2, 22, "expected metres, from 0 to 10"},
    {"garment g\nring a pelvis 1 size 0 1 1\n", 2, 6, "no size left"},
    {"garment g\nring a pelvis 1 tilt 181\n", 2, 22, "from -180 to 180"},
    /* bind, move, join */
    {RINGS "bind d pelvis 1\n", 5, 6, "unknown ring 'd'"},
    {RINGS "bind a.lft pelvis 1\n", 5, 8, "unknown station 'lft'; did you mean 'left'?"},
    {RINGS "bind a. pelvis 1\n", 5, 6, "expected RING.STATION, found 'a.'"},
    {RINGS "bind a pelvis 0\n", 5, 15, "a weight must be positive"},
    {RINGS "bind a pelvis -1\n", 5, 15, "a weight must be positive"},
    {RINGS "bind a pelvis nan\n", 5, 15, "found 'nan'"},
    {RINGS "bind a pelvis 1 chest\n", 5, 22, "expected a number"},
    {RINGS "bind a pelvis 1 pelvis 1\n", 5, 17, "'pelvis' is named twice"},
    {RINGS "bind a pelvis 1 chest 1 spine 1 neck 1 head 1\n", 5, 40, "more than 4 body parts"},
    {RINGS "bind a pelvis 1\nbind a chest 1\n", 6, 6, "'a.left' is bound already"},
    {RINGS "bind a.left pelvis 1\nbind a chest 1\n", 6, 6, "'a.left' is bound already"},
    {RINGS "move a 0 0 0\n", 5, 6, "expected RING.STATION, found 'a'"},
    {RINGS "move a.left 0 0\n", 5, 16, "expected 'move RING.STATION X Y Z'"},
    {RINGS "move a.left 0 0 1\nmove a.left 0 0 1\n", 6, 6, "moved already"},
    {RINGS "join a.left a.right\n", 5, 6, "two stations of one ring"},
    {RINGS "join a.left b.left\njoin b.left c.left\n", 6, 6, "'b.left' is joined already"},
    /* panels */
    {RINGS "row a left front\n", 5, 1, "'row' outside a panel"},
    {RINGS "panel p\nrow d left front\n", 6, 5, "unknown ring 'd'"},
    {RINGS "panel p\nrow a left right\n", 6, 5, "'left' and 'right' are not neighbours"},
    {RINGS "panel p\nrow a left left\n", 6, 5, "are not neighbours"},
    {RINGS "panel p\nrow a left front left\n", 6, 5, "no half arc"},
    {RINGS "panel p\nrow a left front back\n", 6, 5, "no half arc"},
    {RINGS "panel p\nrow a left frnt right\n", 6, 12, "did you mean 'front'?"},
    {RINGS "panel p\nrow a left\n", 6, 11, "expected 'row RING FROM [VIA] TO'"},
    {RINGS "panel p\nrow a left front\nrow a left front\n", 7, 5, "a row on the ring 'a' already"},
    {RINGS "panel p\nrow a left front\n", 5, 7, "1 of at least 2 rows"},
    {RINGS "panel p\npin a\n", 5, 7, "0 of at least 2 rows"},
    {PANEL "pin a\nrow c left front\n", 10, 1, "'row' outside a panel"},
    /* raw patches */
    {"garment g\npatch s\n0 0 0 pelvis 1\n", 2, 7, "1 of its 16 points"},
    {"garment g\npatch s\n0 0 0 pelvis 1\nseam s.top s.end\n", 4, 1, "expected point 2 of the 16"},
    {"garment g\npatch s\n0 0 pelvis 1\n", 3, 5, "expected a number, found 'pelvis'"},
    {"garment g\npatch s\n0 0 0\n", 3, 6, "expected a body part and its weight"},
    {"garment g\npatch s\n0 0 0 pelvs 1\n", 3, 7, "did you mean 'pelvis'?"},
    {"garment g\npatch s\n0 0 nan pelvis 1\n", 3, 5, "found 'nan'"},
    {"garment g\npatch s\n" FLAT "1 1 1 pelvis 1\n", 19, 1, "more than 16 points"},
    {"garment g\npatch s\n" POINTS16, 2, 7, "degenerate"},
    {"garment g\npatch s\n" COLUMN(0, "pelvis") COLUMN(0, "pelvis") COLUMN(0, "pelvis") COLUMN(0, "pelvis"), 2, 7,
     "degenerate"},
    /* seams */
    {TWO "seam p.end\n", 13, 11, "expected 'seam"},
    {TWO "seam p.end r.start\n", 13, 12, "unknown panel or patch 'r'"},
    {TWO "seam p.end q.stat\n", 13, 14, "did you mean 'start'?"},
    {TWO "seam p q\n", 13, 6, "expected PIECE.SIDE, found 'p'"},
    {TWO "seam p.end q.start flat\n", 13, 20, "expected 'crease'"},
    {TWO "seam p.end p.end\n", 13, 6, "cannot be sewn to itself"},
    {TWO "seam p.start q.start\n", 13, 6, "does not meet: 'a.left' against 'a.right'"},
    {TWO "seam p.top q.top\n", 13, 6, "does not meet"},
    {TWO "seam p.top q.start\n", 13, 6, "does not meet"},
    {TWO "seam p.end q.start\nseam q.start p.end\n", 14, 6, "has a seam already"},
    {TWO "patch s\n" FLAT "seam p.end s.start\n", 30, 6, "a panel cannot be sewn to a raw patch"},
    {"garment g\npatch s\n" FLAT "patch t\n" FLAT "seam s.end t.start\n", 36, 6, "up to 0.3 m apart"},
    {"garment g\npatch s\n" FLAT "patch t\n" COLUMN(.3, "chest") COLUMN(.4, "pelvis") COLUMN(.5, "pelvis")
         COLUMN(.6, "pelvis") "seam s.end t.start\n",
     36, 6, "follow different bones"},
    {"garment g\npatch s\n" FLAT "patch t\n" BACK "seam s.end t.start\n", 36, 6, "folded by up to 180 degrees"},
    {"garment g\npatch s\n" FLAT "patch t\n" BACK "seam t.start s.end\n", 36, 6, "folded by up to 180 degrees"},
    /* pins, colliders */
    {RINGS "pin a\n", 5, 5, "no panel above uses the ring 'a'"},
    {PANEL "pin d\n", 9, 5, "unknown ring 'd'"},
    {PANEL "pin p\n", 9, 5, "pin a ring or one side, as in 'p.top'"},
    {PANEL "pin p.up\n", 9, 7, "unknown side 'up': expected start, end, top or bottom"},
    {PANEL "collide a..b\n", 9, 13, "expected 'collide"},
    {PANEL "collide a..d pelvis\n", 9, 9, "unknown ring 'd'"},
    {PANEL "collide a..a pelvis\n", 9, 9, "no panel above has patches from the ring 'a' to 'a'"},
    {RINGS "collide a..b pelvis\n", 5, 9, "no panel above has patches"},
    {PANEL "collide a pelvis\n", 9, 9, "'a' is one ring"},
    {PANEL "collide r pelvis\n", 9, 9, "unknown panel or patch 'r'"},
    {PANEL "collide p pelvis pelvis\n", 9, 18, "named twice"},
    {PANEL "collide p knee\n", 9, 11, "unknown body part 'knee'"},
    /* mirrors */
    {PANEL "mirror left_ right_\n", 9, 8, "nothing above has a name that begins with 'left_'"},
    {"garment g\nring l_a pelvis 1\nring r_a pelvis 1\nmirror l_ r_\n", 4, 8, "taken: 'r_a'"},
    {"garment g\nring l_a pelvis 1\nmirror l_a row\n", 3, 8, "reserved word"},
    {"garment g\nring l_a pelvis 1\nmirror l_ r_234567890123456789012345678901234567890123456\n", 3, 8,
     "longer than 47 bytes"},
    /* envelopes */
    {"garment g\nfollow envelope\nring a pelvis 1\nring b left_hand 1\npanel p\nrow a left front\nrow b left front\n",
     4, 6, "not the ring 'b' on 'left_hand'"},
    {"garment g\nfollow envelope\nring a pelvis 1\nring b chest 1\npanel p\nrow a left front\nrow b left front\n", 4, 6,
     "'b' must lie below 'a'"},
    {"garment g\nfollow envelope\nring a pelvis 1\nring b pelvis 0\nring c left_shin 0\npanel p\nrow a left front\nrow "
     "c left front\n", 6, 7, "row 2 of the panel 'p' must be on the ring 'b'"},
    {"garment g\nfollow envelope\nring a pelvis 1\nring b pelvis 0\npanel p\nrow a left front\nrow b left front\nring "
     "c left_shin 0\n", 8, 1, "must stand above its panels"},
    {"garment g\nfollow envelope\npatch s\n", 3, 1, "no rings to follow the envelope"},
};

static void finds_mistakes(void) {
    for (size_t i = 0; i < sizeof mistakes / sizeof *mistakes; i++) {
        const Mistake *m = &mistakes[i];
        Error e;
        bool good = parse(m->text, &first, &e);
        bool found =
            !good && e.kind == ERR_INPUT && e.line == m->line && e.column == m->column && strstr(e.text, m->says);
        if (!OK(found, "%d:%d: %s", m->line, m->column, m->says)) printf("# %d:%d: %s\n", e.line, e.column, e.text);
    }
}

/* Appends n copies of `line`, each '@' replaced by the number of the copy. */
static void repeat(char *text, size_t size, const char *line, int n) {
    size_t k = strlen(text);
    for (int i = 0; i < n; i++)
        for (const char *c = line; *c && k + 12 < size; c++) {
            if (*c == '@') k += (size_t)snprintf(text + k, size - k, "%d", i);
            else text[k++] = *c, text[k] = 0;
        }
}

/* As many as the format allows are taken, one more is not. */
static void has_limits(void) {
    static const struct {
        const char *head, *line;
        int most;
        const char *says;
    } limits[] = {
        {"garment g\n", "ring r@ pelvis 1\n", GARMENT_RINGS_MAX, "more than 64 rings"},
        {RINGS, "panel p@\nrow a left front\nrow b left front\n", GARMENT_PANELS_MAX, "more than 32 panels"},
        {"garment g\n", "patch p@\n" FLAT, GARMENT_PATCHES_MAX, "more than 64 raw patches"},
        {PANEL, "pin a\n", GARMENT_PINS_MAX, "more than 16 pins"},
        {PANEL, "collide a..b chest\n", GARMENT_COLLIDES_MAX, "more than 32 collides"},
    };
    static char text[1 << 16];
    for (size_t i = 0; i < sizeof limits / sizeof *limits; i++)
        for (int extra = 0; extra < 2; extra++) {
            Error e;
            snprintf(text, sizeof text, "%s", limits[i].head);
            repeat(text, sizeof text, limits[i].line, limits[i].most + extra);
            bool good = parse(text, &first, &e), told = strstr(e.text, limits[i].says) != NULL;
            OK(extra ? !good && told : !told, "%s, not before", limits[i].says);
        }
    strcpy(text, "garment g\n");
    repeat(text, sizeof text, "ring r@ pelvis 1\n", GARMENT_ROWS_MAX + 1);
    strcat(text, "panel p\n");
    repeat(text, sizeof text, "row r@ left front\n", GARMENT_ROWS_MAX + 1);
    Error e;
    OK(!parse(text, &first, &e) && e.line == 36 && strstr(e.text, "more than 16 rows"),
       "more than 16 rows, at the 17th");
}

int main(void) {
    reads_rings();
    reads_pieces();
    mirrors();
    seams_meet();
    round_trips();
    shipped();
    documented();
    finds_mistakes();
    has_limits();
    return tap_done();
}
