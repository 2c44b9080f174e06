/* A joint's name as a few known words.

   Every naming family writes the same few words in its own way: LeftUpLeg, lThigh, thigh_l, DEF-thigh.L.001,
   "Bip01 L Thigh", lfemur. So a name is cut at signs, capitals and digits, the pieces are cut into words of one small
   vocabulary, and phrases of one or two words vote for bones. A word may vote for several bones, because families
   disagree: LeftShoulder is the clavicle in one and the upper arm in another. Which is right is decided where the whole
   limb is known (limbs.c), not here. */
#include "figure/names.h"

#include <ctype.h>
#include <string.h>

enum { WORDS_MAX = 16, TOKEN_MAX = 40 };

/* Words that say nothing, or something only as part of a phrase. */
static const char *const other[] = {
    "ball", "blade", "bone", "joint", "base", "root", "center", "centre", "mid", "twist", "roll", "bend", "share",
    "def", "org", "mch", "fk", "jnt", "jt", "bip", "rig", "character", "skeleton", "main", "body", "in", "up", "upper",
    "low", "lower", "fore", "front",
};
/* Words of what is no bone of the human: helpers, fingers, the face, clothes, things. */
static const char *const strangers[] = {
    "end", "nub", "tip", "site", "ik", "pole", "target", "ctrl", "control", "helper", "muscle", "effector", "eff",
    "dummy", "eye", "eyes", "eyelid", "ear", "jaw", "hair", "breast", "bust", "thumb", "index", "middle", "ring",
    "pinky", "pinkie", "finger", "fingers", "metacarpal", "carpal", "heel", "tongue", "brow", "lip", "lips", "cheek",
    "nose", "mouth", "teeth", "weapon", "prop", "skirt", "cloth", "tail", "wing", "buttock", "butt", "glute", "pad",
    "attach", "socket", "camera", "nail", "pec", "rib", "sole", "coat", "cape", "dress", "robe", "scarf", "ribbon",
    "sleeve", "sword", "gun", "bag", "belt", "hat", "horn", "feather",
};

/* Left and right: in Latin letters as words of a name, in others wherever they stand. */
typedef struct { const char *word; int side; } Side;
static const Side sides[] = {
    {"l", 1}, {"left", 1}, {"le", 1}, {"lt", 1}, {"lft", 1}, {"links", 1}, {"gauche", 1}, {"izq", 1}, {"izquierda", 1},
    {"izquierdo", 1}, {"sx", 1}, {"sinistra", 1}, {"sinistro", 1},
    {"r", -1}, {"right", -1}, {"ri", -1}, {"rt", -1}, {"rgt", -1}, {"rechts", -1}, {"droite", -1}, {"droit", -1},
    {"der", -1}, {"derecha", -1}, {"derecho", -1}, {"dx", -1}, {"destra", -1}, {"destro", -1},
};
static const Side foreign_sides[] = {
    {"\xe5\xb7\xa6", 1}, {"\xe5\x8f\xb3", -1},                                             /* Japanese, Chinese */
    {"\xec\x99\xbc", 1}, {"\xec\x98\xa4\xeb\xa5\xb8", -1},                                 /* Korean */
    {"\xd0\xbb\xd0\xb5\xd0\xb2", 1}, {"\xd0\xbf\xd1\x80\xd0\xb0\xd0\xb2", -1},           /* Russian */
    {"\xd0\x9b\xd0\xb5\xd0\xb2", 1}, {"\xd0\x9f\xd1\x80\xd0\xb0\xd0\xb2", -1},           /* with a capital */
};
enum { NSIDES = sizeof sides / sizeof sides[0], NFOREIGN_SIDES = sizeof foreign_sides / sizeof foreign_sides[0] };

/* A phrase: one word, or two beside each other, and the bone that it votes for. where: 's' if it does so only in
   names that tell a side, 'c' only in names that do not, 0 in both. */
typedef struct {
    const char *first, *second;
    char where;
    Part part;
    double weight;
} Phrase;

