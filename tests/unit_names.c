/* What joint names say: the side, the bone, that it is no bone of a human. */
#include "figure/names.h"

#include <math.h>

#include "tap.h"

static void test_names(void) {
    static const struct { const char *name; int side; Part part; } hints[] = {
        {"LeftUpLeg", 1, PART_THIGH}, {"LEFTUPLEG", 1, PART_THIGH}, {"rThigh", -1, PART_THIGH},
        {"thigh_l", 1, PART_THIGH}, {"DEF-thigh.R.001", -1, PART_THIGH}, {"Bip01 L Calf", 1, PART_SHIN},
        {"ValveBiped.Bip01_R_UpperArm", -1, PART_UPPER_ARM}, {"lfemur", 1, PART_THIGH}, {"LUArm", 1, PART_UPPER_ARM},
        {"UpperLeftArm", 1, PART_UPPER_ARM}, {"L_lowArm_jnt", 1, PART_FOREARM}, {"mElbowRight", -1, PART_FOREARM},
        {"CC_Base_L_Calf", 1, PART_SHIN}, {"mixamorig:RightToeBase", -1, PART_TOE}, {"l_up_leg", 1, PART_THIGH},
        {"LUARM", 1, PART_UPPER_ARM}, {"RFARM", -1, PART_FOREARM}, {"RtForearm", -1, PART_FOREARM},
        {"arm_lower_L", 1, PART_FOREARM}, {"LegUpR", -1, PART_THIGH}, {"rgt_shank_jnt", -1, PART_SHIN},
        {"UpperArm_L_low", 1, PART_UPPER_ARM}, {"lft_leg_lower", 1, PART_SHIN},
        {"lowerneck", 0, PART_NECK}, {"head neck upper", 0, PART_NECK}, {"Head_M", 0, PART_HEAD},
    };
    for (size_t i = 0; i < sizeof hints / sizeof hints[0]; i++) {
        NameHint h = name_hint(hints[i].name);
        double own = h.weight[hints[i].part], other = 0;
        for (int p = 0; p < PART_COUNT; p++)
            if (p != (int)hints[i].part) other = max_of(other, h.weight[p]);
        OK(h.side == hints[i].side && own >= 0.9 && own <= 1 && other <= 0.5, "'%s' is understood, and is nothing else",
           hints[i].name);
    }
    static const char *const not_hands[] = {"LeftHandThumb1", "LeftInHandIndex", "ik_hand_l", "LeftHandEnd",
                                            "HandTipLeft"};
    for (size_t i = 0; i < sizeof not_hands / sizeof not_hands[0]; i++)
        OK(name_hint(not_hands[i]).weight[PART_HAND] < 0.1, "'%s' is no hand", not_hands[i]);
    static const struct { const char *name; int side; } sides[] = {
        {"Muslo_Izq", 1}, {"PiernaDerecha", -1}, {"cuisse.gauche", 1}, {"BraccioDx", -1}, {"Oberarm_links", 1},
        {"j_hip_le", 1}, {"j_hip_ri", -1},
        {"\xec\x98\xa4\xeb\xa5\xb8\xec\xaa\xbd\xec\x86\x90", -1}, {"\xd0\x9b\xd0\xb5\xd0\xb2\xd0\xb0\xd1\x8f", 1},
        {"Under", 0}, {"Izquier", 0},
    };
    for (size_t i = 0; i < sizeof sides / sizeof sides[0]; i++)
        OK(name_hint(sides[i].name).side == sides[i].side, "side of '%s'", sides[i].name);
    NameHint hip = name_hint("hip_a"), sided = name_hint_sided("hip_a");
    OK(hip.weight[PART_PELVIS] > 0.5 && hip.weight[PART_THIGH] == 0, "'hip_a' is the pelvis");
    OK(sided.weight[PART_THIGH] > 0.5 && sided.weight[PART_PELVIS] == 0 && sided.side == 0,
       "but one of two is a thigh, of a side that is not told");
    NameHint shoulder = name_hint("LeftShoulder");
    OK(shoulder.weight[PART_CLAVICLE] > 0.5 && shoulder.weight[PART_UPPER_ARM] > 0.5, "'LeftShoulder' may be either");
    OK(name_hint("Wing1_L").stranger && name_hint("CoatTail").stranger && !name_hint("LeftHandEnd").stranger &&
           !name_hint("Brazo").stranger, "wings and coats are strangers, unknown words are not");
    static const char *const nothing[] = {"", "j12", "\xff\xfe", "---", "x", "0123"};
    for (size_t i = 0; i < sizeof nothing / sizeof nothing[0]; i++) {
        NameHint h = name_hint(nothing[i]);
        double most = 0;
        for (int p = 0; p < PART_COUNT; p++) most = max_of(most, h.weight[p]);
        OK(most == 0 && h.side == 0, "'%s' says nothing", i == 2 ? "bytes" : nothing[i]);
    }
}

int main(void) {
    test_names();
    return tap_done();
}
