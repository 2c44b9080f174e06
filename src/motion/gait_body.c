/* A walker sized by stature: every length is a fraction of it, after Drillis and Contini, so
   that a child and a tall adult walk alike. The names are those that MotionBuilder and
   Blender users know. */
#include "motion/gait_body.h"

static const struct { const char *name; int parent; } JOINT[GAIT_JOINTS] = {
    {"Hips", -1}, {"Spine", GAIT_HIPS}, {"Spine1", GAIT_SPINE}, {"Neck", GAIT_CHEST}, {"Head", GAIT_NECK},
    {"LeftShoulder", GAIT_CHEST}, {"LeftArm", GAIT_CLAVICLE}, {"LeftForeArm", GAIT_ARM},
    {"LeftHand", GAIT_FOREARM},
    {"RightShoulder", GAIT_CHEST}, {"RightArm", GAIT_RIGHT_CLAVICLE}, {"RightForeArm", GAIT_RIGHT_ARM},
    {"RightHand", GAIT_RIGHT_FOREARM},
    {"LeftUpLeg", GAIT_HIPS}, {"LeftLeg", GAIT_THIGH}, {"LeftFoot", GAIT_SHIN}, {"LeftToeBase", GAIT_FOOT},
    {"RightUpLeg", GAIT_HIPS}, {"RightLeg", GAIT_RIGHT_THIGH}, {"RightFoot", GAIT_RIGHT_SHIN},
    {"RightToeBase", GAIT_RIGHT_FOOT},
};

enum { ARM_JOINTS = GAIT_RIGHT_ARM - GAIT_ARM, LEG_JOINTS = GAIT_RIGHT_THIGH - GAIT_THIGH };

/* Heights of Drillis and Contini: hip 0.530, knee 0.285, ankle 0.039, shoulder 0.818; upper
   arm 0.186, forearm 0.146, hand 0.108, foot 0.152. They give the breadths of hips and
   shoulders over the skin (0.191, 0.259); the joints lie inside. */
GaitBody gait_body(double height) {
    GaitBody b = {.height = height};
    double h = height;
    b.hip = 0.052 * h;
    b.thigh = (0.530 - 0.285) * h;
    b.shin = (0.285 - 0.039) * h;
    b.ankle = 0.039 * h;
    b.heel = 0.038 * h;
    b.ball = 0.071 * h;
    b.toe = 0.114 * h;
    b.ball_height = 0.011 * h;

    b.stand = 0.530 * h;
    b.offset[GAIT_SPINE] = vec(0, 0.055 * h, 0);
    b.offset[GAIT_CHEST] = vec(0, 0.115 * h, 0);
    b.offset[GAIT_NECK] = vec(0, 0.138 * h, 0);
    b.offset[GAIT_HEAD] = vec(0, 0.052 * h, 0.006 * h);
    b.tip[GAIT_HEAD] = vec(0, 0.110 * h, 0);
    for (int side = 0; side < GAIT_SIDES; side++) {
        double left = side == GAIT_LEFT ? 1 : -1;
        Vec3 *arm = b.offset + GAIT_CLAVICLE + side * ARM_JOINTS, *leg = b.offset + GAIT_THIGH + side * LEG_JOINTS;
        arm[0] = vec(left * 0.020 * h, 0.108 * h, 0);
        arm[1] = vec(left * 0.085 * h, 0.010 * h, 0);
        arm[2] = vec(left * 0.186 * h, 0, 0);
        arm[3] = vec(left * 0.146 * h, 0, 0);
        b.tip[GAIT_HAND + side * ARM_JOINTS] = vec(left * 0.108 * h, 0, 0);
        leg[0] = vec(left * b.hip, 0, 0);
        leg[1] = vec(0, -b.thigh, 0);
        leg[2] = vec(0, -b.shin, 0);
        leg[3] = vec(0, b.ball_height - b.ankle, b.ball);
        b.tip[GAIT_TOE + side * LEG_JOINTS] = vec(0, 0, b.toe - b.ball);
    }
    return b;
}

void gait_pose_arm(GaitPose *pose, int side, double flexion, double abduction, double elbow) {
    Vec3 *arm = pose->turn + GAIT_ARM + side * ARM_JOINTS;
    double left = side == GAIT_LEFT ? 1 : -1;
    arm[0] = vec(-flexion, 0, left * (abduction - 90));
    arm[1] = vec(0, -left * elbow, 0);
}

void gait_pose_leg(GaitPose *pose, int side, double hip, double abduction, double knee, double ankle) {
    Vec3 *leg = pose->turn + GAIT_THIGH + side * LEG_JOINTS;
    leg[0] = vec(-hip, 0, side == GAIT_LEFT ? abduction : -abduction);
    leg[1] = vec(knee, 0, 0);
    leg[2] = vec(-ankle, 0, 0);
}

void gait_pose_toe(GaitPose *pose, int side, double bend) {
    pose->turn[GAIT_TOE + side * LEG_JOINTS].x = -bend;
}

static Mat3 about_x(double degrees) { return mat_axis_angle(vec(1, 0, 0), degrees * PI / 180); }
static Mat3 about_y(double degrees) { return mat_axis_angle(vec(0, 1, 0), degrees * PI / 180); }
static Mat3 about_z(double degrees) { return mat_axis_angle(vec(0, 0, 1), degrees * PI / 180); }

Mat3 gait_pitch(double degrees) {
    return about_x(-degrees);
}

static Mat3 joint_rotation(const GaitPose *pose, int joint) {
    Vec3 t = pose->turn[joint];
    Mat3 x = about_x(t.x), y = about_y(t.y), z = about_z(t.z);
    return joint == GAIT_HIPS ? mat_mul(mat_mul(y, x), z) : mat_mul(mat_mul(x, y), z);
}

