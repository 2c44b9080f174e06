/* The human in trees of odd shapes, made here: limbs that are there twice, a tree that hangs from the head, one that is
   flat. */
#include "figure/human.h"
#include "folder.h"
#include "rig.h"
#include "tap.h"

/* A limb of three bones whose names stand between `before` and `after`. It begins `aside` of its parent; each bone goes
   x, y on, and turns by so many channels. tip: what is below the last. */
static void put_limb_with(FILE *f, const char *const bones[3], const char *before, const char *after, double aside,
                          double x, double y, int channels, const char *tip) {
    for (int b = 0; b < 3; b++)
        fprintf(f, "JOINT %s%s%s {\nOFFSET %g %g 0\nCHANNELS %d %s\n", before, bones[b], after, b ? x : aside,
                b ? y : 0, channels, channels ? "Zrotation" : "");
    fprintf(f, "%s\n}\n}\n}\n", tip);
}

static void put_limb(FILE *f, const char *const bones[3], const char *before, const char *after, double aside, double x,
                     double y, int channels) {
    put_limb_with(f, bones, before, after, aside, x, y, channels, "End Site { OFFSET 0 0 9 }");
}

/* A human whose limbs are there twice: with bones that keep still, for the animator, before those that move. */
static const char *put_twins(void) {
    static const char *const leg[] = {"thigh", "shin", "foot"}, *const arm[] = {"upper_arm", "forearm", "hand"};
    FILE *f = fopen(in_folder("twins.bvh"), "w");
    if (!f) return "";
    fputs("HIERARCHY\nROOT hips {\nOFFSET 0 0 0\nCHANNELS 0\n", f);
    for (int k = 0; k < 4; k++)
        put_limb(f, leg, k % 2 ? "DEF-" : "", k < 2 ? ".L" : ".R", k < 2 ? 9 : -9, 0, -40, k % 2);
    fputs("JOINT chest {\nOFFSET 0 40 0\nCHANNELS 0\n", f);
    for (int k = 0; k < 4; k++)
        put_limb(f, arm, k % 2 ? "DEF-" : "", k < 2 ? ".L" : ".R", k < 2 ? 17 : -17, k < 2 ? 27 : -27, 0, k % 2);
    fputs("JOINT head {\nOFFSET 0 20 0\nCHANNELS 0\nEnd Site { OFFSET 0 20 0 }\n}\n}\n}\n", f);
    fputs("MOTION\nFrames: 2\nFrame Time: 0.1\n0 0 0 0 0 0 0 0 0 0 0 0\n9 9 9 9 9 9 9 9 9 9 9 9\n", f);
    fclose(f);
    return in_folder("twins.bvh");
}

/* A tree that hangs from the head, by way of the chest. */
static const char *put_hanging(void) {
    static const char *const leg[] = {"Thigh", "Shin", "Foot"}, *const arm[] = {"UpperArm", "Forearm", "Hand"};
    FILE *f = fopen(in_folder("hanging.bvh"), "w");
    if (!f) return "";
    fputs("HIERARCHY\nROOT Head {\nOFFSET 0 0 0\nCHANNELS 0\nJOINT Chest {\nOFFSET 0 -20 0\nCHANNELS 0\n", f);
    for (int k = 0; k < 2; k++) put_limb(f, arm, k ? "Right" : "Left", "", k ? -17 : 17, k ? -27 : 27, 0, 1);
    fputs("JOINT Hips {\nOFFSET 0 -40 0\nCHANNELS 0\n", f);
    for (int k = 0; k < 2; k++) put_limb(f, leg, k ? "Right" : "Left", "", k ? -9 : 9, 0, -40, 1);
    fputs("}\n}\n}\nMOTION\nFrames: 1\nFrame Time: 0.1\n0 0 0 0 0 0 0 0 0 0 0 0\n", f);
    fclose(f);
    return in_folder("hanging.bvh");
}

/* A human whose names tell sides by `a` and `b`. head: the joints above the chest. held: what is below the second
   hand. */
