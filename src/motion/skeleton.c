/* Forward kinematics. A joint's frame is its parent's, moved by OFFSET and position channels,
   turned by the rotation channels in the order in which the file lists them. */
#include "motion/skeleton.h"

#include <string.h>

/* m times the rotation about axis `kind` by `degrees`: it mixes two columns of m. */
static Mat3 turn(Mat3 m, ChannelKind kind, double degrees) {
    if (degrees == 0) return m;
    double a = degrees * (PI / 180), c = cos(a), s = sin(a);
    for (int i = 0; i < 3; i++) {
        Vec3 r = m.r[i];
        if (kind == CHANNEL_RX) m.r[i] = vec(r.x, c * r.y + s * r.z, c * r.z - s * r.y);
        else if (kind == CHANNEL_RY) m.r[i] = vec(c * r.x - s * r.z, r.y, c * r.z + s * r.x);
        else m.r[i] = vec(c * r.x + s * r.y, c * r.y - s * r.x, r.z);
    }
    return m;
}

/* The transform from the joint's frame to its parent's. */
static Rigid local(const Joint *j, const double *value, bool adds) {
    Rigid g = {mat_identity(), j->offset};
    for (int i = 0; i < j->nchannels; i++) {
        switch (j->channel[i]) {
        case CHANNEL_TX: g.t.x = adds ? j->offset.x + value[i] : value[i]; break;
        case CHANNEL_TY: g.t.y = adds ? j->offset.y + value[i] : value[i]; break;
        case CHANNEL_TZ: g.t.z = adds ? j->offset.z + value[i] : value[i]; break;
        default: g.r = turn(g.r, j->channel[i], value[i]);
        }
    }
    if (j->has_axis) g.r = mat_mul(mat_mul(j->axis, g.r), mat_transpose(j->axis));
    return g;
}

void skeleton_pose(const Skeleton *s, const double *row, Rigid *world) {
    for (int i = 0; i < s->njoints; i++) {
        const Joint *j = &s->joint[i];
        Rigid g = local(j, row + j->first_channel, s->position_adds);
        world[i] = j->parent < 0 ? g : rigid_mul(world[j->parent], g);
    }
}

bool skeleton_below(const Skeleton *s, int joint, int ancestor) {
    while (joint > ancestor) joint = s->joint[joint].parent; /* parents stand before their children */
    return joint == ancestor;
}

int skeleton_find(const Skeleton *s, const char *name) {
    for (int i = 0; i < s->njoints; i++)
        if (strcmp(s->joint[i].name, name) == 0) return i;
    return -1;
}
