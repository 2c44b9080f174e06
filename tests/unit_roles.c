/* Roles: which joint plays which bone in every family, files that settle it by hand, and what is no human. */
#include "folder.h"
#include "rig.h"
#include "tap.h"

/* The joints of a family, in the order of Role: pelvis spine chest neck head; clavicle, upper arm,
   forearm, hand; thigh, shin, foot, toe. A '*' stands for the side. */
typedef struct {
    const char *file, *left, *right;
    const char *torso[5], *arm[4], *leg[4];
} Family;

#define MIXAMO(name) "mixamorig:" name
static const Family families[] = {
    {"mixamo.bvh", "Left", "Right",
     {MIXAMO("Hips"), MIXAMO("Spine"), MIXAMO("Spine2"), MIXAMO("Neck"), MIXAMO("Head")},
     {MIXAMO("*Shoulder"), MIXAMO("*Arm"), MIXAMO("*ForeArm"), MIXAMO("*Hand")},
     {MIXAMO("*UpLeg"), MIXAMO("*Leg"), MIXAMO("*Foot"), MIXAMO("*ToeBase")}},
    {"lafan1.bvh", "Left", "Right", {"Hips", "Spine", "Spine2", "Neck", "Head"},
     {"*Shoulder", "*Arm", "*ForeArm", "*Hand"}, {"*UpLeg", "*Leg", "*Foot", "*Toe"}},
    {"smpl.bvh", "L", "R", {"Pelvis", "Spine1", "Spine3", "Neck", "Head"},
     {"*_Collar", "*_Shoulder", "*_Elbow", "*_Wrist"}, {"*_Hip", "*_Knee", "*_Ankle", "*_Foot"}},
    {"biped.bvh", "L", "R", {"Bip01 Pelvis", "Bip01 Spine", "Bip01 Spine2", "Bip01 Neck", "Bip01 Head"},
     {"Bip01 * Clavicle", "Bip01 * UpperArm", "Bip01 * Forearm", "Bip01 * Hand"},
     {"Bip01 * Thigh", "Bip01 * Calf", "Bip01 * Foot", "Bip01 * Toe0"}},
    {"unreal.bvh", "l", "r", {"pelvis", "spine_01", "spine_03", "neck_01", "head"},
     {"clavicle_*", "upperarm_*", "lowerarm_*", "hand_*"}, {"thigh_*", "calf_*", "foot_*", "ball_*"}},
    {"unity.bvh", "Left", "Right", {"Hips", "Spine", "UpperChest", "Neck", "Head"},
     {"*Shoulder", "*UpperArm", "*LowerArm", "*Hand"}, {"*UpperLeg", "*LowerLeg", "*Foot", "*Toes"}},
    {"rigify.bvh", "L", "R", {"DEF-spine", "DEF-spine.001", "DEF-spine.003", "DEF-spine.004", "DEF-spine.006"},
     {"DEF-shoulder.*", "DEF-upper_arm.*", "DEF-forearm.*", "DEF-hand.*"},
     {"DEF-thigh.*", "DEF-shin.*", "DEF-foot.*", "DEF-toe.*"}},
    {"xsens.bvh", "Left", "Right", {"Pelvis", "L5", "T8", "Neck", "Head"},
     {"*Shoulder", "*UpperArm", "*ForeArm", "*Hand"}, {"*UpperLeg", "*LowerLeg", "*Foot", "*Toe"}},
    {"genesis.bvh", "l", "r", {"pelvis", "abdomenLower", "chestUpper", "neckLower", "head"},
     {"*Collar", "*ShldrBend", "*ForearmBend", "*Hand"}, {"*ThighBend", "*Shin", "*Foot", "*Toe"}},
    {"opensim.bvh", "l", "r", {"pelvis", "-", "torso", "-", "-"},
     {"-", "humerus_*", "ulna_*", "hand_*"}, {"femur_*", "tibia_*", "talus_*", "toes_*"}},
    {"neuron.bvh", "Left", "Right", {"Hips", "Spine", "Spine2", "Neck", "Head"},
     {"*Shoulder", "*Arm", "*ForeArm", "*Hand"}, {"*UpLeg", "*Leg", "*Foot", "-"}},
    {"kinect.bvh", "Left", "Right", {"SpineBase", "SpineMid", "SpineShoulder", "Neck", "Head"},
     {"-", "Shoulder*", "Elbow*", "Wrist*"}, {"Hip*", "Knee*", "Ankle*", "Foot*"}},
    {"vrm.bvh", "L", "R",
     {"J_Bip_C_Hips", "J_Bip_C_Spine", "J_Bip_C_UpperChest", "J_Bip_C_Neck", "J_Bip_C_Head"},
     {"J_Bip_*_Shoulder", "J_Bip_*_UpperArm", "J_Bip_*_LowerArm", "J_Bip_*_Hand"},
     {"J_Bip_*_UpperLeg", "J_Bip_*_LowerLeg", "J_Bip_*_Foot", "J_Bip_*_ToeBase"}},
    {"optitrack.bvh", "L", "R", {"Hip", "Ab", "Chest", "Neck", "Head"},
     {"*Shoulder", "*UArm", "*FArm", "*Hand"}, {"*Thigh", "*Shin", "*Foot", "*Toe"}},
    {"cat.bvh", "L", "R", {"CATRigHub001", "CATRigSpine1", "CATRigHub002", "CATRigNeck1", "CATRigHub003"},
     {"CATRig*ArmCollarbone", "CATRig*Arm1", "CATRig*Arm2", "CATRig*ArmPalm"},
     {"CATRig*Leg1", "CATRig*Leg2", "CATRig*LegAnkle", "CATRig*LegDigit11"}},
    {"acclaim_names.bvh", "l", "r", {"root", "lowerback", "thorax", "lowerneck", "head"},
     {"*clavicle", "*humerus", "*radius", "*wrist"}, {"*femur", "*tibia", "*foot", "*toes"}},
    /* Left is 左 and right is 右. */
    {"mmd.bvh", "\xe5\xb7\xa6", "\xe5\x8f\xb3",
     {"下半身", "上半身", "上半身2", "首", "頭"},
     {"*肩", "*腕", "*ひじ", "*手首"}, {"*足", "*ひざ", "*足首", "*つま先"}},
    {"nameless_axis.bvh", "", "", {"j0", "j1", "j2", "j3", "j4"}, {NULL}, {NULL}},
    {"nameless.bvh", "", "", {"j0", "j1", "j3", "j4", "j5"}, {NULL}, {NULL}},
};

