/* Memory by lifetime: everything that lives as long as the run, a job or a frame comes
   from one arena and goes with it. Not thread-safe: one arena belongs to one thread. */
#ifndef BASE_ARENA_H
#define BASE_ARENA_H

#include <stddef.h>

#include "base/error.h"

typedef struct ArenaBlock ArenaBlock;

/* Clear with {0} for an arena without a limit. */
typedef struct {
    ArenaBlock *first, *last;    /* private */
    size_t limit;                /* bytes it may hold in all; 0 = no limit */
    size_t used, peak, held;     /* bytes handed out, their maximum, bytes taken from libc */
    long fail_after;             /* for tests: the n-th allocation from now fails; 0 = never */
} Arena;

/* Returns `count` zeroed items of `size` bytes, aligned to 64 bytes, never NULL for
   count * size == 0. NULL with ERR_INTERNAL where memory is exhausted,
   with ERR_INPUT where that would be beyond the limit. */
void *arena_array(Arena *a, size_t count, size_t size, Error *e);

/* Typed form: Vec3 *p = ARENA_NEW(a, Vec3, n, e); */
#define ARENA_NEW(arena, Type, count, e) ((Type *)arena_array((arena), (size_t)(count), sizeof(Type), (e)))

/* Room for one item more than `count`: `item` itself, or a copy with twice the room once `count` has reached *capacity.
   Start with NULL, 0 and 0. NULL with an error as above. */
void *arena_grow(Arena *a, void *item, size_t size, int count, int *capacity, Error *e);

/* Typed form: p = ARENA_GROW(a, Vec3, p, n, &capacity, e); */
#define ARENA_GROW(arena, Type, item, count, capacity, e) \
    ((Type *)arena_grow((arena), (item), sizeof(Type), (count), (capacity), (e)))

/* Copies n bytes of `text` and a final NUL. NULL with an error as above. */
char *arena_text(Arena *a, const char *text, size_t n, Error *e);

/* Forgets every allocation and keeps the blocks for the next round. */
void arena_reset(Arena *a);

/* Gives everything back; the arena can be used again. */
void arena_free(Arena *a);

#endif
