/* A folder that a unit program may write in, removed at its end. */
#ifndef TESTS_FOLDER_H
#define TESTS_FOLDER_H

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/kitsuke-unit-XXXXXX";

static inline bool folder_make(void) {
    if (mkdtemp(folder)) return true;
    printf("Bail out! cannot make a folder in /tmp\n");
    return false;
}

static inline void folder_remove(void) {
    char command[64];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    if (system(command) != 0) printf("# %s is left\n", folder);
}

/* Its path with a name in it; good until the call after the next. */
static inline const char *in_folder(const char *name) {
    static char path[2][256];
    static int turn;
    turn = !turn;
    snprintf(path[turn], sizeof path[turn], "%s/%s", folder, name);
    return path[turn];
}

/* Puts a file of `size` bytes, or one of a text, into the folder; returns its path, which is as good. */
static inline const char *folder_put(const char *name, const char *bytes, size_t size) {
    const char *path = in_folder(name);
    FILE *f = fopen(path, "wb");
    if (!f || fwrite(bytes, 1, size, f) != size) printf("Bail out! cannot write %s\n", path);
    if (f) fclose(f);
    return path;
}
static inline const char *folder_put_text(const char *name, const char *text) {
    return folder_put(name, text, strlen(text));
}

/* A link in the folder to a device. Tests write to the link: as root a broken writer would
   replace what it is given, and that must not be the device itself. */
static inline const char *link_to(const char *device, const char *name) {
    const char *path = in_folder(name);
    remove(path);
    return symlink(device, path) == 0 ? path : NULL;
}

#endif
