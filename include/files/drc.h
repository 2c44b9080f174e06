/* Draco (.drc): the one door to C++. */
#ifndef FILES_DRC_H
#define FILES_DRC_H

#include "base/error.h"
#include "geometry/mesh.h"

/* Zero means the default in brackets. */
typedef struct {
    int position_bits;  /* 1..30 [16]; a step is the largest extent / (2^bits - 1) */
    int normal_bits;    /* 2..30 [10] */
    int uv_bits;        /* 1..30 [12] */
    int speed;          /* 0 smallest .. 10 fastest; stored as speed + 1 so that 0 = [7] */
    bool keep_order;    /* sequential encoding: vertices and triangles stay in order */
} DrcOptions;

/* The memory that a sequence of files is encoded with. Clear with {0}; one belongs to one thread. */
typedef struct { struct DrcKept *kept[4]; /* for each kind of mesh */ } DrcWriter;

#ifdef __cplusplus
extern "C" {
#endif
/* Encodes the mesh (positions times `unit`, normals and u, w where present) and writes it as
   obj_write does: temporary name, then rename. A vertex has one normal: creases are left out, for
   Draco would take the surface apart there. *bytes, if not NULL, gets the size. ERR_OUTPUT;
   ERR_INTERNAL where Draco refuses. */
MUST_CHECK bool drc_write(DrcWriter *w, const char *path, const Mesh *mesh, double unit, const DrcOptions *options,
                          long long *bytes, Error *e);
void drc_writer_free(DrcWriter *w);

/* Decodes positions and triangles, normals and u, w if present, into the arena. ERR_INPUT. */
MUST_CHECK bool drc_read(const char *path, Arena *arena, Mesh *out, Error *e);
#ifdef __cplusplus
}
#endif

#endif
