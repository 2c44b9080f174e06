/* SIMD instruction sets. Whichever is used, results are the same to the bit. */
#ifndef GEOMETRY_VECTORS_H
#define GEOMETRY_VECTORS_H

#include <stdbool.h>

/* BEST: the widest that this machine has. PLAIN: none, the compiler's code for every machine. */
typedef enum { VECTORS_BEST, VECTORS_PLAIN, VECTORS_AVX2, VECTORS_AVX512, VECTORS_COUNT } Vectors;

/* v, or, for BEST, the widest that this machine has. */
Vectors vectors_pick(Vectors v);

/* Does this machine have it? */
bool vectors_usable(Vectors v);

/* What begins a function that becomes a part of each that calls it, and is compiled for the instruction set of that. */
#define ALWAYS static inline __attribute__((always_inline))

/* Attributes of a function that is compiled for an instruction set; only where VECTORS_ARE_X86 is defined. */
#if defined(__x86_64__) && defined(__GNUC__)
#define VECTORS_ARE_X86 1
#define FOR_AVX2 __attribute__((target("avx2")))
#define FOR_AVX512 __attribute__((target("avx512f,avx512vl,avx512dq")))
#endif

#endif
