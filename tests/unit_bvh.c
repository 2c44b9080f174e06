/* What real BVH files do wrong, and what is made of it: the frames that can be understood with a
   warning, or one error at its place. */
#include "motion/motion.h"

#include <string.h>

#include "folder.h"
#include "session.h"
#include "tap.h"

/* 4 channels. MOTION stands on line 16, the first frame on line 19. */
#define HEAD                                                                                       \
    "HIERARCHY\nROOT hip\n{\n\tOFFSET 0 0 0\n\tCHANNELS 3 Zrotation Xrotation Yrotation\n"         \
    "\tJOINT leg\n\t{\n\t\tOFFSET 0 -4 0\n\t\tCHANNELS 1 Xrotation\n"                              \
    "\t\tEnd Site\n\t\t{\n\t\t\tOFFSET 0 -3 0\n\t\t}\n\t}\n}\n"
#define FRAMES(count) HEAD "MOTION\nFrames: " count "\nFrame Time: 0.01\n"
#define ONE "MOTION\nFrames: 1\nFrame Time: 0.01\n"
#define MOVED(offset) "HIERARCHY\nROOT a\n{\nOFFSET " offset "\nCHANNELS 3 Xposition Yposition Zposition\n}\n"
#define LONE(channels) "HIERARCHY\nROOT hip\n{\n OFFSET 1 2 3\n CHANNELS " channels "\n}\n" ONE

typedef struct {
    const char *what, *text;
    int frames;          /* complete ones; 0: the file is refused */
    const char *message; /* a part of the error, or of the warning; NULL: there is none */
    int line, column;    /* where; 0: anywhere */
    double last;         /* the last value of the last frame */
} Case;

