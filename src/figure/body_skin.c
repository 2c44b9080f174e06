/* From sections to skin: the Bezier patches of each part, and one closed triangle mesh whose
   vertices lie on them. */
#include "figure/body.h"

enum { RINGS_MAX = 256, DETAIL_MIN = 8, DETAIL_MAX = 64 };

/* Control points of a quarter circle, as the classic cubic: off by at most 0.027 %. */
static const double ARC_SIN[4] = {0, 0.5522847498307936, 1, 1};
static const double ARC_COS[4] = {1, 1, 0.5522847498307936, 0};

/* Which way the sine and cosine point in the four quarters: front to left, on to the back, to
   the right and home. */
static const int TURN[4][4] = {{1, 0, 0, 1}, {0, 1, -1, 0}, {-1, 0, 0, -1}, {0, -1, 1, 0}};

/* Rings stand as far apart as facets are wide, but on thin parts no closer than on one of this
   radius (metres on the reference adult): slim limbs are straight and need no more. */
static const double THIN = 0.062;

/* The unit circle's point for the cubic's parameter in a quarter. */
static void arc_point(int quarter, double t, double *x, double *z) {
    double b[4], s = 0, c = 0;
    bezier_basis(t, b, NULL);
    for (int i = 0; i < 4; i++) {
        s += b[i] * ARC_SIN[i];
        c += b[i] * ARC_COS[i];
    }
    const int *turn = TURN[quarter];
    *x = s * turn[0] + c * turn[1];
    *z = s * turn[2] + c * turn[3];
}

/* Bezier values of one shape value between sections i and i + 1. */
static void bezier_values(const BodyPart *part, int i, int k, double out[4]) {
    double h = part->section[i + 1].at - part->section[i].at;
    const double (*c)[SHAPE_VALUES] = part->cubic[i];
    out[0] = c[0][k];
    out[1] = out[0] + c[1][k] * h / 3;
    out[2] = 2 * out[1] - out[0] + c[2][k] * h * h / 3;
    out[3] = part->cubic[i + 1][0][k]; /* the next patch's first value, to the bit */
}

/* u runs round the part from front to left, w along it: du x dw points outwards. */
static Patch quarter_patch(const BodyPart *part, int i, int quarter) {
    double v[SHAPE_VALUES][4];
    for (int k = 0; k < SHAPE_VALUES; k++) bezier_values(part, i, k, v[k]);
    const double *depth = quarter == 0 || quarter == 3 ? v[3] : v[4];
    const int *turn = TURN[quarter];
    double low = part->section[i].at, high = part->section[i + 1].at;
    Patch patch;
    for (int a = 0; a < 4; a++) {
        double x = ARC_SIN[a] * turn[0] + ARC_COS[a] * turn[1], z = ARC_SIN[a] * turn[2] + ARC_COS[a] * turn[3];
        for (int b = 0; b < 4; b++) {
            double y = b < 3 ? low + (high - low) * b / 3.0 : high;
            patch.p[a][b] = rigid_apply(part->frame, vec(v[0][b] + v[2][b] * x, y, v[1][b] + depth[b] * z));
        }
    }
    return patch;
}

static bool make_patches(Body *body, Arena *arena, Error *e) {
    body->npatches = 0;
    for (int i = 0; i < body->nparts; i++) body->npatches += 4 * (body->part[i].nsections - 1);
    body->patch = ARENA_NEW(arena, Patch, body->npatches, e);
    if (!body->patch) return false;
    Patch *next = body->patch;
    for (int i = 0; i < body->nparts; i++)
        for (int row = 0; row + 1 < body->part[i].nsections; row++)
            for (int quarter = 0; quarter < 4; quarter++) *next++ = quarter_patch(&body->part[i], row, quarter);
    return true;
}

static double mean_radius(const Section *s) { return 0.25 * (2 * s->side + s->front + s->back); }

/* Heights of the rings between the poles, spaced like the facets round them are wide: the
   length of the outline in units of facet widths is summed up and cut into equal pieces. */
static int ring_heights(const BodyPart *part, double scale, int detail, double y[RINGS_MAX]) {
    enum { STEPS = 512 };
    double sum[STEPS + 1], widest = 0, step = (part->high - part->low) / STEPS;
    for (int i = 0; i < part->nsections; i++) widest = fmax(widest, mean_radius(&part->section[i]));
    double least = fmin(fmax(0.4 * widest, THIN * scale), 2 * widest);
    Section last = part->section[0];
    sum[0] = 0;
    for (int i = 1; i <= STEPS; i++) {
        Section s = body_section_at(part, part->low + i * step);
        double radius = mean_radius(&s), facet = 2 * PI / detail * fmax(radius, least);
        sum[i] = sum[i - 1] + hypot(step, radius - mean_radius(&last)) / facet;
        last = s;
    }
    int n = (int)clamp(floor(sum[STEPS] + 0.5), 4, RINGS_MAX) - 1;
    for (int ring = 0, i = 0; ring < n; ring++) {
        double wanted = sum[STEPS] * (ring + 1) / (n + 1);
        while (sum[i + 1] < wanted) i++;
        y[ring] = part->low + step * (i + (wanted - sum[i]) / (sum[i + 1] - sum[i]));
    }
    return n;
}

