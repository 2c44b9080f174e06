/* The skin of a posed body, where its parts press on each other and give way (dress/yield). */
#ifndef DRESS_FLESH_H
#define DRESS_FLESH_H

#include "dress/bodyframe.h"

/* Finds which parts press on each other (f->contacts), and moves their skin (f->position, in metres, and f->normal) to
   where it has given way. A step of body_frame_pose, after the pose itself. */
void flesh_press(BodyFrame *f);

#endif
