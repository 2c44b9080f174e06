/* Reading the words of a garment line. All take word i of the line, record an error at its place
   and return false where it is not what was asked for. */
#ifndef GARMENT_WORDS_H
#define GARMENT_WORDS_H

#include "garment/garment.h"

enum { LENGTH_MAX = 10 };  /* metres; nothing worn is longer: a slip of the pen, centimetres most often */
enum { PLACE_MAX = 10 };   /* bone lengths; a ring farther from its bone is a slip of the pen, per cent most often */

/* nearest_error at word i. */
bool words_unknown(const Line *line, int i, Error *e, const char *what, const Nearest *n);

/* The number of the word among n words, -1 with an error. */
int words_choose(const Line *line, int i, const char *what, const char *const *words, int n, Error *e);

MUST_CHECK bool words_part(const Line *line, int i, Role *out, Error *e);
MUST_CHECK bool words_station(const Line *line, int i, Station *out, Error *e);

/* The ring, or the panel or patch, called `name`; i is only the place for the error. */
MUST_CHECK bool words_ring_named(const Garment *g, const char *name, const Line *line, int i, int *out, Error *e);
MUST_CHECK bool words_piece_named(const Garment *g, const char *name, const Line *line, int i, int *out, Error *e);

/* RING, RING.STATION, PIECE.SIDE */
MUST_CHECK bool words_ring(const Garment *g, const Line *line, int i, int *out, Error *e);
MUST_CHECK bool words_ring_station(const Garment *g, const Line *line, int i, int *ring, Station *station, Error *e);
MUST_CHECK bool words_piece_side(const Garment *g, const Line *line, int i, int *piece, Side *side, Error *e);

/* Numbers are finite and never -0. Lengths are metres, sizes not less than 0. A vector is three lengths. */
MUST_CHECK bool words_number(const Line *line, int i, double low, double high, double *out, Error *e);
MUST_CHECK bool words_length(const Line *line, int i, double *out, Error *e);
MUST_CHECK bool words_size(const Line *line, int i, double *out, Error *e);
MUST_CHECK bool words_vector(const Line *line, int i, Vec3 *out, Error *e);

/* PART WEIGHT pairs from word i to the end of the line; the weights are made to sum to 1. */
MUST_CHECK bool words_binding(const Line *line, int i, Binding *out, Error *e);

#endif
