#include "core/containment/window_codec.h"

#include <bit>
#include <cmath>

#include "absl/status/status.h"
#include "absl/strings/str_format.h"
#include "core/base/byte_reader.h"
#include "core/base/byte_writer.h"
#include "core/base/sealed_bytes.h"
#include "core/base/status_macros.h"
#include "core/containment/window_codebook.h"

namespace argmesh {
namespace {

constexpr std::string_view kWordsName = "window words";
constexpr std::string_view kWordsMagic = "ARGW";
constexpr std::string_view kWindowsName = "windows";
constexpr std::string_view kWindowsMagic = "ARGV";
constexpr size_t kPointBytes = 8;
constexpr size_t kWindowBytes = kPointBytes + kWindowDims;

void WritePoint(const PackedPoint& point, ByteWriter& writer) {
  for (const int16_t x : point.position) {
    writer.WriteU16(std::bit_cast<uint16_t>(x));
  }
  for (const int8_t x : point.normal) writer.WriteU8(std::bit_cast<uint8_t>(x));
}

absl::StatusOr<PackedPoint> ReadPoint(ByteReader& reader) {
  PackedPoint point;
  for (int16_t& x : point.position) {
    ARGMESH_ASSIGN_OR_RETURN(const uint16_t bits, reader.ReadU16());
    x = std::bit_cast<int16_t>(bits);
  }
  for (int8_t& x : point.normal) {
    ARGMESH_ASSIGN_OR_RETURN(const uint8_t bits, reader.ReadU8());
    x = std::bit_cast<int8_t>(bits);
  }
  return point;
}

// A count of items of `item_bytes` each, at most `limit`.
absl::StatusOr<size_t> ReadLimited(ByteReader& reader, std::string_view what,
                                   size_t item_bytes, int limit) {
  ARGMESH_ASSIGN_OR_RETURN(const uint32_t count, reader.ReadCount(item_bytes));
  if (count > static_cast<uint32_t>(limit)) {
    return absl::DataLossError(absl::StrFormat(
        "windows: %d %s, at most %d", count, std::string(what), limit));
  }
  return count;
}

absl::StatusOr<WindowLevel> ReadLevel(ByteReader& reader) {
  ARGMESH_ASSIGN_OR_RETURN(const size_t count,
                           ReadLimited(reader, "windows in a level",
                                       kWindowBytes, kMaxLevelWindows));
  WindowLevel level;
  level.frames.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    ARGMESH_ASSIGN_OR_RETURN(const PackedPoint frame, ReadPoint(reader));
    level.frames.push_back(frame);
  }
  level.descriptors.resize(count);
  for (WindowDescriptor& descriptor : level.descriptors) {
    ARGMESH_ASSIGN_OR_RETURN(const std::string_view bytes,
                             reader.ReadBytes(kWindowDims));
    for (size_t d = 0; d < kWindowDims; ++d) {
      descriptor[d] = std::bit_cast<int8_t>(bytes[d]);
    }
  }
  return level;
}

absl::StatusOr<WindowFrame> ReadFrame(ByteReader& reader) {
  WindowFrame frame;
  for (int k = 0; k < 3; ++k) {
    ARGMESH_ASSIGN_OR_RETURN(frame.origin[k], reader.ReadF64());
  }
  ARGMESH_ASSIGN_OR_RETURN(frame.scale, reader.ReadF64());
  if (!frame.origin.allFinite() || !std::isfinite(frame.scale) ||
      frame.scale <= 0) {
    return absl::DataLossError(
        "windows: frame without a finite place and size");
  }
  return frame;
}

}  // namespace

std::string SerializeWindowWords(const WindowWords& words) {
  ByteWriter writer;
  for (const std::vector<uint16_t>& level : words.levels) {
    writer.WriteU32(static_cast<uint32_t>(level.size()));
    for (const uint16_t word : level) writer.WriteU16(word);
  }
  return SealBytes(kWordsMagic, kWindowsVersion, writer.bytes());
}

absl::StatusOr<WindowWords> ParseWindowWords(std::string_view bytes) {
  ARGMESH_ASSIGN_OR_RETURN(
      const std::string_view payload,
      OpenSealedBytes(kWordsName, kWordsMagic, kWindowsVersion, bytes));
  ByteReader reader(payload, kWordsName);
  WindowWords words;
  for (std::vector<uint16_t>& level : words.levels) {
    ARGMESH_ASSIGN_OR_RETURN(const uint32_t count, reader.ReadCount(2));
    level.reserve(count);
    for (uint32_t i = 0; i < count; ++i) {
      ARGMESH_ASSIGN_OR_RETURN(const uint16_t word, reader.ReadU16());
      if (word >= kNumWindowWords) {
        return absl::DataLossError(absl::StrFormat(
            "window words: word %d, at most %d", word, kNumWindowWords - 1));
      }
      if (!level.empty() && word <= level.back()) {
        return absl::DataLossError("window words: words out of order");
      }
      level.push_back(word);
    }
  }
  ARGMESH_RETURN_IF_ERROR(reader.ExpectEnd());
  return words;
}

std::string SerializeTargetWindows(const TargetWindows& windows) {
  ByteWriter writer;
  for (const double x : windows.frame.origin) writer.WriteF64(x);
  writer.WriteF64(windows.frame.scale);
  for (const WindowLevel& level : windows.levels) {
    writer.WriteU32(static_cast<uint32_t>(level.frames.size()));
    for (const PackedPoint& frame : level.frames) WritePoint(frame, writer);
    for (const WindowDescriptor& descriptor : level.descriptors) {
      for (const int8_t x : descriptor) {
        writer.WriteU8(std::bit_cast<uint8_t>(x));
      }
    }
  }
  writer.WriteU32(static_cast<uint32_t>(windows.points.size()));
  for (const PackedPoint& point : windows.points) WritePoint(point, writer);
  return SealBytes(kWindowsMagic, kWindowsVersion, writer.bytes());
}

absl::StatusOr<TargetWindows> ParseTargetWindows(std::string_view bytes) {
  ARGMESH_ASSIGN_OR_RETURN(
      const std::string_view payload,
      OpenSealedBytes(kWindowsName, kWindowsMagic, kWindowsVersion, bytes));
  ByteReader reader(payload, kWindowsName);
  TargetWindows windows;
  ARGMESH_ASSIGN_OR_RETURN(windows.frame, ReadFrame(reader));
  for (WindowLevel& level : windows.levels) {
    ARGMESH_ASSIGN_OR_RETURN(level, ReadLevel(reader));
  }
  ARGMESH_ASSIGN_OR_RETURN(
      const size_t points,
      ReadLimited(reader, "points", kPointBytes, kMaxTargetPoints));
  windows.points.reserve(points);
  for (size_t i = 0; i < points; ++i) {
    ARGMESH_ASSIGN_OR_RETURN(const PackedPoint point, ReadPoint(reader));
    windows.points.push_back(point);
  }
  ARGMESH_RETURN_IF_ERROR(reader.ExpectEnd());
  return windows;
}

}  // namespace argmesh
