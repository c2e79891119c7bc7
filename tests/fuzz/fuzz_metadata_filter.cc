// Filters: whatever the text, a reason with a place in it, or a filter that
// holds or does not.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "server/engine/error_reason.h"
#include "server/engine/metadata_filter.h"

namespace argmesh {
namespace {

int CountTerms(const FilterNode& node) {
  if (node.kind == FilterNode::Kind::kTerm) return 1;
  int terms = 0;
  for (const FilterNode& child : node.children) terms += CountTerms(child);
  return terms;
}

void FuzzFilter(std::string_view text) {
  const std::vector<MetadataKey> keys = {{"a", MetadataType::kString},
                                         {"b", MetadataType::kNumber},
                                         {"c", MetadataType::kBool}};
  const auto filter = MetadataFilter::Parse(text, keys);
  if (!filter.ok()) {
    if (!ReasonOf(filter.status())) std::abort();
    const std::string position = MetadataOf(filter.status())["position"];
    if (std::stoull(position) > text.size()) std::abort();
    return;
  }
  (void)filter->Matches({{"a", "a"}, {"b", "1"}, {"c", "true"}});
  if (filter->Matches({}) && !filter->root() &&
      text.find_first_not_of(" \t\r\n") != std::string_view::npos) {
    std::abort();
  }
  if (filter->root() && CountTerms(*filter->root()) > kMaxFilterTerms) {
    std::abort();
  }
}

}  // namespace
}  // namespace argmesh

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  argmesh::FuzzFilter({reinterpret_cast<const char*>(data), size});
  return 0;
}
