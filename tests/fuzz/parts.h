/* Input of several files in one: parts between lines of '%%%', and files without a name to hold them. */
#ifndef FUZZ_PARTS_H
#define FUZZ_PARTS_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int memfd_create(const char *name, unsigned flags); /* of Linux: a file in memory */

/* Clear with {0}; stays open for the next input. */
typedef struct {
    int fd;
    char path[32]; /* that Linux gives it; empty before the first input */
} Sheet;

static inline void sheet_write(Sheet *s, const void *data, size_t size) {
    if (!s->path[0] && (s->fd = memfd_create("sheet", 0)) < 0) abort();
    snprintf(s->path, sizeof s->path, "/dev/fd/%d", s->fd);
    if (ftruncate(s->fd, 0) != 0 || pwrite(s->fd, data, size, 0) != (ssize_t)size) abort();
}

static const char part_mark[] = "%%%\n";

/* The first mark, or NULL. */
static inline const uint8_t *part_find(const uint8_t *data, size_t size) {
    size_t n = sizeof part_mark - 1;
    for (size_t i = 0; i + n <= size; i++)
        if (memcmp(data + i, part_mark, n) == 0) return data + i;
    return NULL;
}

/* Writes what stands in front of the first mark, and moves on behind it. Without a mark that is all. */
static inline size_t part_take(const uint8_t **data, size_t *size, Sheet *s) {
    const uint8_t *mark = part_find(*data, *size);
    size_t n = mark ? (size_t)(mark - *data) : *size, behind = mark ? n + sizeof part_mark - 1 : n;
    sheet_write(s, *data, n);
    *data += behind;
    *size -= behind;
    return n;
}

#endif