/* The angles of Rx Ry Rz. Legs keep far away from 90 degrees about y. */
static Vec3 angles_xyz(Mat3 m) {
    double x = atan2(-m.r[1].z, m.r[2].z), y = asin(clamp(m.r[0].z, -1, 1)), z = atan2(-m.r[0].y, m.r[0].x);
    return vec_scale(vec(x, y, z), 180 / PI);
}

Vec3 gait_pose_hip(const GaitBody *body, const GaitPose *pose, int side) {
    Rigid hips = {joint_rotation(pose, GAIT_HIPS), pose->hips};
    return rigid_apply(hips, body->offset[GAIT_THIGH + side * LEG_JOINTS]);
}

Rigid gait_pose_foot(const GaitBody *body, const GaitPose *pose, int side) {
    Rigid g = {joint_rotation(pose, GAIT_HIPS), pose->hips};
    for (int i = GAIT_THIGH; i <= GAIT_FOOT; i++) {
        int joint = i + side * LEG_JOINTS;
        g = rigid_mul(g, (Rigid){joint_rotation(pose, joint), body->offset[joint]});
    }
    return g;
}

double gait_leg_length(const GaitBody *body, double knee) {
    double a = body->thigh, b = body->shin;
    return sqrt(a * a + b * b + 2 * a * b * cos(knee * PI / 180));
}

double gait_leg_knee(const GaitBody *body, double length) {
    double a = body->thigh, b = body->shin;
    return acos(clamp((length * length - a * a - b * b) / (2 * a * b), -1, 1)) * 180 / PI;
}

void gait_pose_reach(const GaitBody *body, GaitPose *pose, int side, Rigid foot, Vec3 forward) {
    Vec3 *leg = pose->turn + GAIT_THIGH + side * LEG_JOINTS;
    Vec3 line = vec_sub(foot.t, gait_pose_hip(body, pose, side));
    double knee = gait_leg_knee(body, vec_len(line));
    double away = atan2(body->shin * sin(knee * PI / 180), body->thigh + body->shin * cos(knee * PI / 180));
    Vec3 down = vec_unit_or(line, vec(0, -1, 0));
    Vec3 x = vec_unit_or(vec_cross(forward, down), vec(1, 0, 0)); /* the knee's axis */
    Vec3 y = vec_scale(mat_apply(mat_axis_angle(x, -away), down), -1);
    Mat3 thigh = mat_columns(x, y, vec_cross(x, y)), shin = mat_mul(thigh, about_x(knee));
    leg[0] = angles_xyz(mat_mul(mat_transpose(joint_rotation(pose, GAIT_HIPS)), thigh));
    leg[1] = vec(knee, 0, 0);
    leg[2] = angles_xyz(mat_mul(mat_transpose(shin), foot.r));
}

/* No minus before a printed zero, so that equal poses are equal text. */
static double printed(double x) {
    return fabs(x) < 0.00005 ? 0 : x;
}

/* A file cannot say its unit, and readers guess it from the size: 83 cm could be 83 inches. What is smaller
   is written in millimetres. */
static double per_centimetre(const GaitBody *body) {
    return body->height < 83 ? 10 : 1;
}

static void write_offset(const GaitBody *body, Vec3 v, FILE *out) {
    v = vec_scale(v, per_centimetre(body));
    fprintf(out, "OFFSET %.4f %.4f %.4f\n", printed(v.x), printed(v.y), printed(v.z));
}

static void indent(int depth, FILE *out) {
    for (int i = 0; i < depth; i++) fputc('\t', out);
}

static void write_joint(const GaitBody *body, int joint, int depth, FILE *out) {
    indent(depth, out);
    fprintf(out, "%s %s\n", joint == GAIT_HIPS ? "ROOT" : "JOINT", JOINT[joint].name);
    indent(depth, out);
    fputs("{\n", out);
    indent(depth + 1, out);
    write_offset(body, body->offset[joint], out);
    indent(depth + 1, out);
    if (joint == GAIT_HIPS) fputs("CHANNELS 6 Xposition Yposition Zposition Yrotation Xrotation Zrotation\n", out);
    else fputs("CHANNELS 3 Xrotation Yrotation Zrotation\n", out);
    for (int child = joint + 1; child < GAIT_JOINTS; child++)
        if (JOINT[child].parent == joint) write_joint(body, child, depth + 1, out);
    if (vec_len(body->tip[joint]) > 0) {
        indent(depth + 1, out);
        fputs("End Site\n", out);
        indent(depth + 1, out);
        fputs("{\n", out);
        indent(depth + 2, out);
        write_offset(body, body->tip[joint], out);
        indent(depth + 1, out);
        fputs("}\n", out);
    }
    indent(depth, out);
    fputs("}\n", out);
}

void gait_write_head(const GaitBody *body, int frames, double frame_time, FILE *out) {
    fputs("HIERARCHY\n", out);
    write_joint(body, GAIT_HIPS, 0, out);
    fprintf(out, "MOTION\nFrames: %d\nFrame Time: %.8f\n", frames, frame_time);
}

void gait_write_pose(const GaitBody *body, const GaitPose *pose, FILE *out) {
    Vec3 p = vec_scale(pose->hips, per_centimetre(body)), t = pose->turn[GAIT_HIPS];
    fprintf(out, "%.4f %.4f %.4f %.4f %.4f %.4f", printed(p.x), printed(p.y), printed(p.z), printed(t.y), printed(t.x),
            printed(t.z));
    for (int i = GAIT_HIPS + 1; i < GAIT_JOINTS; i++) {
        t = pose->turn[i];
        fprintf(out, " %.4f %.4f %.4f", printed(t.x), printed(t.y), printed(t.z));
    }
    fputc('\n', out);
}
