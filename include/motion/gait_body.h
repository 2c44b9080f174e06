/* The walker's skeleton, its poses, and both as BVH text: centimetres, Y up, facing +Z, +X is
   the walker's left. The zero pose is a T-pose. Angles in degrees. */
#ifndef MOTION_GAIT_BODY_H
#define MOTION_GAIT_BODY_H

#include <stdio.h>

#include "geometry/vec.h"

/* Order of the file. The right side follows the left one at GAIT_ARM or GAIT_LEG joints. */
typedef enum {
    GAIT_HIPS, GAIT_SPINE, GAIT_CHEST, GAIT_NECK, GAIT_HEAD,
    GAIT_CLAVICLE, GAIT_ARM, GAIT_FOREARM, GAIT_HAND,
    GAIT_RIGHT_CLAVICLE, GAIT_RIGHT_ARM, GAIT_RIGHT_FOREARM, GAIT_RIGHT_HAND,
    GAIT_THIGH, GAIT_SHIN, GAIT_FOOT, GAIT_TOE,
    GAIT_RIGHT_THIGH, GAIT_RIGHT_SHIN, GAIT_RIGHT_FOOT, GAIT_RIGHT_TOE,
    GAIT_JOINTS
} GaitJoint;

enum { GAIT_LEFT, GAIT_RIGHT, GAIT_SIDES };

/* Lengths in centimetres. The sole is level in the zero pose; its points are given from the
   ankle joint, in the foot's frame. */
typedef struct {
    double height;
    Vec3 offset[GAIT_JOINTS];   /* from the parent joint; the hips' own is zero, so that it is
                                   the same whether position channels add to it or replace it */
    Vec3 tip[GAIT_JOINTS];      /* end site from its joint; zero = none */
    double stand;               /* height of the hips in quiet standing */
    double hip;                 /* half the distance of the hip joints */
    double thigh, shin;         /* joint to joint */
    double ankle;               /* height of the ankle joint over the sole */
    double heel, ball, toe;     /* along the foot: heel behind, ball and toe tip ahead of the ankle */
    double ball_height;         /* of the toe joint over the sole */
} GaitBody;

/* One frame. turn[] holds angles about x, y and z: R = Rx Ry Rz, for the hips R = Ry Rx Rz
   (heading first, so that a walker may turn right round). */
typedef struct {
    Vec3 hips;
    Vec3 turn[GAIT_JOINTS];
} GaitPose;

/* The body of a stature in centimetres. */
GaitBody gait_body(double height);

/* Flexion swings forward and abduction outwards on both sides. */
void gait_pose_arm(GaitPose *pose, int side, double flexion, double abduction, double elbow);
void gait_pose_leg(GaitPose *pose, int side, double hip, double abduction, double knee, double ankle);
/* bend: toes up. */
void gait_pose_toe(GaitPose *pose, int side, double bend);

/* Where the hip joint stands, and the frame of the foot (origin at the ankle joint). */
Vec3 gait_pose_hip(const GaitBody *body, const GaitPose *pose, int side);
Rigid gait_pose_foot(const GaitBody *body, const GaitPose *pose, int side);

/* Bends the leg so that the foot has that frame (inverse kinematics). The knee points along
   `forward`, a unit vector across the leg. A foot out of reach is met with a straight leg. */
void gait_pose_reach(const GaitBody *body, GaitPose *pose, int side, Rigid foot, Vec3 forward);

/* Distance from hip to ankle joint with the knee bent by so many degrees, and back. */
double gait_leg_length(const GaitBody *body, double knee);
double gait_leg_knee(const GaitBody *body, double length);

/* Rotation about x by so many degrees, toes up positive: what pitches a foot. */
Mat3 gait_pitch(double degrees);

/* HIERARCHY and the head of MOTION, and one line of it. */
void gait_write_head(const GaitBody *body, int frames, double frame_time, FILE *out);
void gait_write_pose(const GaitBody *body, const GaitPose *pose, FILE *out);

#endif
