/* From a path and the settings to a body that can be posed: how a motion is opened stands here
   and nowhere else, so that every command sees the same figure. */
#include "app/wearer.h"

MotionOptions wearer_motion_options(const Settings *s) {
    return (MotionOptions){.asf = s->asf, .fps = s->fps, .position = (PositionRule)s->position,
                           .max_joints = s->max_joints, .max_frames = s->max_frames};
}

FigureOptions wearer_figure_options(const Settings *s) { return (FigureOptions){s->unit, s->scale, (char)s->up}; }

static bool make_frame(Wearer *w, double unit, Arena *arena, Error *e) {
    const Mesh *skin = &w->body.skin;
    return body_frame_init(&w->posed, &w->body, unit, arena, e) &&
           facing_reserve(&w->facing, skin->nvertices, skin->ntriangles, arena, e);
}

bool wearer_open(const Wardrobe *wardrobe, const char *path, double unit, Arena *arena, Notes *notes, Wearer *out,
                 Error *e) {
    const Settings *s = wardrobe->settings;
    MotionOptions options = wearer_motion_options(s);
    FigureOptions figure = wearer_figure_options(s);
    Roles roles;
    return motion_open(path, &options, arena, notes, &out->motion, e) &&
           roles_read(&out->motion, &wardrobe->roles, arena, notes, &roles, e) &&
           figure_build(&out->motion, &roles, &figure, arena, notes, &out->figure, e) &&
           body_fit(&wardrobe->body, &out->figure, s->body_detail ? s->body_detail : 16, arena, &out->body, e) &&
           make_frame(out, unit, arena, e);
}

bool wearer_share(const Wearer *w, double unit, Arena *arena, Wearer *out, Error *e) {
    *out = *w;
    return make_frame(out, unit, arena, e);
}

void wearer_close(Wearer *w) { motion_close(&w->motion); }

bool wearer_put_on(const Wearer *w, const Wardrobe *wardrobe, const DressOptions *options, Arena *arena,
                   Dresser ***out, Error *e) {
    Dresser **dresser = ARENA_NEW(arena, Dresser *, wardrobe->ngarments, e);
    *out = dresser;
    if (!dresser) return false;
    for (int g = 0; g < wardrobe->ngarments; g++)
        if (!dresser_open(wardrobe->garment[g], &w->figure, &w->body, options, arena, &dresser[g], e)) return false;
    return true;
}

Mesh wearer_skin(const Wearer *w) {
    Mesh mesh = w->body.skin;
    body_frame_normals(&w->posed);
    mesh.position = w->posed.position;
    mesh.normal = w->posed.normal;
    facing_mend(&w->facing, &mesh);
    return mesh;
}
