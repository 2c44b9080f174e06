/* Acclaim pairs: what a skeleton of bones becomes, which file is taken for the skeleton, and what
   is said of files that are wrong. */
#include "motion/motion.h"

#include <string.h>
#include <sys/stat.h>

#include "folder.h"
#include "session.h"
#include "tap.h"

/* A thigh with a turned axis, a shin that hinges, an arm whose values come in another order. */
#define HEAD                                                                                       \
    ":version 1.10\n:name T\n:units\n mass 1.0\n length 0.45\n angle deg\n"                        \
    ":documentation\n begin what you like\n"
#define ROOT ":root\n order TX TY TZ RX RY RZ\n axis XYZ\n position 0 0 0\n orientation 0 0 0\n"
#define THIGH                                                                                      \
    " begin\n id 1\n name thigh\n direction 0 -1 0\n length 4\n axis 30 0 20 XYZ\n dof rx ry rz\n" \
    " limits (-160.0 20.0)\n (-70.0 70.0)\n (-60 70)\n end\n"
#define SHIN                                                                                       \
    " begin\n id 2\n name shin # hinge\n direction 0 -1 0\n length 3\n axis 0 0 0 XYZ\n dof rx\n"  \
    " limits (0 1)\n end\n"
#define ARM " begin\n name arm\n direction 1 0 0\n length 2\n axis 0 0 0 ZXY\n dof rz l ry\n end\n"
#define TREE ":hierarchy\n begin\n root thigh arm\n thigh shin\n end\n"
#define ASF "# made by hand\n" HEAD ROOT ":bonedata\n" THIGH SHIN ARM TREE

#define VALUES "root 1 2 3 10 20 30\nthigh 40 50 60\nshin 70\narm 80 0.5 90\n"
#define FIRST "#!OML:ASF x\n:FULLY-SPECIFIED\n:DEGREES\n1\n" VALUES
#define NEXT "2\narm 8 0 9\nshin 7\n# a remark\nthigh 4 5 6\nroot 9 8 7 6 5 4\n"
/* The least bone, along x and turning about it. */
#define BONE(name) " begin\n name " name "\n direction 1 0 0\n length 1\n axis 0 0 0 XYZ\n dof rx\n end\n"

static Session session;

static bool same(const double *a, const double *b, int n) {
    for (int i = 0; i < n; i++)
        if (!(fabs(a[i] - b[i]) <= 1e-12)) return printf("# value %d is %.17g\n", i, a[i]), false;
    return true;
}

static void test_skeleton(void) {
    folder_put_text("pair.asf", ASF);
    folder_put_text("pair.amc", FIRST NEXT);
    Session *s = &session;
    bool good = session_open(s, in_folder("pair.amc"), (MotionOptions){0});
    const Skeleton *k = &s->motion.skeleton;
    OK(good && s->notes.count == 0, "a pair %s", s->e.text);
    if (!good) return;
    OK(strcmp(s->motion.format, "ASF/AMC") == 0 && !s->motion.has_frame_time && s->motion.frame_time == 1.0 / 120,
       "no rate: 120");
    NEAR(s->motion.file_unit, 0.0254 / 0.45, 1e-15, "the unit in metres");
    OK(k->njoints == 6 && k->nchannels == 12, "%d joints, %d channels", k->njoints, k->nchannels);
    int thigh = skeleton_find(k, "thigh"), shin = skeleton_find(k, "shin"), end = skeleton_find(k, "shin_End"),
        arm = skeleton_find(k, "arm");
    OK(thigh == 1 && shin == 2 && end == 3 && arm == 4, "in the order of the tree");
    OK(vec_len(k->joint[thigh].offset) == 0 && k->joint[shin].offset.y == -4 && k->joint[end].offset.y == -3 &&
       k->joint[end].is_end,
       "a joint stands where its parent's bone ends");
    OK(k->joint[thigh].has_axis && !k->joint[shin].has_axis, "axis");
    OK(k->joint[thigh].channel[0] == CHANNEL_RZ && k->joint[thigh].channel[2] == CHANNEL_RX,
       "XYZ is the product Rz Ry Rx");
    OK(k->joint[arm].nchannels == 2 && k->joint[arm].channel[0] == CHANNEL_RY &&
       k->joint[arm].channel[1] == CHANNEL_RZ, "ZXY: Ry Rx Rz, a length left out");
    const double first[] = {1, 2, 3, 30, 20, 10, 60, 50, 40, 70, 90, 80}, next[] = {9, 8, 7, 4, 5, 6, 6, 5, 4, 7, 9, 8};
    good = s->motion.nframes == 2 && session_row(s, 1) && same(s->row, next, 12) &&
           session_row(s, 0) && same(s->row, first, 12);
    OK(good, "values go to their channels, bones in any order");
    Rigid w[6];
    skeleton_pose(k, s->row, w);
    Mat3 c = mat_mul(mat_axis_angle(vec(0, 0, 1), 20 * PI / 180), mat_axis_angle(vec(1, 0, 0), 30 * PI / 180));
    Mat3 d = mat_axis_angle(vec(0, 0, 1), 60 * PI / 180);
    d = mat_mul(d, mat_axis_angle(vec(0, 1, 0), 50 * PI / 180));
    d = mat_mul(d, mat_axis_angle(vec(1, 0, 0), 40 * PI / 180));
    Vec3 knee = rigid_apply(w[0], mat_apply(mat_mul(c, mat_mul(d, mat_transpose(c))), vec(0, -4, 0)));
    NEAR(vec_dist(w[shin].t, knee), 0, 1e-12, "the knee is at C D C^T of the thigh");
    session_close(s);
}

