/* Roles: found in the skeleton, then corrected by the user's file, then checked. */
#include "figure/roles.h"

#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "figure/human.h"

enum { SAMPLE_FRAMES = 12, FILE_LIMIT = 1 << 20, NAME_MAX_LENGTH = 512 };

static const char *const names[ROLE_COUNT] = {
    "pelvis", "spine", "chest", "neck", "head",
    "left_clavicle", "left_upper_arm", "left_forearm", "left_hand",
    "right_clavicle", "right_upper_arm", "right_forearm", "right_hand",
    "left_thigh", "left_shin", "left_foot", "left_toe",
    "right_thigh", "right_shin", "right_foot", "right_toe",
};

static const Role required[] = {
    ROLE_PELVIS, ROLE_CHEST, ROLE_LEFT_UPPER_ARM, ROLE_LEFT_FOREARM, ROLE_RIGHT_UPPER_ARM, ROLE_RIGHT_FOREARM,
    ROLE_LEFT_THIGH, ROLE_LEFT_SHIN, ROLE_RIGHT_THIGH, ROLE_RIGHT_SHIN,
};

const char *role_name(Role role) { return (unsigned)role < ROLE_COUNT ? names[role] : "none"; }

int role_limb(Role role) {
    static const Role first[] = {ROLE_LEFT_CLAVICLE, ROLE_RIGHT_CLAVICLE, ROLE_LEFT_THIGH, ROLE_RIGHT_THIGH};
    int limb = 0;
    while (limb < 4 && role >= first[limb]) limb++;
    return limb;
}

Role role_mirror(Role role) {
    int limb = role_limb(role), way = limb == 0 ? 0 : limb % 2 ? 1 : -1; /* from a left limb to a right one, or back */
    int arm = ROLE_RIGHT_CLAVICLE - ROLE_LEFT_CLAVICLE, leg = ROLE_RIGHT_THIGH - ROLE_LEFT_THIGH;
    return (Role)((int)role + way * (limb < 3 ? arm : leg));
}

Role role_parent(Role role) {
    static const Role root[] = {ROLE_PELVIS, ROLE_CHEST, ROLE_CHEST, ROLE_PELVIS, ROLE_PELVIS};
    bool begins = role == ROLE_PELVIS || role_limb(role) != role_limb((Role)((int)role - 1));
    return begins ? root[role_limb(role)] : (Role)((int)role - 1);
}

Role role_find(const char *name, int length) {
    for (int r = 0; r < ROLE_COUNT; r++)
        if ((int)strlen(names[r]) == length && memcmp(names[r], name, (size_t)length) == 0) return (Role)r;
    return ROLE_COUNT;
}

bool role_unknown(const char *name, const char *what, Place place, Error *e) {
    Nearest near = {.word = name};
    for (int r = 0; r < ROLE_COUNT; r++) {
        if (role_limb((Role)r) % 2 && strcmp(name, names[r] + strlen("left_")) == 0)
            return error_at(e, ERR_INPUT, place, "unknown %s '%s': expected %s or %s", what, name, names[r],
                            names[role_mirror((Role)r)]);
        nearest_try(&near, names[r]);
    }
    if (near.best) return nearest_error(&near, what, place, e);
    return error_at(e, ERR_INPUT, place,
                    "unknown %s '%.60s': expected pelvis, spine, chest, neck, head, or with left_ or right_: clavicle, "
                    "upper_arm, forearm, hand, thigh, shin, foot, toe", what, name);
}

/* --- the file --- */

static bool blank(char c) { return c == ' ' || c == '\t'; }

/* Copies text without the blanks round it. False where it does not fit. */
static bool copy_trimmed(const char *from, const char *to, char *out, size_t n) {
    while (from < to && blank(*from)) from++;
    while (to > from && blank(to[-1])) to--;
    size_t length = (size_t)(to - from);
    if (length >= n) return false;
    memcpy(out, from, length);
    out[length] = '\0';
    return true;
}

/* One line `role = joint`. */
MUST_CHECK static bool read_line(const Line *line, Arena *arena, RoleFile *out, Error *e) {
    const char *start = line->word[0], *end = line->word[line->count - 1] + line->length[line->count - 1];
    const char *equals = memchr(start, '=', (size_t)(end - start));
    char role_text[64], joint_text[NAME_MAX_LENGTH];
    Place at_role = text_place(&line->at, start);
    if (!equals) return error_at(e, ERR_INPUT, at_role, "expected 'role = joint'");
    if (!copy_trimmed(start, equals, role_text, sizeof role_text))
        return error_at(e, ERR_INPUT, at_role, "role name too long");
    Role role = role_find(role_text, (int)strlen(role_text));
    if (role == ROLE_COUNT) return role_unknown(role_text, "role", at_role, e);
    for (int i = 0; i < out->count; i++)
        if (out->line[i].role == role) return error_at(e, ERR_INPUT, at_role, "role '%s' given twice", role_text);

    const char *value = equals + 1;
    while (value < end && blank(*value)) value++;
    Place at_joint = text_place(&line->at, value);
    if (value == end) return error_at(e, ERR_INPUT, at_joint, "no joint for role '%s'", role_text);
    if (!copy_trimmed(value, end, joint_text, sizeof joint_text))
        return error_at(e, ERR_INPUT, at_joint, "joint name too long");
    out->line[out->count].role = role;
    out->line[out->count].place = at_joint;
    out->line[out->count].joint = arena_text(arena, joint_text, strlen(joint_text), e);
    return out->line[out->count++].joint != NULL;
}

