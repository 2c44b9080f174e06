/* Wavefront OBJ, written and read back. */
#ifndef FILES_OBJ_H
#define FILES_OBJ_H

#include "base/text.h"
#include "files/memo.h"
#include "geometry/mesh.h"
#include "geometry/vectors.h"

/* The memory that a sequence of files is written with: it grows to the largest and stays.
   Clear with {0}. One belongs to one thread. */
typedef struct {
    char *text; /* of the last file */
    size_t size, capacity;
    struct ObjCorner *corner; /* how corner i is written in a face, for all files so far of its kind */
    int ncorners, corner_capacity;
    int corner_kind;
    Memo memo; /* of parameters and faces */
    Vectors vectors; /* to format numbers with */
    double metre; /* how many units of the file the first line says a metre has; 0: as many as `unit` */
} ObjWriter;

/* Writes mesh to `path` as v / vt / vn / g / f lines, positions times `unit` (output units per
   metre) as "%.6f", vt and vn as "%.6f" where the mesh has them. Goes to a temporary name in
   the same folder first and is renamed, so that nothing half-written is ever seen. *bytes, if
   not NULL, gets the size. ERR_OUTPUT; ERR_INTERNAL for a number that is not finite. */
MUST_CHECK bool obj_write(ObjWriter *w, const char *path, const Mesh *mesh, double unit, long long *bytes, Error *e);

/* Only the text, in w->text. */
MUST_CHECK bool obj_format(ObjWriter *w, const Mesh *mesh, double unit, Error *e);

void obj_writer_free(ObjWriter *w);

/* Reads v, vt, vn, groups and f (any polygon, fan-triangulated; negative indices). Positions
   as they stand; a vertex takes normal and u, w from its first corner in a face, and arrays
   that not every corner gives are NULL. Groups are those of `g`, without any those of `o`,
   without any those of `usemtl`. No edges. ERR_INPUT with place. */
MUST_CHECK bool obj_parse(const Text *text, Arena *arena, Mesh *out, Error *e);

#endif