static const Family real[] = {
    {"cmu_daz_02_03_run.bvh", "l", "r", {"hip", "abdomen", "chest", "neck", "head"},
     {"*Collar", "*Shldr", "*ForeArm", "*Hand"}, {"*Thigh", "*Shin", "*Foot", "-"}},
    {"cmu_mb_12_01_walk.bvh", "Left", "Right", {"Hips", "LowerBack", "Spine1", "Neck", "Head"},
     {"*Shoulder", "*Arm", "*ForeArm", "*Hand"}, {"*UpLeg", "*Leg", "*Foot", "*ToeBase"}},
    {"cmu_mb_jumping_jacks.bvh", "Left", "Right", {"Hips", "lowerback", "Chest2", "lowerneck", "Head"},
     {"*Collar", "*Shoulder", "*Elbow", "*Wrist"}, {"*Hip", "*Knee", "*Ankle", "*Toe"}},
    {"fair1_dab.bvh", "Left", "Right", {"Hips", "Spine", "Spine3", "Neck", "Head"},
     {"*Shoulder", "*Arm", "*ForeArm", "*Hand"}, {"*UpLeg", "*Leg", "*Foot", "*ToeBase"}},
    {"rokoko_jesse_dance.bvh", "Left", "Right", {"Hips", "Spine", "Spine2", "Neck", "Head"},
     {"*Shoulder", "*Arm", "*ForeArm", "*Hand"}, {"*UpLeg", "*Leg", "*Foot", "*ToeBase"}},
    {"mixamorig_freebvh.bvh", "Left", "Right",
     {MIXAMO("Hips"), MIXAMO("Spine"), MIXAMO("Spine2"), MIXAMO("Neck"), MIXAMO("Head")},
     {MIXAMO("*Shoulder"), MIXAMO("*Arm"), MIXAMO("*ForeArm"), MIXAMO("*Hand")},
     {MIXAMO("*UpLeg"), MIXAMO("*Leg"), MIXAMO("*Foot"), MIXAMO("*ToeBase")}},
    {"mocapbank_crlf.bvh", "Left", "Right", {"Hips", "Chest", "Chest2", "Neck", "Head"},
     {"*Collar", "*Shoulder", "*Elbow", "*Wrist"}, {"*Hip", "*Knee", "*Ankle", "-"}},
    {"toolbox_walk01.bvh", "Left", "Right", {"Hips", "Spine", "Spine1", "Neck", "Head"},
     {"*Shoulder", "*Arm", "*ForeArm", "*Hand"}, {"*UpLeg", "*Leg", "*Foot", "-"}},
    {"pymo_8walk.bvh", "Left", "Right", {"Hips", "-", "Spine", "-", "Head"},
     {"*Shoulder", "*Arm", "*ForeArm", "*Hand"}, {"*UpLeg", "*Leg", "*Foot", "*ToeBase"}},
    {"pybvh_test2.bvh", "Left", "Right", {"Hips", "Chest", "Chest4", "Neck", "Head"},
     {"*Collar", "*Shoulder", "*Elbow", "*Wrist"}, {"*Hip", "*Knee", "*Ankle", "*Toe"}},
    {"pybvh_test3_fingers.bvh", "Left", "Right", {"Hips", "Spine", "Spine3", "Neck", "Head"},
     {"*Shoulder", "*Arm", "*ForeArm", "*Hand"}, {"*UpLeg", "*Leg", "*Foot", "*ForeFoot"}},
    {"dfki_custom_skeleton_walk.bvh", "L", "R",
     {"FK_back1_jnt", "FK_back2_jnt", "FK_back3_jnt", "FK_back4_jnt", "head_jnt"},
     {"*_shoulder_jnt", "*_upArm_jnt", "*_lowArm_jnt", "*_hand_jnt"},
     {"*_upLeg_jnt", "*_lowLeg_jnt", "*_foot_jnt", "*_toe_jnt"}},
    {"dfki_game_engine_walk.bvh", "Left", "Right", {"Hips", "LowerBack", "Spine1", "Neck", "Head"},
     {"*Shoulder", "*Arm", "*ForeArm", "*Hand"}, {"*UpLeg", "*Leg", "*Foot", "*ToeBase"}},
    {"makehuman_sit01.bvh", "L", "R", {"root", "spine05", "spine01", "neck01", "head"},
     {"clavicle.*", "upperarm01.*", "lowerarm01.*", "wrist.*"},
     {"upperleg01.*", "lowerleg01.*", "foot.*", "toe1-1.*"}},
    {"bandai1_bow_normal_001_NC.bvh", "L", "R", {"Hips", "Spine", "Chest", "Neck", "Head"},
     {"Shoulder_*", "UpperArm_*", "LowerArm_*", "Hand_*"}, {"UpperLeg_*", "LowerLeg_*", "Foot_*", "Toes_*"}},
    {"bandai2_walk_turn_left_normal_001_NC.bvh", "L", "R", {"Hips", "Spine", "Chest", "Neck", "Head"},
     {"Shoulder_*", "UpperArm_*", "LowerArm_*", "Hand_*"}, {"UpperLeg_*", "LowerLeg_*", "Foot_*", "Toes_*"}},
    {"cmu_02_03_run.amc", "l", "r", {"root", "lowerback", "thorax", "lowerneck", "head"},
     {"*clavicle", "*humerus", "*radius", "*hand"}, {"*femur", "*tibia", "*foot", "*toes"}},
};

