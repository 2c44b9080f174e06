/* Numbers as text, fast. */
#ifndef FILES_DECIMAL_H
#define FILES_DECIMAL_H

/* Room that either function may need, a final NUL included (1.8e308 has 309 digits). */
enum { DECIMAL_MAX = 320 };

/* Writes what printf("%.6f") writes and returns the end; no final NUL. Needs DECIMAL_MAX bytes. */
char *decimal_put(char *out, double x);

/* The same for n >= 0 and "%d". */
char *decimal_put_int(char *out, int n);

#endif
