/* What is known of a finished motion, kept in its folder as RECORD_NAME: from which inputs, with
   which options, and its rows of the summary. By it --resume knows what need not be done again. */
#ifndef APP_RECORD_H
#define APP_RECORD_H

#include "app/inputs.h"
#include "base/digest.h"
#include "files/stats.h"

#define RECORD_NAME ".done"

/* Of what a motion was made. 0: cannot be known (standard input, a pipe), never finished. */
typedef struct { Digest options, motion; } RecordKey;

typedef struct {
    int frames, residual_frames;
    long long bytes;
    const char *rows; /* of the summary, as text with line ends */
} Record;

/* The options that shape what is written, and the contents of the files that they name: garments,
   body, roles. Also what the program itself would write differently: its version, its columns. */
MUST_CHECK bool record_options(const Settings *s, Digest *out, Error *e);

/* The contents of the motion file, and of the skeletons that an AMC file may mean. */
MUST_CHECK bool record_motion(const Input *input, const Settings *s, Digest *out, Error *e);

/* Is the motion in the folder finished, made of just this? A record that is missing, torn or of
   something else is no error but a no. Text from arena. */
bool record_read(const char *folder, const RecordKey *key, Arena *arena, Record *out, Error *e);

/* row: n of them. Everything that they tell of must be on the disk by now. */
MUST_CHECK bool record_write(const char *folder, const RecordKey *key, const Record *r, const SummaryRow *row, int n,
                             bool times, Error *e);

#endif
