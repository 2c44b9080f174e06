/* The shared real motions, if they are there: each opens without a warning, with the joints,
   channels and frames that are known of it; rows can be posed. KITSUKE_MOTIONS names the folder. */
#include <stdlib.h>
#include <unistd.h>

#include "motion/motion.h"
#include "session.h"
#include "tap.h"

typedef struct {
    const char *file;
    int joints, ends, channels, frames;
    double frame_time;
    bool adds;
} Known;

static const Known known[] = {
    {"cmu_daz_02_03_run.bvh", 43, 14, 132, 174, 0.00833333, false},
    {"cmu_daz_02_04_jump_balance.bvh", 43, 14, 132, 484, 0.00833333, false},
    {"cmu_daz_03_01_uneven_terrain.bvh", 43, 14, 132, 433, 0.00833333, false},
    {"cmu_daz_05_06_cartwheel_pirouette.bvh", 43, 14, 132, 886, 0.00833333, false},
    {"cmu_daz_07_12_brisk_walk.bvh", 43, 14, 132, 264, 0.00833333, false},
    {"cmu_daz_13_35_climb_steps.bvh", 43, 14, 132, 1202, 0.00833333, false},
    {"cmu_daz_114_16_sit_stretch.bvh", 43, 14, 132, 1000, 0.00833333, false},
    {"cmu_mb_12_01_walk.bvh", 31, 7, 96, 524, 0.0083333, false},
    {"cmu_mb_jumping_jacks.bvh", 31, 7, 96, 125, 0.03333, false},
    {"fair1_dab.bvh", 27, 7, 84, 339, 0.0333333, false},
    {"rokoko_jesse_dance.bvh", 60, 13, 183, 1007, 0.01, false},
    {"mixamorig_freebvh.bvh", 55, 15, 168, 69, 0.0333333, false},
    {"mocapbank_crlf.bvh", 19, 5, 60, 455, 0.033333, false},
    {"toolbox_walk01.bvh", 19, 5, 60, 101, 0.0416667, false},
    {"pymo_8walk.bvh", 23, 7, 72, 1064, 0.008333, false},
    {"pybvh_test2.bvh", 23, 5, 72, 61, 0.008333, false},
    {"pybvh_test3_fingers.bvh", 60, 13, 183, 100, 0.008333, false},
    {"dfki_custom_skeleton_walk.bvh", 78, 17, 237, 47, 0.013888888888888888, true},
    {"dfki_game_engine_walk.bvh", 31, 7, 96, 47, 0.013888888888888888, true},
    {"makehuman_sit01.bvh", 163, 49, 978, 1, 0.041667, true},
    {"bandai1_kick_normal_001_NC.bvh", 22, 5, 132, 358, 0.0333333, false},
    {"bandai1_bow_normal_001_NC.bvh", 22, 5, 132, 138, 0.0333333, false},
    {"bandai2_walk_turn_left_normal_001_NC.bvh", 22, 5, 132, 102, 0.0333333, false},
    {"fairmotion_sinusoidal_noend.bvh", 4, 0, 15, 120, 0.016666666666666666, false},
    {"cmu_02_03_run.amc", 31, 7, 62, 173, 1.0 / 120, false},
    {"cmu_11_01_kick.amc", 31, 7, 62, 597, 1.0 / 120, false},
};

static const char *folder;

static Session session, other;

/* The path is good as long as the program runs. */
static bool open_shared(Session *s, const char *file) {
    static char path[2][1024];
    char *p = path[s == &other];
    snprintf(p, sizeof path[0], "%s/%s", folder, file);
    return session_open(s, p, (MotionOptions){0});
}

static bool poses_are_finite(Session *s) {
    for (int f = 0; f < s->motion.nframes; f++) {
        if (!session_pose(s, f)) return false;
        for (int i = 0; i < s->motion.skeleton.njoints; i++)
            if (!vec_finite(s->world[i].t)) return false;
    }
    return true;
}

static void test_known(const Known *k) {
    Session *s = &session;
    bool good = open_shared(s, k->file);
    const Skeleton *a = &s->motion.skeleton;
    int ends = 0;
    for (int i = 0; i < a->njoints && good; i++) ends += a->joint[i].is_end;
    if (good && !(a->njoints - ends == k->joints && ends == k->ends && a->nchannels == k->channels &&
                  s->motion.nframes == k->frames))
        good = printf("# %d joints, %d ends, %d channels, %d frames\n", a->njoints - ends, ends, a->nchannels,
                      s->motion.nframes) < 0;
    good = good && s->motion.frame_time == k->frame_time && a->position_adds == k->adds && s->notes.count == 0 &&
        poses_are_finite(s);
    OK(good, "%s %s", k->file, s->e.text);
    session_close(s);
}

/* The same take as BVH and as AMC; the BVH has a T-pose in front. Root angles agree to the
   digits that the BVH has. */
static void test_pair(void) {
    bool good = open_shared(&session, "cmu_daz_02_03_run.bvh") && open_shared(&other, "cmu_02_03_run.amc");
    double most = good ? 0 : 1e9;
    for (int f = 0; f < other.motion.nframes && good; f++) {
        good = session_pose(&session, f + 1) && session_pose(&other, f);
        for (int i = 0; i < 3; i++) most = max_of(most, vec_dist(session.world[0].r.r[i], other.world[0].r.r[i]));
    }
    NEAR(most, 0, 2e-6, "run.bvh and run.amc turn their root the same way");
    session_close(&session);
    session_close(&other);
}

/* A runner's stance foot rests: with any other order of rotations it slides three times as fast.
   Speeds of the toes in metres per second, the slowest twentieth of the frames. */
static void test_stance(void) {
    enum { MOST = 256 };
    double speed[MOST] = {0}, slow = 1e9;
    Vec3 before = {0};
    int n = 0;
    bool good = open_shared(&session, "cmu_02_03_run.amc");
    int toe = good ? skeleton_find(&session.motion.skeleton, "rtoes_End") : 0;
    for (int f = 0; good && f < session.motion.nframes && f < MOST; f++) {
        good = session_pose(&session, f);
        if (f) speed[n++] = vec_dist(session.world[toe].t, before) * session.motion.file_unit * 120;
        before = session.world[toe].t;
    }
    for (int k = 0; k <= n / 20; k++) { /* the k-th slowest */
        int at = k;
        for (int i = k; i < n; i++)
            if (speed[i] < speed[at]) at = i;
        slow = speed[at];
        speed[at] = speed[k];
        speed[k] = slow;
    }
    OK(good && slow < 0.2, "the stance foot rests (%.2f m/s)", slow);
    session_close(&session);
}

int main(void) {
    folder = getenv("KITSUKE_MOTIONS");
    if (!folder) folder = "../shared/motions";
    if (access(folder, R_OK) != 0) {
        printf("1..0 # SKIP the shared motions are not here\n");
        return 0;
    }
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) test_known(&known[i]);
    test_pair();
    test_stance();
    return tap_done();
}
