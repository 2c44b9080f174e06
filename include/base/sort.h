/* Numbers in order. */
#ifndef BASE_SORT_H
#define BASE_SORT_H

/* Sorts n numbers, of which each is one (not NaN), the smallest first. */
void sort_numbers(double *x, int n);

#endif