static const char *put_sides(const char *a, const char *b, const char *head, const char *held) {
    static const char *const leg[] = {"hip_", "knee_", "ankle_"}, *const arm[] = {"shoulder_", "elbow_", "wrist_"};
    FILE *f = fopen(in_folder("sides.bvh"), "w");
    if (!f) return "";
    fputs("HIERARCHY\nROOT hips {\nOFFSET 0 0 0\nCHANNELS 0\n", f);
    for (int k = 0; k < 2; k++) put_limb(f, leg, "", k ? b : a, k ? -9 : 9, 0, -40, 1);
    fputs("JOINT chest {\nOFFSET 0 40 0\nCHANNELS 0\n", f);
    put_limb(f, arm, "", a, 17, 27, 0, 1);
    put_limb_with(f, arm, "", b, -17, -27, 0, 1, held);
    fprintf(f, "%s}\n}\nMOTION\nFrames: 1\nFrame Time: 0.1\n0 0 0 0 0 0 0 0 0 0 0 0\n", head);
    fclose(f);
    return in_folder("sides.bvh");
}

/* Two humans beside each other, A: and B:, below two ROOTs or one. */
static const char *put_two(bool one_root) {
    static const char *const leg[] = {"Thigh", "Shin", "Foot"}, *const arm[] = {"UpperArm", "Forearm", "Hand"};
    FILE *f = fopen(in_folder("two.bvh"), "w");
    if (!f) return "";
    fputs("HIERARCHY\n", f);
    if (one_root) fputs("ROOT World {\nOFFSET 0 0 0\nCHANNELS 0\n", f);
    for (int k = 0; k < 2; k++) {
        const char *left = k ? "B:Left" : "A:Left", *right = k ? "B:Right" : "A:Right";
        fprintf(f, "%s %.2sHips {\nOFFSET %d 0 0\nCHANNELS 0\n", one_root ? "JOINT" : "ROOT", left, k * 60);
        put_limb(f, leg, left, "", 9, 0, -40, 1);
        put_limb(f, leg, right, "", -9, 0, -40, 1);
        fprintf(f, "JOINT %.2sChest {\nOFFSET 0 40 0\nCHANNELS 0\n", left);
        put_limb(f, arm, left, "", 17, 27, 0, 1);
        put_limb(f, arm, right, "", -17, -27, 0, 1);
        fprintf(f, "JOINT %.2sHead {\nOFFSET 0 20 0\nCHANNELS 0\nEnd Site { OFFSET 0 20 0 }\n}\n}\n}\n", left);
    }
    fprintf(f, "%sMOTION\nFrames: 1\nFrame Time: 0.1\n", one_root ? "}\n" : "");
    for (int i = 0; i < 24; i++) fputs("0 ", f);
    fputs("\n", f);
    fclose(f);
    return in_folder("two.bvh");
}

/* One role that is told chooses between figures: all others are of the same. */
static void test_two(void) {
    static const char *const told[] = {"", "pelvis = B:Hips\n", "head = B:Head\n", "left_hand = B:LeftHand\n",
                                       "right_shin = B:RightShin\n", "left_hand = A:LeftHand\n"};
    for (int i = 0; i < 12; i++) {
        Rig r;
        const char *path = put_two(i % 2), *roles = folder_put_text("roles", told[i / 2]);
        char who = strstr(told[i / 2], "B:") ? 'B' : 'A';
        int wrong = !rig_roles(&r, path, roles);
        for (Role role = 0; role < ROLE_COUNT && !wrong; role++)
            wrong += r.roles.joint[role] >= 0 && rig_joint(&r, role)[0] != who;
        OK(wrong == 0, "of two figures below %s that of '%.*s'", i % 2 ? "one root" : "two roots",
           (int)strcspn(told[i / 2], "\n"), told[i / 2]);
        rig_close(&r);
    }
}

