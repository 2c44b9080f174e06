/* Joints of the sample, brought from file units and axes to metres with Y up. */
#include "figure/binder.h"

Mat3 binder_rotation(const Binder *b, int frame, int joint) {
    return mat_mul(b->f->upright, sample_at(b->sample, frame, joint).r);
}

Vec3 binder_position(const Binder *b, int frame, int joint) {
    return vec_scale(mat_apply(b->f->upright, sample_point(b->sample, frame, joint)), b->f->unit);
}

Vec3 binder_offset(const Binder *b, int joint, int other) {
    Vec3 sum = {0, 0, 0};
    for (int i = 0; i < b->sample->count; i++) {
        Vec3 d = vec_sub(binder_position(b, i, other), binder_position(b, i, joint));
        sum = vec_add(sum, mat_apply(mat_transpose(binder_rotation(b, i, joint)), d));
    }
    return vec_scale(sum, 1.0 / b->sample->count);
}

void binder_mean_add(Quat *sum, Mat3 r) {
    Quat q = quat_like(quat_from_mat(r), *sum);
    *sum = (Quat){sum->w + q.w, sum->x + q.x, sum->y + q.y, sum->z + q.z};
}

Mat3 binder_mean(Quat sum) {
    double n = sqrt(sum.w * sum.w + sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
    if (n < 1e-9) return mat_identity();
    return mat_from_quat((Quat){sum.w / n, sum.x / n, sum.y / n, sum.z / n});
}
