/* The CSV tables: fixed columns, fixed formats, names that cannot break a row. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "files/csv.h"
#include "files/stats.h"
#include "folder.h"
#include "tap.h"

static const char frame_head[] = "frame,time,garment,split,nodes,leaves,depth,cells,vertices,triangles,pairs_all,pairs_"
                                 "tested,hits_before,sweeps,active,"
                                 "displacement,residual_edges,residual_cloth,inside,deepest,limb_edges,limb_cloth,limb_"
                                 "inside,pinched,capped,restarted,method,tests,tests_culled";
static const char no_times[] = ",arm_turn";
static const char frame_times[] = ",pose_s,global_s,test_s,push_s,mesh_s,write_s,arm_turn";

static StatsRow sample_row(void) {
    return (StatsRow){.frame = 12,
                      .time = 11 / 120.0,
                      .garment = "skirt",
                      .split = SPLIT_UNIFORM,
                      .method = METHOD_PAPER,
                      .stats = {.nodes = 42,
                                .leaves = 32,
                                .depth = 2,
                                .cells = 50,
                                .vertices = 1300,
                                .triangles = 2500,
                                .pairs_all = 60000000000,
                                .tests = 70000000000,
                                .pairs_tested = 12345,
                                .hits_before = 7,
                                .sweeps = 3,
                                .active = 9,
                                .displacement = 0.0123456789,
                                .residual_edges = 1,
                                .residual_cloth = 2,
                                .inside = 3,
                                .deepest = 1e-9,
                                .limb_edges = 4,
                                .limb_cloth = 5,
                                .limb_inside = 6,
                                .pinched = 8,
                                .capped = true,
                                .restarted = false,
                                .global_s = 0.5,
                                .test_s = 0.25,
                                .push_s = 1e-6,
                                .mesh_s = 2},
                      .pose_s = 0.125,
                      .write_s = 0.0625,
                      .arm_turn = 12.5};
}

/* The lines of the file that are no comment, in one static text. */
static const char *table_of(const char *path) {
    static char text[8192];
    char line[4096];
    FILE *f = fopen(path, "r");
    text[0] = 0;
    while (f && fgets(line, sizeof line, f))
        if (line[0] != '#') strncat(text, line, sizeof text - strlen(text) - 1);
    if (f) fclose(f);
    return text;
}

static bool is_table(const char *path, const char *head, const char *head_more, const char *row) {
    char wanted[4096];
    snprintf(wanted, sizeof wanted, "%s%s\n%s\n", head, head_more, row);
    const char *found = table_of(path);
    if (strcmp(found, wanted) != 0) printf("# found\n%s# wanted\n%s", found, wanted);
    return strcmp(found, wanted) == 0;
}

static void test_frames(void) {
    Error e = {0};
    StatsRow row = sample_row();
    StatsFile f;
    const char *path = in_folder("stats.csv");
    struct stat info;
    OK(stats_open(&f, path, TABLE_STATS, true, &e) && stats_add(&f, &row, &e) && stat(path, &info) != 0,
       "nothing is seen before the end");
    OK(stats_close(&f, &e) && is_table(path, frame_head, frame_times,
                                       "12,0.091667,skirt,uniform,42,32,2,50,1300,2500,60000000000,12345,7,3,9,0."
                                       "012346,1,2,3,0.000000,4,5,6,8,1,0,paper,70000000000,0,"
                                       "0.125000,0.500000,0.250000,0.000001,2.000000,0.062500,12.500000"),
       "a row of stats.csv");
    bool written = stats_open(&f, path, TABLE_STATS, false, &e) && stats_add(&f, &row, &e) && stats_close(&f, &e);
    OK(written && is_table(path, frame_head, no_times,
                           "12,0.091667,skirt,uniform,42,32,2,50,1300,2500,60000000000,12345,7,3,9,0.012346,1,2,3,0."
                           "000000,4,5,6,8,1,0,paper,70000000000,0,12.500000"),
       "and without times");
    row.stats.displacement = -NAN;
    row.garment = "a,\"b\"\nc";
    written = stats_open(&f, path, TABLE_STATS, false, &e) && stats_add(&f, &row, &e) && stats_close(&f, &e);
    OK(written && is_table(path, frame_head, no_times,
                           "12,0.091667,\"a,\"\"b\"\"?c\",uniform,42,32,2,50,1300,2500,60000000000,12345,7,3,9,nan,1,2,"
                           "3,0.000000,4,5,6,8,1,0,paper,70000000000,0,12.500000"),
       "names are quoted, no number is nan");
}

