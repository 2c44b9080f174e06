/* The canonical human: what it is by definition, that every family gives the same one, and what
   it does in real motions. */
#include "folder.h"
#include "tap.h"
#include "turns.h"

/* --- by definition --- */

static void check_stance(const Figure *f, const char *what) {
    static const int pairs[][2] = {
        {ROLE_LEFT_CLAVICLE, ROLE_RIGHT_CLAVICLE}, {ROLE_LEFT_UPPER_ARM, ROLE_RIGHT_UPPER_ARM},
        {ROLE_LEFT_FOREARM, ROLE_RIGHT_FOREARM}, {ROLE_LEFT_HAND, ROLE_RIGHT_HAND},
        {ROLE_LEFT_THIGH, ROLE_RIGHT_THIGH}, {ROLE_LEFT_SHIN, ROLE_RIGHT_SHIN},
        {ROLE_LEFT_FOOT, ROLE_RIGHT_FOOT}, {ROLE_LEFT_TOE, ROLE_RIGHT_TOE},
    };
    int mirrored = 0, joined = 0;
    for (int i = 0; i < 8; i++) {
        Vec3 l = f->start[pairs[i][0]], r = f->start[pairs[i][1]];
        mirrored += l.x > 0 && vec_dist(l, vec(-r.x, r.y, r.z)) < 1e-12;
        l = f->end[pairs[i][0]], r = f->end[pairs[i][1]];
        mirrored += l.x > 0 && vec_dist(l, vec(-r.x, r.y, r.z)) < 1e-12;
    }
    OK(mirrored == 16, "%s: left is +x, right mirrors it", what);
    static const int chains[][2] = {
        {ROLE_PELVIS, ROLE_SPINE}, {ROLE_SPINE, ROLE_CHEST}, {ROLE_CHEST, ROLE_NECK}, {ROLE_NECK, ROLE_HEAD},
        {ROLE_LEFT_CLAVICLE, ROLE_LEFT_UPPER_ARM}, {ROLE_LEFT_UPPER_ARM, ROLE_LEFT_FOREARM},
        {ROLE_LEFT_FOREARM, ROLE_LEFT_HAND}, {ROLE_LEFT_THIGH, ROLE_LEFT_SHIN}, {ROLE_LEFT_SHIN, ROLE_LEFT_FOOT},
        {ROLE_LEFT_FOOT, ROLE_LEFT_TOE},
    };
    for (int i = 0; i < 10; i++) joined += vec_dist(f->end[chains[i][0]], f->start[chains[i][1]]) < 1e-12;
    OK(joined == 10, "%s: bones follow each other", what);
    NEAR(f->end[ROLE_HEAD].y, f->height, 1e-12, "the head ends at the stature");
    OK(f->end[ROLE_LEFT_FOOT].z > f->start[ROLE_LEFT_FOOT].z, "%s: feet point to +z", what);
    Vec3 arm = vec_sub(f->end[ROLE_LEFT_HAND], f->start[ROLE_LEFT_UPPER_ARM]);
    OK(angle(arm, vec(1, -1, 0)) < 1e-4, "%s: arms 45 degrees down", what);
    OK(f->start[ROLE_LEFT_THIGH].z == 0 && f->end[ROLE_LEFT_SHIN].x == f->start[ROLE_LEFT_THIGH].x,
       "%s: legs straight down from z = 0", what);
}

static void test_reference(void) {
    Figure f = figure_reference();
    check_stance(&f, "reference");
    NEAR(f.height, 1.70, 1e-12, "the reference is 1.70 m tall");
    NEAR(f.start[ROLE_LEFT_THIGH].y, 0.885, 1e-12, "its hips stand at 0.885 m");
    Pose rest = figure_rest_pose();
    int same = 0;
    for (int r = 0; r < ROLE_COUNT; r++) same += vec_dist(rigid_apply(rest.bone[r], f.start[r]), f.start[r]) == 0;
    OK(same == ROLE_COUNT, "in the rest pose every bone is where it stands");
    NEAR(figure_step(&f, &rest, &rest), 0, 0, "no move, no step");
    Pose moved = rest;
    for (int r = 0; r < ROLE_COUNT; r++) moved.bone[r].t = vec(0, 0, 0.34);
    NEAR(figure_step(&f, &rest, &moved), 0.2, 1e-12, "0.34 m are a step of a fifth of the height");
}

