/* What the readers of BVH, AMC and ASF share with motion.c. Private to this floor. */
#ifndef MOTION_SOURCE_H
#define MOTION_SOURCE_H

#include "motion/motion.h"
#include "motion/stream.h"

/* Every stride-th frame has a mark, from which reading can start. When there is no room for more marks, every second
   one is dropped and the stride doubles, so that the index of any file has the same size. */
enum { MARKS_MAX = 1024 };

/* Where the values of a bone's line in an AMC file go. An ASF file lists degrees of freedom in any order, seven at
   most: three of translation, three of rotation, and length, which no joint takes. */
enum { DOF_LENGTH = CHANNEL_RZ + 1, DOF_MAX };
typedef struct {
    const char *name;
    int joint, ndof;
    int dof[DOF_MAX];  /* a ChannelKind up to CHANNEL_RZ, or DOF_LENGTH; in the order of the values */
    int slot[DOF_MAX]; /* channel of the joint that takes it, -1: left out */
} Bone;

/* What is needed to read AMC frames: the bones of the ASF sorted by name. */
typedef struct {
    const char *asf;
    Bone *bone;
    int nbones;
    double degrees; /* per unit of angle in the AMC file */
    bool *rests;    /* by joint: the first frame has no values for it, so others need none */
} Acclaim;

struct MotionSource {
    int fd;
    const char *name; /* for messages */
    long long size;   /* of the file, to see whether it has changed */
    long long changed_s, changed_ns;
    Skeleton skeleton;
    int nframes;
    Mark *mark;
    int nmarks, stride;
    const Acclaim *acclaim; /* NULL for BVH */
};

/* A file that is being opened. */
typedef struct {
    Stream in;
    const MotionOptions *options;
    int max_joints, max_frames;
    Arena *arena, *scratch; /* of the motion; of this opening */
    Notes *notes;
    Motion *motion;
    MotionSource *source;
    struct Positions *positions;
} Opening;

/* bvh.c: bvh_open reads the head and all frames, bvh_row the frame at which the stream stands. */
MUST_CHECK bool bvh_open(Opening *o, Error *e);
MUST_CHECK bool bvh_row(Stream *s, const MotionSource *source, double *row, Error *e);
/* bvh_head.c: reads up to MOTION and hands the skeleton to source_skeleton. */
MUST_CHECK bool bvh_head(Opening *o, Error *e);
/* A channel's name in a BVH file, by its ChannelKind. */
extern const char *const bvh_channels[CHANNEL_KINDS];

/* acclaim.c: the same for AMC files. */
MUST_CHECK bool acclaim_open(Opening *o, Error *e);
MUST_CHECK bool acclaim_row(Stream *s, const MotionSource *source, double *row, Error *e);

/* asf_find.c: the path of the skeleton that stands beside an AMC file. */
MUST_CHECK bool asf_find(Opening *o, const char **path, Error *e);
/* asf.c: reads a skeleton and hands it to source_skeleton. */
MUST_CHECK bool asf_read(Opening *o, const char *path, Acclaim *out, Error *e);
/* Index in a->bone, or -1. */
int asf_bone(const Acclaim *a, Word name);

/* motion.c: opens a regular file, or spools anything else. ERR_INPUT for a directory, a
   missing file, an empty one or one with NUL bytes at its start. */
MUST_CHECK bool source_file(const char *path, int *fd, Error *e);
/* PARENT_End, the name of an end site. NULL with an error where memory is exhausted. */
const char *source_end_name(Opening *o, const char *parent, Error *e);
/* Copies the joints into the motion's arena and says which names are there twice. */
MUST_CHECK bool source_skeleton(Opening *o, const Joint *joint, int njoints, Error *e);
/* The stream stands at the first value of `frame`: remember it if it is time. */
void source_mark(MotionSource *source, int frame, Mark mark);
/* A whole frame has been read. */
void source_sample(Opening *o, int frame, const double *row);
/* Checks a frame time that the file says, or takes the one of --fps. */
MUST_CHECK bool source_rate(Opening *o, double frame_time, Error *e);

/* position.c: do position channels replace the OFFSET, or add to it? Looks at frames that
   are spread evenly over the motion. And are they all that moves the joints below a root?
   Then those without OFFSET get one from the first frame. */
typedef struct Positions Positions;
MUST_CHECK bool positions_start(const Skeleton *s, Arena *arena, Positions **out, Error *e);
void positions_add(Positions *p, int frame, const double *row);
bool positions_are_deltas(Positions *p);
bool positions_are_all(const Positions *p);
void positions_fill_offsets(const Positions *p, Skeleton *s);

#endif
