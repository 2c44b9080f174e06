/* For drc.cpp alone (C++): a Draco encoder that knows the meshes it has encoded before. */
#ifndef FILES_DRC_ENCODER_H
#define FILES_DRC_ENCODER_H

#include <memory>
#include <vector>

#include <draco/compression/encode.h>

/* What Draco found out about one connectivity; see drc_encoder.cpp. */
struct DrcRecord;

/* The bytes are those of draco::Encoder with the same options. Not for more than one thread. */
class DrcEncoder {
public:
    DrcEncoder();
    ~DrcEncoder();
    draco::Encoder &options() { return encoder; }
    draco::Status encode(const draco::Mesh &mesh, draco::EncoderBuffer *out);

private:
    draco::Encoder encoder;
    std::vector<std::unique_ptr<DrcRecord>> records; /* the one used last comes last */
};

#endif
