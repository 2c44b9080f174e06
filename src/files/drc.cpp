/* Draco files: our plain arrays in, theirs out, and back.

   No logic of ours is in here, only the translation. Draco counts in float, and no exception
   of C++ leaves this file. The headers of C come last, for they must not be the first to
   include the system's inside extern "C". */
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <vector>

#include <draco/compression/decode.h>

#include "files/drc_encoder.h"
extern "C" {
#include "files/drc.h"
#include "files/output.h"
}

using draco::GeometryAttribute;

static const size_t FILE_LIMIT = size_t(1) << 30;

/* The memory of a writer: the mesh with its attributes, the encoder and the bytes. What
   Draco needs within one encoding, connectivity included, it takes and gives back itself. */
struct DrcKept {
    draco::Mesh mesh;
    DrcEncoder encoder;
    draco::EncoderBuffer buffer;
    int attribute[draco::GeometryAttribute::NAMED_ATTRIBUTES_COUNT];
    bool has_normal, has_uv;
};

static void add_attribute(DrcKept *kept, GeometryAttribute::Type type, int components) {
    GeometryAttribute shape;
    shape.Init(type, nullptr, uint8_t(components), draco::DT_FLOAT32, false, int64_t(sizeof(float)) * components, 0);
    kept->attribute[type] = kept->mesh.AddAttribute(shape, true, 0);
}

static DrcKept *make_kept(bool has_normal, bool has_uv) {
    DrcKept *kept = new DrcKept{};
    kept->has_normal = has_normal;
    kept->has_uv = has_uv;
    add_attribute(kept, GeometryAttribute::POSITION, 3);
    if (has_normal) add_attribute(kept, GeometryAttribute::NORMAL, 3);
    if (has_uv) add_attribute(kept, GeometryAttribute::TEX_COORD, 2);
    return kept;
}

/* Room for a value for each point. */
static float *values_of(DrcKept *kept, GeometryAttribute::Type type) {
    draco::PointAttribute *attribute = kept->mesh.attribute(kept->attribute[type]);
    attribute->Reset(kept->mesh.num_points());
    return reinterpret_cast<float *>(attribute->GetAddress(draco::AttributeValueIndex(0)));
}

/* Sums of finite numbers are finite, or overflow, which no mesh of ours comes near. */
static bool put_vectors(float *out, const Vec3 *v, int n, double unit) {
    float sum = 0;
    for (int i = 0; i < n; i++, out += 3) {
        out[0] = float(v[i].x * unit);
        out[1] = float(v[i].y * unit);
        out[2] = float(v[i].z * unit);
        sum += std::fabs(out[0]) + std::fabs(out[1]) + std::fabs(out[2]);
    }
    return std::isfinite(sum);
}

static bool put_uv(float *out, const Mesh *mesh) {
    float sum = 0;
    for (int i = 0; i < mesh->nvertices; i++, out += 2) {
        out[0] = float(mesh->u[i]);
        out[1] = float(mesh->w[i]);
        sum += std::fabs(out[0]) + std::fabs(out[1]);
    }
    return std::isfinite(sum);
}

static bool fill(DrcKept *kept, const Mesh *mesh, double unit, Error *e) {
    draco::Mesh &out = kept->mesh;
    out.set_num_points(uint32_t(mesh->nvertices));
    out.SetNumFaces(size_t(mesh->ntriangles));
    for (int t = 0; t < mesh->ntriangles; t++) {
        const int *v = mesh->triangle[t].v;
        out.SetFace(
            draco::FaceIndex(uint32_t(t)),
            {draco::PointIndex(uint32_t(v[0])), draco::PointIndex(uint32_t(v[1])), draco::PointIndex(uint32_t(v[2]))});
    }
    bool good = put_vectors(values_of(kept, GeometryAttribute::POSITION), mesh->position, mesh->nvertices, unit) &&
                (!kept->has_normal ||
                 put_vectors(values_of(kept, GeometryAttribute::NORMAL), mesh->normal, mesh->nvertices, 1)) &&
                (!kept->has_uv || put_uv(values_of(kept, GeometryAttribute::TEX_COORD), mesh));
    return good || error_set(e, ERR_INTERNAL, "the mesh has a number that is not finite");
}

/* Cloth and body are rounded apart: with 14 bits, a tenth of a millimetre on a body, one frame in 300 showed something
   that its OBJ file does not. */
static void set_options(draco::Encoder *encoder, const DrcOptions &o) {
    int speed = o.speed > 0 ? o.speed - 1 : 7;
    encoder->SetSpeedOptions(speed, speed);
    encoder->SetEncodingMethod(o.keep_order ? draco::MESH_SEQUENTIAL_ENCODING : draco::MESH_EDGEBREAKER_ENCODING);
    encoder->SetAttributeQuantization(GeometryAttribute::POSITION, o.position_bits > 0 ? o.position_bits : 16);
    encoder->SetAttributeQuantization(GeometryAttribute::NORMAL, o.normal_bits > 0 ? o.normal_bits : 10);
    encoder->SetAttributeQuantization(GeometryAttribute::TEX_COORD, o.uv_bits > 0 ? o.uv_bits : 12);
}

void drc_writer_free(DrcWriter *w) {
    for (DrcKept *&kept : w->kept) {
        delete kept;
        kept = nullptr;
    }
}

