/* Forward kinematics against matrices written out by hand. */
#include "motion/skeleton.h"

#include "tap.h"

static double worst(Mat3 a, Mat3 b) {
    double most = 0;
    for (int i = 0; i < 3; i++) {
        Vec3 d = vec_sub(a.r[i], b.r[i]);
        most = max_of(most, max_of(fabs(d.x), max_of(fabs(d.y), fabs(d.z))));
    }
    return most;
}

/* The three rotations as they stand in every book. */
static Mat3 about(ChannelKind kind, double degrees) {
    double a = degrees * PI / 180, c = cos(a), s = sin(a);
    if (kind == CHANNEL_RX) return (Mat3){{{1, 0, 0}, {0, c, -s}, {0, s, c}}};
    if (kind == CHANNEL_RY) return (Mat3){{{c, 0, s}, {0, 1, 0}, {-s, 0, c}}};
    return (Mat3){{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
}

static Joint joint(const char *name, int parent, Vec3 offset, int n, const ChannelKind *channel, int first) {
    Joint j = {.name = name, .parent = parent, .offset = offset, .axis = mat_identity(), .nchannels = n,
               .first_channel = first};
    for (int i = 0; i < n; i++) j.channel[i] = channel[i];
    return j;
}

static Rigid pose_one(Joint j, const double *row, bool adds) {
    Skeleton s = {1, j.nchannels, &j, adds, false};
    Rigid world;
    skeleton_pose(&s, row, &world);
    return world;
}

/* Every list of three axes, also with one twice, which some files have. */
static void test_orders(void) {
    const double row[3] = {20, -75, 140};
    const ChannelKind axis[] = {CHANNEL_RX, CHANNEL_RY, CHANNEL_RZ};
    for (int code = 0; code < 27; code++) {
        ChannelKind c[3] = {axis[code / 9], axis[code / 3 % 3], axis[code % 3]};
        Mat3 wanted = mat_mul(about(c[0], row[0]), mat_mul(about(c[1], row[1]), about(c[2], row[2])));
        Mat3 got = pose_one(joint("a", -1, vec(0, 0, 0), 3, c, 0), row, false).r;
        const char name[] = {"XYZ"[c[0] - CHANNEL_RX], "XYZ"[c[1] - CHANNEL_RX], "XYZ"[c[2] - CHANNEL_RX], 0};
        NEAR(worst(got, wanted), 0, 1e-15, name);
    }
}

/* ZXY multiplied out on paper, so that not even the order of a product is taken on trust. */
static void test_zxy(void) {
    static const ChannelKind zxy[] = {CHANNEL_RZ, CHANNEL_RX, CHANNEL_RY};
    const double row[3] = {30, 50, -20}, k = PI / 180;
    double cz = cos(30 * k), sz = sin(30 * k), cx = cos(50 * k), sx = sin(50 * k), cy = cos(-20 * k), sy = sin(-20 * k);
    Mat3 wanted = {{{cz * cy - sz * sx * sy, -sz * cx, cz * sy + sz * sx * cy},
                    {sz * cy + cz * sx * sy, cz * cx, sz * sy - cz * sx * cy},
                    {-cx * sy, sx, cx * cy}}};
    NEAR(worst(pose_one(joint("a", -1, vec(0, 0, 0), 3, zxy, 0), row, false).r, wanted), 0, 1e-15, "ZXY on paper");
    static const ChannelKind scaled[] = {CHANNEL_SX, CHANNEL_RZ, CHANNEL_SY, CHANNEL_RX, CHANNEL_RY};
    const double quarter[3] = {90, 90, 0}; /* x goes to x, then to y; y goes to z and stays */
    const double among[5] = {2, 90, 3, 90, 0};
    Mat3 r = pose_one(joint("a", -1, vec(0, 0, 0), 3, zxy, 0), quarter, false).r;
    NEAR(vec_dist(mat_apply(r, vec(1, 0, 0)), vec(0, 1, 0)), 0, 1e-15, "two quarter turns take x to y");
    NEAR(vec_dist(mat_apply(r, vec(0, 1, 0)), vec(0, 0, 1)), 0, 1e-15, "and y to z");
    NEAR(worst(pose_one(joint("a", -1, vec(0, 0, 0), 5, scaled, 0), among, false).r, r), 0, 0,
         "scales among the rotations change nothing");
}

static void test_positions(void) {
    static const ChannelKind all[] = {CHANNEL_TZ, CHANNEL_RY, CHANNEL_TX, CHANNEL_TY}, height[] = {CHANNEL_TY};
    const double row[4] = {30, 90, 10, 20}, five[1] = {5};
    Vec3 offset = vec(1, 2, 3);
    NEAR(vec_dist(pose_one(joint("a", -1, offset, 4, all, 0), row, false).t, vec(10, 20, 30)), 0, 0,
         "positions replace, in any order");
    NEAR(vec_dist(pose_one(joint("a", -1, offset, 4, all, 0), row, true).t, vec(11, 22, 33)), 0, 0, "positions add");
    NEAR(vec_dist(pose_one(joint("a", -1, offset, 1, height, 0), five, false).t, vec(1, 5, 3)), 0, 0,
         "one of them replaces one");
    NEAR(vec_dist(pose_one(joint("a", -1, offset, 0, NULL, 0), row, false).t, offset), 0, 0, "none leaves the OFFSET");
}

/* Root turned a quarter about z, elbow about x; an end site follows its parent. */
static void test_chain(void) {
    static const ChannelKind z[] = {CHANNEL_RZ}, x[] = {CHANNEL_RX};
    Joint j[4] = {joint("root", -1, vec(1, 0, 0), 1, z, 0), joint("arm", 0, vec(2, 0, 0), 1, x, 1),
                  joint("hand", 1, vec(0, 3, 0), 0, NULL, 2), joint("hand_End", 2, vec(0, 1, 0), 0, NULL, 2)};
    j[3].is_end = true;
    Skeleton s = {4, 2, j, false, false};
    const double row[2] = {90, 90};
    Rigid w[4];
    skeleton_pose(&s, row, w);
    NEAR(vec_dist(w[1].t, vec(1, 2, 0)), 0, 1e-15, "the arm hangs on the turned root");
    NEAR(vec_dist(w[2].t, vec(1, 2, 3)), 0, 1e-15, "the hand on the turned arm");
    NEAR(vec_dist(w[3].t, vec(1, 2, 4)), 0, 1e-15, "the end site goes on as the hand does");
    OK(skeleton_find(&s, "hand_End") == 3 && skeleton_find(&s, "hand_end") == -1, "names are found exactly");
}

/* ASF: the same turn, told in a frame that is turned itself. About x in a frame turned by a
   quarter about z is about y. */
static void test_axis(void) {
    static const ChannelKind x[] = {CHANNEL_RX};
    const double row[1] = {35};
    Joint j = joint("a", -1, vec(0, 0, 0), 1, x, 0);
    j.has_axis = true;
    j.axis = about(CHANNEL_RZ, 90);
    NEAR(worst(pose_one(j, row, false).r, about(CHANNEL_RY, 35)), 0, 1e-15, "x of a turned axis is y");
}

/* Hips with a spine and two legs, a shin and an end site; only positions move them. */
static void test_points(void) {
    static const ChannelKind xyz[] = {CHANNEL_TX, CHANNEL_TY, CHANNEL_TZ};
    Vec3 offset[6] = {{0, 0, 0}, {0, 3, 0.5}, {1, -0.2, 0}, {0, -4, 0}, {0, -1, 0}, {-1, -0.2, 0}};
    static const int parent[6] = {-1, 0, 0, 2, 3, 0}, first[6] = {0, 3, 6, 9, 12, 12};
    Joint j[6];
    double row[15] = {7, 8, 9};
    Rigid w[6];
    for (int i = 0; i < 6; i++) j[i] = joint("j", parent[i], offset[i], i == 4 ? 0 : 3, xyz, first[i]);
    j[4].is_end = true;
    Skeleton s = {6, 15, j, false, true};
    for (int k = 0; k < 4; k++) { /* also half a turn, where small turns would not know which way */
        Mat3 hips = mat_mul(about(CHANNEL_RY, 60 * k), about(CHANNEL_RX, 25));
        Mat3 thigh = mat_mul(hips, about(CHANNEL_RX, -80));
        for (int i = 1; i < 6; i++) {
            Vec3 to = mat_apply(i == 3 ? thigh : hips, offset[i]);
            if (i != 4) row[first[i]] = to.x, row[first[i] + 1] = to.y, row[first[i] + 2] = to.z;
        }
        skeleton_pose(&s, row, w);
        NEAR(worst(w[0].r, hips), 0, 1e-9, "hips turn as spine and legs say");
        NEAR(worst(w[2].r, thigh), 0, 1e-9, "a thigh by the smallest turn from them");
        NEAR(vec_dist(w[4].t, rigid_apply((Rigid){thigh, w[3].t}, offset[4])), 0, 1e-9, "an end goes on as the joint");
    }
}

int main(void) {
    test_orders();
    test_zxy();
    test_positions();
    test_chain();
    test_axis();
    test_points();
    return tap_done();
}
