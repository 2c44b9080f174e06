/* Forward kinematics. A joint's frame is its parent's, moved by OFFSET and position channels,
   turned by the rotation channels in the order in which the file lists them.

   Files of bare points move joints by positions and turn none. There the rotations follow from the places. */
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
        case CHANNEL_RX: case CHANNEL_RY: case CHANNEL_RZ: g.r = turn(g.r, j->channel[i], value[i]); break;
        default: break;
        }
    }
    if (j->has_axis) g.r = mat_mul(mat_mul(j->axis, g.r), mat_transpose(j->axis));
    return g;
}

/* The joints right below one, in it, by their OFFSETs and by where they are now. */
enum { CHILDREN_MAX = 16 };
typedef struct {
    int n;
    Vec3 told[CHILDREN_MAX], now[CHILDREN_MAX];
} Children;

static Children children_of(const Skeleton *s, const Rigid *world, int joint) {
    Children c = {0};
    for (int k = joint + 1; k < s->njoints && s->joint[k].parent >= joint && c.n < CHILDREN_MAX; k++) {
        if (s->joint[k].parent != joint || s->joint[k].is_end) continue;
        c.told[c.n] = s->joint[k].offset;
        c.now[c.n++] = vec_sub(world[k].t, world[joint].t);
    }
    return c;
}

/* The frame that two directions span. */
static Mat3 spanned(Vec3 a, Vec3 b) {
    Vec3 x = vec_unit_or(a, vec(1, 0, 0)), z = vec_unit_or(vec_cross(a, b), vec(0, 0, 1));
    return mat_columns(x, vec_cross(z, x), z);
}

/* A rotation that is about right: of the two children whose OFFSETs span most, else the parent's. */
static Mat3 first_guess(const Children *c, Mat3 parent) {
    double most = 0;
    Mat3 guess = parent;
    for (int a = 0; a < c->n; a++)
        for (int b = 0; b < a; b++) {
            double span = vec_len(vec_cross(c->told[a], c->told[b]));
            if (!(span > most) || vec_len(vec_cross(c->now[a], c->now[b])) == 0) continue;
            most = span;
            guess = mat_mul(spanned(c->now[a], c->now[b]), mat_transpose(spanned(c->told[a], c->told[b])));
        }
    return guess;
}

/* The rotation under which the OFFSETs of a joint's children lie as near as can be to where the children are, by small
   turns from a guess (Mueller et al., A Robust Method to Extract the Rotational Part of Deformations, 2016). Of a
   single child it is the smallest turn. */
static Mat3 turn_of(const Children *c, Mat3 parent) {
    static const int TURNS = 30;
    static const double SMALL = 1e-9; /* radians */
    Mat3 r = first_guess(c, parent);
    for (int k = 0; k < TURNS; k++) {
        Vec3 torque = {0, 0, 0};
        double along = 0;
        for (int i = 0; i < c->n; i++) {
            Vec3 told = mat_apply(r, c->told[i]);
            torque = vec_add(torque, vec_cross(told, c->now[i]));
            along += vec_dot(told, c->now[i]);
        }
        double size = vec_len(torque), angle = atan2(size, along);
        if (!(size > 0) || angle < SMALL) break;
        r = mat_mul(mat_axis_angle(vec_scale(torque, 1 / size), angle), r);
    }
    return r;
}

static void turn_points(const Skeleton *s, Rigid *world) {
    for (int i = 0; i < s->njoints; i++) {
        const Joint *j = &s->joint[i];
        const Rigid *parent = j->parent < 0 ? &world[i] : &world[j->parent];
        Children children = children_of(s, world, i);
        if (j->is_end) world[i] = (Rigid){parent->r, rigid_apply(*parent, j->offset)};
        else world[i].r = turn_of(&children, parent->r);
    }
}

void skeleton_pose(const Skeleton *s, const double *row, Rigid *world) {
    for (int i = 0; i < s->njoints; i++) {
        const Joint *j = &s->joint[i];
        Rigid g = local(j, row + j->first_channel, s->position_adds);
        world[i] = j->parent < 0 ? g : rigid_mul(world[j->parent], g);
    }
    if (s->points) turn_points(s, world);
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
