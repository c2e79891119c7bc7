// Appends little-endian values to a byte string; the mirror of ByteReader.
#ifndef ARGMESH_CORE_BASE_BYTE_WRITER_H_
#define ARGMESH_CORE_BASE_BYTE_WRITER_H_

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace argmesh {

class ByteWriter {
 public:
  void WriteU8(uint8_t value);
  void WriteU16(uint16_t value);
  void WriteU32(uint32_t value);
  void WriteU64(uint64_t value);
  void WriteF32(float value);
  void WriteF64(double value);
  void WriteF32Array(std::span<const float> values);
  void WriteBytes(std::string_view bytes);

  const std::string& bytes() const { return bytes_; }
  std::string TakeBytes() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_BASE_BYTE_WRITER_H_
