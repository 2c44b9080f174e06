/* SVG by its few words that figures need: what print takes and every browser shows. Lengths are
   points; y points down. Nothing here fails: errors stay with the stream, as output_close wants. */
#ifndef FILES_SVG_H
#define FILES_SVG_H

#include <stdio.h>

typedef enum { SVG_START, SVG_MIDDLE, SVG_END } SvgAnchor;

/* A picture on white paper. `title` is what screen readers say and browsers show. */
void svg_open(FILE *out, double width, double height, const char *title);
void svg_close(FILE *out);

/* Two coordinates, apart from each other. */
void svg_point(FILE *out, double x, double y);

/* Text whose foot stands at (x, y), read upwards where it is turned. Any bytes may be in it. */
void svg_text(FILE *out, double x, double y, double size, SvgAnchor anchor, const char *text);
void svg_text_turned(FILE *out, double x, double y, double size, const char *text);

/* About as wide as the text is drawn. */
double svg_text_width(const char *text, double size);

#endif
