/* A motion file with the roles and the figure that are found in it, for the unit programs of
   the figure floor. */
#ifndef TESTS_RIG_H
#define TESTS_RIG_H

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "figure/figure.h"

typedef struct {
    Arena arena;
    Notes notes;
    Error e;
    Motion motion;
    MotionReader *reader;
    Roles roles;
    Figure figure;
    double *row;
    Rigid *world;
} Rig;

/* Opens a motion as far as its roles. roles_file may be NULL. */
static inline bool rig_roles(Rig *r, const char *path, const char *roles_file) {
    MotionOptions options = {0};
    RoleFile file = {0};
    memset(r, 0, sizeof *r);
    return motion_open(path, &options, &r->arena, &r->notes, &r->motion, &r->e) &&
           (!roles_file || role_file_read(roles_file, &r->arena, &file, &r->e)) &&
           roles_read(&r->motion, &file, &r->arena, &r->notes, &r->roles, &r->e);
}

/* Opens it ready for rig_pose. */
static inline bool rig_open(Rig *r, const char *path, const FigureOptions *options) {
    FigureOptions none = {0};
    if (!rig_roles(r, path, NULL)) return false;
    if (!figure_build(&r->motion, &r->roles, options ? options : &none, &r->arena, &r->notes, &r->figure, &r->e))
        return false;
    r->row = ARENA_NEW(&r->arena, double, r->motion.skeleton.nchannels, &r->e);
    r->world = ARENA_NEW(&r->arena, Rigid, r->motion.skeleton.njoints, &r->e);
    return r->row && r->world && motion_reader_open(&r->motion, &r->arena, &r->reader, &r->e);
}

static inline Pose rig_pose(Rig *r, int frame) {
    Pose pose = figure_rest_pose();
    if (!motion_row(r->reader, frame, r->row, &r->e)) return pose;
    skeleton_pose(&r->motion.skeleton, r->row, r->world);
    figure_pose(&r->figure, r->world, &pose);
    return pose;
}

static inline void rig_close(Rig *r) {
    if (r->reader) motion_reader_close(r->reader);
    motion_close(&r->motion);
    arena_free(&r->arena);
}

/* Name of the joint that plays a role, "-" for none. */
static inline const char *rig_joint(const Rig *r, Role role) {
    int joint = r->roles.joint[role];
    return joint < 0 ? "-" : r->motion.skeleton.joint[joint].name;
}

/* Where that joint is in the world of the pose (metres, Y up) after rig_pose. */
static inline Vec3 rig_place(const Rig *r, Role role) {
    Vec3 p = r->world[r->roles.joint[role]].t;
    return vec_scale(mat_apply(r->figure.upright, p), r->figure.unit);
}

/* Path of a shared real motion; NULL where the folder KITSUKE_MOTIONS is not there. */
static inline const char *rig_shared(const char *file) {
    static char path[1024];
    const char *folder_name = getenv("KITSUKE_MOTIONS");
    if (!folder_name) folder_name = "../shared/motions";
    snprintf(path, sizeof path, "%s/%s", folder_name, file);
    return access(path, R_OK) == 0 ? path : NULL;
}

#endif
