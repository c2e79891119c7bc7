#include "core/containment/window_words.h"

#include <algorithm>
#include <cstddef>

#include "core/containment/word_table.h"

namespace argmesh {

WindowWords AssignWindowWords(const TargetWindows& windows) {
  const DescriptorTable& table = DefaultWordTable();
  WindowWords words;
  for (size_t l = 0; l < words.levels.size(); ++l) {
    std::vector<uint16_t>& level = words.levels[l];
    for (const WindowDescriptor& d : windows.levels[l].descriptors) {
      level.push_back(static_cast<uint16_t>(table.FindNearest<1>(d)[0].row));
    }
    std::sort(level.begin(), level.end());
    level.erase(std::unique(level.begin(), level.end()), level.end());
  }
  return words;
}

}  // namespace argmesh
