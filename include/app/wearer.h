/* The one who wears the garments: the figure of one motion, and its body. */
#ifndef APP_WEARER_H
#define APP_WEARER_H

#include "app/wardrobe.h"
#include "dress/bodypose.h"
#include "geometry/facing.h"

typedef struct {
    Motion motion;
    Figure figure;
    Body body;
    BodyFrame posed;
    Facing facing; /* of the skin */
} Wearer;

/* How the settings want a motion opened, and its figure built. */
MotionOptions wearer_motion_options(const Settings *s);
FigureOptions wearer_figure_options(const Settings *s);

/* Reads the motion, finds its figure and fits the body of the wardrobe to it. unit: output units
   per metre of what is dressed. Clear `out` with {0}; wearer_close must follow, whatever the
   result. ERR_INPUT for what the motion lacks. Memory from arena. */
MUST_CHECK bool wearer_open(const Wardrobe *wardrobe, const char *path, double unit, Arena *arena, Notes *notes,
                            Wearer *out, Error *e);
void wearer_close(Wearer *w);

/* The same motion, figure and body with a pose of its own, for another thread. Neither closed nor
   used longer than `w`. Memory from arena. */
MUST_CHECK bool wearer_share(const Wearer *w, double unit, Arena *arena, Wearer *out, Error *e);

/* A dresser for each garment of the wardrobe. */
MUST_CHECK bool wearer_put_on(const Wearer *w, const Wardrobe *wardrobe, const DressOptions *options, Arena *arena,
                              Dresser ***out, Error *e);

/* The body as it was posed last: arrays of `posed`, valid until the next pose. Where parts gave way, its normals
   are mended first. */
Mesh wearer_skin(const Wearer *w);

#endif