static void test_summary(void) {
    Error e = {0};
    SummaryRow sum = {.motion = "walks/fast", .garment = "skirt", .status = "ok", .bytes = 5000000000, .seconds = 1.5};
    StatsRow row = sample_row();
    summary_add(&sum, &row);
    row.stats = (FrameStats){.nodes = 1, .pairs_all = 1, .deepest = 0.001, .pinched = 1};
    summary_add(&sum, &row);
    row.stats = (FrameStats){.limb_cloth = 1, .displacement = 0.2, .inside = 1};
    summary_add(&sum, &row);
    SummaryRow refused = {
        .motion = "chain", .status = "refused", .reason = "no human: 'left_thigh', 'right_thigh' missing"};
    StatsFile f;
    const char *path = in_folder("summary.csv");
    bool written = stats_open(&f, path, TABLE_SUMMARY, true, &e) && stats_add_summary(&f, &sum, &e) &&
                   stats_add_summary(&f, &refused, &e) && stats_close(&f, &e);
    OK(written &&
           is_table(
               path,
               "motion,garment,status,frames,residual_frames,residual_edges,residual_cloth,inside,deepest,limb_frames,"
               "pinched_frames,capped_frames,max_displacement,mean_nodes,max_nodes,pairs_all,pairs_tested,bytes,"
               "seconds,reason,max_arm_turn",
               "",
               "walks/"
               "fast,skirt,ok,3,2,1,2,4,0.001000,2,2,1,0.200000,14.333333,42,60000000001,12345,5000000000,1.500000,,"
               "12.500000\n"
               "chain,,refused,0,0,0,0,0,0.000000,0,0,0,0.000000,0.000000,0,0,0,0,0.000000,\"no human: 'left_thigh', "
               "'right_thigh' missing\",0.000000"),
       "rows of summary.csv");
}

static void test_cells(void) {
    static const struct { const char *text, *cell; } cells[] = {
        {"walk", "walk"}, {"", ""}, {"two words", "two words"}, {" first", "\" first\""}, {"last ", "\"last \""},
        {"a,b", "\"a,b\""}, {"say \"so\"", "\"say \"\"so\"\"\""}, {"#1", "\"#1\""}, {"no 1#", "no 1#"},
        {"a\nb\177", "a?b?"}, {NULL, ""},
    };
    for (size_t i = 0; i < sizeof cells / sizeof *cells; i++) {
        char got[64] = "";
        FILE *out = fmemopen(got, sizeof got, "w");
        if (!out) exit(1);
        csv_text(cells[i].text, out);
        fclose(out);
        OK(strcmp(got, cells[i].cell) == 0, "the cell %s", cells[i].cell);
    }
}

static void test_units(void) {
    Error e = {0};
    StatsFile f;
    char line[2][1024] = {"", ""};
    bool written = stats_open(&f, in_folder("units.csv"), TABLE_STATS, false, &e) && stats_close(&f, &e);
    FILE *in = written ? fopen(in_folder("units.csv"), "r") : NULL;
    if (in) {
        if (!fgets(line[0], sizeof line[0], in) || !fgets(line[1], sizeof line[1], in)) printf("# two lines wanted\n");
        fclose(in);
    }
    OK(line[0][0] == '#' &&
           strcmp(line[1], "# units: time s; displacement m; deepest m; arm_turn deg; "
                           "all other numbers are counts or flags\n") == 0,
       "comment lines tell the units: %.*s", (int)strcspn(line[1], "\n"), line[1]);
}

static void test_full_disk(void) {
    struct stat info;
    if (stat("/dev/full", &info) != 0) {
        SKIP("a full disk", "no /dev/full");
        return;
    }
    Error e = {0};
    StatsFile f;
    StatsRow row = sample_row();
    bool good = stats_open(&f, link_to("/dev/full", "full"), TABLE_STATS, true, &e);
    int rows = 0;
    while (good && rows < 1000 && stats_add(&f, &row, &e)) rows++;
    if (good) stats_abandon(&f);
    OK(good && rows > 0 && rows < 1000 && e.kind == ERR_OUTPUT && strstr(e.text, "No space left"),
       "a full disk is noticed after %d rows", rows);
}

/* The README shows the columns as stats_describe prints them. */
static void test_readme(void) {
    static char readme[1 << 18], described[1 << 14];
    FILE *f = fopen("README.md", "r");
    if (f) {
        readme[fread(readme, 1, sizeof readme - 1, f)] = 0;
        fclose(f);
    }
    if (!strstr(readme, "| `pairs_tested` |")) {
        SKIP("the README shows the columns", "no such table in README.md here");
        return;
    }
    FILE *out = fmemopen(described, sizeof described, "w");
    stats_describe(TABLE_STATS, out);
    stats_describe(TABLE_SUMMARY, out);
    fclose(out);
    int missing = 0;
    for (char *line = strtok(described, "\n"); line; line = strtok(NULL, "\n"))
        if (!strstr(readme, line)) printf("# not in README.md: %s\n", line), missing++;
    OK(missing == 0, "the README shows the columns");
}

int main(int argc, char **argv) {
    if (argc > 1 && strcmp(argv[1], "--describe") == 0) { /* to paste into the README */
        stats_describe(TABLE_STATS, stdout);
        stats_describe(TABLE_SUMMARY, stdout);
        return 0;
    }
    if (!folder_make()) return 1;
    test_frames();
    test_summary();
    test_cells();
    test_units();
    test_full_disk();
    test_readme();
    folder_remove();
    return tap_done();
}