bool drc_write(DrcWriter *w, const char *path, const Mesh *mesh, double unit, const DrcOptions *options,
               long long *bytes, Error *e) try {
    bool has_normal = mesh->normal, has_uv = mesh->u && mesh->w;
    DrcKept *&kept = w->kept[(has_normal ? 1 : 0) + (has_uv ? 2 : 0)];
    if (!kept) kept = make_kept(has_normal, has_uv);
    if (!fill(kept, mesh, unit, e)) return false;
    set_options(&kept->encoder.options(), *options);
    draco::EncoderBuffer &buffer = kept->buffer;
    buffer.Clear();
    const draco::Status status = kept->encoder.encode(kept->mesh, &buffer);
    if (!status.ok()) return error_set(e, ERR_INTERNAL, "cannot encode '%s': Draco says: %s", path, status.error_msg());
    if (bytes) *bytes = (long long)buffer.size();
    return output_file(path, buffer.data(), buffer.size(), e);
} catch (const std::exception &problem) {
    return error_set(e, ERR_INTERNAL, "cannot encode '%s': %s", path, problem.what());
} catch (...) {
    return error_set(e, ERR_INTERNAL, "cannot encode '%s': Draco gave up", path);
}

static bool read_bytes(const char *path, std::vector<char> *out, Error *e) {
    std::unique_ptr<FILE, int (*)(FILE *)> file(fopen(path, "rb"), fclose);
    if (!file) return error_set(e, ERR_INPUT, "cannot open '%s': %s", path, strerror(errno));
    for (size_t n = 0;; n = out->size()) {
        out->resize(n + (1 << 16));
        size_t got = fread(out->data() + n, 1, 1 << 16, file.get());
        out->resize(n + got);
        if (ferror(file.get())) return error_set(e, ERR_INPUT, "cannot read '%s': %s", path, strerror(errno));
        if (out->size() > FILE_LIMIT) return error_set(e, ERR_INPUT, "'%s' is larger than %zu bytes", path, FILE_LIMIT);
        if (got < 1 << 16) return true;
    }
}

/* n values of a named attribute, `components` floats each. */
template <typename Take> static void take_attribute(const draco::PointAttribute *attribute, uint32_t n, Take take) {
    for (uint32_t i = 0; i < n; i++) {
        float x[3] = {0, 0, 0};
        attribute->ConvertValue<float>(attribute->mapped_index(draco::PointIndex(i)), 3, x);
        take(i, x);
    }
}

static bool take_vectors(const draco::PointAttribute *attribute, uint32_t n, Arena *arena, Vec3 **out, Error *e) {
    Vec3 *v = ARENA_NEW(arena, Vec3, n, e);
    if (!v) return false;
    take_attribute(attribute, n, [=](uint32_t i, const float *x) { v[i].x = x[0], v[i].y = x[1], v[i].z = x[2]; });
    *out = v;
    return true;
}

/* Written so that NaN fails. */
static bool is_within(const Vec3 &p) {
    return std::fabs(p.x) <= MESH_REACH && std::fabs(p.y) <= MESH_REACH && std::fabs(p.z) <= MESH_REACH;
}

static bool check_places(const Mesh *mesh, const char *path, Error *e) {
    for (int i = 0; i < mesh->nvertices; i++)
        if (!is_within(mesh->position[i]))
            return error_set(e, ERR_INPUT, "'%s' has a vertex with a coordinate out of range", path);
    return true;
}

static bool take_uv(const draco::PointAttribute *attribute, uint32_t n, Arena *arena, Mesh *out, Error *e) {
    double *u = ARENA_NEW(arena, double, n, e), *w = ARENA_NEW(arena, double, n, e);
    if (!u || !w) return false;
    take_attribute(attribute, n, [=](uint32_t i, const float *x) { u[i] = x[0], w[i] = x[1]; });
    out->u = u;
    out->w = w;
    return true;
}

static bool take_triangles(const draco::Mesh &mesh, Arena *arena, Mesh *out, const char *path, Error *e) {
    out->triangle = ARENA_NEW(arena, Triangle, mesh.num_faces(), e);
    if (!out->triangle) return false;
    for (uint32_t t = 0; t < mesh.num_faces(); t++) {
        for (int c = 0; c < 3; c++) {
            uint32_t v = mesh.face(draco::FaceIndex(t))[size_t(c)].value();
            if (v >= mesh.num_points())
                return error_set(e, ERR_INPUT, "'%s' has a triangle with a vertex that does not exist", path);
            out->triangle[t].v[c] = int(v);
        }
    }
    out->ntriangles = int(mesh.num_faces());
    return true;
}

bool drc_read(const char *path, Arena *arena, Mesh *out, Error *e) try {
    memset(out, 0, sizeof *out);
    std::vector<char> bytes;
    if (!read_bytes(path, &bytes, e)) return false;
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) return error_set(e, ERR_INPUT, "'%s' is no Draco mesh: %s", path, decoded.status().error_msg());
    const draco::Mesh &mesh = *decoded.value();
    const draco::PointAttribute *position = mesh.GetNamedAttribute(GeometryAttribute::POSITION);
    const draco::PointAttribute *normal = mesh.GetNamedAttribute(GeometryAttribute::NORMAL);
    const draco::PointAttribute *uv = mesh.GetNamedAttribute(GeometryAttribute::TEX_COORD);
    if (!position || mesh.num_points() > INT32_MAX || mesh.num_faces() > INT32_MAX)
        return error_set(e, ERR_INPUT, "'%s' has no vertices", path);
    uint32_t n = mesh.num_points();
    out->nvertices = int(n);
    return take_vectors(position, n, arena, &out->position, e) && check_places(out, path, e) &&
           (!normal || take_vectors(normal, n, arena, &out->normal, e)) && (!uv || take_uv(uv, n, arena, out, e)) &&
           take_triangles(mesh, arena, out, path, e);
} catch (const std::exception &problem) {
    return error_set(e, ERR_INPUT, "cannot decode '%s': %s", path, problem.what());
} catch (...) {
    return error_set(e, ERR_INPUT, "cannot decode '%s': Draco gave up", path);
}
