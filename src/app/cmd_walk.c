/* kitsuke walk: a walking motion to a BVH file. */
#include "app/commands.h"
#include "files/output.h"

ErrorKind cmd_walk(const Settings *s, Error *e) {
    Output out;
    if (s->inputs.count > 0) return error_set(e, ERR_USAGE, "'walk' reads no file: '%s'", s->inputs.item[0]), ERR_USAGE;
    if (!output_open(&out, s->output ? s->output : "-", e)) return e->kind;
    if (!gait_write(&s->gait, out.file, e)) output_abandon(&out);
    else if (output_close(&out, e)) return ERR_NONE;
    return e->kind;
}
