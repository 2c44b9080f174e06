/* A chain of blocks, each twice as large as the one before, up to two megabytes, or as large as what is asked for;
   reset keeps them. They are few, so that every allocation looks for the first one with room: what a large array left
   at the end of a block is taken by smaller ones. The system gives blocks full of zeros, and large ones without memory
   behind them until it is used: only what has been handed out before is cleared. */
#include "base/arena.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_CAPACITY = 64, ALIGN = 64, FIRST_BLOCK = 64 << 10, LARGE_BLOCK = 2 << 20 };

struct ArenaBlock {
    ArenaBlock *next;
    char *data;                 /* aligned, behind this head */
    size_t size, used, touched; /* bytes of it; touched: that may not be zero */
};

/* What a block needs beside its data. */
#define HEAD (sizeof(ArenaBlock) + ALIGN)

/* Would a block of that size be more than is allowed? */
static bool is_beyond(const Arena *a, size_t size) { return a->limit && a->held + size + HEAD > a->limit; }

static ArenaBlock *new_block(Arena *a, size_t need) {
    size_t size = a->last ? a->last->size * 2 : FIRST_BLOCK;
    if (size > LARGE_BLOCK) size = LARGE_BLOCK;
    if (size < need || is_beyond(a, size)) size = need;
    if (is_beyond(a, size)) return NULL;
    ArenaBlock *b = calloc(1, HEAD + size);
    if (!b) return NULL;
    char *data = (char *)(b + 1);
    *b = (ArenaBlock){.data = data + (ALIGN - (uintptr_t)data % ALIGN) % ALIGN, .size = size};
    a->held += HEAD + size;
    if (a->last) a->last->next = b;
    else a->first = b;
    a->last = b;
    return b;
}

static void *take(Arena *a, size_t bytes) {
    ArenaBlock *b = a->first;
    while (b && b->size - b->used < bytes) b = b->next;
    if (!b && !(b = new_block(a, bytes))) return NULL;
    char *p = b->data + b->used;
    if (b->touched > b->used) memset(p, 0, b->touched - b->used < bytes ? b->touched - b->used : bytes);
    b->used += bytes;
    if (b->used > b->touched) b->touched = b->used;
    a->used += bytes;
    if (a->used > a->peak) a->peak = a->used;
    return p;
}

void *arena_array(Arena *a, size_t count, size_t size, Error *e) {
    if (size && count > (SIZE_MAX / 4) / size) {
        error_set(e, ERR_INTERNAL, "%zu items of %zu bytes are too many", count, size);
        return NULL;
    }
    size_t bytes = (count * size + ALIGN - 1) / ALIGN * ALIGN;
    void *p = a->fail_after > 0 && --a->fail_after == 0 ? NULL : take(a, bytes ? bytes : ALIGN);
    if (!p && is_beyond(a, bytes))
        error_set(e, ERR_INPUT, "needs more memory than the limit of %zu MB (%zu bytes held, %zu more asked)",
                  a->limit >> 20, a->held, bytes);
    else if (!p) error_set(e, ERR_INTERNAL, "out of memory (%zu bytes held, %zu more asked)", a->held, bytes);
    return p;
}

void *arena_grow(Arena *a, void *item, size_t size, int count, int *capacity, Error *e) {
    if (count < *capacity) return item;
    int wider = *capacity ? 2 * *capacity : FIRST_CAPACITY;
    void *copy = arena_array(a, (size_t)wider, size, e);
    if (!copy) return NULL;
    if (count) memcpy(copy, item, (size_t)count * size);
    *capacity = wider;
    return copy;
}

char *arena_text(Arena *a, const char *text, size_t n, Error *e) {
    char *p = arena_array(a, n + 1, 1, e);
    if (p) memcpy(p, text, n);
    return p;
}

void arena_reset(Arena *a) {
    for (ArenaBlock *b = a->first; b; b = b->next) {
#ifdef VALIDATE
        memset(b->data, 0xDD, b->used); /* so that a stale pointer shows */
#endif
        b->used = 0;
    }
    a->used = 0;
}

void arena_free(Arena *a) {
    for (ArenaBlock *b = a->first, *next; b; b = next) {
        next = b->next;
        free(b);
    }
    a->first = a->last = NULL;
    a->used = a->held = 0;
}
