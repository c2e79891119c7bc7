#include "server/engine/metadata_filter.h"

#include <algorithm>

#include "core/base/status_macros.h"
#include "server/engine/filter_parser.h"

namespace argmesh {
namespace {

using Metadata = std::map<std::string, std::string>;

bool Holds(const FilterTerm& term, const Metadata& metadata) {
  const auto entry = metadata.find(term.key.key);
  if (entry == metadata.end()) return false;
  if (term.op == FilterOperator::kPresent) return true;
  const std::optional<MetadataValue> value =
      ReadMetadataValue(term.key.type, entry->second);
  if (!value) return false;
  switch (term.op) {
    case FilterOperator::kEqual:
      return *value == term.value;
    case FilterOperator::kNotEqual:
      return *value != term.value;
    case FilterOperator::kLess:
      return *value < term.value;
    case FilterOperator::kLessOrEqual:
      return *value <= term.value;
    case FilterOperator::kGreater:
      return *value > term.value;
    case FilterOperator::kGreaterOrEqual:
      return *value >= term.value;
    case FilterOperator::kPresent:
      break;
  }
  return true;
}

bool Holds(const FilterNode& node, const Metadata& metadata) {
  const auto holds = [&metadata](const FilterNode& child) {
    return Holds(child, metadata);
  };
  const std::vector<FilterNode>& children = node.children;
  switch (node.kind) {
    case FilterNode::Kind::kAnd:
      return std::all_of(children.begin(), children.end(), holds);
    case FilterNode::Kind::kOr:
      return std::any_of(children.begin(), children.end(), holds);
    case FilterNode::Kind::kNot:
      return std::none_of(children.begin(), children.end(), holds);
    case FilterNode::Kind::kTerm:
      return Holds(node.term, metadata);
  }
  return false;
}

}  // namespace

absl::StatusOr<MetadataFilter> MetadataFilter::Parse(
    std::string_view filter, const std::vector<MetadataKey>& keys) {
  FilterParser parser(filter, keys);
  ARGMESH_ASSIGN_OR_RETURN(std::optional<FilterNode> root, parser.Parse());
  return root ? MetadataFilter(*std::move(root)) : MetadataFilter();
}

bool MetadataFilter::Matches(const Metadata& metadata) const {
  return !root_ || Holds(*root_, metadata);
}

}  // namespace argmesh
