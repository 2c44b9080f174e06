/* What the figures of a run are dressed in; const once it is read. */
#ifndef APP_WARDROBE_H
#define APP_WARDROBE_H

#include "app/settings.h"
#include "figure/body.h"

typedef struct {
    const Settings *settings;
    BodySpec body;
    RoleFile roles;
    int ngarments;
    Garment **garment;
} Wardrobe;

/* The body, the garments and the roles that the settings name. Two garments of one name are an error, for
   names become files; so is one that does not fit the body (ERR_INPUT): it would fit no figure. Memory from arena. */
MUST_CHECK bool wardrobe_read(const Settings *settings, Arena *arena, Wardrobe *out, Error *e);

#endif
