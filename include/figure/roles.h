/* Which joint plays which bone of a human. */
#ifndef FIGURE_ROLES_H
#define FIGURE_ROLES_H

#include "motion/motion.h"

typedef enum {
    ROLE_PELVIS, ROLE_SPINE, ROLE_CHEST, ROLE_NECK, ROLE_HEAD,
    ROLE_LEFT_CLAVICLE, ROLE_LEFT_UPPER_ARM, ROLE_LEFT_FOREARM, ROLE_LEFT_HAND,
    ROLE_RIGHT_CLAVICLE, ROLE_RIGHT_UPPER_ARM, ROLE_RIGHT_FOREARM, ROLE_RIGHT_HAND,
    ROLE_LEFT_THIGH, ROLE_LEFT_SHIN, ROLE_LEFT_FOOT, ROLE_LEFT_TOE,
    ROLE_RIGHT_THIGH, ROLE_RIGHT_SHIN, ROLE_RIGHT_FOOT, ROLE_RIGHT_TOE,
    ROLE_COUNT
} Role;

/* "pelvis", "left_upper_arm", ... */
const char *role_name(Role role);

/* The bone that a bone hangs on: of the pelvis, itself. */
Role role_parent(Role role);

/* The role of that name (length bytes), or ROLE_COUNT. */
Role role_find(const char *name, int length);

/* Records "unknown WHAT 'NAME'", with the role that was probably meant or else all of them, and returns false. */
bool role_unknown(const char *name, const char *what, Place place, Error *e);

/* The limb that a role belongs to: 0 the trunk with neck and head, 1 and 2 the arms (left, right), 3 and 4
   the legs. Roles of a limb follow each other from the trunk outwards. */
int role_limb(Role role);

/* The same role on the other side; of the trunk itself. */
Role role_mirror(Role role);

/* joint[role]: the joint whose rotation moves that bone and at whose origin it begins; -1 =
   the skeleton has none. Pelvis, chest, and on both sides upper arm, forearm, thigh and shin
   are always there after a success. */
typedef struct { int joint[ROLE_COUNT]; } Roles;

/* What a file tells of roles: lines `role = joint`, in the file's order and each role once. Clear with {0}: it tells
   nothing. */
typedef struct {
    struct {
        Role role;
        const char *joint; /* the rest of the line; `none` removes a role */
        Place place;       /* of the joint's name */
    } line[ROLE_COUNT];
    int count;
} RoleFile;

/* Reads and checks what can be checked without a motion, so that a file that many motions share is read once and wrong
   once. Texts from arena. */
MUST_CHECK bool role_file_read(const char *path, Arena *arena, RoleFile *out, Error *e);

/* Finds the roles by names and, where names do not settle it, by topology and geometry of
   some poses of the motion. ERR_INPUT with the list of missing roles where it is no human.
   What the file tells wins over everything found; it may be NULL. */
MUST_CHECK bool roles_read(const Motion *m, const RoleFile *file, Arena *scratch, Notes *notes, Roles *out, Error *e);

#endif