static const Case counts[] = {
    {"plain", FRAMES("2") "1 2 3 4\n5 6 7 8\n", 2, NULL, 0, 0, 8},
    {"no newline at the end", FRAMES("2") "1 2 3 4\n5 6 7 8", 2, NULL, 0, 0, 8},
    {"a single frame", FRAMES("1") "1 2 3 4\n", 1, NULL, 0, 0, 4},
    {"fewer frames than announced", FRAMES("9") "1 2 3 4\n5 6 7 8\n", 2, "9 frames announced, but 2 found", 21, 1, 8},
    {"more frames than announced", FRAMES("1") "1 2 3 4\n5 6 7 8\n", 1, "values behind the 1 announced", 20, 1, 4},
    {"cut within the last line", FRAMES("3") "1 2 3 4\n5 6 7 8\n9 10", 2, "ends within frame 3 of 3", 21, 5, 8},
    {"cut there, and the line ended", FRAMES("3") "1 2 3 4\n5 6 7 8\n9 10\n", 2, "ends within frame 3 of 3", 22, 1, 8},
    {"cut within a number", FRAMES("2") "1 2 3 4\n5 6 7 -", 1, "ends within frame 2 of 2", 20, 7, 4},
    {"cut within a frame's first number", FRAMES("2") "1 2 3 4\n-", 1, "ends within frame 2 of 2", 20, 1, 4},
    {"cut within an exponent", FRAMES("2") "1 2 3 4\n5 6 7 8e-", 1, "ends within frame 2", 20, 7, 4},
    {"cut within the first frame", FRAMES("2") "1 2", 0, "ends before the first frame is complete", 19, 4, 0},
    {"nothing behind the head", FRAMES("2"), 0, "ends before the first frame", 19, 1, 0},
    {"numbers behind the frames", FRAMES("2") "1 2 3 4\n5 6 7 8\n1 1\n", 2, "values behind the 2", 21, 1, 8},
    {"text behind the frames", FRAMES("2") "1 2 3 4\n5 6 7 8\n\nNotes: -\n", 2, "text behind the frames", 22, 1, 8},
    {"half the values on each line", FRAMES("3") "1 2\n3 4\n5 6\n", 0, "lines of 2 values for 4 channels", 19, 1, 0},
    {"twice the values on each line", FRAMES("2") "1 2 3 4 5 6 7 8\n1 2 3 4 5 6 7 8\n", 0, "lines of 8 values", 19, 1,
     0},
    {"one value more on each line", FRAMES("2") "1 2 3 4 5\n1 2 3 4 5\n", 0, "lines of 5 values", 19, 1, 0},
    {"one value more on the only line", FRAMES("1") "1 2 3 4 5\n", 0, "lines of 5 values", 19, 1, 0},
    {"one value less on each line", FRAMES("2") "1 2 3\n1 2 3\n1 2 3\n", 0, "lines of 3 values", 19, 1, 0},
    {"the same, more lines than frames", FRAMES("6") "1 2 3\n1 2 3\n1 2 3\n1 2 3\n1 2 3\n1 2 3\n1 2 3\n", 0,
     "lines of 3 values", 19, 1, 0},
    {"one value more, fewer lines than frames", FRAMES("9") "1 2 3 4 5\n1 2 3 4 5\n", 0, "lines of 5 values", 19, 1, 0},
    {"one value more, no newline", FRAMES("1") "1 2 3 4 5", 0, "lines of 5 values", 19, 1, 0},
    {"a value lost in the middle", FRAMES("3") "1 2 3 4\n5 6 7\n8 9 10 11\n", 0, "a line of 3 values for 4", 20, 1, 0},
    {"a value too many in the middle", FRAMES("3") "1 2 3 4\n5 6 7 8 9\n8 9 10 11\n", 0, "a line of 5 values", 20, 1,
     0},
    {"wrapped lines", FRAMES("2") "1 2\n3 4\n5 6\n7 8\n", 2, NULL, 0, 0, 8},
    {"lines wrapped anywhere", FRAMES("2") "1\n2 3 4 5\n\n6 7\n8", 2, NULL, 0, 0, 8},
    {"wrapped lines, cut", FRAMES("3") "1 2\n3 4\n5 6\n7 8\n9", 2, "ends within frame 3", 23, 2, 8},
    {"two frames on a line", FRAMES("4") "1 2 3 4 5 6 7 8\n1 2 3 4 5 6 7 9\n", 4, NULL, 0, 0, 9},
    {"all frames on a line", FRAMES("2") "1 2 3 4 5 6 7 8\n", 2, NULL, 0, 0, 8},
    {"frames: 0", FRAMES("0") "1 2 3 4\n", 0, "no frames", 17, 9, 0},
    {"frames: -3", FRAMES("-3") "1 2 3 4\n", 0, "no frames", 17, 9, 0},
    {"frames: 1.5", FRAMES("1.5") "1 2 3 4\n", 0, "whole number", 17, 9, 0},
    {"frames: 99999999999", FRAMES("99999999999") "1 2 3 4\n", 0, "more than the limit of 100000000", 17, 9, 0},
    {"frames: 1e999", FRAMES("1e999") "1 2 3 4\n", 0, "out of range", 17, 9, 0},
    {"no number of frames", FRAMES("") "1 2 3 4\n", 0, "expected a number, found 'Frame'", 18, 1, 0},
    {"no Frames: line", HEAD "MOTION\n1 2 3 4\n", 0, "expected 'Frames:'", 17, 1, 0},
};

