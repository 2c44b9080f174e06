/* Tracing. A crack is the side between two pixels, kept at the corner where it begins: bit RIGHT
   for the one to the corner's right, bit DOWN for the one below. A walk over the cracks takes each
   away as it goes, straight on where it can, and so joins them to lines; the lines go through the
   middles of the cracks, which turns the steps of a slope into the slope. */
#include "files/outline.h"

#include "geometry/vec.h"

#include <math.h>
#include <string.h>

enum { RIGHT = 1, DOWN = 2 };
enum { SMOOTH = 8 };              /* rounds: takes away the steps of pixels and next to nothing else */
static const double THIN = 0.4;   /* pixels that a thinned line may be off */
static const double SHARP = 0.5;  /* cosine of the bend from which on it is a corner */

bool outline_reserve(Outline *o, int width, int height, Arena *arena, Error *e) {
    size_t corners = (size_t)(width + 1) * (size_t)(height + 1), n = corners / 4 + 64;
    *o = (Outline){.width = width, .capacity = (int)n};
    o->crack = ARENA_NEW(arena, unsigned char, corners, e);
    o->point = ARENA_NEW(arena, OutlinePoint, n, e);
    o->kept = ARENA_NEW(arena, unsigned char, n, e);
    o->range = arena_array(arena, n, sizeof *o->range, e);
    return o->crack && o->point && o->kept && o->range;
}

void outline_clear(Outline *o, int left, int top, int right, int bottom) {
    o->left = left;
    o->top = top;
    o->right = right;
    o->bottom = bottom;
    for (int y = top; y <= bottom; y++) memset(&o->crack[y * (o->width + 1) + left], 0, (size_t)(right - left + 1));
    o->at = o->pass = o->count = 0;
}

void outline_above(Outline *o, int x, int y) { o->crack[y * (o->width + 1) + x] |= RIGHT; }
void outline_left(Outline *o, int x, int y) { o->crack[y * (o->width + 1) + x] |= DOWN; }

/* The byte and the bit of the crack from corner (x, y) in a direction: 0 right, 1 down, 2 left, 3 up. NULL: there is
   none. */
static unsigned char *crack_from(const Outline *o, int x, int y, int way, unsigned char *bit) {
    static const int dx[4] = {0, 0, -1, 0}, dy[4] = {0, 0, 0, -1};
    x += dx[way];
    y += dy[way];
    *bit = way % 2 == 0 ? RIGHT : DOWN;
    if (x < o->left || y < o->top) return NULL;
    unsigned char *c = &o->crack[y * (o->width + 1) + x];
    return *c & *bit ? c : NULL;
}

static bool has_crack(const Outline *o, int x, int y, int way) {
    unsigned char bit;
    return crack_from(o, x, y, way, &bit) != NULL;
}

static int degree(const Outline *o, int x, int y) {
    return has_crack(o, x, y, 0) + has_crack(o, x, y, 1) + has_crack(o, x, y, 2) + has_crack(o, x, y, 3);
}

static void add_point(Outline *o, double x, double y) { o->point[o->count++] = (OutlinePoint){(float)x, (float)y}; }

/* Follows cracks from a corner to where no more go on, or the room is used up. */
static void walk(Outline *o, int x, int y) {
    static const int dx[4] = {1, 0, -1, 0}, dy[4] = {0, 1, 0, -1}, turn[4] = {0, 1, 3, 2};
    int first_x = x, first_y = y, way = 0;
    o->count = 0;
    add_point(o, x, y);
    while (o->count < o->capacity - 1) {
        unsigned char bit, *c = NULL;
        int from = way;
        for (int k = 0; k < 4 && !c; k++) {
            way = (from + turn[k]) % 4;
            c = crack_from(o, x, y, way, &bit);
        }
        if (!c) break;
        *c &= (unsigned char)~bit;
        add_point(o, x + 0.5 * dx[way], y + 0.5 * dy[way]);
        x += dx[way];
        y += dy[way];
    }
    o->is_closed = x == first_x && y == first_y;
    if (o->is_closed) memmove(o->point, o->point + 1, (size_t)--o->count * sizeof *o->point);
    else add_point(o, x, y);
}

/* Every point becomes the mean of itself, twice, and its neighbours; ends stay. */
static void smooth(Outline *o) {
    int n = o->count;
    for (int round = 0; round < SMOOTH && n > 2; round++) {
        OutlinePoint first = o->point[0], before = o->is_closed ? o->point[n - 1] : first;
        for (int k = 0; k < n; k++) {
            OutlinePoint here = o->point[k], after = k + 1 < n ? o->point[k + 1] : o->is_closed ? first : here;
            if (o->is_closed || (k > 0 && k < n - 1))
                o->point[k] = (OutlinePoint){0.25f * (before.x + 2 * here.x + after.x),
                                             0.25f * (before.y + 2 * here.y + after.y)};
            before = here;
        }
    }
}

static double length_of(double x, double y) { return sqrt(x * x + y * y); }

static double distance_from(OutlinePoint a, OutlinePoint b, OutlinePoint p) {
    double ux = (double)b.x - a.x, uy = (double)b.y - a.y, vx = (double)p.x - a.x, vy = (double)p.y - a.y;
    double n = ux * ux + uy * uy, t = n > 0 ? clamp((ux * vx + uy * vy) / n, 0, 1) : 0;
    return length_of(vx - t * ux, vy - t * uy);
}

