/* Union-find with path halving; the smallest member is the root, so that the result does not
   depend on the order of joining. */
#include "geometry/sets.h"

bool sets_make(Sets *sets, int n, Arena *arena, Error *e) {
    sets->parent = ARENA_NEW(arena, int, n, e);
    sets->turned = ARENA_NEW(arena, bool, n, e);
    if (!sets->parent || !sets->turned) return false;
    for (int i = 0; i < n; i++) sets->parent[i] = i;
    return true;
}

int sets_find(Sets *sets, int i, bool *turned) {
    bool against = false;
    while (sets->parent[i] != i) {
        int up = sets->parent[i];
        sets->turned[i] ^= sets->turned[up]; /* a root is never turned */
        sets->parent[i] = sets->parent[up];
        against ^= sets->turned[i];
        i = sets->parent[i];
    }
    if (turned) *turned = against;
    return i;
}

void sets_join(Sets *sets, int a, int b, bool against) {
    bool turned_a, turned_b;
    int root_a = sets_find(sets, a, &turned_a), root_b = sets_find(sets, b, &turned_b);
    if (root_a == root_b) return;
    int first = root_a < root_b ? root_a : root_b, other = root_a < root_b ? root_b : root_a;
    sets->parent[other] = first;
    sets->turned[other] = against ^ turned_a ^ turned_b;
}
