#include "core/containment/window_codebook.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

#include "absl/status/status.h"
#include "core/base/byte_reader.h"
#include "core/base/byte_writer.h"
#include "core/base/sealed_bytes.h"
#include "core/base/status_macros.h"

// core/containment/window_codebook.bin, linked in by argmesh_embed.
extern "C" {
extern const char argmesh_window_codebook_begin[];
extern const char argmesh_window_codebook_end[];
}

namespace argmesh {
namespace {

constexpr std::string_view kWhat = "window codebook";
constexpr std::string_view kMagic = "ARGK";
constexpr uint32_t kVersion = 1;

absl::Status ReadFinite(ByteReader& reader, float* out, Eigen::Index count) {
  for (Eigen::Index i = 0; i < count; ++i) {
    ARGMESH_ASSIGN_OR_RETURN(out[i], reader.ReadF32());
    if (!std::isfinite(out[i])) {
      return absl::DataLossError("window codebook: a number is not finite");
    }
  }
  return absl::OkStatus();
}

}  // namespace

WindowDescriptor WindowCodebook::Project(const RawDescriptor& raw) const {
  const RawDescriptor difference = raw - mean;
  WindowDescriptor descriptor;
  for (size_t d = 0; d < kWindowDims; ++d) {
    const float x =
        projection.col(static_cast<Eigen::Index>(d)).dot(difference);
    descriptor[d] =
        static_cast<int8_t>(std::lround(std::clamp(x, -127.0F, 127.0F)));
  }
  return descriptor;
}

std::string SerializeWindowCodebook(const WindowCodebook& codebook) {
  ByteWriter writer;
  const auto write = [&writer](const float* values, Eigen::Index count) {
    writer.WriteF32Array({values, static_cast<size_t>(count)});
  };
  write(codebook.mean.data(), codebook.mean.size());
  write(codebook.projection.data(), codebook.projection.size());
  writer.WriteF32(codebook.unit);
  for (const WindowDescriptor& word : codebook.words) {
    for (const int8_t x : word) writer.WriteU8(std::bit_cast<uint8_t>(x));
  }
  for (const auto& level : codebook.share) {
    for (const uint8_t x : level) writer.WriteU8(x);
  }
  return SealBytes(kMagic, kVersion, writer.bytes());
}

absl::StatusOr<WindowCodebook> ParseWindowCodebook(std::string_view bytes) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string_view payload,
                           OpenSealedBytes(kWhat, kMagic, kVersion, bytes));
  ByteReader reader(payload, kWhat);
  WindowCodebook codebook;
  ARGMESH_RETURN_IF_ERROR(
      ReadFinite(reader, codebook.mean.data(), codebook.mean.size()));
  ARGMESH_RETURN_IF_ERROR(ReadFinite(reader, codebook.projection.data(),
                                     codebook.projection.size()));
  ARGMESH_RETURN_IF_ERROR(ReadFinite(reader, &codebook.unit, 1));
  if (!(codebook.unit >= 1 && codebook.unit <= 1000)) {
    return absl::DataLossError("window codebook: unit outside 1 .. 1000");
  }
  ARGMESH_ASSIGN_OR_RETURN(const std::string_view words,
                           reader.ReadBytes(kNumWindowWords * kWindowDims));
  codebook.words.resize(kNumWindowWords);
  auto next = words.begin();
  for (WindowDescriptor& word : codebook.words) {
    for (int8_t& x : word) x = std::bit_cast<int8_t>(*next++);
  }
  for (auto& level : codebook.share) {
    ARGMESH_ASSIGN_OR_RETURN(const std::string_view shares,
                             reader.ReadBytes(kNumWindowWords));
    std::transform(shares.begin(), shares.end(), level.begin(),
                   [](char x) { return std::bit_cast<uint8_t>(x); });
  }
  ARGMESH_RETURN_IF_ERROR(reader.ExpectEnd());
  return codebook;
}

const WindowCodebook& DefaultWindowCodebook() {
  static const WindowCodebook* const kCodebook = [] {
    absl::StatusOr<WindowCodebook> parsed = ParseWindowCodebook(
        {argmesh_window_codebook_begin,
         static_cast<size_t>(argmesh_window_codebook_end -
                             argmesh_window_codebook_begin)});
    if (!parsed.ok()) std::abort();  // the program itself is damaged
    return new WindowCodebook(*std::move(parsed));
  }();
  return *kCodebook;
}

}  // namespace argmesh
