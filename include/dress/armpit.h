/* Cloth below raised arms. */
#ifndef DRESS_ARMPIT_H
#define DRESS_ARMPIT_H

#include "figure/body.h"
#include "garment/garment.h"

typedef struct {
    Vec3 joint;     /* of the shoulder; world, metres */
    double radius;  /* of its flesh, metres */
    double spanned; /* 0..1: how far cloth is spanned below the arm */
} Armpit;

typedef struct {
    Armpit side[2]; /* left, right */
} Armpits;

Armpits armpits_find(const Figure *figure, const Body *body, const Pose *pose);

/* Where a point that a blend leaves at `at` is if its cloth is bound to trunk and upper arm, and spanned between them;
   `at` for any other cloth. rest: the point in the bind pose. World frame, metres. */
Vec3 armpits_span(const Armpits *a, const Pose *pose, const Binding *b, Vec3 rest, Vec3 at);

#endif