/* Does `name` equal `pattern` with its '*' replaced by `side`? */
static bool matches(const char *name, const char *pattern, const char *side) {
    char wanted[128];
    const char *star = strchr(pattern, '*');
    if (!star) return strcmp(name, pattern) == 0;
    snprintf(wanted, sizeof wanted, "%.*s%s%s", (int)(star - pattern), pattern, side, star + 1);
    return strcmp(name, wanted) == 0;
}

static int check_roles(const Rig *r, const char *const *names, int n, Role first, const char *side) {
    int wrong = 0;
    for (int i = 0; i < n && names[0]; i++) {
        if (matches(rig_joint(r, first + (Role)i), names[i], side)) continue;
        printf("# %s is '%s', wanted '%s'\n", role_name(first + (Role)i), rig_joint(r, first + (Role)i), names[i]);
        wrong++;
    }
    return wrong;
}

static void test_family(const Family *f, const char *path) {
    Rig r;
    bool good = rig_roles(&r, path, NULL);
    if (!good) printf("# %s\n", r.e.text);
    int wrong = !good;
    if (good) {
        wrong += check_roles(&r, f->torso, 5, ROLE_PELVIS, "");
        wrong += check_roles(&r, f->arm, 4, ROLE_LEFT_CLAVICLE, f->left);
        wrong += check_roles(&r, f->arm, 4, ROLE_RIGHT_CLAVICLE, f->right);
        wrong += check_roles(&r, f->leg, 4, ROLE_LEFT_THIGH, f->left);
        wrong += check_roles(&r, f->leg, 4, ROLE_RIGHT_THIGH, f->right);
    }
    OK(wrong == 0, "roles of %s", f->file);
    rig_close(&r);
}

