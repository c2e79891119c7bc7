// What windows are compared by: a projection of raw descriptors, words that
// stand for the usual ones, and how usual each is.
//
// Made once from training meshes by tests/benchmark/make_window_codebook and
// embedded. Another codebook makes stored windows useless: it comes with
// another kWindowsVersion.
#ifndef ARGMESH_CORE_CONTAINMENT_WINDOW_CODEBOOK_H_
#define ARGMESH_CORE_CONTAINMENT_WINDOW_CODEBOOK_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "core/containment/window_descriptor.h"
#include "core/containment/window_set.h"

namespace argmesh {

inline constexpr size_t kNumWindowWords = 2048;

struct WindowCodebook {
  RawDescriptor mean;
  // descriptor = round((raw - mean)^T projection), clamped to -127 .. 127.
  Eigen::Matrix<float, static_cast<int>(kRawDims),
                static_cast<int>(kWindowDims)>
      projection;
  // What distance 1 of the formulas is, in units of descriptors.
  float unit = 1;
  std::vector<WindowDescriptor> words;  // kNumWindowWords
  // [level][word]: share of training shapes that have the word at the level,
  // in 255ths.
  std::array<std::array<uint8_t, kNumWindowWords>, kNumTargetLevels> share{};

  WindowDescriptor Project(const RawDescriptor& raw) const;
};

std::string SerializeWindowCodebook(const WindowCodebook& codebook);

// Fails    kDataLoss  damaged, another version, or numbers out of range
absl::StatusOr<WindowCodebook> ParseWindowCodebook(std::string_view bytes);

// The embedded one; ends the program when it is damaged.
const WindowCodebook& DefaultWindowCodebook();

}  // namespace argmesh

#endif  // ARGMESH_CORE_CONTAINMENT_WINDOW_CODEBOOK_H_