/* What the root turns first its `order` says, whatever the `axis` of its position at rest. */
static void test_root_order(void) {
    folder_put_text("root.asf", ":root\n order RZ TX TY RY TZ RX\n axis YXZ\n position 0 0 0\n orientation 0 0 0\n"
                                ":bonedata\n" BONE("a") ":hierarchy\n begin\n root a\n end\n");
    folder_put_text("root.amc", ":DEGREES\n1\nroot 30 1 2 20 3 10\na 5\n");
    Session *s = &session;
    bool good = session_open(s, in_folder("root.amc"), (MotionOptions){0}) && session_row(s, 0);
    const double row[] = {1, 2, 3, 10, 20, 30, 5};
    const ChannelKind *c = s->motion.skeleton.joint[0].channel;
    OK(good && c[3] == CHANNEL_RX && c[4] == CHANNEL_RY && c[5] == CHANNEL_RZ && same(s->row, row, 7),
       "a root whose order is RZ RY RX is the product Rx Ry Rz %s", s->e.text);
    session_close(s);
}

static void test_units(void) {
    folder_put_text("rad.asf", ":units\n angle rad\n length 1\n" ROOT
                               ":bonedata\n begin\n name a\n direction 1 0 0\n length 1\n"
                               " axis 0 0 1.5707963267948966 XYZ\n dof rx\n end\n:hierarchy\n begin\n root a\n end\n");
    folder_put_text("rad.amc", "1\nroot 0 0 0 0 0 1\na 0.5\n");
    Session *s = &session;
    bool good = session_open(s, in_folder("rad.amc"), (MotionOptions){.fps = 60}) && session_row(s, 0);
    const double row[] = {0, 0, 0, 180 / PI, 0, 0, 90 / PI};
    OK(good && same(s->row, row, 7), "radians become degrees %s", s->e.text);
    OK(good && s->motion.file_unit == 0, "a unit of 1 says nothing");
    OK(good && s->motion.has_frame_time && s->motion.frame_time == 1.0 / 60, "--fps");
    Vec3 turned = mat_apply(s->motion.skeleton.joint[1].axis, vec(1, 0, 0));
    NEAR(vec_dist(turned, vec(0, 1, 0)), 0, 1e-15, "also of an axis");
    session_close(s);
    folder_put_text("rad.amc", ":DEGREES\n1\nroot 0 0 0 0 0 1\na 0.5\n");
    good = session_open(s, in_folder("rad.amc"), (MotionOptions){0}) && session_row(s, 0);
    OK(good && s->row[6] == 0.5, "the motion's own word on angles counts more");
    session_close(s);
}

static void test_rate(void) {
    Session *s = &session;
    folder_put_text("rate.asf", ASF);
    folder_put_text("rate.amc", ":FULLY-SPECIFIED\n:SAMPLES-PER-SECOND 50\n:DEGREES\n1\n" VALUES);
    bool good = session_open(s, in_folder("rate.amc"), (MotionOptions){0});
    OK(good && s->motion.has_frame_time && s->motion.frame_time == 1.0 / 50, "a rate in the file %s", s->e.text);
    session_close(s);
    good = session_open(s, in_folder("rate.amc"), (MotionOptions){.fps = 60});
    OK(good && s->motion.frame_time == 1.0 / 60, "--fps counts more");
    session_close(s);
}

typedef struct {
    const char *what, *text, *message; /* a part of the error or warning; NULL: there is none */
    int frames, line, column;          /* frames 0: refused */
} Case;