/* The point between two (round the end of a closed line) that lies farthest from their chord. */
static int farthest(const Outline *o, int from, int to, double *distance) {
    int best = -1;
    *distance = -1;
    for (int k = from + 1; k < to; k++) {
        double d = distance_from(o->point[from], o->point[to % o->count], o->point[k]);
        if (d <= *distance) continue;
        *distance = d;
        best = k;
    }
    return best;
}

static void thin_between(Outline *o, int from, int to) {
    int n = 0;
    o->range[n][0] = from;
    o->range[n++][1] = to;
    while (n > 0) {
        double d;
        int a = o->range[--n][0], b = o->range[n][1], middle = farthest(o, a, b, &d);
        if (middle < 0 || d <= THIN) continue;
        o->kept[middle] = 1;
        int part[2][2] = {{a, middle}, {middle, b}};
        memcpy(o->range[n], part, sizeof part);
        n += 2;
    }
}

/* Leaves of a line the points that lie farther than THIN from what is left without them (Douglas and Peucker). */
static void thin(Outline *o) {
    int n = 0, last = o->is_closed ? o->count : o->count - 1;
    if (o->count < 3) return;
    memset(o->kept, 0, (size_t)o->count);
    o->kept[0] = 1;
    if (o->is_closed) { /* two points that are far from each other part it */
        double d;
        int opposite = farthest(o, 0, o->count, &d);
        o->kept[opposite] = 1;
        thin_between(o, 0, opposite);
        thin_between(o, opposite, last);
    } else {
        o->kept[last] = 1;
        thin_between(o, 0, last);
    }
    for (int k = 0; k < o->count; k++)
        if (o->kept[k]) o->point[n++] = o->point[k];
    o->count = n;
}

/* Open ends first, so that lines are not begun in their middle. */
bool outline_next(Outline *o) {
    int row = o->right - o->left + 1, corners = row * (o->bottom - o->top + 1);
    for (; o->pass < 2; o->pass++, o->at = 0)
        for (; o->at < corners; o->at++) {
            int x = o->left + o->at % row, y = o->top + o->at / row, n = degree(o, x, y);
            if (n == 0 || (o->pass == 0 && n % 2 == 0)) continue;
            walk(o, x, y);
            smooth(o);
            thin(o);
            return true;
        }
    return false;
}

double outline_area(const Outline *o) {
    double sum = 0;
    for (int k = 0; k < o->count; k++) {
        OutlinePoint a = o->point[k], b = o->point[(k + 1) % o->count];
        sum += (double)a.x * b.y - (double)b.x * a.y;
    }
    return fabs(0.5 * sum);
}

double outline_length(const Outline *o) {
    double sum = 0;
    for (int k = 0; k + 1 < o->count + o->is_closed; k++) {
        OutlinePoint a = o->point[k], b = o->point[(k + 1) % o->count];
        sum += length_of((double)b.x - a.x, (double)b.y - a.y);
    }
    return sum;
}

/* A pen that writes relative moves between whole numbers, so that rounding does not add up. */
typedef struct { FILE *out; double scale; int x, y; char command; } Pen;

static int rounded(double x) { return (int)floor(x + 0.5); }

/* A command that goes on needs no letter, a negative number no blank before it. */
static void put(Pen *p, char command, int x, int y) {
    if (command != p->command) fputc(command, p->out);
    else if (x >= 0) fputc(' ', p->out);
    fprintf(p->out, y < 0 ? "%d%d" : "%d %d", x, y);
    p->command = command;
}

static void pen_to(Pen *p, char command, double px, double py) {
    int x = rounded(px * p->scale), y = rounded(py * p->scale);
    if (command == 'M') put(p, 'M', x, y);
    else if (x != p->x || y != p->y) put(p, 'l', x - p->x, y - p->y);
    p->x = x;
    p->y = y;
}

static void pen_bend(Pen *p, OutlinePoint over, double px, double py) {
    int x = rounded(px * p->scale), y = rounded(py * p->scale);
    put(p, 'q', rounded(over.x * p->scale) - p->x, rounded(over.y * p->scale) - p->y);
    put(p, 'q', x - p->x, y - p->y);
    p->x = x;
    p->y = y;
}

static bool is_sharp(OutlinePoint a, OutlinePoint b, OutlinePoint c) {
    double ux = (double)b.x - a.x, uy = (double)b.y - a.y, vx = (double)c.x - b.x, vy = (double)c.y - b.y;
    return ux * vx + uy * vy < SHARP * length_of(ux, uy) * length_of(vx, vy);
}

/* Bends go from the middle of one piece to the middle of the next, over the point between. */
void outline_write(const Outline *o, double scale, FILE *out) {
    Pen pen = {.out = out, .scale = scale};
    int n = o->count;
    const OutlinePoint *p = o->point;
    if (o->is_closed) pen_to(&pen, 'M', 0.5 * ((double)p[n - 1].x + p[0].x), 0.5 * ((double)p[n - 1].y + p[0].y));
    else pen_to(&pen, 'M', p[0].x, p[0].y);
    for (int k = o->is_closed ? 0 : 1; k < n - !o->is_closed; k++) {
        OutlinePoint a = p[(k + n - 1) % n], b = p[k], c = p[(k + 1) % n];
        if (is_sharp(a, b, c)) {
            pen_to(&pen, 'l', b.x, b.y);
            continue;
        }
        pen_to(&pen, 'l', 0.5 * ((double)a.x + b.x), 0.5 * ((double)a.y + b.y));
        pen_bend(&pen, b, 0.5 * ((double)b.x + c.x), 0.5 * ((double)b.y + c.y));
    }
    if (o->is_closed) fputc('z', out);
    else pen_to(&pen, 'l', p[n - 1].x, p[n - 1].y);
}