/* --- every family the same human --- */

static const char *const families[] = {
    "smpl", "unity", "vrm", "xsens", "rigify", "genesis", "neuron", "acclaim_names", "optitrack", "kinect", "mmd",
    "opensim", "nameless", "lafan1", "unreal", "biped", "cat", "nameless_axis",
    "swapped", "weapon", "zero_offsets", "chest_root", "nameless_split", "astride", "captured",
};

/* The largest angle between a bone of two poses, over the frames. Only limb bones have a direction
   that no binding can change. */
static double limb_difference(Rig *a, Rig *b) {
    static const int limbs[] = {ROLE_LEFT_UPPER_ARM, ROLE_LEFT_FOREARM, ROLE_RIGHT_UPPER_ARM, ROLE_RIGHT_FOREARM,
                                ROLE_LEFT_THIGH, ROLE_LEFT_SHIN, ROLE_RIGHT_THIGH, ROLE_RIGHT_SHIN};
    double most = 0;
    for (int frame = 0; frame < a->motion.nframes; frame++) {
        Pose p = rig_pose(a, frame), q = rig_pose(b, frame);
        for (int i = 0; i < 8; i++) {
            Vec3 u = mat_apply(p.bone[limbs[i]].r, vec_sub(a->figure.end[limbs[i]], a->figure.start[limbs[i]]));
            Vec3 v = mat_apply(q.bone[limbs[i]].r, vec_sub(b->figure.end[limbs[i]], b->figure.start[limbs[i]]));
            most = max_of(most, angle(u, v));
        }
    }
    return most;
}

/* The motion's hips go ahead 0.16 m a frame at 20 degrees from z towards x. */
static void check_travel(Rig *r, const char *name) {
    Vec3 first = rigid_apply(rig_pose(r, 0).bone[ROLE_PELVIS], r->figure.start[ROLE_PELVIS]);
    Vec3 last = rigid_apply(rig_pose(r, 7).bone[ROLE_PELVIS], r->figure.start[ROLE_PELVIS]);
    Vec3 way = vec_scale(vec_sub(last, first), 1 / r->figure.height);
    double expected = 7 * 0.16 / 1.757;
    OK(angle(vec(way.x, 0, way.z), vec(sin(20 * DEGREE), 0, cos(20 * DEGREE))) < 3, "%s: walks where it walks", name);
    NEAR(vec_len(way), expected, 0.03 * expected, "as far, in heights");
}

static void test_families(void) {
    Rig one;
    if (!OK(rig_open(&one, "tests/data/figure/mixamo.bvh", NULL), "mixamo opens")) return;
    check_stance(&one.figure, "mixamo");
    check_travel(&one, "mixamo");
    for (size_t i = 0; i < sizeof families / sizeof families[0]; i++) {
        char path[256];
        Rig r;
        snprintf(path, sizeof path, "tests/data/figure/%s.bvh", families[i]);
        bool good = rig_open(&r, path, NULL);
        OK(good, "%s opens", families[i]);
        if (!good) { printf("# %s\n", r.e.text); rig_close(&r); continue; }
        bool axis = strcmp(r.figure.rest, "upright frames") == 0; /* torso and feet are estimates */
        double limbs = limb_difference(&one, &r), pelvis = turn_difference(&one, &r, ROLE_PELVIS);
        double chest = turn_difference(&one, &r, ROLE_CHEST), head = turn_difference(&one, &r, ROLE_HEAD);
        double foot = turn_difference(&one, &r, ROLE_LEFT_FOOT);
        bool headless = r.roles.joint[ROLE_HEAD] < 0, one_spine = r.roles.joint[ROLE_SPINE] < 0;
        printf("# %s: limbs %.2f pelvis %.2f chest %.2f head %.2f foot %.2f degrees\n", families[i], limbs, pelvis,
               chest, head, foot);
        OK(limbs < (one_spine ? 3 : 1.5), "%s: limbs point the same way", families[i]);
        OK(pelvis < (axis ? 7 : 0.1), "%s: the pelvis turns the same way", families[i]);
        OK(chest < (axis ? 7 : one_spine ? 3 : 0.1), "%s: and the chest", families[i]);
        OK(headless || head < (axis ? 9 : 0.1), "%s: and the head", families[i]);
        OK(foot < (axis ? 9 : 3), "%s: and the feet", families[i]);
        NEAR(r.figure.height / one.figure.height, 1, strcmp(families[i], "mmd") == 0 ? 0.04 : 0.015, families[i]);
        check_travel(&r, families[i]);
        rig_close(&r);
    }
    rig_close(&one);
}