static void test_families(void) {
    for (size_t i = 0; i < sizeof families / sizeof families[0]; i++) {
        char path[256];
        snprintf(path, sizeof path, "tests/data/figure/%s", families[i].file);
        test_family(&families[i], path);
    }
    for (size_t i = 0; i < sizeof real / sizeof real[0]; i++) {
        const char *path = rig_shared(real[i].file);
        if (path) test_family(&real[i], path);
        else SKIP(real[i].file, "no shared motions");
    }
}

/* Without names the limbs are checked by their own order: joints are numbered down the limbs. */
static void test_nameless(void) {
    static const struct { const char *file; int left_arm, right_arm, left_leg, right_leg; } rigs[] = {
        {"tests/data/figure/nameless.bvh", 20, 10, 16, 6},
        {"tests/data/figure/nameless_axis.bvh", 9, 19, 5, 15},
        {"tests/data/figure/nameless_tpose.bvh", 20, 10, 16, 6},
    };
    for (int i = 0; i < 3; i++) {
        Rig r;
        int wrong = !rig_roles(&r, rigs[i].file, NULL);
        for (int k = 0; k < 4 && !wrong; k++) {
            char name[4][8];
            snprintf(name[0], sizeof name[0], "j%d", rigs[i].left_arm + k);
            snprintf(name[1], sizeof name[1], "j%d", rigs[i].right_arm + k);
            snprintf(name[2], sizeof name[2], "j%d", rigs[i].left_leg + k);
            snprintf(name[3], sizeof name[3], "j%d", rigs[i].right_leg + k);
            wrong += strcmp(rig_joint(&r, ROLE_LEFT_CLAVICLE + (Role)k), name[0]) != 0;
            wrong += strcmp(rig_joint(&r, ROLE_RIGHT_CLAVICLE + (Role)k), name[1]) != 0;
            wrong += strcmp(rig_joint(&r, ROLE_LEFT_THIGH + (Role)k), name[2]) != 0;
            wrong += strcmp(rig_joint(&r, ROLE_RIGHT_THIGH + (Role)k), name[3]) != 0;
        }
        OK(wrong == 0, "%s: limbs without names, left and right by the feet", rigs[i].file);
        OK(r.notes.count == 1, "and a note says so");
        rig_close(&r);
    }
}

