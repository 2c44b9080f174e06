/* Where a motion makes steps that no body makes, for the messages. */
#ifndef APP_JUMPS_H
#define APP_JUMPS_H

#include "figure/figure.h"

/* What lies between two neighbouring frames. */
typedef enum { STEP_PLAIN, STEP_FLIP, STEP_JUMP } Step;

/* What the steps of a motion are judged by. */
typedef struct {
    const Figure *figure;
    double frame_time; /* seconds */
    bool lone_first;   /* the first frame does not belong to the others */
} JumpRule;

/* The step onto `frame`, from 0, of the source. *width gets the widest step of a bone, in heights. */
Step jumps_judge(const JumpRule *rule, int frame, const Pose *behind, const Pose *ahead, double *width);

/* Reads the pose of a frame of the source, from 0. */
typedef bool JumpsRead(void *context, int frame, Pose *out, Error *e);

/* At a jump of that width onto `frame`, of `count`, from the pose `behind`: does the motion go on in one of the next
   frames as if it had not jumped? Then the frames before it are astray. *back: that frame, or `frame` if there is
   none. */
MUST_CHECK bool jumps_find_return(const JumpRule *rule, int frame, int count, double width, const Pose *behind,
                                  JumpsRead *read, void *context, int *back, Error *e);

/* Neighbouring frames first..last, from 1, each that far (in heights) from the one before. */
typedef struct { int first, last; double width; Step kind; } Jump;

/* The first few in the order of the frames, and where there are more, behind them the last of all; `count` goes on
   counting. Clear with {0}. */
enum { JUMPS_KEPT = 4 };
typedef struct { int count; Jump jump[JUMPS_KEPT + 1]; } Jumps;

/* A step onto `frame`. Neighbours of one kind become one jump. */
void jumps_add(Jumps *j, int frame, double width, Step kind);

/* Appends those of the frames that follow. */
void jumps_append(Jumps *j, const Jumps *later);

/* As warnings about the motion `path`. */
void jumps_notes(const Jumps *j, const char *path, Notes *notes);

#endif