static const Case numbers[] = {
    {"no blank in front of a minus", FRAMES("1") "0.0-7.5094748 3 4\n", 1, "no blank between", 19, 4, 4},
    {"no blank anywhere", FRAMES("1") "1-2-3e-2-4\n", 1, "no blank between", 19, 2, -4},
    {"no digit between point and minus", FRAMES("1") "1.-2 3 4\n", 1, "no blank between", 19, 3, 4},
    {"an exponent is no second number", FRAMES("1") "1 2 3 4.5e-01\n", 1, NULL, 0, 0, 0.45},
    {"below the smallest double", FRAMES("1") "1 2 3 -7e-400\n", 1, NULL, 0, 0, 0},
    {"below the smallest float", FRAMES("1") "1 2 3 1.5e-40\n", 1, NULL, 0, 0, 1.5e-40},
    {"no digit in front of the point", FRAMES("1") "1 2 3 .0083333\n", 1, NULL, 0, 0, .0083333},
    {"no digit behind the point", FRAMES("1") "-0 +2 3 1.\n", 1, NULL, 0, 0, 1},
    {"comma decimals", FRAMES("1") "1,5 2 3 4\n", 0, "frame 1, joint 'hip', Zrotation: comma in '1,5'", 19, 1, 0},
    {"nan", FRAMES("2") "1 2 3 4\n1 nan 3 4\n", 0, "frame 2, joint 'hip', Xrotation is 'nan'", 20, 3, 0},
    {"inf in the last channel", FRAMES("1") "1 2 3 -Infinity\n", 0, "frame 1, joint 'leg', Xrotation is '-Infinity'",
     19, 7, 0},
    {"-nan(ind)", FRAMES("1") "1 2 -nan(ind) 4\n", 0, "Yrotation is '-nan(ind)', not a finite", 19, 5, 0},
    {"1.#QNAN", FRAMES("1") "1 2 1.#QNAN 4\n", 0, "'1.#QNAN', not a finite", 19, 5, 0},
    {"overflow", FRAMES("1") "1 2 1e999 4\n", 0, "'1e999', out of range", 19, 5, 0},
    {"a word", FRAMES("1") "1 2 three 4\n", 0, "expected a number, found 'three'", 19, 5, 0},
    {"hexadecimal", FRAMES("1") "1 2 0x10 4\n", 0, "expected a number, found '0x10'", 19, 5, 0},
    {"a control byte", FRAMES("1") "1 2 \x01 4\n", 0, "expected a number", 19, 5, 0},
    {"nan in an OFFSET", "HIERARCHY\nROOT a\n{\nOFFSET 0 nan 0\n", 0, "OFFSET Y of joint 'a' is 'nan'", 4, 10, 0},
};

static const Case lines[] = {
    {"tabs and blanks", HEAD "MOTION \nFrames:\t1 \nFrame Time:\t0.01\t\n\t1\t2 3  4 \n", 1, NULL, 0, 0, 4},
    {"blanks round colons", HEAD "MOTION\nframes : 1\nFRAME TIME : 0.01\n1 2 3 4\n", 1, NULL, 0, 0, 4},
    {"no blank behind colons", HEAD "MOTION\nFrames:1\nFrameTime:0.01\n1 2 3 4\n", 1, NULL, 0, 0, 4},
    {"time in front of frames", HEAD "MOTION\nFrame Time: 0.01\nFrames: 1\n1 2 3 4\n", 1, NULL, 0, 0, 4},
    {"byte-order mark", "\xEF\xBB\xBF" FRAMES("1") "1 2 3 4\n", 1, NULL, 0, 0, 4},
    {"blank lines first", "\n \n" FRAMES("1") "1 2 3 4\n", 1, NULL, 0, 0, 4},
    {"time 0", HEAD "MOTION\nFrames: 1\nFrame Time: 0\n1 2 3 4\n", 0, "frame time is not positive", 18, 13, 0},
    {"time below 0", HEAD "MOTION\nFrames: 1\nFrame Time: -0.01\n1 2 3 4\n", 0, "not positive", 18, 13, 0},
    {"time denormal", HEAD "MOTION\nFrames: 1\nFrame Time: 1e-320\n1 2 3 4\n", 0, "is not between", 18, 13, 0},
    {"time of years", HEAD "MOTION\nFrames: 1\nFrame Time: 1e9\n1 2 3 4\n", 0, "1e+09 seconds is not", 18, 13, 0},
    {"no time", HEAD "MOTION\nFrames: 1\n1 2 3 4\n", 0, "expected 'Frame Time:'", 18, 1, 0},
    {"time nan", HEAD "MOTION\nFrames: 1\nFrame Time: nan\n1 2 3 4\n", 0, "the frame time is 'nan'", 18, 13, 0},
    {"1 frame per second", HEAD "MOTION\nFrames: 1\nFrame Time: 1.0\n1 2 3 4\n", 1,
     "unlikely frame time of 1 seconds", 18, 13, 4},
    {"1000 per second", HEAD "MOTION\nFrames: 1\nFrame Time: .001\n1 2 3 4\n", 1, "1000 frames per second", 18, 13, 4},
};

