/* The smallest human: the joints without which there is none, and two frames of a step. */
#ifndef FUZZ_HUMAN_H
#define FUZZ_HUMAN_H

#define LIMB(side, root, x, y, lower) \
    " JOINT " side root "{OFFSET " x " " y " 0 CHANNELS 1 Xrotation" \
    "  JOINT " side lower "{OFFSET 0 -.4 0 CHANNELS 1 Xrotation End Site{OFFSET 0 -.4 0}}}\n"

static const char human_bvh[] =
    "HIERARCHY ROOT Hips{OFFSET 0 .9 0 CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
    " JOINT Chest{OFFSET 0 .3 0 CHANNELS 1 Xrotation\n"
    LIMB("Left", "Arm", ".2", ".2", "ForeArm") LIMB("Right", "Arm", "-.2", ".2", "ForeArm")
    " JOINT Head{OFFSET 0 .3 0 CHANNELS 1 Yrotation End Site{OFFSET 0 .2 0}}}\n"
    LIMB("Left", "UpLeg", ".1", "0", "Leg") LIMB("Right", "UpLeg", "-.1", "0", "Leg")
    "}\nMOTION\nFrames: 2\nFrame Time: .04\n"
    "0 .9 0 0 0 0  5  10 -10 -10 -10 0  20 5 -20 5\n"
    "0 .9 .1 0 0 5  0  0 -10 0 -10 3  0 0 -10 30\n";

#undef LIMB

#endif
