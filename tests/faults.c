/* Faults at a chosen place, for tests/faults.sh: a library that is loaded in front of the C library
   (LD_PRELOAD; glibc). FAULT says which and where, the N-th call from 1:

       write:N    a call that changes a file fails (no space left), and the next ones succeed
       full:N     that one and all behind it fail
       kill:N     the process dies (SIGKILL) in front of such a call
       memory:N   an allocation fails
       late:MS    whoever has told other threads of something sleeps so long behind the lock
       short:1    every write takes but half of what it is given
       list:N     a folder cannot be listed to its end: no more than N - 1 names of all

   Such a call is: open for writing, write, close of what was written, rename, unlink, mkdir, syncfs. Where
   the N-th call comes, the file FAULT_HIT is made. */
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

void *__libc_malloc(size_t n);
void *__libc_calloc(size_t n, size_t size);
void *__libc_realloc(void *p, size_t n);
void *__libc_memalign(size_t align, size_t n);

static enum { NOTHING, WRITE, FULL, KILL, MEMORY, LATE, SHORT, LIST } fault;
static long at;
static atomic_long calls;

__attribute__((constructor)) static void start(void) {
    static const char *const words[] = {"", "write:", "full:", "kill:", "memory:", "late:", "short:", "list:"};
    const char *text = getenv("FAULT");
    for (int i = WRITE; text && i <= LIST; i++) {
        if (strncmp(text, words[i], strlen(words[i])) != 0) continue;
        at = strtol(text + strlen(words[i]), NULL, 10);
        fault = i;
    }
}

static bool is_hit(bool and_later) {
    long n = atomic_fetch_add(&calls, 1) + 1;
    if (n == at) {
        int keep = errno;
        const char *path = getenv("FAULT_HIT");
        if (path) syscall(SYS_close, (int)syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT, 0666));
        errno = keep;
    }
    return n == at || (and_later && n > at);
}

/* Shall the call fail? */
static bool fails(void) {
    if (fault == KILL && is_hit(false)) raise(SIGKILL);
    if ((fault != WRITE && fault != FULL) || !is_hit(fault == FULL)) return false;
    errno = ENOSPC;
    return true;
}

static bool is_out_of_memory(void) {
    if (fault != MEMORY || !is_hit(false)) return false;
    errno = ENOMEM;
    return true;
}

void *malloc(size_t n) { return is_out_of_memory() ? NULL : __libc_malloc(n); }
void *calloc(size_t n, size_t size) { return is_out_of_memory() ? NULL : __libc_calloc(n, size); }
void *realloc(void *p, size_t n) { return is_out_of_memory() ? NULL : __libc_realloc(p, n); }
void *aligned_alloc(size_t align, size_t n) { return is_out_of_memory() ? NULL : __libc_memalign(align, n); }

/* Makes NAME the next definition of itself. */
#define NEXT(result, name, ...) \
    static result (*next)(__VA_ARGS__); \
    if (!next) *(void **)&next = dlsym(RTLD_NEXT, #name)

int open(const char *path, int flags, ...) {
    va_list args;
    va_start(args, flags);
    mode_t mode = flags & O_CREAT ? va_arg(args, mode_t) : 0;
    va_end(args);
    if ((flags & O_ACCMODE) != O_RDONLY && fails()) return -1;
    return (int)syscall(SYS_openat, AT_FDCWD, path, flags, mode);
}

static ssize_t write_some(int fd, const char *data, size_t n) {
    if (fails()) return -1;
    return (ssize_t)syscall(SYS_write, fd, data, fault == SHORT ? (n + 1) / 2 : n);
}

ssize_t write(int fd, const void *data, size_t n) { return write_some(fd, data, n); }

int close(int fd) {
    int flags = fcntl(fd, F_GETFL);
    bool bad = flags >= 0 && (flags & O_ACCMODE) != O_RDONLY && fails();
    int code = (int)syscall(SYS_close, fd);
    if (bad) errno = ENOSPC;
    return bad ? -1 : code;
}

int rename(const char *from, const char *to) {
    NEXT(int, rename, const char *, const char *);
    return fails() ? -1 : next(from, to);
}

int unlinkat(int fd, const char *path, int flags) {
    NEXT(int, unlinkat, int, const char *, int);
    if (fault == KILL) fails(); /* a full disk lets files go */
    return next(fd, path, flags);
}

int mkdir(const char *path, mode_t mode) {
    NEXT(int, mkdir, const char *, mode_t);
    struct stat info;
    return stat(path, &info) != 0 && fails() ? -1 : next(path, mode);
}

int syncfs(int fd) {
    NEXT(int, syncfs, int);
    return fails() ? -1 : next(fd);
}

struct dirent *readdir(DIR *folder) {
    NEXT(struct dirent *, readdir, DIR *);
    if (fault != LIST || !is_hit(true)) return next(folder);
    errno = EIO;
    return NULL;
}

/* With _FILE_OFFSET_BITS=64 programs call these, which on machines of 64 bits are the same. */
int open64(const char *path, int flags, ...) __attribute__((alias("open")));
struct dirent64 *readdir64(DIR *folder) { return (struct dirent64 *)readdir(folder); }

/* A stream's writes are the C library's own; behind this one they are ours. */
static ssize_t cookie_write(void *cookie, const char *data, size_t n) {
    int fd = (int)(long)cookie;
    for (size_t done = 0; done < n;) {
        ssize_t k = write_some(fd, data + done, n - done);
        if (k < 0) return 0;
        done += (size_t)k;
    }
    return (ssize_t)n;
}

static int cookie_close(void *cookie) { return close((int)(long)cookie); }

FILE *fdopen(int fd, const char *mode) {
    if (mode[0] != 'w') abort();
    return fopencookie((void *)(long)fd, mode, (cookie_io_functions_t){NULL, cookie_write, NULL, cookie_close});
}

static _Thread_local bool has_told;

int pthread_cond_broadcast(pthread_cond_t *c) {
    NEXT(int, pthread_cond_broadcast, pthread_cond_t *);
    has_told = fault == LATE;
    return next(c);
}

int pthread_mutex_unlock(pthread_mutex_t *m) {
    NEXT(int, pthread_mutex_unlock, pthread_mutex_t *);
    int code = next(m);
    if (has_told) usleep((useconds_t)(1000 * at));
    has_told = false;
    return code;
}
