/* How the body sits on the joints of rigs whose zero pose tells nothing: against the same take with a human one. */
#include "folder.h"
#include "tap.h"
#include "turns.h"

/* A take with a zero pose that tells, and the same one without. */
static bool open_both(Rig *told, const char *with, Rig *found, const char *without, const char *who) {
    return OK(rig_open(told, with, NULL) && rig_open(found, without, NULL), "%s open", who);
}

static void close_both(Rig *told, Rig *found) {
    rig_close(told);
    rig_close(found);
}

/* Up is up also of those who never stand. The body lies turned by 20 degrees about its own axis. */
static void test_lying(void) {
    static const struct { const char *file; char up; double face; } cases[] = {
        {"tests/data/figure/pushups.bvh", 'y', -1}, {"tests/data/figure/lying.bvh", 'z', 1},
    };
    for (int i = 0; i < 2; i++) {
        Rig r;
        bool good = rig_open(&r, cases[i].file, NULL) && r.figure.up == cases[i].up;
        OK(good, "%s: up is %c", cases[i].file, r.figure.up);
        Pose pose = rig_pose(&r, 5);
        OK(angle(mat_column(pose.bone[ROLE_CHEST].r, 2), vec(0, cases[i].face, 0)) < 35, "and the chest faces %s",
           cases[i].face > 0 ? "the sky" : "the floor");
        OK(angle(mat_column(pose.bone[ROLE_PELVIS].r, 2), vec(0, cases[i].face, 0)) < 35, "and so does the pelvis");
        rig_close(&r);
    }
    Rig back; /* head along y, the floor below z */
    bool opens = rig_open(&back, "tests/data/figure/supine.bvh", NULL);
    OK(opens && (back.figure.up == 'z' || back.notes.count == 1), "who lies on the back is understood, or doubted");
    rig_close(&back);
}

/* The up axis of lafan1.bvh, whose rest pose tells nothing, turned about z (degrees) and all in one place. */
static char up_turned(double turn, Vec3 place, double frame_time) {
    const char *path = in_folder("turned.bvh");
    FILE *in = fopen("tests/data/figure/lafan1.bvh", "r"), *out = fopen(path, "w");
    char line[4096];
    double x, y, z, about_z;
    int used = 0;
    while (fgets(line, sizeof line, in)) {
        bool row = sscanf(line, "%lf %lf %lf %lf %n", &x, &y, &z, &about_z, &used) == 4;
        if (row) fprintf(out, "%g %g %g %g %s", place.x, place.y, place.z, about_z + turn, line + used);
        else if (strstr(line, "Frame Time")) fprintf(out, "Frame Time: %g\n", frame_time);
        else fputs(line, out);
    }
    fclose(in);
    fclose(out);
    Rig r;
    char up = rig_open(&r, path, NULL) ? r.figure.up : '?';
    rig_close(&r);
    return up;
}

static void test_turned(void) {
    char toppled = up_turned(-90, vec(0, 150, 300), 0.5), camera = up_turned(180, vec(0, 0, 0), 1e-3);
    char head = up_turned(180, vec(0, 62, 0), 1e-3);
    OK(toppled == 'y', "x is no axis for up, so who lies along it lies, high over zero: up is %c", toppled);
    OK(camera == 'Y', "who stands along -y about the origin is seen by a camera, also for a moment: up is %c", camera);
    OK(head == 'y', "who stands on the head on a floor is upside down: up is %c", head);
}

/* neuron.bvh with the end sites of the feet somewhere else. */
static const char *with_foot_ends(const char *end) {
    const char *path = in_folder("ends.bvh");
    FILE *in = fopen("tests/data/figure/neuron.bvh", "r"), *out = fopen(path, "w");
    char line[4096];
    while (fgets(line, sizeof line, in))
        if (strstr(line, "-6.5000 13.0000")) fprintf(out, "OFFSET %s\n", end);
        else fputs(line, out);
    fclose(in);
    fclose(out);
    return path;
}

