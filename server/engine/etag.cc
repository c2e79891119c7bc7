// The etags of both kinds of record: a checksum of what tells two versions of
// a record apart, short enough to be typed.
#include "absl/strings/str_format.h"
#include "core/base/crc32c.h"
#include "server/engine/collection_record.h"
#include "server/engine/shape_record.h"

namespace argmesh {
namespace {

std::string Etag(const std::string& uid, int64_t version) {
  return absl::StrFormat("%d-%08x", version, ComputeCrc32c(uid));
}

}  // namespace

std::string CollectionEtag(const CollectionRecord& record) {
  return Etag(record.uid, record.revision);
}

std::string ShapeEtag(const ShapeRecord& record) {
  return Etag(record.uid, record.generation);
}

}  // namespace argmesh