static const Phrase phrases[] = {
    {"hip", "joint", 's', PART_THIGH, 0.2},
    {"hip", "center", 'c', PART_PELVIS, 1},
    {"lower", "body", 'c', PART_PELVIS, 0.8},
    {"spine", "base", 'c', PART_PELVIS, 0.6},
    {"spine", "shoulder", 'c', PART_CHEST, 0.8},
    {"lower", "back", 'c', PART_SPINE, 1},
    {"upper", "back", 'c', PART_CHEST, 0.5},
    {"upper", "body", 'c', PART_SPINE, 0.6},
    {"upper", "chest", 'c', PART_CHEST, 1},
    {"lower", "neck", 'c', PART_NECK, 1},
    {"upper", "neck", 'c', PART_NECK, 0.8},
    {"head", "neck", 'c', PART_NECK, 0.9}, /* XNALara: head neck lower, head neck upper */
    {"shoulder", "blade", 's', PART_CLAVICLE, 0.7},
    {"up", "arm", 's', PART_UPPER_ARM, 1},
    {"upper", "arm", 's', PART_UPPER_ARM, 1},
    {"fore", "arm", 's', PART_FOREARM, 1},
    {"lower", "arm", 's', PART_FOREARM, 1},
    {"low", "arm", 's', PART_FOREARM, 1},
    {"up", "leg", 's', PART_THIGH, 1},
    {"upper", "leg", 's', PART_THIGH, 1},
    {"lower", "leg", 's', PART_SHIN, 1},
    {"low", "leg", 's', PART_SHIN, 1},
    {"u", "arm", 's', PART_UPPER_ARM, 1}, /* OptiTrack: LUArm, LFArm */
    {"f", "arm", 's', PART_FOREARM, 1},
    {"toe", "base", 's', PART_TOE, 1},
    {"fore", "foot", 's', PART_TOE, 0.7},
    {"pelvis", NULL, 'c', PART_PELVIS, 1},
    {"hips", NULL, 'c', PART_PELVIS, 1},
    {"hip", NULL, 'c', PART_PELVIS, 0.9},
    {"root", NULL, 'c', PART_PELVIS, 0.3},
    {"spine", NULL, 'c', PART_SPINE, 1},
    {"back", NULL, 'c', PART_SPINE, 0.8},
    {"abdomen", NULL, 'c', PART_SPINE, 1},
    {"waist", NULL, 'c', PART_SPINE, 0.9},
    {"lumbar", NULL, 'c', PART_SPINE, 0.9},
    {"torso", NULL, 'c', PART_CHEST, 0.6},
    {"chest", NULL, 'c', PART_CHEST, 1},
    {"thorax", NULL, 'c', PART_CHEST, 1},
    {"ribcage", NULL, 'c', PART_CHEST, 0.9},
    {"neck", NULL, 'c', PART_NECK, 1},
    {"head", NULL, 'c', PART_HEAD, 1},
    {"skull", NULL, 'c', PART_HEAD, 1},
    {"clavicle", NULL, 's', PART_CLAVICLE, 1},
    {"clav", NULL, 's', PART_CLAVICLE, 1},
    {"collar", NULL, 's', PART_CLAVICLE, 1},
    {"scapula", NULL, 's', PART_CLAVICLE, 0.7},
    {"shoulder", NULL, 's', PART_CLAVICLE, 0.8},
    {"shoulder", NULL, 's', PART_UPPER_ARM, 0.7},
    {"shldr", NULL, 's', PART_CLAVICLE, 0.5},
    {"shldr", NULL, 's', PART_UPPER_ARM, 0.9},
    {"acromial", NULL, 's', PART_UPPER_ARM, 0.9},
    {"arm", NULL, 's', PART_UPPER_ARM, 0.9},
    {"uparm", NULL, 's', PART_UPPER_ARM, 1},
    {"uarm", NULL, 's', PART_UPPER_ARM, 1}, /* LUARM, where no capital tells words apart */
    {"farm", NULL, 's', PART_FOREARM, 1},
    {"humerus", NULL, 's', PART_UPPER_ARM, 1},
    {"bicep", NULL, 's', PART_UPPER_ARM, 0.7},
    {"elbow", NULL, 's', PART_FOREARM, 0.95},
    {"ulna", NULL, 's', PART_FOREARM, 0.9},
    {"radius", NULL, 's', PART_FOREARM, 0.85},
    {"wrist", NULL, 's', PART_HAND, 0.88},
    {"hand", NULL, 's', PART_HAND, 0.9},
    {"palm", NULL, 's', PART_HAND, 0.7},
    {"thigh", NULL, 's', PART_THIGH, 1},
    {"femur", NULL, 's', PART_THIGH, 1},
    {"hip", NULL, 's', PART_THIGH, 0.8},
    {"leg", NULL, 's', PART_THIGH, 0.5},
    {"leg", NULL, 's', PART_SHIN, 0.8},
    {"shin", NULL, 's', PART_SHIN, 1},
    {"shank", NULL, 's', PART_SHIN, 1},
    {"calf", NULL, 's', PART_SHIN, 1},
    {"tibia", NULL, 's', PART_SHIN, 1},
    {"knee", NULL, 's', PART_SHIN, 0.95},
    {"ankle", NULL, 's', PART_FOOT, 0.95},
    {"foot", NULL, 's', PART_FOOT, 0.9},
    {"foot", NULL, 's', PART_TOE, 0.3},
    {"talus", NULL, 's', PART_FOOT, 0.9},
    {"calcn", NULL, 's', PART_FOOT, 0.6},
    {"calcaneus", NULL, 's', PART_FOOT, 0.6},
    {"subtalar", NULL, 's', PART_FOOT, 0.4},
    {"toe", NULL, 's', PART_TOE, 1},
    {"toes", NULL, 's', PART_TOE, 1},
    {"ball", NULL, 's', PART_TOE, 0.9},
    {"mtp", NULL, 's', PART_TOE, 0.9},
    {"metatarsal", NULL, 's', PART_TOE, 0.6},
    {"metatarsals", NULL, 's', PART_TOE, 0.6},
};

