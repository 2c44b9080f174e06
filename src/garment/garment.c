/* A garment on its way into the program: read the text, find things by name. The statements
   of the format live in garment_parse.c, its rules in garment_check.c, the way back to text in
   garment_write.c. */
#include "garment/garment.h"

#include <string.h>

enum { FILE_MAX = 1 << 20 }; /* bytes; the largest garment the limits allow is a tenth of it */

const char *station_name(Station s) {
    static const char *const name[STATION_COUNT] = {"left", "front", "right", "back"};
    return s >= 0 && s < STATION_COUNT ? name[s] : "none";
}

const char *side_name(Side s) {
    static const char *const name[] = {"start", "end", "top", "bottom"};
    return name[s];
}

int garment_find_ring(const Garment *g, const char *name) {
    for (int i = 0; i < g->nrings; i++)
        if (strcmp(g->ring[i].name, name) == 0) return i;
    return -1;
}

const char *garment_piece_name(const Garment *g, int piece) {
    return piece < g->npanels ? g->panel[piece].name : g->patch[piece - g->npanels].name;
}

int garment_find_piece(const Garment *g, const char *name) {
    for (int i = 0; i < g->npanels + g->npatches; i++)
        if (strcmp(garment_piece_name(g, i), name) == 0) return i;
    return -1;
}

bool garment_read(const char *path, Arena *scratch, Garment *out, Error *e) {
    Text text;
    return text_read(path, FILE_MAX, scratch, &text, e) && garment_parse(&text, out, e);
}
