/* Texts that were made before, found again by what they were made of: what stays from frame to frame
   is not made anew. */
#ifndef FILES_MEMO_H
#define FILES_MEMO_H

#include <stddef.h>

enum { MEMO_ITEMS = 16, MEMO_MOST = 4 << 20 /* bytes of an item; a larger one is not kept */ };

typedef struct {
    char *data;            /* the key, and the text behind it */
    size_t key, text;      /* bytes of each */
    unsigned long used;    /* when last */
} MemoItem;

/* Clear with {0}, memo_free at the end. Private inside. */
typedef struct {
    MemoItem item[MEMO_ITEMS];
    unsigned long now;
    char *key;             /* that is being put together */
    size_t size, capacity;
} Memo;

/* Begins a key and adds to it: all that the text depends on. */
void memo_begin(Memo *m);
void memo_add(Memo *m, const void *data, size_t size);

/* The text that was kept under this very key; NULL: none. */
const char *memo_find(Memo *m, size_t *size);

/* Keeps the text under the key, instead of what has not been asked for the longest. */
void memo_keep(Memo *m, const char *text, size_t size);

void memo_free(Memo *m);

#endif
