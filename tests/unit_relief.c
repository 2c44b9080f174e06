/* The turns of arms over a motion: never less than a frame needs, smooth, and of the frame alone. */
#include "app/relief.h"

#include "folder.h"
#include "rig.h"
#include "tap.h"

enum { FRAMES_MOST = 200 };

typedef struct {
    Rig rig;
    Body body;
    Padding padding;
    int count;
    double need[FRAMES_MOST][ARMS * TURNS], turn[FRAMES_MOST][ARMS * TURNS];
} Scene;

static Relief *open_relief(Scene *s) {
    Relief *r;
    Error e = {0};
    if (relief_open(&s->rig.motion, &s->rig.figure, &s->body, &s->padding, false, &s->rig.arena, &r, &e)) return r;
    printf("# %s\n", e.text);
    exit(1);
}

static void copy(const ArmTurn from[ARMS], double to[ARMS * TURNS]) {
    for (int i = 0; i < ARMS * TURNS; i++) to[i] = from[i / TURNS].angle[i % TURNS];
}

/* A walk in cloth so wide that the swinging arms touch it again and again. */
static void open_scene(Scene *s, const char *path) {
    Error e = {0};
    if (!rig_open(&s->rig, path, NULL) ||
        !body_fit(body_default(), &s->rig.figure, 16, &s->rig.arena, &s->body, &e))
        exit(1);
    for (int r = 0; r < ROLE_COUNT; r++)
        for (int k = 0; k < PADDING_PLACES; k++)
            s->padding.side[r][k] = r == ROLE_LEFT_THIGH || r == ROLE_PELVIS ? 0.12 : 0;
    Relief *r = open_relief(s);
    s->count = s->rig.motion.nframes;
    for (int f = 0; f < s->count && f < FRAMES_MOST; f++) {
        ArmTurn turn[ARMS];
        Pose pose = rig_pose(&s->rig, f);
        relax_find(&s->rig.figure, &s->body, &s->padding, &pose, turn);
        copy(turn, s->need[f]);
        if (!relief_at(r, f, turn, &e)) exit(1);
        copy(turn, s->turn[f]);
    }
    relief_close(r);
}

static void test_enough(const Scene *s) {
    double least = 90, most = 0, jerk = 0, rough = 0;
    for (int f = 0; f < s->count; f++)
        for (int i = 0; i < ARMS * TURNS; i++) {
            least = min_of(least, s->turn[f][i] - s->need[f][i]);
            most = max_of(most, s->turn[f][i]);
            if (f < 2) continue;
            jerk = max_of(jerk, fabs(s->turn[f][i] - 2 * s->turn[f - 1][i] + s->turn[f - 2][i]));
            rough = max_of(rough, fabs(s->need[f][i] - 2 * s->need[f - 1][i] + s->need[f - 2][i]));
        }
    OK(most > 3 && least > -1e-9, "of %.1f degrees at most no frame gets less than it needs", most);
    OK(jerk < 0.1 && jerk < 0.2 * rough, "second differences: %.3f degrees, of the bare needs %.3f", jerk, rough);
}

/* Largest difference to the turns of all frames, asked for from `first` on with that step. */
static double difference(Scene *s, int first, int step) {
    Relief *r = open_relief(s);
    Error e = {0};
    double most = 0;
    for (int f = first; f < s->count; f += step) {
        ArmTurn turn[ARMS];
        double now[ARMS * TURNS];
        if (!relief_at(r, f, turn, &e)) return 1;
        copy(turn, now);
        for (int i = 0; i < ARMS * TURNS; i++) most = max_of(most, fabs(now[i] - s->turn[f][i]));
    }
    relief_close(r);
    return most;
}

static void test_alone(Scene *s) {
    double most = 0;
    for (int first = 0; first < s->count; first += 7)
        for (int step = 1; step < 72; step = 2 * step + 1) most = max_of(most, difference(s, first, step));
    OK(most == 0, "the turn of a frame is the same to the last bit whatever else is asked for");
}

/* A motion whose figure stands 30 m aside in two frames. */
enum { ASTRAY = 30, BACK = 32 };
static const char *write_astray(const char *path) {
    char line[4096];
    const char *name = in_folder("astray.bvh");
    FILE *in = fopen(path, "r"), *out = fopen(name, "w");
    if (!in || !out) exit(1);
    for (int frame = -1; fgets(line, sizeof line, in);) {
        if (frame >= ASTRAY && frame < BACK) fputs("3000", out);
        fputs(frame >= ASTRAY && frame < BACK ? strchr(line, ' ') : line, out);
        if (frame >= 0 || strncmp(line, "Frame Time", 10) == 0) frame++;
    }
    fclose(in);
    fclose(out);
    return name;
}

static void test_astray(const Scene *plain) {
    static Scene s;
    double off = 0, jerk = 0;
    open_scene(&s, write_astray("motions/paper-walk.bvh"));
    for (int f = 0; f < s.count; f++)
        for (int i = 0; i < ARMS * TURNS && (f < ASTRAY || f >= BACK); i++) {
            off = max_of(off, fabs(s.turn[f][i] - plain->turn[f][i]));
            if (f == BACK) jerk = max_of(jerk, fabs(s.turn[f][i] - s.turn[ASTRAY - 1][i]));
        }
    OK(s.count == plain->count && off < 0.5 && jerk < 0.5,
       "arms turn on past frames that are astray (%.2f degrees across them, %.2f off)", jerk, off);
    test_alone(&s);
    rig_close(&s.rig);
}

int main(void) {
    static Scene scene;
    if (!folder_make()) return 1;
    open_scene(&scene, "motions/paper-walk.bvh");
    test_enough(&scene);
    test_alone(&scene);
    test_astray(&scene);
    rig_close(&scene.rig);
    folder_remove();
    return tap_done();
}
