/* CSV as RFC 4180 has it, but for line ends within a cell, which nobody expects. */
#include "files/csv.h"

#include <stdbool.h>
#include <string.h>

void csv_text(const char *text, FILE *out) {
    if (!text) return;
    size_t n = strlen(text);
    bool quoted = strpbrk(text, ",\"") || (n > 0 && (text[0] == ' ' || text[0] == '#' || text[n - 1] == ' '));
    if (quoted) fputc('"', out);
    for (; *text; text++) {
        unsigned char c = (unsigned char)*text;
        if (c == '"') fputc('"', out);
        fputc(c < 32 || c == 127 ? '?' : c, out);
    }
    if (quoted) fputc('"', out);
}
