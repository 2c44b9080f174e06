/* Locks between runs, and data that survives a power cut. */
#ifndef FILES_LOCK_H
#define FILES_LOCK_H

#include "files/output.h"

/* Clear with {0}. */
typedef struct { int fd_plus_one; bool is_file; char path[OUTPUT_PATH_MAX]; } Lock; /* private */

/* Takes a lock that ends with the process, however that ends. lock_file makes the file and
   lock_release removes it; lock_folder leaves no trace. Where the file system has no locks (or, as
   NFS, none for what is open to be read: lock_folder) the answer is yes. ERR_OUTPUT where another process has it. */
MUST_CHECK bool lock_file(Lock *lock, const char *path, Error *e);
MUST_CHECK bool lock_folder(Lock *lock, const char *path, Error *e);
void lock_release(Lock *lock);

/* Waits until everything that was written to the folder's file system stands on the disk. */
MUST_CHECK bool sync_folder(const char *path, Error *e);

#endif
