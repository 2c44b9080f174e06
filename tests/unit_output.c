/* Writing files: what is written is whole or not there. Numbers as printf writes them. */
#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "files/decimal.h"
#include "files/output.h"
#include "dice.h"
#include "folder.h"
#include "tap.h"

static bool is_there(const char *path) {
    struct stat info;
    return lstat(path, &info) == 0;
}

static bool holds(const char *path, const char *text) {
    char data[4096] = "";
    FILE *f = fopen(path, "rb");
    size_t n = f ? fread(data, 1, sizeof data, f) : 0;
    if (f) fclose(f);
    return f && n == strlen(text) && memcmp(data, text, n) == 0;
}

/* The same numbers in every run. */
/* -- decimal -------------------------------------------------------------------------- */

static bool same_as_printf(double x) {
    char ours[DECIMAL_MAX + 1], theirs[DECIMAL_MAX];
    *decimal_put(ours, x) = 0;
    snprintf(theirs, sizeof theirs, "%.6f", x);
    if (strcmp(ours, theirs) != 0) printf("# %a: '%s', wanted '%s'\n", x, ours, theirs);
    return strcmp(ours, theirs) == 0;
}

static void test_decimal(void) {
    static const double special[] = {0.0,
                                     -0.0,
                                     1e-7,
                                     -1e-7,
                                     4.9999999e-7,
                                     5e-7,
                                     5.0000001e-7,
                                     0.0000015,
                                     0.5,
                                     0.9999995,
                                     0.99999949999,
                                     1.0 / 128,
                                     3.0 / 128,
                                     1.0 / 64,
                                     123456789.123456789,
                                     999999999.9999994,
                                     999999999.9999999,
                                     1e9,
                                     1e15,
                                     1e16,
                                     4503599627370496.5,
                                     1e22,
                                     1.7976931348623157e308,
                                     2.2250738585072014e-308,
                                     5e-324};
    bool good = true;
    for (size_t i = 0; i < sizeof special / sizeof *special; i++)
        good &= same_as_printf(special[i]) && same_as_printf(-special[i]);
    OK(good, "decimal_put equals printf on special numbers");

    good = true;
    for (int i = 0; i < 200000 && good; i++) {
        double size = pow(10, (int)dice_below(19) - 8);
        double x = (dice_unit() - 0.5) * 2 * size;
        good = same_as_printf(x);
    }
    OK(good, "and on numbers of every size");
    good = true;
    for (int i = 0; i < 100000 && good; i++) {
        double k = dice_below(4000000000u), half = (k + 0.5) / 1e6;
        good = same_as_printf(k / 1e6) && same_as_printf(half) && same_as_printf(nextafter(half, 0)) &&
               same_as_printf(nextafter(half, 1e9)) && same_as_printf(k / 128);
    }
    OK(good, "and on snapped numbers and next to the middle between two");
    good = true;
    for (int i = 0; i < 100000 && good; i++) {
        int n = (int)dice_below(2147483648u) >> (i % 31);
        char ours[DECIMAL_MAX], theirs[32];
        *decimal_put_int(ours, n) = 0;
        snprintf(theirs, sizeof theirs, "%d", n);
        good = strcmp(ours, theirs) == 0;
    }
    OK(good, "decimal_put_int equals printf");
}

/* -- output --------------------------------------------------------------------------- */

static void test_output(void) {
    Error e = {0};
    const char *path = in_folder("whole.txt");
    OK(output_file(path, "one", 3, &e) && holds(path, "one"), "a whole file is written");
    OK(output_file(path, "two", 3, &e) && holds(path, "two"), "and replaced");
    OK(!is_there(in_folder("whole.txt.tmp")), "the temporary is gone");

    Output o;
    path = in_folder("bits.txt");
    OK(output_open(&o, path, &e) && !is_there(path), "a file that is being written is not there yet");
    fprintf(o.file, "a bit");
    OK(output_good(&o, &e) && output_close(&o, &e) && holds(path, "a bit"), "when it is closed it is");
    OK(output_open(&o, path, &e), "opened again");
    fprintf(o.file, "half");
    output_abandon(&o);
    output_abandon(&o);
    OK(holds(path, "a bit") && !is_there(in_folder("bits.txt.tmp")),
       "abandoned: the old file stays, the temporary goes");
    OK(output_folder(in_folder("a/b/c"), &e) && output_folder(in_folder("a/b/c/"), &e),
       "folders are made, or there already");
    path = link_to("/dev/null", "null");
    OK(output_file(path, "gone", 4, &e) && !is_there(in_folder("null.tmp")), "a device is written in place");
    struct stat info;
    OK(stat(path, &info) == 0 && S_ISCHR(info.st_mode), "and stays a device");
}

