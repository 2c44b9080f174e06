/* Everything that can be asked for, as plain data, and the one table that says how it is
   asked for. Parsing, help, suggestions and job files are made from this table. */
#ifndef APP_SETTINGS_H
#define APP_SETTINGS_H

#include "dress/frame.h"
#include "files/drc.h"
#include "motion/gait.h"

typedef enum {
    COMMAND_DRESS = 1, COMMAND_INSPECT = 2, COMMAND_WALK = 4, COMMAND_VERIFY = 8, COMMAND_COMPARE = 16,
    COMMAND_DRAW = 32, COMMAND_ALL = 63
} CommandBit;

/* Frames first, first + step, ... up to last, counted from 1. 0: from the first, to the last,
   every one. */
typedef struct { int first, last, step; } FrameSpan;

/* The k-th of n parts, from 1; 0: the whole. */
typedef struct { int k, n; } Shard;
enum { SHARDS_MAX = 100000 };

typedef struct { int count, capacity; const char **item; } TextList;

typedef enum { FORMAT_OBJ = 1, FORMAT_DRC = 2, FORMAT_NONE = 4 } FormatBit;
/* What is compared: global, no local deformation; paper, the paper's to the letter. */
typedef enum { COMPARE_UNIFORM, COMPARE_ADAPTIVE, COMPARE_GLOBAL, COMPARE_PAPER, COMPARE_METHODS } CompareMethod;
typedef enum { PROGRESS_AUTO, PROGRESS_ALWAYS, PROGRESS_NEVER, PROGRESS_JSON } ProgressMode;

enum { SHOW_PATCHES = 1, SHOW_POINTS = 2, SHOW_CELLS = 4 };

/* A sheet of pictures, as it is asked for; drawing.h has what that means. */
typedef struct {
    const char *frames, *view;
    TextList cells;
    unsigned show;              /* SHOW_ bits */
    double zoom;                /* 0 = 1 */
    int size;                   /* points; 0 = 320 */
    int columns;                /* 0: what suits */
    bool follow;
} DrawSettings;

/* Filled by options_parse, const for everybody else. Zero is the default everywhere, but for
   `gait`, which gait_defaults fills. */
typedef struct {
    TextList inputs;            /* what stands on the command line without a dash, or --motion */
    const char *files_from;     /* a list of more of them */
    const char *output;         /* folder (dress, compare) or file (walk, draw) */

    TextList garments;
    const char *asf, *roles, *body;
    double fps;                 /* frames per second instead of what the file says */
    int position;               /* PositionRule */
    double unit;                /* metres per unit of the motion file */
    double scale;
    int up;                     /* as in FigureOptions */
    FrameSpan frames;
    double rate;                /* resample to so many frames per second */
    bool relax_arms;            /* turn arms outwards where they leave no room for cloth */

    int method;                 /* Method */
    int split;                  /* SplitRule */
    int fixed;                  /* 1: --topology fixed */
    int detail, depth;          /* as in DressOptions */
    int body_detail;            /* facets round a section; 0 = 16 */

    unsigned formats;           /* FormatBit set; 0 = obj and drc */
    double output_unit;         /* metres per unit of the written files; 0 = 1 */
    DrcOptions drc;             /* .speed counts from 1, as there */
    bool no_body, no_times, force;

    bool resume;
    Shard shard;
    bool merge;                 /* inputs are folders with summaries */
    int max_joints, max_frames; /* 0: those of motion_open */
    int max_memory;             /* megabytes for each thread; 0 = no limit */
    int jobs;                   /* worker threads; 0 = one per processor */
    bool strict, quiet, verbose;
    int progress;               /* ProgressMode */

    unsigned methods;           /* compare: bits 1 << CompareMethod; uniform and adaptive are always run */
    int repeat;                 /* compare: runs that are timed; 0 = 3 */
    bool joints;                /* inspect */
    bool list, acceleration, landmarks; /* verify */
    const char *parts;          /* verify: groups of the body, separated by commas; NULL = all */
    Gait gait;                  /* walk */
    DrawSettings draw;
    const char *job;            /* file with more of these */
    bool print_job, help, version;
} Settings;

typedef enum {
    KIND_FLAG,   /* bool: --name, --no-name, --name=yes|no */
    KIND_INT,    /* int in low..high, a multiple of `step` */
    KIND_REAL,   /* double in low..high */
    KIND_TEXT,   /* const char *; one of `choices` if there are any */
    KIND_LIST,   /* TextList: may be repeated */
    KIND_CHOICE, /* int: one of `choices` */
    KIND_SET,    /* unsigned: several of `choices`, separated by commas */
    KIND_STAIRS, /* Gait: RISE:RUN:COUNT */
    KIND_SHARD,  /* Shard: K/N */
    KIND_SPAN,   /* FrameSpan: A, A:B or A:B:STEP */
    KIND_UNIT    /* double: metres; the name of a unit, or a number of metres */
} OptionKind;

typedef struct { const char *name; int value; } Choice;

typedef struct {
    const char *name;      /* without the dashes */
    char letter;           /* short form, or 0 */
    OptionKind kind;
    size_t field;          /* offset in Settings */
    const char *argument;  /* what the help calls the value; FILE and DIR are paths; NULL for flags */
    const char *group;     /* heading in the help */
    unsigned commands;     /* CommandBit set */
    const char *help;
    const char *fallback;  /* the default, in words; NULL: nothing to say */
    double low, high;      /* range of a number, both included */
    int step;              /* KIND_INT: multiples of this; 0 = 1 */
    bool manner;           /* how it is done, not what: the files that are written stay the same */
    int bias;              /* KIND_INT: added before it is stored, so that 0 can mean default */
    const Choice *choices; /* ends with a NULL name */
} Option;

enum { OPTIONS_MAX = 96 };

/* Ends with a NULL name. */
extern const Option settings_table[];

/* The option of that name or letter that one of `commands` takes; else one of another command; else NULL. */
const Option *settings_find(const char *name, unsigned commands);
const Option *settings_find_letter(char letter, unsigned commands);

/* The same for a name that may also be no-NAME, which sets *no: a switch that is taken back. */
const Option *settings_find_switch(const char *name, unsigned commands, bool *no);

/* The name nearest to a mistyped one, or NULL. */
const char *settings_nearest(const char *name, unsigned commands);

/* Puts a value, as text, where it belongs. `text` must outlive the settings. ERR_USAGE that
   names the option, says what was expected and quotes what was found. */
MUST_CHECK bool settings_put(Settings *s, const Option *option, const char *text, Arena *arena, Error *e);

/* The one form of all complaints about values: `what` was expected as the value of --`option`. Returns false. */
bool settings_expected(const char *option, const char *what, const char *text, Error *e);

/* The value as a text that settings_put takes; of a list its item `i`. False where it is the default
   (or the list has no such item): then nothing is written. */
bool settings_show(const Settings *s, const Option *option, int i, FILE *out);

/* All defaults. */
void settings_clear(Settings *s);

/* Is the value the name of a file or folder? */
bool settings_is_path(const Option *option);

/* "cm" for 0.01; NULL where a unit has no name. */
const char *settings_unit(double metres);

/* Adds a text to a list, which must outlive it. */
MUST_CHECK bool settings_append(TextList *list, const char *text, Arena *arena, Error *e);

/* "adaptive, uniform or none" into out (capacity n, always terminated); returns out. */
const char *settings_choices(const Choice *choices, char *out, size_t n);

#endif
