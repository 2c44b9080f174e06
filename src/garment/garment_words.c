/* The words of a garment line: parts, rings, pieces, stations, numbers, weights. A word that is
   none of those that could stand there is answered with the one that was probably meant. */
#include "garment/words.h"

#include <math.h>
#include <string.h>

static const double SUM_IS_ONE = 1e-9; /* weights with such a sum stay as they are, so writing and reading is stable */

bool words_unknown(const Line *line, int i, Error *e, const char *what, const Nearest *n) {
    return nearest_error(n, what, text_place(&line->at, line->word[i]), e);
}

/* A word that is near none of those that could stand there: so all of them are named. */
static void unknown_choice(const Line *line, int i, const char *what, const char *const *words, int n, Error *e) {
    char list[120] = "";
    size_t used = 0;
    for (int k = 0; k < n && used < sizeof list; k++)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", k == 0 ? "" : k + 1 < n ? ", " : " or ",
                                 words[k]);
    int shown = error_shown(line->length[i]);
    text_error(line, i, e, "unknown %s '%.*s': expected %s", what, shown, line->word[i], list);
}

int words_choose(const Line *line, int i, const char *what, const char *const *words, int n, Error *e) {
    char word[GARMENT_NAME_MAX];
    if (!text_word(line, i, word, sizeof word, e)) return -1;
    Nearest near = {.word = word};
    for (int k = 0; k < n; k++) {
        if (strcmp(word, words[k]) == 0) return k;
        nearest_try(&near, words[k]);
    }
    if (near.best) words_unknown(line, i, e, what, &near);
    else unknown_choice(line, i, what, words, n, e);
    return -1;
}

bool words_part(const Line *line, int i, Role *out, Error *e) {
    char word[GARMENT_NAME_MAX];
    if (!text_word(line, i, word, sizeof word, e)) return false;
    *out = role_find(word, (int)strlen(word));
    if (*out < ROLE_COUNT) return true;
    return role_unknown(word, "body part", text_place(&line->at, line->word[i]), e);
}

bool words_ring_named(const Garment *g, const char *name, const Line *line, int i, int *out, Error *e) {
    *out = garment_find_ring(g, name);
    if (*out >= 0) return true;
    Nearest near = {.word = name};
    for (int k = 0; k < g->nrings; k++) nearest_try(&near, g->ring[k].name);
    return words_unknown(line, i, e, "ring", &near);
}

bool words_ring(const Garment *g, const Line *line, int i, int *out, Error *e) {
    char name[GARMENT_NAME_MAX];
    return text_word(line, i, name, sizeof name, e) && words_ring_named(g, name, line, i, out, e);
}

bool words_piece_named(const Garment *g, const char *name, const Line *line, int i, int *out, Error *e) {
    *out = garment_find_piece(g, name);
    if (*out >= 0) return true;
    Nearest near = {.word = name};
    for (int k = 0; k < g->npanels + g->npatches; k++) nearest_try(&near, garment_piece_name(g, k));
    return words_unknown(line, i, e, "panel or patch", &near);
}

bool words_station(const Line *line, int i, Station *out, Error *e) {
    const char *words[STATION_COUNT];
    for (int s = 0; s < STATION_COUNT; s++) words[s] = station_name((Station)s);
    int k = words_choose(line, i, "station", words, STATION_COUNT, e);
    *out = (Station)k;
    return k >= 0;
}

/* Cuts word i at its dot: NAME.REST, both not empty. */
static bool split_word(const Line *line, int i, const char *expected, char name[GARMENT_NAME_MAX], Line *rest,
                       Error *e) {
    const char *word = line->word[i], *dot = i < line->count ? memchr(word, '.', (size_t)line->length[i]) : NULL;
    if (!dot || dot == word || dot + 1 == word + line->length[i]) {
        int n = i < line->count ? line->length[i] : 0;
        return text_error(line, i, e, "expected %s, found '%.*s'", expected, error_shown(n), n ? word : "");
    }
    Line whole = *line;
    whole.length[i] = (int)(dot - word);
    *rest = *line;
    rest->word[i] = dot + 1;
    rest->length[i] = (int)(word + line->length[i] - (dot + 1));
    return text_word(&whole, i, name, GARMENT_NAME_MAX, e);
}

bool words_ring_station(const Garment *g, const Line *line, int i, int *ring, Station *station, Error *e) {
    char name[GARMENT_NAME_MAX];
    Line rest;
    return split_word(line, i, "RING.STATION", name, &rest, e) && words_ring_named(g, name, line, i, ring, e) &&
           words_station(&rest, i, station, e);
}

bool words_piece_side(const Garment *g, const Line *line, int i, int *piece, Side *side, Error *e) {
    const char *words[4];
    char name[GARMENT_NAME_MAX];
    Line rest;
    if (!split_word(line, i, "PIECE.SIDE", name, &rest, e) || !words_piece_named(g, name, line, i, piece, e))
        return false;
    for (int s = 0; s < 4; s++) words[s] = side_name((Side)s);
    int k = words_choose(&rest, i, "side", words, 4, e);
    *side = (Side)k;
    return k >= 0;
}

bool words_number(const Line *line, int i, double low, double high, double *out, Error *e) {
    if (!text_real(line, i, out, e)) return false;
    return (*out >= low && *out <= high) || text_error(line, i, e, "expected a number from %g to %g", low, high);
}

static bool length_from(double low, const Line *line, int i, double *out, Error *e) {
    if (!text_real(line, i, out, e)) return false;
    return (*out >= low && *out <= LENGTH_MAX) ||
           text_error(line, i, e, "expected metres, from %g to %d", low, LENGTH_MAX);
}

bool words_length(const Line *line, int i, double *out, Error *e) { return length_from(-LENGTH_MAX, line, i, out, e); }

bool words_size(const Line *line, int i, double *out, Error *e) { return length_from(0, line, i, out, e); }

bool words_vector(const Line *line, int i, Vec3 *out, Error *e) {
    return words_length(line, i, &out->x, e) && words_length(line, i + 1, &out->y, e) &&
           words_length(line, i + 2, &out->z, e);
}

bool words_binding(const Line *line, int i, Binding *out, Error *e) {
    *out = (Binding){0};
    double sum = 0;
    if (i >= line->count)
        return text_error(line, i, e, "expected a body part and its weight, found the end of the line");
    for (; i < line->count; i += 2) {
        if (out->n == BINDING_MAX) return text_error(line, i, e, "more than %d body parts for one point", BINDING_MAX);
        Role *bone = &out->bone[out->n];
        double *weight = &out->weight[out->n];
        if (!words_part(line, i, bone, e) || !text_real(line, i + 1, weight, e)) return false;
        for (int k = 0; k < out->n; k++)
            if (out->bone[k] == *bone) return text_error(line, i, e, "'%s' is named twice", role_name(*bone));
        if (!(*weight >= 1e-6 && *weight <= 1e6))
            return text_error(line, i + 1, e, "a weight must be positive, from 1e-6 to 1e6");
        sum += *weight;
        out->n++;
    }
    for (int k = 0; fabs(sum - 1) > SUM_IS_ONE && k < out->n; k++) out->weight[k] /= sum;
    return true;
}