enum { NPHRASES = sizeof phrases / sizeof phrases[0] };

/* Entry i of the vocabulary; NULL behind the last. */
static const char *vocabulary(int i) {
    const int nother = sizeof other / sizeof other[0], nstrangers = sizeof strangers / sizeof strangers[0];
    if (i < NPHRASES) return phrases[i].first;
    i -= NPHRASES;
    if (i < NSIDES) return sides[i].word;
    i -= NSIDES;
    if (i < nother) return other[i];
    i -= nother;
    return i < nstrangers ? strangers[i] : NULL;
}

typedef struct {
    int count;
    const char *word[WORDS_MAX];
    int side; /* told by other than Latin letters: +1 left, -1 right, 0 not told */
} Words;

/* Cuts a lower-case token into words of the vocabulary, longest first, all of it or nothing.
   A lone l or r may only stand at the token's start or end. */
static bool segment(const char *token, size_t length, bool at_start, Words *out) {
    if (length == 0) return true;
    for (size_t n = length; n > 0; n--) {
        bool at_end = n == length;
        if (n == 1 && !(at_start || at_end)) continue;
        for (int i = 0; vocabulary(i); i++) {
            const char *word = vocabulary(i);
            if (strlen(word) != n || memcmp(word, token, n) != 0) continue;
            if (out->count >= WORDS_MAX) return false;
            int count = out->count;
            out->word[out->count++] = word;
            if (segment(token + n, length - n, false, out)) return true;
            out->count = count;
            break;
        }
    }
    return false;
}

static bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
static bool is_lower(char c) { return c >= 'a' && c <= 'z'; }

/* Does a new token begin at s[i]? aB and ABc, where A ends one and B begins the next. */
static bool boundary(const char *s, size_t i) {
    if (!is_upper(s[i])) return false;
    return is_lower(s[i - 1]) || (is_upper(s[i - 1]) && is_lower(s[i + 1]));
}

