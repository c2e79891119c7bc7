// Bounds-checked reading of little-endian binary data.
//
// Every read checks the bytes that are left before it touches or allocates
// anything, so that a count found in the data can never cost more memory than
// the data itself.
//
// Fails    kDataLoss  the bytes end before the value asked for
// Cost     O(bytes read). One reader belongs to one thread.
#ifndef ARGMESH_CORE_BASE_BYTE_READER_H_
#define ARGMESH_CORE_BASE_BYTE_READER_H_

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace argmesh {

class ByteReader {
 public:
  // `bytes` must outlive the reader. `what` names the data in error messages.
  ByteReader(std::string_view bytes, std::string_view what);

  size_t position() const { return position_; }
  size_t remaining() const { return bytes_.size() - position_; }

  absl::StatusOr<uint8_t> ReadU8();
  absl::StatusOr<uint16_t> ReadU16();
  absl::StatusOr<uint32_t> ReadU32();
  absl::StatusOr<uint64_t> ReadU64();
  absl::StatusOr<float> ReadF32();
  absl::StatusOr<double> ReadF64();

  // A u32 count of items that take at least `item_bytes` each; refused when
  // the bytes left cannot hold them.
  absl::StatusOr<uint32_t> ReadCount(size_t item_bytes);
  absl::StatusOr<std::vector<float>> ReadF32Array(size_t count);
  absl::StatusOr<std::string_view> ReadBytes(size_t count);

  // OK when every byte was consumed.
  absl::Status ExpectEnd() const;

 private:
  absl::Status Need(size_t count) const;
  template <typename T>
  absl::StatusOr<T> ReadScalar();

  std::string_view bytes_;
  std::string_view what_;
  size_t position_ = 0;
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_BASE_BYTE_READER_H_