/* In the oldest rigs a foot's line goes straight down to the ground. */
static void test_foot_ends(void) {
    static const char *const ends[] = {"0 -8 0", "0 -15 0"};
    for (int i = 0; i < 2; i++) {
        Rig told, found;
        if (!open_both(&told, "tests/data/figure/neuron.bvh", &found, with_foot_ends(ends[i]), ends[i])) return;
        double off = foot_difference(&told, &found);
        OK(strcmp(found.figure.rest, told.figure.rest) == 0, "a line from ankle to ground leaves a T-pose what it is");
        OK(off < 20, "and soles stay flat, but for %.1f degrees: the ankle is higher", off);
        close_both(&told, &found);
    }
}

/* The take of a rig as bare points: the same tree, in which joints have positions only. offsets: or zero. */
static const char *as_points(Rig *r, bool offsets) {
    const char *path = in_folder("points.bvh");
    const Skeleton *s = &r->motion.skeleton;
    FILE *out = fopen(path, "w");
    fputs("HIERARCHY\n", out);
    for (int i = 0; i < s->njoints; i++) {
        const Joint *j = &s->joint[i];
        Vec3 at = offsets ? j->offset : vec(0, 0, 0);
        const char *kind = j->parent < 0 ? "ROOT" : "JOINT";
        if (j->is_end) fprintf(out, "End Site { OFFSET %g %g %g", j->offset.x, j->offset.y, j->offset.z);
        else fprintf(out, "%s %s { OFFSET %g %g %g\nCHANNELS 3 Xposition Yposition Zposition\n", kind, j->name, at.x,
                     at.y, at.z);
        int next = i + 1 < s->njoints ? s->joint[i + 1].parent : -1;
        for (int up = i; up != next; up = s->joint[up].parent) fputs("}\n", out);
    }
    fprintf(out, "MOTION\nFrames: %d\nFrame Time: %g\n", r->motion.nframes, r->motion.frame_time);
    for (int frame = 0; frame < r->motion.nframes; frame++) {
        rig_pose(r, frame);
        for (int i = 0; i < s->njoints; i++) {
            int parent = s->joint[i].parent;
            Vec3 to = parent < 0 ? r->world[i].t : vec_sub(r->world[i].t, r->world[parent].t);
            if (!s->joint[i].is_end) fprintf(out, "%.9g %.9g %.9g ", to.x, to.y, to.z);
        }
        fputs("\n", out);
    }
    fclose(out);
    return path;
}

/* Pelvis and chest turn by where legs, arms and spine begin. A head without eyes says next to nothing. */
static void test_points(void) {
    for (int offsets = 0; offsets < 2; offsets++) {
        Rig told, found;
        if (!OK(rig_open(&told, "tests/data/figure/unity.bvh", NULL), "unity opens")) return;
        if (!OK(rig_open(&found, as_points(&told, offsets), NULL), "and as points")) return;
        double pelvis = turn_difference(&told, &found, ROLE_PELVIS), chest = turn_difference(&told, &found, ROLE_CHEST);
        double foot = foot_difference(&told, &found);
        OK(pelvis < 9 && chest < 9, "points tell how pelvis and chest turn: %.1f and %.1f degrees off", pelvis, chest);
        OK(foot < 9, "and feet with toes: %.1f degrees off", foot);
        close_both(&told, &found);
    }
}

/* Who crouches on the toes for the whole take never shows how trunk, head and feet are at rest: the same take with a
   human zero pose tells. */
static void test_crouch(void) {
    Rig told, found;
    if (!open_both(&told, "tests/data/figure/crouch_tpose.bvh",
                   &found, "tests/data/figure/crouch.bvh", "crouchers")) return;
    OK(turn_difference(&told, &found, ROLE_PELVIS) < 7, "a crouching pelvis turns the same way without a zero pose");
    OK(turn_difference(&told, &found, ROLE_CHEST) < 3, "and the chest");
    OK(turn_difference(&told, &found, ROLE_HEAD) < 13, "and the head");
    OK(foot_difference(&told, &found) < 4, "and the feet point the same way, that never stand flat");
    close_both(&told, &found);
}