static void test_refused(void) {
    static const char chain[] = "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Xrotation Yrotation Zrotation\n"
                                "JOINT b\n{\nOFFSET 0 1 0\nCHANNELS 3 Xrotation Yrotation Zrotation\n"
                                "End Site\n{\nOFFSET 0 1 0\n}\n}\n}\n"
                                "MOTION\nFrames: 1\nFrame Time: 0.1\n0 0 0 0 0 0\n";
    Rig r;
    bool good = rig_roles(&r, folder_put_text("chain.bvh", chain), NULL);
    OK(!good && r.e.kind == ERR_INPUT, "a chain is refused");
    int named = 0;
    for (int role = 0; role < ROLE_COUNT; role++) named += strstr(r.e.text, role_name((Role)role)) != NULL;
    OK(named == 10, "and the message names the ten roles that are missing");
    printf("# %s\n", r.e.text);
    rig_close(&r);
}

/* A chest with two arms, and nothing else. */
static const char *put_arms(void) {
    static const char *const sides[] = {"Left", "Right"}, *const bones[] = {"Arm", "ForeArm", "Hand"};
    static const int length[] = {18, 28, 26};
    FILE *f = fopen(in_folder("arms.bvh"), "w");
    if (!f) return "";
    fputs("HIERARCHY\nROOT Chest\n{\nOFFSET 0 0 0\nCHANNELS 0\n", f);
    for (int k = 0; k < 2; k++) {
        for (int b = 0; b < 3; b++)
            fprintf(f, "JOINT %s%s\n{\nOFFSET %d 0 0\nCHANNELS 1 Xrotation\n", sides[k], bones[b],
                    k ? -length[b] : length[b]);
        fprintf(f, "End Site\n{\nOFFSET %d 0 0\n}\n}\n}\n}\n", k ? -10 : 10);
    }
    fputs("}\nMOTION\nFrames: 1\nFrame Time: 0.1\n0 0 0 0 0 0\n", f);
    fclose(f);
    return in_folder("arms.bvh");
}

static void test_not_human(void) {
    Rig r;
    bool good = rig_roles(&r, "tests/data/figure/hand.bvh", NULL);
    OK(!good && r.e.kind == ERR_INPUT, "a hand is refused, though it has pairs of fingers");
    rig_close(&r);
    good = rig_roles(&r, "tests/data/figure/legs_only.bvh", NULL);
    OK(!good && strstr(r.e.text, "roles: chest, left_upper_arm, left_forearm, right_upper_arm, right_forearm"),
       "legs alone are refused, and only what is missing is named");
    rig_close(&r);
    good = rig_roles(&r, put_arms(), NULL);
    OK(!good && strstr(r.e.text, "roles: pelvis, left_thigh, left_shin, right_thigh, right_shin"), "nor do arms: %s",
       r.e.text);
    rig_close(&r);
    static const char *const refused[][2] = {
        {"dog", "a dog is refused, though its joints have the names of a human's"},
        {"one_arm", "who has one arm is refused: neck and head are no other"},
    };
    for (int i = 0; i < 2; i++) {
        char path[256];
        snprintf(path, sizeof path, "tests/data/figure/%s.bvh", refused[i][0]);
        good = rig_roles(&r, path, NULL);
        OK(!good && r.e.kind == ERR_INPUT && strstr(r.e.text, "missing roles: chest, left_upper_arm"), "%s",
           refused[i][1]);
        rig_close(&r);
    }
}

/* unity.bvh, with a camera as the first ROOT. */
static void write_filmed(const char *path) {
    FILE *in = fopen("tests/data/figure/unity.bvh", "r"), *out = fopen(path, "w");
    char line[4096];
    bool motion = false;
    while (fgets(line, sizeof line, in)) {
        fprintf(out, "%s%s", motion ? "2 1 " : "", line);
        if (strstr(line, "HIERARCHY"))
            fputs("ROOT Camera {\nOFFSET 0 0 0\nCHANNELS 2 Xposition Yrotation\nEnd Site { OFFSET 0 0 1 }\n}\n", out);
        motion = motion || strstr(line, "Frame Time");
    }
    fclose(in);
    fclose(out);
}