bool role_file_read(const char *path, Arena *arena, RoleFile *out, Error *e) {
    Text text;
    Line line;
    *out = (RoleFile){0};
    if (!text_read(path, FILE_LIMIT, arena, &text, e)) return false;
    Cursor c = text_start(&text);
    while (text_line(&c, &line, e))
        if (!read_line(&line, arena, out, e)) return false;
    return e->kind == ERR_NONE;
}

static bool unknown_joint(const Skeleton *s, Place place, const char *joint, Error *e) {
    Nearest near = {.word = joint};
    for (int j = 0; j < s->njoints; j++) nearest_try(&near, s->joint[j].name);
    return nearest_error(&near, "joint", place, e);
}

/* The joints of this skeleton that the file names. */
MUST_CHECK static bool find_joints(const Skeleton *s, const RoleFile *file, bool *given, Roles *out, Error *e) {
    for (int i = 0; i < file->count; i++) {
        const char *name = file->line[i].joint;
        Place place = file->line[i].place;
        int joint = skeleton_find(s, name);
        if (joint < 0 && strcmp(name, "none") != 0) return unknown_joint(s, place, name, e);
        if (joint >= 0 && s->joint[joint].is_end)
            return error_at(e, ERR_INPUT, place, "'%s' is an end site, not a joint", name);
        given[file->line[i].role] = true;
        out->joint[file->line[i].role] = joint;
    }
    return true;
}

/* --- what must be there --- */

static bool check_required(const Motion *m, const Roles *roles, Error *e) {
    char list[256] = "";
    size_t used = 0;
    for (size_t i = 0; i < sizeof required / sizeof required[0]; i++) {
        if (roles->joint[required[i]] >= 0) continue;
        int n = snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "", names[required[i]]);
        if (n > 0 && used + (size_t)n < sizeof list) used += (size_t)n;
    }
    if (used == 0) return true;
    return error_set(e, ERR_INPUT, "no human skeleton in '%s': missing roles: %s", m->path ? m->path : "motion", list);
}

/* The last line that gives one of two roles a joint. */
static Place place_of(const RoleFile *file, int a, int b) {
    int i = file->count - 1;
    while (i > 0 && (int)file->line[i].role != a && (int)file->line[i].role != b) i--;
    return i < 0 ? (Place){0} : file->line[i].place;
}

/* A role file can ask for one joint twice; the search cannot. Only a trunk may be of one bone. */
static bool check_distinct(const Skeleton *s, const Roles *roles, const RoleFile *file, Error *e) {
    for (int a = 0; a < ROLE_COUNT; a++)
        for (int b = a + 1; b < ROLE_COUNT; b++)
            if (roles->joint[a] >= 0 && roles->joint[a] == roles->joint[b] && !(a == ROLE_PELVIS && b == ROLE_CHEST))
                return error_at(e, ERR_INPUT, place_of(file, a, b), "joint '%s' plays two roles: %s and %s",
                                s->joint[roles->joint[a]].name, names[a], names[b]);
    return true;
}

/* What the file gives away, the search may not keep for another role. */
static void take_from_file(const Skeleton *s, const bool *given, const Roles *file, Notes *notes, Roles *roles) {
    for (int a = 0; a < ROLE_COUNT; a++) {
        if (!given[a] || file->joint[a] < 0 || file->joint[a] == roles->joint[a]) continue;
        for (int b = 0; b < ROLE_COUNT; b++) {
            if (given[b] || file->joint[a] != roles->joint[b]) continue;
            notes_add(notes, (Place){0}, "'%s' is %s, as the roles say, and no longer %s",
                      s->joint[file->joint[a]].name, names[a], names[b]);
            roles->joint[b] = -1;
        }
    }
    for (int a = 0; a < ROLE_COUNT; a++)
        if (given[a]) roles->joint[a] = file->joint[a];
}

bool roles_read(const Motion *m, const RoleFile *file, Arena *scratch, Notes *notes, Roles *out, Error *e) {
    static const RoleFile nothing = {.count = 0};
    Sample sample;
    Tree tree;
    if (!sample_read(m, SAMPLE_FRAMES, scratch, &sample, e)) return false;
    if (!tree_build(&m->skeleton, &sample, scratch, &tree, e)) return false;
    bool given[ROLE_COUNT] = {false};
    Roles told;
    if (!file) file = &nothing;
    for (int r = 0; r < ROLE_COUNT; r++) told.joint[r] = -1;
    if (!find_joints(&m->skeleton, file, given, &told, e)) return false;
    bool sides_are_told = given[ROLE_LEFT_THIGH] && given[ROLE_RIGHT_THIGH]; /* then the search may doubt in silence */
    human_find(&tree, &told, sides_are_told ? NULL : notes, out);
    take_from_file(&m->skeleton, given, &told, notes, out);
    return check_distinct(&m->skeleton, out, file, e) && check_required(m, out, e);
}
