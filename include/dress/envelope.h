/* The global shape of a loose garment: a tube of rings that holds both legs in any pose. */
#ifndef DRESS_ENVELOPE_H
#define DRESS_ENVELOPE_H

#include "garment/fit.h"

/* What a hip that is bent forwards does to the front of the tube. */
typedef struct {
    double hangs;                      /* 0..1: how far the front hangs between pelvis and lap, instead of turning with
                                          the legs */
    double gathers;                    /* 0..1: how far it is gathered at the waist, since the thigh is at the belly */
    double lap;                        /* metres below the hip joint along the leg: where the lap begins */
} Bend;

/* The envelope in one pose; private inside. */
typedef struct {
    const Fit *fit;
    const Body *body;
    double cm;                         /* a hundredth of a metre on a figure of 1.70 m */
    Vec3 hip[2], knee[2];              /* left, right; world */
    Vec3 down, thigh[2], lower[2];     /* unit directions: pelvis, thighs, below the knees */
    double thigh_length[2], rest_hip;  /* metres; half the distance of the hip joints */
    double hip_height;                 /* of the hip joints in the canonical stance */
    Vec3 root;                         /* between the hip joints */
    Mat3 pelvis;
    double last;                       /* metres below the hip joints: where the last ring is */
    double turn;                       /* radians: by how much the tube turns at the hips */
    double outside[2];                 /* metres, per x and z on the ring: how far outside the axis of that turn */
    Bend bend[2];                      /* left, right */
} Envelope;

/* Prepares the rings for a pose. */
void envelope_pose(Envelope *env, const Fit *fit, const Figure *figure, const Body *body, const Pose *pose);

/* A point of the tube: of cloth that is s metres below the hip joints at rest (negative above), at (x, z) on the ring
   if that were the unit circle, x to the left, z to the front. World frame, metres. */
Vec3 envelope_point(const Envelope *env, double s, double x, double z);

/* The s of a ring of the fit. */
double envelope_place(const Envelope *env, int ring);

#endif