static const Case motions[] = {
    {"plain", FIRST NEXT, NULL, 2, 0, 0},
    {"no keywords", "1\n" VALUES, NULL, 1, 0, 0},
    {"ends in a bone's name", FIRST "2\narm 8 0 9\nshi", "ends within frame 2", 1, 11, 1},
    {"ends in a number", FIRST "2\narm 8 0 -", "ends within frame 2", 1, 10, 9},
    {"ends between bones", FIRST "2\narm 8 0 9\n", "ends within frame 2", 1, 11, 1},
    {"ends behind a frame's number", FIRST "2", "ends within frame 2", 1, 9, 2},
    {"frame numbers with a gap", FIRST "7\narm 8 0 9\nshin 7\nthigh 4 5 6\nroot 9 8 7 6 5 4\n",
     "frame 7 follows frame 1", 2, 9, 1},
    {"indented", "  1\n " VALUES "\t2\n " VALUES, NULL, 2, 0, 0},
    {"starts in the middle", "512\n" VALUES, NULL, 1, 0, 0},
    {"a bone is missing", FIRST "2\nroot 1 2 3 10 20 30\nthigh 40 50 60\nshin 70\n3\n",
     "frame 2 has no values for bone 'arm'", 0, 13, 1},
    {"a bone is missing from the first frame on", "1\nroot 1 2 3 10 20 30\nthigh 4 5 6\nshin 70\n2\nroot 1 2 3 1 2 3\n"
     "thigh 4 5 6\nshin 7\n", "no values for bone 'arm', which rests", 2, 5, 1},
    {"two of them", "1\nroot 1 2 3 10 20 30\nthigh 4 5 6\n2\nroot 1 2 3 1 2 3\nthigh 4 5 6\n",
     "no values for bone 'shin' and 1 more, which rest", 2, 4, 1},
    {"the root is missing", "1\narm 1 2 3\nthigh 4 5 6\nshin 7\n2\n", "frame 1 has no values for bone 'root'", 0, 5, 1},
    {"a bone twice", FIRST "2\nshin 7\nshin 7\n", "frame 2 has bone 'shin' twice", 0, 11, 1},
    {"an unknown bone", FIRST "2\ntail 7\nshin 7\n", "has no bone 'tail'", 0, 10, 1},
    {"a value is missing", FIRST "2\nthigh 1 2\nshin 7\n", "frame 2: 2 values for the 3 of bone 'thigh'", 0, 10, 10},
    {"a value too many", FIRST "2\nshin 1 2\n", "more than the 1 values of bone 'shin'", 0, 10, 8},
    {"nan", FIRST "2\nthigh 1 nan 2\n", "frame 2, bone 'thigh', value 2 is 'nan'", 0, 10, 9},
    {"comma", FIRST "2\nthigh 1 2,5 2\n", "comma in '2,5'", 0, 10, 9},
    {"text for a frame's number", "#\n:DEGREES\nroot 1 2 3 4 5 6\n", "expected the number of a frame, found 'root'",
     0, 3, 1},
    {"no frames", ":FULLY-SPECIFIED\n:DEGREES\n", "no complete frame", 0, 0, 0},
    {"a rate that is none", ":SAMPLES-PER-SECOND fast\n1\n" VALUES, "expected a number, found 'fast'", 0, 1, 21},
    {"a rate of nothing", ":DEGREES\n:SAMPLES-PER-SECOND\n1\n" VALUES, NULL, 1, 0, 0},
    {"a rate of next to nothing", ":SAMPLES-PER-SECOND 1e-320\n1\n" VALUES, "is not between", 0, 1, 21},
    {"a rate of zero", ":SAMPLES-PER-SECOND 0\n1\n" VALUES, "not positive", 0, 1, 21},
    {"a skeleton for a motion", ASF, "an ASF skeleton without a motion", 0, 2, 1},
};