/* Joints that all hang on one: only their names tell what they are. */
static const char *put_flat(const char *const names[], int n) {
    FILE *f = fopen(in_folder("flat.bvh"), "w");
    if (!f) return "";
    fputs("HIERARCHY\nROOT World {\nOFFSET 0 0 0\nCHANNELS 1 Xposition\n", f);
    for (int i = 0; i < n; i++) fprintf(f, "JOINT %s { OFFSET 0 0 0 }\n", names[i]);
    fputs("}\nMOTION\nFrames: 1\nFrame Time: 0.1\n0\n", f);
    fclose(f);
    return in_folder("flat.bvh");
}

static void test_flat(void) {
    /* In the order of Role. */
    static const char *const names[ROLE_COUNT] = {
        "Hips", "Spine", "Spine1", "Neck", "Head", "LeftCollar", "LeftShoulder", "LeftElbow", "LeftWrist",
        "RightCollar", "RightShoulder", "RightElbow", "RightWrist", "LeftUpLeg", "LeftLeg", "LeftFoot", "LeftToe",
        "RightUpLeg", "RightLeg", "RightFoot", "RightToe",
    };
    Rig r;
    bool good = rig_roles(&r, put_flat(names, ROLE_COUNT), NULL);
    int wrong = 0;
    for (Role role = 0; good && role < ROLE_COUNT; role++) wrong += strcmp(rig_joint(&r, role), names[role]) != 0;
    OK(good && wrong == 0, "names tell the roles of joints that all hang on one: %d wrong", wrong);
    rig_close(&r);
    OK(!rig_roles(&r, put_flat(names, ROLE_RIGHT_THIGH), NULL) && strstr(r.e.text, "roles: right_thigh, right_shin"),
       "and which are missing");
    rig_close(&r);
}

/* A file's two roles are joints of these names. */
static void two_roles(const char *path, Role a, const char *name_a, Role b, const char *name_b, const char *says) {
    Rig r;
    OK(rig_roles(&r, path, NULL) && strcmp(rig_joint(&r, a), name_a) == 0 && strcmp(rig_joint(&r, b), name_b) == 0,
       "%s", says);
    rig_close(&r);
}

int main(void) {
    if (!folder_make()) return 1;
    two_roles(put_hanging(), ROLE_HEAD, "Head", ROLE_PELVIS, "Hips", "a tree that hangs from the head");
    two_roles(put_twins(), ROLE_LEFT_THIGH, "DEF-thigh.L", ROLE_RIGHT_FOREARM, "DEF-forearm.R",
              "of two limbs alike, the one that moves");
    static const char head[] = "JOINT head { OFFSET 0 20 0 CHANNELS 0 End Site { OFFSET 0 20 0 } }\n";
    static const char hat[] = "JOINT x1 { OFFSET 0 8 0 CHANNELS 0 JOINT x2 { OFFSET 0 8 0 CHANNELS 0\n"
                              "JOINT x3 { OFFSET 0 14 0 CHANNELS 0 End Site { OFFSET 0 9 0 } } } }\n";
    static const char hand[] = "End Site { OFFSET 0 0 9 }";
    static const char staff[] = "JOINT x1 { OFFSET 0 80 0 CHANNELS 0 JOINT x2 { OFFSET 0 -100 0 CHANNELS 0 } }\n";
    two_roles(put_sides("_l", "_r", hat, hand), ROLE_NECK, "x1", ROLE_HEAD, "x2", "a joint at the crown is no head");
    two_roles(put_sides("a", "b", head, hand), ROLE_PELVIS, "hips", ROLE_LEFT_THIGH, "hip_a",
              "sides told by an unknown word");
    two_roles(put_sides("1", "2", head, hand), ROLE_RIGHT_SHIN, "knee_2", ROLE_RIGHT_UPPER_ARM, "shoulder_2",
              "by a number");
    two_roles(put_sides("a", "b", head, staff), ROLE_LEFT_HAND, "wrist_a", ROLE_RIGHT_HAND, "wrist_b",
              "a staff looks more like an arm than the arm does, but not like the other arm");
    test_two();
    test_flat();
    folder_remove();
    return tap_done();
}