static void count_part(BodyPart *part, double scale, Mesh *skin, int detail) {
    double y[RINGS_MAX];
    int rings = ring_heights(part, scale, detail, y);
    part->first_vertex = skin->nvertices;
    part->nvertices = detail * rings + 2;
    part->first_triangle = skin->ntriangles;
    part->ntriangles = 2 * detail * rings;
    part->first_edge = skin->nedges;
    part->nedges = 3 * detail * rings; /* Euler: V - E + F = 2 */
    skin->nvertices += part->nvertices;
    skin->ntriangles += part->ntriangles;
    skin->nedges += part->nedges;
}

/* Low pole, rings from low to high, high pole. */
static void place_vertices(const BodyPart *part, double scale, Mesh *skin, int detail) {
    double y[RINGS_MAX];
    int rings = ring_heights(part, scale, detail, y), last = part->nsections - 1, round = detail / 4;
    Vec3 *position = skin->position + part->first_vertex, *normal = skin->normal + part->first_vertex;
    for (int ring = 0; ring < rings; ring++) {
        Section s = body_section_at(part, y[ring]);
        for (int k = 0; k < detail; k++) {
            double x, z;
            arc_point(k / round, (double)(k % round) / round, &x, &z);
            Vec3 p = vec(s.x + s.side * x, y[ring], s.z + (z > 0 ? s.front : s.back) * z), n;
            body_distance(part, p, INFINITY, &n);
            position[1 + ring * detail + k] = rigid_apply(part->frame, p);
            normal[1 + ring * detail + k] = mat_apply(part->frame.r, n);
        }
    }
    for (int end = 0; end < 2; end++) {
        const Section *s = &part->section[end ? last : 0];
        int at = end ? part->nvertices - 1 : 0;
        position[at] = rigid_apply(part->frame, vec(s->x, s->at, s->z));
        normal[at] = mat_apply(part->frame.r, vec(0, end ? 1 : -1, 0));
    }
}

/* Diagonals lean the other way on the other half, so that a body made of mirrored parts has a
   mirrored mesh. */
static void place_triangles(const BodyPart *part, Mesh *skin, int detail) {
    Triangle *t = skin->triangle + part->first_triangle;
    int base = part->first_vertex, rings = (part->nvertices - 2) / detail, top = base + part->nvertices - 1;
    for (int k = 0; k < detail; k++) *t++ = (Triangle){{base, base + 1 + (k + 1) % detail, base + 1 + k}};
    for (int ring = 0; ring + 1 < rings; ring++) {
        for (int k = 0; k < detail; k++) {
            int a = base + 1 + ring * detail + k, b = a - k + (k + 1) % detail, c = b + detail, d = a + detail;
            bool left = k < detail / 2;
            *t++ = left ? (Triangle){{a, b, c}} : (Triangle){{a, b, d}};
            *t++ = left ? (Triangle){{a, c, d}} : (Triangle){{b, c, d}};
        }
    }
    for (int k = 0; k < detail; k++) *t++ = (Triangle){{top, top - detail + k, top - detail + (k + 1) % detail}};
}

bool body_skin(Body *body, int detail, Arena *arena, Error *e) {
    if (detail < DETAIL_MIN || detail > DETAIL_MAX || detail % 4)
        return error_set(e, ERR_USAGE, "body detail must be a multiple of 4 from %d to %d, not %d", DETAIL_MIN,
                         DETAIL_MAX, detail);
    Mesh *skin = &body->skin;
    *skin = (Mesh){.ngroups = body->nparts};
    for (int i = 0; i < body->nparts; i++) count_part(&body->part[i], body->scale, skin, detail);
    skin->position = ARENA_NEW(arena, Vec3, skin->nvertices, e);
    skin->normal = ARENA_NEW(arena, Vec3, skin->nvertices, e);
    skin->triangle = ARENA_NEW(arena, Triangle, skin->ntriangles, e);
    skin->group = ARENA_NEW(arena, MeshGroup, skin->ngroups, e);
    if (!skin->position || !skin->normal || !skin->triangle || !skin->group) return false;
    for (int i = 0; i < body->nparts; i++) {
        const BodyPart *part = &body->part[i];
        place_vertices(part, body->scale, skin, detail);
        place_triangles(part, skin, detail);
        skin->group[i] = (MeshGroup){role_name(part->role), part->first_triangle, part->ntriangles};
    }
    return mesh_find_edges(skin, arena, e) && make_patches(body, arena, e);
}
