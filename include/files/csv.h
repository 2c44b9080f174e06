/* Texts as cells of a CSV table. */
#ifndef FILES_CSV_H
#define FILES_CSV_H

#include <stdio.h>

/* Quotes stand round a text with a comma or a quote in it, or with a blank or '#' where it would be lost; control
   bytes become '?', so that a row stays a line. NULL is the empty text. */
void csv_text(const char *text, FILE *out);

#endif