static const Case heads[] = {
    {"no End Site", LONE("3 Xrotation Yrotation Zrotation") "1 2 3\n", 1, NULL, 0, 0, 3},
    {"root without position, one channel", LONE("1 Yrotation") "7\n", 1, NULL, 0, 0, 7},
    {"an axis twice", LONE("3 Zrotation Xrotation Zrotation") "7 8 9\n", 1, NULL, 0, 0, 9},
    {"keywords in any case",
     "Hierarchy\nRoot a\n{\noffset 0 0 0\nchannels 1 xRotation\nend site\n{\noffset 0 1 0\n}\n}\n" ONE "5\n",
     1, NULL, 0, 0, 5},
    {"named end site",
     "HIERARCHY ROOT a\n{ OFFSET 0 0 0 CHANNELS 1 Xrotation End Site tip\n{ OFFSET 0 1 0 } }\n" ONE "5",
     1, NULL, 0, 0, 5},
    {"all on a line",
     "HIERARCHY ROOT a {OFFSET 0 0 0 CHANNELS 1 Xrotation JOINT b{OFFSET 0 1 0}} MOTION Frames: 1 Frame Time: .01 5",
     1, NULL, 0, 0, 5},
    {"duplicate names",
     "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\nJOINT a\n{\nOFFSET 0 0 0\n}\n}\n" ONE "5\n",
     1, "joint name 'a' occurs more than once", 0, 0, 5},
    {"a second ROOT",
     "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n}\n"
     "ROOT b\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n}\n" ONE "5 6\n", 1, "another ROOT", 7, 5, 6},
    {"a ROOT within a joint", "HIERARCHY\nROOT a\n{\nROOT b\n{\n", 0, "ROOT within joint 'a'", 4, 5, 0},
    {"no ROOT", "HIERARCHY\nMOTION\n", 0, "no ROOT", 2, 1, 0},
    {"JOINT without ROOT", "HIERARCHY\nJOINT a\n", 0, "JOINT cannot stand outside of a ROOT", 2, 1, 0},
    {"a joint without a name", "HIERARCHY\nROOT\n{\n", 0, "joint without a name", 3, 1, 0},
    {"brace missing", "HIERARCHY\nROOT a\nOFFSET 0 0 0\n", 0, "expected '{', found 'OFFSET'", 3, 1, 0},
    {"brace too many", "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n}\n}\n", 0, "'}' without '{'", 6, 1, 0},
    {"brace not closed", "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nMOTION\n", 0, "MOTION before the '}' of joint 'a'", 5,
     1, 0},
    {"no OFFSET", "HIERARCHY\nROOT a\n{\nCHANNELS 0\n}\n", 0, "joint 'a' has no OFFSET", 5, 1, 0},
    {"a rotation behind the OFFSET",
     "HIERARCHY\nROOT a\n{\nOFFSET 1 2 3 90 1e-3 -4\nCHANNELS 1 Xrotation\n"
     "End Site\n{\nOFFSET 0 1 0 0 0 0 }\n}\n" ONE "5\n", 1, "OFFSETs of more than three numbers", 4, 14, 5},
    {"two OFFSETs", "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nOFFSET 0 0 0\n}\n", 0, "a second OFFSET", 5, 7, 0},
    {"no channels at all", "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n}\n" ONE, 0, "no joint of", 0, 0, 0},
    {"a million channels", "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1000000\n", 0, "a joint has 0 to 9", 5, 17, 0},
    {"scale channels",
     "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 6 Xscale Yscale Zscale Xrotation Yrotation Zrotation\n}\n"
     ONE "1 1 1 5 6 7\n", 1, "scale channels, left out", 5, 12, 7},
    {"channels of an End Site", "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nEnd Site\n{\nCHANNELS 1 Xrotation\n", 0,
     "an End Site has none", 7, 11, 0},
    {"a joint in an End Site", "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nEnd Site\n{\nJOINT b\n", 0,
     "JOINT cannot stand in an End Site", 7, 1, 0},
    {"unknown channel", "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Wrotation\n", 0, "found 'Wrotation'", 5, 12, 0},
    {"unknown keyword", "HIERARCHY\nROOT a\n{\nSCALE 1\n", 0, "expected JOINT, End Site, OFFSET", 4, 1, 0},
    {"no MOTION", HEAD, 0, "the file ends before MOTION", 16, 1, 0},
    {"empty", "", 0, "is empty", 0, 0, 0},
    {"white space", " \n\r\n", 0, "is empty", 0, 0, 0},
    {"another format", "solid cube\n", 0, "neither BVH nor Acclaim AMC: starts with 'solid'", 1, 1, 0},
};

