/* How cloth moves that follows several bones at once. */
#ifndef DRESS_BLEND_H
#define DRESS_BLEND_H

#include "figure/figure.h"
#include "garment/fit.h"

/* The bones of one pose, as cloth follows them; private inside. */
typedef struct {
    const Figure *figure;
    const Pose *pose;
    Quat turn[ROLE_COUNT];    /* the rotation of every bone, by its sign: which way round it has turned */
    double twist[2];          /* how far left and right thigh have turned about themselves, radians */
} Blender;

/* Figure and pose must outlive the blender. */
Blender blender_of(const Figure *figure, const Pose *pose);

/* The blend of weighted bones as one rigid motion from the canonical stance to the world, by dual quaternions (Kavan
   et al. 2007): between the two bones of a joint it turns about the joint, so the ring at a knee keeps its width
   however far the knee bends. A thigh that turns about itself takes cloth along little by little: not at all at the
   hip, wholly at the knee. rest: where the cloth is in the canonical stance. */
Rigid blend_at(const Blender *b, const Binding *binding, Vec3 rest);

#endif
