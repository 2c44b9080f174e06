/* A folder whose listing breaks off, as on a network disk that goes away: what was not listed must not pass for what is
   not there. This program's own readdir stands before the C library's. */
#include "files/listing.h"

#include <dirent.h>
#include <errno.h>
#include <string.h>

#include "folder.h"
#include "motion/motion.h"
#include "tap.h"

static const char *listed[8];
static int nlisted, breaks_after; /* names; how many come before the error */

struct dirent *readdir(DIR *folder_of_names) {
    static struct dirent entry;
    (void)folder_of_names;
    if (nlisted == breaks_after) return errno = EIO, NULL;
    if (!listed[nlisted]) return NULL;
    snprintf(entry.d_name, sizeof entry.d_name, "%s", listed[nlisted++]);
    return &entry;
}

static void lists(const char *const name[], int n, int broken) {
    memset(listed, 0, sizeof listed);
    memcpy(listed, name, (size_t)n * sizeof *name);
    nlisted = 0;
    breaks_after = broken;
    errno = EAGAIN; /* left by somebody else */
}

int main(void) {
    static const char *const names[] = {"b.bvh", ".hidden", "a.bvh"}, *const one[] = {"some.asf"};
    Arena arena = {0};
    Error e = {0};
    Listing list;
    if (!folder_make()) return 1;
    lists(names, 3, -1);
    OK(listing_read(folder, &arena, &list, &e) && list.count == 2 && strcmp(list.name[0], "a.bvh") == 0, "a listing %s",
       e.text);
    lists(names, 3, 1);
    OK(!listing_read(folder, &arena, &list, &e) && e.kind == ERR_INPUT && strstr(e.text, strerror(EIO)),
       "one that breaks off is an error: %s", e.text);

    Motion m;
    MotionOptions options = {0};
    e = (Error){0};
    folder_put_text("some.asf", ":root\n order TX\n:bonedata\n begin\n name a\n end\n:hierarchy\n root a\n");
    const char *path = folder_put_text("walk.amc", "1\nroot 0\n");
    lists(one, 1, -1);
    OK(motion_open(path, &options, &arena, NULL, &m, &e), "the only skeleton of a folder %s", e.text);
    motion_close(&m);
    lists(one, 1, 1);
    OK(!motion_open(path, &options, &arena, NULL, &m, &e) && strstr(e.text, strerror(EIO)),
       "is not the only one that is known to be there: %s", e.text);
    motion_close(&m);
    arena_free(&arena);
    folder_remove();
    return tap_done();
}
