/* Writing files so that a reader sees the whole of one or none of it.

   A file is written under PATH.tmp and renamed, which replaces an older PATH in one step. The
   temporary's name follows from the path alone: the next run overwrites what a killed run
   left behind. No fsync: after a power cut ten thousand frames are computed again, and syncing
   each of them would cost more than computing it. */
#include "files/output.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Of a long path the end is shown, so that there is room for the reason. */
static bool cannot(const char *what, const char *path, int code, Error *e) {
    enum { SHOWN = 160 };
    size_t n = strlen(path);
    return error_set(e, ERR_OUTPUT, "cannot %s '%s%s': %s", what, n > SHOWN ? "..." : "",
                     n > SHOWN ? path + n - SHOWN : path, strerror(code));
}

static bool cannot_write(const char *path, int code, Error *e) {
    if (strcmp(path, "-") == 0)
        return error_set(e, ERR_OUTPUT, "cannot write to standard output: %s", strerror(code));
    return cannot("write", path, code, e);
}

/* Something that is there and no regular file must not be replaced by one. */
static bool is_written_in_place(const char *path) {
    struct stat info;
    return stat(path, &info) == 0 && !S_ISREG(info.st_mode);
}

/* Opens path, or the temporary for it, whose name goes to `temporary` (empty: in place). -1
   with an error. */
static int open_temporary(const char *path, char *temporary, size_t n, Error *e) {
    bool in_place = is_written_in_place(path);
    if (in_place) temporary[0] = 0;
    else if (snprintf(temporary, n, "%s.tmp", path) >= (int)n) return cannot_write(path, ENAMETOOLONG, e), -1;
    int flags = in_place ? O_WRONLY : O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW;
    int fd = open(in_place ? path : temporary, flags | O_CLOEXEC, 0666);
    if (fd < 0) cannot_write(path, errno, e);
    return fd;
}

/* Gives the finished temporary its name, or removes it where code says that something failed. */
static bool settle(const char *path, const char *temporary, int code, Error *e) {
    if (!code && temporary[0] && rename(temporary, path) != 0) code = errno;
    if (!code) return true;
    if (temporary[0]) unlink(temporary);
    return cannot_write(path, code, e);
}

bool output_open(Output *o, const char *path, Error *e) {
    o->file = NULL;
    if (snprintf(o->path, sizeof o->path, "%s", path) >= (int)sizeof o->path)
        return cannot_write(path, ENAMETOOLONG, e);
    if (strcmp(path, "-") == 0) {
        o->temporary[0] = 0;
        o->file = stdout;
        return true;
    }
    int fd = open_temporary(path, o->temporary, sizeof o->temporary, e);
    if (fd < 0) return false;
    o->file = fdopen(fd, "w");
    if (o->file) return true;
    int code = errno;
    close(fd);
    return settle(path, o->temporary, code, e);
}

bool output_good(const Output *o, Error *e) {
    int code = errno; /* of the write that failed, if this is asked right behind it */
    return !ferror(o->file) || cannot_write(o->path, code ? code : EIO, e);
}

bool output_close(Output *o, Error *e) {
    FILE *file = o->file;
    o->file = NULL;
    errno = 0;
    int code = fflush(file) != 0 || ferror(file) ? (errno ? errno : EIO) : 0;
    if (file != stdout && fclose(file) != 0 && !code) code = errno ? errno : EIO;
    return settle(o->path, o->temporary, code, e);
}

void output_abandon(Output *o) {
    if (!o->file) return;
    if (o->file != stdout) fclose(o->file);
    if (o->temporary[0]) unlink(o->temporary);
    o->file = NULL;
}

/* All n bytes, in as few calls as the system lets us; 0 or the errno. */
static int write_all(int fd, const char *data, size_t n) {
    while (n > 0) {
        ssize_t k = write(fd, data, n);
        if (k < 0 && errno == EINTR) continue;
        if (k <= 0) return k < 0 ? errno : EIO;
        data += k;
        n -= (size_t)k;
    }
    return 0;
}

bool output_file(const char *path, const void *data, size_t size, Error *e) {
    char temporary[OUTPUT_PATH_MAX + 8];
    int fd = open_temporary(path, temporary, sizeof temporary, e);
    if (fd < 0) return false;
    int code = write_all(fd, data, size);
    if (close(fd) != 0 && !code) code = errno; /* some disks say only now that they are full */
    return settle(path, temporary, code, e);
}

bool output_folder(const char *path, Error *e) {
    char part[OUTPUT_PATH_MAX];
    size_t n = strlen(path);
    if (n >= sizeof part) return cannot("make the folder", path, ENAMETOOLONG, e);
    memcpy(part, path, n + 1);
    for (size_t i = n > 0; i <= n; i++) {
        if (path[i] != '/' && path[i] != 0) continue;
        part[i] = 0;
        struct stat info;
        int code = mkdir(part, 0777) == 0 ? 0 : errno;
        if (code && stat(part, &info) == 0) code = S_ISDIR(info.st_mode) ? 0 : ENOTDIR;
        if (code) return cannot("make the folder", part, code, e);
        part[i] = path[i];
    }
    return true;
}
