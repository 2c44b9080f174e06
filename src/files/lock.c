/* flock(2): a lock that the kernel gives back when its owner dies, so nothing stale can be left
   behind. syncfs(2) writes a whole motion to the disk with one call, where fsync would need one
   for each frame. */
#define _GNU_SOURCE /* syncfs */
#include "files/lock.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

static bool is_same_file(int fd, const char *path) {
    struct stat open_one, named;
    return fstat(fd, &open_one) == 0 && stat(path, &named) == 0 && open_one.st_dev == named.st_dev &&
           open_one.st_ino == named.st_ino;
}

/* Between our open and our flock the owner may have removed the file: then the lock is on nothing
   that others see, and it takes another try. */
static bool take(Lock *lock, const char *path, int flags, Error *e) {
    enum { TRIES = 100 };
    for (int i = 0; i < TRIES; i++) {
        int fd = open(path, flags | O_CLOEXEC, 0666);
        if (fd < 0) return error_set(e, ERR_OUTPUT, "cannot open '%s': %s", path, strerror(errno));
        if (flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            close(fd);
            return error_set(e, ERR_OUTPUT, "another run is writing here: '%s' is locked", path);
        }
        lock->fd_plus_one = fd + 1;
        if (is_same_file(fd, path)) return true;
        close(fd);
        lock->fd_plus_one = 0;
    }
    return error_set(e, ERR_OUTPUT, "another run is writing here: '%s' comes and goes", path);
}

bool lock_file(Lock *lock, const char *path, Error *e) {
    lock->is_file = true;
    if (snprintf(lock->path, sizeof lock->path, "%s", path) >= (int)sizeof lock->path)
        return error_set(e, ERR_OUTPUT, "the name of the output folder is too long");
    return take(lock, path, O_RDWR | O_CREAT | O_NOFOLLOW, e);
}

bool lock_folder(Lock *lock, const char *path, Error *e) {
    lock->is_file = false;
    return take(lock, path, O_RDONLY | O_DIRECTORY, e);
}

void lock_release(Lock *lock) {
    if (!lock->fd_plus_one) return;
    if (lock->is_file) unlink(lock->path);
    close(lock->fd_plus_one - 1);
    lock->fd_plus_one = 0;
}

bool sync_folder(const char *path, Error *e) {
    int fd = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    int code = fd < 0 ? errno : 0;
#ifdef __linux__
    if (!code && syncfs(fd) != 0) code = errno;
#else
    sync();
#endif
    if (fd >= 0) close(fd);
    return !code || error_set(e, ERR_OUTPUT, "cannot bring '%s' to the disk: %s", path, strerror(code));
}
