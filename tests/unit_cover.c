/* Sleeves of known size round a figure of tubes. */
#include "dress/cover.h"

#include "figure/roles.h"
#include "tap.h"

enum { AROUND = 64, RINGS = 12, ROOM = 20000 };

static Arena arena;

static Mesh empty(void) {
    Error e = {0};
    Mesh m = {0};
    m.position = ARENA_NEW(&arena, Vec3, ROOM, &e);
    m.triangle = ARENA_NEW(&arena, Triangle, ROOM, &e);
    m.group = ARENA_NEW(&arena, MeshGroup, ROLE_COUNT, &e);
    return m;
}

/* A tube upright from y = low to high at x; `share` of it goes round, from the front (z) on. */
static void tube(Mesh *m, const char *name, double x, double low, double high, double radius, double share) {
    int first = m->ntriangles, v = m->nvertices;
    for (int r = 0; r <= RINGS; r++)
        for (int k = 0; k <= AROUND; k++) {
            double angle = 2 * PI * share * k / AROUND;
            double y = low + (high - low) * r / RINGS;
            m->position[m->nvertices++] = vec(x + radius * sin(angle), y, radius * cos(angle));
        }
    for (int r = 0; r < RINGS; r++)
        for (int k = 0; k < AROUND; k++) {
            int i = v + r * (AROUND + 1) + k;
            m->triangle[m->ntriangles++] = (Triangle){{i, i + 1, i + AROUND + 1}};
            m->triangle[m->ntriangles++] = (Triangle){{i + 1, i + AROUND + 2, i + AROUND + 1}};
        }
    m->group[m->ngroups++] = (MeshGroup){name, first, m->ntriangles - first};
}

static Mesh figure(void) {
    Mesh m = empty();
    tube(&m, role_name(ROLE_LEFT_SHIN), 0.1, 0.1, 0.5, 0.05, 1);
    tube(&m, role_name(ROLE_RIGHT_SHIN), -0.1, 0.1, 0.5, 0.05, 1);
    tube(&m, role_name(ROLE_LEFT_THIGH), 0.1, 0.5, 0.9, 0.07, 1);
    tube(&m, role_name(ROLE_RIGHT_THIGH), -0.1, 0.5, 0.9, 0.07, 1);
    tube(&m, role_name(ROLE_PELVIS), 0, 0.85, 1.05, 0.15, 1);
    tube(&m, role_name(ROLE_CHEST), 0, 1.1, 1.5, 0.15, 1);
    return m;
}

static void measure(const Mesh *body, double low, double high, double share, double out[COVER_COUNT]) {
    Error e = {0};
    Mesh cloth = empty();
    tube(&cloth, "cloth", 0, low, high, 0.3, share);
    OK(cover_measure(body, &cloth, &arena, out, &e), "cloth from %.2f to %.2f, %.2f round", low, high, share);
}

int main(void) {
    Mesh body = figure(), headless = empty();
    double c[COVER_COUNT];
    measure(&body, 0.3, 1, 1, c);
    OK(c[COVER_HIPS] == 1 && c[COVER_THIGHS] == 1 && c[COVER_KNEES] == 1, "a long skirt covers them all");
    OK(c[COVER_TORSO] == 0, "and no torso");
    measure(&body, 0.6, 1, 1, c);
    OK(c[COVER_HIPS] == 1 && c[COVER_THIGHS] == 1 && c[COVER_KNEES] == 0, "one above the knee covers hips and thighs");
    measure(&body, 1, 1.5, 1, c);
    OK(c[COVER_HIPS] == 0 && c[COVER_TORSO] == 1, "a shirt covers the torso");
    measure(&body, 1, 1.5, 0.75, c);
    NEAR(c[COVER_TORSO], 0.75, 0.04, "an open one covers what it goes round");
    measure(&body, 0.3, 1, 0.5, c);
    OK(c[COVER_THIGHS] < 0.5, "of two thighs the barer one counts (%.2f)", c[COVER_THIGHS]);
    tube(&headless, "stick", 0, 0, 1, 0.1, 1);
    measure(&headless, 0.3, 1, 1, c);
    OK(isnan(c[COVER_HIPS]) && isnan(c[COVER_TORSO]), "without roles there are no landmarks");
    arena_free(&arena);
    return tap_done();
}
