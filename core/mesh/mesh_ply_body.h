// The numbers of a PLY body, read one after the other: from text or from
// binary data. Both sources have the same members, so that one reader of
// elements works on either. Nothing is read past the end of the bytes.
//
// Fails    kInvalidArgument  with the line or byte
#ifndef ARGMESH_CORE_MESH_MESH_PLY_BODY_H_
#define ARGMESH_CORE_MESH_MESH_PLY_BODY_H_

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/mesh/mesh_format.h"
#include "core/mesh/mesh_ply_header.h"
#include "core/mesh/text_scanner.h"

namespace argmesh {

class PlyTextSource {
 public:
  PlyTextSource(std::string_view bytes, const PlyHeader& header,
                const MeshLimits& limits);

  absl::StatusOr<double> ReadCoordinate(PlyScalar type);
  // `type` is an integer type.
  absl::StatusOr<int64_t> ReadInteger(PlyScalar type);
  absl::Status Skip(PlyScalar type, int64_t count);
  // Every item of an element begins a line; what is left of the item's last
  // line is skipped.
  absl::Status EndItem();
  int64_t lines_with_more() const { return lines_with_more_; }
  absl::Status ExpectEnd();

  // Fewest bytes that a value takes.
  int64_t MinBytes(PlyScalar /*type*/) const { return 2; }
  // The last value may lack the blank behind it.
  int64_t BytesLeft() const {
    return static_cast<int64_t>(scanner_.remaining()) + 1;
  }
  absl::Status Malformed(std::string_view message) const {
    return scanner_.Malformed(message);
  }
  absl::Status Located(const absl::Status& status) const {
    return scanner_.Located(status);
  }

 private:
  TextScanner scanner_;
  int64_t lines_with_more_ = 0;
};

class PlyBinarySource {
 public:
  PlyBinarySource(std::string_view bytes, const PlyHeader& header);

  absl::StatusOr<double> ReadCoordinate(PlyScalar type);
  absl::StatusOr<int64_t> ReadInteger(PlyScalar type);
  absl::Status Skip(PlyScalar type, int64_t count);
  absl::Status EndItem() const { return absl::OkStatus(); }
  int64_t lines_with_more() const { return 0; }
  absl::Status ExpectEnd() const;

  int64_t MinBytes(PlyScalar type) const {
    return static_cast<int64_t>(PlyScalarBytes(type));
  }
  int64_t BytesLeft() const {
    return static_cast<int64_t>(bytes_.size() - position_);
  }
  absl::Status Malformed(std::string_view message) const;
  absl::Status Located(const absl::Status& status) const;

 private:
  absl::Status Need(int64_t count) const;
  template <typename T>
  T Take();

  std::string_view bytes_;
  size_t position_;
  bool swap_;
};

}  // namespace argmesh

#endif  // ARGMESH_CORE_MESH_MESH_PLY_BODY_H_
