/* The front door: finds the command, reads its options, runs it, prints the error that comes
   back, and makes its kind the exit code. */
#include <errno.h>
#include <string.h>

#include "app/commands.h"
#include "app/help.h"
#include "app/jobfile.h"
#include "app/options.h"

static const Command commands[] = {
    {.name = "dress", .bit = COMMAND_DRESS, .run = cmd_dress,
     .summary = "dress moving bodies in garments, frame by frame",
     .operands = "[OPTION]... MOTION... -g GARMENT... -o DIR",
     .example = "kitsuke dress motions/paper-walk.bvh -g garments/skirt.garment -o out\n"
                "kitsuke dress mocap/ -g garments/skirt.garment -o out --format drc --rate 30"},
    {.name = "compare", .bit = COMMAND_COMPARE, .run = cmd_compare,
     .summary = "count and time uniform against adaptive subdivision",
     .operands = "[OPTION]... MOTION... -g GARMENT... -o DIR",
     .example = "kitsuke compare motions/paper-walk.bvh -g garments/paper-skirt.garment -o out"},
    {.name = "inspect", .bit = COMMAND_INSPECT, .run = cmd_inspect,
     .summary = "tell what is in a motion, garment or body file",
     .operands = "[OPTION]... FILE...",
     .example = "kitsuke inspect motions/paper-walk.bvh\n"
                "kitsuke inspect --joints motions/paper-walk.bvh > joints.csv"},
    {.name = "walk", .bit = COMMAND_WALK, .run = cmd_walk,
     .summary = "make a walking motion",
     .operands = "[OPTION]...",
     .example = "kitsuke walk --preset paper -o paper-walk.bvh\n"
                "kitsuke walk --height 1.2 --speed 0.9 --steps 20 > child.bvh"},
    {.name = "draw", .bit = COMMAND_DRAW, .run = cmd_draw,
     .summary = "draw frames as SVG pictures",
     .operands = "[OPTION]... MOTION -g GARMENT... -o FILE.svg",
     .example = "kitsuke draw motions/paper-walk.bvh -g garments/skirt.garment -o walk.svg\n"
                "kitsuke draw motions/paper-walk.bvh -g garments/skirt.garment -o sheet.svg \\\n"
                "    --frames 1:36:7 --view 60/10 --follow --show patches,points"},
    {.name = "verify", .bit = COMMAND_VERIFY, .run = cmd_verify,
     .summary = "test written meshes: what shows through, what cracks",
     .operands = "[OPTION]... DIR... | --garment FILE --body FILE",
     .example = "kitsuke verify out > verify.csv\n"
                "kitsuke verify --garment 'cloth.####.obj' --body 'body.####.obj'"},
    {0}};

static const Command *find_command(const char *name) {
    for (const Command *c = commands; c->name; c++)
        if (strcmp(c->name, name) == 0) return c;
    return NULL;
}

static bool unknown_command(const char *name, Error *e) {
    if (name[0] == '-') return error_set(e, ERR_USAGE, "expected a command in front of '%s'", name);
    Nearest near = {.word = name};
    for (const Command *c = commands; c->name; c++) nearest_try(&near, c->name);
    if (near.best) return error_set(e, ERR_USAGE, "unknown command '%s'; did you mean '%s'?", name, near.best);
    return error_set(e, ERR_USAGE, "unknown command '%s'", name);
}

static bool is_one_of(const char *word, const char *a, const char *b, const char *c) {
    return strcmp(word, a) == 0 || strcmp(word, b) == 0 || strcmp(word, c) == 0;
}

static ErrorKind print_version(void) {
    printf("kitsuke %s\n", KITSUKE_VERSION);
    return ERR_NONE;
}

/* `kitsuke help` and `kitsuke help COMMAND` */
static ErrorKind run_help(const char *topic, Error *e) {
    const Command *command = topic ? find_command(topic) : NULL;
    if (topic && !command) unknown_command(topic, e);
    else if (command) help_command(command, stdout);
    else help_program(commands, stdout);
    return e->kind;
}

static ErrorKind run_command(const Command *command, int argc, char **argv, Error *e) {
    Arena arena = {0};
    Settings settings;
    ErrorKind code = ERR_USAGE;
    if (options_parse(command, argc, argv, &arena, &settings, e)) {
        if (settings.help) help_command(command, stdout);
        else if (settings.version) print_version();
        if (settings.help || settings.version) code = ERR_NONE;
        else if (settings.print_job) code = jobfile_print(command, &settings, stdout, e) ? ERR_NONE : e->kind;
        else code = command->run(&settings, e);
    }
    arena_free(&arena);
    return e->kind > code ? e->kind : code;
}

static ErrorKind run(int argc, char **argv, Error *e) {
    if (argc < 2) {
        help_hint(commands, stderr);
        return ERR_USAGE;
    }
    const char *word = argv[1];
    if (is_one_of(word, "--version", "-V", "version")) return print_version();
    if (is_one_of(word, "--help", "-h", "help")) return run_help(argc > 2 ? argv[2] : NULL, e);
    const Command *command = find_command(word);
    if (command) return run_command(command, argc - 2, argv + 2, e);
    unknown_command(word, e);
    return ERR_USAGE;
}

int main(int argc, char **argv) {
    Error e = {0};
    ErrorKind code = run(argc, argv, &e);
    errno = 0;
    if (fflush(stdout) != 0 || ferror(stdout)) {
        error_set(&e, ERR_OUTPUT, "cannot write to standard output: %s", errno ? strerror(errno) : "write error");
        if (code < ERR_OUTPUT) code = ERR_OUTPUT;
    }
    if (e.kind) error_print(&e, stderr);
    if (e.kind == ERR_USAGE) {
        const Command *command = argc > 1 ? find_command(argv[1]) : NULL;
        fprintf(stderr, "Use 'kitsuke %s%s--help' for what there is.\n", command ? command->name : "",
                command ? " " : "");
    }
    return (int)code;
}
