/* Acclaim ASF/AMC: not read yet. */
#include "motion/source.h"

bool acclaim_open(Opening *o, Error *e) {
    return stream_error(&o->in, e, "Acclaim motions cannot be read yet");
}

bool acclaim_row(Stream *s, const MotionSource *source, double *row, Error *e) {
    row[0] = source->nframes;
    return stream_error(s, e, "Acclaim motions cannot be read yet");
}
