/* What a joint's name says: which side, and how well it fits each bone of a human. */
#ifndef FIGURE_NAMES_H
#define FIGURE_NAMES_H

#include <stdbool.h>

/* Bones without their side. */
typedef enum {
    PART_PELVIS, PART_SPINE, PART_CHEST, PART_NECK, PART_HEAD,
    PART_CLAVICLE, PART_UPPER_ARM, PART_FOREARM, PART_HAND,
    PART_THIGH, PART_SHIN, PART_FOOT, PART_TOE, PART_COUNT
} Part;

typedef struct {
    int side;                  /* +1 left, -1 right, 0 the name does not say */
    double weight[PART_COUNT]; /* 0 = says nothing, 1 = names that bone and nothing else */
    bool stranger;             /* names something that is no bone: a wing, a skirt, a camera */
} NameHint;

/* Reads LeftUpLeg, lThigh, thigh_l, thigh.L.001, "Bip01 L Thigh", mixamorig:LeftUpLeg,
   FK_upArm_jnt, lfemur, LEFTLEG, ... An unknown name gives zeros. */
NameHint name_hint(const char *name);

/* The same for a joint that is known to belong to one side, though its name may not tell to which. */
NameHint name_hint_sided(const char *name);

#endif