static void test_two_roots(void) {
    const char *path = in_folder("filmed.bvh");
    Rig r;
    write_filmed(path);
    OK(rig_roles(&r, path, NULL) && strcmp(rig_joint(&r, ROLE_PELVIS), "Hips") == 0 &&
           strcmp(rig_joint(&r, ROLE_LEFT_HAND), "LeftHand") == 0,
       "a performer is found beside a camera");
    rig_close(&r);
}

/* nameless.bvh of a character whose name stands in front of every joint's but the first. */
static void write_called(const char *path, const char *who) {
    FILE *in = fopen("tests/data/figure/nameless.bvh", "r"), *out = fopen(path, "w");
    char line[4096];
    while (fgets(line, sizeof line, in)) {
        const char *name = strstr(line, "JOINT ");
        if (name) fprintf(out, "JOINT %s%s", who, name + 6);
        else fputs(line, out);
    }
    fclose(in);
    fclose(out);
}

static void test_called(void) {
    static const char *const who[] = {"Left Hand:", "root_", "Heads|Wings|"};
    Rig plain, called;
    bool good = rig_roles(&plain, "tests/data/figure/nameless.bvh", NULL);
    for (int i = 0; good && i < 3; i++) {
        const char *path = in_folder("called.bvh");
        int wrong = 0;
        write_called(path, who[i]);
        good = rig_roles(&called, path, NULL);
        for (int r = 0; good && r < ROLE_COUNT; r++)
            wrong += called.roles.joint[r] != plain.roles.joint[r];
        OK(good && wrong == 0, "'%s' in front of every name tells nothing of the bones: %d others", who[i], wrong);
        rig_close(&called);
    }
    rig_close(&plain);
}

/* unity.bvh with hair instead of a head. */
static void test_headless(void) {
    const char *path = in_folder("headless.bvh");
    FILE *in = fopen("tests/data/figure/unity.bvh", "r"), *out = fopen(path, "w");
    char line[4096];
    while (fgets(line, sizeof line, in)) fputs(strstr(line, "JOINT Head") ? "JOINT Hair\n" : line, out);
    fclose(in);
    fclose(out);
    Rig r;
    OK(rig_roles(&r, path, NULL) && strcmp(rig_joint(&r, ROLE_HEAD), "Neck") == 0 && r.roles.joint[ROLE_NECK] < 0,
       "a neck with no head on it is what the head turns with");
    rig_close(&r);
}

static void test_oddities(void) {
    Rig r;
    OK(rig_roles(&r, "tests/data/figure/swapped.bvh", NULL) &&
           strcmp(rig_joint(&r, ROLE_LEFT_THIGH), "RightUpLeg") == 0 &&
           strcmp(rig_joint(&r, ROLE_RIGHT_HAND), "LeftHand") == 0 && r.notes.count == 1,
       "left and right go by feet and knees where names say the opposite, with a note");
    rig_close(&r);
    OK(rig_roles(&r, "tests/data/figure/outward.bvh", NULL) &&
           strcmp(rig_joint(&r, ROLE_LEFT_THIGH), "LeftUpLeg") == 0 && r.notes.count == 0,
       "but not by feet that point outwards and knees that bend a little backwards");
    rig_close(&r);
    OK(rig_roles(&r, "tests/data/figure/nameless_split.bvh", NULL) &&
           strcmp(rig_joint(&r, ROLE_LEFT_FOREARM), "j29") == 0 &&
           strcmp(rig_joint(&r, ROLE_LEFT_HAND), "j31") == 0 && strcmp(rig_joint(&r, ROLE_RIGHT_SHIN), "j8") == 0,
       "split bones without names");
    rig_close(&r);
    OK(rig_roles(&r, "tests/data/figure/low_ribs.bvh", NULL) && strcmp(rig_joint(&r, ROLE_LEFT_FOREARM), "j13") == 0 &&
           strcmp(rig_joint(&r, ROLE_RIGHT_FOREARM), "j7") == 0,
       "an upper arm is not made longer to bring a far shoulder nearer");
    rig_close(&r);
    OK(rig_roles(&r, "tests/data/figure/chest_root.bvh", NULL) && strcmp(rig_joint(&r, ROLE_PELVIS), "Hips") == 0 &&
           strcmp(rig_joint(&r, ROLE_HEAD), "Head") == 0,
       "a tree that hangs from the chest");
    rig_close(&r);
    OK(rig_roles(&r, "tests/data/figure/torso_root.bvh", NULL) && strcmp(rig_joint(&r, ROLE_PELVIS), "Torso") == 0 &&
           strcmp(rig_joint(&r, ROLE_CHEST), "Torso") == 0,
       "a trunk of one bone, from which all limbs hang");
    OK(strcmp(rig_joint(&r, ROLE_HEAD), "x2") == 0, "a head without a name ends where eyes grow from it");
    rig_close(&r);
    OK(rig_roles(&r, "tests/data/figure/costume.bvh", NULL) &&
           strcmp(rig_joint(&r, ROLE_LEFT_UPPER_ARM), "BrazoIzq") == 0 &&
           strcmp(rig_joint(&r, ROLE_RIGHT_THIGH), "MusloDer") == 0,
       "wings and coat tails with sides are no limbs, beside limbs with names in Spanish");
    OK(strcmp(rig_joint(&r, ROLE_HEAD), "Head") == 0 && strcmp(rig_joint(&r, ROLE_LEFT_TOE), "L_Toe") == 0,
       "nodes in front of bones are passed over");
    rig_close(&r);
}

