#include "core/base/byte_writer.h"

namespace argmesh {
namespace {

template <typename T>
void Append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

}  // namespace

void ByteWriter::WriteU8(uint8_t value) { Append(bytes_, value); }
void ByteWriter::WriteU16(uint16_t value) { Append(bytes_, value); }
void ByteWriter::WriteU32(uint32_t value) { Append(bytes_, value); }
void ByteWriter::WriteU64(uint64_t value) { Append(bytes_, value); }
void ByteWriter::WriteF32(float value) { Append(bytes_, value); }
void ByteWriter::WriteF64(double value) { Append(bytes_, value); }

void ByteWriter::WriteF32Array(std::span<const float> values) {
  bytes_.append(reinterpret_cast<const char*>(values.data()),
                values.size_bytes());
}

void ByteWriter::WriteBytes(std::string_view bytes) { bytes_.append(bytes); }

}  // namespace argmesh
