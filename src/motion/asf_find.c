/* The skeleton of an AMC file without --asf: the .asf file beside it whose name, without the ending, the AMC's name
   begins with (02.asf for 02_03.amc), the longest of several; or the only one in the folder. */
#include <dirent.h>
#include <errno.h>
#include <string.h>

#include "base/text.h"
#include "motion/source.h"

/* Is `stem` the beginning of `name` up to a place where a word ends? 02 of 02_03, not of 021. */
static bool is_prefix(const char *stem, size_t n, const char *name, size_t length) {
    return n <= length && memcmp(stem, name, n) == 0 && (n == length || !strchr("0123456789", name[n]));
}

typedef struct {
    char best[256]; /* the file with the longest stem that fits, or the only one */
    size_t stem;    /* its length; 0: it does not fit */
    int count;      /* files that end in .asf */
} Search;

static bool cannot_list(const char *folder, const char *amc, Error *e) {
    return error_set(e, ERR_INPUT, "cannot list '%s' for the skeleton of '%s': %s", folder, amc, strerror(errno));
}

static void consider(Search *found, const char *file, const char *name, size_t length) {
    size_t n = strlen(file);
    if (n >= sizeof found->best || !text_ends_in(file, ".asf")) return;
    found->count++;
    size_t stem = is_prefix(file, n - 4, name, length) ? n - 4 : 0;
    /* Of a.asf and a.ASF take one whatever the order of the folder. */
    bool better = stem > found->stem || (stem == found->stem && (found->count == 1 || strcmp(file, found->best) < 0));
    if (!better) return;
    memcpy(found->best, file, n + 1);
    found->stem = stem;
}

bool asf_find(Opening *o, const char **path, Error *e) {
    const char *amc = o->motion->path, *slash = strrchr(amc, '/'), *name = slash ? slash + 1 : amc;
    if (strcmp(amc, "-") == 0)
        return error_set(e, ERR_INPUT, "an AMC motion on standard input needs its skeleton: give --asf");
    const char *dot = strrchr(name, '.');
    size_t length = dot ? (size_t)(dot - name) : strlen(name), folder = (size_t)(name - amc);
    const char *where = folder ? arena_text(o->arena, amc, folder, e) : ".";
    if (!where) return false;
    DIR *dir = opendir(where);
    if (!dir) return cannot_list(where, amc, e);
    Search found = {.count = 0};
    for (struct dirent *entry; (errno = 0, entry = readdir(dir));) consider(&found, entry->d_name, name, length);
    bool whole = !errno || cannot_list(where, amc, e);
    closedir(dir);
    if (!whole) return false;
    if (!found.stem && found.count != 1)
        return error_set(e, ERR_INPUT, "no skeleton for '%s': %s beside it; give --asf", amc,
                         found.count ? "none of the .asf files has a name that fits" : "there is no .asf file");
    char *full = ARENA_NEW(o->arena, char, folder + strlen(found.best) + 1, e);
    if (!full) return false;
    memcpy(full, amc, folder);
    memcpy(full + folder, found.best, strlen(found.best));
    *path = full;
    return true;
}
