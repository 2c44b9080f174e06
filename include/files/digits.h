/* Lines of numbers as text, sixteen at a time. */
#ifndef FILES_DIGITS_H
#define FILES_DIGITS_H

#include "geometry/vectors.h"

/* DIGITS_ROOM: bytes that a line needs. */
enum { DIGITS_LINES = 16, DIGITS_COLUMNS = 3, DIGITS_ROOM = 40 };

/* Writes sixteen lines and returns the end: each the tag (one or two letters) and `columns` <= 3 of the
   numbers x, times unit, with a blank before, as printf("%.6f") does. There are 48 numbers at x, whether
   they are all written or not. NULL, with nothing of use written, if any of them is not below 10 in
   magnitude or not finite, or its last digit is hard to tell: then decimal_put must do it. */
char *digits_lines(char *out, const char *tag, const double *x, double unit, int columns, Vectors vectors);

#endif
