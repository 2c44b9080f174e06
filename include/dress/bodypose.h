/* The pose of a frame, put on a body. */
#ifndef DRESS_BODYPOSE_H
#define DRESS_BODYPOSE_H

#include "dress/bodyframe.h"

/* Poses the body and lets its parts give way to each other. Allocates nothing. */
void body_frame_pose(BodyFrame *f, const Pose *pose);

/* Fills f->normal, which only those need who write the body. */
void body_frame_normals(const BodyFrame *f);

#endif
