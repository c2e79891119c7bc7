// Any bytes behind a valid seal: the parsers of windows refuse them, or what
// they accept gives the same bytes again and can be voted on.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "core/base/sealed_bytes.h"
#include "core/containment/prepared_target.h"
#include "core/containment/window_codec.h"
#include "core/containment/window_index.h"

namespace {

void Require(bool holds) {
  if (!holds) std::abort();
}

void FuzzWords(const std::string& bytes) {
  const auto words = argmesh::ParseWindowWords(bytes);
  if (!words.ok()) {
    Require(words.status().code() == absl::StatusCode::kDataLoss);
    return;
  }
  Require(argmesh::SerializeWindowWords(*words) == bytes);
  argmesh::WindowIndex index;
  index.Set(0, *words);
  Require(index.size() == 1);
}

void FuzzTarget(const std::string& bytes) {
  const auto windows = argmesh::ParseTargetWindows(bytes);
  if (!windows.ok()) {
    Require(windows.status().code() == absl::StatusCode::kDataLoss);
    return;
  }
  Require(argmesh::SerializeTargetWindows(*windows) == bytes);
  const argmesh::PreparedTarget prepared(*windows);
  Require(prepared.surface.tree.size() == windows->points.size());
  for (const Eigen::Vector3f& normal : prepared.surface.normals) {
    Require(std::abs(normal.norm() - 1) < 1e-3F);
  }
  argmesh::AssignWindowWords(*windows);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view payload(reinterpret_cast<const char*>(data), size);
  FuzzWords(argmesh::SealBytes("ARGW", argmesh::kWindowsVersion, payload));
  FuzzTarget(argmesh::SealBytes("ARGV", argmesh::kWindowsVersion, payload));
  return 0;
}