/* --- size --- */

/* Writes mixamo.bvh with every length multiplied: OFFSETs and the three position channels. */
static void write_scaled(const char *path, double factor) {
    FILE *in = fopen("tests/data/figure/mixamo.bvh", "r"), *out = fopen(path, "w");
    char line[4096];
    bool motion = false;
    while (fgets(line, sizeof line, in)) {
        double x, y, z;
        int used = 0;
        const char *offset = strstr(line, "OFFSET");
        if (offset && sscanf(offset, "OFFSET %lf %lf %lf", &x, &y, &z) == 3)
            fprintf(out, "OFFSET %.9g %.9g %.9g\n", x * factor, y * factor, z * factor);
        else if (motion && sscanf(line, "%lf %lf %lf %n", &x, &y, &z, &used) == 3)
            fprintf(out, "%.9g %.9g %.9g %s", x * factor, y * factor, z * factor, line + used);
        else
            fputs(line, out);
        if (strstr(line, "Frame Time")) motion = true;
    }
    fclose(in);
    fclose(out);
}

static void test_units(void) {
    /* mixamo.bvh is 175.7 cm tall. */
    static const struct { double factor; const char *unit; double stature; } cases[] = {
        {1, "cm", 1.757}, {0.01, "m", 1.757}, {10, "mm", 1.757}, {0.1, "dm", 1.757}, {1 / 2.54, "inch", 1.757},
        {1 / 30.48, "foot", 1.757}, {0.45 / 2.54, "5.644 cm", 1.757},
        {0.6, "cm", 1.054}, {0.006, "m", 1.054}, /* a child */
        {0.82, "cm", 1.441}, {1.19, "cm", 2.091}, /* the smallest and the tallest adult */
        {0.3, "unknown", 1.703}, {0.003, "unknown", 1.703}, {1e-4, "unknown", 1.703}, {1e5, "unknown", 1.703},
        {1.3, "cm", 2.284}, {3, "mm", 0.527}, /* a giant, a baby */
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const char *path = in_folder("scaled.bvh");
        Rig r;
        write_scaled(path, cases[i].factor);
        OK(rig_open(&r, path, NULL), "a skeleton %g times as large", cases[i].factor);
        OK(strcmp(r.figure.unit_name, cases[i].unit) == 0, "has unit %s", r.figure.unit_name);
        NEAR(r.figure.height, cases[i].stature, 0.01, "and stature");
        rig_close(&r);
    }
}

static void test_options(void) {
    Rig r;
    FigureOptions options = {.unit = 0.02};
    OK(rig_open(&r, "tests/data/figure/mixamo.bvh", &options), "a unit can be given");
    NEAR(r.figure.height, 2 * 1.757, 0.02, "twice the unit, twice the height");
    rig_close(&r);
    options = (FigureOptions){.scale = 0.5};
    OK(rig_open(&r, "tests/data/figure/mixamo.bvh", &options), "and a scale");
    NEAR(r.figure.height, 0.5 * 1.757, 0.01, "half the scale, half the height");
    rig_close(&r);
    options = (FigureOptions){.up = 'z'};
    OK(rig_open(&r, "tests/data/figure/mixamo.bvh", &options), "and the up axis");
    NEAR(mat_column(rig_pose(&r, 0).bone[ROLE_PELVIS].r, 1).z, -1, 0.05, "y of the file is then world -z");
    rig_close(&r);
    options = (FigureOptions){.up = 'q'};
    OK(!rig_open(&r, "tests/data/figure/mixamo.bvh", &options) && r.e.kind == ERR_USAGE, "but no axis 'q'");
    rig_close(&r);
}

