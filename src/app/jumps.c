/* A T-pose in front of a take, a root that teleports, a knee that flips: reported, a few of them one
   by one, the rest as a number. */
#include "app/jumps.h"

/* Heights a second. Kicks and dances that were looked at reach 9 at a hand or foot and 4 at the
   pelvis, a pitcher's hand about 14; a rest pose that a converter has blended into a take moves at
   15 to 60, a knee that it flips at up to 50, a teleport at 200. Only what concerns the whole body
   makes cloth start afresh; a limb that flips is reported. */
static const double FAST_LIMB = 15, FAST_PELVIS = 8, TELEPORT = 80;

/* A step also has to be so wide, in heights: noise at a high frame rate is no jump. */
static const double WIDE_LIMB = 0.1, WIDE_PELVIS = 0.05;

/* The motion is back from a jump that is so many times wider than what is left of it, and after so many frames at the
   latest. */
static const double BACK_FACTOR = 4;
enum { ASTRAY_MOST = 3 };

/* A single fast limb means a rest pose in front of the take only near its beginning. */
enum { BEGINNING = 8 };

static double pelvis_step(const Figure *f, const Pose *behind, const Pose *ahead) {
    Vec3 start = f->start[ROLE_PELVIS];
    return vec_dist(rigid_apply(behind->bone[ROLE_PELVIS], start), rigid_apply(ahead->bone[ROLE_PELVIS], start)) /
           f->height;
}

Step jumps_judge(const JumpRule *rule, int frame, const Pose *behind, const Pose *ahead, double *width) {
    double dt = rule->frame_time, pelvis = pelvis_step(rule->figure, behind, ahead);
    *width = figure_step(rule->figure, behind, ahead);
    bool is_fast = *width > WIDE_LIMB && *width > FAST_LIMB * dt;
    if (frame == 1 && rule->lone_first) return STEP_JUMP;
    if (pelvis > WIDE_PELVIS && pelvis > FAST_PELVIS * dt) return STEP_JUMP;
    if (is_fast && (frame < BEGINNING || *width > TELEPORT * dt)) return STEP_JUMP;
    return is_fast ? STEP_FLIP : STEP_PLAIN;
}

bool jumps_find_return(const JumpRule *rule, int frame, int count, double width, const Pose *behind, JumpsRead *read,
                       void *context, int *back, Error *e) {
    *back = frame;
    for (int k = 1; k <= ASTRAY_MOST && frame + k < count && *back == frame; k++) {
        JumpRule over = {rule->figure, rule->frame_time * (k + 1), rule->lone_first};
        Pose ahead;
        double left;
        if (!read(context, frame + k, &ahead, e)) return false;
        Step kind = jumps_judge(&over, frame + k, behind, &ahead, &left);
        if (kind == STEP_PLAIN && left * BACK_FACTOR <= width) *back = frame + k;
    }
    return true;
}

/* The last of `count`. */
static Jump *last_of(Jumps *j, int count) { return &j->jump[count <= JUMPS_KEPT ? count - 1 : JUMPS_KEPT]; }

static bool goes_on(const Jump *last, const Jump *next) {
    return last->last == next->first - 1 && last->kind == next->kind;
}

static void append(Jumps *j, Jump next) {
    if (j->count == 0 || !goes_on(last_of(j, j->count), &next)) {
        *last_of(j, ++j->count) = next;
        return;
    }
    Jump *last = last_of(j, j->count);
    last->last = next.last;
    last->width = larger(last->width, next.width);
}

void jumps_add(Jumps *j, int frame, double width, Step kind) { append(j, (Jump){frame, frame, width, kind}); }

void jumps_append(Jumps *j, const Jumps *later) {
    for (int i = 0; i < later->count && i <= JUMPS_KEPT; i++) append(j, later->jump[i]);
    if (later->count > JUMPS_KEPT) j->count += later->count - JUMPS_KEPT - 1;
}

static void note(const Jump *j, Place place, Notes *notes) {
    char frames[48];
    if (j->first == j->last) snprintf(frames, sizeof frames, "frame %d", j->first);
    else snprintf(frames, sizeof frames, "frames %d to %d", j->first, j->last);
    if (j->kind == STEP_FLIP)
        notes_add(notes, place, "a limb flips by up to %.2f heights a frame at %s", j->width, frames);
    else if (j->first == 2 && j->last == 2)
        notes_add(notes, place, "frame 1 stands apart from the rest; cloth starts afresh at frame 2");
    else if (j->first == 2)
        notes_add(notes, place, "the first %d frames stand apart from the rest; cloth starts afresh up to frame %d",
                  j->last - 1, j->last);
    else
        notes_add(notes, place, "the figure jumps by up to %.2f heights a frame at %s; cloth starts afresh", j->width,
                  frames);
}

void jumps_notes(const Jumps *j, const char *path, Notes *notes) {
    Place place = {.file = path};
    for (int i = 0; i < j->count && i < JUMPS_KEPT; i++) note(&j->jump[i], place, notes);
    if (j->count > JUMPS_KEPT) notes_add(notes, place, "it flips or jumps in %d more places", j->count - JUMPS_KEPT);
}
