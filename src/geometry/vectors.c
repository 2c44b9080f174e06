/* The only place that asks the processor what it has. */
#include "geometry/vectors.h"

bool vectors_usable(Vectors v) {
#ifdef VECTORS_ARE_X86
    if (v == VECTORS_AVX2) return __builtin_cpu_supports("avx2");
    if (v == VECTORS_AVX512)
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
               __builtin_cpu_supports("avx512dq");
#endif
    return v == VECTORS_BEST || v == VECTORS_PLAIN;
}

Vectors vectors_pick(Vectors v) {
    if (v != VECTORS_BEST) return v;
    if (vectors_usable(VECTORS_AVX512)) return VECTORS_AVX512;
    return vectors_usable(VECTORS_AVX2) ? VECTORS_AVX2 : VECTORS_PLAIN;
}
