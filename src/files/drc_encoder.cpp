/* From frame to frame points move and triangles stay, but for Draco each mesh is new: more than half of
   its time goes into how triangles hang together and in which order to walk over them. None of that
   looks at a coordinate. So the first mesh of a connectivity is encoded by Draco's own encoder, and what it
   has written of it is kept, with its tables; later ones take both over, and only their attributes are
   encoded, by the same classes of Draco from the same tables.

   This holds where all attributes share one connectivity, which is how Draco goes about it from speed 6
   on; for all else Draco is asked as ever. */
#include "files/drc_encoder.h"

#include <algorithm>

#include <draco/compression/attributes/sequential_attribute_encoders_controller.h>
#include <draco/compression/expert_encode.h>
#include <draco/compression/mesh/mesh_edgebreaker_encoder.h>

namespace {

const int SPEED_OF_ONE_CONNECTIVITY = 6;
const size_t RECORDS_MAX = 8;

typedef std::vector<char> Bytes;

void put(const Bytes &bytes, draco::EncoderBuffer *out) { out->Encode(bytes.data(), bytes.size()); }

/* Draco's encoder, which keeps what it writes before the attributes. */
class Recorder : public draco::MeshEdgebreakerEncoder {
public:
    Bytes start, connectivity, identifier;

protected:
    bool InitializeEncoder() override {
        size_t from = buffer()->size();
        bool good = MeshEdgebreakerEncoder::InitializeEncoder();
        keep(from, &start);
        return good;
    }
    draco::Status EncodeConnectivity() override {
        size_t from = buffer()->size();
        draco::Status status = MeshEdgebreakerEncoder::EncodeConnectivity();
        keep(from, &connectivity);
        return status;
    }
    bool EncodeAttributesEncoderIdentifier(int32_t id) override {
        size_t from = buffer()->size();
        bool good = MeshEdgebreakerEncoder::EncodeAttributesEncoderIdentifier(id);
        keep(from, &identifier);
        return good;
    }

private:
    void keep(size_t from, Bytes *out) { out->assign(buffer()->data() + from, buffer()->data() + buffer()->size()); }
};

/* The order in which the recorder has walked over the points. */
class Order : public draco::PointsSequencer {
public:
    Order(const draco::Mesh *mesh, const Recorder &recorder) : mesh(mesh), recorder(recorder) {}

protected:
    bool GenerateSequenceInternal() override {
        for (draco::CornerIndex corner :
             recorder.GetAttributeEncodingData(0)->encoded_attribute_value_index_to_corner_map)
            AddPointId(mesh->CornerToPointId(corner));
        return true;
    }

private:
    const draco::Mesh *mesh;
    const Recorder &recorder;
};

/* Repeats what was recorded, round the attributes of another mesh. */
class Repeater : public draco::MeshEncoder {
public:
    explicit Repeater(const Recorder &recorder) : recorder(recorder) {}
    uint8_t GetEncodingMethod() const override { return recorder.GetEncodingMethod(); }
    const draco::CornerTable *GetCornerTable() const override { return recorder.GetCornerTable(); }
    const draco::MeshAttributeIndicesEncodingData *GetAttributeEncodingData(int attribute) const override {
        return recorder.GetAttributeEncodingData(attribute);
    }

protected:
    bool InitializeEncoder() override {
        put(recorder.start, buffer());
        return true;
    }
    draco::Status EncodeConnectivity() override {
        put(recorder.connectivity, buffer());
        return draco::OkStatus();
    }
    bool GenerateAttributesEncoder(int32_t attribute) override {
        typedef draco::SequentialAttributeEncodersController Controller;
        if (num_attributes_encoders() > 0) attributes_encoder(0)->AddAttributeId(attribute);
        else
            AddAttributesEncoder(std::unique_ptr<Controller>(
                new Controller(std::unique_ptr<draco::PointsSequencer>(new Order(mesh(), recorder)), attribute)));
        return true;
    }
    bool EncodeAttributesEncoderIdentifier(int32_t) override {
        put(recorder.identifier, buffer());
        return true;
    }
    void ComputeNumberOfEncodedPoints() override {}
    void ComputeNumberOfEncodedFaces() override {}

private:
    const Recorder &recorder;
};

} // namespace

struct DrcRecord {
    int speed;
    uint32_t points;
    std::vector<draco::Mesh::Face> faces;
    Recorder recorder;

    bool is_of(const draco::Mesh &mesh, int its_speed) const {
        if (speed != its_speed || points != mesh.num_points() || faces.size() != mesh.num_faces()) return false;
        for (uint32_t t = 0; t < mesh.num_faces(); t++)
            if (faces[t] != mesh.face(draco::FaceIndex(t))) return false;
        return true;
    }
};

DrcEncoder::DrcEncoder() {}
DrcEncoder::~DrcEncoder() {}

draco::Status DrcEncoder::encode(const draco::Mesh &mesh, draco::EncoderBuffer *out) {
    const draco::EncoderOptions o = encoder.CreateExpertEncoderOptions(mesh);
    bool edgebreaker = o.GetGlobalInt("encoding_method", -1) == draco::MESH_EDGEBREAKER_ENCODING;
    if (!edgebreaker || o.GetSpeed() < SPEED_OF_ONE_CONNECTIVITY) return encoder.EncodeMeshToBuffer(mesh, out);

    for (size_t k = 0; k < records.size(); k++) {
        if (!records[k]->is_of(mesh, o.GetSpeed())) continue;
        std::rotate(records.begin() + long(k), records.begin() + long(k) + 1, records.end());
        Repeater repeater(records.back()->recorder);
        repeater.SetMesh(mesh);
        return repeater.Encode(o, out);
    }
    std::unique_ptr<DrcRecord> record(new DrcRecord{o.GetSpeed(), mesh.num_points(), {}, {}});
    for (uint32_t t = 0; t < mesh.num_faces(); t++) record->faces.push_back(mesh.face(draco::FaceIndex(t)));
    record->recorder.SetMesh(mesh);
    const draco::Status status = record->recorder.Encode(o, out);
    if (!status.ok()) return status;
    if (records.size() == RECORDS_MAX) records.erase(records.begin());
    records.push_back(std::move(record));
    return status;
}