static const Case skeletons[] = {
    {"not a skeleton", "HIERARCHY\n", "expected a keyword such as :version, found 'HIERARCHY'", 0, 1, 1},
    {"a motion for a skeleton", FIRST, "is this an ASF skeleton?", 0, 0, 0},
    {"no hierarchy", HEAD ROOT ":bonedata\n" BONE("a"), "no ':hierarchy'", 0, 0, 0},
    {"an unknown child", HEAD ROOT ":bonedata\n" BONE("a") ":hierarchy\n begin\n root a b\n",
     "expected the name of a bone, found 'b'", 0, 24, 9},
    {"a child of two", HEAD ROOT ":bonedata\n" BONE("a") ":hierarchy\nroot a\nroot a\n",
     "bone 'a' cannot have a parent twice", 0, 24, 6},
    {"a child of itself", HEAD ROOT ":bonedata\n" BONE("a") ":hierarchy\na a\n", "bone 'a' has no place", 0, 16, 7},
    {"the root as a child", HEAD ROOT ":bonedata\n" BONE("a") ":hierarchy\na root\n",
     "bone 'root' cannot have a parent", 0, 23, 3},
    {"a bone outside of the tree", HEAD ROOT ":bonedata\n" BONE("a") BONE("b") ":hierarchy\nroot a\n",
     "bone 'b' has no place", 0, 23, 7},
    {"two bones of a name", HEAD ROOT ":bonedata\n" BONE("a") BONE("a") ":hierarchy\nroot a\n",
     "two bones are named 'a'", 0, 23, 7},
    {"a bone without a name or an end", HEAD ROOT ":bonedata\n" BONE("a") " begin\n length 1\n:hierarchy\nroot a\n",
     "a bone without a name", 0, 22, 2},
    {"a bone without a name behind the tree", ASF ":bonedata\n begin\n length 1\n", "a bone without a name", 0, 49, 2},
    {"a bone without a name", HEAD ROOT ":bonedata\n begin\n length 1\n end\n", "a bone without a name", 0, 17, 2},
    {"an unknown dof", HEAD ROOT ":bonedata\n begin\n name a\n dof rx rw\n end\n",
     "expected tx ty tz rx ry rz or l, found 'rw'", 0, 17, 9},
    {"a dof twice", HEAD ROOT ":bonedata\n begin\n name a\n dof rx rx\n end\n",
     "expected another degree of freedom, found 'rx'", 0, 17, 9},
    {"an unknown order", HEAD ROOT ":bonedata\n begin\n name a\n axis 0 0 0 XYY\n",
     "expected an order such as XYZ, found 'XYY'", 0, 17, 13},
    {"a word for a number", HEAD ROOT ":bonedata\n begin\n name a\n length long\n",
     "the bone's length: expected a number, found 'long'", 0, 17, 9},
    {"an unknown angle", ":units\n angle gon\n", "expected deg or rad, found 'gon'", 0, 2, 8},
    {"empty", "", "is empty", 0, 0, 0},
};

static bool as_wanted(const Case *c) {
    Session *s = &session;
    bool good = session_open(s, in_folder("case.amc"), (MotionOptions){.asf = in_folder("case.asf")});
    if (good != (c->frames > 0)) good = false;
    else if (!good) good = s->e.kind == ERR_INPUT && session_told(&s->e, c->message, c->line, c->column);
    else good = s->motion.nframes == c->frames && session_row(s, c->frames - 1) &&
                s->notes.count == (c->message != NULL) &&
                (!c->message || session_told(&s->notes.note[0], c->message, c->line, c->column));
    session_close(s);
    return good;
}

static void test_cases(void) {
    folder_put_text("case.asf", ASF);
    for (size_t i = 0; i < sizeof motions / sizeof *motions; i++) {
        folder_put_text("case.amc", motions[i].text);
        OK(as_wanted(&motions[i]), "motion: %s", motions[i].what);
    }
    folder_put_text("case.amc", FIRST);
    for (size_t i = 0; i < sizeof skeletons / sizeof *skeletons; i++) {
        folder_put_text("case.asf", skeletons[i].text);
        OK(as_wanted(&skeletons[i]), "skeleton: %s", skeletons[i].what);
    }
}

/* Which skeleton is taken shows in the arm's length. */
static void put_skeleton(const char *name, double length) {
    char text[2048];
    snprintf(text, sizeof text,
             HEAD ROOT ":bonedata\n begin\n name a\n direction 1 0 0\n length %g\n axis 0 0 0 XYZ\n dof rx\n end\n"
                       ":hierarchy\n root a\n", length);
    folder_put_text(name, text);
}

static void test_found(const char *amc, double length, const char *why) {
    folder_put_text(amc, "1\nroot 0 0 0 0 0 0\na 1\n");
    bool good = session_open(&session, in_folder(amc), (MotionOptions){0});
    double found = good ? session.motion.skeleton.joint[2].offset.x : 0;
    OK(found == length, "%s: %s %s", amc, why, session.e.text);
    session_close(&session);
}

static void test_search(void) {
    mkdir(in_folder("many"), 0700);
    mkdir(in_folder("lone"), 0700);
    mkdir(in_folder("none"), 0700);
    put_skeleton("many/02.asf", 2);
    put_skeleton("many/02_03.ASF", 3);
    put_skeleton("many/walk.asf", 4);
    put_skeleton("many/1.asf", 5);
    put_skeleton("lone/any.asf", 6);
    test_found("many/walk.amc", 4, "the same stem");
    test_found("many/02_04.amc", 2, "the subject's");
    test_found("many/02_03_take1.amc", 3, "the longest that fits, in capitals");
    test_found("many/021.amc", 0, "02 is not 021, and nothing fits");
    test_found("many/11_02.amc", 0, "1 is not 11");
    test_found("lone/10_01.amc", 6, "the only one");
    test_found("none/10_01.amc", 0, "there is none");
}

int main(void) {
    if (!folder_make()) return 1;
    test_skeleton();
    test_root_order();
    test_units();
    test_rate();
    test_cases();
    test_search();
    folder_remove();
    return tap_done();
}
