/* Whatever the bytes: roles that make a figure of finite bones, or one error with a reason. Behind a
   line of '%%%' may stand a motion, else the roles are those of the smallest human. */
#include "figure/figure.h"

#include "human.h"
#include "parts.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static bool build(const char *motion, const char *roles_file, Arena *arena, Error *e) {
    static Notes notes;
    MotionOptions options = {.max_frames = 1000, .max_joints = 200};
    FigureOptions nothing = {0};
    Motion m;
    RoleFile file;
    Roles roles;
    Figure figure;
    notes.count = 0;
    bool good = motion_open(motion, &options, arena, &notes, &m, e) &&
                role_file_read(roles_file, arena, &file, e) && roles_read(&m, &file, arena, &notes, &roles, e) &&
                figure_build(&m, &roles, &nothing, arena, &notes, &figure, e);
    if (good && !(figure.height > 0 && figure.height < 1e6)) abort();
    motion_close(&m);
    return good;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static Sheet roles, motion;
    Arena arena = {0};
    Error e = {0};
    part_take(&data, &size, &roles);
    if (size) sheet_write(&motion, data, size);
    else sheet_write(&motion, human_bvh, sizeof human_bvh - 1);
    if (!build(motion.path, roles.path, &arena, &e) && (e.kind != ERR_INPUT || !e.text[0])) abort();
    arena_free(&arena);
    return 0;
}
