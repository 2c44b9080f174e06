/* The kinds of vectors that a processor may have; the same is computed with any of them. */
#ifndef GEOMETRY_VECTORS_H
#define GEOMETRY_VECTORS_H

#include <stdbool.h>

/* BEST: the widest at hand. PLAIN: what the compiler makes of C for every machine. */
typedef enum { VECTORS_BEST, VECTORS_PLAIN, VECTORS_AVX2, VECTORS_AVX512, VECTORS_COUNT } Vectors;

/* The same but for BEST, which becomes what it stands for. */
Vectors vectors_pick(Vectors v);

/* Has this machine these? */
bool vectors_usable(Vectors v);

/* A function compiled for such vectors; only where VECTORS_ARE_X86. */
#if defined(__x86_64__) && defined(__GNUC__)
#define VECTORS_ARE_X86 1
#define FOR_AVX2 __attribute__((target("avx2")))
#define FOR_AVX512 __attribute__((target("avx512f,avx512vl,avx512dq")))
#endif

#endif