static Words split(const char *name) {
    Words words = {0};
    for (int i = 0; i < NFOREIGN_SIDES; i++)
        if (strstr(name, foreign_sides[i].word)) words.side = foreign_sides[i].side;
    char token[TOKEN_MAX];
    for (size_t i = 0; name[i];) {
        size_t n = 0;
        if (!is_upper(name[i]) && !is_lower(name[i])) { i++; continue; }
        do {
            if (n < TOKEN_MAX) token[n] = (char)tolower((unsigned char)name[i]);
            n++;
            i++;
        } while ((is_upper(name[i]) || is_lower(name[i])) && !boundary(name, i));
        if (n <= TOKEN_MAX) (void)segment(token, n, true, &words);
    }
    return words;
}

static bool is(const char *word, const char *other_word) { return strcmp(word, other_word) == 0; }

/* +1 left, -1 right, 0 neither. */
static int side_of_word(const char *word) {
    for (int i = 0; i < NSIDES; i++)
        if (is(word, sides[i].word)) return sides[i].side;
    return 0;
}

/* The side by the last word that tells one: a first letter l or r may mean something else. */
static int side_of(const Words *w) {
    int side = w->side;
    for (int i = 0; i < w->count; i++)
        if (side_of_word(w->word[i])) side = side_of_word(w->word[i]);
    return side;
}

/* Factor for words that say that this is not the bone itself. */
static double doubt(const Words *w) {
    double factor = 1;
    for (int i = 0; i < w->count; i++) {
        if (is(w->word[i], "twist") || is(w->word[i], "roll") || is(w->word[i], "share")) factor *= 0.6;
        for (size_t k = 0; k < sizeof strangers / sizeof strangers[0]; k++)
            if (is(w->word[i], strangers[k])) factor *= 0.05;
    }
    return factor;
}

/* The word that goes with word i in a phrase of two: the next, or the one behind a side, as in UpperLeftArm. May be one
   behind the last. */
static int partner(const Words *w, int i) {
    int j = i + 1;
    return j + 1 < w->count && side_of_word(w->word[j]) ? j + 1 : j;
}

/* Do words i and j make up the phrase, in either order: UpperArm, arm_upper? j = i: does word i alone? */
static bool says(const Words *w, int i, int j, const Phrase *ph) {
    const char *a = w->word[i], *b = w->word[j];
    if (i == j || !ph->second) return i == j && !ph->second && is(a, ph->first);
    return (is(a, ph->first) && is(b, ph->second)) || (is(b, ph->first) && is(a, ph->second));
}

/* Counts the votes of all phrases that words i and j make up; not those of the class `other_class` (see Phrase).
   Returns whether there is one. */
static bool vote(const Words *w, int i, int j, char other_class, double factor, NameHint *hint) {
    bool any = false;
    for (int p = 0; p < NPHRASES; p++) {
        const Phrase *ph = &phrases[p];
        if (ph->where == other_class) continue;
        if (!says(w, i, j, ph)) continue;
        any = true;
        if (ph->weight * factor > hint->weight[ph->part]) hint->weight[ph->part] = ph->weight * factor;
    }
    return any;
}

static NameHint read_name(const char *name, bool sided) {
    Words w = split(name);
    NameHint hint = {.side = side_of(&w)};
    char other_class = sided || hint.side != 0 ? 'c' : 's';
    double factor = doubt(&w);
    bool used[WORDS_MAX] = {false};
    for (int i = 0; i < w.count; i++) {
        int j = partner(&w, i);
        if (j < w.count && !used[i] && vote(&w, i, j, other_class, factor, &hint)) used[i] = used[j] = true;
    }
    for (int i = 0; i < w.count; i++)
        if (!used[i]) vote(&w, i, i, other_class, factor, &hint);
    hint.stranger = factor < 0.1;
    for (int part = 0; part < PART_COUNT; part++) hint.stranger = hint.stranger && hint.weight[part] == 0;
    return hint;
}

NameHint name_hint(const char *name) { return read_name(name, false); }

NameHint name_hint_sided(const char *name) { return read_name(name, true); }