static Session session;

static const char *file_of(const char *text, size_t size) { return folder_put("motion.bvh", text, size); }

static bool as_wanted(const Case *c, const char *text, size_t size) {
    Session *s = &session;
    bool good = session_open(s, file_of(text, size), (MotionOptions){0});
    if (good && c->frames) {
        good = s->motion.nframes == c->frames && session_row(s, c->frames - 1) &&
               s->row[s->motion.skeleton.nchannels - 1] == c->last && s->notes.count == (c->message ? 1 : 0) &&
               (!c->message || session_told(&s->notes.note[0], c->message, c->line, c->column));
        if (!good) printf("# %d frames, %d notes, last %g\n", s->motion.nframes, s->notes.count,
                          s->row[s->motion.skeleton.nchannels - 1]);
    } else {
        good = !good && !c->frames && s->e.kind == ERR_INPUT && session_told(&s->e, c->message, c->line, c->column);
    }
    session_close(s);
    return good;
}

static void test_cases(const Case *cases, size_t n) {
    for (size_t i = 0; i < n; i++) OK(as_wanted(&cases[i], cases[i].text, strlen(cases[i].text)), "%s", cases[i].what);
}

/* The same case with other line ends says the same at the same place. */
static void test_line_ends(const Case *cases, size_t n, const char *ending, const char *what) {
    bool good = true;
    for (size_t i = 0; i < n; i++) {
        char text[2048];
        size_t size = 0;
        for (const char *p = cases[i].text; *p; p++) {
            if (*p != '\n') text[size++] = *p;
            else for (const char *q = ending; *q; q++) text[size++] = *q;
        }
        if (!as_wanted(&cases[i], text, size)) good = false, printf("# %s\n", cases[i].what);
    }
    OK(good, "%zu cases with %s", n, what);
}

static void test_names(void) {
    static const struct { const char *line, *name; } names[] = {
        {"Bip01 L Thigh", "Bip01 L Thigh"}, {"  mixamorig:Hips \t", "mixamorig:Hips"}, {"\"left hip\"", "left hip"},
        {"upperarm01.L", "upperarm01.L"},   {"TORSO#", "TORSO#"},
        {"H\xC3\xBC" "fte", "H\xC3\xBC" "fte"},
        {"LeftHand_End", "LeftHand_End"},   {"\"a {b}\" ", "a {b}"},                  {"'x', \"y\"", "'x', \"y\""},
        {"End", "End"},                     {"MOTION", "MOTION"},                     {"tail {", "tail"},
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char text[512];
        int n = snprintf(text, sizeof text,
                         "HIERARCHY\nROOT %s\n%s\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n"
                         "End Site\n{\nOFFSET 0 1 0\n}\n}\n" ONE "5\n",
                         names[i].line, strstr(names[i].line, "tail") ? "" : "{");
        bool good = session_open(&session, file_of(text, (size_t)n), (MotionOptions){0}) &&
            session.motion.skeleton.njoints == 2;
        char end[64];
        snprintf(end, sizeof end, "%s_End", names[i].name);
        OK(good && strcmp(session.motion.skeleton.joint[0].name, names[i].name) == 0 &&
               strcmp(session.motion.skeleton.joint[1].name, end) == 0 &&
               skeleton_find(&session.motion.skeleton, end) == 1,
           "name %s", names[i].name);
        session_close(&session);
    }
}

