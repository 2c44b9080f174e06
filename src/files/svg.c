/* The words of SVG. Numbers have few digits: a tenth of a point is finer than any printer
   needs, keeps files small, and lets pictures of equal things have equal bytes. */
#include "files/svg.h"

#include <math.h>

/* How many bytes the character of UTF-8 at s has; 0 where none begins. */
static int character(const char *s) {
    const unsigned char *b = (const unsigned char *)s;
    int n = b[0] < 0x80 ? 1 : b[0] < 0xC2 ? 0 : b[0] < 0xE0 ? 2 : b[0] < 0xF0 ? 3 : b[0] < 0xF5 ? 4 : 0;
    /* Longer than need be; a half of a pair of UTF-16; beyond the last character. */
    if ((b[0] == 0xE0 && b[1] < 0xA0) || (b[0] == 0xED && b[1] > 0x9F)) return 0;
    if ((b[0] == 0xF0 && b[1] < 0x90) || (b[0] == 0xF4 && b[1] > 0x8F)) return 0;
    for (int k = 1; k < n; k++)
        if ((b[k] & 0xC0) != 0x80) return 0;
    return n;
}

/* Control bytes are no XML, nor is what is no UTF-8, as in names of files: each such byte becomes '?'. */
static void put_escaped(FILE *out, const char *text) {
    for (const char *c = text; *c; c++) {
        int n = character(c);
        if (*c == '<') fputs("&lt;", out);
        else if (*c == '&') fputs("&amp;", out);
        else if (n == 0 || (unsigned char)*c < 32 || *c == 127) fputc('?', out);
        else fprintf(out, "%.*s", n, c), c += n - 1;
    }
}

void svg_open(FILE *out, double width, double height, const char *title) {
    fprintf(out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\"\n"
            " font-family=\"Helvetica,Arial,'Liberation Sans',sans-serif\" fill=\"none\" stroke-linejoin=\"round\">\n",
            width, height, width, height);
    fprintf(out, "<title>");
    put_escaped(out, title);
    fprintf(out, "</title>\n<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n");
}

void svg_close(FILE *out) { fputs("</svg>\n", out); }

/* A coordinate with one digit behind the point, and none that says nothing: "12", "0.5", "-3.1". */
static void put_number(FILE *out, double x) {
    double tenths = floor(x * 10 + 0.5);
    if (fmod(tenths, 10) == 0) fprintf(out, "%.0f", tenths == 0 ? 0 : tenths / 10);
    else fprintf(out, "%.1f", tenths / 10);
}

void svg_point(FILE *out, double x, double y) {
    put_number(out, x);
    if (floor(y * 10 + 0.5) >= 0) fputc(' ', out); /* a minus parts numbers by itself */
    put_number(out, y);
}

void svg_text(FILE *out, double x, double y, double size, SvgAnchor anchor, const char *text) {
    static const char *const names[] = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
    fputs("<text x=\"", out);
    put_number(out, x);
    fputs("\" y=\"", out);
    put_number(out, y);
    fprintf(out, "\" font-size=\"%.0f\" fill=\"#000\"%s>", size, names[anchor]);
    put_escaped(out, text);
    fputs("</text>\n", out);
}

void svg_text_turned(FILE *out, double x, double y, double size, const char *text) {
    fputs("<g transform=\"translate(", out);
    svg_point(out, x, y);
    fputs(")rotate(-90)\">", out);
    svg_text(out, 0, 0, size, SVG_MIDDLE, text);
    fputs("</g>\n", out);
}

double svg_text_width(const char *text, double size) {
    int letters = 0;
    for (const char *c = text; *c; c++) letters += ((unsigned char)*c & 0xC0) != 0x80; /* first bytes of UTF-8 */
    return 0.53 * size * letters;
}
