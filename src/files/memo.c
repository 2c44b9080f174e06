/* A few texts with their whole keys, not digests of them: to compare a key costs less than one line of the
   text. Nothing here can fail: where there is no memory nothing is kept, and nothing found. */
#include "files/memo.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { VOID = MEMO_MOST + 1 }; /* the size of a key that is too long, or that there was no memory for */

void memo_begin(Memo *m) { m->size = 0; }

static bool has_room(Memo *m, size_t size) {
    if (size <= m->capacity) return true;
    char *more = realloc(m->key, 2 * size);
    if (!more) return false;
    m->key = more;
    m->capacity = 2 * size;
    return true;
}

void memo_add(Memo *m, const void *data, size_t size) {
    if (size == 0) return;
    if (m->size == VOID || size > MEMO_MOST - m->size || !has_room(m, m->size + size)) {
        m->size = VOID;
        return;
    }
    memcpy(m->key + m->size, data, size);
    m->size += size;
}

const char *memo_find(Memo *m, size_t *size) {
    for (int i = 0; i < MEMO_ITEMS; i++) {
        MemoItem *item = &m->item[i];
        if (!item->data || item->key != m->size || memcmp(item->data, m->key, m->size) != 0) continue;
        item->used = ++m->now;
        *size = item->text;
        return item->data + item->key;
    }
    return NULL;
}

void memo_keep(Memo *m, const char *text, size_t size) {
    MemoItem *oldest = &m->item[0];
    if (m->size == VOID || size > MEMO_MOST - m->size) return;
    for (int i = 1; i < MEMO_ITEMS; i++)
        if (m->item[i].used < oldest->used) oldest = &m->item[i];
    free(oldest->data);
    *oldest = (MemoItem){malloc(m->size + size + 1), m->size, size, ++m->now};
    if (!oldest->data) return;
    memcpy(oldest->data, m->key, m->size);
    memcpy(oldest->data + m->size, text, size);
}

void memo_free(Memo *m) {
    for (int i = 0; i < MEMO_ITEMS; i++) free(m->item[i].data);
    free(m->key);
    *m = (Memo){0};
}
