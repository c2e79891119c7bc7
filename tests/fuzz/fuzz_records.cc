// Any bytes as a record of the catalog: refused as damaged, or what they are
// taken for survives being written and read.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "server/engine/record_codec.h"
#include "tests/fuzz/require.h"

namespace argmesh {
namespace {

template <typename Parse, typename Serialize>
void FuzzRecord(std::string_view bytes, const Parse& parse,
                const Serialize& serialize) {
  const auto record = parse(bytes);
  if (!record.ok()) {
    Require(absl::IsDataLoss(record.status()), "an error of another kind");
    return;
  }
  const std::string written = serialize(*record);
  const auto again = parse(written);
  Require(again.ok(), "what was written cannot be read");
  Require(serialize(*again) == written, "a record that changes");
}

absl::StatusOr<ShapeRecord> ParseDetails(std::string_view bytes) {
  ShapeRecord record;
  const absl::Status status = ParseShapeDetails(bytes, record);
  if (!status.ok()) return status;
  return record;
}

void FuzzEvery(std::string_view bytes) {
  FuzzRecord(bytes, ParseCollectionSettings, SerializeCollectionSettings);
  FuzzRecord(bytes, ParseMetadataKeys, SerializeMetadataKeys);
  FuzzRecord(bytes, ParseDetails, SerializeShapeDetails);
  FuzzRecord(bytes, ParseShapeRecord, SerializeShapeRecord);
  FuzzRecord(bytes, ParseCollectionRecord, SerializeCollectionRecord);
  FuzzRecord(bytes, ParseShapeWritten, SerializeShapeWritten);
  FuzzRecord(bytes, ParseShapeDeleted, SerializeShapeDeleted);
  FuzzRecord(bytes, ParseCollectionDeleted, SerializeCollectionDeleted);
}

}  // namespace
}  // namespace argmesh

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  argmesh::FuzzEvery({reinterpret_cast<const char*>(data), size});
  return 0;
}