/* The same crouch with a first bone of the spine that is short and leads backwards, as to a sacrum. */
static void test_sacrum(void) {
    const char *path = in_folder("sacrum.bvh");
    FILE *in = fopen("tests/data/figure/crouch.bvh", "r"), *out = fopen(path, "w");
    char line[4096];
    for (int spine = 0; fgets(line, sizeof line, in);) {
        bool next = spine == 1 && strstr(line, "OFFSET");
        if (strstr(line, "OFFSET 9.35") || next) spine++;
        fputs(next ? "OFFSET 14.125 0 -2.5\n" : strstr(line, "OFFSET 9.35") ? "OFFSET 5 0 2.5\n" : line, out);
    }
    fclose(in);
    fclose(out);
    Rig told, found;
    if (!open_both(&told, "tests/data/figure/crouch_tpose.bvh", &found, path, "crouchers with a sacrum")) return;
    double off = turn_difference(&told, &found, ROLE_PELVIS);
    OK(off < 9, "a pelvis with a sacrum turns the same way (%.1f degrees)", off);
    close_both(&told, &found);
}

/* The same crouch with a T-pose in front: that frame tells as much as a human zero pose. */
static void test_pose_in_front(void) {
    Rig told, found;
    if (!open_both(&told, "tests/data/figure/crouch_tpose.bvh",
                   &found, "tests/data/figure/crouch_calibrated.bvh", "calibrated crouchers")) return;
    double most = 0;
    for (int frame = 0; frame < told.motion.nframes; frame++) {
        Pose p = rig_pose(&told, frame), q = rig_pose(&found, frame + 1);
        for (int r = 0; r < ROLE_COUNT; r++) most = max_of(most, turned(p.bone[r].r, q.bone[r].r));
    }
    OK(strcmp(found.figure.rest, "T-pose in frame 1") == 0, "rest: %s", found.figure.rest);
    OK(most < 0.5, "behind a T-pose every bone turns as with a human zero pose (%.2f degrees)", most);
    NEAR(found.figure.height, told.figure.height, 1e-4, "and the stature is the same");
    close_both(&told, &found);
}

/* Writes a motion of a rig again, its head turned about an axis by so many degrees in all frames. */
static void write_turned_head(Rig *r, const char *from, const char *path, ChannelKind axis, double degrees) {
    FILE *in = fopen(from, "r"), *out = fopen(path, "w");
    char line[4096];
    do fputs(fgets(line, sizeof line, in), out);
    while (!strstr(line, "Frame Time"));
    const Joint *head = &r->motion.skeleton.joint[r->roles.joint[ROLE_HEAD]];
    for (int frame = 0; frame < r->motion.nframes; frame++) {
        if (!motion_row(r->reader, frame, r->row, &r->e)) break;
        for (int c = 0; c < head->nchannels; c++)
            if (head->channel[c] == axis) r->row[head->first_channel + c] += degrees;
        for (int c = 0; c < r->motion.skeleton.nchannels; c++) fprintf(out, "%.9g ", r->row[c]);
        fprintf(out, "\n");
    }
    fclose(in);
    fclose(out);
}

/* Who looks aside for the whole take is not taken for one who looks ahead. */
static void test_look_aside(void) {
    const char *ahead = "tests/data/figure/lafan1.bvh", *path = in_folder("aside.bvh");
    Rig told, found;
    if (!OK(rig_open(&told, ahead, NULL), "lafan1 opens")) return;
    write_turned_head(&told, ahead, path, CHANNEL_RX, 40);
    OK(rig_open(&found, path, NULL), "and with its head turned");
    NEAR(turn_difference(&told, &found, ROLE_HEAD), 40, 2, "a head that is turned aside in all frames is aside");
    rig_close(&found);
    write_turned_head(&told, ahead, path, CHANNEL_RZ, 80);
    OK(rig_open(&found, path, NULL), "and with its head's axes tipped over");
    NEAR(turn_difference(&told, &found, ROLE_HEAD), 0, 12, "nobody looks at the own feet all the time");
    close_both(&told, &found);
}

/* Feet lie along the shins of one who kneels, and look back: a moment of standing tells where they point. */
static void test_kneel(void) {
    Rig told, found;
    if (!open_both(&told, "tests/data/figure/kneel_tpose.bvh",
                   &found, "tests/data/figure/kneel.bvh", "kneelers")) return;
    double off = foot_difference(&told, &found);
    OK(off < 16, "the feet of one who kneels point the same way without a zero pose (%.1f degrees)", off);
    close_both(&told, &found);
}

