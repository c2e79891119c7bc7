#include "core/containment/word_table.h"

#include "core/containment/window_codebook.h"

namespace argmesh {

const DescriptorTable& DefaultWordTable() {
  static const DescriptorTable* const kTable =
      new DescriptorTable(DefaultWindowCodebook().words);
  return *kTable;
}

}  // namespace argmesh
