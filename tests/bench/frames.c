/* Whole frames in this process, without files: the walk of the paper, dressed again and again. */
#include "app/take.h"
#include "app/wearer.h"
#include "bench.h"

enum { FRAMES_MAX = 72 };

typedef struct {
    Arena arena;
    Settings settings;
    Wardrobe wardrobe;
    Wearer wearer;
    Dresser **dresser;
    TakeFrame frame[FRAMES_MAX];
    int frames;
    FrameStats sum;    /* of all garments and frames of the last run */
} Walk;

static void dress(void *context) {
    Walk *w = context;
    Mesh mesh;
    FrameStats stats;
    w->sum = (FrameStats){0};
    for (int f = 0; f < w->frames; f++) {
        body_frame_pose(&w->wearer.posed, &w->frame[f].pose);
        for (int g = 0; g < w->wardrobe.ngarments; g++) {
            dresser_frame(w->dresser[g], &w->wearer.posed, w->frame[f].dt, w->frame[f].tie, &mesh, &stats);
            w->sum.pairs_all += stats.pairs_all;
            w->sum.pairs_tested += stats.pairs_tested;
            w->sum.triangles += stats.triangles;
        }
    }
}

static void walk_open(Walk *w, const char *const *garments, int count, DressOptions options, int body_detail) {
    static Notes notes;
    Error e = {0};
    Take *take;
    *w = (Walk){.settings = {.body_detail = body_detail}};
    w->settings.garments = (TextList){.count = count, .item = (const char **)garments};
    bench_need(wardrobe_read(&w->settings, &w->arena, &w->wardrobe, &e) &&
               wearer_open(&w->wardrobe, "motions/paper-walk.bvh", 1, &w->arena, &notes, &w->wearer, &e) &&
               wearer_put_on(&w->wearer, &w->wardrobe, &options, &w->arena, &w->dresser, &e) &&
               take_open(&w->wearer.motion, &w->wearer.figure, &(FrameSpan){0, FRAMES_MAX, 0}, 0, &w->arena, &take,
                         &e), &e);
    while (w->frames < FRAMES_MAX && take_next(take, &w->frame[w->frames], &e)) w->frames++;
    bench_need(e.kind == ERR_NONE, &e);
    take_close(take);
}

static void walk_close(Walk *w) {
    wearer_close(&w->wearer);
    arena_free(&w->arena);
}

static Timing per(Timing t, int count) { return (Timing){t.least / count, t.median / count}; }

static const char *const SKIRT[] = {"garments/skirt.garment"}, *const PAPER[] = {"garments/paper-skirt.garment"};
static const char *const THREE[] = {"garments/skirt.garment", "garments/trousers.garment", "garments/tshirt.garment"};

/* Enters the time of a frame of one garment. A goal is in seconds; 0: none. */
static Timing enter(Bench *b, const char *scene, const char *what, Walk *w, double goal) {
    int garment_frames = w->frames * w->wardrobe.ngarments;
    Timing time = per(bench_time(dress, w), garment_frames);
    bench_enter(b, (BenchRow){scene, what, w->sum.triangles / garment_frames, "triangles a frame", time,
                              goal > 0 ? "half a millisecond" : NULL, {goal, goal}, goal > 0});
    return time;
}

/* Time against the fineness of the cloth, of the body, and the number of frames. */
static void growth(Bench *b) {
    static const int cloth[] = {8, 11, 16, 22}, body[] = {12, 16, 24, 32}, frames[] = {9, 18, 36, 72};
    static const char *const what[] = {"frames; finer cloth", "frames; finer body", "frames"};
    static const char *const unit[] = {"triangles of the cloth", "triangles of the body", "frames"};
    for (int kind = 0; kind < 3; kind++) {
        BenchSeries s = {.what = what[kind], .unit = unit[kind]};
        for (int k = 0; k < 4; k++) {
            Walk w;
            walk_open(&w, SKIRT, 1, (DressOptions){.detail = kind == 0 ? cloth[k] : 10}, kind == 1 ? body[k] : 16);
            if (kind == 2) w.frames = frames[k];
            Timing time = per(bench_time(dress, &w), kind == 2 ? 1 : w.frames);
            double triangles = kind == 0 ? (double)w.sum.triangles / w.frames : w.wearer.body.skin.ntriangles;
            bench_add(&s, kind == 2 ? w.frames : triangles, time.least);
            walk_close(&w);
        }
        bench_series(b, &s);
    }
}

void bench_frames(Bench *b) {
    Walk w;
    walk_open(&w, PAPER, 1, (DressOptions){.split = SPLIT_UNIFORM, .detail = 8, .depth = 2}, 12);
    enter(b, "paper", "frame; split uniformly", &w, 0);
    walk_close(&w);
    walk_open(&w, PAPER, 1, (DressOptions){.detail = 8, .depth = 2}, 12);
    enter(b, "paper", "frame; split adaptively", &w, 0);
    walk_close(&w);
    walk_open(&w, SKIRT, 1, (DressOptions){.detail = 14}, 16);
    enter(b, "skirt", "frame", &w, 0.5e-3);
    walk_close(&w);
    walk_open(&w, THREE, 3, (DressOptions){0}, 16);
    enter(b, "wardrobe", "frame of a garment", &w, 0);
    walk_close(&w);
    growth(b);
}
