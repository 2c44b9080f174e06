/* A small mesh for the tests of files. */
#ifndef TESTS_WAVE_H
#define TESTS_WAVE_H

#include <math.h>

#include "geometry/mesh.h"

enum { SIDE = 12, VERTICES = SIDE * SIDE, TRIANGLES = 2 * (SIDE - 1) * (SIDE - 1) };

typedef struct {
    Vec3 position[VERTICES], normal[VERTICES + 2];
    double u[VERTICES], w[VERTICES];
    Triangle triangle[TRIANGLES];
    MeshGroup group[3];
    Crease crease[3];
    Mesh mesh;
} Wave;

/* A wavy sheet in two groups (and one that is empty), snapped like a written mesh. Three corners, the first one
   of the first vertex among them, have normals of their own. */
static inline void make_wave(Wave *s) {
    s->mesh = (Mesh){.nvertices = VERTICES, .ntriangles = TRIANGLES, .ngroups = 3, .position = s->position,
                     .normal = s->normal, .u = s->u, .w = s->w, .triangle = s->triangle, .group = s->group,
                     .crease = s->crease, .ncreases = 3, .nextra = 2};
    Triangle *t = s->triangle;
    for (int i = 0; i < VERTICES; i++) {
        double a = i % SIDE, b = (double)(i - i % SIDE) / SIDE, slope = 0.3 * cos(a), length = sqrt(1 + slope * slope);
        s->position[i] = (Vec3){round(1e5 * a) / 1e6, round(1e6 * 0.03 * sin(a)) / 1e6, round(1e5 * b) / 1e6 - 0.7};
        s->normal[i] = (Vec3){-slope / length, 1 / length, 0};
        s->u[i] = a / (SIDE - 1);
        s->w[i] = b / (SIDE - 1);
        if (i % SIDE == SIDE - 1 || i >= VERTICES - SIDE) continue;
        *t++ = (Triangle){{i, i + SIDE, i + 1}};
        *t++ = (Triangle){{i + 1, i + SIDE, i + SIDE + 1}};
    }
    s->normal[VERTICES] = (Vec3){0, 0, -1};
    s->normal[VERTICES + 1] = (Vec3){1, 0, 0};
    s->crease[0] = (Crease){0, VERTICES};
    s->crease[1] = (Crease){3 * 50 + 1, VERTICES + 1};
    s->crease[2] = (Crease){3 * 51, VERTICES + 1};
    s->group[0] = (MeshGroup){"left back", 0, 100};
    s->group[1] = (MeshGroup){"none", 100, 0};
    s->group[2] = (MeshGroup){"right", 100, TRIANGLES - 100};
}

#endif
