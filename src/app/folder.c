/* Only files with names that this program gives are ever removed from a motion's folder. The record goes first: it says
   that the others are there. */
#include "app/folder.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "app/record.h"

bool folder_has_files(const char *path) {
    DIR *folder = opendir(path);
    if (!folder) return errno != ENOENT && errno != ENOTDIR;
    bool found = false;
    for (struct dirent *entry; !found && (errno = 0, entry = readdir(folder));) {
        struct stat info;
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
        found = fstatat(dirfd(folder), entry->d_name, &info, AT_SYMLINK_NOFOLLOW) != 0 || !S_ISDIR(info.st_mode);
    }
    found = found || errno != 0;
    closedir(folder);
    return found;
}

/* The record, stats.csv, or NAME.DIGITS.obj or .drc with at least four digits; any of them with .tmp behind. */
static bool is_ours(const char *name) {
    size_t n = strlen(name), digits = 0;
    if (n > 4 && strcmp(name + n - 4, ".tmp") == 0) n -= 4;
    if (n == 9 && memcmp(name, "stats.csv", 9) == 0) return true;
    if (n == strlen(RECORD_NAME) && memcmp(name, RECORD_NAME, n) == 0) return true;
    if (n < 10 || (memcmp(name + n - 4, ".obj", 4) != 0 && memcmp(name + n - 4, ".drc", 4) != 0)) return false;
    for (n -= 4; n > 0 && isdigit((unsigned char)name[n - 1]); n--) digits++;
    return digits >= 4 && n >= 2 && name[n - 1] == '.';
}

bool folder_clear(const char *path, Error *e) {
    DIR *folder = opendir(path);
    if (!folder && errno == ENOENT) return true;
    if (!folder) return error_set(e, ERR_OUTPUT, "cannot open the folder '%s': %s", path, strerror(errno));
    bool good = unlinkat(dirfd(folder), RECORD_NAME, 0) == 0 || errno == ENOENT ||
                error_set(e, ERR_OUTPUT, "cannot remove '%s/" RECORD_NAME "': %s", path, strerror(errno));
    for (struct dirent *entry; good && (errno = 0, entry = readdir(folder));)
        if (is_ours(entry->d_name) && unlinkat(dirfd(folder), entry->d_name, 0) != 0 && errno != ENOENT)
            good = error_set(e, ERR_OUTPUT, "cannot remove '%s/%s': %s", path, entry->d_name, strerror(errno));
    if (good && errno) good = error_set(e, ERR_OUTPUT, "cannot list the folder '%s': %s", path, strerror(errno));
    closedir(folder);
    return good;
}
