/* The text format of bodies: exact round trips, and every mistake at its place. */
#include "figure/body.h"

#include <stdlib.h>
#include <string.h>

#include "tap.h"

static Text text_of(const char *s) { return (Text){"x.body", s, strlen(s)}; }

static char *written(const BodySpec *spec) {
    char *text = NULL;
    size_t size = 0;
    FILE *f = open_memstream(&text, &size);
    bool good = body_write(spec, f);
    fclose(f);
    if (!good) text[0] = 0;
    return text;
}

static void test_round_trip(void) {
    static BodySpec again;
    Error e = {0};
    char *first = written(body_default());
    Text text = text_of(first);
    OK(body_parse(&text, &again, &e), "the adult's text reads back %s", e.text);
    OK(memcmp(&again, body_default(), sizeof again) == 0, "as the same body to the bit");
    char *second = written(&again);
    OK(strcmp(first, second) == 0, "and is written as the same bytes");
    OK(strstr(first, "\nmirror right_thigh\n") != NULL, "the right side is written as a mirror");
    size_t n = strlen(first);
    int wrong = 0;
    for (size_t cut = 0; cut < n; cut++) { /* a body file cut anywhere is an error or a smaller body */
        char *part = strndup(first, cut);
        Text t = text_of(part);
        Error refused = {0};
        if (body_parse(&t, &again, &refused)) wrong += again.nparts < 1;
        else wrong += refused.kind != ERR_INPUT || refused.line < 1;
        free(part);
    }
    OK(wrong == 0, "cut at each of %zu bytes it is read or refused with a place", n);
    free(first);
    free(second);
}

/* garments/adult.body is a comment and then what body_write makes of the compiled-in adult. */
static void test_shipped_adult(void) {
    static BodySpec shipped;
    Arena arena = {0};
    Error e = {0};
    Text text = {0};
    char *adult = written(body_default());
    OK(body_read("garments/adult.body", &arena, &shipped, &e), "garments/adult.body is read %s", e.text);
    OK(memcmp(&shipped, body_default(), sizeof shipped) == 0, "it is the compiled-in adult");
    OK(text_read("garments/adult.body", 1 << 20, &arena, &text, &e) && strstr(text.data, adult),
       "as body_write writes it");
    free(adult);
    arena_free(&arena);
}

static void test_bad_text(void) {
#define HEAD "body b\npart neck\n"
#define TWO "section 0 0 0 .1 .1 .1\nsection 1 0 0 .1 .1 .1\n"
    static const struct {
        const char *text;
        int line, column;
        const char *says;
    } bad[] = {
        {"", 1, 1, "empty body file"},
        {"part neck\n", 1, 1, "expected 'body NAME'"},
        {"body\n", 1, 5, "expected a name"},
        {"body a b\n", 1, 8, "unexpected 'b'"},
        {"body b\n", 1, 7, "at least one part"},
        {"body b\npart tail\n" TWO, 2, 6, "unknown body part 'tail'"},
        {"body b\npart left_thig\n" TWO, 2, 6, "did you mean 'left_thigh'"},
        {HEAD TWO "part neck\n" TWO, 5, 6, "given twice"},
        {HEAD "section 0 0 0 .1 .1 .1\n", 2, 6, "has 1 section, it needs"},
        {HEAD "part head\n" TWO, 2, 6, "has 0 sections"},
        {HEAD "section 0 0 0 .1 .1 .1\nsection 0 0 0 .1 .1 .1\n", 4, 9, "must grow"},
        {HEAD "section 0 0 0 0 .1 .1\n", 3, 15, "side must be"},
        {HEAD "section 0 0 0 .1 -1 .1\n", 3, 18, "front must be"},
        {HEAD "section 0 0 0 .1 .1 1.01\n", 3, 21, "back must be"},
        {HEAD "section 0 0 -1.01 .1 .1 .1\n", 3, 13, "z must be"},
        {HEAD "section 0 0 nan .1 .1 .1\n", 3, 13, "expected a number"},
        {HEAD "section 10.1 0 0 .1 .1 .1\n", 3, 9, "at must be"},
        {HEAD "section 0 0 0 .1 .1\n", 3, 20, "'back' is missing"},
        {HEAD "section 0 0 0 .1 .1 .1 7\n", 3, 24, "unexpected '7'"},
        {"body b\n" TWO, 2, 1, "outside of a part"},
        {"body b\ncaps 0 0\n", 2, 1, "outside of a part"},
        {HEAD TWO "caps 0\n", 5, 7, "expected a number"},
        {HEAD TWO "caps 0 -1\n", 5, 8, "a cap must be"},
        {HEAD TWO "mirror neck\n", 5, 8, "given twice"},
        {HEAD TWO "mirror head\n", 5, 8, "no other side"},
        {HEAD TWO "mirror left_hand\n", 5, 8, "must be given before"},
        {HEAD TWO "tail 1\n", 5, 1, "expected 'part', 'section', 'caps' or 'mirror'"},
        {HEAD "secton 0 0 0 .1 .1 .1\n", 3, 1, "expected 'part', 'section', 'caps' or 'mirror', found 'secton'"},
    };
    static BodySpec out;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        Error e = {0};
        Text text = text_of(bad[i].text);
        bool refused = !body_parse(&text, &out, &e);
        bool placed = e.kind == ERR_INPUT && e.line == bad[i].line && e.column == bad[i].column;
        OK(refused && placed && strstr(e.text, bad[i].says), "refused at %d:%d: %s (%d:%d %s)", bad[i].line,
           bad[i].column, bad[i].says, e.line, e.column, e.text);
    }
    char many[4096] = HEAD;
    for (int i = 0; i <= SPEC_SECTIONS_MAX; i++)
        snprintf(many + strlen(many), 64, "section %g 0 0 .1 .1 .1\n", 0.25 * i);
    Error e = {0};
    Text text = text_of(many);
    OK(!body_parse(&text, &out, &e) && e.line == 3 + SPEC_SECTIONS_MAX && strstr(e.text, "more than"),
       "too many sections: %s", e.text);
    Text widest = text_of(HEAD "section -10 -1 1 .001 .001 1\nsection 10 1 -1 1 1 .001\n");
    Error fine = {0};
    OK(body_parse(&widest, &out, &fine), "the widest part that is read %s", fine.text);
    Text mirror = text_of("body b\npart right_hand\nsection 0 .5 0 .1 .1 .1\nsection 1 0 0 .1 .1 .1\n"
                          "mirror left_hand\n");
    Error none = {0};
    OK(body_parse(&mirror, &out, &none) && out.nparts == 2, "a mirror is a part");
    OK(out.part[1].role == ROLE_LEFT_HAND && out.part[1].section[0].x == -0.5, "with x turned round");
}

int main(void) {
    test_round_trip();
    test_shipped_adult();
    test_bad_text();
    return tap_done();
}