/* Feet that stand flat far apart, under shins that slant: the floor tells what is up for them, not the shins. */
static void test_horse_stance(void) {
    Rig told, found;
    if (!open_both(&told, "tests/data/figure/horse_tpose.bvh",
                   &found, "tests/data/figure/horse.bvh", "riders without a horse")) return;
    double left = turn_difference(&told, &found, ROLE_LEFT_FOOT);
    double right = turn_difference(&told, &found, ROLE_RIGHT_FOOT);
    OK(max_of(left, right) < 4, "feet under slanting shins lie flat (%.1f and %.1f degrees)", left, right);
    close_both(&told, &found);
}

/* Writes the last n frames of a motion. */
static const char *write_last(const char *from, const char *name, int n) {
    const char *path = in_folder(name);
    FILE *in = fopen(from, "r"), *out = fopen(path, "w");
    char line[4096];
    int frames = 0, row = -1;
    while (fgets(line, sizeof line, in)) {
        bool count = sscanf(line, "Frames: %d", &frames) == 1;
        if (count) fprintf(out, "Frames: %d\n", n);
        else if (row < 0 || row >= frames - n) fputs(line, out);
        if (row >= 0 || strstr(line, "Frame Time")) row++;
    }
    fclose(in);
    fclose(out);
    return path;
}

/* Who only kneels has the feet along the shins throughout: their left is where the hips have it. */
static void test_only_kneel(void) {
    Rig told, found;
    bool good = rig_open(&found, write_last("tests/data/figure/kneel.bvh", "kneel.bvh", 4), NULL) &&
                rig_open(&told, "tests/data/figure/kneel_tpose.bvh", NULL);
    if (!OK(good && found.motion.nframes == 4, "who only kneels opens")) return;
    double most = 0;
    for (int frame = 0; frame < 4; frame++) {
        Pose p = rig_pose(&told, told.motion.nframes - 4 + frame), q = rig_pose(&found, frame);
        for (int foot = ROLE_LEFT_FOOT; foot <= ROLE_RIGHT_FOOT; foot += ROLE_RIGHT_FOOT - ROLE_LEFT_FOOT)
            most = max_of(most, turned(p.bone[foot].r, q.bone[foot].r));
    }
    OK(most < 16, "the feet of one who only kneels lie as they do (%.1f degrees)", most);
    close_both(&told, &found);
}

/* A copy of a motion in which every end site is at the same offset from its joint. */
static const char *with_ends(const char *from, const char *offset) {
    const char *path = in_folder("ends.bvh");
    FILE *in = fopen(from, "r"), *out = fopen(path, "w");
    char line[4096];
    bool in_end = false;
    while (fgets(line, sizeof line, in)) {
        bool is_offset = strstr(line, "OFFSET") != NULL;
        in_end |= strstr(line, "End Site") != NULL;
        if (is_offset && in_end) fprintf(out, "OFFSET %s\n", offset);
        else fputs(line, out);
        in_end = in_end && !is_offset;
    }
    fclose(in);
    fclose(out);
    return path;
}

/* Writers that know no ends of bones write any. Feet with toes, in metres, and without, in centimetres. */
static void test_ends(void) {
    static const struct { const char *file, *offset; } cases[] = {
        {"tests/data/figure/smpl.bvh", "0 0.15 0"}, {"tests/data/figure/neuron.bvh", "0 15 0"},
        {"tests/data/figure/neuron.bvh", "0 0 -0.001"}, {"tests/data/figure/lafan1.bvh", "0 15 0"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        Rig told, any;
        if (!open_both(&told, cases[i].file, &any, with_ends(cases[i].file, cases[i].offset), cases[i].file)) continue;
        double feet = foot_difference(&told, &any);
        OK(strcmp(told.figure.rest, any.figure.rest) == 0, "with ends at %s the rest pose is as good", cases[i].offset);
        OK(feet < 5, "and feet point the same way, within %.1f degrees", feet);
        close_both(&told, &any);
    }
}

int main(void) {
    if (!folder_make()) return 1;
    test_lying();
    test_ends();
    test_turned();
    test_foot_ends();
    test_points();
    test_crouch();
    test_sacrum();
    test_pose_in_front();
    test_look_aside();
    test_horse_stance();
    test_kneel();
    test_only_kneel();
    folder_remove();
    return tap_done();
}