/* A heel between ankle and toes, as pose estimators see it, is no toe. */
static void test_heel(void) {
    const char *path = in_folder("heel.bvh");
    FILE *in = fopen("tests/data/figure/mixamo.bvh", "r"), *out = fopen(path, "w");
    char line[4096];
    int depth = 0, heel = -1; /* braces open; as many where the heel is */
    while (fgets(line, sizeof line, in)) {
        bool is_toe = strstr(line, "ToeBase") != NULL;
        if (is_toe) {
            const char *side = strstr(line, "Left") ? "Left" : "Right";
            fprintf(out, "JOINT %sHeel\n{\nOFFSET 0 -5 -5\nCHANNELS 0\nJOINT %sFootIndex\n", side, side);
            heel = depth;
        } else fputs(line, out);
        depth += (strchr(line, '{') != NULL) - (strchr(line, '}') != NULL);
        if (heel == depth && !is_toe) fputs("}\n", out), heel = -1;
    }
    fclose(in);
    fclose(out);
    Rig r;
    OK(rig_roles(&r, path, NULL) && strcmp(rig_joint(&r, ROLE_LEFT_TOE), "LeftFootIndex") == 0 &&
           strcmp(rig_joint(&r, ROLE_RIGHT_TOE), "RightFootIndex") == 0, "a heel is no toe");
    rig_close(&r);
}

/* A role file against the biped. */
static void test_file(const char *text, const char *wanted, int line, int column) {
    Rig r;
    const char *path = folder_put_text("roles", text);
    bool good = rig_roles(&r, "tests/data/figure/biped.bvh", path);
    if (!wanted) {
        OK(good, "accepted: %.30s", text);
        if (!good) printf("# %s\n", r.e.text);
    } else {
        OK(!good && r.e.kind == ERR_INPUT && strstr(r.e.text, wanted) && r.e.line == line && r.e.column == column,
           "refused: %s", wanted);
        if (!good) printf("# %s at %d:%d\n", r.e.text, r.e.line, r.e.column);
    }
    rig_close(&r);
}

/* Half the letters wrong are no slip of the finger. */
static void test_far_off(void) {
    Rig r;
    const char *path = folder_put_text("roles", "tail = Bip01 Head\n");
    OK(!rig_roles(&r, "tests/data/figure/biped.bvh", path) && !strstr(r.e.text, "did you mean"),
       "what is near to nothing is not guessed");
    rig_close(&r);
}

