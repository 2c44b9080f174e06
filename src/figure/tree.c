/* The tree of a skeleton's joints, and its names.

   Names tell sides in more languages than names.c knows, and by numbers. Where they do, hip_a would be taken for the
   pelvis. But two chains of the same names and lengths that leave one joint can only be limbs of the two sides: their
   names are read so, whatever the word is that tells them apart. */
#include "figure/tree.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

static bool is_letter(char c) { return isalnum((unsigned char)c) || (unsigned char)c >= 128; }

/* The length of what all names below a ROOT begin with, up to its last sign: mixamorig: or Bip01_. It is the name of
   the character and tells nothing of bones, though it may be made of words that do. */
static size_t shared_start(const Skeleton *s, int root) {
    const char *first = NULL;
    size_t length = 0;
    for (int j = root + 1; j < s->njoints && s->joint[j].parent >= 0; j++) {
        const char *name = s->joint[j].name;
        size_t same = 0;
        if (s->joint[j].is_end) continue;
        if (!first) first = name, length = strlen(name);
        while (same < length && name[same] == first[same]) same++;
        length = same;
    }
    while (length > 0 && is_letter(first[length - 1])) length--;
    return length;
}

/* What the names of a joint and of those below it tell of sides. */
typedef struct {
    const char *name; /* without what all names begin with */
    bool is_sideless; /* could all of it be a limb whose names tell the side in an unknown word? */
    bool is_sided;    /* it is part of such a limb */
} Naming;

static void read_names(const Skeleton *s, Naming *naming, NameHint *hint) {
    size_t shared = 0;
    for (int j = 0; j < s->njoints; j++) {
        if (s->joint[j].parent < 0) shared = shared_start(s, j);
        naming[j].name = s->joint[j].name + (s->joint[j].parent < 0 ? 0 : shared);
        if (!s->joint[j].is_end) hint[j] = name_hint(naming[j].name);
    }
}

static void measure(Tree *t) {
    for (int j = 0; j < t->skeleton->njoints; j++) t->child[j] = t->sibling[j] = -1;
    for (int j = t->skeleton->njoints - 1; j >= 0; j--) {
        int parent = t->skeleton->joint[j].parent;
        if (parent < 0) continue;
        t->sibling[j] = t->child[parent];
        t->child[parent] = j;
        t->bone[j] = sample_distance(t->sample, parent, j);
        t->reach[parent] = fmax(t->reach[parent], t->bone[j] + t->reach[j]);
    }
}

/* --- limbs whose names tell their side in a word that is not known --- */

/* Not where a name tells a side, or a part of the trunk above the pelvis. */
static bool may_be_sideless(const NameHint *h) {
    bool may_be = h->side == 0;
    for (int part = PART_SPINE; part <= PART_HEAD; part++) may_be = may_be && h->weight[part] == 0;
    return may_be;
}

/* Are the names the same but for one short stretch? */
static bool names_alike(const char *a, const char *b) {
    enum { SIDE_MOST = 12 }; /* bytes of a word that tells a side */
    size_t same = 0, na = strlen(a), nb = strlen(b);
    while (same < na && same < nb && a[same] == b[same]) same++;
    while (na > same && nb > same && a[na - 1] == b[nb - 1]) na--, nb--;
    return na - same <= SIDE_MOST && nb - same <= SIDE_MOST;
}

/* Do chains that differ in nothing but a word begin with these two children of a joint? */
static bool are_twins(const Tree *t, const Naming *naming, int a, int b) {
    static const double ALIKE = 0.2; /* logarithm of the ratio of their lengths */
    if (!naming[a].is_sideless || !naming[b].is_sideless || !(t->reach[a] > 0 && t->reach[b] > 0)) return false;
    return fabs(log(t->reach[a] / t->reach[b])) < ALIKE && names_alike(naming[a].name, naming[b].name) &&
           memcmp(t->hint[a].weight, t->hint[b].weight, sizeof t->hint[a].weight) == 0;
}

static void find_sided(const Tree *t, Naming *naming) {
    enum { SIBLINGS_MAX = 12 }; /* so many that stand behind a joint are compared with it */
    const Skeleton *s = t->skeleton;
    for (int j = 0; j < s->njoints; j++) naming[j].is_sideless = s->joint[j].is_end || may_be_sideless(&t->hint[j]);
    for (int j = s->njoints - 1; j >= 0; j--)
        if (s->joint[j].parent >= 0 && !naming[j].is_sideless) naming[s->joint[j].parent].is_sideless = false;
    for (int j = 0; j < s->njoints; j++) {
        int twin = t->sibling[j];
        if (s->joint[j].parent >= 0 && naming[s->joint[j].parent].is_sided) naming[j].is_sided = true;
        for (int k = 0; k < SIBLINGS_MAX && twin >= 0; k++, twin = t->sibling[twin])
            if (are_twins(t, naming, j, twin)) naming[j].is_sided = naming[twin].is_sided = true;
    }
}

bool tree_build(const Skeleton *skeleton, const Sample *sample, Arena *arena, Tree *out, Error *e) {
    int n = skeleton->njoints;
    Naming *naming = ARENA_NEW(arena, Naming, n, e);
    Tree t = {skeleton, sample, ARENA_NEW(arena, NameHint, n, e), ARENA_NEW(arena, int, n, e),
              ARENA_NEW(arena, int, n, e), ARENA_NEW(arena, double, n, e), ARENA_NEW(arena, double, n, e)};
    if (!naming || !t.hint || !t.child || !t.sibling || !t.bone || !t.reach) return false;
    read_names(skeleton, naming, t.hint);
    measure(&t);
    find_sided(&t, naming);
    for (int j = 0; j < n; j++)
        if (naming[j].is_sided && !skeleton->joint[j].is_end) t.hint[j] = name_hint_sided(naming[j].name);
    *out = t;
    return true;
}

bool tree_below(const Tree *t, int joint, int ancestor) { return skeleton_below(t->skeleton, joint, ancestor); }

int tree_past_nodes(const Tree *t, int joint, Part part) {
    static const double AT_PARENT = 0.02; /* distance to the parent against the chain below */
    for (int next = joint; next >= 0;) {
        joint = next;
        next = -1;
        if (t->bone[joint] > AT_PARENT * t->reach[joint]) break;
        for (int c = t->child[joint]; c >= 0; c = t->sibling[c])
            if (t->hint[c].weight[part] > 0 && t->hint[c].weight[part] >= t->hint[joint].weight[part]) next = c;
    }
    return joint;
}