/* The six up axes are turns: right-handed, and the axis goes up. */
static void test_upright(void) {
    static const Vec3 up[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    for (int i = 0; i < 6; i++) {
        Rig r;
        FigureOptions options = {.up = "xyzXYZ"[i]};
        bool good = rig_open(&r, "tests/data/figure/mixamo.bvh", &options);
        OK(good && is_rotation(r.figure.upright) && vec_dist(mat_apply(r.figure.upright, up[i]), vec(0, 1, 0)) < 1e-12,
           "up axis %c is turned up", options.up);
        rig_close(&r);
    }
}

/* A thigh that is lifted towards the chest, a little to the side, while the knee is stretched and while it is bent. */
static void test_lifted_thigh(void) {
    static const double flexion[] = {0, 45, 90, 120, 150}, knee[] = {5, 60, 120};
    Rig r;
    if (!OK(rig_open(&r, "tests/data/figure/mixamo.bvh", NULL) && motion_row(r.reader, 0, r.row, &r.e), "mixamo opens"))
        return;
    const Joint *joint = r.motion.skeleton.joint;
    int thigh = joint[r.roles.joint[ROLE_LEFT_THIGH]].first_channel;
    int shin = joint[r.roles.joint[ROLE_LEFT_SHIN]].first_channel;
    double most = 0;
    for (int i = 0; i < 5; i++)
        for (int k = 0; k < 3; k++) {
            Pose pose;
            double turns[] = {15, 0, -flexion[i]}, bend[] = {0, 0, knee[k]}; /* about z, y, x */
            for (int c = 0; c < 3; c++) r.row[thigh + c] = turns[c], r.row[shin + c] = bend[c];
            skeleton_pose(&r.motion.skeleton, r.row, r.world);
            figure_pose(&r.figure, r.world, &pose);
            Vec3 side = mat_column(pose.bone[ROLE_LEFT_THIGH].r, 0), hips = mat_column(pose.bone[ROLE_PELVIS].r, 0);
            most = max_of(most, angle(side, hips));
        }
    OK(most < 20, "a lifted thigh keeps its side where the hips have theirs, within %.0f degrees", most);
    rig_close(&r);
}

/* --- real motions --- */

enum { WALKS = 1, STANDS = 2 }; /* goes ahead; head over pelvis and pelvis upright all the time */

static const struct { const char *file, *unit; char up; double stature; int habits; } real[] = {
    {"cmu_daz_02_03_run.bvh", "cm", 'y', 1.66, WALKS | STANDS},
    {"cmu_daz_02_04_jump_balance.bvh", "cm", 'y', 1.66, STANDS},
    {"cmu_daz_03_01_uneven_terrain.bvh", "cm", 'y', 1.66, WALKS | STANDS},
    {"cmu_daz_05_06_cartwheel_pirouette.bvh", "cm", 'y', 1.66, 0},
    {"cmu_daz_07_12_brisk_walk.bvh", "cm", 'y', 1.66, STANDS},
    {"cmu_daz_13_35_climb_steps.bvh", "cm", 'y', 1.66, STANDS},
    {"cmu_daz_114_16_sit_stretch.bvh", "cm", 'y', 1.66, 0},
    {"cmu_mb_12_01_walk.bvh", "5.644 cm", 'y', 1.44, WALKS | STANDS}, /* the file lacks a thorax of 11 cm */
    {"cmu_mb_jumping_jacks.bvh", "5.644 cm", 'y', 1.59, STANDS},
    {"fair1_dab.bvh", "unknown", 'z', 1.68, STANDS},
    {"rokoko_jesse_dance.bvh", "cm", 'y', 1.81, STANDS},
    {"mixamorig_freebvh.bvh", "cm", 'y', 1.77, STANDS},
    {"mocapbank_crlf.bvh", "cm", 'y', 1.67, 0},
    {"toolbox_walk01.bvh", "cm", 'y', 1.85, WALKS | STANDS},
    {"pymo_8walk.bvh", "inch", 'y', 1.66, STANDS},
    {"pybvh_test2.bvh", "cm", 'y', 1.82, STANDS},
    {"pybvh_test3_fingers.bvh", "inch", 'z', 1.69, STANDS},
    {"dfki_custom_skeleton_walk.bvh", "cm", 'y', 1.85, WALKS | STANDS},
    {"dfki_game_engine_walk.bvh", "cm", 'y', 1.59, WALKS | STANDS},
    {"makehuman_sit01.bvh", "dm", 'z', 1.65, 0},
    {"bandai1_kick_normal_001_NC.bvh", "cm", 'y', 1.58, STANDS},
    {"bandai1_bow_normal_001_NC.bvh", "cm", 'y', 1.59, STANDS},
    {"bandai2_walk_turn_left_normal_001_NC.bvh", "cm", 'y', 1.58, WALKS | STANDS},
    {"cmu_02_03_run.amc", "5.644 cm", 'y', 1.71, WALKS | STANDS},
    {"cmu_11_01_kick.amc", "5.644 cm", 'y', 1.78, WALKS | STANDS},
};

/* By how much a knee that is bent by 90 degrees or more does not lie behind its thigh, degrees. */
static double knee_off(const Pose *pose) {
    double most = 0;
    for (int side = 0; side < 2; side++) {
        Role thigh = side ? ROLE_RIGHT_THIGH : ROLE_LEFT_THIGH;
        Vec3 shin = mat_apply(mat_transpose(pose->bone[thigh].r), mat_column(pose->bone[thigh + 1].r, 1));
        if (angle(shin, vec(0, 1, 0)) >= 90) most = max_of(most, fabs(atan2(shin.x, shin.z)) / DEGREE);
    }
    return most;
}

typedef struct {
    double landing, head_below, tilt, shin_behind, shin_aside, knee_off;
    int frames, rotations;
    Vec3 ahead; /* sum of where the pelvis faces */
    Vec3 first, last;
} Measures;

static void measure_frame(Rig *r, Pose pose, Measures *m) {
    static const int landing[] = {ROLE_LEFT_FOREARM, ROLE_RIGHT_FOREARM, ROLE_LEFT_HAND, ROLE_RIGHT_HAND,
                                  ROLE_LEFT_THIGH, ROLE_RIGHT_THIGH, ROLE_LEFT_SHIN, ROLE_RIGHT_SHIN,
                                  ROLE_LEFT_FOOT, ROLE_RIGHT_FOOT, ROLE_LEFT_UPPER_ARM, ROLE_RIGHT_UPPER_ARM};
    for (int i = 0; i < 12; i++) {
        if (r->roles.joint[landing[i]] < 0) continue;
        Vec3 at = rigid_apply(pose.bone[landing[i]], r->figure.start[landing[i]]);
        m->landing = max_of(m->landing, vec_dist(at, rig_place(r, (Role)landing[i])));
    }
    for (int k = 0; k < ROLE_COUNT; k++) m->rotations += is_rotation(pose.bone[k].r);
    Vec3 pelvis = rigid_apply(pose.bone[ROLE_PELVIS], r->figure.start[ROLE_PELVIS]);
    Vec3 head = rigid_apply(pose.bone[ROLE_HEAD], r->figure.start[ROLE_HEAD]);
    m->head_below += head.y < pelvis.y;
    m->tilt += angle(mat_column(pose.bone[ROLE_PELVIS].r, 1), vec(0, 1, 0));
    for (int side = 0; side < 2; side++) {
        Role thigh = side ? ROLE_RIGHT_THIGH : ROLE_LEFT_THIGH;
        Vec3 shin = mat_apply(mat_transpose(pose.bone[thigh].r), mat_column(pose.bone[thigh + 1].r, 1));
        m->shin_behind += shin.z; /* up of a bent shin leans forward in the thigh's frame */
        m->shin_aside += fabs(shin.x);
    }
    m->knee_off = max_of(m->knee_off, knee_off(&pose));
    if (m->frames++ == 0) m->first = pelvis;
    m->last = pelvis;
    m->ahead = vec_add(m->ahead, mat_column(pose.bone[ROLE_PELVIS].r, 2));
}

static void test_real(int i) {
    const char *path = rig_shared(real[i].file), *file = real[i].file;
    Rig r;
    Measures m = {0};
    if (!path) { SKIP(file, "no shared motions"); return; }
    if (!OK(rig_open(&r, path, NULL), "%s gives a figure", file)) { rig_close(&r); return; }
    OK(strcmp(r.figure.unit_name, real[i].unit) == 0 && r.figure.up == real[i].up, "%s: unit %s, %c up", file,
       r.figure.unit_name, r.figure.up);
    NEAR(r.figure.height, real[i].stature, 0.015, "stature");
    for (int frame = r.motion.nframes > 8 ? 2 : 0; frame < r.motion.nframes; frame++)
        measure_frame(&r, rig_pose(&r, frame), &m);
    int n = m.frames;
    OK(m.rotations == n * ROLE_COUNT, "%s: every bone moves rigidly", file);
    OK(m.landing < 0.02, "%s: limbs begin at their joints (within %.4f m)", file, m.landing);
    OK(m.shin_behind > 0, "%s: knees bend backwards (%.2f)", file, m.shin_behind / n / 2);
    OK(m.knee_off < 1, "%s: and behind the thigh when they are bent (%.2f degrees off)", file, m.knee_off);
    if (real[i].habits & STANDS) {
        OK(m.head_below == 0, "%s: the head stays over the pelvis", file);
        OK(m.tilt / n < 19, "%s: the pelvis is upright, mean tilt %.1f degrees", file, m.tilt / n);
    }
    if (real[i].habits & WALKS) {
        Vec3 way = vec_sub(m.last, m.first);
        double off = angle(vec(way.x, 0, way.z), vec(m.ahead.x, 0, m.ahead.z));
        OK(off < 25, "%s: goes where it faces, %.0f degrees off", file, off);
        OK(m.tilt / n < 15, "%s: upright in the walk", file);
        OK(m.shin_aside < 0.5 * m.shin_behind, "%s: the knee is a hinge across the way", file);
    }
    rig_close(&r);
}

/* All takes of one skeleton give one figure. */
static void test_same_skeleton(void) {
    Rig a, b;
    const char *path = rig_shared("cmu_daz_02_03_run.bvh");
    if (!path) { SKIP("one skeleton, one figure", "no shared motions"); return; }
    bool good = rig_open(&a, path, NULL);
    good = rig_open(&b, rig_shared("cmu_daz_114_16_sit_stretch.bvh"), NULL) && good;
    double most = 0;
    for (int r = 0; good && r < ROLE_COUNT; r++) most = max_of(most, vec_dist(a.figure.start[r], b.figure.start[r]));
    OK(good && most < 1e-4, "one skeleton, one figure: run and floor sit within %.6f m", most);
    rig_close(&a);
    rig_close(&b);
}

/* --- nonsense --- */

static void test_no_size(void) {
    /* A human by names, all joints in one point. */
    static const char *const leg[] = {"UpLeg", "Leg", "Foot"}, *const arm[] = {"Arm", "ForeArm", "Hand"};
    const char *path = in_folder("point.bvh");
    FILE *f = fopen(path, "w");
    fprintf(f, "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n");
    int joints = 2;
    for (int limb = 0; limb < 4; limb++) {
        if (limb == 2) fprintf(f, "JOINT Spine\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n");
        for (int i = 0; i < 3; i++, joints++)
            fprintf(f, "JOINT %s%s\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n", limb & 1 ? "Right" : "Left",
                    limb < 2 ? leg[i] : arm[i]);
        fprintf(f, "End Site\n{\nOFFSET 0 0 0\n}\n}\n}\n}\n");
    }
    fprintf(f, "}\n}\nMOTION\nFrames: 1\nFrame Time: 0.1\n");
    for (int i = 0; i < joints; i++) fprintf(f, "0 ");
    fprintf(f, "\n");
    fclose(f);
    Rig r;
    OK(!rig_open(&r, path, NULL) && r.e.kind == ERR_INPUT, "a skeleton in one point is refused");
    printf("# %s\n", r.e.text);
    rig_close(&r);
}

int main(void) {
    if (!folder_make()) return 1;
    test_reference();
    test_families();
    test_units();
    test_options();
    test_upright();
    test_lifted_thigh();
    for (int i = 0; i < (int)(sizeof real / sizeof real[0]); i++) test_real(i);
    test_same_skeleton();
    test_no_size();
    folder_remove();
    return tap_done();
}
