/* Wavefront OBJ, written and read back. */
#ifndef FILES_OBJ_H
#define FILES_OBJ_H

#include "geometry/mesh.h"

/* Writes mesh to `path` as v / vt / vn / g / f lines, positions times `unit` (output units per
   metre) as "%.6f", vt and vn as "%.6f" where the mesh has them. Goes to a temporary name in
   the same folder first and is renamed, so that nothing half-written is ever seen. *bytes, if
   not NULL, gets the size. ERR_OUTPUT. */
MUST_CHECK bool obj_write(const char *path, const Mesh *mesh, double unit, long long *bytes, Error *e);

/* Reads v, vt, vn, g/o/usemtl groups and f (any polygon, fan-triangulated; negative indices).
   Positions as they stand. ERR_INPUT with place. Used by `kitsuke verify` and the tests. */
MUST_CHECK bool obj_read(const char *path, Arena *arena, Mesh *out, Error *e);

#endif
