/* Numbers at random that are the same in every run (xorshift: Marsaglia, J. Stat. Softw. 8(14), 2003). */
#ifndef TESTS_DICE_H
#define TESTS_DICE_H

#include <stdint.h>

#include "geometry/vec.h"

/* 64 bits, not all of them 0. */
static inline uint64_t dice_bits(void) {
    static uint64_t state = 88172645463325252u;
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    return state;
}

/* 0..n-1 */
static inline unsigned dice_below(unsigned n) { return (unsigned)((dice_bits() >> 20) % n); }

/* 0 <= x < 1 */
static inline double dice_unit(void) { return (double)(dice_bits() >> 11) * 0x1p-53; }

/* A point of the cube from 0 to 1, and of that from -1 to 1. */
static inline Vec3 dice_point(void) {
    double x = dice_unit(), y = dice_unit(), z = dice_unit();
    return vec(x, y, z);
}
static inline Vec3 dice_around(void) { return vec_sub(vec_scale(dice_point(), 2), vec(1, 1, 1)); }

#endif
