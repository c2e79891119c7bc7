// Snapshots and compressed labels: whatever the bytes, damage is found, and
// nothing larger than the file is taken.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "server/engine/error_reason.h"
#include "server/storage/label_compression.h"
#include "server/storage/sealed_archive.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/require.h"

namespace argmesh {
namespace {

constexpr int64_t kMaxLabels = 1 << 20;  // larger ones only take time

// The status at the end; how many bytes of members there were.
absl::Status ReadAll(const std::string& path, int64_t& bytes) {
  const auto reader = ArchiveReader::Open(path);
  if (!reader.ok()) return reader.status();
  while (true) {
    ArchiveMember member;
    const auto more = (*reader)->Next(member);
    if (!more.ok()) return more.status();
    if (!*more) return absl::OkStatus();
    while (true) {
      const auto part = (*reader)->Read(1000);
      if (!part.ok()) return part.status();
      if (part->empty()) break;
      bytes += static_cast<int64_t>(part->size());
    }
  }
}

void FuzzArchive(std::string_view archive) {
  static const MemoryFile file;
  file.Store(archive);
  int64_t bytes = 0;
  const absl::Status status = ReadAll(file.path(), bytes);
  Require(bytes <= static_cast<int64_t>(archive.size()), "no byte is made up");
  Require(status.ok() || ReasonOf(status) == ErrorReason::kStoredDataDamaged,
          "damage is called damage");
}

void FuzzLabels(std::string_view compressed, int64_t raw_bytes) {
  if (raw_bytes > kMaxLabels) return;
  const auto labels = DecompressLabels(compressed, raw_bytes);
  if (!labels.ok()) {
    Require(labels.status().code() == absl::StatusCode::kDataLoss, "labels");
    return;
  }
  const auto again = CompressLabels(*labels);
  Require(again.ok(), "labels can be compressed");
  const auto back = DecompressLabels(*again, raw_bytes);
  Require(back.ok() && *back == *labels, "labels come back");
}

}  // namespace
}  // namespace argmesh

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  argmesh::FuzzArchive(bytes);
  if (size < 3) return 0;
  argmesh::FuzzLabels(bytes.substr(3), data[0] | data[1] << 8 | data[2] << 16);
  return 0;
}