/* ROOT with 1, 2, 3 as OFFSET; what the root's height says. */
static void test_position(const char *what, const char *text, PositionRule rule, bool adds) {
    bool good = session_open(&session, file_of(text, strlen(text)), (MotionOptions){.position = rule});
    OK(good && session.motion.skeleton.position_adds == adds, "position channels %s: %s", adds ? "add" : "replace",
       what);
    session_close(&session);
}

static void test_positions(void) {
    static const char around[] = LONE("3 Xposition Yposition Zposition") "1.1 2 2.9\n";
    static const char deltas[] = LONE("3 Xposition Yposition Zposition") "0.1 0 -0.1\n";
    static const char height[] = LONE("1 Yposition") "2.05\n";
    static const char sitting[] = MOVED("0 94 0") ONE "3 40 2\n";
    static const char bones[] = "HIERARCHY\nROOT a\n{\nOFFSET 0 1 0\nCHANNELS 1 Yposition\nJOINT b\n{\nOFFSET 0 9 0\n"
                                "CHANNELS 1 Yposition\n}\n}\n" ONE "90 0\n";
    static const char zero[] = "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xposition\n}\n" ONE "0\n";
    test_position("they lie round the OFFSET", around, POSITION_GUESS, false);
    test_position("they lie round zero", deltas, POSITION_GUESS, true);
    test_position("only a height", height, POSITION_GUESS, false);
    test_position("somebody sits", sitting, POSITION_GUESS, false);
    test_position("a bone whose length they do not tell", bones, POSITION_GUESS, true);
    test_position("OFFSET is zero", zero, POSITION_GUESS, false);
    test_position("forced", around, POSITION_ADD, true);
    test_position("forced", deltas, POSITION_REPLACE, false);
    char text[8192]; /* walks away along x and z, through the OFFSET and through zero */
    int n = snprintf(text, sizeof text, MOVED("0 9 20") "MOTION\nFrames: 99\nFrame Time: .01\n");
    int m = n;
    for (int i = 0; i < 99; i++)
        n += snprintf(text + n, sizeof text - (size_t)n, "%d %g %d\n", i, 9 + 0.1 * (i % 2), i - 49);
    test_position("a long walk of replacing channels", text, POSITION_GUESS, false);
    n = m;
    for (int i = 0; i < 99; i++)
        n += snprintf(text + n, sizeof text - (size_t)n, "%d %g %d\n", i, 0.1 * (i % 2), i - 29);
    test_position("a long walk of deltas", text, POSITION_GUESS, true);
}

static void test_rate(void) {
    static const char nothing[] = HEAD "MOTION\nFrames: 1\n1 2 3 4\n";
    static const char wrong[] = HEAD "MOTION\nFrames: 1\nFrame Time: nan\n1 2 3 4\n";
    OK(session_open(&session, file_of(nothing, sizeof nothing - 1), (MotionOptions){.fps = 50}) &&
       session.motion.frame_time == 0.02,
       "--fps where the file says nothing");
    session_close(&session);
    OK(session_open(&session, file_of(wrong, sizeof wrong - 1), (MotionOptions){.fps = 50}) &&
       session.motion.frame_time == 0.02 &&
           session.motion.has_frame_time && session_row(&session, 0) && session.row[3] == 4,
       "--fps where the file says nonsense");
    session_close(&session);
}

#define CASES(list) list, sizeof list / sizeof *list

int main(void) {
    if (!folder_make()) return 1;
    test_cases(CASES(counts));
    test_cases(CASES(numbers));
    test_cases(CASES(lines));
    test_cases(CASES(heads));
    test_line_ends(CASES(counts), "\r\n", "CRLF");
    test_line_ends(CASES(counts), "\r", "CR");
    test_line_ends(CASES(heads), "\r\n", "CRLF");
    test_names();
    test_positions();
    test_rate();
    folder_remove();
    return tap_done();
}
