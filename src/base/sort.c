/* What qsort needs to be told of numbers. */
#include "base/sort.h"

#include <stdlib.h>

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void sort_numbers(double *x, int n) { qsort(x, (size_t)n, sizeof *x, by_size); }
