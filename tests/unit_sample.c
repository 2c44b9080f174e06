/* Frames of a motion that stand for all, and what is read from them. */
#include "figure/sample.h"

#include "dice.h"
#include "rig.h"
#include "tap.h"

enum { JOINTS = 6 };

static Rigid at(Vec3 p) { return (Rigid){mat_identity(), p}; }

/* Frames that a motion of that many gives: the last one always, the first one only where there are few. */
static void spreads_evenly(void) {
    Rig r;
    Sample s;
    if (!OK(rig_open(&r, "motions/paper-walk.bvh", NULL), "the walk opens")) return;
    int given = r.motion.nframes, n = r.motion.skeleton.njoints;
    for (int frames = 1; frames <= given; frames = frames < 9 ? frames + 1 : given + (frames == given)) {
        Motion m = r.motion;
        m.nframes = frames;
        if (!OK(sample_read(&m, 6, &r.arena, &s, &r.e), "%d frames are sampled", frames)) continue;
        int first = frames < 8 ? 0 : 1, wrong = s.count != (frames - first < 6 ? frames - first : 6);
        int last = s.count > 1 ? frames - 1 : first + (frames - first) / 2;
        wrong += s.frame[s.count - 1] != last || (s.count > 1 && s.frame[0] != first);
        int least = given, most = 0;
        for (int i = 1; i < s.count; i++) {
            int gap = s.frame[i] - s.frame[i - 1];
            least = gap < least ? gap : least;
            most = gap > most ? gap : most;
        }
        OK(wrong == 0 && (s.count < 2 || most - least <= 1), "evenly, from frame %d on", first);
        for (int i = 0; i < s.count; i++) {
            (void)rig_pose(&r, s.frame[i]);
            wrong += vec_dist(r.world[n - 1].t, sample_point(&s, i, n - 1)) != 0;
        }
        (void)rig_pose(&r, 0);
        OK(wrong == 0 && vec_dist(r.world[n - 1].t, s.first[n - 1].t) == 0, "they are those frames, `first` the first");
    }
    Vec3 sum = {0, 0, 0};
    for (int j = n - 1; j >= 0; j = r.motion.skeleton.joint[j].parent)
        sum = vec_add(sum, r.motion.skeleton.joint[j].offset);
    NEAR(vec_dist(s.zero[n - 1].t, sum), 0, 1e-9, "in the zero pose a joint is where the OFFSETs say");
    rig_close(&r);
}

static void finds_the_best(void) {
    int wrong = 0;
    for (int round = 0; round < 500; round++) {
        double score[SAMPLE_FRAMES_MAX];
        int out[SAMPLE_BEST_MAX], count = 1 + (int)dice_below(SAMPLE_FRAMES_MAX);
        Sample s = {.count = count};
        for (int i = 0; i < count; i++) score[i] = dice_below(20); /* equal ones too */
        int n = sample_best(&s, score, out), quarter = count / 4, least = count < 3 ? count : 3;
        wrong += n != (quarter > least ? quarter : least);
        for (int k = 1; k < n; k++) wrong += score[out[k]] > score[out[k - 1]];
        int better = 0, chosen[SAMPLE_FRAMES_MAX] = {0};
        for (int k = 0; k < n; k++) wrong += chosen[out[k]]++;
        for (int i = 0; i < count; i++) better += !chosen[i] && score[i] > score[out[n - 1]];
        wrong += better;
    }
    OK(wrong == 0, "a quarter, best first, each once, and none that is left out is better (%d wrong)", wrong);
}

/* Every fourth frame: a flat foot on the floor; between them it is raised, or on its tip. */
static void finds_who_stands(void) {
    enum { FRAMES = 24 };
    Rigid world[FRAMES * 2];
    int out[SAMPLE_BEST_MAX], wrong = 0;
    for (int i = 0; i < FRAMES; i++) {
        double lift = i % 4 == 1 ? 0.3 : 0, tilt = i % 4 == 2 ? 0.15 : i % 4 == 3 ? -0.1 : 0;
        world[2 * i] = at(vec(0, 0, -(lift + 0.08 + tilt + 0.001 * i))); /* -z is up */
        world[2 * i + 1] = at(vec(0, 0.2, -(lift + 0.001 * i)));
    }
    Sample s = {.count = FRAMES, .njoints = 2, .world = world};
    Mat3 upright = mat_columns(vec(1, 0, 0), vec(0, 0, 1), vec(0, -1, 0));
    int n = sample_standing(&s, upright, 0, 1, 0.08, out);
    for (int k = 0; k < n; k++) wrong += out[k] % 4 != 0;
    OK(n == 6 && wrong == 0, "feet that stand flat are found (%d of %d are others)", wrong, n);
}

static void finds_tips(void) {
    int wrong = 0, none = 0;
    for (int round = 0; round < 2000; round++) {
        Joint joint[JOINTS];
        Rigid world[JOINTS];
        Skeleton skeleton = {.njoints = JOINTS, .joint = joint};
        Sample s = {.count = 1, .njoints = JOINTS, .world = world};
        for (int j = 0; j < JOINTS; j++) {
            joint[j] = (Joint){.parent = j ? (int)dice_below((unsigned)j) : -1};
            world[j] = at(j && dice_below(3) == 0 ? world[joint[j].parent].t : dice_point());
        }
        int from = (int)dice_below(JOINTS / 2), tip = -1;
        double limit = dice_unit(), farthest = 0;
        for (int j = 0; j < JOINTS; j++) {
            int k = j;
            while (k > from) k = joint[k].parent;
            double d = vec_dist(world[j].t, world[from].t);
            if (k == from && d > farthest && d <= limit) farthest = d, tip = j;
        }
        wrong += sample_tip(&s, &skeleton, from, limit) != tip;
        none += tip < 0;
    }
    OK(wrong == 0 && none > 100, "the farthest joint below, but not too far (%d wrong, %d have none)", wrong, none);
    Sample empty = {.count = 0};
    Joint lone = {.parent = -1};
    OK(sample_tip(&empty, &(Skeleton){.njoints = 1, .joint = &lone}, 0, 1) == -1, "no frames, no tip");
}

static void measures(void) {
    Rigid world[4] = {at(vec(0, 0, 0)), at(vec(3, 4, 0)), at(vec(1, 0, 0)), at(vec(1, 1, 0))};
    Sample s = {.count = 2, .njoints = 2, .world = world};
    NEAR(sample_distance(&s, 0, 1), 3, 1e-12, "distances are means over the frames");
}

int main(void) {
    spreads_evenly();
    finds_the_best();
    finds_who_stands();
    finds_tips();
    measures();
    return tap_done();
}