static bool fails_with(bool result, const Error *e, int code) {
    bool good = !result && e->kind == ERR_OUTPUT && strstr(e->text, strerror(code));
    if (!good) printf("# result %d, error '%s', wanted '%s'\n", result, e->text, strerror(code));
    return good;
}

static void test_output_failures(void) {
    Error e = {0};
    OK(fails_with(output_file(in_folder("none/x"), "x", 1, &e), &e, ENOENT), "a folder that is not there");
    e = (Error){0};
    OK(fails_with(output_file(folder, "x", 1, &e), &e, EISDIR), "a folder in place of the file");
    e = (Error){0};
    OK(fails_with(output_folder(in_folder("whole.txt/sub"), &e), &e, ENOTDIR), "a file in place of the folder");
    e = (Error){0};
    char *long_name = calloc(1, OUTPUT_PATH_MAX + 10);
    memset(long_name, 'x', OUTPUT_PATH_MAX + 8);
    OK(fails_with(output_file(long_name, "x", 1, &e), &e, ENAMETOOLONG), "a path that is too long");
    free(long_name);

    Output o;
    e = (Error){0};
    if (is_there("/dev/full")) {
        const char *path = link_to("/dev/full", "full");
        OK(fails_with(output_file(path, "x", 1, &e), &e, ENOSPC), "a full disk, whole file");
        e = (Error){0};
        bool opened = output_open(&o, path, &e);
        fprintf(o.file, "x");
        OK(opened && fails_with(output_close(&o, &e), &e, ENOSPC), "a full disk, noticed when closing");
    } else SKIP("a full disk", "no /dev/full");
}

/* A limit on the size of files stands for a disk that fills up in the middle. */
static void test_full_disk(void) {
    struct rlimit old, small;
    getrlimit(RLIMIT_FSIZE, &old);
    small = (struct rlimit){10000, old.rlim_max};
    void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    Error first = {0}, second = {0}, third = {0};
    char *data = calloc(1, 100000);
    bool whole = output_file(in_folder("big"), data, 100000, &first), good = true;
    Output o;
    bool opened = output_open(&o, in_folder("slow"), &second);
    for (int i = 0; opened && good && i < 100; i++) {
        fwrite(data, 1, 1000, o.file);
        good = output_good(&o, &second);
    }
    bool noticed = !good;
    output_abandon(&o);
    bool replaced = output_file(in_folder("whole.txt"), data, 100000, &third);
    setrlimit(RLIMIT_FSIZE, &old);
    signal(SIGXFSZ, handler);
    free(data);
    OK(fails_with(whole, &first, EFBIG) && !is_there(in_folder("big")) && !is_there(in_folder("big.tmp")),
       "full in the middle: nothing is left");
    OK(opened && noticed && fails_with(good, &second, EFBIG), "a long job notices while it writes");
    OK(!is_there(in_folder("slow")) && !is_there(in_folder("slow.tmp")), "and nothing is left either");
    OK(!replaced && third.kind == ERR_OUTPUT && holds(in_folder("whole.txt"), "two"), "an older file is as it was");
}

static void test_read_only(void) {
    if (geteuid() == 0) {
        SKIP("a folder that is read-only", "root may write everywhere");
        return;
    }
    Error e = {0};
    mkdir(in_folder("closed"), 0500);
    OK(fails_with(output_file(in_folder("closed/x"), "x", 1, &e), &e, EACCES), "a folder that is read-only");
    chmod(in_folder("closed"), 0700);
}

int main(void) {
    if (!folder_make()) return 1;
    test_decimal();
    test_output();
    test_output_failures();
    test_full_disk();
    test_read_only();
    folder_remove();
    return tap_done();
}