/* Whose left is told by hand needs no warning that it was a guess. */
static void test_told_sides(void) {
    const char *nameless = "tests/data/figure/nameless.bvh";
    Rig r;
    char text[200];
    OK(rig_roles(&r, nameless, NULL) && r.notes.count == 1, "nameless limbs: a note that left was guessed");
    snprintf(text, sizeof text, "left_thigh = %s\nright_thigh = %s\n", rig_joint(&r, ROLE_LEFT_THIGH),
             rig_joint(&r, ROLE_RIGHT_THIGH));
    rig_close(&r);
    OK(rig_roles(&r, nameless, folder_put_text("roles", text)) && r.notes.count == 0,
       "no note where the role file tells");
    rig_close(&r);
}

static void test_role_files(void) {
    Rig r;
    const char *path = folder_put_text("roles", "# by hand\nchest = Bip01 Spine1   # names with blanks\nneck=none\n\n"
                                                "  left_toe   =   none\n");
    OK(rig_roles(&r, "tests/data/figure/biped.bvh", path), "a role file is read");
    OK(strcmp(rig_joint(&r, ROLE_CHEST), "Bip01 Spine1") == 0, "it settles the chest");
    OK(r.roles.joint[ROLE_NECK] < 0 && r.roles.joint[ROLE_LEFT_TOE] < 0, "'none' removes a role");
    OK(strcmp(rig_joint(&r, ROLE_LEFT_THIGH), "Bip01 L Thigh") == 0, "what it does not name is found as before");
    rig_close(&r);

    OK(rig_roles(&r, "tests/data/figure/biped.bvh", folder_put_text("roles", "left_foot = Bip01 L Toe0\n")) &&
           r.roles.joint[ROLE_LEFT_TOE] < 0 && r.notes.count == 1 && strstr(r.notes.note[0].text, "no longer left_toe"),
       "a joint that another role had is taken from it, and that is told");
    rig_close(&r);
    OK(rig_roles(&r, "tests/data/figure/torso_root.bvh", folder_put_text("roles", "pelvis = Torso\n")) &&
           strcmp(rig_joint(&r, ROLE_CHEST), "Torso") == 0 && r.notes.count == 0,
       "what a role has anyway takes nothing away");
    rig_close(&r);

    test_file("", NULL, 0, 0);
    test_file("spine = Bip01 Spine1\n", NULL, 0, 0);
    test_file("head = Bip01 Hed\n", "did you mean 'Bip01 Head'?", 1, 8);
    test_file("\nleft_tigh = Bip01 L Thigh\n", "did you mean 'left_thigh'?", 2, 1);
    test_file("zzzzzzzzzzzzzz = Bip01 L Thigh\n", "unknown role", 1, 1);
    test_far_off();
    test_told_sides();
    test_file("head = Bip01 Head\nhead = Bip01 Head\n", "given twice", 2, 1);
    test_file("head Bip01 Head\n", "expected 'role = joint'", 1, 1);
    test_file("head =\n", "no joint for role", 1, 7);
    test_file("chest = Bip01 Head\nhead = Bip01 Head\n", "plays two roles", 2, 8);
    test_file("left_shin = none\n", "missing roles: left_shin", 0, 0);
}

static void mirrors_are_their_own_mirror(void) {
    int wrong = 0, alone = 0;
    for (Role r = 0; r < ROLE_COUNT; r++) {
        Role other = role_mirror(r);
        bool named = strncmp(role_name(r), "left_", 5) != 0 || strcmp(role_name(r) + 5, role_name(other) + 6) == 0;
        wrong += role_mirror(other) != r || !named;
        alone += other == r;
    }
    OK(wrong == 0 && alone == ROLE_HEAD + 1, "the mirror of a mirror is the role itself, and only the trunk has none");
}

int main(void) {
    if (!folder_make()) return 1;
    test_families();
    test_nameless();
    test_refused();
    test_not_human();
    test_oddities();
    test_heel();
    test_two_roots();
    test_called();
    test_headless();
    test_role_files();
    mirrors_are_their_own_mirror();
    folder_remove();
    return tap_done();
}
